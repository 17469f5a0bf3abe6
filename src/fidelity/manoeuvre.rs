//! A flight divided into manoeuvres by its commands.

use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, COMMAND_LONG_DATA, MavCmd, MavFrame, MavMessage, PositionTargetTypemask,
    SET_POSITION_TARGET_LOCAL_NED_DATA,
};

use super::replay::AFTERWARDS;
use super::{Observed, Timed};
use crate::geo::LatLon;
use crate::vehicle::{Mode, VehicleClass};
use crate::wire::Content;

/// The state that a manoeuvre should reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    /// Climb to a height above the origin, in metres.
    Height(f64),
    /// Be at a place: metres north, east and down of the origin.
    Place([f64; 3]),
    /// Have the velocity that the real vehicle had at the last command.
    Velocity,
    /// Have the heading that the real vehicle had at the last command.
    Heading,
    /// Be on the ground and disarmed.
    Landed,
    /// Report the end with this text.
    Told(&'static str),
}

/// One manoeuvre: from its command to the command of the next manoeuvre.
#[derive(Debug, Clone, PartialEq)]
pub struct Manoeuvre {
    /// The name of the commanded manoeuvre.
    pub name: String,
    /// The time of its command, in seconds since the recording began.
    pub from_s: f64,
    /// The time of its last command: a velocity must be repeated.
    pub last_asked_s: f64,
    /// The time of the next command.
    pub to_s: f64,
    /// The state that the manoeuvre should reach.
    pub aim: Aim,
}

/// Shorter manoeuvres, in seconds, are not compared.
const SHORTEST_S: f64 = 1.5;

/// Divides the sent frames into manoeuvres. Commands that the real vehicle refused begin no manoeuvre.
pub(super) fn cut(sent: &[Timed], real: &Observed) -> Vec<Manoeuvre> {
    let mut all: Vec<Manoeuvre> = Vec::new();
    let mut sticks = None;
    for Timed { at, frame } in sent {
        let at_s = at.as_secs_f64();
        let Content::Message(message) = &frame.content else {
            continue;
        };
        let Some((name, aim)) = asked(message, real, at_s).filter(|_| at_s >= real.begin_s())
        else {
            continue;
        };
        // Stick positions are sent continuously, alongside other commands.
        if let MavMessage::RC_CHANNELS_OVERRIDE(data) = message
            && sticks.replace(data.chan3_raw) == Some(data.chan3_raw)
        {
            continue;
        }
        if let Some(before) = all.last_mut() {
            if before.name == name && aim == Aim::Velocity {
                before.last_asked_s = at_s;
                continue;
            }
            before.to_s = at_s;
        }
        all.push(Manoeuvre {
            name,
            from_s: at_s,
            last_asked_s: at_s,
            to_s: real.end_s() + AFTERWARDS.as_secs_f64(),
            aim,
        });
    }
    for manoeuvre in &mut all {
        if manoeuvre.last_asked_s <= manoeuvre.from_s {
            manoeuvre.last_asked_s = manoeuvre.to_s;
        }
    }
    all.retain(|manoeuvre| manoeuvre.to_s - manoeuvre.from_s >= SHORTEST_S);
    all
}

fn asked(message: &MavMessage, real: &Observed, at_s: f64) -> Option<(String, Aim)> {
    match message {
        MavMessage::COMMAND_LONG(data) if real.accepted(data.command as u16, at_s) => {
            long(data, real.class())
        }
        MavMessage::COMMAND_INT(data) if real.accepted(data.command as u16, at_s) => {
            int(data, real)
        }
        MavMessage::SET_POSITION_TARGET_LOCAL_NED(data) => Some(local(data)),
        MavMessage::SET_POSITION_TARGET_GLOBAL_INT(data) => {
            let above_home = !is_amsl(data.coordinate_frame);
            let place = place(
                real,
                LatLon::from_e7(data.lat_int, data.lon_int),
                f64::from(data.alt),
                above_home,
            )?;
            Some((name_of_place("to", place), Aim::Place(place)))
        }
        MavMessage::SET_ATTITUDE_TARGET(_) => Some(("attitude".to_owned(), Aim::Velocity)),
        MavMessage::RC_CHANNELS_OVERRIDE(data) => {
            let name = format!("throttle stick at {}", data.chan3_raw);
            Some((name, Aim::Velocity))
        }
        _ => None,
    }
}

fn long(data: &COMMAND_LONG_DATA, class: VehicleClass) -> Option<(String, Aim)> {
    let named = |name: &str| class.mode(name).map(entered);
    match data.command {
        MavCmd::MAV_CMD_NAV_TAKEOFF => {
            let name = format!("takeoff {} m", data.param7);
            Some((name, Aim::Height(f64::from(data.param7))))
        }
        MavCmd::MAV_CMD_CONDITION_YAW => {
            let relative = if data.param4 > 0.0 { " more" } else { "" };
            Some((format!("yaw {}{relative}", data.param1), Aim::Heading))
        }
        MavCmd::MAV_CMD_DO_SET_MODE => Some(entered(Mode {
            class,
            number: data.param2 as u32,
        })),
        MavCmd::MAV_CMD_NAV_LAND => named("LAND"),
        MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH => named("RTL"),
        MavCmd::MAV_CMD_MISSION_START => named("AUTO"),
        MavCmd::MAV_CMD_DO_PAUSE_CONTINUE if data.param1 > 0.0 => {
            Some(("continue".to_owned(), Aim::Velocity))
        }
        MavCmd::MAV_CMD_DO_PAUSE_CONTINUE => Some(("pause".to_owned(), Aim::Velocity)),
        _ => None,
    }
}

/// The manoeuvre that begins with a mode.
fn entered(mode: Mode) -> (String, Aim) {
    let aim = match mode.class {
        VehicleClass::Rover if mode.comes_down() => Aim::Told("Reached destination"),
        VehicleClass::Rover if mode.flies_plan() => Aim::Told("Mission Complete"),
        VehicleClass::Copter if mode.comes_down() || mode.flies_plan() => Aim::Landed,
        _ => Aim::Velocity,
    };
    (mode.to_string(), aim)
}

fn int(data: &COMMAND_INT_DATA, real: &Observed) -> Option<(String, Aim)> {
    if data.command != MavCmd::MAV_CMD_DO_REPOSITION {
        return None;
    }
    let above_home = !is_amsl(data.frame);
    let place = place(
        real,
        LatLon::from_e7(data.x, data.y),
        f64::from(data.z),
        above_home,
    )?;
    Some((name_of_place("reposition to", place), Aim::Place(place)))
}

#[expect(
    deprecated,
    reason = "the dialect deprecates the body frame, but most programs use it"
)]
fn local(data: &SET_POSITION_TARGET_LOCAL_NED_DATA) -> (String, Aim) {
    let ignores = |bit| data.type_mask.contains(bit);
    let frame = match data.coordinate_frame {
        MavFrame::MAV_FRAME_LOCAL_NED => "",
        MavFrame::MAV_FRAME_BODY_NED => " of the body",
        _ => " from here",
    };
    if !ignores(PositionTargetTypemask::POSITION_TARGET_TYPEMASK_X_IGNORE) {
        let place = [data.x, data.y, data.z].map(f64::from);
        let name = format!("{}{frame}", name_of_place("to", place));
        let aim = if frame.is_empty() {
            Aim::Place(place)
        } else {
            Aim::Velocity
        };
        return (name, aim);
    }
    if ignores(PositionTargetTypemask::POSITION_TARGET_TYPEMASK_VX_IGNORE) {
        return ("acceleration".to_owned(), Aim::Velocity);
    }
    let turning = if ignores(PositionTargetTypemask::POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE) {
        String::new()
    } else {
        format!(" turning {:.0}/s", f64::from(data.yaw_rate).to_degrees())
    };
    let name = format!(
        "velocity {} {} {}{frame}{turning}",
        data.vx, data.vy, data.vz
    );
    (name, Aim::Velocity)
}

fn place(real: &Observed, at: LatLon, altitude_m: f64, above_home: bool) -> Option<[f64; 3]> {
    let start = real.start()?;
    let (north, east) = start.at.offset_to(at);
    let base_m = if above_home {
        0.0
    } else {
        start.altitude_amsl_m
    };
    at.is_valid().then_some([north, east, base_m - altitude_m])
}

/// Whether heights of a frame are above mean sea level: `MAV_FRAME_GLOBAL` and `MAV_FRAME_GLOBAL_INT`.
fn is_amsl(frame: MavFrame) -> bool {
    matches!(frame as u32, 0 | 5)
}

fn name_of_place(verb: &str, place: [f64; 3]) -> String {
    let [north, east, down] = place.map(|metres| metres.round() + 0.0);
    format!("{verb} {north} {east} {down}")
}
