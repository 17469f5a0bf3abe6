//! SIMPLE and SUPER SIMPLE: the sticks refer to the heading at arming, or to the direction away from home, instead of
//! the nose.

use sortie_geo::wrap_180;

/// SUPER SIMPLE keeps its heading within this distance of home, in metres.
const NEAR_HOME_M: f64 = 10.0;
/// The heading of SUPER SIMPLE changes once the direction to home differs by this many degrees.
const TURNS_BY_DEG: f64 = 5.0;

/// The reference of the sticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SimpleMode {
    /// The nose: forward on the stick is forward for the vehicle.
    #[default]
    Off,
    /// The heading at arming.
    Simple,
    /// The direction away from home.
    SuperSimple,
}

/// The reference of the sticks, and the headings of both kinds.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SimpleSticks {
    mode: SimpleMode,
    armed_deg: f64,
    /// The direction to home when the heading of SUPER SIMPLE was set, and that heading.
    home_deg: f64,
    away_deg: f64,
}

impl SimpleSticks {
    /// Takes the nose as the heading of both kinds.
    pub(crate) fn reset(&mut self, nose_deg: f64) {
        self.armed_deg = nose_deg;
        self.away_deg = nose_deg;
        self.home_deg = nose_deg + 180.0;
    }

    /// Sets the reference; returns a text for the pilot if the reference has changed. Home lies in
    /// the direction `home_deg`.
    pub(crate) fn set(&mut self, mode: SimpleMode, home_deg: f64) -> Option<&'static str> {
        if std::mem::replace(&mut self.mode, mode) == mode {
            return None;
        }
        Some(match mode {
            SimpleMode::Off => "SIMPLE mode off",
            SimpleMode::Simple => "SIMPLE mode on",
            SimpleMode::SuperSimple => {
                self.turn_away(home_deg);
                "SUPERSIMPLE mode on"
            }
        })
    }

    /// Whether the reference changes in flight.
    pub(crate) fn follows_home(&self) -> bool {
        self.mode == SimpleMode::SuperSimple
    }

    /// Follows the direction away from home; to be called ten times a second.
    pub(crate) fn watch(&mut self, home_distance_m: f64, home_deg: f64) {
        if self.follows_home() && home_distance_m >= NEAR_HOME_M {
            self.turn_away(home_deg);
        }
    }

    fn turn_away(&mut self, home_deg: f64) {
        if wrap_180(home_deg - self.home_deg).abs() >= TURNS_BY_DEG {
            self.home_deg = home_deg;
            self.away_deg = home_deg + 180.0;
        }
    }

    /// The heading that "forward" means, in degrees; `None` for the nose.
    pub(crate) fn heading_deg(&self) -> Option<f64> {
        match self.mode {
            SimpleMode::Off => None,
            SimpleMode::Simple => Some(self.armed_deg),
            SimpleMode::SuperSimple => Some(self.away_deg),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_is_the_heading_at_arming_or_away_from_home() {
        let mut sticks = SimpleSticks::default();
        sticks.reset(90.0);
        assert_eq!(sticks.heading_deg(), None);
        assert_eq!(sticks.set(SimpleMode::Simple, 0.0), Some("SIMPLE mode on"));
        assert_eq!(sticks.set(SimpleMode::Simple, 0.0), None);
        assert_eq!(sticks.heading_deg(), Some(90.0));
        sticks.set(SimpleMode::SuperSimple, 200.0);
        assert_eq!(sticks.heading_deg(), Some(380.0));
        sticks.watch(9.0, 250.0);
        assert_eq!(sticks.heading_deg(), Some(380.0));
        sticks.watch(11.0, 204.0);
        assert_eq!(sticks.heading_deg(), Some(380.0));
        sticks.watch(11.0, 206.0);
        assert_eq!(sticks.heading_deg(), Some(386.0));
    }
}
