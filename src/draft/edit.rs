//! The changes of a document.

use std::ops::Range;

use strum::{EnumString, VariantNames};

use super::fence;
use crate::geo::LatLon;
use crate::plan::edit::{self, EditError, FrameChange, HeightChange};
use crate::plan::{Document, HeightFrame, Home, Item, ListKind, board, command, field};
use crate::text;
use crate::text::Text;

/// The height of a first item that names none, in metres above home.
const USUAL_HEIGHT_M: f32 = 30.0;
/// The smallest radius that a change of a circle leaves, in metres.
const LEAST_RADIUS_M: f32 = 1.0;

/// Items of a list by their numbers, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Items {
    pub first: usize,
    pub last: usize,
}

impl Items {
    pub const fn one(number: usize) -> Self {
        Self {
            first: number,
            last: number,
        }
    }

    /// Their places in the list, from 0.
    fn range(self) -> Range<usize> {
        self.first.saturating_sub(1)..self.last
    }
}

/// A place in a plan, as it is named.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// The cursor of the map.
    Cursor,
    At(LatLon),
    /// Metres from home.
    FromHome {
        north_m: f64,
        east_m: f64,
    },
}

/// What heights are measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum PlanFrame {
    Home,
    Terrain,
    Sea,
}

impl PlanFrame {
    /// The number of its `MAV_FRAME`.
    pub const fn number(self) -> u8 {
        match self {
            Self::Sea => 0,
            Self::Home => 3,
            Self::Terrain => 10,
        }
    }

    /// The frame of an item, if it is one of these.
    pub const fn of(item: &Item) -> Option<Self> {
        match item.height_frame() {
            HeightFrame::SeaLevel => Some(Self::Sea),
            HeightFrame::Home => Some(Self::Home),
            HeightFrame::Terrain => Some(Self::Terrain),
            HeightFrame::Other => None,
        }
    }

    #[must_use]
    pub const fn next(self) -> Self {
        match self {
            Self::Home => Self::Terrain,
            Self::Terrain => Self::Sea,
            Self::Sea => Self::Home,
        }
    }
}

/// An item to add to the plan; what it does not name follows from the items before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewItem {
    pub command: u16,
    /// `None`: the cursor if the command needs a place, otherwise where the vehicle is.
    pub spot: Option<Spot>,
    pub height_m: Option<f32>,
    pub frame: Option<PlanFrame>,
    pub params: [f32; 4],
}

impl NewItem {
    pub const fn new(command: u16) -> Self {
        Self {
            command,
            spot: None,
            height_m: None,
            frame: None,
            params: [0.0; 4],
        }
    }
}

/// Where a new item goes; numbers count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Insertion {
    Last,
    Before(usize),
    After(usize),
}

/// A change of a document.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    Add {
        item: NewItem,
        at: Insertion,
    },
    Delete {
        list: ListKind,
        items: Items,
    },
    /// Moves places by a distance.
    Shift {
        list: ListKind,
        items: Items,
        north_m: f64,
        east_m: f64,
    },
    /// Moves the first of the items to a place; the others keep their distance from it.
    Place {
        list: ListKind,
        items: Items,
        spot: Spot,
    },
    /// Gives items other numbers; the first of them gets the number `to`.
    Reorder {
        items: Items,
        to: usize,
    },
    /// Puts a waypoint into the middle of the leg to this item.
    Split(usize),
    /// Changes heights; of circles of a fence, the radius.
    Height {
        list: ListKind,
        items: Items,
        change: HeightChange,
    },
    Frame {
        items: Items,
        frame: PlanFrame,
    },
    Command {
        item: usize,
        command: u16,
    },
    /// Gives a parameter a value, by its name.
    Set {
        list: ListKind,
        items: Items,
        field: String,
        value: f32,
    },
    Home(Spot),
    /// Adds a corner to a polygon of the fence, behind this item.
    Corner {
        spot: Spot,
        after: Option<usize>,
    },
    /// Begins a polygon of the fence.
    Polygon {
        keeps_in: bool,
        corners: Vec<Spot>,
    },
    Circle {
        keeps_in: bool,
        spot: Spot,
        radius_m: f32,
    },
    /// Turns the area of this item from one to stay in into one to stay out of, or back.
    Flip(usize),
    Rally {
        spot: Spot,
        height_m: Option<f32>,
    },
}

/// What lies around a draft.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// The cursor of the map.
    pub cursor: Option<LatLon>,
    /// The home of the vehicle, for a document without one.
    pub home: Option<Home>,
}

/// A changed document.
#[derive(Debug, Clone, PartialEq)]
pub struct Edited {
    pub document: Document,
    /// The item that the change is about, counted from 0.
    pub item: Option<usize>,
}

/// Why the library refused, in words.
fn refused(error: EditError) -> Text {
    match error {
        EditError::NoItem(count) => text!("draft-no-item", count = count),
        EditError::JumpTarget(jump) => text!("draft-jump-target", item = jump + 1),
        EditError::NoLeg => text!("draft-no-leg"),
        EditError::UnknownHeight => text!("draft-unknown-height"),
    }
}

fn known(list: &[Item], items: Items) -> Result<Range<usize>, Text> {
    let range = items.range();
    if range.start < range.end && range.end <= list.len() {
        Ok(range)
    } else {
        Err(text!("draft-no-item", count = list.len()))
    }
}

/// A place named relative to what is around.
fn found(spot: Spot, document: &Document, around: &Surroundings) -> Result<LatLon, Text> {
    match spot {
        Spot::At(place) => Ok(place),
        Spot::Cursor => around.cursor.ok_or_else(|| text!("draft-no-cursor")),
        Spot::FromHome { north_m, east_m } => {
            let home = document.home.ok_or_else(|| text!("draft-no-home"))?;
            Ok(LatLon::from_e7(home.x, home.y).moved(north_m, east_m))
        }
    }
}

impl Edit {
    /// The list that it changes.
    pub fn list(&self) -> ListKind {
        match self {
            Self::Delete { list, .. }
            | Self::Shift { list, .. }
            | Self::Place { list, .. }
            | Self::Height { list, .. }
            | Self::Set { list, .. } => *list,
            Self::Add { .. }
            | Self::Reorder { .. }
            | Self::Split(_)
            | Self::Frame { .. }
            | Self::Command { .. }
            | Self::Home(_) => ListKind::Plan,
            Self::Corner { .. } | Self::Polygon { .. } | Self::Circle { .. } | Self::Flip(_) => {
                ListKind::Fence
            }
            Self::Rally { .. } => ListKind::Rally,
        }
    }

    /// The document with this change.
    ///
    /// # Errors
    /// The reason why it is not possible.
    pub fn apply(&self, document: &Document, around: &Surroundings) -> Result<Edited, Text> {
        let mut document = document.clone();
        document.home = document.home.or(around.home);
        let item = match self {
            Self::Add { item, at } => Some(add(&mut document, item, *at, around)?),
            Self::Delete { list, items } => delete(&mut document, *list, *items)?,
            Self::Shift {
                list,
                items,
                north_m,
                east_m,
            } => {
                let range = known(document.list(*list), *items)?;
                shift(document.list_mut(*list), &range, (*north_m, *east_m));
                Some(range.start)
            }
            Self::Place { list, items, spot } => {
                let place = found(*spot, &document, around)?;
                Some(put(&mut document, *list, *items, place)?)
            }
            Self::Reorder { items, to } => {
                let to = to.saturating_sub(1);
                document.plan =
                    edit::relocate(&document.plan, items.range(), to).map_err(refused)?;
                Some(to)
            }
            Self::Split(item) => {
                let at = item.saturating_sub(1);
                document.plan = edit::split(&document.plan, at).map_err(refused)?;
                Some(at)
            }
            Self::Height {
                list,
                items,
                change,
            } => {
                change_height(&mut document, *list, *items, *change)?;
                None
            }
            Self::Frame { items, frame } => {
                change_frame(&mut document, *items, *frame)?;
                None
            }
            Self::Command { item, command } => {
                Some(change_command(&mut document, *item, *command, around)?)
            }
            Self::Set {
                list,
                items,
                field,
                value,
            } => {
                set(document.list_mut(*list), *items, field, *value)?;
                None
            }
            Self::Home(spot) => {
                move_home(&mut document, *spot, around)?;
                None
            }
            Self::Corner { .. } | Self::Polygon { .. } | Self::Circle { .. } | Self::Flip(_) => {
                Some(self.change_fence(&mut document, around)?)
            }
            Self::Rally { spot, height_m } => {
                let place = found(*spot, &document, around)?;
                Some(add_rally(&mut document, place, *height_m))
            }
        };
        Ok(Edited { document, item })
    }

    /// Changes the areas of the fence.
    fn change_fence(&self, document: &mut Document, around: &Surroundings) -> Result<usize, Text> {
        match self {
            Self::Corner { spot, after } => {
                let place = found(*spot, document, around)?;
                let after = after.map(|number| number.saturating_sub(1));
                Ok(fence::add_corner(&mut document.fence, after, place))
            }
            Self::Polygon { keeps_in, corners } => {
                let corners = corners.iter().map(|spot| found(*spot, document, around));
                let corners = corners.collect::<Result<Vec<LatLon>, Text>>()?;
                Ok(fence::add_polygon(&mut document.fence, *keeps_in, &corners))
            }
            Self::Circle {
                keeps_in,
                spot,
                radius_m,
            } => {
                let centre = found(*spot, document, around)?;
                let items = &mut document.fence;
                Ok(fence::add_circle(items, *keeps_in, centre, *radius_m))
            }
            Self::Flip(item) => {
                let range = known(&document.fence, Items::one(*item))?;
                fence::flip(&mut document.fence, range.start);
                Ok(range.start)
            }
            Self::Add { .. }
            | Self::Delete { .. }
            | Self::Shift { .. }
            | Self::Place { .. }
            | Self::Reorder { .. }
            | Self::Split(_)
            | Self::Height { .. }
            | Self::Frame { .. }
            | Self::Command { .. }
            | Self::Set { .. }
            | Self::Home(_)
            | Self::Rally { .. } => Ok(0),
        }
    }
}

fn add(
    document: &mut Document,
    new: &NewItem,
    at: Insertion,
    around: &Surroundings,
) -> Result<usize, Text> {
    let at = match at {
        Insertion::Last => document.plan.len(),
        Insertion::Before(number) => number.saturating_sub(1),
        Insertion::After(number) => number,
    };
    let item = built(document, new, at, around)?;
    document.plan = edit::insert(&document.plan, at, &[item]).map_err(refused)?;
    Ok(at)
}

/// Whether a command that names no place is carried out where the vehicle is.
fn stays_in_place(command: u16) -> bool {
    command::is_takeoff(command) || matches!(command, command::LAND | command::VTOL_LAND)
}

fn built(
    document: &Document,
    new: &NewItem,
    at: usize,
    around: &Surroundings,
) -> Result<Item, Text> {
    let has_place = command::has_place(new.command);
    let spot = match new.spot {
        None if has_place && !stays_in_place(new.command) => Some(Spot::Cursor),
        other => other,
    };
    let place = spot.map(|spot| found(spot, document, around)).transpose()?;
    let (x, y) = place.map_or((0, 0), LatLon::to_e7);
    let before = document.plan.get(..at).unwrap_or(&document.plan);
    let flown = before
        .iter()
        .rev()
        .find(|item| command::is_flown_to(item.command) && item.command != command::LAND);
    let frame = new.frame.or_else(|| flown.and_then(PlanFrame::of));
    let usual_m = match new.command {
        command::LAND | command::VTOL_LAND => 0.0,
        _ => flown.map_or(USUAL_HEIGHT_M, |item| item.z),
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

/// Deletes items; the one behind them, or the last, is then the one to look at.
fn delete(document: &mut Document, list: ListKind, items: Items) -> Result<Option<usize>, Text> {
    let range = known(document.list(list), items)?;
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

fn is_placed(item: &Item) -> bool {
    command::has_place(item.command) && (item.x, item.y) != (0, 0)
}

fn shift(items: &mut [Item], range: &Range<usize>, (north_m, east_m): (f64, f64)) {
    for item in items[range.clone()]
        .iter_mut()
        .filter(|item| is_placed(item))
    {
        (item.x, item.y) = item.point().moved(north_m, east_m).to_e7();
    }
}

fn put(
    document: &mut Document,
    list: ListKind,
    items: Items,
    place: LatLon,
) -> Result<usize, Text> {
    let range = known(document.list(list), items)?;
    let items = document.list_mut(list);
    let has_place = |item: &&Item| command::has_place(item.command);
    let first = items[range.clone()].iter().find(has_place);
    let first = *first.ok_or_else(|| text!("draft-no-place"))?;
    if is_placed(&first) {
        shift(items, &range, first.point().offset_to(place));
    } else if let Some(item) = items.get_mut(range.start) {
        (item.x, item.y) = place.to_e7();
    }
    Ok(range.start)
}

fn change_height(
    document: &mut Document,
    list: ListKind,
    items: Items,
    change: HeightChange,
) -> Result<(), Text> {
    let range = known(document.list(list), items)?;
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
                return Err(text!("draft-no-radius"));
            }
            for item in circles {
                item.params[0] = changed(item.params[0]).max(LEAST_RADIUS_M);
            }
        }
    }
    Ok(())
}

/// Changes the frame of items. Numbers stay between home and terrain, where the ground counts as level; to or from sea
/// level, the flight stays at its height.
fn change_frame(document: &mut Document, items: Items, frame: PlanFrame) -> Result<(), Text> {
    let home = document.home;
    for at in known(&document.plan, items)? {
        let before = PlanFrame::of(&document.plan[at]);
        let keep = FrameChange::KeepHeights {
            home,
            ground_amsl_m: &|_| None,
        };
        let change = match (before, frame) {
            (Some(PlanFrame::Sea), _) | (_, PlanFrame::Sea) => keep,
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
) -> Result<usize, Text> {
    let at = known(&document.plan, Items::one(number))?.start;
    let old = document.plan[at];
    let is_placed = is_placed(&old);
    let new = NewItem {
        spot: is_placed.then(|| Spot::At(old.point())),
        height_m: is_placed.then_some(old.z),
        frame: is_placed.then(|| PlanFrame::of(&old)).flatten(),
        ..NewItem::new(command)
    };
    document.plan[at] = built(document, &new, at, around)?;
    Ok(at)
}

fn set(list: &mut [Item], items: Items, name: &str, value: f32) -> Result<(), Text> {
    let range = known(list, items)?;
    let mut is_any = false;
    for item in &mut list[range.clone()] {
        if let Some(field) = field::field_named(item.command, name) {
            field.set(item, value);
            is_any = true;
        }
    }
    if is_any {
        return Ok(());
    }
    let command = list[range.start].command;
    let names: Vec<&str> = field::fields(command).iter().map(|it| it.name).collect();
    let word = field::word(command).or_else(|| board::name(command));
    let word = word.unwrap_or_default();
    Err(if names.is_empty() {
        text!("draft-no-fields", command = word)
    } else {
        text!(
            "draft-no-field",
            command = word,
            name = name,
            names = names.join(", ")
        )
    })
}

fn move_home(document: &mut Document, spot: Spot, around: &Surroundings) -> Result<(), Text> {
    let (x, y) = found(spot, document, around)?.to_e7();
    let z = document.home.or(around.home).map_or(0.0, |home| home.z);
    document.home = Some(Home { x, y, z });
    Ok(())
}

fn add_rally(document: &mut Document, place: LatLon, height_m: Option<f32>) -> usize {
    let (x, y) = place.to_e7();
    let usual_m = document.rally.last().map_or(USUAL_HEIGHT_M, |item| item.z);
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
