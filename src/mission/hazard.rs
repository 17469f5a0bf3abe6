//! Hazards: fields of something harmful that sensors can measure, and things that they can find. One file per kind.

use std::fmt::Debug;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;

use super::Point;
use super::file::Reader;
use super::weather::Weather;
use crate::text::Text;

mod dispersion;
pub(super) mod fire;
pub(super) mod flood;
pub(super) mod line;
pub(super) mod minefield;
pub(super) mod people;
mod placing;
pub(super) mod plume;
pub(super) mod puffs;
pub(super) mod radiation;
mod source;
pub(super) mod survivors;
mod wander;

pub(crate) use fire::{Fire, Grid};
pub(crate) use people::Care;

/// A hazard as the file describes it.
pub(crate) trait Hazard: Debug + Send + Sync {
    /// The hazard of one flight: what the file leaves to chance is drawn from `random`, now and as time passes.
    fn release(&self, weather: &Weather, random: ChaCha8Rng) -> Box<dyn Field>;
}

/// A hazard's truth during one flight.
pub(crate) trait Field: Debug + Send + Sync {
    /// Lets a [`TICK`](super::TICK) pass; `now` is mission time at its end.
    fn step(&mut self, _now: Duration, _weather: &Weather) {}

    /// How much of a quantity it brings to a point and a height above the origin.
    fn amount(&self, _quantity: Quantity, _at: Point, _height_m: f64) -> f64 {
        0.0
    }

    /// The things in it that detectors can find; their order and number never change during a flight.
    fn objects(&self) -> &[Object] {
        &[]
    }

    /// What a load does to it where it comes down; `None` where the load does not concern it.
    fn affect(&mut self, _load: Load, _at: Point) -> Option<Effect> {
        None
    }

    /// What has been done for the people in it; `None` where there are none.
    fn care(&self) -> Option<Care> {
        None
    }

    /// How near a place is to the structure; `None` for hazards without one.
    fn distance_m(&self, _at: Point, _height_m: f64) -> Option<f64> {
        None
    }

    /// The fire that it is, if it is one.
    fn fire(&self) -> Option<&Fire> {
        None
    }

    /// What the debrief reveals of it on the map.
    fn truth(&self) -> Vec<Truth> {
        Vec::new()
    }
}

/// What a field can be measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Solvent vapour or gas, in ug/m3.
    Vapour,
    /// Carbon monoxide, in ug/m3.
    Monoxide,
    /// Methane, in ug/m3.
    Methane,
    /// Fine particles and smoke, in ug/m3.
    Particles,
    /// Dose rate of gamma radiation, in uSv/h.
    DoseRate,
}

/// Something that detectors can find.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Object {
    pub class: Class,
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
    pub fn new(class: Class, at: Point) -> Self {
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

/// What an object is. The word after `mark .. as` is [`Class::kind`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// A mine with much metal in it.
    MetalMine,
    /// A mine with hardly any metal in it.
    MinimumMetalMine,
    /// A mine or a shell that lies open.
    SurfaceMine,
    /// Scrap: what detectors take for a mine.
    Clutter,
    /// Somebody who needs help.
    Person,
    /// What a thermal camera takes for a person.
    Animal,
    /// Something that burns.
    Fire,
    /// A fault of a line or a structure.
    Defect,
    /// Where gas comes out.
    Leak,
    /// Where radiation comes from.
    Source,
}

impl Class {
    /// What it is reported as; `None` for what should not be reported at all.
    pub fn kind(self) -> Option<&'static str> {
        Some(match self {
            Self::MetalMine | Self::MinimumMetalMine | Self::SurfaceMine => "mine",
            Self::Person => "person",
            Self::Fire => "fire",
            Self::Defect => "defect",
            Self::Leak => "leak",
            Self::Source => "source",
            Self::Clutter | Self::Animal => return None,
        })
    }
}

/// What vehicles let go of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Load {
    /// An extinguishing ball.
    Ball,
    /// A second of the sprayer.
    Spray,
    /// A kit: medicine, a life vest.
    Kit,
    /// A sensor node.
    Node,
}

impl Load {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ball, Self::Spray, Self::Kit, Self::Node];

    /// The part of the workshop's catalogue that it is, or is sprayed by.
    pub fn part(self) -> &'static str {
        match self {
            Self::Ball => "s_ball",
            Self::Spray => "s_spray",
            Self::Kit => "s_med",
            Self::Node => "s_node",
        }
    }
}

/// What a load has done.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Effect {
    /// Whether it did any good.
    pub good: bool,
    /// The object that it reached, by its place among the hazard's.
    pub object: Option<usize>,
    /// In words.
    pub text: Text,
}

/// A piece of the truth, for the map of the debrief.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Truth {
    pub at: Point,
    /// What is there.
    pub shape: TruthShape,
}

/// What a piece of the truth is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TruthShape {
    /// An object, and whether it was there at the end.
    Object(Class, bool),
    /// A square of this side, and how strong the hazard was there, 0 to 1.
    Square(f64, f64),
}

/// All kinds by name.
pub(super) const KINDS: &[(&str, Reader<Box<dyn Hazard>>)] = &[
    ("flood", flood::read),
    ("line", line::read),
    ("minefield", minefield::read),
    ("plume", plume::read),
    ("puffs", puffs::read),
    ("radiation", radiation::read),
    ("survivors", survivors::read),
    ("fire", fire::read),
];
