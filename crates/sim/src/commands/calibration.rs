//! Calibrations on the ground.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, MavCmd, MavMessage, MavResult, MavSeverity,
};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::link::Link;

/// The parameter value that accepts the existing calibration.
const FORCE: f32 = 76.0;
const FORCE_WHOLE: i32 = 76;
/// Values of the fifth parameter for a calibration in one position: of the level, and of the
/// accelerometers.
const LEVEL: i32 = 2;
const SIMPLE: i32 = 4;
const BRIEFLY_APART: Duration = Duration::from_secs(5);

/// Calibrates the gyros, the barometer, the accelerometers or the level.
pub(super) fn preflight(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    if autopilot.vehicle.safety.armed {
        autopilot.vehicle.say(
            MavSeverity::MAV_SEVERITY_NOTICE,
            "Disarm to allow calibration",
        );
        return MavResult::MAV_RESULT_FAILED;
    }
    let says = |autopilot: &mut Autopilot, texts: &[&str]| {
        for text in texts {
            autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
        }
        MavResult::MAV_RESULT_ACCEPTED
    };
    if command.is(0, 1.0) {
        initialise(autopilot);
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    if command.is(2, 1.0) {
        let texts = [
            "Updating barometer calibration",
            "Barometer calibration complete",
        ];
        // The airspeed sensors are calibrated afterwards: there are none, so this ends at once.
        link.reply(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command: MavCmd::MAV_CMD_PREFLIGHT_CALIBRATION,
            result: MavResult::MAV_RESULT_IN_PROGRESS,
            ..Default::default()
        }));
        return says(autopilot, &texts);
    }
    if command.y == 1 {
        let result = says(autopilot, &["Starting calibration", "Current"]);
        initialise(autopilot);
        return result;
    }
    autopilot.workbench.radio_calibrates = command.p[3] > 0.0;
    match command.x {
        1 => {
            initialise(autopilot);
            says(autopilot, &["Place vehicle level and press any key."])
        }
        LEVEL => {
            let result = calibrate_briefly(autopilot);
            if result == MavResult::MAV_RESULT_ACCEPTED {
                initialise(autopilot);
                says(autopilot, &["Trim OK: roll=0.01 pitch=-0.01 yaw=0.00"]);
            }
            result
        }
        SIMPLE => calibrate_briefly(autopilot),
        FORCE_WHOLE => MavResult::MAV_RESULT_ACCEPTED,
        _ if command.is(1, FORCE) => MavResult::MAV_RESULT_ACCEPTED,
        _ => MavResult::MAV_RESULT_UNSUPPORTED,
    }
}

/// Reports a calibration that keeps the vehicle busy, at most every five seconds.
fn initialise(autopilot: &mut Autopilot) {
    let now = autopilot.vehicle.uptime();
    let last = &mut autopilot.workbench.initialised_at;
    if last.is_none_or(|at| now >= at + BRIEFLY_APART) {
        *last = Some(now);
        let text = "Initialising ArduPilot";
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
    }
}

/// Calibrates the level, or the accelerometers in one position; refused within five seconds of the
/// last calibration or of the boot.
fn calibrate_briefly(autopilot: &mut Autopilot) -> MavResult {
    let now = autopilot.vehicle.uptime();
    let last = &mut autopilot.workbench.accelerometers_calibrated;
    if now < *last + BRIEFLY_APART {
        return MavResult::MAV_RESULT_TEMPORARILY_REJECTED;
    }
    *last = now;
    MavResult::MAV_RESULT_ACCEPTED
}

/// The compasses of a command, a bit each; zero means all. `None` if the value is out of range.
fn compasses(command: &Command) -> Option<u8> {
    let asked = command.p[0];
    (0.0..=255.0).contains(&asked).then_some(asked as u8)
}

pub(super) fn start_compass(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    if autopilot.vehicle.safety.armed {
        autopilot.vehicle.say(
            MavSeverity::MAV_SEVERITY_NOTICE,
            "Disarm to allow compass calibration",
        );
        return MavResult::MAV_RESULT_FAILED;
    }
    done(compasses(command).is_some_and(|mask| autopilot.workbench.compasses.start(mask)))
}

pub(super) fn accept_compass(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    done(compasses(command).is_some_and(|mask| autopilot.workbench.compasses.accept(mask)))
}

pub(super) fn cancel_compass(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let Some(mask) = compasses(command) else {
        return MavResult::MAV_RESULT_FAILED;
    };
    autopilot.workbench.compasses.cancel(mask);
    MavResult::MAV_RESULT_ACCEPTED
}
