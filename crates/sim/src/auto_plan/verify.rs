//! Whether the commands of a mission are over.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Wait, command, sequence};
use crate::autopilot::Autopilot;
use crate::cmd;
use crate::kinematics::square_root;
use crate::plan::Item;
use crate::task::{Landing, Task};

/// How fast the last bit of a height is approached: fitted to 4 m in 3.8 s.
const HEIGHT_GAIN_PER_S: f64 = 1.5;
/// A height is reached within this distance.
const HEIGHT_REACHED_M: f64 = 0.05;

impl Autopilot {
    /// Whether the navigation command is over; that it is goes into the slot of reached items.
    pub(super) fn navigation_is_over(&mut self, at: u16) -> bool {
        let item = self.mission.nav_item;
        let over = match item.command {
            cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF => {
                matches!(&self.task, Task::Takeoff(takeoff) if takeoff.reached)
            }
            cmd::NAV_WAYPOINT | cmd::NAV_SPLINE_WAYPOINT | cmd::NAV_LOITER_TIME => {
                self.has_stayed(at, &item)
            }
            cmd::NAV_LAND | cmd::NAV_VTOL_LAND => self.has_landed(at),
            cmd::NAV_LOITER_TURNS => self.has_turned(&item),
            cmd::NAV_LOITER_TO_ALT => return self.has_height(),
            cmd::NAV_RETURN_TO_LAUNCH => self.landing_is_over(),
            cmd::NAV_GUIDED_ENABLE => item.p[0] as u16 == 0,
            cmd::NAV_DELAY => {
                matches!(self.mission.wait, Wait::Until(until) if self.uptime() >= until)
            }
            _ => false,
        };
        if over {
            self.mission.reached = Some(at);
        }
        over
    }

    /// Whether the action or condition is over.
    pub(super) fn action_is_over(&mut self, at: u16) -> bool {
        let Some(item) = self.item(at) else {
            return true;
        };
        if command::is_quiet(item.command) {
            return true;
        }
        let over = match item.command {
            cmd::CONDITION_DELAY => {
                let seconds = f64::from(item.p[0]).clamp(0.0, 1e6);
                self.uptime() > self.mission.action.since + Duration::from_secs_f64(seconds)
            }
            cmd::CONDITION_DISTANCE => self.distance_to_goal_m() < f64::from(item.p[0]).max(0.0),
            cmd::CONDITION_YAW => self.yaw.has_turned(self.body.yaw_deg),
            known if command::acts_at_once(known) => true,
            unknown => {
                self.say(
                    MavSeverity::MAV_SEVERITY_WARNING,
                    &format!("Skipping invalid cmd #{unknown}"),
                );
                true
            }
        };
        if over {
            self.mission.reached = Some(at);
        }
        over
    }

    fn has_stayed(&mut self, at: u16, item: &Item) -> bool {
        if !matches!(&self.task, Task::Route(route) if route.reached) {
            return false;
        }
        let now = self.uptime();
        let Wait::Stay(since) = &mut self.mission.wait else {
            return false;
        };
        let since = *since.get_or_insert(now);
        let over = now.saturating_sub(since).as_secs() >= u64::from(item.p[0] as u16);
        if over {
            let text = format!("Reached command #{at}");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        over
    }

    fn has_turned(&mut self, item: &Item) -> bool {
        if matches!(&self.task, Task::Route(route) if route.reached)
            && let Wait::Edge(orbit) = std::mem::take(&mut self.mission.wait)
        {
            self.begin_turning(orbit);
            return false;
        }
        matches!(&self.task, Task::Orbit(orbit) if orbit.turns() >= f64::from(item.p[0]))
    }

    /// First over the place, then at the height, which may be passed as well as met.
    fn has_height(&mut self) -> bool {
        let Wait::Height { down_m, left_m } = self.mission.wait.clone() else {
            return false;
        };
        let here_m = self.believed().position_m;
        let there = self.with_cockpit(|task, cockpit| match task {
            Task::Route(route) if !route.is_over_goal(cockpit) => false,
            _ => {
                let limits = &cockpit.limits;
                let climb = square_root(down_m - here_m.z, HEIGHT_GAIN_PER_S, limits.accel_z_m_s2);
                *task = Task::Velocity {
                    wanted_m_s: DVec3::Z * climb.clamp(-limits.speed_up_m_s, limits.speed_down_m_s),
                    // Renewed with every step.
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
        self.mission.wait = Wait::Height {
            down_m,
            left_m: Some(left),
        };
        left.abs() < HEIGHT_REACHED_M || passed
    }

    /// After a landing the vehicle disarms and the mission begins anew, unless it is to go on with a takeoff.
    fn has_landed(&mut self, at: u16) -> bool {
        if self.mission.wait == Wait::LandingPlace {
            if matches!(&self.task, Task::Route(route) if route.reached) {
                self.task = Task::Land(Landing::default());
                self.mission.wait = Wait::Nothing;
                self.yaw.settle(self.body.yaw_deg);
            }
            return false;
        }
        if !self.landing_is_over() {
            return false;
        }
        let goes_on = self.tuning.flight.auto.continues_after_landing
            && sequence::takes_off_first(
                &self.plans.mission,
                at.saturating_add(1),
                &self.mission.jumps,
            );
        if !goes_on {
            self.disarm();
        }
        goes_on
    }

    fn distance_to_goal_m(&self) -> f64 {
        let here_m = self.believed().position_m;
        let goal_m = match &self.task {
            Task::Route(route) => route.goal_m(),
            Task::Takeoff(takeoff) => takeoff.goal_m,
            Task::Goto { goal_m, .. } => *goal_m,
            Task::Return(_) => self.datum.home_point(),
            _ => here_m,
        };
        (goal_m - here_m).truncate().length()
    }
}
