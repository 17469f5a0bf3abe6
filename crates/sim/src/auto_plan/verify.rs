//! Detects when commands of a mission are complete.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{AutoPlan, PlanWait, command, sequence};
use crate::cmd;
use crate::kind::VehicleKind;
use crate::kinematics::square_root;
use crate::plan::Item;
use crate::task::{Landing, Task};
use crate::vehicle::Vehicle;

/// The gain of the final approach to a height: fitted to 4 m in 3.8 s.
const HEIGHT_GAIN_PER_S: f64 = 1.5;
const HEIGHT_REACHED_M: f64 = 0.05;

impl AutoPlan {
    /// Whether the navigation command is over; if so, fills the slot of reached items.
    pub(super) fn navigation_is_over(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let over = match vehicle.kind {
            VehicleKind::Copter => self.flight_is_over(vehicle, at),
            VehicleKind::Rover(_) => self.drive_is_over(vehicle, at),
        };
        // The end of a climb or descent at a place is not reported.
        if over && self.nav_item.command != cmd::NAV_LOITER_TO_ALT {
            self.reached = Some(at);
        }
        over
    }

    fn flight_is_over(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let item = self.nav_item;
        match item.command {
            cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF => {
                matches!(&vehicle.flight.task, Task::Takeoff(takeoff) if takeoff.reached)
            }
            cmd::NAV_WAYPOINT | cmd::NAV_SPLINE_WAYPOINT | cmd::NAV_LOITER_TIME => {
                self.has_stayed(vehicle, at, &item)
            }
            cmd::NAV_LAND | cmd::NAV_VTOL_LAND => self.has_landed(vehicle, at),
            cmd::NAV_LOITER_TURNS => self.has_turned(vehicle, &item),
            cmd::NAV_LOITER_TO_ALT => self.has_height(vehicle),
            cmd::NAV_RETURN_TO_LAUNCH => vehicle.landing_is_over(),
            cmd::NAV_GUIDED_ENABLE => self.guiding_is_over(vehicle, &item),
            cmd::NAV_DELAY => {
                matches!(self.wait, PlanWait::Until(until) if vehicle.uptime() >= until)
            }
            _ => false,
        }
    }

    /// Whether the action or condition is complete.
    pub(super) fn action_is_over(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let Some(item) = vehicle.plans.item(at) else {
            return true;
        };
        if command::is_quiet(item.command) {
            return true;
        }
        let over = match item.command {
            cmd::CONDITION_DELAY => {
                let seconds = f64::from(item.params[0]).clamp(0.0, 1e6);
                vehicle.uptime() > self.action.since + Duration::from_secs_f64(seconds)
            }
            cmd::CONDITION_DISTANCE => {
                distance_to_goal_m(vehicle) < f64::from(item.params[0]).max(0.0)
            }
            cmd::CONDITION_YAW if vehicle.kind == VehicleKind::Copter => {
                vehicle.flight.yaw.has_turned(vehicle.plant.body.yaw_deg)
            }
            cmd::DO_SET_REVERSE if vehicle.kind != VehicleKind::Copter => true,
            known if command::acts_at_once(known) => true,
            unknown => {
                vehicle.say(
                    MavSeverity::MAV_SEVERITY_WARNING,
                    &format!("Skipping invalid cmd #{unknown}"),
                );
                true
            }
        };
        if over {
            self.reached = Some(at);
        }
        over
    }

    fn has_stayed(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item) -> bool {
        if !matches!(&vehicle.flight.task, Task::Route(route) if route.reached) {
            return false;
        }
        let now = vehicle.uptime();
        let PlanWait::Stay(since) = &mut self.wait else {
            return false;
        };
        let since = *since.get_or_insert(now);
        let over = now.saturating_sub(since).as_secs() >= u64::from(item.params[0] as u16);
        if over {
            let text = format!("Reached command #{at}");
            vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        over
    }

    fn has_turned(&mut self, vehicle: &mut Vehicle, item: &Item) -> bool {
        if matches!(&vehicle.flight.task, Task::Route(route) if route.reached)
            && let PlanWait::Edge(orbit) = std::mem::take(&mut self.wait)
        {
            self.begin_turning(vehicle, orbit);
            return false;
        }
        matches!(&vehicle.flight.task, Task::Orbit(orbit) if orbit.turns() >= f64::from(item.params[0]))
    }

    /// Whether the vehicle has arrived at the place and then reached or passed the height.
    fn has_height(&mut self, vehicle: &mut Vehicle) -> bool {
        let PlanWait::Height { down_m, left_m } = self.wait.clone() else {
            return false;
        };
        let here_m = vehicle.believed().position_m;
        let there = vehicle.with_cockpit(|task, cockpit| match task {
            Task::Route(route) if !route.is_over_goal(cockpit) => false,
            _ => {
                let limits = &cockpit.limits;
                let climb = square_root(down_m - here_m.z, HEIGHT_GAIN_PER_S, limits.accel_z_m_s2);
                *task = Task::Velocity {
                    wanted_m_s: DVec3::Z * climb.clamp(-limits.speed_up_m_s, limits.speed_down_m_s),
                    // The time limit is renewed in every step.
                    until: cockpit.now + Duration::from_secs(1),
                };
                true
            }
        });
        if !there {
            return false;
        }
        let left = here_m.z - down_m;
        let passed = left_m.is_some_and(|before| before * left < 0.0);
        self.wait = PlanWait::Height {
            down_m,
            left_m: Some(left),
        };
        left.abs() < HEIGHT_REACHED_M || passed
    }

    /// Handles a landing. Afterwards, the mission continues if a takeoff follows and `MIS_OPTIONS`
    /// allows it; otherwise the vehicle disarms and the mission resets. Returns whether the mission
    /// continues.
    fn has_landed(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        if self.wait == PlanWait::LandingPlace {
            if matches!(&vehicle.flight.task, Task::Route(route) if route.reached) {
                vehicle.flight.task = Task::Land(Landing::default());
                self.wait = PlanWait::Nothing;
                vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
            }
            return false;
        }
        if !vehicle.landing_is_over() {
            return false;
        }
        let goes_on = vehicle.tuning.flight.auto.continues_after_landing
            && sequence::takes_off_first(&vehicle.plans.mission, at.saturating_add(1), &self.jumps);
        if !goes_on {
            self.disarm(vehicle);
        }
        goes_on
    }
}

fn distance_to_goal_m(vehicle: &Vehicle) -> f64 {
    let here_m = vehicle.believed().position_m;
    let goal_m = match &vehicle.flight.task {
        Task::Route(route) => route.goal_m(),
        Task::Takeoff(takeoff) => takeoff.goal_m,
        Task::Goto { goal_m, .. } => *goal_m,
        Task::Return(_) => vehicle.datum.home_point(),
        Task::Drive(drive) => drive.goal_m().unwrap_or(here_m),
        Task::Wait
        | Task::Velocity { .. }
        | Task::Accelerate { .. }
        | Task::Attitude(_)
        | Task::Brake
        | Task::Land(_)
        | Task::Circle(_)
        | Task::Orbit(_)
        | Task::Piloted
        | Task::Manual => here_m,
    };
    (goal_m - here_m).truncate().length()
}
