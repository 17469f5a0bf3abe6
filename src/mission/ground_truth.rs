//! What the world of a mission is made of, whatever hazard brings it: quantities that sensors measure, objects that they
//! find, loads and what they do, and what a debrief reveals.

use std::time::Duration;

use super::Point;
use crate::commands::FindKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// What a field can be measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Solvent vapour or gas, in ug/m3.
    Vapour,
    /// Carbon monoxide, in ug/m3.
    Monoxide,
    /// Methane in the air, in ug/m3.
    Methane,
    /// Fine particles and smoke, in ug/m3.
    Particles,
    /// Dose rate of gamma radiation, in uSv/h.
    DoseRate,
}

/// Something that detectors can find.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Object {
    pub class: ObjectClass,
    pub at: Point,
    /// Above the origin (a defect on a line hangs high).
    pub height_m: f64,
    /// Whether it is still there: a fire may be out, a person rescued.
    pub present: bool,
    /// How much of it is hidden from above, 0 to 1 (canopy, rubble).
    pub cover: f64,
    /// The direction of the line that it hangs on, for what has to be looked at from the side.
    pub axis_deg: Option<f64>,
}

impl Object {
    /// One that lies open on the ground.
    pub fn new(class: ObjectClass, at: Point) -> Self {
        Self {
            class,
            at,
            height_m: 0.0,
            present: true,
            cover: 0.0,
            axis_deg: None,
        }
    }
}

/// What an object is. The word after `mark .. as` is [`ObjectClass::kind`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ObjectClass {
    /// A mine with much metal in it.
    MetalMine,
    /// A mine with hardly any metal in it.
    MinimumMetalMine,
    /// A mine or a shell that lies open.
    SurfaceMine,
    /// Scrap: what detectors take for a mine.
    Clutter,
    /// A person who needs help.
    Person,
    /// What a thermal camera takes for a person.
    Animal,
    Fire,
    /// A fault of a line or a structure.
    Defect,
    /// Where gas comes out.
    Leak,
    /// Where radiation comes from.
    Source,
}

impl ObjectClass {
    /// What it is reported as; `None` for what should not be reported at all.
    pub fn kind(self) -> Option<FindKind> {
        Some(match self {
            Self::MetalMine | Self::MinimumMetalMine | Self::SurfaceMine => FindKind::Mine,
            Self::Person => FindKind::Person,
            Self::Fire => FindKind::Fire,
            Self::Defect => FindKind::Defect,
            Self::Leak => FindKind::Leak,
            Self::Source => FindKind::Source,
            Self::Clutter | Self::Animal => return None,
        })
    }
}

/// What vehicles let go of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Load {
    Ball,
    /// A second of the sprayer.
    Spray,
    /// A kit: medicine, a life vest.
    Kit,
    Node,
}

impl Load {
    pub const ALL: [Self; 4] = [Self::Ball, Self::Spray, Self::Kit, Self::Node];

    /// What mission files call it.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Spray => "spray",
            Self::Kit => "kit",
            Self::Node => "node",
        }
    }

    /// The part of the workshop's catalogue that it is, or is sprayed by.
    pub fn part(self) -> &'static str {
        match self {
            Self::Ball => "s_ball",
            Self::Spray => "s_spray",
            Self::Kit => "s_med",
            Self::Node => "s_node",
        }
    }

    /// What it is called, for people.
    pub fn name(self) -> Text {
        match self {
            Self::Ball => text!("load-ball"),
            Self::Spray => text!("load-spray"),
            Self::Kit => text!("load-kit"),
            Self::Node => text!("load-node"),
        }
    }
}

/// What a load has done.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LoadEffect {
    /// Whether it did any good.
    pub good: bool,
    /// The object that it reached, by its place among the hazard's.
    pub object: Option<usize>,
    pub text: Text,
}

/// Something let go of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Release {
    pub load: Load,
    pub at: Point,
    pub by: VehicleId,
    /// Mission time at which it was let go of.
    pub when: Duration,
    /// Whether it did any good.
    pub good: bool,
}

/// A piece of the truth, for the map of the debrief.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TruthPiece {
    pub at: Point,
    pub shape: TruthShape,
}

/// What a piece of the truth is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TruthShape {
    /// An object, and whether it was there at the end.
    Object(ObjectClass, bool),
    /// A square of this side, and how strong the hazard was there, 0 to 1.
    Square(f64, f64),
}
