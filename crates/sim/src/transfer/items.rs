//! The stored form of an item: storage is small, and parts that do not fit are truncated or dropped, and a download
//! shows the item as it will be flown.

use std::ops::RangeInclusive;

use mavlink::dialects::ardupilotmega::MavMissionResult::{
    self, MAV_MISSION_INVALID, MAV_MISSION_INVALID_PARAM1, MAV_MISSION_INVALID_PARAM2,
    MAV_MISSION_INVALID_PARAM3, MAV_MISSION_INVALID_PARAM4, MAV_MISSION_INVALID_PARAM5_X,
    MAV_MISSION_INVALID_PARAM6_Y, MAV_MISSION_INVALID_PARAM7, MAV_MISSION_UNSUPPORTED,
    MAV_MISSION_UNSUPPORTED_FRAME,
};

use crate::cmd;
use crate::frame::{self, HeightOrigin};
use crate::plan::Item;
use sortie_geo::LatLon;

/// Altitudes of this many metres and more do not fit.
const ALTITUDE_LIMIT_M: f32 = 83_000.0;

/// Numbers that the vehicle uses internally and refuses in items.
const NEVER_COMMANDS: RangeInclusive<u16> = 0..=1;

/// How the seven parameters of each command are stored, one letter each: `.` not at all, `B` and `b` as an unsigned and
/// a signed byte, `H` and `h` as 16 bits, `f` as a float, `c` in hundredths, `o` as a flag, `L` as part of a place, and
/// four that only loiters and landings have: `t` turns, `r` and `s` radii with a direction, `d` the direction alone.
const COMMANDS: &[(u16, &[u8; 7])] = &[
    (cmd::NAV_WAYPOINT, b"H...LLL"),
    (cmd::NAV_LOITER_UNLIM, b"..s.LLL"),
    (cmd::NAV_LOITER_TURNS, b"t.roLLL"),
    (cmd::NAV_LOITER_TIME, b"H.doLLL"),
    (cmd::NAV_RETURN_TO_LAUNCH, b"......."),
    (cmd::NAV_LAND, b"H..dLLL"),
    (cmd::NAV_TAKEOFF, b"H...LLL"),
    (cmd::NAV_CONTINUE_AND_CHANGE_ALT, b"H...LLL"),
    (cmd::NAV_LOITER_TO_ALT, b".s.oLLL"),
    (cmd::NAV_SPLINE_WAYPOINT, b"H...LLL"),
    (cmd::NAV_ALTITUDE_WAIT, b"ffB...."),
    (cmd::NAV_VTOL_TAKEOFF, b"....LLL"),
    (cmd::NAV_VTOL_LAND, b"H...LLL"),
    (cmd::NAV_GUIDED_ENABLE, b"H...LLL"),
    (cmd::NAV_DELAY, b"fbbb..."),
    (cmd::NAV_PAYLOAD_PLACE, b"c...LLL"),
    (cmd::CONDITION_DELAY, b"f......"),
    (cmd::CONDITION_DISTANCE, b"f......"),
    (cmd::CONDITION_YAW, b"ffbB..."),
    (cmd::DO_JUMP, b"Hh....."),
    (cmd::DO_CHANGE_SPEED, b"Bff...."),
    (cmd::DO_SET_HOME, b"H...LLL"),
    (cmd::DO_SET_RELAY, b"BB....."),
    (cmd::DO_REPEAT_RELAY, b"Bhf...."),
    (cmd::DO_SET_SERVO, b"BH....."),
    (cmd::DO_REPEAT_SERVO, b"BHhf..."),
    (cmd::DO_RETURN_PATH_START, b"....LLL"),
    (cmd::DO_LAND_START, b"....LLL"),
    (cmd::DO_GO_AROUND, b"....LLL"),
    (cmd::DO_PAUSE_CONTINUE, b"H......"),
    (cmd::DO_SET_REVERSE, b"H......"),
    (cmd::DO_SET_ROI, b"H...LLL"),
    (cmd::DO_DIGICAM_CONFIGURE, b"BHBHBBf"),
    (cmd::DO_DIGICAM_CONTROL, b"BBbBBB."),
    (cmd::DO_MOUNT_CONTROL, b"fff...."),
    (cmd::DO_SET_CAM_TRIGG_DIST, b"f.B...."),
    (cmd::DO_FENCE_ENABLE, b"H......"),
    (cmd::DO_PARACHUTE, b"H......"),
    (cmd::DO_INVERTED_FLIGHT, b"H......"),
    (cmd::DO_GRIPPER, b"BB....."),
    (cmd::DO_AUTOTUNE_ENABLE, b"H......"),
    (cmd::NAV_SET_YAW_SPEED, b"ffB...."),
    (cmd::DO_SET_RESUME_REPEAT_DIST, b"H......"),
    (cmd::DO_SPRAYER, b"H......"),
    (cmd::DO_SEND_SCRIPT_MESSAGE, b"Hfff..."),
    (cmd::DO_AUX_FUNCTION, b"HB....."),
    (cmd::DO_GUIDED_LIMITS, b"Hfff..."),
    (cmd::DO_ENGINE_CONTROL, b"ooco..."),
    (cmd::SET_CAMERA_ZOOM, b"Bf....."),
    (cmd::SET_CAMERA_FOCUS, b"Bf....."),
    (cmd::SET_CAMERA_SOURCE, b"BBB...."),
    (cmd::JUMP_TAG, b"H......"),
    (cmd::DO_JUMP_TAG, b"Hh....."),
    (cmd::DO_GIMBAL_MANAGER_PITCHYAW, b"bhbbB.B"),
    (cmd::IMAGE_START_CAPTURE, b"BfHH..."),
    (cmd::IMAGE_STOP_CAPTURE, b"H......"),
    (cmd::VIDEO_START_CAPTURE, b"B......"),
    (cmd::VIDEO_STOP_CAPTURE, b"B......"),
    (cmd::DO_VTOL_TRANSITION, b"B......"),
    (cmd::DO_WINCH, b"BBff..."),
    (cmd::NAV_SCRIPT_TIME, b"BBffhh."),
    (cmd::NAV_ATTITUDE_TIME, b"Hhbhh.."),
];

fn letters(command: u16) -> Option<&'static [u8; 7]> {
    let at = COMMANDS
        .binary_search_by_key(&command, |(number, _)| *number)
        .ok()?;
    COMMANDS.get(at).map(|(_, letters)| *letters)
}

/// Whether the command's fifth and sixth parameters are a latitude and a longitude.
pub(super) fn has_place(command: u16) -> bool {
    letters(command).is_some_and(|kept| kept[4] == b'L')
}

/// The item of a mission as the vehicle keeps it, or the reason to refuse it.
pub(super) fn mission_item(item: &Item) -> Result<Item, MavMissionResult> {
    check_numbers(item)?;
    if NEVER_COMMANDS.contains(&item.command) {
        return Err(MAV_MISSION_INVALID);
    }
    let kept = letters(item.command).ok_or(MAV_MISSION_UNSUPPORTED)?;
    let mut stored = Item {
        command: item.command,
        auto_continue: true,
        ..Item::default()
    };
    for (place, value) in item.p.iter().enumerate() {
        stored.p[place] = shortened(kept[place], *value);
    }
    if kept[4] == b'L' {
        check_place(item)?;
        if item.z.is_nan() || item.z.abs() >= ALTITUDE_LIMIT_M {
            return Err(MAV_MISSION_INVALID_PARAM7);
        }
        stored.x = item.x;
        stored.y = item.y;
        stored.z = (item.z * 100.0).trunc() * 0.01;
        stored.frame = match item.frame {
            frame::MISSION => HeightOrigin::Sea.frame(),
            other => height_frame(other)?,
        };
    } else {
        stored.x = shortened(kept[4], item.x as f32) as i32;
        stored.y = shortened(kept[5], item.y as f32) as i32;
        stored.z = shortened(kept[6], item.z);
    }
    Ok(stored)
}

/// A rally point as the vehicle keeps it, or the reason to refuse it.
pub(super) fn rally_item(item: &Item) -> Result<Item, MavMissionResult> {
    if item.command != cmd::NAV_RALLY_POINT {
        return Err(MAV_MISSION_UNSUPPORTED);
    }
    check_place(item)?;
    // Whole metres in 16 bits.
    if item.z.is_nan() || item.z < f32::from(i16::MIN) || item.z > f32::from(i16::MAX) {
        return Err(MAV_MISSION_INVALID_PARAM7);
    }
    Ok(Item {
        command: item.command,
        frame: height_frame(item.frame)?,
        x: item.x,
        y: item.y,
        z: item.z.trunc(),
        ..Item::default()
    })
}

/// A corner, circle or return point of a fence as the vehicle keeps it, or the reason to refuse it. The fence as a
/// whole is checked when it is complete.
pub(super) fn fence_item(item: &Item) -> Result<Item, MavMissionResult> {
    height_frame(item.frame)?;
    let first = match item.command {
        cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION | cmd::NAV_FENCE_POLYGON_VERTEX_EXCLUSION => {
            f32::from(item.p[0] as u8)
        }
        // Radii close to whole metres are kept as whole metres.
        cmd::NAV_FENCE_CIRCLE_INCLUSION | cmd::NAV_FENCE_CIRCLE_EXCLUSION
            if item.p[0].fract() < 0.001 =>
        {
            item.p[0].trunc()
        }
        cmd::NAV_FENCE_CIRCLE_INCLUSION | cmd::NAV_FENCE_CIRCLE_EXCLUSION => item.p[0],
        cmd::NAV_FENCE_RETURN_POINT => 0.0,
        _ => return Err(MAV_MISSION_UNSUPPORTED),
    };
    Ok(Item {
        command: item.command,
        p: [first, 0.0, 0.0, 0.0],
        x: item.x,
        y: item.y,
        ..Item::default()
    })
}

fn check_place(item: &Item) -> Result<(), MavMissionResult> {
    if !LatLon::from_e7(item.x, 0).is_valid() {
        return Err(MAV_MISSION_INVALID_PARAM5_X);
    }
    if !LatLon::from_e7(0, item.y).is_valid() {
        return Err(MAV_MISSION_INVALID_PARAM6_Y);
    }
    Ok(())
}

/// Refuses infinite parameters, and NaN except where it means "as it is".
fn check_numbers(item: &Item) -> Result<(), MavMissionResult> {
    let may_be_nan: &[usize] = match item.command {
        cmd::NAV_WAYPOINT | cmd::NAV_LAND | cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF => &[3],
        cmd::NAV_VTOL_LAND => &[2, 3],
        _ => &[],
    };
    let reasons = [
        MAV_MISSION_INVALID_PARAM1,
        MAV_MISSION_INVALID_PARAM2,
        MAV_MISSION_INVALID_PARAM3,
        MAV_MISSION_INVALID_PARAM4,
    ];
    for (place, reason) in reasons.into_iter().enumerate() {
        let value = item.p[place];
        if value.is_infinite() || (value.is_nan() && !may_be_nan.contains(&place)) {
            return Err(reason);
        }
    }
    Ok(())
}

/// The frame as it appears in a download: sea level, home, terrain.
fn height_frame(frame: u8) -> Result<u8, MavMissionResult> {
    HeightOrigin::of(frame)
        .map(HeightOrigin::frame)
        .ok_or(MAV_MISSION_UNSUPPORTED_FRAME)
}

fn shortened(letter: u8, value: f32) -> f32 {
    let direction = if value < 0.0 { -1.0 } else { 1.0 };
    match letter {
        b't' if value > 0.0 && value < 1.0 => (value * 256.0).trunc() / 256.0,
        b'B' | b't' => f32::from(value as u8),
        b'b' => f32::from(value as i8),
        b'H' => f32::from(value as u16),
        b'h' => f32::from(value as i16),
        b'f' if value.is_finite() => value,
        b'c' => f32::from((value * 100.0) as u16) / 100.0,
        b'o' => f32::from(u8::from(value > 0.0)),
        b'r' if value.abs() <= 255.0 => direction * value.abs().trunc(),
        b'r' => direction * 10.0 * f32::from((value.abs() * 0.1) as u8),
        b's' => direction * f32::from(value.abs() as u16),
        b'd' => direction,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(command: u16, p: [f32; 4]) -> Item {
        Item {
            command,
            frame: frame::GLOBAL_RELATIVE_ALT,
            p,
            x: -353_632_620,
            y: 1_491_652_370,
            z: 20.25,
            ..Item::default()
        }
    }

    #[test]
    fn the_commands_are_sorted() {
        assert!(COMMANDS.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn parameters_are_kept_as_the_storage_allows() {
        for (command, sent, kept) in [
            (16, [3.9, 5.0, 6.0, f32::NAN], [3.0, 0.0, 0.0, 0.0]),
            (18, [0.5, 0.0, -80.0, 1.0], [0.5, 0.0, -80.0, 1.0]),
            (18, [3.0, 0.0, 777.0, 0.0], [3.0, 0.0, 770.0, 0.0]),
            (19, [30.0, 0.0, 0.0, 0.0], [30.0, 0.0, 1.0, 0.0]),
            (21, [0.0, 0.0, 0.0, f32::NAN], [0.0, 0.0, 0.0, 1.0]),
            (93, [5.0, -1.0, -1.0, -1.0], [5.0, -1.0, -1.0, -1.0]),
            (177, [2.0, -1.0, 0.0, 0.0], [2.0, -1.0, 0.0, 0.0]),
            (178, [1.0, 4.5, -1.0, 9.0], [1.0, 4.5, -1.0, 0.0]),
            (183, [9.0, 1700.0, 0.0, 0.0], [9.0, 1700.0, 0.0, 0.0]),
        ] {
            let stored = mission_item(&item(command, sent)).expect("known");
            let stored = stored.p.map(f32::to_bits);
            assert_eq!(stored, kept.map(f32::to_bits), "command {command}");
        }
    }

    #[test]
    fn places_are_kept_only_by_commands_that_have_one() {
        let waypoint = mission_item(&item(16, [0.0; 4])).expect("known");
        assert_eq!((waypoint.frame, waypoint.x), (3, -353_632_620));
        assert!((waypoint.z - 20.25).abs() < 0.011);
        let home = mission_item(&item(20, [0.0; 4])).expect("known");
        assert_eq!((home.frame, home.x, home.y), (0, 0, 0));
    }

    #[test]
    fn what_cannot_be_kept_is_refused_with_its_reason() {
        let far = Item {
            x: 910_000_000,
            ..item(16, [0.0; 4])
        };
        let frame = Item {
            frame: 12,
            ..item(16, [0.0; 4])
        };
        let nan = Item {
            z: f32::NAN,
            ..item(16, [0.0; 4])
        };
        for (bad, reason) in [
            (item(31_010, [0.0; 4]), MAV_MISSION_UNSUPPORTED),
            (item(195, [0.0; 4]), MAV_MISSION_UNSUPPORTED),
            (item(1, [0.0; 4]), MAV_MISSION_INVALID),
            (
                item(16, [f32::NAN, 0.0, 0.0, 0.0]),
                MAV_MISSION_INVALID_PARAM1,
            ),
            (far, MAV_MISSION_INVALID_PARAM5_X),
            (frame, MAV_MISSION_UNSUPPORTED_FRAME),
            (nan, MAV_MISSION_INVALID_PARAM7),
        ] {
            assert_eq!(mission_item(&bad), Err(reason), "{bad:?}");
        }
    }
}
