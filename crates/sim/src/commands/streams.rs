//! Commands that request messages.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, GPS_GLOBAL_ORIGIN_DATA, HOME_POSITION_DATA, MESSAGE_INTERVAL_DATA,
    MavMessage, MavResult, MavSeverity,
};

use super::{Command, done};
use crate::autopilot::Autopilot;
use crate::autopilot::telemetry;
use crate::link::Link;
use crate::schedule;

/// A message id from a float parameter, without its fraction. A number out of range becomes an id that no message has.
fn id(parameter: f32) -> u32 {
    if (0.0..16_777_216.0).contains(&parameter) {
        parameter as u32
    } else {
        u32::MAX
    }
}

pub(super) fn set_interval(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    let id = id(command.p[0]);
    if !telemetry::is_known(id, autopilot.vehicle.kind) {
        let text = format!("No ap_message for mavlink id ({})", command.p[0] as i64);
        autopilot.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        return MavResult::MAV_RESULT_DENIED;
    }
    let now = autopilot.vehicle.uptime();
    match command.p[1] as i32 {
        0 => {
            let parameters = &autopilot.vehicle.parameters;
            link.schedule.set_default(id, link.serial, parameters, now);
        }
        interval_us => link.schedule.set(id, i64::from(interval_us), now),
    }
    MavResult::MAV_RESULT_ACCEPTED
}

pub(super) fn get_interval(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    let id = id(command.p[0]);
    let known = telemetry::is_known(id, autopilot.vehicle.kind);
    let interval_us = if known {
        link.schedule.interval_us(id)
    } else {
        0
    };
    link.reply(MavMessage::MESSAGE_INTERVAL(MESSAGE_INTERVAL_DATA {
        interval_us: interval_us as i32,
        message_id: id as u16,
    }));
    done(known)
}

pub(super) fn request(autopilot: &mut Autopilot, link: &mut Link, command: &Command) -> MavResult {
    let id = id(command.p[0]);
    let known = telemetry::is_known(id, autopilot.vehicle.kind);
    if known {
        link.replies
            .extend(telemetry::message(id, autopilot).map(Into::into));
    }
    if id == telemetry::TRAFFIC {
        let traffic = autopilot.vehicle.next_traffic(link.serial);
        link.replies.extend(traffic.map(Into::into));
    }
    if id == schedule::TERRAIN_REQUEST {
        link.replies
            .extend(telemetry::message(schedule::TERRAIN_REPORT, autopilot).map(Into::into));
    }
    done(known)
}

pub(super) fn capabilities(
    autopilot: &mut Autopilot,
    link: &mut Link,
    command: &Command,
) -> MavResult {
    let asked = (command.p[0] - 1.0).abs() < f32::EPSILON;
    if asked {
        link.replies
            .extend(telemetry::message(AUTOPILOT_VERSION_DATA::ID, autopilot).map(Into::into));
    }
    done(asked)
}

pub(super) fn home_position(autopilot: &mut Autopilot, link: &mut Link, _: &Command) -> MavResult {
    let home = telemetry::message(HOME_POSITION_DATA::ID, autopilot);
    let known = home.is_some();
    link.replies.extend(home.map(Into::into));
    link.replies
        .extend(telemetry::message(GPS_GLOBAL_ORIGIN_DATA::ID, autopilot).map(Into::into));
    done(known)
}
