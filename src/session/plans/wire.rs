//! The messages of the mission protocol, as the reader of plans sees them.

#![expect(
    deprecated,
    reason = "older vehicles answer only to what the dialect calls superseded"
)]

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    MISSION_ACK_DATA, MISSION_ITEM_DATA, MISSION_ITEM_INT_DATA, MISSION_REQUEST_DATA,
    MISSION_REQUEST_INT_DATA, MISSION_REQUEST_LIST_DATA, MavMessage, MavMissionResult,
    MavMissionType,
};

use crate::plan::command::has_place;
use crate::plan::{Item, ListKind};
use crate::wire::{Content, Frame, MavAddress, SystemId};

/// MAVLink ids of the messages that carry an item.
const MISSION_ITEM: u32 = MISSION_ITEM_DATA::ID;
const MISSION_ITEM_INT: u32 = MISSION_ITEM_INT_DATA::ID;

/// A vehicle's answer about a list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::session) enum Answer {
    /// The number of items (`MISSION_COUNT`).
    Count(u16),
    /// One item with its number (`MISSION_ITEM_INT` or `MISSION_ITEM`).
    Item(u16, Item),
    /// `MISSION_ACK`: for a reader always a refusal.
    Refused(MavMissionResult),
}

/// The form of items: positions as integers, or as floats for vehicles that support only floats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::session) enum Form {
    Int,
    Float,
}

/// The answer in a frame, with the list that it is about. Answers to other ground stations do not count.
pub(in crate::session) fn answer(frame: &Frame, station: SystemId) -> Option<(ListKind, Answer)> {
    let (target, kind, answer) = match &frame.content {
        Content::Message(MavMessage::MISSION_COUNT(data)) => {
            let kind = kind(data.mission_type as u8)?;
            (data.target_system, kind, Answer::Count(data.count))
        }
        Content::Message(MavMessage::MISSION_ACK(data)) => {
            let kind = kind(data.mission_type as u8)?;
            (data.target_system, kind, Answer::Refused(data.mavtype))
        }
        Content::Message(MavMessage::MISSION_ITEM_INT(data)) => {
            let kind = kind(data.mission_type as u8)?;
            (
                data.target_system,
                kind,
                Answer::Item(data.seq, item_int(data)),
            )
        }
        Content::Message(MavMessage::MISSION_ITEM(data)) => {
            let kind = kind(data.mission_type as u8)?;
            (
                data.target_system,
                kind,
                Answer::Item(data.seq, item_float(data)),
            )
        }
        Content::Undecoded { id, payload } if matches!(*id, MISSION_ITEM | MISSION_ITEM_INT) => {
            let seq = u16::from_le_bytes([payload[28], payload[29]]);
            let item = item_by_hand(payload, *id == MISSION_ITEM_INT);
            (payload[32], kind(payload[37])?, Answer::Item(seq, item))
        }
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => return None,
    };
    [0, station].contains(&target).then_some((kind, answer))
}

/// The kind of the list if a frame shows that the vehicle has accepted another program's upload.
pub(in crate::session) fn others_upload(frame: &Frame) -> Option<ListKind> {
    match &frame.content {
        Content::Message(MavMessage::MISSION_ACK(data))
            if data.mavtype == MavMissionResult::MAV_MISSION_ACCEPTED =>
        {
            kind(data.mission_type as u8)
        }
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

/// Requests the length of a list.
pub(in crate::session) fn request_list(vehicle: MavAddress, kind: ListKind) -> MavMessage {
    MavMessage::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
        mission_type: mission_type(kind),
    })
}

pub(in crate::session) fn request_item(
    vehicle: MavAddress,
    kind: ListKind,
    seq: u16,
    form: Form,
) -> MavMessage {
    let mission_type = mission_type(kind);
    match form {
        Form::Int => MavMessage::MISSION_REQUEST_INT(MISSION_REQUEST_INT_DATA {
            seq,
            target_system: vehicle.system,
            target_component: vehicle.component,
            mission_type,
        }),
        Form::Float => MavMessage::MISSION_REQUEST(MISSION_REQUEST_DATA {
            seq,
            target_system: vehicle.system,
            target_component: vehicle.component,
            mission_type,
        }),
    }
}

/// Ends a transfer, either complete or cancelled.
pub(in crate::session) fn acknowledge(
    vehicle: MavAddress,
    kind: ListKind,
    result: MavMissionResult,
) -> MavMessage {
    MavMessage::MISSION_ACK(MISSION_ACK_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
        mavtype: result,
        mission_type: mission_type(kind),
        opaque_id: 0,
    })
}

pub(in crate::session) fn mission_type(kind: ListKind) -> MavMissionType {
    match kind {
        ListKind::Plan => MavMissionType::MAV_MISSION_TYPE_MISSION,
        ListKind::Fence => MavMissionType::MAV_MISSION_TYPE_FENCE,
        ListKind::Rally => MavMissionType::MAV_MISSION_TYPE_RALLY,
    }
}

fn kind(mission_type: u8) -> Option<ListKind> {
    ListKind::numbered(mission_type)
}

/// An item of either message, with `x` and `y` as integers.
macro_rules! item {
    ($data:expr, $x:expr, $y:expr) => {
        Item {
            command: $data.command as u16,
            frame: $data.frame as u8,
            auto_continue: $data.autocontinue != 0,
            params: [$data.param1, $data.param2, $data.param3, $data.param4],
            x: $x,
            y: $y,
            z: $data.z,
        }
    };
}

fn item_int(data: &MISSION_ITEM_INT_DATA) -> Item {
    item!(data, data.x, data.y)
}

fn item_float(data: &MISSION_ITEM_DATA) -> Item {
    let [x, y] = whole([data.x, data.y], data.command as u16);
    item!(data, x, y)
}

/// The place of a `MISSION_ITEM`, given in degrees, as integers; other parameters keep their value.
fn whole(place: [f32; 2], command: u16) -> [i32; 2] {
    let scale = if has_place(command) { 1e7 } else { 1.0 };
    place.map(|value| (f64::from(value) * scale).round() as i32)
}

/// An item whose command or frame is unknown to the dialect, read by its layout in MAVLink: four parameters, x, y, z,
/// the number, the command, target system and component, the frame, whether it is current, whether to continue
/// automatically.
fn item_by_hand(payload: &[u8; 255], is_int: bool) -> Item {
    let word = |at: usize| {
        [
            payload[at],
            payload[at + 1],
            payload[at + 2],
            payload[at + 3],
        ]
    };
    let float = |at: usize| f32::from_le_bytes(word(at));
    let command = u16::from_le_bytes([payload[30], payload[31]]);
    let [x, y] = if is_int {
        [16, 20].map(|at| i32::from_le_bytes(word(at)))
    } else {
        whole([float(16), float(20)], command)
    };
    Item {
        command,
        frame: payload[34],
        auto_continue: payload[36] != 0,
        params: [float(0), float(4), float(8), float(12)],
        x,
        y,
        z: float(24),
    }
}
