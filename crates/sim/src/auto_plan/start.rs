//! Starting the commands of a mission.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavSeverity, SpeedType};

use super::guided::GuidedLimits;
use super::place::{circle_radius_m, item_down_m, item_place, item_point, reference_point};
use super::{AutoPlan, PlanWait, command, driving, sequence};
use crate::cmd;
use crate::flight_log::EPOCH_US;
use crate::kind::VehicleKind;
use crate::place::Place;
use crate::plan::Item;
use crate::task::{Landing, Orbit, Returning, Route, Takeoff, Task};
use crate::vehicle::Vehicle;
use crate::yaw::YawDemand;
use sortie_geo::LatLon;
/// The minimum climb of a takeoff from the ground, in metres.
const LEAST_CLIMB_M: f64 = 1.0;
/// The distance from its edge within which a circle begins at once, in metres.
const AT_EDGE_M: f64 = 3.0;

impl AutoPlan {
    /// Starts a navigation command; `false` if it cannot be flown and the next one is to be tried.
    pub(super) fn start_navigation(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let Some(item) = announce_item(vehicle, at) else {
            return false;
        };
        self.nav_item = item;
        match vehicle.kind {
            VehicleKind::Copter => self.start_flying(vehicle, at, &item),
            VehicleKind::Rover(_) => self.start_driving(vehicle, at, &item),
        }
    }

    fn start_flying(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item) -> bool {
        match item.command {
            cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF => self.begin_takeoff(vehicle, item),
            cmd::NAV_WAYPOINT | cmd::NAV_SPLINE_WAYPOINT => self.begin_waypoint(vehicle, at, item),
            cmd::NAV_LAND | cmd::NAV_VTOL_LAND => self.begin_landing(vehicle, item),
            cmd::NAV_LOITER_UNLIM => self.begin_loiter(vehicle, item, PlanWait::Nothing),
            cmd::NAV_LOITER_TIME => self.begin_loiter(vehicle, item, PlanWait::Stay(None)),
            cmd::NAV_LOITER_TURNS => self.begin_circle(vehicle, item),
            cmd::NAV_LOITER_TO_ALT => {
                let wait = PlanWait::Height {
                    down_m: item_down_m(vehicle, item),
                    left_m: None,
                };
                self.begin_loiter(vehicle, item, wait);
            }
            cmd::NAV_RETURN_TO_LAUNCH => {
                let returning = vehicle.with_cockpit(|_, cockpit| Returning::new(cockpit));
                self.fly_task(vehicle, Task::Return(returning), PlanWait::Nothing);
                vehicle.flight.yaw.demand = vehicle.default_yaw_home();
            }
            cmd::NAV_GUIDED_ENABLE => {
                if item.params[0] as u16 > 0 {
                    let wait = Self::guided_from_here(vehicle);
                    self.fly_task(vehicle, Task::STOP, wait);
                }
            }
            cmd::NAV_DELAY => self.begin_delay(vehicle, item),
            _ => return false,
        }
        true
    }

    /// Starts an action or a condition.
    pub(super) fn start_action(&mut self, vehicle: &mut Vehicle, at: u16) {
        let Some(item) = announce_item(vehicle, at) else {
            return;
        };
        match item.command {
            cmd::CONDITION_YAW => {
                let [angle, rate, direction, relative] = item.params.map(f64::from);
                if !(angle.is_finite() && rate.is_finite()) {
                    return;
                }
                self.looks_at_place = false;
                if relative > 0.0 {
                    let signed = if direction < 0.0 { -angle } else { angle };
                    vehicle.flight.yaw.turn_by(signed, rate);
                } else {
                    vehicle.flight.yaw.turn_to(angle, rate, direction);
                }
            }
            cmd::DO_CHANGE_SPEED if vehicle.kind.chassis().is_some() => {
                driving::change_speed(vehicle, &item);
            }
            cmd::DO_CHANGE_SPEED => change_mission_speed(vehicle, &item),
            cmd::DO_SET_REVERSE if vehicle.kind.chassis().is_some() => {
                vehicle.flight.backs_up = item.params[0] as u16 == 1;
            }
            cmd::DO_GUIDED_LIMITS => self.guided_limits = GuidedLimits::of(&item),
            cmd::DO_FENCE_ENABLE => switch_fence(vehicle, &item),
            cmd::DO_SET_HOME => set_mission_home(vehicle, &item),
            cmd::DO_SET_SERVO => {
                let channel = item.params[0] as usize;
                if (5..=16).contains(&channel)
                    && let Some(servo) = vehicle.servos_us.get_mut(channel - 1)
                {
                    *servo = item.params[1] as u16;
                }
            }
            cmd::DO_SET_ROI => self.look_at_item(vehicle, &item),
            _ => {}
        }
    }

    /// Starts a waiting takeoff once the motors run and the throttle is up.
    pub(super) fn lift_if_allowed(&mut self, vehicle: &mut Vehicle) {
        let throttle_up = !vehicle.sticks().throttle_is_low();
        self.may_lift |= throttle_up || vehicle.tuning.flight.auto.lifts_unasked;
        if let PlanWait::Throttle(height_m) = self.wait
            && self.may_lift
        {
            let begins = vehicle.safety.takeoff_begins(vehicle.uptime());
            let takeoff = Takeoff::new(vehicle.believed().position_m, height_m, begins);
            self.fly_task(vehicle, Task::Takeoff(takeoff), PlanWait::Nothing);
        }
    }

    /// Extends the route from the vehicle's position, or from the end of the current route.
    pub(super) fn fly_to(&mut self, vehicle: &mut Vehicle, goal_m: DVec3, wait: PlanWait) {
        vehicle.with_cockpit(|task, cockpit| {
            if !matches!(task, Task::Route(_)) {
                *task = Task::Route(Box::new(Route::standing(cockpit)));
            }
            if let Task::Route(route) = task {
                route.go_to(goal_m, cockpit);
            }
        });
        self.wait = wait;
        self.paused = false;
        if !self.looks_at_place {
            vehicle.flight.yaw.demand = vehicle.default_yaw();
        }
    }

    fn fly_task(&mut self, vehicle: &mut Vehicle, task: Task, wait: PlanWait) {
        vehicle.flight.task = task;
        self.wait = wait;
        self.looks_at_place = false;
        vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
    }

    fn begin_takeoff(&mut self, vehicle: &mut Vehicle, item: &Item) {
        self.returns = false;
        let landed = vehicle.safety.landed;
        let here_m = vehicle.believed().height_m();
        let least_m = here_m + if landed { LEAST_CLIMB_M } else { 0.0 };
        let height_m = (-item_down_m(vehicle, item)).max(least_m);
        if landed {
            self.fly_task(vehicle, Task::Wait, PlanWait::Throttle(height_m));
        } else {
            let takeoff =
                Takeoff::in_flight(vehicle.believed().position_m, height_m, vehicle.uptime());
            self.fly_task(vehicle, Task::Takeoff(takeoff), PlanWait::Nothing);
        }
    }

    fn begin_waypoint(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item) {
        let goal_m = item_point(vehicle, item, reference_point(vehicle));
        self.fly_to(vehicle, goal_m, PlanWait::Stay(None));
        let stays = item.params[0] as u16 > 0;
        let items = &vehicle.plans.mission;
        let next = sequence::next_navigation(items, at.saturating_add(1), &self.jumps)
            .and_then(|next| vehicle.plans.item(next))
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
            let further_m = item_point(vehicle, &next, goal_m);
            vehicle.with_cockpit(|task, cockpit| {
                if let Task::Route(route) = task {
                    route.then_to(further_m, cockpit);
                }
            });
        }
    }

    /// Flies to the item's place at the current height and lands; without a place, lands at once.
    fn begin_landing(&mut self, vehicle: &mut Vehicle, item: &Item) {
        match item_place(vehicle, item) {
            Some(flat) => {
                let goal_m = flat.extend(vehicle.believed().position_m.z);
                self.fly_to(vehicle, goal_m, PlanWait::LandingPlace);
            }
            None => self.fly_task(vehicle, Task::Land(Landing::default()), PlanWait::Nothing),
        }
    }

    fn begin_loiter(&mut self, vehicle: &mut Vehicle, item: &Item, wait: PlanWait) {
        let mut otherwise = vehicle.believed().position_m;
        if item_place(vehicle, item).is_none() {
            let stop_m = vehicle.with_cockpit(|_, cockpit| crate::task::stopping_point(cockpit));
            otherwise = stored(vehicle, stop_m.truncate().extend(otherwise.z));
        }
        self.fly_to(vehicle, item_point(vehicle, item, otherwise), wait);
    }

    fn begin_circle(&mut self, vehicle: &mut Vehicle, item: &Item) {
        let centre_m = item_point(vehicle, item, vehicle.believed().position_m);
        let orbit = Orbit::around(
            centre_m,
            circle_radius_m(item),
            item.params[2] < 0.0,
            &vehicle.parameters,
        );
        let here_m = vehicle.believed().position_m;
        let edge_m = orbit.nearest_m(here_m);
        if edge_m.distance(here_m) <= AT_EDGE_M {
            self.begin_turning(vehicle, orbit);
            return;
        }
        let outside = orbit.is_outside(here_m);
        self.fly_to(vehicle, edge_m, PlanWait::Edge(orbit));
        if !outside && !self.looks_at_place {
            vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
        }
    }

    /// Begins the circle at its edge.
    pub(super) fn begin_turning(&mut self, vehicle: &mut Vehicle, mut orbit: Orbit) {
        orbit.begin(vehicle.believed().position_m);
        if !self.looks_at_place {
            vehicle.flight.yaw.demand = orbit.yaw();
        }
        vehicle.flight.task = Task::Orbit(orbit);
        self.wait = PlanWait::Nothing;
    }

    pub(super) fn begin_delay(&mut self, vehicle: &mut Vehicle, item: &Item) {
        let seconds = if item.params[0] > 0.0 {
            f64::from(item.params[0]).min(1e6)
        } else {
            until_time_of_day_s(item, vehicle.uptime())
        };
        self.wait = PlanWait::Until(vehicle.uptime() + Duration::from_secs_f64(seconds));
        let text = format!("Delaying {} sec", seconds as u32);
        vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
    }

    fn look_at_item(&mut self, vehicle: &mut Vehicle, item: &Item) {
        let place = item_place(vehicle, item);
        self.looks_at_place = place.is_some();
        vehicle.flight.yaw.demand = place.map_or_else(|| vehicle.default_yaw(), YawDemand::Towards);
    }
}

/// The seconds from now until the time of day (UTC) of a `NAV_DELAY`: hour, minute and second.
/// Leading fields may be -1, which matches any value; 0 if all fields are -1.
pub(super) fn until_time_of_day_s(item: &Item, uptime: Duration) -> f64 {
    let now_s = (EPOCH_US as f64 / 1e6 + uptime.as_secs_f64()) % 86_400.0;
    let units_s = [3600.0, 60.0, 1.0];
    let Some(first) = item.params[1..].iter().position(|unit| *unit as i32 != -1) else {
        return 0.0;
    };
    let wanted_s: f64 = (first..3)
        .map(|place| f64::from(item.params[place + 1] as i32) * units_s[place])
        .sum();
    // The time repeats with the period of the unit above the first one given.
    let round_s = [86_400.0, 3600.0, 60.0][first];
    let left_s = wanted_s - now_s % round_s;
    let rounds_s = if left_s < 0.0 { round_s } else { 0.0 };
    (left_s + rounds_s).max(0.0)
}

/// A point as the vehicle stores places: in 1e-7 degrees and centimetres. Therefore even a wait in place begins with a
/// leg of a few millimetres that takes about a second.
fn stored(vehicle: &Vehicle, point_m: DVec3) -> DVec3 {
    let place = vehicle.datum.place_of(point_m);
    let (lat, lon) = place.at.to_e7();
    vehicle.datum.point_of(Place {
        at: LatLon::from_e7(lat, lon),
        altitude_amsl_m: (place.altitude_amsl_m * 100.0).trunc() / 100.0,
    })
}

/// Reports the command that begins, and returns its item.
fn announce_item(vehicle: &mut Vehicle, at: u16) -> Option<Item> {
    let item = vehicle.plans.item(at)?;
    let name = command::name(item.command);
    let text = if item.command == cmd::JUMP_TAG {
        // The real vehicle also prints a field that tags do not use.
        format!("Mission: {at} {name} 0")
    } else {
        format!("Mission: {at} {name}")
    };
    vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
    Some(item)
}

/// The speed types of `DO_CHANGE_SPEED` other than ground speed.
const CLIMB: i32 = SpeedType::SPEED_TYPE_CLIMB_SPEED as i32;
const DESCENT: i32 = SpeedType::SPEED_TYPE_DESCENT_SPEED as i32;

fn change_mission_speed(vehicle: &mut Vehicle, item: &Item) {
    let speed = f64::from(item.params[1]);
    if !(speed > 0.0 && speed.is_finite()) {
        return;
    }
    match item.params[0] as i32 {
        CLIMB => vehicle.flight.speeds.up_m_s = Some(speed),
        DESCENT => vehicle.flight.speeds.down_m_s = Some(speed),
        _ => vehicle.flight.speeds.ground_m_s = Some(speed.max(0.2)),
    }
}

fn switch_fence(vehicle: &mut Vehicle, item: &Item) {
    let on = item.params[0] as u16 != 0;
    vehicle.enable_fence(on);
    let text = if on {
        "Fence Enabled"
    } else {
        "Fence Disabled"
    };
    vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
}

fn set_mission_home(vehicle: &mut Vehicle, item: &Item) {
    let unset = item.x == 0 && item.y == 0 && item.z == 0.0;
    if item.params[0] as u16 == 1 || unset {
        vehicle.set_home_here();
        return;
    }
    let at = LatLon::from_e7(item.x, item.y);
    if at.is_valid() {
        vehicle.set_home(Place {
            at,
            altitude_amsl_m: vehicle.datum.start.altitude_amsl_m - item_down_m(vehicle, item),
        });
    }
}
