//! Commands to servos, relays, motors and other outputs.

use mavlink::dialects::ardupilotmega::{
    MavResult, MavSeverity, ParachuteAction, SafetySwitchState,
};

use super::{Command, FAILED, done};
use crate::autopilot::Autopilot;
use crate::cmd;
use crate::link::Link;
use crate::workbench::{self, MotorTest};

/// `SERVOn_FUNCTION` of outputs that a command may drive: none, RC input through, sprayer, gripper.
const FREE_FUNCTIONS: &[i32] = &[0, 1, 22, 23, 28];
const RC_THROUGH: std::ops::RangeInclusive<i32> = 51..=66;
/// The numbers of the outputs, with and without pins.
const SERVOS: std::ops::RangeInclusive<i32> = 1..=16;
const BACK_SERVOS: std::ops::RangeInclusive<i32> = 17..=32;
const PARACHUTE_DISABLE: i32 = ParachuteAction::PARACHUTE_DISABLE as i32;
const PARACHUTE_ENABLE: i32 = ParachuteAction::PARACHUTE_ENABLE as i32;
const PARACHUTE_RELEASE: i32 = ParachuteAction::PARACHUTE_RELEASE as i32;
const SAFE: i32 = SafetySwitchState::SAFETY_SWITCH_STATE_SAFE as i32;
const DANGEROUS: i32 = SafetySwitchState::SAFETY_SWITCH_STATE_DANGEROUS as i32;

pub(super) fn servo(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(channel), Some(width_us)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    let function = if SERVOS.contains(&channel) {
        autopilot
            .vehicle
            .parameters
            .value(&format!("SERVO{channel}_FUNCTION")) as i32
    } else if BACK_SERVOS.contains(&channel) {
        // A general-purpose input or output.
        -1
    } else {
        return MavResult::MAV_RESULT_FAILED;
    };
    if !FREE_FUNCTIONS.contains(&function) && !RC_THROUGH.contains(&function) {
        let text = format!("ServoRelayEvent: Channel {channel} is already in use");
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        return MavResult::MAV_RESULT_FAILED;
    }
    let place = usize::try_from(channel - 1).ok();
    if let Some(servo) = place.and_then(|place| autopilot.vehicle.servos_us.get_mut(place)) {
        *servo = width_us.clamp(0, i32::from(u16::MAX)) as u16;
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// Switches a relay on or off, or back and forth, which leaves it as it was; the numbers begin at 0.
pub(super) fn relay(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(number), Some(_)) = (command.whole(0), command.whole(1)) else {
        return FAILED;
    };
    let number = u32::try_from(number).ok();
    let bit = number.and_then(|number| 1_u16.checked_shl(number));
    let bit = bit.unwrap_or(0);
    let all = &autopilot.vehicle.parameters;
    done(if command.number == cmd::DO_SET_RELAY {
        let on = command.p[1] > 0.0;
        autopilot.workbench.switch_relay(all, bit, on)
    } else {
        workbench::relays(all) & bit != 0
    })
}

pub(super) fn parachute(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    match command.whole(0) {
        Some(PARACHUTE_DISABLE) => autopilot.workbench.parachute = false,
        Some(PARACHUTE_ENABLE) => autopilot.workbench.parachute = true,
        Some(PARACHUTE_RELEASE) => autopilot.release_parachute(),
        _ => return MavResult::MAV_RESULT_FAILED,
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn safety_switch(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    match command.whole(0) {
        Some(SAFE) => autopilot.workbench.safety_on = true,
        Some(DANGEROUS) => autopilot.workbench.safety_on = false,
        _ => return MavResult::MAV_RESULT_DENIED,
    }
    MavResult::MAV_RESULT_ACCEPTED
}

/// Sets the battery's remaining charge, in percent.
pub(super) fn battery_reset(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let (Some(batteries), Some(_)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if batteries & 1 == 1 {
        let left = f64::from(command.p[1].clamp(0.0, 100.0)) / 100.0;
        autopilot.vehicle.plant.battery.consumed_mah =
            autopilot.vehicle.tuning.battery_capacity_mah * (1.0 - left);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn motor_test(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(motor), Some(kind)) = (command.whole(0), command.whole(1)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if autopilot.workbench.motor_test.is_none() {
        if !autopilot.vehicle.safety.landed {
            autopilot.vehicle.say(
                MavSeverity::MAV_SEVERITY_CRITICAL,
                "Motor Test: vehicle not landed",
            );
            return MavResult::MAV_RESULT_FAILED;
        }
        autopilot
            .vehicle
            .say(MavSeverity::MAV_SEVERITY_INFO, "starting motor test");
    }
    let [_, _, throttle, timeout_s] = command.p;
    let test = MotorTest::new(
        [motor, kind, command.x],
        throttle,
        timeout_s,
        autopilot.vehicle.uptime(),
    );
    autopilot.workbench.motor_test = Some(test);
    MavResult::MAV_RESULT_ACCEPTED
}
