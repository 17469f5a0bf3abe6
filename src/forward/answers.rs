//! The answers of vehicles to other ground stations.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, MISSION_ACK_DATA, MavMessage, MavMissionResult, MavMissionType,
    PARAM_VALUE_DATA,
};

use super::commands::{Deed, NamedCommand, named};
use crate::commands::AckResult;
use crate::ledger::{RowEnding, RowState, StationId};
use crate::text::Text;
use crate::wire::{Content, MavAddress};

/// An answer to a station.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StationAnswer {
    /// The station; `None` if the answer goes to all stations.
    pub station: Option<StationId>,
    pub to: Answered,
    pub ending: RowEnding,
}

/// The subject of an answer.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Answered {
    Command(NamedCommand),
    Plan(MavMissionType),
    /// The parameter of this name has this value now.
    Parameter(String, f32),
}

impl Answered {
    /// Whether this is an answer to an action.
    pub fn fits(&self, deed: &Deed) -> bool {
        match (self, deed) {
            (Self::Command(command), _) => deed.is_answered_by(command.number),
            (Self::Plan(list), Deed::Plan(of, _)) => list == of,
            (Self::Parameter(name, _), Deed::Parameter(of, _)) => name == of,
            (Self::Plan(_) | Self::Parameter(..), _) => false,
        }
    }

    /// The action that can be inferred from the answer alone; `None` if the answer does not identify one.
    pub fn deed(&self) -> Option<Deed> {
        match self {
            Self::Command(command) => Some(Deed::Command(command.clone())),
            Self::Plan(_) | Self::Parameter(..) => None,
        }
    }
}

/// The answer in a frame; `None` if it is addressed to the console itself (`own`) or to no station
/// in particular, or answers a question.
pub(super) fn answer_in(content: &Content, own: MavAddress) -> Option<StationAnswer> {
    match content {
        Content::Message(MavMessage::COMMAND_ACK(ack)) => Some(StationAnswer {
            station: Some(station(ack.target_system, ack.target_component, own)?),
            to: Answered::Command(named(ack.command)?),
            ending: ending(AckResult::from_wire(ack.result as u8), ack.progress),
        }),
        Content::Undecoded { id, payload } if *id == COMMAND_ACK_DATA::ID => {
            let number = u16::from_le_bytes([payload[0], payload[1]]);
            let name = number.to_string();
            Some(StationAnswer {
                station: Some(station(payload[8], payload[9], own)?),
                to: Answered::Command(NamedCommand { number, name }),
                ending: ending(AckResult::from_wire(payload[2]), payload[3]),
            })
        }
        Content::Message(MavMessage::MISSION_ACK(ack)) => loaded(ack, own),
        Content::Message(MavMessage::PARAM_VALUE(value)) => parameter(value),
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

/// The station of an address; `None` for the console itself and for all. Autopilots that leave the component out answer
/// the whole system.
fn station(system: u8, component: u8, own: MavAddress) -> Option<StationId> {
    let address = MavAddress { system, component };
    let is_own = address == own || (system == own.system && component == 0);
    (system != 0 && !is_own).then_some(StationId(address))
}

fn ending(result: AckResult, progress: u8) -> RowEnding {
    let state = match result {
        AckResult::Accepted => RowState::Accepted,
        AckResult::InProgress => RowState::InProgress(if progress > 100 { 0 } else { progress }),
        AckResult::Cancelled => RowState::Superseded,
        AckResult::TemporarilyRejected
        | AckResult::Denied
        | AckResult::Unsupported
        | AckResult::Failed
        | AckResult::LongOnly
        | AckResult::IntOnly
        | AckResult::UnsupportedFrame
        | AckResult::NotInControl
        | AckResult::Other(_) => RowState::Refused,
    };
    RowEnding::new(state, result.reason())
}

fn loaded(ack: &MISSION_ACK_DATA, own: MavAddress) -> Option<StationAnswer> {
    let is_accepted = ack.mavtype == MavMissionResult::MAV_MISSION_ACCEPTED;
    let ending = if is_accepted {
        RowEnding::new(RowState::Accepted, Text::default())
    } else {
        let name = format!("{:?}", ack.mavtype);
        let reason = Text::verbatim(name.trim_start_matches("MAV_MISSION_"));
        RowEnding::new(RowState::Refused, reason)
    };
    Some(StationAnswer {
        station: Some(station(ack.target_system, ack.target_component, own)?),
        to: Answered::Plan(ack.mission_type),
        ending,
    })
}

fn parameter(value: &PARAM_VALUE_DATA) -> Option<StationAnswer> {
    let name = value.param_id.to_str().ok()?.to_owned();
    Some(StationAnswer {
        station: None,
        to: Answered::Parameter(name, value.param_value),
        ending: RowEnding::new(RowState::Accepted, Text::default()),
    })
}
