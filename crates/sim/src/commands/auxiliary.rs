//! `DO_AUX_FUNCTION`: functions of a transmitter's switch, triggered by a ground station.

use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::Command;
use crate::autopilot::Autopilot;
use crate::link::Link;
use crate::mode;

/// Positions of the switch.
const LOW: i32 = 0;
const HIGH: i32 = 2;

/// Functions that enter a mode, with its number.
const MODES: &[(i32, u8)] = &[
    (4, mode::RTL),
    (16, mode::AUTO),
    (17, mode::AUTOTUNE),
    (18, mode::LAND),
    (33, mode::BRAKE),
    (42, mode::SMART_RTL),
    (52, mode::ACRO),
    (55, mode::GUIDED),
    (56, mode::LOITER),
    (68, mode::STABILIZE),
    (69, mode::POSHOLD),
    (70, mode::ALT_HOLD),
    (71, mode::FLOWHOLD),
    (72, mode::CIRCLE),
    (73, mode::DRIFT),
];
const ARM_OR_DISARM: i32 = 153;
const DISARM: i32 = 81;
/// Functions that exist but have no effect in the simulation.
const WITHOUT_EFFECT: &[i32] = &[
    2, 3, 5, 7, 9, 10, 11, 13, 14, 15, 19, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 34, 35,
    36, 37, 38, 39, 40, 44, 45, 46, 57, 58, 60, 61, 62, 65, 66, 67, 75, 76, 78, 79, 80, 83, 84, 85,
    90, 99, 100, 101, 102, 103, 104, 105, 106, 109, 110, 111, 112, 151, 152, 154, 156, 158, 159,
    160, 162, 163, 164, 165, 171, 172, 177, 178, 212, 213, 214, 215, 216, 217, 218, 300, 301, 302,
    303, 304, 305, 306, 307,
];
/// Functions that exist but fail.
const FAILING: &[i32] = &[166, 167, 168, 169, 174, 175];

pub(super) fn switch(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(function), Some(position)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if position > HIGH {
        return MavResult::MAV_RESULT_DENIED;
    }
    if let Some((_, number)) = MODES.iter().find(|(known, _)| *known == function) {
        if position == HIGH {
            autopilot.set_mode(*number);
        } else if position == LOW && autopilot.vehicle.flight.mode.number == *number {
            // Returns to the mode of the transmitter's switch.
            autopilot.obey_mode_switch();
        }
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    match function {
        ARM_OR_DISARM if position == HIGH => {
            autopilot.arm(false);
        }
        ARM_OR_DISARM if position == LOW => autopilot.disarm(),
        DISARM if position == HIGH => autopilot.disarm(),
        ARM_OR_DISARM | DISARM => {}
        known if WITHOUT_EFFECT.contains(&known) => {}
        known if FAILING.contains(&known) => return MavResult::MAV_RESULT_FAILED,
        _ => {
            let text = format!("Invalid channel option ({function})");
            autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
            return MavResult::MAV_RESULT_FAILED;
        }
    }
    MavResult::MAV_RESULT_ACCEPTED
}
