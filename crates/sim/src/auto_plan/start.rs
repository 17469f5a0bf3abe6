//! Starting the commands of a mission.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Wait, command, sequence};
use crate::autopilot::Autopilot;
use crate::cmd;
use crate::place::Place;
use crate::plan::Item;
use crate::task::{Landing, Orbit, Returning, Route, Takeoff, Task};
use crate::yaw::YawDemand;
use sortie_geo::LatLon;
/// A takeoff from the ground goes at least this far up.
const LEAST_CLIMB_M: f64 = 1.0;
/// A circle begins at once within this distance of its edge.
const AT_EDGE_M: f64 = 3.0;
/// Radii of this size and more are stored in steps of 10 m.
const COARSE_RADIUS_M: f64 = 255.0;

impl Autopilot {
    /// Starts a navigation command; `false` for one the vehicle cannot fly, so that the next one is tried.
    pub(super) fn start_navigation(&mut self, at: u16) -> bool {
        let Some(item) = self.announce_item(at) else {
            return false;
        };
        self.mission.nav_item = item;
        match item.command {
            cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF => self.begin_takeoff(&item),
            cmd::NAV_WAYPOINT | cmd::NAV_SPLINE_WAYPOINT => self.begin_waypoint(at, &item),
            cmd::NAV_LAND | cmd::NAV_VTOL_LAND => self.begin_landing(&item),
            cmd::NAV_LOITER_UNLIM => self.begin_loiter(&item, Wait::Nothing),
            cmd::NAV_LOITER_TIME => self.begin_loiter(&item, Wait::Stay(None)),
            cmd::NAV_LOITER_TURNS => self.begin_circle(&item),
            cmd::NAV_LOITER_TO_ALT => {
                let wait = Wait::Height {
                    down_m: self.item_down_m(&item),
                    left_m: None,
                };
                self.begin_loiter(&item, wait);
            }
            cmd::NAV_RETURN_TO_LAUNCH => {
                let returning = self.with_cockpit(|_, cockpit| Returning::new(cockpit));
                self.fly_task(Task::Return(returning), Wait::Nothing);
                self.yaw.demand = self.default_yaw_home();
            }
            cmd::NAV_GUIDED_ENABLE => {
                if item.p[0] as u16 > 0 {
                    self.fly_task(Task::STOP, Wait::Guided);
                }
            }
            cmd::NAV_DELAY => self.begin_delay(&item),
            _ => return false,
        }
        true
    }

    /// Starts an action or a condition.
    pub(super) fn start_action(&mut self, at: u16) {
        let Some(item) = self.announce_item(at) else {
            return;
        };
        match item.command {
            cmd::CONDITION_YAW => {
                let [angle, rate, direction, relative] = item.p.map(f64::from);
                if !(angle.is_finite() && rate.is_finite()) {
                    return;
                }
                self.mission.looks_at_place = false;
                if relative > 0.0 {
                    let signed = if direction < 0.0 { -angle } else { angle };
                    self.yaw.turn_by(signed, rate);
                } else {
                    self.yaw.turn_to(angle, rate, direction);
                }
            }
            cmd::DO_CHANGE_SPEED => self.change_mission_speed(&item),
            cmd::DO_SET_HOME => self.set_mission_home(&item),
            cmd::DO_SET_SERVO => {
                let channel = item.p[0] as usize;
                if (5..=16).contains(&channel)
                    && let Some(servo) = self.servos_us.get_mut(channel - 1)
                {
                    *servo = item.p[1] as u16;
                }
            }
            cmd::DO_SET_ROI => self.look_at_item(&item),
            _ => {}
        }
    }

    /// A takeoff that waits lifts once the motors run and the throttle is up.
    pub(super) fn lift_if_allowed(&mut self) {
        let throttle_up = !self.sticks().throttle_is_low();
        self.mission.may_lift |= throttle_up || self.tuning.flight.auto.lifts_unasked;
        if let Wait::Throttle(height_m) = self.mission.wait
            && self.mission.may_lift
        {
            let begins = self.safety.takeoff_begins(self.uptime());
            let takeoff = Takeoff::new(self.believed().position_m, height_m, begins);
            self.fly_task(Task::Takeoff(takeoff), Wait::Nothing);
        }
    }

    /// Flies a route on from where the vehicle is, or from the end of the one it flies.
    pub(super) fn fly_to(&mut self, goal_m: DVec3, wait: Wait) {
        self.with_cockpit(|task, cockpit| {
            if !matches!(task, Task::Route(_)) {
                *task = Task::Route(Box::new(Route::standing(cockpit)));
            }
            if let Task::Route(route) = task {
                route.go_to(goal_m, cockpit);
            }
        });
        self.mission.wait = wait;
        self.mission.paused = false;
        if !self.mission.looks_at_place {
            self.yaw.demand = self.default_yaw();
        }
    }

    /// Says which command begins.
    fn announce_item(&mut self, at: u16) -> Option<Item> {
        let item = self.item(at)?;
        let name = command::name(item.command);
        let text = if item.command == cmd::JUMP_TAG {
            // The vehicle prints a field that tags do not use.
            format!("Mission: {at} {name} 0")
        } else {
            format!("Mission: {at} {name}")
        };
        self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        Some(item)
    }

    fn fly_task(&mut self, task: Task, wait: Wait) {
        self.task = task;
        self.mission.wait = wait;
        self.mission.looks_at_place = false;
        self.yaw.settle(self.body.yaw_deg);
    }

    fn begin_takeoff(&mut self, item: &Item) {
        self.mission.returns = false;
        let landed = self.safety.landed;
        let here_m = self.believed().height_m();
        let least_m = here_m + if landed { LEAST_CLIMB_M } else { 0.0 };
        let height_m = (-self.item_down_m(item)).max(least_m);
        if landed {
            self.fly_task(Task::Wait, Wait::Throttle(height_m));
        } else {
            let takeoff = Takeoff::in_flight(self.believed().position_m, height_m, self.uptime());
            self.fly_task(Task::Takeoff(takeoff), Wait::Nothing);
        }
    }

    fn begin_waypoint(&mut self, at: u16, item: &Item) {
        let goal_m = self.item_point(item, self.reference_point());
        self.fly_to(goal_m, Wait::Stay(None));
        let stays = item.p[0] as u16 > 0;
        let items = &self.plans.mission;
        let next = sequence::next_navigation(items, at.saturating_add(1), &self.mission.jumps)
            .and_then(|next| self.item(next))
            .filter(|next| {
                matches!(
                    next.command,
                    cmd::NAV_WAYPOINT
                        | cmd::NAV_SPLINE_WAYPOINT
                        | cmd::NAV_LOITER_UNLIM
                        | cmd::NAV_LOITER_TIME
                )
            });
        if let Some(next) = next.filter(|_| !stays) {
            let further_m = self.item_point(&next, goal_m);
            self.with_cockpit(|task, cockpit| {
                if let Task::Route(route) = task {
                    route.then_to(further_m, cockpit);
                }
            });
        }
    }

    /// To the place of the item, at the present height, and down; or down at once.
    fn begin_landing(&mut self, item: &Item) {
        match self.item_place(item) {
            Some(flat) => {
                let goal_m = flat.extend(self.believed().position_m.z);
                self.fly_to(goal_m, Wait::LandingPlace);
            }
            None => self.fly_task(Task::Land(Landing::default()), Wait::Nothing),
        }
    }

    fn begin_loiter(&mut self, item: &Item, wait: Wait) {
        let mut otherwise = self.believed().position_m;
        if self.item_place(item).is_none() {
            let stop_m = self.with_cockpit(|_, cockpit| crate::task::stopping_point(cockpit));
            otherwise = self.stored(stop_m.truncate().extend(otherwise.z));
        }
        self.fly_to(self.item_point(item, otherwise), wait);
    }

    /// A point as the vehicle stores places: in 1e-7 degrees and centimetres. That is why even a stay on the spot
    /// begins with a way, of a few millimetres and about a second.
    fn stored(&self, point_m: DVec3) -> DVec3 {
        let place = self.datum.place_of(point_m);
        let (lat, lon) = place.at.to_e7();
        self.datum.point_of(Place {
            at: LatLon::from_e7(lat, lon),
            altitude_amsl_m: (place.altitude_amsl_m * 100.0).trunc() / 100.0,
        })
    }

    fn begin_circle(&mut self, item: &Item) {
        let centre_m = self.item_point(item, self.believed().position_m);
        let asked_m = f64::from(item.p[2]).abs().min(2550.0);
        let radius_m = if asked_m > COARSE_RADIUS_M {
            (asked_m / 10.0).floor() * 10.0
        } else {
            asked_m.floor()
        };
        let orbit = Orbit::around(centre_m, radius_m, item.p[2] < 0.0, &self.parameters);
        let here_m = self.believed().position_m;
        let edge_m = orbit.nearest_m(here_m);
        if edge_m.distance(here_m) <= AT_EDGE_M {
            self.begin_turning(orbit);
            return;
        }
        let outside = orbit.is_outside(here_m);
        self.fly_to(edge_m, Wait::Edge(orbit));
        if !outside && !self.mission.looks_at_place {
            self.yaw.settle(self.body.yaw_deg);
        }
    }

    /// The edge is reached: the circle begins.
    pub(super) fn begin_turning(&mut self, mut orbit: Orbit) {
        orbit.begin(self.believed().position_m);
        if !self.mission.looks_at_place {
            self.yaw.demand = orbit.yaw();
        }
        self.task = Task::Orbit(orbit);
        self.mission.wait = Wait::Nothing;
    }

    fn begin_delay(&mut self, item: &Item) {
        let seconds = f64::from(item.p[0]).clamp(0.0, 1e6);
        self.mission.wait = Wait::Until(self.uptime() + Duration::from_secs_f64(seconds));
        let text = format!("Delaying {} sec", seconds as u32);
        self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
    }

    fn change_mission_speed(&mut self, item: &Item) {
        let speed = f64::from(item.p[1]);
        if !(speed > 0.0 && speed.is_finite()) {
            return;
        }
        match item.p[0] as i32 {
            2 => self.speeds.up_m_s = Some(speed),
            3 => self.speeds.down_m_s = Some(speed),
            _ => self.speeds.ground_m_s = Some(speed.max(0.2)),
        }
    }

    fn set_mission_home(&mut self, item: &Item) {
        let unset = item.x == 0 && item.y == 0 && item.z == 0.0;
        if item.p[0] as u16 == 1 || unset {
            self.set_home_here();
            return;
        }
        let at = LatLon::from_e7(item.x, item.y);
        if at.is_valid() {
            self.set_home(Place {
                at,
                altitude_amsl_m: self.datum.start.altitude_amsl_m - self.item_down_m(item),
            });
        }
    }

    fn look_at_item(&mut self, item: &Item) {
        let place = self.item_place(item);
        self.mission.looks_at_place = place.is_some();
        self.yaw.demand = place.map_or_else(|| self.default_yaw(), YawDemand::Towards);
    }
}
