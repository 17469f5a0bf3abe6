//! Functions of switches with which a pilot changes the mission, the meaning of the sticks and the sensors.

use mavlink::dialects::ardupilotmega::MavSeverity::{
    self, MAV_SEVERITY_ALERT, MAV_SEVERITY_INFO, MAV_SEVERITY_NOTICE, MAV_SEVERITY_WARNING,
};

use super::{
    ACRO_TRAINER, CLEAR_MISSION, EKF_SOURCES, FENCE, GPS_OFF, MISSION_RESET, OVERRIDES, PARACHUTE,
    PARACHUTE_ENABLE, PARACHUTE_RELEASE, SAVE_TRIM, SIMPLE, SIMPLE_HEADING, STANDBY, SUPER_SIMPLE,
};
use crate::autopilot::Autopilot;
use crate::cmd;
use crate::mode::ModeId;
use crate::plan::{Item, ListKind, frame};
use crate::radio::SimpleMode;
use crate::radio::SwitchPosition::{self, High, Low, Middle};
use crate::task::{LineEnd, Route, Task};

/// The minimum height of a saved takeoff, in metres.
const TAKEOFF_MIN_M: f32 = 1.0;

impl Autopilot {
    fn inform(&mut self, severity: MavSeverity, text: &str) {
        self.vehicle.say(severity, text);
    }

    /// Switches a relay on in the high position, otherwise off.
    pub(super) fn switch_relay(&mut self, bit: u16, position: SwitchPosition) {
        let all = &self.vehicle.parameters;
        self.workbench.switch_relay(all, bit, position == High);
    }

    /// Switches the fence, overrides by ground stations, or the GPS.
    pub(super) fn switch_equipment(&mut self, function: u16, position: SwitchPosition) {
        let is_high = position == High;
        match function {
            FENCE => {
                self.vehicle.enable_fence(is_high);
            }
            GPS_OFF => {
                self.vehicle.flight.gps_off = is_high;
                self.vehicle.retune();
            }
            OVERRIDES if position != Middle => self.vehicle.radio.allow_overrides(is_high),
            _ => {}
        }
    }

    /// In the high position, restarts the mission, empties it, or adds the place of the vehicle.
    pub(super) fn edit_mission(&mut self, function: u16, position: SwitchPosition) {
        match function {
            _ if position != High => {}
            MISSION_RESET => self.auto_plan.reset(),
            CLEAR_MISSION => self.clear_mission(),
            _ => self.save_waypoint(),
        }
    }

    /// Empties the mission, except while it is being flown.
    fn clear_mission(&mut self) {
        let vehicle = &mut self.vehicle;
        if vehicle.safety.armed && vehicle.flight.mode.id == ModeId::Auto {
            return;
        }
        vehicle.plans.mission.clear();
        self.mission_edited();
    }

    /// Adds the place of the vehicle to the mission, if it is armed and not in AUTO: a landing if
    /// the throttle is down, otherwise a waypoint. An empty mission begins with a takeoff; with the
    /// throttle down, nothing is added to it.
    fn save_waypoint(&mut self) {
        let vehicle = &mut self.vehicle;
        let low = vehicle.sticks().throttle_is_low();
        let is_empty = vehicle.plans.mission.is_empty();
        let refuses = !vehicle.safety.armed || vehicle.flight.mode.id == ModeId::Auto;
        if refuses || (is_empty && low) {
            return;
        }
        let here = vehicle.here();
        let (x, y) = here.at.to_e7();
        let above_home_m = vehicle.datum.home_point().z - vehicle.believed().position_m.z;
        let height_m = (above_home_m * 100.0).round() as f32 * 0.01;
        if is_empty {
            // The height of the takeoff is stored without its reference.
            vehicle.plans.mission.push(Item {
                command: cmd::NAV_TAKEOFF,
                frame: frame::SEA_LEVEL,
                z: height_m.max(TAKEOFF_MIN_M),
                auto_continue: true,
                ..Item::default()
            });
        }
        vehicle.plans.mission.push(Item {
            command: if low {
                cmd::NAV_LAND
            } else {
                cmd::NAV_WAYPOINT
            },
            frame: frame::ABOVE_HOME,
            auto_continue: true,
            x,
            y,
            z: height_m,
            ..Item::default()
        });
        self.mission_edited();
    }

    fn mission_edited(&mut self) {
        let items = self.vehicle.plans.mission.len() as f32;
        self.vehicle.store_parameter("MIS_TOTAL", items);
        self.plans_changed(ListKind::Plan);
    }

    /// Changes the reference of the sticks.
    pub(super) fn switch_simple(&mut self, function: u16, position: SwitchPosition) {
        let mode = match (function, position) {
            (SIMPLE_HEADING, High) => {
                let nose_deg = self.vehicle.believed().yaw_deg;
                self.vehicle.flight.simple.reset(nose_deg);
                return self.inform(MAV_SEVERITY_INFO, "Simple heading reset");
            }
            (SIMPLE, Middle | High) | (SUPER_SIMPLE, Middle) => SimpleMode::Simple,
            (SUPER_SIMPLE, High) => SimpleMode::SuperSimple,
            (SIMPLE | SUPER_SIMPLE, Low) => SimpleMode::Off,
            _ => return,
        };
        self.set_simple(mode);
    }

    /// Sets the reference of the sticks for a position of the mode switch (`SIMPLE`,
    /// `SUPER_SIMPLE`), unless another switch sets it.
    pub(in crate::autopilot) fn choose_simple(&mut self, switch_position: usize) {
        let rules = &self.vehicle.tuning.flight.radio;
        if rules.has_switch(SIMPLE) || rules.has_switch(SUPER_SIMPLE) {
            return;
        }
        let chosen = |name| {
            let bits = self.vehicle.parameters.value(name) as i32;
            bits & (1 << switch_position) != 0
        };
        let mode = if chosen("SUPER_SIMPLE") {
            SimpleMode::SuperSimple
        } else if chosen("SIMPLE") {
            SimpleMode::Simple
        } else {
            SimpleMode::Off
        };
        self.set_simple(mode);
    }

    /// Sets the reference of the sticks, and announces a change.
    fn set_simple(&mut self, mode: SimpleMode) {
        let (_, home_deg) = self.vehicle.way_home();
        if let Some(text) = self.vehicle.flight.simple.set(mode, home_deg) {
            self.inform(MAV_SEVERITY_INFO, text);
        }
    }

    /// Stores a point of ZIGZAG, or flies to the line through it; the middle position returns control to the pilot.
    pub(super) fn switch_zigzag(&mut self, position: SwitchPosition) {
        let end = match position {
            Low => LineEnd::A,
            High => LineEnd::B,
            Middle => return self.end_zigzag(false),
        };
        let vehicle = &mut self.vehicle;
        if vehicle.flight.mode.id != ModeId::ZigZag {
            return;
        }
        let here_m = vehicle.believed().position_m.truncate();
        let name = end.name();
        let zigzag = &mut vehicle.flight.pilot.zigzag;
        if zigzag.store(end, here_m) {
            return self.inform(MAV_SEVERITY_INFO, &format!("ZIGZAG: point {name} stored"));
        }
        let Some(goal_m) = zigzag.across(end, here_m) else {
            return;
        };
        vehicle.with_cockpit(|task, cockpit| {
            // A flight that is under way keeps its height.
            let down_m = match task {
                Task::Route(route) => route.goal_m().z,
                _ => cockpit.control.path_m.z,
            };
            let mut route = Route::standing(cockpit);
            route.go_to(goal_m.extend(down_m), cockpit);
            *task = Task::Route(Box::new(route));
        });
        self.inform(MAV_SEVERITY_INFO, &format!("ZIGZAG: moving to {name}"));
    }

    /// In ZIGZAG, returns control to the pilot at the destination or after a landing; to be called
    /// ten times a second.
    pub(in crate::autopilot) fn watch_zigzag(&mut self) {
        let flight = &self.vehicle.flight;
        let arrived = matches!(&flight.task, Task::Route(route) if route.reached);
        if arrived || self.vehicle.safety.landed {
            self.end_zigzag(arrived);
        }
    }

    /// In ZIGZAG, returns control to the pilot; the vehicle holds the destination or, if
    /// `keeps_target` is false, stops where it is.
    fn end_zigzag(&mut self, keeps_target: bool) {
        let vehicle = &mut self.vehicle;
        let is_zigzag = vehicle.flight.mode.id == ModeId::ZigZag;
        if !is_zigzag || !matches!(vehicle.flight.task, Task::Route(_)) {
            return;
        }
        vehicle.flight.task = Task::Piloted;
        if !keeps_target {
            let believed = vehicle.estimator.belief(&vehicle.plant.body);
            vehicle.flight.control.take_over(believed);
        }
        self.inform(MAV_SEVERITY_INFO, "ZIGZAG: manual control");
    }

    /// Enables, disables or releases the parachute.
    pub(super) fn switch_parachute(&mut self, function: u16, position: SwitchPosition) {
        match (function, position) {
            (PARACHUTE_ENABLE, High) | (PARACHUTE, Middle) => self.workbench.parachute = true,
            (PARACHUTE_ENABLE, Low | Middle) | (PARACHUTE, Low) => self.workbench.parachute = false,
            (PARACHUTE_RELEASE, Low | Middle) => {}
            (PARACHUTE, High) => {
                self.workbench.parachute = true;
                self.release_parachute();
            }
            _ => self.release_parachute(),
        }
    }

    /// Releases the parachute, if it is enabled and the vehicle is high enough; the motors stop.
    /// The fall is not braked, as in SITL without a parachute.
    pub(crate) fn release_parachute(&mut self) {
        let vehicle = &mut self.vehicle;
        if !self.workbench.parachute {
            return;
        }
        let height_m = vehicle.datum.home_point().z - vehicle.believed().position_m.z;
        if vehicle.safety.landed {
            vehicle.say(MAV_SEVERITY_INFO, "Parachute: Landed");
        } else if height_m < vehicle.parameters.value("CHUTE_ALT_MIN") {
            vehicle.say(MAV_SEVERITY_ALERT, "Parachute: Too low");
        } else {
            vehicle.say(MAV_SEVERITY_INFO, "Parachute: Released");
            self.disarm();
        }
    }

    /// Begins or cancels the calibration of all compasses.
    pub(super) fn switch_compass_calibration(&mut self, position: SwitchPosition) {
        let compasses = &mut self.workbench.compasses;
        match position {
            High if self.vehicle.safety.armed => {
                self.inform(MAV_SEVERITY_NOTICE, "Disarm to allow compass calibration");
            }
            High => {
                compasses.start(0);
            }
            Low => compasses.cancel(0),
            Middle => {}
        }
    }

    /// Interrupts the flight along a mission, or continues it.
    pub(super) fn switch_pause(&mut self, position: SwitchPosition) {
        if position == Middle {
            return;
        }
        let pause = position == High;
        if !self.pause(pause) && pause {
            self.inform(MAV_SEVERITY_WARNING, "Flight Mode Pause failed");
        }
    }

    /// Changes a setting that is stored or only reported.
    pub(super) fn switch_setting(&mut self, function: u16, position: SwitchPosition) {
        let number = position.number();
        match function {
            ACRO_TRAINER => {
                let value = f32::from(number);
                self.vehicle
                    .parameters
                    .set_until_boot("ACRO_TRAINER", value);
                self.vehicle.retune();
            }
            EKF_SOURCES => {
                let text = format!("Using EKF Source Set {}", number + 1);
                self.inform(MAV_SEVERITY_INFO, &text);
            }
            STANDBY if position == High => self.inform(MAV_SEVERITY_INFO, "Stand By Enabled"),
            STANDBY => self.inform(MAV_SEVERITY_INFO, "Stand By Disabled"),
            SAVE_TRIM if position == High => self.save_trim(),
            _ => {}
        }
    }

    /// Reports that the trim was saved, as in STABILIZE and ACRO with the throttle down; the sensors are level anyway.
    fn save_trim(&mut self) {
        let vehicle = &self.vehicle;
        let allows = matches!(vehicle.flight.mode.id, ModeId::Stabilize | ModeId::Acro);
        if allows && vehicle.sticks().throttle_is_low() {
            self.inform(MAV_SEVERITY_INFO, "Trim saved");
        }
    }
}
