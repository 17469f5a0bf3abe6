//! Commands to devices that a plain SITL lacks or does not use (camera, gimbal, gripper, winch, sprayer, scripting and the
//! like).

use mavlink::dialects::ardupilotmega::{MavResult, SetFocusType};

use self::Answer::{Always, By};
use super::{ACCEPTED, Command, FAILED};
use crate::cmd;
use crate::kind::VehicleKind;

const DENIED: MavResult = MavResult::MAV_RESULT_DENIED;
const UNSUPPORTED: MavResult = MavResult::MAV_RESULT_UNSUPPORTED;

/// The answer to a command.
#[derive(Clone, Copy)]
enum Answer {
    Always(MavResult),
    /// One that depends on the parameters.
    By(fn(&Command) -> MavResult),
}

const ANSWERS: &[(u16, Answer)] = &[
    (cmd::DO_SET_ROI_SYSID, Always(ACCEPTED)),
    (cmd::DO_DIGICAM_CONFIGURE, Always(ACCEPTED)),
    (cmd::DO_DIGICAM_CONTROL, Always(ACCEPTED)),
    (cmd::DO_MOUNT_CONFIGURE, Always(FAILED)),
    (cmd::DO_MOUNT_CONTROL, Always(FAILED)),
    (cmd::DO_SET_CAM_TRIGG_DIST, Always(ACCEPTED)),
    (cmd::DO_GRIPPER, Always(FAILED)),
    (cmd::DO_SPRAYER, Always(ACCEPTED)),
    (cmd::START_RX_PAIR, Always(FAILED)),
    (cmd::STORAGE_FORMAT, By(format)),
    (cmd::SET_CAMERA_FOCUS, By(focus)),
    (cmd::SET_CAMERA_SOURCE, Always(DENIED)),
    (cmd::DO_GIMBAL_MANAGER_PITCHYAW, Always(FAILED)),
    (cmd::DO_GIMBAL_MANAGER_CONFIGURE, Always(FAILED)),
    (cmd::IMAGE_START_CAPTURE, By(pictures)),
    (cmd::IMAGE_STOP_CAPTURE, By(no_pictures)),
    (cmd::VIDEO_START_CAPTURE, Always(FAILED)),
    (cmd::VIDEO_STOP_CAPTURE, Always(FAILED)),
    (cmd::AIRFRAME_CONFIGURATION, Always(ACCEPTED)),
    (cmd::DO_ADSB_OUT_IDENT, Always(FAILED)),
    (cmd::CAN_FORWARD, By(bus)),
    (cmd::FIXED_MAG_CAL_YAW, Always(ACCEPTED)),
    (cmd::ACCELCAL_VEHICLE_POS, Always(FAILED)),
    (cmd::DO_WINCH, Always(FAILED)),
    (cmd::DEBUG_TRAP, Always(DENIED)),
    (cmd::SCRIPTING, Always(ACCEPTED)),
];

/// The numbers of these commands.
pub(crate) fn answered() -> impl Iterator<Item = u16> {
    ANSWERS.iter().map(|(number, _)| *number)
}

/// Those that a rover does not know.
const ONLY_COPTER: &[u16] = &[cmd::AIRFRAME_CONFIGURATION, cmd::DO_WINCH];

/// The answer to a command, if it is one of these.
pub(super) fn answer(command: &Command, kind: VehicleKind) -> Option<MavResult> {
    if kind != VehicleKind::Copter && ONLY_COPTER.contains(&command.number) {
        return None;
    }
    let (_, answer) = ANSWERS.iter().find(|(known, _)| *known == command.number)?;
    Some(match answer {
        Always(result) => *result,
        By(answer) => answer(command),
    })
}

/// Formats a memory card, which is absent.
fn format(command: &Command) -> MavResult {
    if command.is(0, 1.0) && command.is(1, 1.0) {
        FAILED
    } else {
        UNSUPPORTED
    }
}

/// Denies steps, metres and unknown kinds of focus; the others fail without a camera.
fn focus(command: &Command) -> MavResult {
    let [kind, ..] = command.p;
    let known = SetFocusType::FOCUS_TYPE_CONTINUOUS as i32
        ..=SetFocusType::FOCUS_TYPE_AUTO_CONTINUOUS as i32;
    let is_possible =
        known.contains(&(kind as i32)) && kind as i32 != SetFocusType::FOCUS_TYPE_METERS as i32;
    if is_possible { FAILED } else { DENIED }
}

fn pictures(command: &Command) -> MavResult {
    let [camera, ..] = command.p;
    if camera < 0.0 { UNSUPPORTED } else { FAILED }
}

/// Ends the pictures of all cameras; a single one is absent.
fn no_pictures(command: &Command) -> MavResult {
    let [camera, ..] = command.p;
    if camera == 0.0 { ACCEPTED } else { UNSUPPORTED }
}

/// Ends forwarding from every bus; a single one is absent.
fn bus(command: &Command) -> MavResult {
    let [number, ..] = command.p;
    if number as i8 == 0 { ACCEPTED } else { FAILED }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a real copter answered.
    #[test]
    fn an_answer_depends_on_the_parameters_where_it_does_on_the_real_vehicle() {
        let first = |value: f32| Command {
            number: 0,
            p: [value, value, 0.0, 0.0],
            x: 0,
            y: 0,
            z: 0.0,
            frame: None,
        };
        assert_eq!(
            [format(&first(0.0)), format(&first(1.0))],
            [UNSUPPORTED, FAILED]
        );
        assert_eq!([focus(&first(0.0)), focus(&first(1.0))], [DENIED, FAILED]);
        assert_eq!(
            [no_pictures(&first(0.0)), no_pictures(&first(1.0))],
            [ACCEPTED, UNSUPPORTED]
        );
        assert_eq!([bus(&first(0.0)), bus(&first(1.0))], [ACCEPTED, FAILED]);
        assert_eq!(
            [pictures(&first(-1.0)), pictures(&first(1.0))],
            [UNSUPPORTED, FAILED]
        );
    }
}
