//! `MAV_CMD`: one table from command number to handler, and one of those that are answered without further ado.

mod auxiliary;
mod calibration;
mod fence;
mod flight;
mod motion;
mod outputs;
mod plan;
mod setup;
mod streams;

use mavlink::dialects::ardupilotmega::MavResult::{
    self, MAV_RESULT_ACCEPTED as ACCEPTED, MAV_RESULT_DENIED as DENIED, MAV_RESULT_FAILED as FAILED,
};

use super::autopilot::Autopilot;
use super::port::Link;
use sortie_geo::LatLon;

/// A command as `COMMAND_LONG` or `COMMAND_INT` brought it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Command {
    pub(super) number: u16,
    /// The first four parameters.
    pub(super) p: [f32; 4],
    /// Parameters 5 and 6: whole numbers, or a place in degrees times 1e7.
    pub(super) x: i32,
    pub(super) y: i32,
    /// Parameter 7.
    pub(super) z: f32,
    /// The frame of a `COMMAND_INT`; a `COMMAND_LONG` has none.
    pub(super) frame: Option<u8>,
}

impl Command {
    /// A `COMMAND_LONG`: the vehicle turns its fifth and sixth parameter into whole numbers, in degrees times 1e7
    /// where the command is about a place.
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

    /// A parameter without its fraction. Where it is not a number there is nothing to ask for: the real vehicle
    /// dies of it, this one denies.
    fn whole(&self, parameter: usize) -> Option<i32> {
        let value = self.p.get(parameter).copied()?;
        (!value.is_nan()).then_some(value as i32)
    }

    /// Whether a parameter is this very number.
    fn is(&self, parameter: usize, number: f32) -> bool {
        self.p
            .get(parameter)
            .is_some_and(|value| (value - number).abs() < f32::EPSILON * number.abs().max(1.0))
    }
}

/// Home, region of interest, reposition, position estimate.
const WITH_PLACE: &[u16] = &[179, 201, 195, 192, 43003];

type Handler = fn(&mut Autopilot, &mut Link, &Command) -> MavResult;

/// What the vehicle carries out, by number of the `MAV_CMD`.
const TABLE: &[(u16, Handler)] = &[
    (17, flight::loiter),
    (20, flight::return_to_launch),
    (21, flight::land),
    (85, flight::land),
    (22, flight::takeoff),
    (84, flight::takeoff),
    (32, setup::follow),
    (115, motion::yaw),
    (176, flight::set_mode),
    (178, motion::change_speed),
    (179, setup::set_home),
    (181, outputs::relay),
    (182, outputs::relay),
    (183, outputs::servo),
    (184, outputs::servo),
    (185, flight::terminate),
    (188, flight::start_return_path),
    (189, plan::start_landing_sequence),
    (192, motion::reposition),
    (193, motion::pause_or_continue),
    (195, motion::look_at),
    (197, motion::look_ahead),
    (201, motion::look_at),
    (207, fence::enable),
    (208, outputs::parachute),
    (209, outputs::motor_test),
    (218, auxiliary::switch),
    (224, plan::set_current),
    (241, calibration::preflight),
    (245, setup::storage),
    (246, setup::reboot),
    (300, plan::start),
    (400, flight::arm_or_disarm),
    (401, setup::run_checks),
    (410, streams::home_position),
    (510, streams::get_interval),
    (511, streams::set_interval),
    (512, streams::request),
    (520, streams::capabilities),
    (601, plan::jump_to_tag),
    (2600, setup::high_latency),
    (5300, outputs::safety_switch),
    (42001, flight::fly_button),
    (42002, flight::fly_button_held),
    (42003, flight::pause_button),
    (42007, setup::estimator_source),
    (42424, calibration::start_compass),
    (42425, calibration::accept_compass),
    (42426, calibration::cancel_compass),
    (42428, setup::banner),
    (42651, outputs::battery_reset),
];

/// Commands to devices that a plain SITL copter has, lacks, or has without using them: the answer to a sweep with
/// every parameter zero (camera, gimbal, gripper, winch, sprayer, scripting and their like).
const FIXED: &[(u16, MavResult)] = &[
    (198, ACCEPTED),
    (202, ACCEPTED),
    (203, ACCEPTED),
    (204, FAILED),
    (205, FAILED),
    (206, ACCEPTED),
    (211, FAILED),
    (216, ACCEPTED),
    (500, FAILED),
    (532, DENIED),
    (534, DENIED),
    (1000, FAILED),
    (1001, FAILED),
    (2000, FAILED),
    (2001, ACCEPTED),
    (2500, FAILED),
    (2501, FAILED),
    (2520, ACCEPTED),
    (10001, FAILED),
    (32000, ACCEPTED),
    (42006, ACCEPTED),
    (42429, FAILED),
    (42600, FAILED),
    (42700, DENIED),
    (42701, ACCEPTED),
];

/// Carries out a command and says how it went.
pub(super) fn execute(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    if let Some((_, handler)) = TABLE.iter().find(|(known, _)| *known == command.number) {
        return handler(autopilot, link, command);
    }
    FIXED
        .iter()
        .find(|(known, _)| *known == command.number)
        .map_or(MavResult::MAV_RESULT_UNSUPPORTED, |(_, result)| *result)
}

/// Whether the messages that a command asks for come before its acknowledgement.
pub(super) fn answers_first(number: u16) -> bool {
    matches!(number, 410 | 510)
}

/// ACCEPTED or FAILED.
fn done(worked: bool) -> MavResult {
    if worked { ACCEPTED } else { FAILED }
}
