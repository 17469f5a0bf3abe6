//! Queries an instance during its start, until it can be armed.
//!
//! Another program may be attached at the same time, so the probe interferes little. It is a separate component, sends
//! no heartbeats (a ground station's failsafe must not depend on it), requests only the two messages that show
//! readiness and the list of parameters, and is silent once the instance is ready.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, EKF_STATUS_REPORT_DATA, MavCmd, MavMessage, MavParamType, PARAM_SET_DATA,
    SYS_STATUS_DATA,
};

use super::SitlStage;
use crate::parameters::Fetching;
use crate::session::Session;
use crate::vehicle::EkfFlags;
use crate::wire::{
    AUTOPILOT_COMPONENT, ComponentId, Content, Decoder, Encoder, Frame, GROUND_STATION_SYSTEM,
    Outgoing, SystemId,
};

/// `MAV_COMP_ID_ONBOARD_COMPUTER2`: no ground station uses it.
const COMPONENT: ComponentId = 192;
/// How often the speed is set until the vehicle confirms it.
const SPEED_EVERY: Duration = Duration::from_millis(500);
/// The number of attempts to set the speed; after that, the vehicle's own speed is accepted.
const SPEED_TRIES: u32 = 10;
const SPEED: &str = "SIM_SPEEDUP";
/// How often the messages are requested until they arrive.
const STREAMS_EVERY: Duration = Duration::from_secs(1);
/// The messages that show readiness.
const STREAMS: [u32; 2] = [SYS_STATUS_DATA::ID, EKF_STATUS_REPORT_DATA::ID];
/// The interval of the requested messages, in microseconds: twice per simulated second.
const INTERVAL_US: f32 = 500_000.0;
/// The interval that restores the vehicle's default rate; by default, it usually does not send
/// these messages.
const USUAL_INTERVAL: f32 = 0.0;
/// The prefix of a text with a reason why the vehicle cannot be armed.
const PREARM: &str = "PreArm: ";

/// The exchange with a booting instance.
pub(super) struct InstanceProbe {
    system: SystemId,
    session: Session,
    decoder: Decoder,
    encoder: Encoder,
    speedup: f64,
    speed_set_at: Option<Duration>,
    speed_tries: u32,
    streams_asked_at: Option<Duration>,
    stage: SitlStage,
    asked: bool,
    can_arm: bool,
    complaint: Option<String>,
}

impl InstanceProbe {
    /// A new exchange. When the vehicle can be armed, its speed is set to `speedup`.
    pub fn new(system: SystemId, speedup: f64, now: Duration) -> Self {
        Self {
            system,
            session: Session::new(system, AUTOPILOT_COMPONENT, now),
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, COMPONENT),
            speedup,
            speed_set_at: None,
            speed_tries: 0,
            streams_asked_at: None,
            stage: SitlStage::Process,
            asked: false,
            can_arm: false,
            complaint: None,
        }
    }

    /// The stage of the instance.
    pub fn stage(&self) -> SitlStage {
        self.stage
    }

    /// The number of parameters received, and the total.
    pub fn parameters(&self) -> [u16; 2] {
        let list = self.session.parameters().list;
        [list.received(), list.count().unwrap_or(0)]
    }

    /// The vehicle's latest reason not to arm; `None` if it gave none.
    pub fn complaint(&self) -> Option<&str> {
        self.complaint.as_deref()
    }

    /// How many times the vehicle has rebooted during this exchange.
    pub fn reboots(&self) -> u32 {
        self.session.vehicle().link.reboots
    }

    /// Handles bytes from the instance.
    pub fn hear(&mut self, bytes: &[u8], now: Duration) {
        self.decoder.push(bytes);
        while let Some(frame) = self.decoder.next_frame() {
            if frame.system == self.system {
                self.session.receive(&frame, now);
                self.note_complaint(&frame);
            }
        }
        self.judge(now);
    }

    /// The bytes to send to the vehicle now.
    pub fn say(&mut self, now: Duration) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.session.poll(now);
        drop(self.session.take_reports());
        for message in self.session.take_outgoing() {
            // An attached program requests the other parameters if it needs them.
            if let Outgoing::Message(
                MavMessage::PARAM_REQUEST_LIST(_) | MavMessage::PARAM_REQUEST_READ(_),
            ) = message
            {
                self.encoder.encode(&message, &mut bytes);
            }
        }
        if self.is_short_of_messages() && is_due(&mut self.streams_asked_at, STREAMS_EVERY, now) {
            self.ask_for_messages(INTERVAL_US, &mut bytes);
        }
        if self.can_arm
            && self.stage < SitlStage::Ready
            && is_due(&mut self.speed_set_at, SPEED_EVERY, now)
        {
            self.speed_tries += 1;
            self.encoder.encode_message(&self.speed(), &mut bytes);
        }
        bytes
    }

    /// Restores the vehicle's message rates.
    pub fn take_leave(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.ask_for_messages(USUAL_INTERVAL, &mut bytes);
        bytes
    }

    fn is_short_of_messages(&self) -> bool {
        let vehicle = self.session.vehicle();
        vehicle.heartbeat.is_some() && (vehicle.ekf.is_none() || vehicle.health.is_none())
    }

    fn ask_for_messages(&mut self, interval_us: f32, bytes: &mut Vec<u8>) {
        for message in STREAMS {
            let request = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
                target_system: self.system,
                target_component: AUTOPILOT_COMPONENT,
                command: MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
                param1: message as f32,
                param2: interval_us,
                ..COMMAND_LONG_DATA::default()
            });
            self.encoder.encode_message(&request, bytes);
        }
    }

    fn speed(&self) -> MavMessage {
        MavMessage::PARAM_SET(PARAM_SET_DATA {
            target_system: self.system,
            target_component: AUTOPILOT_COMPONENT,
            param_id: SPEED.into(),
            param_value: self.speedup as f32,
            param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
        })
    }

    fn note_complaint(&mut self, frame: &Frame) {
        if let Content::Message(MavMessage::STATUSTEXT(said)) = &frame.content {
            let field = String::from_utf8_lossy(&said.text[..]);
            let text = field.trim_end_matches('\0');
            if text.starts_with(PREARM) {
                self.complaint = Some(text.to_owned());
            }
        }
    }

    fn judge(&mut self, now: Duration) {
        let vehicle = self.session.vehicle();
        if vehicle.heartbeat.is_none() {
            return;
        }
        let can_arm = vehicle.ready_to_arm();
        let has_position = vehicle
            .ekf
            .is_some_and(|ekf| ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE));
        if !self.asked {
            self.asked = true;
            self.session.fetch_parameters(now);
        }
        let parameters = self.session.parameters();
        let speed = parameters.list.get(SPEED).map(|speed| speed.value as f32);
        let speed_fits = speed == Some(self.speedup as f32) || self.speed_tries > SPEED_TRIES;
        self.can_arm = can_arm;
        self.stage = match parameters.fetching {
            Fetching::Complete if can_arm && speed_fits => SitlStage::Ready,
            Fetching::Complete if has_position => SitlStage::Position,
            Fetching::Complete => SitlStage::Parameters,
            Fetching::NotAsked | Fetching::UnderWay { .. } | Fetching::Stalled => {
                SitlStage::Heartbeat
            }
        };
    }
}

/// Whether an action is due again; if so, it counts as done.
fn is_due(last: &mut Option<Duration>, every: Duration, now: Duration) -> bool {
    let is_due = last.is_none_or(|at| now >= at + every);
    if is_due {
        *last = Some(now);
    }
    is_due
}
