//! Auxiliary functions of the transmitter's switches (`RCn_OPTION`), run by the switch itself or by
//! `DO_AUX_FUNCTION`.

mod pilot;
mod surface;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Autopilot;
use crate::arming::ArmingMethod;
use crate::kind::VehicleKind;
use crate::mode::{Mode, ModeId};
use crate::radio::SwitchPosition::{self, High, Low, Middle};
use crate::radio::{ARM_OR_EMERGENCY_STOP, MOTOR_EMERGENCY_STOP, MOTOR_INTERLOCK};

/// Functions that enter a mode.
const MODES: &[(u16, ModeId)] = &[
    (2, ModeId::Flip),
    (4, ModeId::Rtl),
    (16, ModeId::Auto),
    (17, ModeId::AutoTune),
    (18, ModeId::Land),
    (33, ModeId::Brake),
    (37, ModeId::Throw),
    (42, ModeId::SmartRtl),
    (52, ModeId::Acro),
    (55, ModeId::Guided),
    (56, ModeId::Loiter),
    (57, ModeId::Follow),
    (60, ModeId::ZigZag),
    (68, ModeId::Stabilize),
    (69, ModeId::PosHold),
    (70, ModeId::AltHold),
    (71, ModeId::FlowHold),
    (72, ModeId::Circle),
    (73, ModeId::Drift),
    (99, ModeId::AutoRtl),
    (151, ModeId::Turtle),
];
const SIMPLE: u16 = 3;
const SAVE_TRIM: u16 = 5;
const SAVE_WAYPOINT: u16 = 7;
const FENCE: u16 = 11;
const SUPER_SIMPLE: u16 = 13;
const ACRO_TRAINER: u16 = 14;
const PARACHUTE_ENABLE: u16 = 21;
const PARACHUTE_RELEASE: u16 = 22;
const PARACHUTE: u16 = 23;
const MISSION_RESET: u16 = 24;
const OVERRIDES: u16 = 46;
const CLEAR_MISSION: u16 = 58;
const ZIGZAG_POINTS: u16 = 61;
const GPS_OFF: u16 = 65;
const STANDBY: u16 = 76;
const DISARM: u16 = 81;
const EKF_SOURCES: u16 = 90;
const SIMPLE_HEADING: u16 = 152;
const ARM_OR_DISARM: u16 = 153;
const ARM_OR_DISARM_AIRMODE: u16 = 154;
const COMPASS_CALIBRATION: u16 = 171;
const PAUSE: u16 = 178;
/// Functions that switch a relay, each with its bit.
const RELAYS: &[(u16, u16)] = &[
    (28, 1),
    (34, 1 << 1),
    (35, 1 << 2),
    (36, 1 << 3),
    (66, 1 << 4),
    (67, 1 << 5),
];
/// Functions with an effect, apart from modes, with their names in the firmware's documentation.
const ACTING: &[(u16, &str)] = &[
    (SIMPLE, "Simple Mode"),
    (SAVE_TRIM, "Save Trim"),
    (SAVE_WAYPOINT, "Save WP"),
    (FENCE, "Fence Enable"),
    (SUPER_SIMPLE, "Super Simple Mode"),
    (ACRO_TRAINER, "Acro Trainer"),
    (PARACHUTE_ENABLE, "Parachute Enable"),
    (PARACHUTE_RELEASE, "Parachute Release"),
    (PARACHUTE, "Parachute 3pos"),
    (MISSION_RESET, "Auto Mission Reset"),
    (28, "Relay1 On/Off"),
    (MOTOR_EMERGENCY_STOP, "Motor Emergency Stop"),
    (MOTOR_INTERLOCK, "Motor Interlock"),
    (34, "Relay2 On/Off"),
    (35, "Relay3 On/Off"),
    (36, "Relay4 On/Off"),
    (OVERRIDES, "RC Override Enable"),
    (CLEAR_MISSION, "Clear Waypoints"),
    (ZIGZAG_POINTS, "ZigZag SaveWP"),
    (GPS_OFF, "GPS Disable"),
    (66, "Relay5 On/Off"),
    (67, "Relay6 On/Off"),
    (STANDBY, "Standby Mode"),
    (DISARM, "Disarm"),
    (EKF_SOURCES, "EKF Source Set"),
    (SIMPLE_HEADING, "Simple Mode Heading Reset"),
    (ARM_OR_DISARM, "ArmDisarm"),
    (ARM_OR_DISARM_AIRMODE, "ArmDisarm with AirMode"),
    (ARM_OR_EMERGENCY_STOP, "Arm/Emergency Motor Stop"),
    (COMPASS_CALIBRATION, "Calibrate Compasses"),
    (PAUSE, "FlightMode Pause/Resume"),
];
/// Functions that exist but have no effect in the simulation.
const WITHOUT_EFFECT: &[u16] = &[
    9, 10, 15, 19, 25, 26, 27, 29, 30, 38, 39, 40, 44, 45, 62, 75, 78, 79, 80, 83, 84, 85, 100,
    101, 102, 103, 104, 105, 106, 109, 110, 111, 112, 156, 158, 159, 160, 162, 163, 164, 172, 177,
    212, 213, 214, 215, 216, 217, 218, 300, 301, 302, 303, 304, 305, 306, 307,
];
/// Functions that exist but fail.
const FAILING: &[u16] = &[166, 167, 168, 169, 174, 175];
/// Functions whose switch is announced in a text when it moves, and their names.
const ANNOUNCED: &[(u16, &str)] = &[
    (SAVE_WAYPOINT, "SaveWaypoint"),
    (9, "CameraTrigger"),
    (10, "Rangefinder"),
    (FENCE, "Fence"),
    (15, "Sprayer"),
    (PARACHUTE_ENABLE, "ParachuteEnable"),
    (PARACHUTE_RELEASE, "ParachuteRelease"),
    (PARACHUTE, "Parachute3Position"),
    (MISSION_RESET, "MissionReset"),
    (27, "RetractMount1"),
    (28, "Relay1"),
    (MOTOR_EMERGENCY_STOP, "MotorEStop"),
    (MOTOR_INTERLOCK, "MotorInterlock"),
    (34, "Relay2"),
    (35, "Relay3"),
    (36, "Relay4"),
    (39, "PrecisionLoiter"),
    (40, "AvoidProximity"),
    (44, "WinchEnable"),
    (45, "WinchControl"),
    (CLEAR_MISSION, "ClearWaypoint"),
    (62, "CompassLearn"),
    (GPS_OFF, "GPSDisable"),
    (66, "Relay5"),
    (67, "Relay6"),
    (75, "SurfaceTracking"),
    (78, "RunCamControl"),
    (79, "RunCamOSDControl"),
    (80, "VisOdomAlign"),
    (84, "AirMode"),
    (85, "Generator"),
    (102, "CamModeToggle"),
    (105, "GPSDisableYaw"),
    (106, "DisableAirspeedUse"),
    (156, "Torqeedo Clear Err"),
    (160, "Weathervane"),
    (162, "FFT Notch Tuning"),
    (163, "MountLock"),
    (164, "Pause Stream Logging"),
    (166, "Camera Record Video"),
    (167, "Camera Zoom"),
    (168, "Camera Manual Focus"),
    (169, "Camera Auto Focus"),
    (172, "Battery MPPT Enable"),
    (174, "Camera Image Tracking"),
    (175, "Camera Lens"),
    (177, "Mount LRF Enable"),
];

/// Whether a function enters a mode of a copter.
fn is_mode(function: u16) -> bool {
    MODES.iter().any(|(known, _)| *known == function)
}

/// The names of functions that act.
pub(crate) fn acting() -> impl Iterator<Item = &'static str> {
    let modes = MODES.iter().filter_map(|(_, id)| {
        let mode = Mode::of(VehicleKind::Copter, *id)?;
        (!mode.is_always_refused()).then_some(mode.name)
    });
    modes.chain(ACTING.iter().map(|(_, name)| *name))
}

/// The numbers of functions without an effect, in ascending order.
pub(crate) fn idle() -> impl Iterator<Item = u16> {
    let refused = MODES.iter().filter_map(|(function, id)| {
        let mode = Mode::of(VehicleKind::Copter, *id)?;
        mode.is_always_refused().then_some(*function)
    });
    let mut all: Vec<u16> = refused
        .chain(WITHOUT_EFFECT.iter().copied())
        .chain(FAILING.iter().copied())
        .collect();
    all.sort_unstable();
    all.into_iter()
}

impl Autopilot {
    /// Obeys the sticks and switches, unless the remote control is lost.
    pub(super) fn watch_sticks(&mut self) {
        let vehicle = &mut self.vehicle;
        let (armed, now) = (vehicle.safety.armed, vehicle.uptime());
        let rules = &vehicle.tuning.flight.radio;
        let hears = vehicle.radio.hears(vehicle.tuning.faults.radio, now);
        vehicle.radio.was_heard |= hears;
        if !hears || self.failsafe.radio_is_lost() || vehicle.boot.is_initialising() {
            return;
        }
        let asked = vehicle.radio.watch(rules, armed, now);
        if armed && vehicle.flight.simple.follows_home() {
            let (away_m, home_deg) = vehicle.way_home();
            vehicle.flight.simple.watch(away_m, home_deg);
        }
        if asked.moved_switch {
            self.obey_mode_switch();
        }
        if asked.arms {
            self.arm(ArmingMethod::YawStick);
        }
        for moved in asked.moves {
            if let Some((_, name)) = ANNOUNCED.iter().find(|(known, _)| *known == moved.function) {
                let text = format!("RC{}: {name} {}", moved.channel, moved.position.name());
                self.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
            }
            self.run_function(moved.function, moved.position);
        }
    }

    /// Runs a function for a position of its switch; `false` for one that does not exist or fails.
    pub(crate) fn run_function(&mut self, function: u16, position: SwitchPosition) -> bool {
        if self.vehicle.kind != VehicleKind::Copter
            && let Some(worked) = self.run_surface_function(function, position)
        {
            return worked;
        }
        if let Some((_, mode)) = MODES.iter().find(|(known, _)| *known == function) {
            self.switch_mode(*mode, position);
            return true;
        }
        if let Some((_, bit)) = RELAYS.iter().find(|(known, _)| *known == function) {
            self.switch_relay(*bit, position);
            return true;
        }
        match function {
            ARM_OR_DISARM
            | ARM_OR_DISARM_AIRMODE
            | ARM_OR_EMERGENCY_STOP
            | DISARM
            | MOTOR_EMERGENCY_STOP
            | MOTOR_INTERLOCK => self.switch_motors(function, position),
            FENCE | OVERRIDES | GPS_OFF => self.switch_equipment(function, position),
            MISSION_RESET | CLEAR_MISSION | SAVE_WAYPOINT => self.edit_mission(function, position),
            SIMPLE | SUPER_SIMPLE | SIMPLE_HEADING => self.switch_simple(function, position),
            ZIGZAG_POINTS => self.switch_zigzag(position),
            PARACHUTE_ENABLE | PARACHUTE_RELEASE | PARACHUTE => {
                self.switch_parachute(function, position);
            }
            COMPASS_CALIBRATION => self.switch_compass_calibration(position),
            PAUSE => self.switch_pause(position),
            SAVE_TRIM | ACRO_TRAINER | STANDBY | EKF_SOURCES => {
                self.switch_setting(function, position);
            }
            known if WITHOUT_EFFECT.contains(&known) => {}
            known if FAILING.contains(&known) => return false,
            _ => return self.refuse_function(function),
        }
        true
    }

    /// Reports a function that the vehicle does not know.
    fn refuse_function(&mut self, function: u16) -> bool {
        let text = format!("Invalid channel option ({function})");
        self.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        false
    }

    /// Arms, disarms, or stops the motors, as the function defines for the position.
    fn switch_motors(&mut self, function: u16, position: SwitchPosition) {
        let safety = &mut self.vehicle.safety;
        match (function, position) {
            (MOTOR_INTERLOCK, _) => safety.interlock = position != Low,
            (ARM_OR_EMERGENCY_STOP, Low) | (MOTOR_EMERGENCY_STOP, High) => {
                safety.emergency_stop = true;
            }
            (ARM_OR_EMERGENCY_STOP, Middle) | (MOTOR_EMERGENCY_STOP, Low) => {
                safety.emergency_stop = false;
            }
            (ARM_OR_EMERGENCY_STOP, High) => {
                safety.emergency_stop = false;
                self.arm(ArmingMethod::Switch);
            }
            (ARM_OR_DISARM | ARM_OR_DISARM_AIRMODE, High) => {
                self.arm(ArmingMethod::Switch);
            }
            (ARM_OR_DISARM | ARM_OR_DISARM_AIRMODE, Low) | (DISARM, High) => self.disarm(),
            (_, Low | Middle | High) => {}
        }
    }

    /// The high position enters a mode; any other position leaves it for the mode of the mode
    /// switch.
    fn switch_mode(&mut self, mode: ModeId, position: SwitchPosition) {
        if position == High {
            self.set_mode(mode);
        } else if self.vehicle.flight.mode.id == mode {
            self.obey_mode_switch();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wind::Wind;

    #[test]
    fn every_function_that_acts_is_known_and_no_other_is_idle() {
        let mut autopilot = Autopilot::new(
            VehicleKind::Copter,
            1,
            crate::tests::start(),
            crate::Airframe::shared_default(),
            Wind::new(0, 0),
        );
        for (function, name) in ACTING {
            assert!(autopilot.run_function(*function, Low), "{name}");
            assert!(!WITHOUT_EFFECT.contains(function), "{name}");
        }
        for function in idle().filter(|function| !FAILING.contains(function)) {
            assert!(autopilot.run_function(function, Low), "{function}");
        }
        assert!(!autopilot.run_function(1, Low));
    }
}
