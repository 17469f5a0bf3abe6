//! Commands that arm, change the mode, take off and end the flight.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MavModeFlag, MavModeFlagDecodePosition, MavResult, MavSeverity,
};

use super::{Command, done};
use crate::arming::ArmingMethod;
use crate::autopilot::Autopilot;
use crate::frame::GLOBAL_RELATIVE_ALT;
use crate::link::Link;
use crate::mode::{self, ModeId};
use crate::task::{Takeoff, Task};

/// The value of the second parameter with which disarming works in the air.
const FORCE: f32 = 21196.0;
/// The value of the second parameter with which arming skips the optional checks.
const FORCE_ARMING: f32 = 2989.0;
/// The maximum climb of a takeoff in a piloted mode with the throttle down, in metres: above it,
/// the throttle takes effect again.
const PILOTED_TAKEOFF_M: f64 = 1.0;
const ALTITUDE_MAX_M: f64 = 83_000.0;
/// Bits of the base mode: the custom mode is valid; the message sets the safety switch.
const CUSTOM_MODE: i32 = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED.bits() as i32;
const SAFETY_SWITCH: i32 =
    MavModeFlagDecodePosition::MAV_MODE_FLAG_DECODE_POSITION_SAFETY.bits() as i32;
/// The time after which BRAKE by the pause button turns into LOITER.
const PAUSE_BUTTON_BRAKE: Duration = Duration::from_millis(2500);

pub(super) fn arm_or_disarm(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    if command.is(0, 1.0) {
        let method = if command.is(1, FORCE_ARMING) {
            ArmingMethod::ForcedCommand
        } else {
            ArmingMethod::Command
        };
        return done(autopilot.arm(method));
    }
    if command.p[0] != 0.0 {
        return MavResult::MAV_RESULT_UNSUPPORTED;
    }
    let forced = (command.p[1] - FORCE).abs() < 0.5;
    let safety = &autopilot.vehicle.safety;
    // A rover is disarmed wherever it is.
    let drives = autopilot.vehicle.kind.chassis().is_some();
    let allowed = forced || safety.landed || !safety.armed || drives;
    if allowed {
        autopilot.disarm();
    }
    done(allowed)
}

pub(super) fn terminate(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if command.p[0] > 0.5 {
        autopilot.disarm();
        MavResult::MAV_RESULT_ACCEPTED
    } else {
        MavResult::MAV_RESULT_FAILED
    }
}

pub(super) fn set_mode(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(base), Some(custom)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if base & CUSTOM_MODE != 0 {
        // Fractions are truncated, and -1 wraps to 255.
        return done(autopilot.set_mode_numbered(custom as u8));
    }
    if base == SAFETY_SWITCH && (custom == 0 || custom == 1) {
        autopilot.workbench.safety_on = custom == 1;
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    MavResult::MAV_RESULT_DENIED
}

pub(super) fn loiter(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(ModeId::Loiter))
}

pub(super) fn return_to_launch(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(ModeId::Rtl))
}

pub(super) fn land(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(ModeId::Land))
}

/// Continues at the nearest leg of a return path.
pub(super) fn start_return_path(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    if autopilot.fly_return_path() {
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    autopilot.vehicle.say(
        MavSeverity::MAV_SEVERITY_WARNING,
        "Mode change to AUTO RTL failed: No return path found",
    );
    MavResult::MAV_RESULT_FAILED
}

pub(super) fn takeoff(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if command
        .frame
        .is_some_and(|frame| frame != GLOBAL_RELATIVE_ALT)
    {
        return MavResult::MAV_RESULT_DENIED;
    }
    // With a third parameter of zero, the vehicle must be able to hold its position.
    let navigates = command.p[2] == 0.0;
    done(take_off(autopilot, f64::from(command.z), navigates))
}

/// Solo's fly button: LOITER, or `ALT_HOLD` if that is impossible.
pub(super) fn fly_button(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    if !autopilot.set_mode(ModeId::Loiter) {
        autopilot.set_mode(ModeId::AltHold);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// The fly button held down: arms, takes off or lands.
pub(super) fn fly_button_held(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    if !autopilot.vehicle.safety.armed {
        autopilot.arm(ArmingMethod::Command);
    } else if autopilot.vehicle.safety.landed {
        if autopilot.set_mode(ModeId::Loiter) {
            take_off(autopilot, f64::from(command.p[0]), true);
        }
    } else {
        autopilot.set_mode(ModeId::Land);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// Solo's pause button: disarms on the ground, brakes in the air.
pub(super) fn pause_button(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    if !autopilot.vehicle.safety.armed {
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    let takes_pictures = command.p[0] != 0.0 && mode::is_guided(autopilot.vehicle.flight.mode.id);
    if autopilot.vehicle.safety.landed {
        autopilot.disarm();
    } else if !takes_pictures {
        if autopilot.set_mode(ModeId::Brake) {
            autopilot.vehicle.flight.brake_until =
                Some(autopilot.vehicle.uptime() + PAUSE_BUTTON_BRAKE);
        } else {
            autopilot.set_mode(ModeId::AltHold);
        }
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// Takes off to a height above home in metres, if the mode and the state allow it.
fn take_off(autopilot: &mut Autopilot, above_home_m: f64, navigates: bool) -> bool {
    let vehicle = &mut autopilot.vehicle;
    let asked_m = above_home_m - vehicle.datum.home_point().z;
    let climb_m = asked_m - vehicle.believed().height_m();
    let sensible = climb_m > 0.0 && climb_m < ALTITUDE_MAX_M;
    let able = mode::takes_off(vehicle.flight.mode.id, navigates);
    if !vehicle.safety.armed || !vehicle.safety.landed || !able || !sensible {
        return false;
    }
    // From here on, AUTO can be entered without a raised throttle.
    autopilot.auto_plan.allow_lifting();
    let guided = vehicle.flight.mode.id == ModeId::Guided;
    let height_m = if !guided && vehicle.sticks().throttle_is_low() {
        vehicle.believed().height_m() + climb_m.min(PILOTED_TAKEOFF_M)
    } else {
        asked_m
    };
    if let Task::Takeoff(takeoff) = &mut vehicle.flight.task {
        takeoff.goal_m.z = -height_m;
        return true;
    }
    let begins = vehicle.safety.takeoff_begins(vehicle.uptime());
    let from_m = vehicle.believed().position_m;
    vehicle.flight.task = Task::Takeoff(Takeoff::new(from_m, height_m, begins));
    vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
    true
}
