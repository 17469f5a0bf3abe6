//! Taking off: spool up, lift, climb.

use std::time::Duration;

use glam::DVec3;

use super::{Act, Cockpit};

/// The times from the command until the vehicle counts as taking off, and until it leaves the ground.
const SPOOLED: Duration = Duration::from_millis(1100);
const LIFTS: Duration = Duration::from_millis(1600);
/// The climb rate at the beginning of the path, in m/s: the thrust overshoots while the vehicle is
/// still on the ground.
const FIRST_CLIMB_M_S: f64 = 0.5;
/// The distance from its goal within which the takeoff is over, in metres.
const REACHED_M: f64 = 0.05;

/// A takeoff under way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Takeoff {
    since: Duration,
    pub(crate) goal_m: DVec3,
    lifted: bool,
    /// Whether the height was reached.
    pub(crate) reached: bool,
}

impl Takeoff {
    /// A takeoff straight up from the vehicle's position to a height (metres above the start).
    pub(crate) fn new(from_m: DVec3, height_m: f64, now: Duration) -> Self {
        Self {
            since: now,
            goal_m: from_m.truncate().extend(-height_m),
            lifted: false,
            reached: false,
        }
    }

    /// A takeoff to a height for a vehicle in flight.
    pub(crate) fn in_flight(from_m: DVec3, height_m: f64, now: Duration) -> Self {
        Self {
            since: now.saturating_sub(LIFTS),
            lifted: true,
            ..Self::new(from_m, height_m, now)
        }
    }

    /// Whether the motors have spooled up.
    pub(crate) fn is_spooled(&self, now: Duration) -> bool {
        now >= self.since + SPOOLED
    }

    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        if cockpit.now < self.since + LIFTS {
            return Act::Idle;
        }
        if !self.lifted {
            self.lifted = true;
            cockpit.control.take_over(cockpit.body);
            cockpit.control.velocity_m_s.z = -FIRST_CLIMB_M_S;
        }
        let limits = cockpit.limits;
        cockpit.control.towards(self.goal_m, &limits);
        self.reached |= (cockpit.body.position_m.z - self.goal_m.z).abs() < REACHED_M;
        Act::Fly
    }
}
