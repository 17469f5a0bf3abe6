//! Commands that configure the vehicle.

use mavlink::dialects::ardupilotmega::{
    MavResult, MavSeverity, PreflightStorageParameterAction, RebootShutdownAction,
};

use super::{Command, done, motion};
use crate::autopilot::Autopilot;
use crate::frame::{self, HeightOrigin};
use crate::link::Link;

/// The value of the sixth parameter that forces a reboot of an armed vehicle.
const FORCE_REBOOT: i32 = 20_190_226;
/// The value of the first parameter of `PREFLIGHT_STORAGE` that restores the defaults.
const ERASE: f32 = PreflightStorageParameterAction::PARAM_RESET_FACTORY_DEFAULT as u8 as f32;
/// The values of the first parameter of `PREFLIGHT_REBOOT_SHUTDOWN` that the vehicle supports.
const REBOOT: f32 = RebootShutdownAction::REBOOT_SHUTDOWN_ACTION_REBOOT as u8 as f32;
const REBOOT_TO_BOOTLOADER: f32 =
    RebootShutdownAction::REBOOT_SHUTDOWN_ACTION_REBOOT_TO_BOOTLOADER as u8 as f32;

pub(super) fn set_home(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if !autopilot.vehicle.is_ready() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if command.is(0, 1.0) || (command.x, command.y) == (0, 0) {
        autopilot.vehicle.set_home_here();
        autopilot.vehicle.datum.lock_home();
        autopilot.vehicle.tell_home();
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    if command.p[0] != 0.0 {
        return MavResult::MAV_RESULT_FAILED;
    }
    let Some(place) = motion::place(autopilot, command, command.frame.unwrap_or(frame::GLOBAL))
    else {
        return MavResult::MAV_RESULT_DENIED;
    };
    done(
        autopilot.vehicle.datum.may_be_home(place) && {
            autopilot.vehicle.set_home(place);
            autopilot.vehicle.datum.lock_home();
            autopilot.vehicle.tell_home();
            true
        },
    )
}

/// Accepts the system id of a vehicle to follow. It has no effect, since the FOLLOW mode is not enabled.
pub(super) fn follow(_: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if command.p[0] > 0.0 && command.p[0] <= 255.0 {
        MavResult::MAV_RESULT_ACCEPTED
    } else {
        MavResult::MAV_RESULT_DENIED
    }
}

/// Accepts the sources 1 to 3 of the estimator.
pub(super) fn estimator_source(_: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    match command.whole(0) {
        Some(1..=3) => MavResult::MAV_RESULT_ACCEPTED,
        _ => MavResult::MAV_RESULT_DENIED,
    }
}

/// Handles a position from outside, which must come as a `COMMAND_INT` in a global frame and
/// without an altitude. A valid one fails, because the estimator has a position of its own.
pub(super) fn external_position(_: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    match command.frame {
        None => MavResult::MAV_RESULT_UNSUPPORTED,
        Some(frame)
            if HeightOrigin::of(frame) == Some(HeightOrigin::Sea)
                && command.z.is_nan()
                && command.at().is_valid() =>
        {
            MavResult::MAV_RESULT_FAILED
        }
        Some(_) => MavResult::MAV_RESULT_DENIED,
    }
}

pub(super) fn high_latency(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let text = if command.is(0, 1.0) {
        "High Latency enabled"
    } else {
        "High Latency disabled"
    };
    autopilot
        .vehicle
        .say(MavSeverity::MAV_SEVERITY_NOTICE, text);
    MavResult::MAV_RESULT_ACCEPTED
}

/// Reports the failing pre-arm checks.
pub(super) fn run_checks(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    if autopilot.vehicle.safety.armed {
        return MavResult::MAV_RESULT_TEMPORARILY_REJECTED;
    }
    for reason in autopilot.arming_checks().obstacles() {
        let text = format!("PreArm: {reason}");
        autopilot
            .vehicle
            .say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// Erases the stored values, even in flight; active values stay until the reboot.
pub(super) fn storage(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if !command.is(0, ERASE) {
        return MavResult::MAV_RESULT_DENIED;
    }
    autopilot.workbench.erased = true;
    autopilot.vehicle.say(
        MavSeverity::MAV_SEVERITY_WARNING,
        "All parameters reset, reboot board",
    );
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn reboot(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if autopilot.vehicle.safety.armed && command.y != FORCE_REBOOT {
        return MavResult::MAV_RESULT_FAILED;
    }
    if !command.is(0, REBOOT) && !command.is(0, REBOOT_TO_BOOTLOADER) {
        return MavResult::MAV_RESULT_UNSUPPORTED;
    }
    autopilot.schedule_reboot();
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn banner(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    autopilot.vehicle.say_banner();
    MavResult::MAV_RESULT_ACCEPTED
}
