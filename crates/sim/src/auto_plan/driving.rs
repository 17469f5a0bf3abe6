//! The mission of a rover (`ArduRover`'s `mode_auto`): navigation commands that drive or wait, and their ends.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::place::{circle_radius_m, item_place, item_point, reference_point};
use super::{AutoPlan, PlanWait, sequence};
use crate::cmd;
use crate::helm::bearing_deg;
use crate::mode::ModeId;
use crate::plan::Item;
use crate::task::{CirclePlace, Drive, DriveCircle, DriveHeading, Loiter, Task, on_surface};
use crate::vehicle::Vehicle;
use glam::DVec2;
use sortie_geo::wrap_180;

/// The values of `MIS_DONE_BEHAVE`; with any other one, the vehicle stops.
const DONE_LOITER: i32 = 1;
const DONE_ACRO: i32 = 2;
const DONE_MANUAL: i32 = 3;

impl AutoPlan {
    /// Starts a navigation command of a rover; `false` if it cannot be driven.
    pub(super) fn start_driving(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item) -> bool {
        match item.command {
            cmd::NAV_WAYPOINT => self.drive_to_waypoint(vehicle, at, item, item.params[0] > 0.0),
            cmd::NAV_LOITER_UNLIM | cmd::NAV_LOITER_TIME => {
                self.drive_to_waypoint(vehicle, at, item, true);
            }
            cmd::NAV_LOITER_TURNS => self.drive_circle(vehicle, item),
            cmd::NAV_SET_YAW_SPEED => self.drive_heading(vehicle, item),
            cmd::NAV_RETURN_TO_LAUNCH => {
                self.begin_drive(vehicle, PlanWait::Nothing, |cockpit, rules| {
                    Drive::home(cockpit, rules)
                });
            }
            cmd::NAV_GUIDED_ENABLE => {
                if item.params[0] as u16 > 0 {
                    let wait = Self::guided_from_here(vehicle);
                    self.begin_drive(vehicle, wait, |cockpit, rules| Drive::rest(cockpit, rules));
                }
            }
            cmd::NAV_DELAY => {
                self.begin_drive(vehicle, PlanWait::Nothing, |cockpit, rules| {
                    Drive::rest(cockpit, rules)
                });
                self.begin_delay(vehicle, item);
            }
            _ => return false,
        }
        true
    }

    /// Whether the navigation command of a rover is over.
    pub(super) fn drive_is_over(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let item = self.nav_item;
        match item.command {
            cmd::NAV_WAYPOINT => self.has_waited(vehicle, at, &item),
            cmd::NAV_LOITER_UNLIM => {
                self.has_waited(vehicle, at, &item);
                false
            }
            cmd::NAV_LOITER_TIME => {
                let over = self.has_waited(vehicle, at, &item);
                if over {
                    let text = "Finished active loiter";
                    vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, text);
                }
                over
            }
            cmd::NAV_RETURN_TO_LAUNCH => match &vehicle.flight.task {
                Task::Drive(Drive::Return(home)) => home.route.reached,
                _ => true,
            },
            cmd::NAV_LOITER_TURNS => match &vehicle.flight.task {
                Task::Drive(Drive::Circle(circle)) => circle.turns() >= f64::from(item.params[0]),
                _ => true,
            },
            cmd::NAV_SET_YAW_SPEED => match &vehicle.flight.task {
                Task::Drive(Drive::Heading(heading)) => heading.is_reached(),
                _ => true,
            },
            cmd::NAV_GUIDED_ENABLE => self.guiding_is_over(vehicle, &item),
            cmd::NAV_DELAY => {
                matches!(self.wait, PlanWait::Until(until) if vehicle.uptime() > until)
            }
            _ => {
                let text = format!("Skipping invalid cmd #{}", item.command);
                vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
                true
            }
        }
    }

    /// The end of the mission: the vehicle stops, holds its place or changes its mode (`MIS_DONE_BEHAVE`).
    pub(super) fn park(&mut self, vehicle: &mut Vehicle) {
        vehicle.say(MavSeverity::MAV_SEVERITY_NOTICE, "Mission Complete");
        let behaviour = vehicle.parameters.value("MIS_DONE_BEHAVE") as i32;
        self.begin_drive(vehicle, PlanWait::Nothing, |cockpit, rules| {
            if behaviour == DONE_LOITER {
                Drive::Loiter(Loiter::here(cockpit, rules))
            } else {
                Drive::Stop
            }
        });
        self.ends_in = match behaviour {
            DONE_ACRO => Some(ModeId::Acro),
            DONE_MANUAL => Some(ModeId::Manual),
            _ => None,
        };
    }

    fn drive_circle(&mut self, vehicle: &mut Vehicle, item: &Item) {
        let centre_m = item_point(vehicle, item, vehicle.believed().position_m);
        let place = CirclePlace {
            centre_m: centre_m.truncate(),
            radius_m: circle_radius_m(item),
            is_counterclockwise: item.params[2] < 0.0,
        };
        vehicle.warn_of_the_circle();
        let helm = vehicle.tuning.flight.helm.as_deref();
        let narrow = helm.and_then(|helm| helm.circle.radius_warning(place.radius_m));
        if let Some(text) = narrow {
            vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        }
        self.begin_drive(vehicle, PlanWait::Nothing, |cockpit, rules| {
            Drive::Circle(DriveCircle::around(place, cockpit, &rules.circle))
        });
    }

    fn drive_heading(&mut self, vehicle: &mut Vehicle, item: &Item) {
        let [angle_deg, speed_m_s, relative, _] = item.params.map(f64::from);
        self.begin_drive(vehicle, PlanWait::Nothing, |cockpit, rules| {
            Drive::Heading(if relative > 0.0 {
                DriveHeading::relative(cockpit.body.yaw_deg, angle_deg, speed_m_s, rules)
            } else {
                DriveHeading::new(angle_deg, speed_m_s, rules)
            })
        });
    }

    fn begin_drive(
        &mut self,
        vehicle: &mut Vehicle,
        wait: PlanWait,
        begin: impl FnOnce(&mut crate::task::Cockpit<'_>, &crate::helm::HelmRules) -> Drive,
    ) {
        let drive = vehicle.with_cockpit(|_, cockpit| {
            let rules = cockpit.tuning.helm.as_deref()?;
            Some(begin(cockpit, rules))
        });
        if let Some(drive) = drive {
            vehicle.flight.task = Task::Drive(drive);
        }
        self.wait = wait;
        self.paused = false;
    }

    fn drive_to_waypoint(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item, stops: bool) {
        let from_m = match &vehicle.flight.task {
            Task::Route(route) => route.goal_m().truncate(),
            _ => vehicle.believed().position_m.truncate(),
        };
        let goal_m = on_surface(item_point(vehicle, item, reference_point(vehicle)));
        self.fly_to(vehicle, goal_m, PlanWait::Stay(None));
        let items = &vehicle.plans.mission;
        let next = sequence::next_navigation(items, at.saturating_add(1), &self.jumps)
            .and_then(|next| vehicle.plans.item(next))
            .filter(|_| !stops);
        let Some(next) = next else {
            return;
        };
        let further_m = item_place(vehicle, &next).unwrap_or(goal_m.truncate());
        if pivots(vehicle, [from_m, goal_m.truncate(), further_m]) {
            return;
        }
        vehicle.with_cockpit(|task, cockpit| {
            if let Task::Route(route) = task {
                route.then_to(further_m.extend(goal_m.z), cockpit);
            }
        });
    }

    fn has_waited(&mut self, vehicle: &mut Vehicle, at: u16, item: &Item) -> bool {
        let is_there = match &vehicle.flight.task {
            Task::Route(route) => route.reached,
            // A boat holds the place where it arrived.
            Task::Drive(Drive::Loiter(_)) => true,
            _ => false,
        };
        if !is_there {
            return false;
        }
        let now = vehicle.uptime();
        let PlanWait::Stay(since) = &mut self.wait else {
            return false;
        };
        let stays = Duration::from_secs(item.params[0].clamp(0.0, 32767.0) as u64);
        if since.is_none() {
            *since = Some(now);
            let text = if stays.is_zero() {
                format!("Reached waypoint #{at}")
            } else {
                format!(
                    "Reached waypoint #{at}. Loiter for {} seconds",
                    stays.as_secs()
                )
            };
            vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        let since = since.unwrap_or(now);
        now.saturating_sub(since).as_secs() >= stays.as_secs()
    }
}

/// Sets the speed of what the mission does now, and reports it.
pub(super) fn change_speed(vehicle: &mut Vehicle, item: &Item) {
    let speed_m_s = f64::from(item.params[1]);
    if vehicle.set_drive_speed(speed_m_s) {
        let text = format!("speed: {speed_m_s:.1} m/s");
        vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
    }
}

/// Whether the vehicle turns on the spot at the corner of three points.
fn pivots(vehicle: &Vehicle, [from, corner, to]: [DVec2; 3]) -> bool {
    let rules = vehicle.tuning.flight.helm.as_deref();
    let turn_deg = wrap_180(bearing_deg(corner, to) - bearing_deg(from, corner)).abs();
    rules
        .and_then(|rules| rules.pivot_from_deg)
        .is_some_and(|from_deg| turn_deg > from_deg)
}
