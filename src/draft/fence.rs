//! Changes to the fence. Every corner of a polygon stores the number of its corners.

use std::ops::Range;

use super::edit::{FenceEdit, Items, Refusal, Surroundings};
use super::place::{found, known};
use crate::geo::LatLon;
use crate::plan::{Document, Item, command};

/// Changes the fence, and returns the index of the item that the change affects.
///
/// # Errors
/// The reason why it is not possible.
pub(super) fn change(
    document: &mut Document,
    edit: &FenceEdit,
    around: &Surroundings,
) -> Result<usize, Refusal> {
    match edit {
        FenceEdit::Corner { spot, after } => {
            let place = found(*spot, document, around)?;
            let after = after.map(|number| number.saturating_sub(1));
            Ok(add_corner(&mut document.fence, after, place))
        }
        FenceEdit::Polygon { keeps_in, corners } => {
            let corners = corners.iter().map(|spot| found(*spot, document, around));
            let corners = corners.collect::<Result<Vec<LatLon>, Refusal>>()?;
            Ok(add_polygon(&mut document.fence, *keeps_in, &corners))
        }
        FenceEdit::Circle {
            keeps_in,
            spot,
            radius_m,
        } => {
            let centre = found(*spot, document, around)?;
            Ok(add_circle(
                &mut document.fence,
                *keeps_in,
                centre,
                *radius_m,
            ))
        }
        FenceEdit::Flip(item) => {
            let range = known(&document.fence, Items::one(*item))?;
            flip(&mut document.fence, range.start);
            Ok(range.start)
        }
    }
}

/// The items of each area, in order; a return point is an area of its own.
pub fn areas(items: &[Item]) -> Vec<Range<usize>> {
    let mut areas = Vec::new();
    let mut start = 0;
    while let Some(first) = items.get(start) {
        let wanted = if command::is_corner(first.command) {
            (first.params[0].max(1.0) as usize).min(items.len() - start)
        } else {
            1
        };
        let alike = items[start..start + wanted]
            .iter()
            .take_while(|item| item.command == first.command);
        let length = alike.count();
        areas.push(start..start + length);
        start += length;
    }
    areas
}

fn item(command: u16, place: LatLon, first: f32) -> Item {
    let (x, y) = place.to_e7();
    Item {
        command,
        frame: 0,
        auto_continue: true,
        params: [first, 0.0, 0.0, 0.0],
        x,
        y,
        z: 0.0,
    }
}

/// Adds a polygon of these corners; more corners may follow. Returns the index of its last item.
fn add_polygon(items: &mut Vec<Item>, keeps_in: bool, corners: &[LatLon]) -> usize {
    let command = if keeps_in {
        command::FENCE_POLYGON_INCLUSION
    } else {
        command::FENCE_POLYGON_EXCLUSION
    };
    let count = corners.len() as f32;
    items.extend(corners.iter().map(|corner| item(command, *corner, count)));
    items.len().saturating_sub(1)
}

/// Adds a circle; returns the index of its item.
fn add_circle(items: &mut Vec<Item>, keeps_in: bool, centre: LatLon, radius_m: f32) -> usize {
    let command = if keeps_in {
        command::FENCE_CIRCLE_INCLUSION
    } else {
        command::FENCE_CIRCLE_EXCLUSION
    };
    items.push(item(command, centre, radius_m));
    items.len() - 1
}

/// Adds a corner after an item of a polygon, or to the last polygon if the item belongs to none.
/// Without a polygon, it begins an inclusion polygon. Returns the index of the new item.
fn add_corner(items: &mut Vec<Item>, after: Option<usize>, place: LatLon) -> usize {
    let all = areas(items);
    let is_polygon = |area: &&Range<usize>| command::is_corner(items[area.start].command);
    let own = |area: &&Range<usize>| after.is_some_and(|after| area.contains(&after));
    let mut polygons = all.iter().filter(is_polygon);
    let chosen = polygons.clone().find(own).or(polygons.next_back()).cloned();
    let Some(area) = chosen else {
        return add_polygon(items, true, &[place]);
    };
    let at = match after {
        Some(after) if area.contains(&after) => after + 1,
        Some(_) | None => area.end,
    };
    let count = (area.len() + 1) as f32;
    let corner = item(items[area.start].command, place, count);
    items.insert(at, corner);
    for item in &mut items[area.start..=area.end] {
        item.params[0] = count;
    }
    at
}

/// Deletes items. A polygon that loses corners stores its new number of corners in those that
/// remain.
pub(super) fn delete(items: &mut Vec<Item>, range: &Range<usize>) {
    let mut rest = Vec::new();
    for area in areas(items) {
        let left: Vec<Item> = area
            .clone()
            .filter(|at| !range.contains(at))
            .map(|at| items[at])
            .collect();
        let count = left.len() as f32;
        rest.extend(left.into_iter().map(|mut item| {
            if command::is_corner(item.command) {
                item.params[0] = count;
            }
            item
        }));
    }
    *items = rest;
}

/// Turns the area of an item from an inclusion into an exclusion, or back.
fn flip(items: &mut [Item], at: usize) {
    let area = areas(items).into_iter().find(|area| area.contains(&at));
    for item in area
        .and_then(|area| items.get_mut(area))
        .into_iter()
        .flatten()
    {
        item.command = match item.command {
            command::FENCE_POLYGON_INCLUSION => command::FENCE_POLYGON_EXCLUSION,
            command::FENCE_POLYGON_EXCLUSION => command::FENCE_POLYGON_INCLUSION,
            command::FENCE_CIRCLE_INCLUSION => command::FENCE_CIRCLE_EXCLUSION,
            command::FENCE_CIRCLE_EXCLUSION => command::FENCE_CIRCLE_INCLUSION,
            other => other,
        };
    }
}
