//! A list as a file of the vehicle: `@MISSION/mission.dat`, `fence.dat` and `rally.dat`; and the layout of its items,
//! which is that of `MISSION_ITEM_INT`. Source: `AP_Filesystem_Mission.cpp` of `ArduPilot`.

use crate::plan::{Item, ListKind, board};
use crate::wire::MavAddress;

const MAGIC: u16 = 0x763D;
/// Magic number, list, options, first item, number of items.
const HEADER: usize = 10;
const ITEM: usize = 38;

/// The path of a list in the vehicle's file system.
pub(super) fn path(kind: ListKind) -> &'static str {
    match kind {
        ListKind::Plan => "@MISSION/mission.dat",
        ListKind::Fence => "@MISSION/fence.dat",
        ListKind::Rally => "@MISSION/rally.dat",
    }
}

/// The payload of `MISSION_ITEM_INT`, even for commands and frames that are missing from the dialect.
pub(super) fn laid_out(item: &Item, seq: u16, to: MavAddress, kind: ListKind) -> Vec<u8> {
    let sent = match kind {
        ListKind::Plan => board::as_sent(item),
        ListKind::Fence | ListKind::Rally => *item,
    };
    let mut bytes = Vec::with_capacity(ITEM);
    for value in sent.params {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend(sent.x.to_le_bytes());
    bytes.extend(sent.y.to_le_bytes());
    bytes.extend(sent.z.to_le_bytes());
    bytes.extend(seq.to_le_bytes());
    bytes.extend(sent.command.to_le_bytes());
    bytes.extend([to.system, to.component, sent.frame, 0]);
    bytes.extend([u8::from(sent.auto_continue), kind.number()]);
    bytes
}

/// A list as a file. Lists too long for the format do not fit on any vehicle.
pub(super) fn pack(kind: ListKind, items: &[Item], to: MavAddress) -> Vec<u8> {
    let count = items.len() as u16;
    let mut bytes = Vec::with_capacity(HEADER + ITEM * items.len());
    for number in [MAGIC, u16::from(kind.number()), 0, 0, count] {
        bytes.extend(number.to_le_bytes());
    }
    for (seq, item) in (0..).zip(items) {
        bytes.extend(laid_out(item, seq, to, kind));
    }
    bytes
}

/// The items in a file; `None` if it is not a complete file of that list.
pub(super) fn unpack(kind: ListKind, file: &[u8]) -> Option<Vec<Item>> {
    let short = |at: usize| Some(u16::from_le_bytes(*file.get(at..)?.first_chunk()?));
    let rest = file.get(HEADER..)?;
    let is_whole = rest.len() == ITEM * usize::from(short(8)?);
    if short(0)? != MAGIC || short(2)? != u16::from(kind.number()) || short(6)? != 0 || !is_whole {
        return None;
    }
    let items = rest.chunks_exact(ITEM).map(item_at);
    match kind {
        ListKind::Plan => items
            .map(|item| item.as_ref().map(board::without_leftovers))
            .collect(),
        ListKind::Fence | ListKind::Rally => items.collect(),
    }
}

fn item_at(bytes: &[u8]) -> Option<Item> {
    let word = |at: usize| bytes.get(at..)?.first_chunk().copied();
    let float = |at: usize| word(at).map(f32::from_le_bytes);
    let whole = |at: usize| word(at).map(i32::from_le_bytes);
    Some(Item {
        command: u16::from_le_bytes(*bytes.get(30..)?.first_chunk()?),
        frame: *bytes.get(34)?,
        auto_continue: *bytes.get(36)? != 0,
        params: [float(0)?, float(4)?, float(8)?, float(12)?],
        x: whole(16)?,
        y: whole(20)?,
        z: float(24)?,
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn any_item() -> impl Strategy<Value = Item> {
        let numbers = (any::<[f32; 4]>(), any::<i32>(), any::<i32>(), any::<f32>());
        (any::<u16>(), any::<u8>(), any::<bool>(), numbers).prop_map(
            |(command, frame, auto_continue, (params, x, y, z))| Item {
                command,
                frame,
                auto_continue,
                params,
                x,
                y,
                z,
            },
        )
    }

    proptest! {
        #[test]
        fn what_is_packed_comes_back(items in proptest::collection::vec(any_item(), 0..9)) {
            let to = MavAddress { system: 3, component: 1 };
            let file = pack(ListKind::Fence, &items, to);
            prop_assert_eq!(unpack(ListKind::Fence, &file), Some(items));
            prop_assert_eq!(unpack(ListKind::Rally, &file), None);
            prop_assert_eq!(unpack(ListKind::Fence, &file[..file.len() - 1]), None);
        }
    }
}
