//! Asks an instance how far it is, until it can be armed.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavParamType, PARAM_SET_DATA};

use super::Stage;
use crate::parameters::Fetching;
use crate::session::Session;
use crate::vehicle::EkfFlags;
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
    SystemId, ground_station_heartbeat,
};

/// How often a ground station says that it is there.
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);
/// How often the speed is set until the vehicle says that it is.
const SPEED_EVERY: Duration = Duration::from_millis(500);
const SPEED: &str = "SIM_SPEEDUP";

/// A conversation with an instance that boots.
pub(super) struct Probe {
    system: SystemId,
    session: Session,
    decoder: Decoder,
    encoder: Encoder,
    speedup: f64,
    said_at: Option<Duration>,
    speed_set_at: Option<Duration>,
    stage: Stage,
    asked: bool,
    can_arm: bool,
}

impl Probe {
    /// A conversation that begins now. When the vehicle can be armed, its speed is set to `speedup`.
    pub fn new(system: SystemId, speedup: f64, now: Duration) -> Self {
        Self {
            system,
            session: Session::new(system, AUTOPILOT_COMPONENT, now),
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
            speedup,
            said_at: None,
            speed_set_at: None,
            stage: Stage::Process,
            asked: false,
            can_arm: false,
        }
    }

    /// How far the instance is.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// How many parameters have come, of how many.
    pub fn parameters(&self) -> [u16; 2] {
        let list = self.session.parameters().list;
        [list.received(), list.count().unwrap_or(0)]
    }

    /// Takes in what the instance said.
    pub fn hear(&mut self, bytes: &[u8], now: Duration) {
        self.decoder.push(bytes);
        while let Some(frame) = self.decoder.next_frame() {
            if frame.system == self.system {
                self.session.receive(&frame, now);
            }
        }
        self.judge(now);
    }

    /// What there is to say to it now.
    pub fn say(&mut self, now: Duration) -> Vec<u8> {
        let mut bytes = Vec::new();
        if self.said_at.is_none_or(|at| now >= at + HEARTBEAT_EVERY) {
            self.said_at = Some(now);
            self.encoder.encode(&ground_station_heartbeat(), &mut bytes);
        }
        self.session.poll(now);
        for message in self.session.take_outgoing() {
            self.encoder.encode(&message, &mut bytes);
        }
        if self.can_arm
            && self.stage < Stage::Ready
            && self.speed_set_at.is_none_or(|at| now >= at + SPEED_EVERY)
        {
            self.speed_set_at = Some(now);
            let message = MavMessage::PARAM_SET(PARAM_SET_DATA {
                target_system: self.system,
                target_component: AUTOPILOT_COMPONENT,
                param_id: SPEED.into(),
                param_value: self.speedup as f32,
                param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
            });
            self.encoder.encode_message(&message, &mut bytes);
        }
        drop(self.session.take_reports());
        bytes
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
        let speed = parameters.list.get(SPEED).map(|speed| speed.value);
        let speed_fits = speed == Some(self.speedup as f32);
        self.can_arm = can_arm;
        self.stage = match parameters.fetching {
            Fetching::Complete if can_arm && speed_fits => Stage::Ready,
            Fetching::Complete if has_position => Stage::Position,
            Fetching::Complete => Stage::Parameters,
            _ => Stage::Heartbeat,
        };
    }
}
