//! The places of items and of typed lines, and the refusals if a place is missing.

use std::ops::Range;

use super::edit::{EditPart, Items, Refusal, Spot, Surroundings};
use crate::geo::LatLon;
use crate::plan::edit::EditError;
use crate::plan::{Document, Item, command};
use crate::text;

/// The place of an item, if it has one.
pub fn place(item: &Item) -> Option<LatLon> {
    let is_placed = command::has_place(item.command) && (item.x, item.y) != (0, 0);
    is_placed.then(|| item.point())
}

/// The reason why an edit is refused, in words.
pub(super) fn refused(error: EditError) -> Refusal {
    let reason = match error {
        EditError::NoItem(count) => text!("draft-no-item", count = count),
        EditError::JumpTarget(jump) => text!("draft-jump-target", item = jump + 1),
        EditError::NoLeg => text!("draft-no-leg"),
        EditError::UnknownHeight => text!("draft-unknown-height"),
    };
    Refusal::new(EditPart::Items, reason)
}

pub(super) fn known(list: &[Item], items: Items) -> Result<Range<usize>, Refusal> {
    let range = items.range();
    if range.start < range.end && range.end <= list.len() {
        Ok(range)
    } else {
        Err(refused(EditError::NoItem(list.len())))
    }
}

/// The place that an edit names; the cursor and home come from its surroundings.
pub(super) fn found(
    spot: Spot,
    document: &Document,
    around: &Surroundings,
) -> Result<LatLon, Refusal> {
    let missing = |reason| Refusal::new(EditPart::Place, reason);
    match spot {
        Spot::At(place) => Ok(place),
        Spot::Cursor => around
            .cursor
            .ok_or_else(|| missing(text!("draft-no-cursor"))),
        Spot::FromHome { north_m, east_m } => {
            let home = document
                .home
                .ok_or_else(|| missing(text!("draft-no-home")))?;
            Ok(LatLon::from_e7(home.x, home.y).moved(north_m, east_m))
        }
    }
}
