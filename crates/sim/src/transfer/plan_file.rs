//! A list as a file: `@MISSION/mission.dat`, `fence.dat` and `rally.dat`.
//!
//! A header of five 16-bit numbers (magic, list, options, first item, items), then each item in the layout of
//! `MISSION_ITEM_INT`.

use super::items;
use super::lists::{self, item_at, laid_out, leads_somewhere, whole_place};
use crate::autopilot::Autopilot;
use crate::payload::{Payload, Writer};
use crate::plan::{Item, ListKind};
use crate::vehicle::Vehicle;
use sortie_plan::board;

const MAGIC: u16 = 0x763D;
const HEADER: usize = 10;
const ITEM: usize = 38;
/// Option bit: items are added to the existing list, or replace some of its items.
const KEEP_THE_REST: u16 = 1;
/// The reported length of each file.
pub(super) const ESTIMATED_LEN: usize = 1024 * 1024;

/// The list of a file; `None` if no such file exists.
pub(super) fn kind_of(name: &str) -> Option<ListKind> {
    match name {
        "mission.dat" => Some(ListKind::Plan),
        "fence.dat" => Some(ListKind::Fence),
        "rally.dat" => Some(ListKind::Rally),
        _ => None,
    }
}

/// A list as a file.
pub(super) fn pack(vehicle: &Vehicle, kind: ListKind) -> Vec<u8> {
    let length = vehicle.plans.list(kind).len();
    let mut before = Item::default();
    let mut writer = Writer::default();
    for number in [MAGIC, kind as u16, 0, 0, length as u16] {
        writer = writer.short(number);
    }
    let to = [u8::from(kind == ListKind::Plan); 2];
    for seq in 0..length {
        if let Some(item) = lists::as_sent(vehicle, kind, seq) {
            // A command without a place repeats the place of the item before, as in the real
            // vehicle's file.
            let item = if board::has_place(item.command) || kind != ListKind::Plan {
                item
            } else {
                repeating(&item, &before)
            };
            before = item;
            let place = whole_place(&item);
            writer = writer.bytes(&laid_out(&item, seq as u16, to, kind, place));
        }
    }
    writer.done()
}

/// An item; coordinates that its command does not store are taken from `other`.
fn repeating(item: &Item, other: &Item) -> Item {
    let other = Item {
        command: item.command,
        ..*other
    };
    let kept = board::without_leftovers(&other);
    let take = |own: i32, other: i32, kept: i32| if kept == other { own } else { other };
    Item {
        x: take(item.x, other.x, kept.x),
        y: take(item.y, other.y, kept.y),
        z: if kept.z.to_bits() == other.z.to_bits() {
            item.z
        } else {
            other.z
        },
        ..*item
    }
}

/// Stores a file that a ground station wrote; `false` if it is incomplete or invalid.
pub(super) fn take(autopilot: &mut Autopilot, kind: ListKind, file: &[u8]) -> bool {
    let number = |at: usize| {
        let bytes = file.get(at..at + 2).and_then(|two| two.try_into().ok());
        bytes.map_or(0, u16::from_le_bytes)
    };
    let items = file.get(HEADER..).unwrap_or_default();
    let (options, start, count) = (number(4), usize::from(number(6)), usize::from(number(8)));
    let blank = items
        .chunks_exact(ITEM)
        .any(|item| item.iter().all(|byte| *byte == 0));
    if number(0) != MAGIC || items.len() / ITEM != count || blank {
        return false;
    }
    let items: Vec<Item> = items
        .chunks_exact(ITEM)
        .map(|bytes| item_at(&Payload::new(bytes), 0))
        .collect();
    let keep = options & KEEP_THE_REST != 0;
    match kind {
        ListKind::Plan => take_mission(autopilot, &items, start, keep),
        ListKind::Fence | ListKind::Rally => !keep && take_list(autopilot, kind, &items),
    }
}

/// Stores a whole list; a plan begins with home. `false` if the vehicle refuses it.
pub(super) fn take_list(autopilot: &mut Autopilot, kind: ListKind, items: &[Item]) -> bool {
    if kind == ListKind::Plan {
        return take_mission(autopilot, items, 0, false);
    }
    let kept: Result<Vec<_>, _> = items.iter().map(|item| items::kept(kind, item)).collect();
    kept.is_ok_and(|kept| match kind {
        ListKind::Fence => lists::take_fence(autopilot, kept),
        ListKind::Plan | ListKind::Rally => lists::replace(autopilot, kind, kept),
    })
}

fn take_mission(autopilot: &mut Autopilot, items: &[Item], start: usize, keep: bool) -> bool {
    let mut mission = if keep {
        autopilot.vehicle.plans.mission.clone()
    } else {
        Vec::new()
    };
    for (seq, item) in items.iter().enumerate() {
        let Ok(item) = items::kept(ListKind::Plan, item) else {
            return false;
        };
        if !leads_somewhere(&item, items.len()) {
            return false;
        }
        if let Some(slot) = mission.get_mut(start + seq) {
            *slot = item;
        } else if mission.len() == start + seq {
            mission.push(item);
        } else {
            return false;
        }
    }
    lists::replace(autopilot, ListKind::Plan, mission)
}
