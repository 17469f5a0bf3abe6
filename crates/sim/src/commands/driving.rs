//! Commands that a rover carries out in its own way.

use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::motion;
use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::guided;
use crate::link::Link;
use crate::mode::{self, ModeId};
use crate::output_test::TestRequest;

/// Changes the speed of the drive under way, until the mode changes.
pub(super) fn change_speed(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let speed_m_s = f64::from(command.p[1]);
    done(autopilot.vehicle.set_drive_speed(speed_m_s))
}

pub(super) fn reposition(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let place = match motion::reposition_place(autopilot, command) {
        Ok(place) => place,
        Err(refused) => return refused,
    };
    let guided = mode::is_guided(autopilot.vehicle.flight.mode.id);
    if !guided && !autopilot.set_mode(ModeId::Guided) {
        return MavResult::MAV_RESULT_FAILED;
    }
    let speed_m_s = f64::from(command.p[0]);
    if speed_m_s > 0.0 && !autopilot.vehicle.set_drive_speed(speed_m_s) {
        return MavResult::MAV_RESULT_FAILED;
    }
    let goal_m = autopilot.vehicle.datum.point_of(place);
    autopilot.drive_to(goal_m);
    MavResult::MAV_RESULT_ACCEPTED
}

/// Drives one output by hand. A vehicle that is disarmed arms for it, and all disarm afterwards.
pub(super) fn motor_test(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let (Some(output), Some(kind), Some(value)) =
        (command.whole(0), command.whole(1), command.whole(2))
    else {
        return MavResult::MAV_RESULT_DENIED;
    };
    done(autopilot.test_output(TestRequest {
        output,
        kind,
        value,
        lasts_s: command.p[3],
    }))
}

/// Drives along a heading at a speed, in GUIDED, as a setpoint does.
pub(super) fn set_yaw_and_speed(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let text = "Received message (MAV_CMD_NAV_SET_YAW_SPEED) is deprecated";
    autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
    let [heading_deg, speed_m_s, relative, _] = command.p.map(f64::from);
    let is_sensible = heading_deg.is_finite() && speed_m_s.is_finite();
    if autopilot.vehicle.flight.mode.id != ModeId::Guided || !is_sensible {
        return MavResult::MAV_RESULT_FAILED;
    }
    let from = if relative > 0.0 {
        autopilot.vehicle.believed().yaw_deg
    } else {
        0.0
    };
    guided::drive_along(autopilot, from + heading_deg, speed_m_s);
    MavResult::MAV_RESULT_ACCEPTED
}

/// Drives backwards or forwards along paths, until the mode changes.
pub(super) fn set_reverse(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    autopilot.vehicle.flight.backs_up = command.is(0, 1.0);
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn start_mission(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.set_mode(ModeId::Auto))
}
