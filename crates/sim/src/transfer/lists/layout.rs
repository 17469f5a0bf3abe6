//! The layout of items in messages.

use mavlink::dialects::ardupilotmega::MavMissionResult;

use crate::payload::{Payload, Writer};
use crate::plan::{Item, ListKind};
use sortie_plan::board;

/// An item as it is sent in a message.
pub(super) struct Travelling {
    pub(super) item: Item,
    pub(super) seq: u16,
    pub(super) current: u8,
    pub(super) number: u8,
}

impl Travelling {
    pub(super) fn read(payload: &Payload) -> Self {
        Self {
            item: item_at(payload, 0),
            seq: payload.short(28),
            current: payload.byte(35),
            number: payload.byte(37),
        }
    }
}

/// The item at an offset, in the layout of `MISSION_ITEM_INT`.
pub(in crate::transfer) fn item_at(payload: &Payload, at: usize) -> Item {
    Item {
        command: payload.short(at + 30),
        frame: payload.byte(at + 34),
        auto_continue: payload.byte(at + 36) != 0,
        params: [0, 4, 8, 12].map(|place| payload.float(at + place)),
        x: payload.word(at + 16) as i32,
        y: payload.word(at + 20) as i32,
        z: payload.float(at + 24),
    }
}

/// An item in the layout of `MISSION_ITEM_INT`, for a receiver.
pub(in crate::transfer) fn laid_out(
    item: &Item,
    seq: u16,
    to: [u8; 2],
    kind: ListKind,
    place: [u8; 8],
) -> Vec<u8> {
    let writer = item
        .params
        .iter()
        .fold(Writer::default(), |writer, value| writer.float(*value));
    writer
        .bytes(&place)
        .float(item.z)
        .short(seq)
        .short(item.command)
        .bytes(&to)
        .bytes(&[item.frame, 0, u8::from(item.auto_continue), kind.number()])
        .done()
}

/// The place of an item as two integers.
pub(in crate::transfer) fn whole_place(item: &Item) -> [u8; 8] {
    let mut place = [0; 8];
    place[..4].copy_from_slice(&item.x.to_le_bytes());
    place[4..].copy_from_slice(&item.y.to_le_bytes());
    place
}

/// The place of an item as two floats: degrees, or the bare numbers.
pub(super) fn float_place(item: &Item) -> [u8; 8] {
    let scale = if board::has_place(item.command) {
        1e-7
    } else {
        1.0
    };
    let mut place = [0; 8];
    place[..4].copy_from_slice(&(item.x as f32 * scale).to_le_bytes());
    place[4..].copy_from_slice(&(item.y as f32 * scale).to_le_bytes());
    place
}

/// Converts floats sent in place of integers.
pub(super) fn read_floats(item: &mut Item) -> Result<(), MavMissionResult> {
    let (x, y) = (f32::from_bits(item.x as u32), f32::from_bits(item.y as u32));
    if !board::has_place(item.command) {
        (item.x, item.y) = (x as i32, y as i32);
        return Ok(());
    }
    if x.is_nan() || x.abs() > 90.0 {
        return Err(MavMissionResult::MAV_MISSION_INVALID_PARAM5_X);
    }
    if y.is_nan() || y.abs() > 180.0 {
        return Err(MavMissionResult::MAV_MISSION_INVALID_PARAM6_Y);
    }
    (item.x, item.y) = ((x * 1e7) as i32, (y * 1e7) as i32);
    Ok(())
}
