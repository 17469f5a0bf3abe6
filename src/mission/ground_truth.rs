//! The elements of a mission's world, shared by all hazards: quantities that sensors measure, objects that they find,
//! loads and their effects, and the truth that a debrief reveals.

use std::time::Duration;

use super::Point;
use crate::commands::FindKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A quantity that sensors can measure.
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
    /// The height above the origin (a defect on a line is high up).
    pub height_m: f64,
    /// Whether it is still there: a fire may be out, or a person rescued.
    pub present: bool,
    /// The share of the object that is hidden from above (by canopy or rubble), 0 to 1.
    pub cover: f64,
    /// The direction of the line that it hangs on, for objects that must be seen from the side.
    pub axis_deg: Option<f64>,
}

impl Object {
    /// An object in the open on the ground.
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

/// The class of an object. The word after `mark .. as` is [`ObjectClass::kind`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ObjectClass {
    /// A mine that contains much metal.
    MetalMine,
    /// A mine that contains hardly any metal.
    MinimumMetalMine,
    /// A mine or a shell in the open.
    SurfaceMine,
    /// Scrap that detectors mistake for a mine.
    Clutter,
    /// A person in need of help.
    Person,
    /// An animal, which a thermal camera mistakes for a person.
    Animal,
    Fire,
    /// A fault of a line or a structure.
    Defect,
    /// A source of gas.
    Leak,
    /// A source of radiation.
    Source,
}

impl ObjectClass {
    /// The kind to report such an object as; `None` if it should not be reported.
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

/// A load that vehicles can release.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Load {
    Ball,
    /// A second of spraying.
    Spray,
    /// A kit, such as medicine or a life vest.
    Kit,
    Node,
}

impl Load {
    pub const ALL: [Self; 4] = [Self::Ball, Self::Spray, Self::Kit, Self::Node];

    /// The load's name in mission files.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Spray => "spray",
            Self::Kit => "kit",
            Self::Node => "node",
        }
    }

    /// The id of this load's part in the workshop's catalogue; for spray, the id of the sprayer.
    pub fn part(self) -> &'static str {
        match self {
            Self::Ball => "s_ball",
            Self::Spray => "s_spray",
            Self::Kit => "s_med",
            Self::Node => "s_node",
        }
    }

    /// The maximum height of a release in metres: from higher up, the wind carries spray away, a kit misses the person
    /// that it is meant for, and other pieces land anywhere.
    pub fn highest_m(self) -> f64 {
        match self {
            Self::Spray | Self::Kit => 20.0,
            Self::Ball | Self::Node => 40.0,
        }
    }

    /// The load's name on the screen.
    pub fn name(self) -> Text {
        match self {
            Self::Ball => text!("load-ball"),
            Self::Spray => text!("load-spray"),
            Self::Kit => text!("load-kit"),
            Self::Node => text!("load-node"),
        }
    }
}

/// The effect of a load where it landed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LoadEffect {
    /// Whether the load helped.
    pub good: bool,
    /// The object that it reached, by its index among the hazard's.
    pub object: Option<usize>,
    pub text: Text,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Release {
    pub load: Load,
    pub at: Point,
    pub by: VehicleId,
    /// Mission time of the release.
    pub when: Duration,
    /// Whether the load helped.
    pub good: bool,
}

/// A ground robot at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passage {
    pub at: Point,
    pub speed_m_s: f64,
    /// Whether the robot has a flail, which sets off mines ahead of it.
    pub has_flail: bool,
}

/// What happens to a mine that a ground robot passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MinePassed {
    /// The flail has set it off, without harm.
    Cleared,
    /// It has gone off under the robot.
    SetOff,
}

/// A piece of the truth, for the map of the debrief.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TruthPiece {
    pub at: Point,
    pub shape: TruthShape,
}

/// The form of a piece of the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TruthShape {
    /// An object, and whether it was there at the end.
    Object(ObjectClass, bool),
    /// A square: its side in metres, and the strength of the hazard there, 0 to 1.
    Square(f64, f64),
    /// A square that a fire has reached: its side in metres, and whether it still burns.
    Fire(f64, bool),
}
