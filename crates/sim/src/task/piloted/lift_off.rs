//! Leaving the ground by the throttle stick: the motors spool up, and a takeoff may climb to a height on its own
//! (`PILOT_TKOFF_ALT`).

use std::time::Duration;

use super::PilotRules;
use crate::kinematics::square_root;

/// The time from the stick's command to climb until the lift-off.
const SPOOL: Duration = Duration::from_millis(1400);
/// The time to the lift-off in a mode in which the stick drives the motors: fitted to a climb of 51 m in 7.8 s.
const MANUAL_SPOOL: Duration = Duration::from_millis(850);
/// How long the throttle stick must command a climb before a takeoff to a height begins.
const TRIGGERS: Duration = Duration::from_millis(400);
/// A takeoff is over within this share of its height.
const ENDS_SHARE: f64 = 0.01;

/// The state of a takeoff to a height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Ascent {
    #[default]
    Not,
    Spools,
    /// The vehicle climbs to a height, in metres down from the start.
    ClimbsTo(f64),
}

/// The state of a lift-off.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LiftOff {
    /// The time at which the throttle stick began to command a vehicle on the ground to climb.
    spooling_since: Option<Duration>,
    ascent: Ascent,
}

impl LiftOff {
    /// Whether a vehicle on the ground lifts off now; its motors spool up first, but not before
    /// `from`. A stick held up for `TRIGGERS` begins a takeoff, if a height is set for it, and may
    /// then be released.
    pub(super) fn lifts(
        &mut self,
        climb_m_s: f64,
        takeoff_m: f64,
        now: Duration,
        from: Duration,
    ) -> bool {
        let begun = self.ascent == Ascent::Spools && climb_m_s >= 0.0;
        if climb_m_s <= 0.0 && !begun {
            *self = Self::default();
            return false;
        }
        let since = *self.spooling_since.get_or_insert(now.max(from));
        if takeoff_m > 0.0 && climb_m_s > 0.0 && now >= since + TRIGGERS {
            self.ascent = Ascent::Spools;
        }
        now >= since + SPOOL
    }

    /// Whether the motors of a vehicle on the ground have spooled up after the throttle stick has left its end.
    pub(super) fn spools(&mut self, share: f64, now: Duration, from: Duration) -> bool {
        if share <= 0.0 {
            self.spooling_since = None;
            return false;
        }
        now >= *self.spooling_since.get_or_insert(now.max(from)) + MANUAL_SPOOL
    }

    /// The climb rate of a takeoff under way, in m/s upwards; the stick's climb rate once the
    /// takeoff is over or the stick commands a descent.
    pub(super) fn climb(&mut self, asked_m_s: f64, here_m: f64, rules: &PilotRules) -> f64 {
        if self.ascent == Ascent::Spools {
            self.ascent = Ascent::ClimbsTo(here_m - rules.takeoff_m);
        }
        let Ascent::ClimbsTo(goal_m) = self.ascent else {
            return asked_m_s;
        };
        let left_m = here_m - goal_m;
        if asked_m_s < 0.0 || left_m < rules.takeoff_m * ENDS_SHARE {
            self.ascent = Ascent::Not;
            return asked_m_s;
        }
        let most = square_root(left_m, 1.0, rules.accel_z_m_s2).min(rules.climb_m_s);
        most.max(asked_m_s)
    }
}
