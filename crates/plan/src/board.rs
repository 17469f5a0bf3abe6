//! ArduPilot's rules for the items of a list, and the form in which it stores them: storage is
//! small, so values that do not fit are truncated or dropped, and a download shows the item as it
//! will be flown. The simulator follows these rules, and the check of a file reports in advance the
//! items that the vehicle would refuse. Source: `AP_Mission`, `AP_Rally` and `AC_Fence` of
//! ArduCopter 4.6.

use std::ops::RangeInclusive;

use sortie_geo::LatLon;

use crate::frame::{ABOVE_HOME, ABOVE_TERRAIN, MISSION, SEA_LEVEL};
use crate::{HeightFrame, Item, ListKind, command};

mod sent;
mod table;
mod unstorable;

pub use sent::as_sent;
use table::letters;
pub use table::{commands, has_place, name};
pub use unstorable::{UnstorableValue, unstorable_values};

/// Why the vehicle refuses an item.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// A command that no list accepts.
    #[error("invalid command")]
    Invalid,
    /// A command that the vehicle does not support, or that does not belong in the list.
    #[error("unsupported command")]
    Command,
    /// A frame that the vehicle does not support.
    #[error("unsupported frame")]
    Frame,
    /// A parameter, from 1 to 7, that is infinite, not set or out of range.
    #[error("invalid parameter {0}")]
    Parameter(u8),
}

/// The maximum number of items in a list; in a plan, this includes home.
pub const fn most_items(kind: ListKind) -> usize {
    match kind {
        ListKind::Plan => 650,
        ListKind::Fence => 70,
        ListKind::Rally => 46,
    }
}

/// Bytes of storage for fences.
pub const FENCE_STORAGE: usize = 560;

/// The bytes that a fence occupies in the vehicle's storage, of [`FENCE_STORAGE`].
pub fn fence_bytes(items: &[Item]) -> usize {
    let mut needed = 4;
    let mut rest = items;
    while let Some(item) = rest.first() {
        let (bytes, length) = if command::is_corner(item.command) {
            let corners = usize::from(item.params[0] as u8);
            (2 + 8 * corners, corners.max(1))
        } else if command::is_circle(item.command) {
            (13, 1)
        } else {
            (9, 1)
        };
        needed += bytes;
        rest = rest.get(length..).unwrap_or_default();
    }
    needed
}

/// The target of a jump if no item of the plan has that number, otherwise `None`; `items` is the
/// number of items, including home.
pub fn wrong_jump(item: &Item, items: usize) -> Option<usize> {
    let target = item.params[0] as usize;
    let is_wrong = item.command == command::DO_JUMP && (target == 0 || target >= items);
    is_wrong.then_some(target)
}

/// Altitudes of this many metres or more, above or below the reference, do not fit into the
/// vehicle's storage.
const ALTITUDE_LIMIT_M: f32 = 83_000.0;

/// Numbers that the vehicle uses internally and refuses in items.
const NEVER_COMMANDS: RangeInclusive<u16> = 0..=1;

/// The item of a mission as the vehicle keeps it.
///
/// # Errors
/// The reason why the vehicle refuses it.
pub fn plan_item(item: &Item) -> Result<Item, Refusal> {
    check_numbers(item)?;
    if NEVER_COMMANDS.contains(&item.command) {
        return Err(Refusal::Invalid);
    }
    let kept = letters(item.command).ok_or(Refusal::Command)?;
    let mut stored = Item {
        command: item.command,
        auto_continue: true,
        ..Item::default()
    };
    for (place, value) in item.params.iter().enumerate() {
        stored.params[place] = shortened(kept[place], *value);
    }
    if kept[4] == b'L' {
        check_place(item)?;
        if item.z.is_nan() || item.z.abs() >= ALTITUDE_LIMIT_M {
            return Err(Refusal::Parameter(7));
        }
        stored.x = item.x;
        stored.y = item.y;
        stored.z = (item.z * 100.0).trunc() * 0.01;
        stored.frame = match item.frame {
            MISSION => SEA_LEVEL,
            other => height_frame(other)?,
        };
    } else {
        stored.x = shortened_place(kept[4], item.x);
        stored.y = shortened_place(kept[5], item.y);
        stored.z = shortened(kept[6], item.z);
    }
    Ok(stored)
}

/// The item of a mission without the coordinates that the vehicle does not store: in `ArduPilot`'s
/// mission file, these repeat the coordinates of the previous item.
#[must_use]
pub fn without_leftovers(item: &Item) -> Item {
    let Some(kept) = letters(item.command) else {
        return *item;
    };
    let keeps = |parameter: usize| kept[4] == b'L' || kept[parameter] != b'.';
    Item {
        x: if keeps(4) { item.x } else { 0 },
        y: if keeps(5) { item.y } else { 0 },
        z: if keeps(6) { item.z } else { 0.0 },
        ..*item
    }
}

/// An item as the vehicle keeps it in the list that it belongs to.
///
/// # Errors
/// The reason why the vehicle refuses it.
pub fn kept(kind: ListKind, item: &Item) -> Result<Item, Refusal> {
    match kind {
        ListKind::Plan => plan_item(item),
        ListKind::Fence => fence_item(item),
        ListKind::Rally => rally_item(item),
    }
}

/// A rally point as the vehicle keeps it.
///
/// # Errors
/// The reason why the vehicle refuses it.
pub fn rally_item(item: &Item) -> Result<Item, Refusal> {
    if item.command != command::RALLY_POINT {
        return Err(Refusal::Command);
    }
    check_place(item)?;
    // Whole metres in 16 bits.
    if item.z.is_nan() || item.z < f32::from(i16::MIN) || item.z > f32::from(i16::MAX) {
        return Err(Refusal::Parameter(7));
    }
    Ok(Item {
        command: item.command,
        frame: height_frame(item.frame)?,
        x: item.x,
        y: item.y,
        z: item.z.trunc(),
        ..Item::default()
    })
}

/// A corner, circle or return point of a fence as the vehicle keeps it. The fence as a whole is
/// checked when it is complete.
///
/// # Errors
/// The reason why the vehicle refuses it.
pub fn fence_item(item: &Item) -> Result<Item, Refusal> {
    height_frame(item.frame)?;
    let first = match item.command {
        command::FENCE_POLYGON_INCLUSION | command::FENCE_POLYGON_EXCLUSION => {
            f32::from(item.params[0] as u8)
        }
        // Radii close to whole metres are kept as whole metres.
        command::FENCE_CIRCLE_INCLUSION | command::FENCE_CIRCLE_EXCLUSION
            if item.params[0].fract() < 0.001 =>
        {
            item.params[0].trunc()
        }
        command::FENCE_CIRCLE_INCLUSION | command::FENCE_CIRCLE_EXCLUSION => item.params[0],
        command::FENCE_RETURN_POINT => 0.0,
        _ => return Err(Refusal::Command),
    };
    Ok(Item {
        command: item.command,
        params: [first, 0.0, 0.0, 0.0],
        x: item.x,
        y: item.y,
        ..Item::default()
    })
}

fn check_place(item: &Item) -> Result<(), Refusal> {
    if !LatLon::from_e7(item.x, 0).is_valid() {
        return Err(Refusal::Parameter(5));
    }
    if !LatLon::from_e7(0, item.y).is_valid() {
        return Err(Refusal::Parameter(6));
    }
    Ok(())
}

/// Refuses infinite parameters, and NaN except where it means "keep the current value".
fn check_numbers(item: &Item) -> Result<(), Refusal> {
    let may_be_nan: &[usize] = match item.command {
        command::WAYPOINT | command::LAND | command::TAKEOFF | command::VTOL_TAKEOFF => &[3],
        command::VTOL_LAND => &[2, 3],
        _ => &[],
    };
    let reasons = [
        Refusal::Parameter(1),
        Refusal::Parameter(2),
        Refusal::Parameter(3),
        Refusal::Parameter(4),
    ];
    for (place, reason) in reasons.into_iter().enumerate() {
        let value = item.params[place];
        if value.is_infinite() || (value.is_nan() && !may_be_nan.contains(&place)) {
            return Err(reason);
        }
    }
    Ok(())
}

/// The frame as a download shows it: relative to sea level, home or terrain.
fn height_frame(frame: u8) -> Result<u8, Refusal> {
    match HeightFrame::of(frame) {
        HeightFrame::SeaLevel => Ok(SEA_LEVEL),
        HeightFrame::Home => Ok(ABOVE_HOME),
        HeightFrame::Terrain => Ok(ABOVE_TERRAIN),
        HeightFrame::Other => Err(Refusal::Frame),
    }
}

/// A fifth or sixth parameter that is no place: a whole number from the beginning.
fn shortened_place(letter: u8, value: i32) -> i32 {
    match letter {
        b'B' => i32::from(value as u8),
        b'b' => i32::from(value as i8),
        b'H' => i32::from(value as u16),
        b'h' => i32::from(value as i16),
        _ => shortened(letter, value as f32) as i32,
    }
}

fn shortened(letter: u8, value: f32) -> f32 {
    let direction = if value < 0.0 { -1.0 } else { 1.0 };
    match letter {
        b't' if value > 0.0 && value < 1.0 => (value * 256.0).trunc() / 256.0,
        b't' if value > 255.0 => 255.0,
        b'B' | b't' => f32::from(wrapped(value) as u8),
        b'b' => f32::from(wrapped(value) as i8),
        b'H' => f32::from(wrapped(value) as u16),
        b'h' => f32::from(wrapped(value) as i16),
        b'f' if value.is_finite() => value,
        b'c' => f32::from(wrapped(value * 100.0) as u16) / 100.0,
        b'1' => f32::from((wrapped(value) & 1) as u8),
        b'o' => f32::from(u8::from(value > 0.0)),
        b'r' if value.abs() <= 255.0 => direction * value.abs().trunc(),
        b'r' => direction * 10.0 * f32::from((value.abs() * 0.1) as u8),
        b's' => direction * f32::from(wrapped(value.abs()) as u16),
        b'd' => direction,
        _ => 0.0,
    }
}

/// The whole part of a value. A field with fewer bits keeps only the lowest ones, so values too
/// large for it wrap. A value beyond 32 bits gives `i32::MIN`; its lowest bits are 0.
fn wrapped(value: f32) -> i32 {
    let whole = f64::from(value).trunc();
    if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&whole) {
        whole as i32
    } else {
        i32::MIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(command: u16, p: [f32; 4]) -> Item {
        Item {
            command,
            frame: ABOVE_HOME,
            params: p,
            x: -353_632_620,
            y: 1_491_652_370,
            z: 20.25,
            ..Item::default()
        }
    }

    /// As a real vehicle returned them.
    #[test]
    fn whole_numbers_beside_a_place_keep_their_lowest_bits() {
        let sent = Item {
            x: -353_629_925,
            y: 1_491_652_920,
            ..item(202, [1.0, 2.0, 3.0, 0.0])
        };
        let stored = plan_item(&sent).expect("stored");
        assert_eq!([stored.x, stored.y], [27, 56]);
    }

    #[test]
    fn parameters_are_kept_as_the_storage_allows() {
        for (command, sent, kept) in [
            (16, [3.9, 5.0, 6.0, f32::NAN], [3.0, 0.0, 0.0, 0.0]),
            (18, [0.5, 0.0, -80.0, 1.0], [0.5, 0.0, -80.0, 1.0]),
            (18, [3.0, 0.0, 777.0, 0.0], [3.0, 0.0, 770.0, 0.0]),
            // Turns and radii that do not fit into their byte are limited to its maximum.
            (18, [300.0, 0.0, 3000.0, 0.0], [255.0, 0.0, 2550.0, 0.0]),
            (17, [0.0, 0.0, -70_000.0, 0.0], [0.0, 0.0, -4464.0, 0.0]),
            // Values too large for a field wrap.
            (181, [300.5, -1.0, 0.0, 0.0], [44.0, 255.0, 0.0, 0.0]),
            (16, [70_000.0, 0.0, 0.0, 0.0], [4464.0, 0.0, 0.0, 0.0]),
            (223, [0.0, 0.0, 0.0, 4.0], [0.0, 0.0, 0.0, 0.0]),
            (223, [0.0, 0.0, 0.0, 5.0], [0.0, 0.0, 0.0, 1.0]),
            (19, [30.0, 0.0, 0.0, 0.0], [30.0, 0.0, 1.0, 0.0]),
            (21, [0.0, 0.0, 0.0, f32::NAN], [0.0, 0.0, 0.0, 1.0]),
            (93, [5.0, -1.0, -1.0, -1.0], [5.0, -1.0, -1.0, -1.0]),
            (177, [2.0, -1.0, 0.0, 0.0], [2.0, -1.0, 0.0, 0.0]),
            (178, [1.0, 4.5, -1.0, 9.0], [1.0, 4.5, -1.0, 0.0]),
            (183, [9.0, 1700.0, 0.0, 0.0], [9.0, 1700.0, 0.0, 0.0]),
        ] {
            let stored = plan_item(&item(command, sent)).expect("known");
            let stored = stored.params.map(f32::to_bits);
            assert_eq!(stored, kept.map(f32::to_bits), "command {command}");
        }
    }

    #[test]
    fn places_are_kept_only_by_commands_that_have_one() {
        let waypoint = plan_item(&item(16, [0.0; 4])).expect("known");
        assert_eq!((waypoint.frame, waypoint.x), (3, -353_632_620));
        assert!((waypoint.z - 20.25).abs() < 0.011);
        let home = plan_item(&item(20, [0.0; 4])).expect("known");
        assert_eq!((home.frame, home.x, home.y), (0, 0, 0));
    }

    #[test]
    fn what_cannot_be_kept_is_refused_with_its_reason() {
        let far = Item {
            x: 910_000_000,
            ..item(16, [0.0; 4])
        };
        let frame = Item {
            frame: 12,
            ..item(16, [0.0; 4])
        };
        let nan = Item {
            z: f32::NAN,
            ..item(16, [0.0; 4])
        };
        for (bad, reason) in [
            (item(31_010, [0.0; 4]), Refusal::Command),
            (item(195, [0.0; 4]), Refusal::Command),
            (item(1, [0.0; 4]), Refusal::Invalid),
            (item(16, [f32::NAN, 0.0, 0.0, 0.0]), Refusal::Parameter(1)),
            (far, Refusal::Parameter(5)),
            (frame, Refusal::Frame),
            (nan, Refusal::Parameter(7)),
        ] {
            assert_eq!(plan_item(&bad), Err(reason), "{bad:?}");
        }
    }
}
