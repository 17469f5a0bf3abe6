//! Changes to a plan. Each returns a new list, so that undo can keep the old one; jumps still lead to the same items.
//!
//! Indices in a list are counted from 0; jump targets from 1, because 0 is home.

use std::ops::Range;

use crate::{HeightFrame, Home, Item, command};

/// Why a change to a plan is not possible.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// No such item; contains the length of the list.
    #[error("the plan has {0} items")]
    NoItem(usize),
    /// A jump leads to an item that would be deleted; contains the index of the jump.
    #[error("item {} jumps to an item that would be deleted", .0 + 1)]
    JumpTarget(usize),
    /// No leg to split: no item before this one has a place.
    #[error("no leg leads to the item")]
    NoLeg,
    /// The height cannot be converted without the height of home or of the ground.
    #[error("the height of home or of the ground is not known")]
    UnknownHeight,
}

/// The target of a jump as an index in the list, if it has one.
fn target_of(item: &Item) -> Option<usize> {
    let is_jump = item.command == command::DO_JUMP && item.params[0] >= 1.0;
    is_jump.then(|| item.params[0] as usize - 1)
}

/// Changes the target of each jump to the index that `moved` returns for it.
fn aimed(mut items: Vec<Item>, moved: impl Fn(usize) -> usize) -> Vec<Item> {
    for item in &mut items {
        if let Some(target) = target_of(item) {
            item.params[0] = (moved(target) + 1) as f32;
        }
    }
    items
}

fn checked(items: &[Item], range: &Range<usize>) -> Result<(), EditError> {
    if range.start < range.end && range.end <= items.len() {
        Ok(())
    } else {
        Err(EditError::NoItem(items.len()))
    }
}

/// Inserts items so that the first of them gets the index `at`. Jumps among the new items refer to
/// the new list.
///
/// # Errors
/// `at` is beyond the end.
pub fn insert(items: &[Item], at: usize, new: &[Item]) -> Result<Vec<Item>, EditError> {
    if at > items.len() {
        return Err(EditError::NoItem(items.len()));
    }
    let shift = |target| {
        if target >= at {
            target + new.len()
        } else {
            target
        }
    };
    let mut changed = aimed(items.to_vec(), shift);
    changed.splice(at..at, new.iter().copied());
    Ok(changed)
}

/// Deletes items. Jumps among them are deleted with them.
///
/// # Errors
/// The range is empty or out of bounds, or a jump outside it leads to one of its items.
pub fn delete(items: &[Item], range: Range<usize>) -> Result<Vec<Item>, EditError> {
    checked(items, &range)?;
    let mut rest = items.iter().enumerate();
    let into = |target: Option<usize>| target.is_some_and(|target| range.contains(&target));
    if let Some((jump, _)) = rest.find(|(at, item)| !range.contains(at) && into(target_of(item))) {
        return Err(EditError::JumpTarget(jump));
    }
    let mut changed = items.to_vec();
    changed.drain(range.clone());
    let shift = |target| {
        if target >= range.end {
            target - range.len()
        } else {
            target
        }
    };
    Ok(aimed(changed, shift))
}

/// Moves items so that the first of them gets the index `to` of the new list.
///
/// # Errors
/// The range is empty or out of bounds, or the new index is beyond the end.
pub fn relocate(items: &[Item], range: Range<usize>, to: usize) -> Result<Vec<Item>, EditError> {
    checked(items, &range)?;
    if to + range.len() > items.len() {
        return Err(EditError::NoItem(items.len()));
    }
    let mut order: Vec<usize> = (0..items.len()).collect();
    let taken: Vec<usize> = order.drain(range).collect();
    order.splice(to..to, taken);
    let changed = order.iter().map(|from| items[*from]).collect();
    let place = |target| order.iter().position(|from| *from == target);
    Ok(aimed(changed, |target| place(target).unwrap_or(target)))
}

/// Puts a waypoint in the middle of the leg that leads to an item.
///
/// # Errors
/// There is no such item, no leg leads to it, or the heights of the leg's two ends have different
/// references.
pub fn split(items: &[Item], at: usize) -> Result<Vec<Item>, EditError> {
    let end = *items.get(at).ok_or(EditError::NoItem(items.len()))?;
    let has_place = |item: &&Item| command::is_flown_to(item.command) && (item.x, item.y) != (0, 0);
    let before = items[..at].iter().rev().find(has_place);
    let start = before
        .filter(|_| has_place(&&end))
        .ok_or(EditError::NoLeg)?;
    if start.height_frame() != end.height_frame() {
        return Err(EditError::UnknownHeight);
    }
    let middle = |a: i32, b: i32| i32::midpoint(a, b);
    let east = i64::from(end.y) - i64::from(start.y);
    // Takes the short way across the date line.
    let y = if east.abs() > 1_800_000_000 {
        let far = i64::midpoint(i64::from(start.y), i64::from(end.y));
        (far - far.signum() * 1_800_000_000) as i32
    } else {
        middle(start.y, end.y)
    };
    let waypoint = Item {
        command: command::WAYPOINT,
        params: [0.0; 4],
        x: middle(start.x, end.x),
        y,
        z: f32::midpoint(start.z, end.z),
        ..end
    };
    // A jump to the end of the leg still leads there.
    insert(items, at, &[waypoint])
}

/// How the heights of several items change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HeightChange {
    /// Sets all heights to this value, in metres.
    To(f32),
    /// Raises (or, if negative, lowers) all heights by this many metres.
    By(f32),
}

/// Changes the heights of the items of a range that have a place, or are a takeoff.
///
/// # Errors
/// The range is empty or out of bounds.
pub fn change_height(
    items: &[Item],
    range: Range<usize>,
    change: HeightChange,
) -> Result<Vec<Item>, EditError> {
    checked(items, &range)?;
    let mut changed = items.to_vec();
    for item in changed[range].iter_mut().filter(|item| has_height(item)) {
        item.z = match change {
            HeightChange::To(height_m) => height_m,
            HeightChange::By(metres) => item.z + metres,
        };
    }
    Ok(changed)
}

fn has_height(item: &Item) -> bool {
    command::is_flown_to(item.command)
}

/// How the numbers change when the frame of a height changes.
#[derive(Clone, Copy)]
pub enum FrameChange<'a> {
    /// The numbers stay the same, so the vehicle flies at a different height.
    KeepNumbers,
    /// The vehicle flies at the same height as before: heights are converted with the height of
    /// home and, where needed, with that of the ground at each item's place (metres above sea
    /// level).
    KeepHeights {
        /// The home position, if the document has one.
        home: Option<Home>,
        /// The height of the ground at an item of the list, in metres above sea level.
        ground_amsl_m: &'a dyn Fn(&Item) -> Option<f32>,
    },
}

/// Changes the reference of the heights in a range; `frame` is the number of a global `MAV_FRAME`.
///
/// # Errors
/// The range is empty or out of bounds, or a required height is unknown.
pub fn change_frame(
    items: &[Item],
    range: Range<usize>,
    frame: u8,
    change: &FrameChange<'_>,
) -> Result<Vec<Item>, EditError> {
    checked(items, &range)?;
    let mut changed = items.to_vec();
    for item in changed[range].iter_mut().filter(|item| has_height(item)) {
        if let FrameChange::KeepHeights {
            home,
            ground_amsl_m,
        } = change
            && item.height_frame() != HeightFrame::of(frame)
        {
            let origin = |frame| match frame {
                HeightFrame::SeaLevel => Some(0.0),
                HeightFrame::Home => home.map(|home| home.z),
                HeightFrame::Terrain => ground_amsl_m(item),
                HeightFrame::Other => None,
            };
            let (from, to) = (origin(item.height_frame()), origin(HeightFrame::of(frame)));
            let (from, to) = from.zip(to).ok_or(EditError::UnknownHeight)?;
            item.z += from - to;
        }
        item.frame = frame;
    }
    Ok(changed)
}

#[cfg(test)]
mod tests;
