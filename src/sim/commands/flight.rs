//! Commands that move the vehicle.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavResult;

use super::{Command, done};
use crate::geo::LatLon;
use crate::sim::autopilot::{Autopilot, Place, Speeds};
use crate::sim::mode;
use crate::sim::port::Link;
use crate::sim::targets::altitude_amsl_m;
use crate::sim::task::{Takeoff, Task};
use crate::sim::yaw::YawDemand;

/// The second parameter that makes arming or disarming ignore what can be ignored.
const FORCE: f32 = 21196.0;
/// `MAV_FRAME_GLOBAL_RELATIVE_ALT`.
const RELATIVE_ALTITUDE: u8 = 3;
/// What a takeoff in a mode with a pilot lifts before the pilot's throttle counts again.
const PILOTED_TAKEOFF_M: f64 = 1.0;
/// A takeoff must go at least this far up.
const LEAST_CLIMB_M: f64 = 0.1;
/// The highest altitude a command may ask for.
const ALTITUDE_MAX_M: f64 = 100_000.0;

pub(super) fn arm_or_disarm(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let [arm, magic, ..] = command.p;
    if (arm - 1.0).abs() < f32::EPSILON {
        return done(autopilot.arm());
    }
    if arm != 0.0 {
        return MavResult::MAV_RESULT_UNSUPPORTED;
    }
    let forced = (magic - FORCE).abs() < 0.5;
    let allowed = forced || autopilot.safety.landed || !autopilot.safety.armed;
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
    // Only custom modes (bit 0) mean anything; fractions are cut off and -1 wraps to 255.
    if (command.p[0] as i32) & 1 == 0 {
        return MavResult::MAV_RESULT_DENIED;
    }
    done(autopilot.set_mode(command.p[1] as i32 as u8))
}

pub(super) fn loiter(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(mode::LOITER))
}

pub(super) fn return_to_launch(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(mode::RTL))
}

pub(super) fn land(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(mode::LAND))
}

pub(super) fn takeoff(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    if command
        .frame
        .is_some_and(|frame| frame != RELATIVE_ALTITUDE)
    {
        return MavResult::MAV_RESULT_DENIED;
    }
    let height_m = f64::from(command.z) - autopilot.home_point().z;
    let climb_m = height_m - autopilot.body.height_m();
    let sensible = climb_m > LEAST_CLIMB_M && climb_m < ALTITUDE_MAX_M;
    let ready = autopilot.safety.armed && autopilot.safety.landed && autopilot.mode.controls_height;
    let flies_itself = autopilot.mode.number == mode::GUIDED;
    let piloted = matches!(autopilot.task, Task::Piloted);
    if !sensible || !ready || !(flies_itself || piloted) {
        return MavResult::MAV_RESULT_FAILED;
    }
    if matches!(autopilot.task, Task::Takeoff(_)) {
        return MavResult::MAV_RESULT_FAILED;
    }
    let height_m = if flies_itself {
        height_m
    } else {
        autopilot.body.height_m() + climb_m.min(PILOTED_TAKEOFF_M)
    };
    let now = autopilot.uptime();
    autopilot.task = Task::Takeoff(Takeoff::new(autopilot.body.position_m, height_m, now));
    autopilot.yaw.settle(autopilot.body.yaw_deg);
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn yaw(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let [angle, rate, direction, relative] = command.p.map(f64::from);
    let known =
        (0.0..=360.0).contains(&angle) && (relative == 0.0 || (relative - 1.0).abs() < 1e-6);
    if !known || !rate.is_finite() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if relative > 0.0 {
        let signed = if direction < 0.0 { -angle } else { angle };
        autopilot.yaw.turn_by(signed, rate);
    } else {
        autopilot.yaw.turn_to(angle, rate, direction);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn change_speed(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let speed = f64::from(command.p[1]);
    if !(speed > 0.0 && speed.is_finite()) {
        return MavResult::MAV_RESULT_FAILED;
    }
    // The autopilot sets climb and descent together: asking for one resets the other.
    let ground_m_s = autopilot.speeds.ground_m_s;
    autopilot.speeds = match command.p[0] as i32 {
        0 | 1 => Speeds {
            ground_m_s: Some(speed),
            ..autopilot.speeds
        },
        2 => Speeds {
            ground_m_s,
            up_m_s: Some(speed),
            down_m_s: None,
        },
        3 => Speeds {
            ground_m_s,
            up_m_s: None,
            down_m_s: Some(speed),
        },
        _ => return MavResult::MAV_RESULT_FAILED,
    };
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn reposition(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let Some(frame) = command.frame else {
        return MavResult::MAV_RESULT_UNSUPPORTED;
    };
    let may_change_mode = (command.p[1] as i32) & 1 == 1;
    let at = LatLon::new(command.x, command.y);
    if autopilot.mode.number != mode::GUIDED && !may_change_mode {
        return MavResult::MAV_RESULT_DENIED;
    }
    if !at.is_valid() || (command.x == 0.0 && command.y == 0.0) || !command.z.is_finite() {
        return MavResult::MAV_RESULT_DENIED;
    }
    let Some(altitude_amsl_m) = altitude_amsl_m(autopilot, frame, f64::from(command.z)) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if !autopilot.set_mode(mode::GUIDED) {
        return MavResult::MAV_RESULT_FAILED;
    }
    if !autopilot.safety.landed {
        let goal = autopilot.point_of(Place {
            at,
            altitude_amsl_m,
        });
        autopilot.go_to(goal, DVec3::ZERO);
        autopilot.yaw.demand = autopilot.default_yaw();
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn pause_or_continue(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    if autopilot.mode.number == mode::AUTO {
        return super::plan::pause_or_continue(autopilot, command);
    }
    if autopilot.mode.number != mode::GUIDED || autopilot.safety.landed {
        return MavResult::MAV_RESULT_FAILED;
    }
    match command.p[0] as i32 {
        0 => {
            if autopilot.paused.is_none() {
                let interrupted = std::mem::replace(&mut autopilot.task, Task::STOP);
                autopilot.paused = Some(interrupted);
            }
        }
        1 => {
            if let Some(task) = autopilot.paused.take() {
                autopilot.task = task;
            }
        }
        _ => return MavResult::MAV_RESULT_DENIED,
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn look_at(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    let at = LatLon::new(command.x, command.y);
    if !at.is_valid() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if command.x == 0.0 && command.y == 0.0 {
        return look_ahead(autopilot, link, command);
    }
    let (north, east) = autopilot.start.at.offset_to(at);
    autopilot.yaw.demand = YawDemand::Towards(glam::DVec2::new(north, east));
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn look_ahead(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    autopilot.yaw.demand = autopilot.default_yaw();
    MavResult::MAV_RESULT_ACCEPTED
}
