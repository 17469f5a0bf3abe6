//! `MAV_CMD`: one table from command number to handler.

mod flight;
mod plan;
mod setup;
mod streams;

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::autopilot::Autopilot;
use super::port::Link;

/// A command as `COMMAND_LONG` or `COMMAND_INT` brought it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Command {
    pub(super) number: u16,
    /// The first four parameters.
    pub(super) p: [f32; 4],
    /// Parameters 5 and 6; as degrees where they are a place.
    pub(super) x: f64,
    pub(super) y: f64,
    /// Parameter 7.
    pub(super) z: f32,
    /// The frame of a `COMMAND_INT`; a `COMMAND_LONG` has none.
    pub(super) frame: Option<u8>,
}

type Handler = fn(&mut Autopilot, &mut Link, &Command) -> MavResult;

/// What the vehicle serves. Everything else is unsupported.
#[expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]
const TABLE: &[(MavCmd, Handler)] = &[
    (MavCmd::MAV_CMD_NAV_LOITER_UNLIM, flight::loiter),
    (
        MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH,
        flight::return_to_launch,
    ),
    (MavCmd::MAV_CMD_NAV_LAND, flight::land),
    (MavCmd::MAV_CMD_NAV_VTOL_LAND, flight::land),
    (MavCmd::MAV_CMD_NAV_TAKEOFF, flight::takeoff),
    (MavCmd::MAV_CMD_NAV_VTOL_TAKEOFF, flight::takeoff),
    (MavCmd::MAV_CMD_CONDITION_YAW, flight::yaw),
    (MavCmd::MAV_CMD_DO_SET_MODE, flight::set_mode),
    (MavCmd::MAV_CMD_DO_CHANGE_SPEED, flight::change_speed),
    (MavCmd::MAV_CMD_DO_SET_HOME, setup::set_home),
    (MavCmd::MAV_CMD_DO_SET_RELAY, setup::set_relay),
    (MavCmd::MAV_CMD_DO_SET_SERVO, setup::set_servo),
    (MavCmd::MAV_CMD_DO_FLIGHTTERMINATION, flight::terminate),
    (MavCmd::MAV_CMD_DO_REPOSITION, flight::reposition),
    (MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, flight::pause_or_continue),
    (MavCmd::MAV_CMD_DO_LAND_START, plan::start_landing_sequence),
    (MavCmd::MAV_CMD_DO_SET_ROI_LOCATION, flight::look_at),
    (MavCmd::MAV_CMD_DO_SET_ROI_NONE, flight::look_ahead),
    (MavCmd::MAV_CMD_DO_SET_ROI, flight::look_at),
    (MavCmd::MAV_CMD_PREFLIGHT_CALIBRATION, setup::calibrate),
    (MavCmd::MAV_CMD_PREFLIGHT_STORAGE, setup::storage),
    (MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, setup::reboot),
    (MavCmd::MAV_CMD_MISSION_START, plan::start),
    (MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT, plan::set_current),
    (MavCmd::MAV_CMD_DO_JUMP_TAG, plan::jump_to_tag),
    (MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, flight::arm_or_disarm),
    (MavCmd::MAV_CMD_GET_HOME_POSITION, streams::home_position),
    (MavCmd::MAV_CMD_GET_MESSAGE_INTERVAL, streams::get_interval),
    (MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, streams::set_interval),
    (MavCmd::MAV_CMD_REQUEST_MESSAGE, streams::request),
    (
        MavCmd::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES,
        streams::capabilities,
    ),
    (MavCmd::MAV_CMD_DO_SEND_BANNER, setup::banner),
];

/// Carries out a command and says how it went.
pub(super) fn execute(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    TABLE
        .iter()
        .find(|(known, _)| *known as u32 == u32::from(command.number))
        .map_or(MavResult::MAV_RESULT_UNSUPPORTED, |(_, handler)| {
            handler(autopilot, link, command)
        })
}

/// ACCEPTED or FAILED.
fn done(worked: bool) -> MavResult {
    if worked {
        MavResult::MAV_RESULT_ACCEPTED
    } else {
        MavResult::MAV_RESULT_FAILED
    }
}
