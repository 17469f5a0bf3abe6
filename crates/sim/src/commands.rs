//! `MAV_CMD`: one table from command number to handler, and one of fixed answers.

mod absent;
mod auxiliary;
mod calibration;
mod driving;
mod fence;
mod flight;
mod motion;
mod outputs;
mod plan;
mod setup;
mod streams;

use mavlink::dialects::ardupilotmega::MavResult::{
    self, MAV_RESULT_ACCEPTED as ACCEPTED, MAV_RESULT_FAILED as FAILED,
};

use super::autopilot::Autopilot;
use super::cmd;
use super::kind::VehicleKind;
use super::link::Link;
use sortie_geo::LatLon;

/// A command from `COMMAND_LONG` or `COMMAND_INT`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Command {
    pub(super) number: u16,
    /// The first four parameters.
    pub(super) p: [f32; 4],
    /// Parameters 5 and 6: whole numbers, or a place in degrees times 1e7.
    pub(super) x: i32,
    pub(super) y: i32,
    /// Altitude in metres above the reference of the frame, or parameter 7.
    pub(super) z: f32,
    /// The frame of a `COMMAND_INT`; a `COMMAND_LONG` has none.
    pub(super) frame: Option<u8>,
}

impl Command {
    /// A `COMMAND_LONG`: the vehicle converts its fifth and sixth parameters to whole numbers, in
    /// degrees times 1e7 if the command has a place.
    pub(super) fn from_long(number: u16, p: [f32; 4], [x, y, z]: [f32; 3]) -> Self {
        let whole = |value: f32| {
            if WITH_PLACE.contains(&number) {
                (f64::from(value) * 1e7) as i32
            } else {
                value as i32
            }
        };
        Self {
            number,
            p,
            x: whole(x),
            y: whole(y),
            z,
            frame: None,
        }
    }

    /// Parameters 5 and 6 as a place.
    fn at(&self) -> LatLon {
        LatLon::from_e7(self.x, self.y)
    }

    /// A parameter without its fraction; `None` for NaN, which would crash the real vehicle.
    fn whole(&self, parameter: usize) -> Option<i32> {
        let value = self.p.get(parameter).copied()?;
        (!value.is_nan()).then_some(value as i32)
    }

    fn is(&self, parameter: usize, number: f32) -> bool {
        self.p
            .get(parameter)
            .is_some_and(|value| (value - number).abs() < f32::EPSILON * number.abs().max(1.0))
    }
}

const WITH_PLACE: &[u16] = &[
    cmd::DO_SET_HOME,
    cmd::DO_SET_ROI,
    cmd::DO_SET_ROI_LOCATION,
    cmd::DO_REPOSITION,
    cmd::EXTERNAL_POSITION_ESTIMATE,
];

type Handler = fn(&mut Autopilot, &mut Link, &Command) -> MavResult;

/// The supported commands of every vehicle, by number.
const SHARED: &[(u16, Handler)] = &[
    (cmd::NAV_RETURN_TO_LAUNCH, flight::return_to_launch),
    (cmd::DO_SET_MODE, flight::set_mode),
    (cmd::DO_SET_HOME, setup::set_home),
    (cmd::DO_SET_RELAY, outputs::relay),
    (cmd::DO_REPEAT_RELAY, outputs::relay),
    (cmd::DO_SET_SERVO, outputs::servo),
    (cmd::DO_REPEAT_SERVO, outputs::servo),
    (cmd::DO_SET_ROI_LOCATION, motion::look_at),
    (cmd::DO_SET_ROI_NONE, motion::look_ahead),
    (cmd::DO_SET_ROI, motion::look_at),
    (cmd::DO_FENCE_ENABLE, fence::enable),
    (cmd::DO_AUX_FUNCTION, auxiliary::switch),
    (cmd::DO_SET_MISSION_CURRENT, plan::set_current),
    (cmd::PREFLIGHT_CALIBRATION, calibration::preflight),
    (cmd::PREFLIGHT_STORAGE, setup::storage),
    (cmd::PREFLIGHT_REBOOT_SHUTDOWN, setup::reboot),
    (cmd::COMPONENT_ARM_DISARM, flight::arm_or_disarm),
    (cmd::RUN_PREARM_CHECKS, setup::run_checks),
    (cmd::GET_HOME_POSITION, streams::home_position),
    (cmd::GET_MESSAGE_INTERVAL, streams::get_interval),
    (cmd::SET_MESSAGE_INTERVAL, streams::set_interval),
    (cmd::REQUEST_MESSAGE, streams::request),
    (cmd::REQUEST_AUTOPILOT_CAPABILITIES, streams::capabilities),
    (cmd::DO_JUMP_TAG, plan::jump_to_tag),
    (cmd::CONTROL_HIGH_LATENCY, setup::high_latency),
    (cmd::DO_SET_SAFETY_SWITCH_STATE, outputs::safety_switch),
    (cmd::SET_EKF_SOURCE_SET, setup::estimator_source),
    (cmd::EXTERNAL_POSITION_ESTIMATE, setup::external_position),
    (cmd::DO_START_MAG_CAL, calibration::start_compass),
    (cmd::DO_ACCEPT_MAG_CAL, calibration::accept_compass),
    (cmd::DO_CANCEL_MAG_CAL, calibration::cancel_compass),
    (cmd::DO_SEND_BANNER, setup::banner),
    (cmd::BATTERY_RESET, outputs::battery_reset),
];

/// The commands that only copters have, or carry out in their own way.
const COPTER: &[(u16, Handler)] = &[
    (cmd::DO_MOTOR_TEST, outputs::motor_test),
    (cmd::DO_FOLLOW, setup::follow),
    (cmd::DO_FLIGHTTERMINATION, flight::terminate),
    (cmd::NAV_LOITER_UNLIM, flight::loiter),
    (cmd::NAV_LAND, flight::land),
    (cmd::NAV_VTOL_LAND, flight::land),
    (cmd::NAV_TAKEOFF, flight::takeoff),
    (cmd::NAV_VTOL_TAKEOFF, flight::takeoff),
    (cmd::CONDITION_YAW, motion::yaw),
    (cmd::DO_CHANGE_SPEED, motion::change_speed),
    (cmd::DO_RETURN_PATH_START, flight::start_return_path),
    (cmd::DO_LAND_START, plan::start_landing_sequence),
    (cmd::DO_REPOSITION, motion::reposition),
    (cmd::DO_PAUSE_CONTINUE, motion::pause_or_continue),
    (cmd::DO_PARACHUTE, outputs::parachute),
    (cmd::MISSION_START, plan::start),
    (cmd::SOLO_BTN_FLY_CLICK, flight::fly_button),
    (cmd::SOLO_BTN_FLY_HOLD, flight::fly_button_held),
    (cmd::SOLO_BTN_PAUSE_CLICK, flight::pause_button),
];

/// The commands that only rovers have, or carry out in their own way.
const ROVER: &[(u16, Handler)] = &[
    (cmd::DO_MOTOR_TEST, driving::motor_test),
    (cmd::DO_CHANGE_SPEED, driving::change_speed),
    (cmd::DO_REPOSITION, driving::reposition),
    (cmd::MISSION_START, driving::start_mission),
    (cmd::DO_SET_REVERSE, driving::set_reverse),
    (cmd::NAV_SET_YAW_SPEED, driving::set_yaw_and_speed),
];

fn own(kind: VehicleKind) -> &'static [(u16, Handler)] {
    match kind {
        VehicleKind::Copter => COPTER,
        VehicleKind::Rover(_) => ROVER,
    }
}

/// The commands that a kind of vehicle carries out, in ascending order.
pub(super) fn carried_out(kind: VehicleKind) -> Vec<u16> {
    let all = own(kind).iter().chain(SHARED);
    let mut numbers: Vec<u16> = all.map(|(number, _)| *number).collect();
    numbers.sort_unstable();
    numbers
}

pub(super) use self::absent::answered;

/// Carries out a command and returns the result.
pub(super) fn execute(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    let mut all = own(autopilot.vehicle.kind).iter().chain(SHARED);
    if let Some((_, handler)) = all.find(|(known, _)| *known == command.number) {
        return handler(autopilot, link, command);
    }
    absent::answer(command, autopilot.vehicle.kind).unwrap_or(MavResult::MAV_RESULT_UNSUPPORTED)
}

/// Whether the messages that a command requests precede its acknowledgement.
pub(super) fn answers_first(number: u16) -> bool {
    matches!(
        number,
        cmd::GET_HOME_POSITION | cmd::GET_MESSAGE_INTERVAL | cmd::PREFLIGHT_CALIBRATION
    )
}

fn done(worked: bool) -> MavResult {
    if worked { ACCEPTED } else { FAILED }
}
