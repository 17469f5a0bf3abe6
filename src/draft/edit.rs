//! Changes to a document, as given by keys and typed lines.

use std::ops::Range;

use mavlink::dialects::ardupilotmega::MavCmd;
use strum::{EnumString, VariantNames};

use crate::geo::{LatLon, Terrain};
use crate::plan::edit::HeightChange;
use crate::plan::{Document, HeightFrame, Home, Item, ListKind, command};
use crate::text::Text;

const SET_SERVO: u16 = MavCmd::MAV_CMD_DO_SET_SERVO as u16;

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

    /// The indices of the items in the list, from 0.
    pub(super) fn range(self) -> Range<usize> {
        self.first.saturating_sub(1)..self.last
    }
}

/// A place in a plan, as given by a key or a typed line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// The cursor of the map.
    Cursor,
    At(LatLon),
    /// North and east of home, in metres.
    FromHome {
        north_m: f64,
        east_m: f64,
    },
}

/// The reference of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum PlanFrame {
    Home,
    Terrain,
    Sea,
}

impl PlanFrame {
    /// The number of the frame's `MAV_FRAME`.
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

/// An item to add to the plan; missing values follow from the items before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewItem {
    pub command: u16,
    /// The place of the item; `None` means the cursor if the command needs a place, otherwise the
    /// place of the vehicle.
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
            params: usual_params(command),
        }
    }
}

/// The default parameters of a new item, where 0 would make the command do nothing.
const fn usual_params(command: u16) -> [f32; 4] {
    match command {
        command::LOITER_TURNS => [1.0, 0.0, 0.0, 0.0],
        command::LOITER_TIME | command::DELAY | command::CONDITION_DELAY => [10.0, 0.0, 0.0, 0.0],
        command::DO_CHANGE_SPEED => [0.0, 5.0, 0.0, 0.0],
        // The first output that drives no motor, at its middle position.
        SET_SERVO => [9.0, 1500.0, 0.0, 0.0],
        _ => [0.0; 4],
    }
}

/// Where a new item goes; numbers count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Insertion {
    Last,
    Before(usize),
    After(usize),
}

/// A change to a document.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    Plan(PlanEdit),
    Fence(FenceEdit),
    /// Changes items of any list.
    Items {
        list: ListKind,
        items: Items,
        change: ItemsChange,
    },
    /// Adds a rally point.
    Rally {
        spot: Spot,
        height_m: Option<f32>,
    },
    /// Moves the home of the draft.
    Home(Spot),
}

/// A change to the plan.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanEdit {
    Add {
        item: NewItem,
        at: Insertion,
    },
    /// Moves items within the list; the first of them gets the number `to`.
    Reorder {
        items: Items,
        to: usize,
    },
    /// Puts a waypoint in the middle of the leg to this item.
    Split(usize),
    Frame {
        items: Items,
        frame: PlanFrame,
    },
    Command {
        item: usize,
        command: u16,
    },
}

/// A change to the fence.
#[derive(Debug, Clone, PartialEq)]
pub enum FenceEdit {
    /// Adds a corner to a polygon, after this item.
    Corner { spot: Spot, after: Option<usize> },
    /// Adds a fence polygon with these corners: an inclusion if `keeps_in`, otherwise an exclusion.
    Polygon { keeps_in: bool, corners: Vec<Spot> },
    Circle {
        keeps_in: bool,
        spot: Spot,
        radius_m: f32,
    },
    /// Turns the area of this item from an inclusion into an exclusion, or back.
    Flip(usize),
}

/// A change to existing items.
#[derive(Debug, Clone, PartialEq)]
pub enum ItemsChange {
    Delete,
    /// Moves places by a distance.
    Shift {
        north_m: f64,
        east_m: f64,
    },
    /// Moves the first of the items to a place; the others keep their distance from it.
    Place(Spot),
    /// Changes heights or, for circles of a fence, the radius.
    Height(HeightChange),
    /// Sets a parameter, given by its name.
    Set {
        field: String,
        value: f32,
    },
}

impl Edit {
    /// The list that the edit changes.
    pub fn list(&self) -> ListKind {
        match self {
            Self::Items { list, .. } => *list,
            Self::Plan(_) | Self::Home(_) => ListKind::Plan,
            Self::Fence(_) => ListKind::Fence,
            Self::Rally { .. } => ListKind::Rally,
        }
    }
}

/// The surroundings of a draft: the map's cursor and the vehicle's home.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surroundings {
    /// The cursor of the map.
    pub cursor: Option<LatLon>,
    /// The home of the vehicle, for a document without one.
    pub home: Option<Home>,
    /// The ground, as far as it is known.
    pub ground: Terrain,
}

/// The document after an edit.
#[derive(Debug, Clone, PartialEq)]
pub struct Edited {
    pub document: Document,
    /// The index of the item that the change affects.
    pub item: Option<usize>,
}

/// The part of a change at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EditPart {
    /// The change as a whole.
    Whole,
    /// The items that the change affects.
    Items,
    /// The new number of the items, or the item that a jump leads to.
    Target,
    /// A place: an offset, coordinates, or a name.
    Place,
    /// The name of a parameter.
    Field,
    /// The vehicles that a line names.
    Vehicles,
}

/// Why a change is not possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    pub part: EditPart,
    pub reason: Text,
}

impl Refusal {
    pub fn new(part: EditPart, reason: Text) -> Self {
        Self { part, reason }
    }
}

impl From<Text> for Refusal {
    fn from(reason: Text) -> Self {
        Self::new(EditPart::Whole, reason)
    }
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.reason.fmt(formatter)
    }
}
