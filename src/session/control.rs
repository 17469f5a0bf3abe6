//! Operator control on this side: requests of other stations, and the end of a permission.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMMAND_ACK_DATA, COMMAND_LONG_DATA};

use super::Output;
use crate::commands::{Command, ControlChange, DeviceCommand, REQUEST_CONTROL};
use crate::notice::Notice;
use crate::text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{Content, Frame, Outgoing, SystemId};

const COMMAND_LONG: u32 = COMMAND_LONG_DATA::ID;

/// The permission for other stations to take control, while it lasts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ControlDesk {
    allowed_until: Option<Duration>,
}

impl ControlDesk {
    /// Notes an order to allow a takeover, which ends by itself, or one that replaces it.
    pub fn note(&mut self, command: &Command, now: Duration) {
        if let Command::Device(DeviceCommand::Control(change)) = command {
            self.allowed_until = match change {
                ControlChange::Allow { seconds } => {
                    Some(now + Duration::from_secs((*seconds).into()))
                }
                ControlChange::Request { .. } | ControlChange::Release => None,
            };
        }
    }

    /// Answers a request for control that the vehicle passes on from another station, and reports it.
    pub fn receive(frame: &Frame, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let Some(station) = asking_station(frame, vehicle.station) else {
            return;
        };
        output.messages.push(accepted(frame));
        let text = text!(
            "heard-control-request",
            station = station,
            allow = format!("{} control allow 10", vehicle.id),
            release = format!("{} control release", vehicle.id)
        );
        output.say([Notice::about(vehicle.id, now, Severity::Warning, text)]);
    }

    /// Ends a permission that is over: control can no longer be taken without asking. Returns whether a command was
    /// sent.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) -> bool {
        if self.allowed_until.is_none_or(|until| now < until) {
            return false;
        }
        self.allowed_until = None;
        let is_open = vehicle.control.is_some_and(|control| control.takeover);
        if !is_open || !vehicle.is_controlled_here() {
            return false;
        }
        let change = ControlChange::Request { takeover: false };
        let request = Command::Device(DeviceCommand::Control(change)).request(vehicle, 0);
        let messages = request.map(|request| request.messages).unwrap_or_default();
        let is_sent = !messages.is_empty();
        output.messages.extend(messages);
        let text = text!("heard-control-closed");
        output.say([Notice::about(vehicle.id, now, Severity::Info, text)]);
        is_sent
    }

    /// Whether a permission runs, which must end on time.
    pub fn is_busy(&self) -> bool {
        self.allowed_until.is_some()
    }
}

/// The station that asks for control, if the frame passes on its request to this console.
fn asking_station(frame: &Frame, own: SystemId) -> Option<SystemId> {
    let Content::Undecoded { id, payload } = &frame.content else {
        return None;
    };
    let number = u16::from_le_bytes([payload[28], payload[29]]);
    let is_request = *id == COMMAND_LONG && number == REQUEST_CONTROL && payload[30] == own;
    let parameter = |at: usize| {
        let bytes = payload.get(4 * at..4 * at + 4)?;
        bytes.try_into().ok().map(f32::from_le_bytes)
    };
    let asks = parameter(0).is_some_and(|action| action > 0.5);
    parameter(3)
        .filter(|_| is_request && asks)
        .map(|station| station as SystemId)
}

fn accepted(frame: &Frame) -> Outgoing {
    let mut payload = REQUEST_CONTROL.to_le_bytes().to_vec();
    payload.extend_from_slice(&[0; 6]);
    payload.extend_from_slice(&[frame.system, frame.component]);
    Outgoing::Raw {
        id: COMMAND_ACK_DATA::ID,
        payload,
    }
}
