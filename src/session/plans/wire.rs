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

use crate::geo::LatLon;
use crate::vehicle::{HeightFrame, PlanItem, PlanKind};
use crate::wire::{Content, Frame, GROUND_STATION_SYSTEM, MavAddress};

/// MAVLink ids of the messages that carry an item.
const MISSION_ITEM: u32 = MISSION_ITEM_DATA::ID;
const MISSION_ITEM_INT: u32 = MISSION_ITEM_INT_DATA::ID;

/// A vehicle's answer about a list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Answer {
    /// The number of items (`MISSION_COUNT`).
    Count(u16),
    /// One item (`MISSION_ITEM_INT` or `MISSION_ITEM`).
    Item(PlanItem),
    /// `MISSION_ACK`: for a reader always a refusal.
    Refused(MavMissionResult),
}

/// The form of items: positions as integers, or as floats for vehicles that support only those.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Int,
    Float,
}

/// The answer in a frame, with the list that it is about. Answers to other ground stations do not count.
pub(super) fn answer(frame: &Frame) -> Option<(PlanKind, Answer)> {
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
            (data.target_system, kind, Answer::Item(item_int(data)))
        }
        Content::Message(MavMessage::MISSION_ITEM(data)) => {
            let kind = kind(data.mission_type as u8)?;
            (data.target_system, kind, Answer::Item(item_float(data)))
        }
        Content::Undecoded { id, payload } if matches!(*id, MISSION_ITEM | MISSION_ITEM_INT) => {
            let item = item_by_hand(payload, *id == MISSION_ITEM_INT);
            (payload[32], kind(payload[37])?, Answer::Item(item))
        }
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => return None,
    };
    (target == 0 || target == GROUND_STATION_SYSTEM).then_some((kind, answer))
}

/// The list of another program's upload that the vehicle has just accepted.
pub(super) fn others_upload(frame: &Frame) -> Option<PlanKind> {
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
pub(super) fn request_list(vehicle: MavAddress, kind: PlanKind) -> MavMessage {
    MavMessage::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
        mission_type: mission_type(kind),
    })
}

pub(super) fn request_item(
    vehicle: MavAddress,
    kind: PlanKind,
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
pub(super) fn acknowledge(
    vehicle: MavAddress,
    kind: PlanKind,
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

fn mission_type(kind: PlanKind) -> MavMissionType {
    match kind {
        PlanKind::Plan => MavMissionType::MAV_MISSION_TYPE_MISSION,
        PlanKind::Fence => MavMissionType::MAV_MISSION_TYPE_FENCE,
        PlanKind::Rally => MavMissionType::MAV_MISSION_TYPE_RALLY,
    }
}

fn kind(mission_type: u8) -> Option<PlanKind> {
    let mut kinds = PlanKind::ALL.iter().copied();
    kinds.find(|kind| self::mission_type(*kind) as u8 == mission_type)
}

/// The common fields of both item messages.
macro_rules! wire_item {
    ($data:expr, $place:expr) => {
        WireItem {
            seq: $data.seq,
            command: $data.command as u16,
            frame: $data.frame as u8,
            params: [$data.param1, $data.param2, $data.param3, $data.param4],
            place: $place,
            z: $data.z,
        }
    };
}

fn item_int(data: &MISSION_ITEM_INT_DATA) -> PlanItem {
    wire_item!(data, LatLon::from_e7(data.x, data.y)).read()
}

fn item_float(data: &MISSION_ITEM_DATA) -> PlanItem {
    wire_item!(data, LatLon::new(f64::from(data.x), f64::from(data.y))).read()
}

/// An item whose command or frame is unknown to the dialect, by its layout on the wire: four parameters, x, y, z, the
/// number, the command, target system and component, the frame.
fn item_by_hand(payload: &[u8; 255], is_int: bool) -> PlanItem {
    let word = |at: usize| {
        [
            payload[at],
            payload[at + 1],
            payload[at + 2],
            payload[at + 3],
        ]
    };
    let float = |at: usize| f32::from_le_bytes(word(at));
    let place = if is_int {
        LatLon::from_e7(i32::from_le_bytes(word(16)), i32::from_le_bytes(word(20)))
    } else {
        LatLon::new(f64::from(float(16)), f64::from(float(20)))
    };
    WireItem {
        seq: u16::from_le_bytes([payload[28], payload[29]]),
        command: u16::from_le_bytes([payload[30], payload[31]]),
        frame: payload[34],
        params: [float(0), float(4), float(8), float(12)],
        place,
        z: float(24),
    }
    .read()
}

/// The common content of both forms of an item.
struct WireItem {
    seq: u16,
    command: u16,
    /// `MAV_FRAME`, known to the dialect or not.
    frame: u8,
    params: [f32; 4],
    place: LatLon,
    /// Metres above the reference of the frame.
    z: f32,
}

impl WireItem {
    fn read(self) -> PlanItem {
        let place = self.place;
        let is_somewhere = place.is_valid() && (place.lat_deg, place.lon_deg) != (0.0, 0.0);
        let frame = HeightFrame::from_wire(self.frame);
        let has_place = frame != HeightFrame::Other && PlanItem::has_place(self.command);
        PlanItem {
            seq: self.seq,
            command: self.command,
            frame,
            params: self.params,
            at_point: (is_somewhere && has_place).then_some(place),
            altitude_m: self.z.is_finite().then_some(self.z),
        }
    }
}
