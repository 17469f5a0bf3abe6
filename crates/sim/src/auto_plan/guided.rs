//! Control by setpoints within a mission (`NAV_GUIDED_ENABLE`), and its limits (`DO_GUIDED_LIMITS`).

use std::time::Duration;

use glam::DVec3;

use super::place::item_place;
use super::{AutoPlan, PlanWait};
use crate::plan::Item;
use crate::vehicle::Vehicle;

/// The limits beyond which the mission goes on; 0 for none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct GuidedLimits {
    lasts: Duration,
    lowest_m: f64,
    highest_m: f64,
    furthest_m: f64,
}

impl GuidedLimits {
    pub(super) fn of(item: &Item) -> Self {
        let [seconds, lowest_m, highest_m, furthest_m] = item.params.map(f64::from);
        Self {
            lasts: Duration::from_secs(seconds.clamp(0.0, 65535.0) as u64),
            lowest_m,
            highest_m,
            furthest_m,
        }
    }

    fn are_exceeded(&self, vehicle: &Vehicle, since: Duration, from_m: DVec3) -> bool {
        if !self.lasts.is_zero() && vehicle.uptime() >= since + self.lasts {
            return true;
        }
        let here_m = vehicle.believed().position_m;
        let is_low = self.lowest_m != 0.0 && -here_m.z < self.lowest_m;
        let is_high = self.highest_m != 0.0 && -here_m.z > self.highest_m;
        // Heights do not matter to a rover.
        let height_is_off = vehicle.kind.chassis().is_none() && (is_low || is_high);
        let way_m = (here_m - from_m).truncate().length();
        height_is_off || self.furthest_m > 0.0 && way_m > self.furthest_m
    }
}

impl AutoPlan {
    /// Whether setpoints from a ground station control the vehicle.
    pub(crate) fn is_guided(&self) -> bool {
        matches!(self.wait, PlanWait::Guided { .. })
    }

    /// Begins to wait for setpoints.
    pub(super) fn guided_from_here(vehicle: &Vehicle) -> PlanWait {
        PlanWait::Guided {
            since: vehicle.uptime(),
            from_m: vehicle.believed().position_m,
        }
    }

    /// Whether the control by setpoints is over: switched off by the item, at a limit, or where a rover was to arrive.
    pub(super) fn guiding_is_over(&self, vehicle: &Vehicle, item: &Item) -> bool {
        let (1.., PlanWait::Guided { since, from_m }) = (item.params[0] as u16, &self.wait) else {
            return true;
        };
        let here_m = vehicle.believed().position_m.truncate();
        let goal_m = item_place(vehicle, item).filter(|_| vehicle.kind.chassis().is_some());
        let radius_m = vehicle.tuning.flight.auto.radius_m;
        goal_m.is_some_and(|goal_m| goal_m.distance(here_m) <= radius_m)
            || self.guided_limits.are_exceeded(vehicle, *since, *from_m)
    }
}
