//! The commands that ArduPilot supports, and how it stores their parameters.

use crate::command;

/// How the seven parameters of each command are stored, one letter each: `.` not at all, `B` and
/// `b` as an unsigned and a signed byte, `H` and `h` as 16 bits, `f` as a float, `c` in hundredths,
/// `o` as a flag, `1` as the lowest bit of the value, `L` as part of a place. Only loiters and
/// landings have four more letters: `t` for turns, `r` and `s` for radii with a direction, `d` for
/// the direction alone. The third value is the name in MAVLink, without `MAV_CMD_`.
const COMMANDS: &[(u16, &[u8; 7], &str)] = &[
    (command::WAYPOINT, b"H...LLL", "NAV_WAYPOINT"),
    (command::LOITER_UNLIMITED, b"..s.LLL", "NAV_LOITER_UNLIM"),
    (command::LOITER_TURNS, b"t.roLLL", "NAV_LOITER_TURNS"),
    (command::LOITER_TIME, b"H.doLLL", "NAV_LOITER_TIME"),
    (
        command::RETURN_TO_LAUNCH,
        b".......",
        "NAV_RETURN_TO_LAUNCH",
    ),
    (command::LAND, b"H..dLLL", "NAV_LAND"),
    (command::TAKEOFF, b"H...LLL", "NAV_TAKEOFF"),
    (30, b"H...LLL", "NAV_CONTINUE_AND_CHANGE_ALT"),
    (command::LOITER_TO_ALTITUDE, b".s.oLLL", "NAV_LOITER_TO_ALT"),
    (command::SPLINE_WAYPOINT, b"H...LLL", "NAV_SPLINE_WAYPOINT"),
    (83, b"ffB....", "NAV_ALTITUDE_WAIT"),
    (command::VTOL_TAKEOFF, b"....LLL", "NAV_VTOL_TAKEOFF"),
    (command::VTOL_LAND, b"H...LLL", "NAV_VTOL_LAND"),
    (92, b"H...LLL", "NAV_GUIDED_ENABLE"),
    (command::DELAY, b"fbbb...", "NAV_DELAY"),
    (command::PAYLOAD_PLACE, b"c...LLL", "NAV_PAYLOAD_PLACE"),
    (112, b"f......", "CONDITION_DELAY"),
    (114, b"f......", "CONDITION_DISTANCE"),
    (115, b"ffbB...", "CONDITION_YAW"),
    (command::DO_JUMP, b"Hh.....", "DO_JUMP"),
    (command::DO_CHANGE_SPEED, b"Bff....", "DO_CHANGE_SPEED"),
    (command::DO_SET_HOME, b"H...LLL", "DO_SET_HOME"),
    (181, b"BB.....", "DO_SET_RELAY"),
    (182, b"Bhf....", "DO_REPEAT_RELAY"),
    (183, b"BH.....", "DO_SET_SERVO"),
    (184, b"BHhf...", "DO_REPEAT_SERVO"),
    (
        command::DO_RETURN_PATH_START,
        b"....LLL",
        "DO_RETURN_PATH_START",
    ),
    (command::DO_LAND_START, b"....LLL", "DO_LAND_START"),
    (191, b"....LLL", "DO_GO_AROUND"),
    (193, b"H......", "DO_PAUSE_CONTINUE"),
    (194, b"H......", "DO_SET_REVERSE"),
    (command::DO_SET_ROI, b"H...LLL", "DO_SET_ROI"),
    (202, b"BHBHBBf", "DO_DIGICAM_CONFIGURE"),
    (203, b"BBbBBB.", "DO_DIGICAM_CONTROL"),
    (205, b"fff....", "DO_MOUNT_CONTROL"),
    (206, b"f.B....", "DO_SET_CAM_TRIGG_DIST"),
    (207, b"H......", "DO_FENCE_ENABLE"),
    (208, b"H......", "DO_PARACHUTE"),
    (210, b"H......", "DO_INVERTED_FLIGHT"),
    (211, b"BB.....", "DO_GRIPPER"),
    (212, b"H......", "DO_AUTOTUNE_ENABLE"),
    (213, b"ffB....", "NAV_SET_YAW_SPEED"),
    (215, b"H......", "DO_SET_RESUME_REPEAT_DIST"),
    (216, b"H......", "DO_SPRAYER"),
    (217, b"Hfff...", "DO_SEND_SCRIPT_MESSAGE"),
    (218, b"HB.....", "DO_AUX_FUNCTION"),
    (222, b"Hfff...", "DO_GUIDED_LIMITS"),
    (223, b"ooc1...", "DO_ENGINE_CONTROL"),
    (531, b"Bf.....", "SET_CAMERA_ZOOM"),
    (532, b"Bf.....", "SET_CAMERA_FOCUS"),
    (534, b"BBB....", "SET_CAMERA_SOURCE"),
    (command::JUMP_TAG, b"H......", "JUMP_TAG"),
    (command::DO_JUMP_TAG, b"Hh.....", "DO_JUMP_TAG"),
    (1000, b"bhbbB.B", "DO_GIMBAL_MANAGER_PITCHYAW"),
    (2000, b"BfHH...", "IMAGE_START_CAPTURE"),
    (2001, b"H......", "IMAGE_STOP_CAPTURE"),
    (2500, b"B......", "VIDEO_START_CAPTURE"),
    (2501, b"B......", "VIDEO_STOP_CAPTURE"),
    (3000, b"B......", "DO_VTOL_TRANSITION"),
    (42600, b"BBff...", "DO_WINCH"),
    (42702, b"BBffhh.", "NAV_SCRIPT_TIME"),
    (42703, b"Hhbhh..", "NAV_ATTITUDE_TIME"),
];

pub(super) fn letters(command: u16) -> Option<&'static [u8; 7]> {
    let at = COMMANDS
        .binary_search_by_key(&command, |(number, ..)| *number)
        .ok()?;
    COMMANDS.get(at).map(|(_, letters, _)| *letters)
}

/// The commands that plans may have, by number, with their names in MAVLink.
pub fn commands() -> impl Iterator<Item = (u16, &'static str)> {
    COMMANDS.iter().map(|(number, _, name)| (*number, *name))
}

/// The name of a command that plans may have, as MAVLink spells it, without `MAV_CMD_`.
pub fn name(command: u16) -> Option<&'static str> {
    let at = COMMANDS
        .binary_search_by_key(&command, |(number, ..)| *number)
        .ok()?;
    COMMANDS.get(at).map(|(.., name)| *name)
}

/// Whether the vehicle keeps the command's fifth and sixth parameters as a latitude and a longitude.
pub fn has_place(command: u16) -> bool {
    letters(command).is_some_and(|kept| kept[4] == b'L')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_sorted() {
        assert!(COMMANDS.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
