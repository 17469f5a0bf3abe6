//! Setpoints for a rover in GUIDED: places, headings with a speed, turn rates with a speed.

use std::time::Duration;

use super::{AttitudeTarget, Setpoint, goal_of, is_body_frame, is_frame_known, quaternion};
use crate::autopilot::Autopilot;
use crate::mask::{ACCELERATION, POSITION, VELOCITY, YAW, YAW_RATE};
use crate::mode::ModeId;
use crate::task::{Drive, DriveSetpoint, SetpointCourse, Task};
use glam::EulerRot;
use sortie_geo::{maths, wrap_180};

/// The time after which a setpoint ends.
const LASTS: Duration = Duration::from_secs(3);

/// Whether the rover takes setpoints now.
fn is_guided(autopilot: &Autopilot) -> bool {
    autopilot.vehicle.flight.mode.id == ModeId::Guided || autopilot.auto_plan.is_guided()
}

/// Carries out a setpoint. Outside GUIDED, and with an unknown frame or an unknown choice of fields, it is silently
/// ignored.
pub(super) fn take_setpoint(autopilot: &mut Autopilot, setpoint: &Setpoint) {
    if !is_guided(autopilot) || !is_frame_known(setpoint) {
        return;
    }
    if asks(setpoint, POSITION) {
        if let Some(goal_m) = goal_of(&autopilot.vehicle, setpoint).filter(|goal| goal.is_finite())
        {
            autopilot.drive_to(goal_m);
        }
        return;
    }
    let speed_m_s = speed_m_s(autopilot, setpoint);
    if let Some(wanted) = wanted(autopilot, setpoint).filter(|_| speed_m_s.is_finite()) {
        set(autopilot, wanted, speed_m_s);
    }
}

/// Carries out an attitude target: the thrust is a share of the default speed; the yaw or its rate sets the direction.
pub(super) fn take_attitude(autopilot: &mut Autopilot, asked: &AttitudeTarget) {
    let rate = f64::from(asked.rates_rad_s[2]);
    if !is_guided(autopilot) || asked.mask & super::NO_THRUST != 0 || !asked.thrust.is_finite() {
        return;
    }
    let speed_m_s = f64::from(asked.thrust.clamp(-1.0, 1.0)) * default_speed_m_s(autopilot);
    let (yaw, ..) = quaternion(asked.q).normalize().to_euler(EulerRot::ZYX);
    let wanted = if asked.mask & super::NO_YAW_RATE == 0 {
        SetpointCourse::TurnRate(rate.to_degrees())
    } else {
        SetpointCourse::Heading(yaw.to_degrees())
    };
    if rate.is_finite() && yaw.is_finite() {
        set(autopilot, wanted, speed_m_s);
    }
}

/// Drives along a heading, as long as a setpoint lasts.
pub(crate) fn drive_along(autopilot: &mut Autopilot, heading_deg: f64, speed_m_s: f64) {
    let wanted = SetpointCourse::Heading(wrap_180(heading_deg));
    set(autopilot, wanted, speed_m_s);
}

fn asks(setpoint: &Setpoint, bits: u16) -> bool {
    setpoint.mask & bits == 0
}

fn default_speed_m_s(autopilot: &Autopilot) -> f64 {
    autopilot.vehicle.tuning.flight.speed_m_s
}

/// The speed over ground; with a yaw of its own, a velocity backwards means reverse.
fn speed_m_s(autopilot: &Autopilot, setpoint: &Setpoint) -> f64 {
    if !asks(setpoint, VELOCITY) {
        return 0.0;
    }
    let velocity = setpoint.velocity_m_s.truncate();
    let speed = velocity.length().min(default_speed_m_s(autopilot));
    let turns = asks(setpoint, YAW) || asks(setpoint, YAW_RATE);
    if turns && velocity.x < 0.0 {
        -speed
    } else {
        speed
    }
}

/// The direction of a setpoint without a place; `None` for a choice of fields that the rover ignores.
fn wanted(autopilot: &Autopilot, setpoint: &Setpoint) -> Option<SetpointCourse> {
    if asks(setpoint, ACCELERATION) {
        return None;
    }
    let heading = |deg: f64| {
        let from = if is_body_frame(setpoint) {
            autopilot.vehicle.believed().yaw_deg
        } else {
            0.0
        };
        SetpointCourse::Heading(wrap_180(deg + from))
    };
    let velocity = setpoint.velocity_m_s;
    match (
        asks(setpoint, VELOCITY),
        asks(setpoint, YAW),
        asks(setpoint, YAW_RATE),
    ) {
        (_, true, false) => Some(heading(setpoint.yaw_rad.to_degrees())),
        (_, false, true) => Some(SetpointCourse::TurnRate(
            setpoint.yaw_rate_rad_s.to_degrees(),
        )),
        (true, false, false) => Some(heading(maths::atan2(velocity.y, velocity.x).to_degrees())),
        _ => None,
    }
    .filter(|wanted| match wanted {
        SetpointCourse::Heading(value) | SetpointCourse::TurnRate(value) => value.is_finite(),
    })
}

fn set(autopilot: &mut Autopilot, wanted: SetpointCourse, speed_m_s: f64) {
    let until = autopilot.vehicle.uptime() + LASTS;
    autopilot.vehicle.flight.task = Task::Drive(Drive::Setpoint(DriveSetpoint {
        wanted,
        speed_m_s,
        until,
        is_over: false,
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guided::TargetPoint;
    use glam::DVec3;

    #[test]
    fn reverse_needs_a_yaw_of_its_own() {
        let setpoint = |mask| Setpoint {
            point: TargetPoint::Local(DVec3::ZERO),
            velocity_m_s: DVec3::new(-1.0, 0.0, 0.0),
            accel_m_s2: DVec3::ZERO,
            yaw_rad: 0.0,
            yaw_rate_rad_s: 0.0,
            mask,
            frame: crate::frame::LOCAL_NED,
        };
        let autopilot = crate::tests::rover();
        let all = POSITION | ACCELERATION | YAW | YAW_RATE;
        assert!(speed_m_s(&autopilot, &setpoint(all)) > 0.99);
        assert!(speed_m_s(&autopilot, &setpoint(all & !YAW)) < -0.99);
    }
}
