//! Commands that configure the vehicle or drive its outputs.

use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::{Command, done};
use crate::geo::LatLon;
use crate::sim::autopilot::{Autopilot, Place, factory_parameters};
use crate::sim::port::Link;
use crate::sim::targets::altitude_amsl_m;

/// The first four outputs drive the motors.
const FREE_SERVOS: std::ops::RangeInclusive<usize> = 5..=16;
const RELAYS: std::ops::Range<i32> = 0..6;

pub(super) fn set_home(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if !autopilot.is_ready() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if (command.p[0] - 1.0).abs() < f32::EPSILON {
        let here = autopilot.here();
        autopilot.set_home(here);
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    let at = LatLon::new(command.x, command.y);
    let somewhere = at.is_valid() && !(command.x == 0.0 && command.y == 0.0);
    let altitude = altitude_amsl_m(autopilot, command.frame.unwrap_or(0), f64::from(command.z));
    match altitude {
        Some(altitude_amsl_m) if somewhere && altitude_amsl_m.is_finite() => {
            autopilot.set_home(Place {
                at,
                altitude_amsl_m,
            });
            MavResult::MAV_RESULT_ACCEPTED
        }
        _ => MavResult::MAV_RESULT_FAILED,
    }
}

pub(super) fn set_servo(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let channel = command.p[0] as usize;
    let free = FREE_SERVOS.contains(&channel) && command.p[1].is_finite();
    if free && let Some(servo) = autopilot.servos_us.get_mut(channel - 1) {
        *servo = command.p[1] as u16;
    }
    done(free)
}

pub(super) fn set_relay(_: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    done(RELAYS.contains(&(command.p[0] as i32)) && command.p[0].is_finite())
}

pub(super) fn calibrate(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let asked = command.p.iter().any(|p| *p != 0.0) || command.x != 0.0 || command.y != 0.0;
    if !asked {
        return MavResult::MAV_RESULT_UNSUPPORTED;
    }
    if autopilot.safety.armed {
        autopilot.say(
            MavSeverity::MAV_SEVERITY_NOTICE,
            "Disarm to allow calibration",
        );
        return MavResult::MAV_RESULT_FAILED;
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn storage(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if (command.p[0] - 2.0).abs() > f32::EPSILON {
        return MavResult::MAV_RESULT_DENIED;
    }
    autopilot.parameters = factory_parameters(autopilot.system, &autopilot.airframe);
    autopilot.retune();
    autopilot.say(
        MavSeverity::MAV_SEVERITY_WARNING,
        "All parameters reset, reboot board",
    );
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn reboot(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    match command.p[0] as i32 {
        1 | 3 if autopilot.safety.armed => MavResult::MAV_RESULT_FAILED,
        1 | 3 => {
            autopilot.schedule_reboot();
            MavResult::MAV_RESULT_ACCEPTED
        }
        _ => MavResult::MAV_RESULT_UNSUPPORTED,
    }
}

pub(super) fn banner(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    autopilot.say_banner();
    MavResult::MAV_RESULT_ACCEPTED
}
