//! Calibrations on the ground.

use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::link::Link;

/// The parameter that accepts the existing calibration.
const FORCE: f32 = 76.0;
const FORCE_WHOLE: i32 = 76;

/// Gyros, barometer, accelerometers, level.
pub(super) fn preflight(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
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
        return says(autopilot, &["Initialising ArduPilot"]);
    }
    if command.is(2, 1.0) {
        let texts = [
            "Updating barometer calibration",
            "Barometer calibration complete",
        ];
        return says(autopilot, &texts);
    }
    match command.x {
        1 => says(autopilot, &["Initialising ArduPilot"]),
        2 | 4 | FORCE_WHOLE => MavResult::MAV_RESULT_ACCEPTED,
        _ if command.is(1, FORCE) => MavResult::MAV_RESULT_ACCEPTED,
        _ => MavResult::MAV_RESULT_UNSUPPORTED,
    }
}

/// The compasses of a command, a bit each; zero means all. `None` if there is another bit.
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
