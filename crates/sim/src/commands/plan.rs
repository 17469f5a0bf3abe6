//! Commands that affect the mission being flown.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::MISSION_CURRENT_DATA;
use mavlink::dialects::ardupilotmega::{MavResult, MavSeverity};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::autopilot::telemetry;
use crate::link::Link;

const MISSION_CURRENT: u32 = MISSION_CURRENT_DATA::ID;

pub(super) fn start(autopilot: &mut Autopilot, _: &mut Link, _: &Command) -> MavResult {
    done(autopilot.start_mission())
}

/// Continues at the nearest `DO_LAND_START`; without one, the command fails.
pub(super) fn start_landing_sequence(
    autopilot: &mut Autopilot,
    _: &mut Link,
    _: &Command,
) -> MavResult {
    if autopilot.fly_landing_sequence() {
        return MavResult::MAV_RESULT_ACCEPTED;
    }
    for text in [
        "Unable to start landing sequence",
        "Mode change to AUTO RTL failed: No landing sequence found",
    ] {
        autopilot
            .vehicle
            .say(MavSeverity::MAV_SEVERITY_WARNING, text);
    }
    MavResult::MAV_RESULT_FAILED
}

/// Sets the current item, which must exist; the second parameter resets the jumps and restarts the
/// mission.
pub(super) fn set_current(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    let items = autopilot.vehicle.plans.mission.len();
    let Some(at) = whole(command.p[0]).filter(|&at| usize::from(at) < items) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    let worked = if (command.p[1] - 1.0).abs() < f32::EPSILON {
        autopilot
            .auto_plan
            .reset_to_item(&mut autopilot.vehicle, at)
    } else {
        autopilot.auto_plan.set_item(&mut autopilot.vehicle, at)
    };
    if worked {
        report(autopilot, link);
    }
    done(worked)
}

pub(super) fn jump_to_tag(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    let Some(tag) = whole(command.p[0]) else {
        return MavResult::MAV_RESULT_DENIED;
    };
    let worked = autopilot.auto_plan.jump_to_tag(&mut autopilot.vehicle, tag);
    if worked {
        report(autopilot, link);
    }
    done(worked)
}

fn report(autopilot: &Autopilot, link: &mut Link) {
    if let Some(message) = telemetry::message(MISSION_CURRENT, autopilot) {
        link.reply(message);
    }
}

/// The number of an item or of a tag, without its fraction; `None` if it is out of range.
fn whole(value: f32) -> Option<u16> {
    (value > -1.0 && value < 65536.0).then_some(value as u16)
}
