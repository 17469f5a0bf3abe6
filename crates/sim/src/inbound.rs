//! Messages from ground stations, and the vehicle's answers.

mod fields;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, COMMAND_ACK_DATA, MISSION_CURRENT_DATA, MavMessage, MavModeFlag,
    MavResult, MavSeverity, PARAM_REQUEST_READ_DATA, PARAM_VALUE_DATA, SETUP_SIGNING_DATA,
    TIMESYNC_DATA,
};

use self::fields::{Addressed, StationRequest};
use super::autopilot::Autopilot;
use super::autopilot::telemetry;
use super::commands::{self, Command};
use super::leader::LeaderReport;
use super::link::Link;
use super::operator::{self, REQUEST_CONTROL, Refusal};
use super::parameters::BY_NAME;
use super::place::Place;
use super::transfer::{self, Transfers};
use super::{guided, schedule, texts};
use sortie_geo::LatLon;
use sortie_wire::{Content, Frame, Outgoing, first_channels};

/// The bit of `SET_MODE` without which its custom mode is ignored.
const CUSTOM_MODE: u8 = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED.bits();
const COMMAND_ACK: u32 = COMMAND_ACK_DATA::ID;

pub(super) fn handle(
    autopilot: &mut Autopilot,
    transfers: &mut Transfers,
    link: &mut Link,
    frame: &Frame,
) {
    let enforced = autopilot.vehicle.tuning.only_ground_station;
    if enforced && frame.system != autopilot.vehicle.tuning.ground_station {
        return;
    }
    let is_barred = is_barred(autopilot, frame);
    if let Some(Addressed { to, request }) = StationRequest::read(&frame.content) {
        if to == 0 || to == autopilot.vehicle.system {
            if is_barred && !refuse(autopilot, link, frame, &request) {
                return;
            }
            carry_out(autopilot, link, frame, &request);
        }
        return;
    }
    if is_barred {
        match operator::refusal(frame) {
            Refusal::None => {}
            Refusal::Silent => return,
            Refusal::Answered(answer) => return link.replies.push(*answer),
        }
    }
    if transfer::handle(transfers, autopilot, link, frame) {
        return;
    }
    if let Content::Message(message) = &frame.content {
        if let (Some(operator), MavMessage::HEARTBEAT(_)) = (&mut autopilot.operator, message) {
            operator.hear(frame.system, autopilot.vehicle.uptime());
        }
        converse(autopilot, link, frame, message);
    }
}

/// Whether another ground station is in control of the vehicle. The vehicle's own system is never barred.
fn is_barred(autopilot: &Autopilot, frame: &Frame) -> bool {
    let operator = autopilot.operator.as_ref();
    frame.system != autopilot.vehicle.system
        && operator.is_some_and(|operator| !operator.admits(frame.system))
}

/// Answers a request of a station that is not in control; `true` if it may pass, because it changes nothing.
fn refuse(autopilot: &Autopilot, link: &mut Link, frame: &Frame, request: &StationRequest) -> bool {
    match request {
        StationRequest::Command(command) if operator::is_question(command.number) => return true,
        StationRequest::Command(command) => {
            let result = MavResult::MAV_RESULT_NOT_IN_CONTROL;
            link.replies.push(acknowledgement(command, result, frame));
        }
        StationRequest::SetParameter { name, .. } => {
            // The unchanged value shows the refusal.
            if let Some(parameter) = autopilot.vehicle.parameters.named(name) {
                link.reply(autopilot.vehicle.parameters.message(&parameter));
            }
        }
        StationRequest::Setpoint(_)
        | StationRequest::Attitude(_)
        | StationRequest::SetMode { .. } => {}
    }
    false
}

fn carry_out(autopilot: &mut Autopilot, link: &mut Link, frame: &Frame, request: &StationRequest) {
    match request {
        StationRequest::Command(command) => {
            let result = match &mut autopilot.operator {
                Some(operator) if command.number == REQUEST_CONTROL => {
                    operator.request(frame.system, command.p)
                }
                _ => commands::execute(autopilot, link, command),
            };
            let place = if commands::answers_first(command.number) {
                link.replies.len()
            } else {
                0
            };
            link.replies
                .insert(place, acknowledgement(command, result, frame));
        }
        StationRequest::Setpoint(setpoint) => guided::take_setpoint(autopilot, setpoint),
        StationRequest::SetMode { base, custom } if base & CUSTOM_MODE != 0 => {
            // Only the lowest byte counts, as on the real vehicle.
            autopilot.set_mode_numbered(*custom as u8);
        }
        StationRequest::SetMode { .. } => {}
        StationRequest::Attitude(asked) => guided::take_attitude(autopilot, asked),
        StationRequest::SetParameter { name, value } => {
            // Reading all parameters again is expensive, and many ground stations write whole files.
            let of_name = |autopilot: &Autopilot| autopilot.vehicle.parameters.named(name);
            let before = of_name(autopilot);
            if autopilot.vehicle.store_parameter(name, *value) && of_name(autopilot) != before {
                autopilot.vehicle.retune();
            }
        }
    }
}

fn acknowledgement(command: &Command, result: MavResult, frame: &Frame) -> Outgoing {
    let mut payload = Vec::with_capacity(10);
    payload.extend_from_slice(&command.number.to_le_bytes());
    payload.push(result as u8);
    payload.extend_from_slice(&[0; 5]);
    payload.extend_from_slice(&[frame.system, frame.component]);
    Outgoing::Raw {
        id: COMMAND_ACK,
        payload,
    }
}

/// Handles messages that are neither commands nor setpoints.
#[expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]
fn converse(autopilot: &mut Autopilot, link: &mut Link, frame: &Frame, message: &MavMessage) {
    let is_pilot = matches!(message, MavMessage::HEARTBEAT(_)) || !is_barred(autopilot, frame);
    if is_pilot && frame.system == autopilot.vehicle.tuning.ground_station {
        hear_pilot(autopilot, message);
    }
    if frame.system != autopilot.vehicle.system
        && let Some(report) = LeaderReport::read(message)
    {
        autopilot.vehicle.hear_leader(frame.system, &report);
    }
    let own = |target: u8| target == 0 || target == autopilot.vehicle.system;
    match message {
        MavMessage::REQUEST_DATA_STREAM(data) if own(data.target_system) => {
            let rate = data.req_message_rate * u16::from(data.start_stop.min(1));
            let stream = data.req_stream_id as u8;
            for name in schedule::rate_names(link.serial, stream) {
                let parameters = &mut autopilot.vehicle.parameters;
                parameters.set_until_boot(&name, f32::from(rate));
            }
            link.schedule
                .set_stream(stream, rate, autopilot.vehicle.uptime());
        }
        // A vehicle that is still initialising ignores this.
        MavMessage::PARAM_REQUEST_LIST(data)
            if own(data.target_system) && !autopilot.vehicle.boot.is_initialising() =>
        {
            link.listing = Some(0);
            autopilot.vehicle.say_banner();
        }
        MavMessage::PARAM_REQUEST_READ(data) if own(data.target_system) => {
            read_parameter(autopilot, link, data);
        }
        MavMessage::TIMESYNC(data) if data.tc1 == 0 => link.reply(time(autopilot, frame, data.ts1)),
        MavMessage::AUTOPILOT_VERSION_REQUEST(data) if own(data.target_system) => {
            link.replies
                .extend(telemetry::message(AUTOPILOT_VERSION_DATA::ID, autopilot).map(Into::into));
        }
        MavMessage::SETUP_SIGNING(data) if own(data.target_system) => {
            set_up_signing(autopilot, link, data);
        }
        MavMessage::MISSION_SET_CURRENT(data) if own(data.target_system) => {
            set_current(autopilot, link, data.seq);
        }
        MavMessage::SET_HOME_POSITION(data) if own(data.target_system) => {
            let at = LatLon::from_e7(data.latitude, data.longitude);
            take_home(autopilot, at, f64::from(data.altitude) / 1000.0);
        }
        _ => {}
    }
}

/// Stores a ground station's key for all links; refused while armed. There is no acknowledgement, because the
/// protocol has none.
fn set_up_signing(autopilot: &Autopilot, link: &mut Link, data: &SETUP_SIGNING_DATA) {
    if autopilot.vehicle.safety.armed {
        let mut said = Vec::new();
        texts::say(
            &mut said,
            MavSeverity::MAV_SEVERITY_WARNING,
            "ERROR: Won't setup signing when armed",
        );
        link.replies.extend(said.into_iter().map(Into::into));
        return;
    }
    link.key = Some((data.secret_key, data.initial_timestamp));
}

/// Handles messages that are accepted only from the vehicle's own ground station: its heartbeat,
/// and its sticks.
fn hear_pilot(autopilot: &mut Autopilot, message: &MavMessage) {
    match message {
        MavMessage::HEARTBEAT(_) => {}
        MavMessage::RC_CHANNELS_OVERRIDE(data)
            if data.target_system == 0 || data.target_system == autopilot.vehicle.system =>
        {
            let now = autopilot.vehicle.uptime();
            let rules = &autopilot.vehicle.tuning.flight.radio;
            autopilot
                .vehicle
                .radio
                .override_channels(first_channels!(data), rules, now);
        }
        MavMessage::MANUAL_CONTROL(data) if data.target == autopilot.vehicle.system => {
            let now = autopilot.vehicle.uptime();
            let rules = &autopilot.vehicle.tuning.flight.radio;
            let axes = [data.x, data.y, data.z, data.r];
            autopilot.vehicle.radio.control_manually(axes, rules, now);
        }
        _ => return,
    }
    autopilot.failsafe.heard = Some(autopilot.vehicle.uptime());
}

fn take_home(autopilot: &mut Autopilot, at: LatLon, altitude_amsl_m: f64) {
    let home = Place {
        at,
        altitude_amsl_m,
    };
    if autopilot.vehicle.is_ready() && autopilot.vehicle.datum.may_be_home(home) {
        autopilot.vehicle.set_home(home);
        autopilot.vehicle.datum.lock_home();
    }
}

/// Jumps to an item of the mission. The answer names the requested item, since ground stations treat it as an
/// acknowledgement.
fn set_current(autopilot: &mut Autopilot, link: &mut Link, seq: u16) {
    if autopilot.auto_plan.set_item(&mut autopilot.vehicle, seq)
        && let Some(MavMessage::MISSION_CURRENT(now)) =
            telemetry::message(MISSION_CURRENT_DATA::ID, autopilot)
    {
        link.reply(MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
            seq,
            ..now
        }));
    }
}

/// The answer to `TIMESYNC`: the vehicle's clock, and the timestamp of the request.
fn time(autopilot: &Autopilot, frame: &Frame, ts1: i64) -> MavMessage {
    MavMessage::TIMESYNC(TIMESYNC_DATA {
        tc1: autopilot.vehicle.uptime().as_nanos() as i64,
        ts1,
        target_system: frame.system,
        target_component: frame.component,
    })
}

fn read_parameter(autopilot: &Autopilot, link: &mut Link, data: &PARAM_REQUEST_READ_DATA) {
    if let Ok(index) = u16::try_from(data.param_index) {
        if let Some(parameter) = autopilot.vehicle.parameters.at(index) {
            link.reply(autopilot.vehicle.parameters.message(&parameter));
        }
        return;
    }
    let found = data
        .param_id
        .to_str()
        .ok()
        .and_then(|name| autopilot.vehicle.parameters.named(name));
    if let Some(parameter) = found {
        link.reply(MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_index: BY_NAME,
            // The name is returned as it was requested.
            param_id: data.param_id,
            ..autopilot.vehicle.parameters.fields_of(&parameter)
        }));
    }
}
