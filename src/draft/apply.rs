//! Applies a change to a document.

use std::ops::Range;

use super::edit::{
    Edit, EditPart, Edited, Items, ItemsChange, PlanFrame, Refusal, Spot, Surroundings,
};
use super::place::{found, known, place, refused};
use super::{fence, plan};
use crate::geo::LatLon;
use crate::plan::edit::{self, HeightChange};
use crate::plan::generate::USUAL_HEIGHT_M;
use crate::plan::{Document, Home, Item, ListKind, command, field};
use crate::text;

/// The smallest radius that a change to a circle leaves, in metres.
const LEAST_RADIUS_M: f32 = 1.0;

impl Edit {
    /// The document with this change. A document without a home gets that of its surroundings.
    ///
    /// # Errors
    /// The reason why the change is not possible.
    pub fn apply(&self, document: &Document, around: &Surroundings) -> Result<Edited, Refusal> {
        let mut document = document.clone();
        document.home = document.home.or(around.home);
        let item = match self {
            Self::Plan(edit) => plan::change(&mut document, edit, around)?,
            Self::Fence(edit) => Some(fence::change(&mut document, edit, around)?),
            Self::Items {
                list,
                items,
                change,
            } => change.apply(&mut document, *list, *items, around)?,
            Self::Rally { spot, height_m } => {
                let place = found(*spot, &document, around)?;
                Some(add_rally(&mut document, place, *height_m))
            }
            Self::Home(spot) => {
                move_home(&mut document, *spot, around)?;
                None
            }
        };
        Ok(Edited { document, item })
    }
}

impl ItemsChange {
    fn apply(
        &self,
        document: &mut Document,
        list: ListKind,
        items: Items,
        around: &Surroundings,
    ) -> Result<Option<usize>, Refusal> {
        let range = known(document.list(list), items)?;
        match self {
            Self::Delete => return delete(document, list, range),
            Self::Shift { north_m, east_m } => {
                shift(document.list_mut(list), &range, *north_m, *east_m);
            }
            Self::Place(spot) => {
                let to = found(*spot, document, around)?;
                put(document.list_mut(list), &range, to)?;
            }
            Self::Height(change) => {
                change_height(document, list, range, *change)?;
                return Ok(None);
            }
            Self::Set { field, value } => {
                set(&mut document.list_mut(list)[range], field, *value)?;
                return Ok(None);
            }
        }
        Ok(Some(range.start))
    }
}

/// Deletes items, and returns the index of the item to select next: the one after them, or the
/// last.
fn delete(
    document: &mut Document,
    list: ListKind,
    range: Range<usize>,
) -> Result<Option<usize>, Refusal> {
    let at = range.start;
    match list {
        ListKind::Plan => {
            document.plan = edit::delete(&document.plan, range).map_err(refused)?;
        }
        ListKind::Fence => fence::delete(&mut document.fence, &range),
        ListKind::Rally => {
            document.rally.drain(range);
        }
    }
    Ok(document
        .list(list)
        .len()
        .checked_sub(1)
        .map(|last| at.min(last)))
}

fn shift(items: &mut [Item], range: &Range<usize>, north_m: f64, east_m: f64) {
    for item in &mut items[range.clone()] {
        if let Some(here) = place(item) {
            (item.x, item.y) = here.moved(north_m, east_m).to_e7();
        }
    }
}

/// Moves items so that the first one with a place is at `to`.
fn put(items: &mut [Item], range: &Range<usize>, to: LatLon) -> Result<(), Refusal> {
    if let Some(first) = items[range.clone()].iter().find_map(place) {
        let (north_m, east_m) = first.offset_to(to);
        shift(items, range, north_m, east_m);
        return Ok(());
    }
    let mut placeable = items[range.clone()]
        .iter_mut()
        .filter(|item| command::has_place(item.command));
    let item = placeable
        .next()
        .ok_or_else(|| Refusal::new(EditPart::Items, text!("draft-no-place")))?;
    (item.x, item.y) = to.to_e7();
    Ok(())
}

fn change_height(
    document: &mut Document,
    list: ListKind,
    range: Range<usize>,
    change: HeightChange,
) -> Result<(), Refusal> {
    let changed = |now: f32| match change {
        HeightChange::To(metres) => metres,
        HeightChange::By(metres) => now + metres,
    };
    match list {
        ListKind::Plan => {
            document.plan = edit::change_height(&document.plan, range, change).map_err(refused)?;
        }
        ListKind::Rally => {
            for item in &mut document.rally[range] {
                item.z = changed(item.z);
            }
        }
        ListKind::Fence => {
            let in_range = document.fence[range].iter_mut();
            let mut circles = in_range
                .filter(|it| command::is_circle(it.command))
                .peekable();
            if circles.peek().is_none() {
                return Err(Refusal::new(EditPart::Items, text!("draft-no-radius")));
            }
            for item in circles {
                item.params[0] = changed(item.params[0]).max(LEAST_RADIUS_M);
            }
        }
    }
    Ok(())
}

/// Sets a parameter of the items that have it.
fn set(items: &mut [Item], name: &str, value: f32) -> Result<(), Refusal> {
    let mut is_any = false;
    for item in items.iter_mut() {
        if let Some(field) = field::field_named(item.command, name) {
            field.set(item, value);
            is_any = true;
        }
    }
    let Some(first) = items.first().filter(|_| !is_any) else {
        return Ok(());
    };
    let command = first.command;
    let names: Vec<&str> = field::fields(command).iter().map(|it| it.name).collect();
    let word = field::word(command).unwrap_or_default();
    let reason = if names.is_empty() {
        text!("draft-no-fields", command = word)
    } else {
        text!(
            "draft-no-field",
            command = word,
            name = name,
            names = names.join(", ")
        )
    };
    Err(Refusal::new(EditPart::Field, reason))
}

fn move_home(document: &mut Document, spot: Spot, around: &Surroundings) -> Result<(), Refusal> {
    let (x, y) = found(spot, document, around)?.to_e7();
    let z = document.home.or(around.home).map_or(0.0, |home| home.z);
    document.home = Some(Home { x, y, z });
    Ok(())
}

fn add_rally(document: &mut Document, place: LatLon, height_m: Option<f32>) -> usize {
    let (x, y) = place.to_e7();
    let usual_m = document
        .rally
        .last()
        .map_or(USUAL_HEIGHT_M as f32, |item| item.z);
    document.rally.push(Item {
        command: command::RALLY_POINT,
        frame: PlanFrame::Home.number(),
        auto_continue: true,
        params: [0.0; 4],
        x,
        y,
        z: height_m.unwrap_or(usual_m),
    });
    document.rally.len() - 1
}
