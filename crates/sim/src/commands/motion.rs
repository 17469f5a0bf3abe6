//! Commands that change how the vehicle moves: heading, speed, goal.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavDoRepositionFlags, MavResult, MavSeverity};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::frame::GLOBAL_RELATIVE_ALT;
use crate::guided;
use crate::link::Link;
use crate::mode::{self, ModeId};
use crate::place::Place;
use crate::vehicle::AskedSpeeds;
use crate::yaw::YawDemand;

/// Heights beyond this, in metres, cannot be stored in a location.
const HEIGHT_MAX_M: f64 = 83_000.0;
/// The flag of `DO_REPOSITION` that allows it to enter GUIDED.
pub(super) const CHANGE_MODE: i32 =
    MavDoRepositionFlags::MAV_DO_REPOSITION_FLAGS_CHANGE_MODE.bits() as i32;

pub(super) fn yaw(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let [angle, rate, direction, relative] = command.p.map(f64::from);
    let known = (0.0..=360.0).contains(&angle) && (command.is(3, 0.0) || command.is(3, 1.0));
    if !known || !rate.is_finite() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if relative > 0.0 {
        let signed = if direction < 0.0 { -angle } else { angle };
        autopilot.vehicle.flight.yaw.turn_by(signed, rate);
    } else {
        autopilot.vehicle.flight.yaw.turn_to(angle, rate, direction);
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn change_speed(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let [kind, speed, ..] = command.p.map(f64::from);
    let able = mode::changes_speed(autopilot.vehicle.flight.mode.id);
    if !(able && speed > 0.0 && speed.is_finite()) {
        return MavResult::MAV_RESULT_FAILED;
    }
    // The autopilot sets climb and descent together: a change of one resets the other. The real vehicle compares the
    // kinds in the same way: 9 is a descent, -1 the speed over ground.
    let ground_m_s = autopilot.vehicle.flight.speeds.ground_m_s;
    autopilot.vehicle.flight.speeds = if kind > 2.9 {
        AskedSpeeds {
            ground_m_s,
            up_m_s: None,
            down_m_s: Some(speed),
        }
    } else if kind > 1.9 {
        AskedSpeeds {
            ground_m_s,
            up_m_s: Some(speed),
            down_m_s: None,
        }
    } else {
        AskedSpeeds {
            ground_m_s: Some(speed),
            ..autopilot.vehicle.flight.speeds
        }
    };
    MavResult::MAV_RESULT_ACCEPTED
}

/// A command's place, with the height in its frame; `None` if invalid.
pub(super) fn place(autopilot: &mut Autopilot, command: &Command, frame: u8) -> Option<Place> {
    let height_m = f64::from(command.z);
    if height_m.is_nan() || height_m.abs() > HEIGHT_MAX_M {
        return None;
    }
    let Some(altitude_amsl_m) = autopilot.vehicle.datum.altitude_amsl_m(frame, height_m) else {
        let text = format!("Unknown mavlink coordinate frame {frame}");
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        return None;
    };
    Some(Place {
        at: command.at(),
        altitude_amsl_m,
    })
}

/// The place of `DO_REPOSITION`, if the vehicle may go there from its mode.
pub(super) fn reposition_place(
    autopilot: &mut Autopilot,
    command: &Command,
) -> Result<Place, MavResult> {
    let Some(frame) = command.frame else {
        return Err(MavResult::MAV_RESULT_UNSUPPORTED);
    };
    let may_change_mode = command
        .whole(1)
        .is_some_and(|flags| flags & CHANGE_MODE != 0);
    let guided = mode::is_guided(autopilot.vehicle.flight.mode.id);
    let somewhere = command.at().is_valid() && (command.x, command.y) != (0, 0);
    if !somewhere || !(guided || may_change_mode) {
        return Err(MavResult::MAV_RESULT_DENIED);
    }
    place(autopilot, command, frame).ok_or(MavResult::MAV_RESULT_DENIED)
}

pub(super) fn reposition(autopilot: &mut Autopilot, _: &mut Link, command: &Command) -> MavResult {
    let place = match reposition_place(autopilot, command) {
        Ok(place) => place,
        Err(refused) => return refused,
    };
    let guided = mode::is_guided(autopilot.vehicle.flight.mode.id);
    let goal = autopilot.vehicle.datum.point_of(place);
    if !autopilot.vehicle.safety.landed && !autopilot.vehicle.may_fly_to(goal) {
        return MavResult::MAV_RESULT_FAILED;
    }
    if !guided && !autopilot.set_mode(ModeId::Guided) {
        return MavResult::MAV_RESULT_FAILED;
    }
    if !autopilot.vehicle.safety.landed {
        guided::go_to(&mut autopilot.vehicle, goal, DVec3::ZERO);
        autopilot.vehicle.flight.yaw.demand = autopilot.vehicle.default_yaw();
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn pause_or_continue(
    autopilot: &mut Autopilot,
    _: &mut Link,
    command: &Command,
) -> MavResult {
    let pause = match command.whole(0) {
        Some(0) => true,
        Some(1) => false,
        _ => return MavResult::MAV_RESULT_DENIED,
    };
    let worked = autopilot.pause(pause);
    if !worked {
        let text = if pause {
            "Failed to pause"
        } else {
            "Failed to resume"
        };
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
    }
    done(worked)
}

pub(super) fn look_at(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    let frame = command.frame.unwrap_or(GLOBAL_RELATIVE_ALT);
    let Some(place) = place(autopilot, command, frame) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    if !place.at.is_valid() {
        return MavResult::MAV_RESULT_FAILED;
    }
    if (command.x, command.y) == (0, 0) {
        return look_ahead(autopilot, link, command);
    }
    let (north, east) = autopilot.vehicle.datum.start.at.offset_to(place.at);
    autopilot.vehicle.flight.yaw.demand = YawDemand::Towards(glam::DVec2::new(north, east));
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn look_ahead(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    autopilot.vehicle.flight.yaw.demand = autopilot.vehicle.default_yaw();
    MavResult::MAV_RESULT_ACCEPTED
}
