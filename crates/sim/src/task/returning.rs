//! Return to launch: stop and climb, fly home or to a rally point, wait, land. Or retrace the flown path, and land.

use std::time::Duration;

use glam::{DVec2, DVec3};

use super::{Act, Cockpit, Landing, Route};
use crate::control::FlatMotion;

/// The flight home begins this long after the vehicle is near its stopping point: even a tiny climb is a separate
/// leg on the real vehicle.
const PLAN_TIME: Duration = Duration::from_millis(700);
/// A leg home that is shorter than this, in metres, takes a fixed time, because the real vehicle is
/// never exactly at its destination.
const TINY_LEG_M: f64 = 0.1;
const TINY_LEG_TIME: Duration = Duration::from_millis(900);
/// The distance from its height within which the climb is over, in metres.
const HEIGHT_REACHED_M: f64 = 0.2;
/// The distance within which the stopping point counts as reached, in metres (`WPNAV_RADIUS`).
const HOME_REACHED_M: f64 = 2.0;
/// The minimum height of a return, in metres (`RTL_ALT_MIN`).
const LEAST_HEIGHT_M: f64 = 2.0;
/// A cone that is flatter than this does not count (`RTL_MIN_CONE_SLOPE`).
const CONE_SLOPE_MIN: f64 = 0.5;
/// A retraced path ends this far above its first point, in metres.
const ABOVE_FIRST_M: f64 = 2.0;

#[derive(Debug, Clone, PartialEq)]
enum ReturnStage {
    Climb { standing_since: Option<Duration> },
    Fly(Box<Route>),
    Wait { until: Duration },
    Hold { down_m: f64 },
    Land(Landing),
    Retrace(Box<Route>),
}

/// A return under way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Returning {
    stage: ReturnStage,
    /// The destination, in metres north and east.
    goal_m: DVec2,
    /// The height to fly at, in metres down from the start.
    down_m: f64,
    /// The point over which to climb, decided in the first step.
    over_m: Option<DVec2>,
}

impl Returning {
    /// Chooses the destination (home or a rally point) and the height: `RTL_ALT` above home, limited by the cone and
    /// the fence, never below the current height.
    pub(crate) fn new(cockpit: &Cockpit<'_>) -> Self {
        let tuning = cockpit.tuning;
        let (here, home) = (cockpit.body.position_m, cockpit.home_m);
        let goal = cockpit
            .rally
            .destination(&tuning.rally, here, home, |point| {
                cockpit.fence.allows(&tuning.fence, point, home)
            });
        let here_m = home.z - here.z;
        let least_m = (here_m + tuning.return_climb_min_m).max(LEAST_HEIGHT_M);
        let mut height_m = tuning.return_altitude_m.max(least_m).max(home.z - goal.z);
        if tuning.return_cone_slope >= CONE_SLOPE_MIN {
            let way_m = (here - goal).truncate().length();
            height_m = height_m.min((way_m * tuning.return_cone_slope).max(least_m));
        }
        if let Some(highest_m) = tuning.fence.highest_m() {
            height_m = height_m.min(highest_m);
        }
        Self {
            stage: ReturnStage::Climb {
                standing_since: None,
            },
            goal_m: goal.truncate(),
            down_m: home.z - height_m.max(here_m),
            over_m: None,
        }
    }

    /// Stops, and retraces the path to the place where the motors were armed.
    pub(crate) fn retracing(cockpit: &mut Cockpit<'_>) -> Self {
        cockpit.trail.tidy(&cockpit.tuning.trail);
        let route = Route::standing(cockpit);
        Self {
            goal_m: route.goal_m().truncate(),
            down_m: route.goal_m().z,
            over_m: None,
            stage: ReturnStage::Retrace(Box::new(route)),
        }
    }

    /// The landing of the return, once it has begun.
    pub(crate) fn landing(&self) -> Option<&Landing> {
        match &self.stage {
            ReturnStage::Land(landing) => Some(landing),
            ReturnStage::Climb { .. }
            | ReturnStage::Fly(_)
            | ReturnStage::Wait { .. }
            | ReturnStage::Hold { .. }
            | ReturnStage::Retrace(_) => None,
        }
    }

    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        let limits = cockpit.limits;
        match &mut self.stage {
            ReturnStage::Climb { .. } => self.climb(cockpit),
            ReturnStage::Fly(route) => {
                cockpit.limits.speed_m_s = cockpit.tuning.return_speed_m_s;
                let act = route.step(cockpit);
                if !route.reached {
                    return act;
                }
                self.stage = ReturnStage::Wait {
                    until: cockpit.now + cockpit.tuning.return_loiter,
                };
            }
            ReturnStage::Wait { until } => {
                let over = self.goal_m.extend(self.down_m);
                cockpit.control.towards(over, &limits);
                if cockpit.now >= *until {
                    self.stage = Self::end(cockpit);
                }
            }
            ReturnStage::Hold { down_m } => {
                let over = self.goal_m.extend(*down_m);
                cockpit.control.towards(over, &limits);
            }
            ReturnStage::Land(landing) => return landing.step(cockpit),
            ReturnStage::Retrace(_) => return self.retrace(cockpit),
        }
        Act::Fly
    }

    /// Flies from one breadcrumb to the next, and lands at the first one of the flight.
    fn retrace(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        let ReturnStage::Retrace(route) = &mut self.stage else {
            return Act::Fly;
        };
        if cockpit.body.on_ground {
            self.stage = ReturnStage::Land(Landing::default());
            return Act::Fly;
        }
        if route.reached {
            let Some((point_m, is_first)) = cockpit.trail.pop() else {
                self.stage = Self::end(cockpit);
                return Act::Fly;
            };
            let goal_m = above_first(point_m, is_first);
            self.goal_m = goal_m.truncate();
            route.go_to(goal_m, cockpit);
            if let Some((next_m, is_first)) = cockpit.trail.peek() {
                route.then_to(above_first(next_m, is_first), cockpit);
            }
        }
        route.step(cockpit)
    }

    /// Climbs over the stopping point, and plans the leg to the destination.
    fn climb(&mut self, cockpit: &mut Cockpit<'_>) {
        if cockpit.body.on_ground {
            self.stage = ReturnStage::Land(Landing::default());
            return;
        }
        let limits = cockpit.limits;
        let over = *self
            .over_m
            .get_or_insert_with(|| cockpit.control.stopping_point(&limits));
        // The path waits at the stopping point: the position error alone brings the vehicle there.
        let still = FlatMotion::steady(over, DVec2::ZERO);
        cockpit.control.along(&still, self.down_m, &limits);
        let high = (cockpit.body.position_m.z - self.down_m).abs() < HEIGHT_REACHED_M;
        let near = cockpit.body.position_m.truncate().distance(over) < HOME_REACHED_M;
        if let ReturnStage::Climb { standing_since } = &mut self.stage
            && high
            && near
        {
            let since = *standing_since.get_or_insert(cockpit.now);
            let is_there = over.distance(self.goal_m) < TINY_LEG_M;
            let tiny_leg = if is_there {
                TINY_LEG_TIME
            } else {
                Duration::ZERO
            };
            if cockpit.now >= since + PLAN_TIME + tiny_leg {
                self.stage = self.leg_home(over, cockpit);
            }
        }
    }

    /// The stage over home: landing, or a descent to `RTL_ALT_FINAL` and a wait there.
    fn end(cockpit: &Cockpit<'_>) -> ReturnStage {
        let stay_m = cockpit.tuning.return_final_altitude_m;
        if stay_m > 0.0 {
            ReturnStage::Hold {
                down_m: cockpit.home_m.z - stay_m,
            }
        } else {
            ReturnStage::Land(Landing::default())
        }
    }

    fn leg_home(&self, from_m: DVec2, cockpit: &mut Cockpit<'_>) -> ReturnStage {
        cockpit.limits.speed_m_s = cockpit.tuning.return_speed_m_s;
        let mut route = Route::waiting_at(from_m.extend(self.down_m), cockpit);
        route.go_to(self.goal_m.extend(self.down_m), cockpit);
        ReturnStage::Fly(Box::new(route))
    }
}

/// The target point for a breadcrumb; slightly higher for the first one of the flight, which lies on the ground.
fn above_first(point_m: DVec3, first: bool) -> DVec3 {
    if first {
        point_m - DVec3::Z * ABOVE_FIRST_M
    } else {
        point_m
    }
}
