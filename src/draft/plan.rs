//! Changes to the plan.

use super::edit::{
    EditPart, Insertion, Items, NewItem, PlanEdit, PlanFrame, Refusal, Spot, Surroundings,
};
use super::place::{found, known, place, refused};
use crate::geo::{LatLon, Terrain};
use crate::plan::edit::{self, FrameChange};
use crate::plan::generate::USUAL_HEIGHT_M;
use crate::plan::{Document, Item, command};

/// Changes the plan, and returns the index of the item that the change affects.
///
/// # Errors
/// The reason why it is not possible.
pub(super) fn change(
    document: &mut Document,
    edit: &PlanEdit,
    around: &Surroundings,
) -> Result<Option<usize>, Refusal> {
    let at = match edit {
        PlanEdit::Add { item, at } => add(document, item, *at, around)?,
        PlanEdit::Reorder { items, to } => {
            let range = known(&document.plan, *items)?;
            let to = to.saturating_sub(1);
            let at_target = |error| Refusal {
                part: EditPart::Target,
                ..refused(error)
            };
            document.plan = edit::relocate(&document.plan, range, to).map_err(at_target)?;
            to
        }
        PlanEdit::Split(item) => {
            let at = item.saturating_sub(1);
            document.plan = edit::split(&document.plan, at).map_err(refused)?;
            at
        }
        PlanEdit::Frame { items, frame } => {
            change_frame(document, *items, *frame, &around.ground)?;
            return Ok(None);
        }
        PlanEdit::Command { item, command } => change_command(document, *item, *command, around)?,
    };
    Ok(Some(at))
}

fn add(
    document: &mut Document,
    new: &NewItem,
    at: Insertion,
    around: &Surroundings,
) -> Result<usize, Refusal> {
    let at = match at {
        Insertion::Last => document.plan.len(),
        Insertion::Before(number) => number.saturating_sub(1),
        Insertion::After(number) => number,
    };
    let item = built(document, new, at, around)?;
    document.plan = edit::insert(&document.plan, at, &[item]).map_err(refused)?;
    Ok(at)
}

/// Whether a command without a place is carried out at the vehicle's position.
fn stays_in_place(command: u16) -> bool {
    command::is_takeoff(command) || matches!(command, command::LAND | command::VTOL_LAND)
}

fn built(
    document: &Document,
    new: &NewItem,
    at: usize,
    around: &Surroundings,
) -> Result<Item, Refusal> {
    let has_place = command::has_place(new.command);
    let spot = match new.spot {
        None if has_place && !stays_in_place(new.command) => Some(Spot::Cursor),
        other => other,
    };
    let point = spot.map(|spot| found(spot, document, around)).transpose()?;
    let (x, y) = point.map_or((0, 0), LatLon::to_e7);
    let before = document.plan.get(..at).unwrap_or(&document.plan);
    let flown = before
        .iter()
        .rev()
        .find(|item| command::is_flown_to(item.command) && item.command != command::LAND);
    let frame = new.frame.or_else(|| flown.and_then(PlanFrame::of));
    let usual_m = match new.command {
        command::LAND | command::VTOL_LAND => 0.0,
        _ => flown.map_or(USUAL_HEIGHT_M as f32, |item| item.z),
    };
    let height_m = new.height_m.unwrap_or(usual_m);
    Ok(Item {
        command: new.command,
        frame: frame.unwrap_or(PlanFrame::Home).number(),
        auto_continue: true,
        params: new.params,
        x: if has_place { x } else { 0 },
        y: if has_place { y } else { 0 },
        z: if has_place { height_m } else { 0.0 },
    })
}

/// Whether a change of frame converts a height to or from the terrain frame at a place whose ground
/// is unknown and therefore counts as level with home. Items without a place are carried out
/// elsewhere and do not count.
pub fn needs_ground(document: &Document, items: Items, frame: PlanFrame, ground: &Terrain) -> bool {
    let converted = document.plan.get(items.range()).unwrap_or_default();
    converted.iter().any(|item| {
        let frames = [PlanFrame::of(item), Some(frame)];
        let is_over_terrain = frames[0] != frames[1] && frames.contains(&Some(PlanFrame::Terrain));
        is_over_terrain && place(item).is_some_and(|at| ground.height_m(at).is_none())
    })
}

/// Changes the frame of items. Their true height stays the same; where the ground is not known, it
/// counts as level with home. A change between home and terrain keeps the value if home is not
/// known either.
fn change_frame(
    document: &mut Document,
    items: Items,
    frame: PlanFrame,
    ground: &Terrain,
) -> Result<(), Refusal> {
    let home = document.home;
    for at in known(&document.plan, items)? {
        let before = PlanFrame::of(&document.plan[at]);
        let keep = FrameChange::KeepHeights {
            home,
            ground_amsl_m: &|item| {
                let metres = place(item).and_then(|at| ground.height_m(at));
                let level = home.map(|home| home.z);
                metres.map(|metres| metres as f32).or(level)
            },
        };
        let is_known = place(&document.plan[at]).is_some_and(|at| ground.height_m(at).is_some());
        let change = match (before, frame) {
            (Some(PlanFrame::Sea), _) | (_, PlanFrame::Sea) => keep,
            _ if is_known && home.is_some() => keep,
            _ => FrameChange::KeepNumbers,
        };
        document.plan = edit::change_frame(&document.plan, at..at + 1, frame.number(), &change)
            .map_err(refused)?;
    }
    Ok(())
}

/// Gives an item another command; its place and height stay, its parameters do not.
fn change_command(
    document: &mut Document,
    number: usize,
    command: u16,
    around: &Surroundings,
) -> Result<usize, Refusal> {
    let at = known(&document.plan, Items::one(number))?.start;
    let old = document.plan[at];
    let here = place(&old);
    let new = NewItem {
        spot: here.map(Spot::At),
        height_m: here.map(|_| old.z),
        frame: here.and_then(|_| PlanFrame::of(&old)),
        ..NewItem::new(command)
    };
    document.plan[at] = built(document, &new, at, around)?;
    Ok(at)
}
