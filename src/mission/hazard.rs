//! Hazards: harmful fields that sensors can measure, and objects that they can find. One file per kind.
//!
//! # How the parts fit
//! - Substances in the air: `plume` (a steady source) and `puffs` (a leak), with `source`, `gaussian` (the
//!   concentration), `dispersion` (how wide a cloud gets) and `wander` (gusts).
//! - Fields on the ground: `fire` (where it spreads, what stops it), `flood`, `radiation`.
//! - Objects to find: `survivors`, `minefield`, `line` (a power line's defects); `placing` scatters them by the seed,
//!   and `people` decides when help is too late.

use std::fmt::Debug;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;

use super::Point;
use super::format::KindOf;
use super::ground_truth::{
    Load, LoadEffect, MinePassed, Object, ObjectClass, Passage, Quantity, TruthPiece, TruthShape,
};
use super::weather::Weather;

mod dispersion;
mod fire;
mod flood;
mod gaussian;
mod line;
mod minefield;
mod people;
mod placing;
mod plume;
mod puffs;
mod radiation;
mod source;
mod survivors;
mod wander;

pub(crate) use fire::{Fire, FireGrid};
pub(crate) use people::Care;

/// A hazard as described in the file.
pub(crate) trait Hazard: Debug + Send + Sync {
    /// Starts the hazard of one flight; all its randomness, now and later, comes from `random`.
    fn release(&self, weather: &Weather, random: ChaCha8Rng) -> Box<dyn Field>;

    /// The pylons of a power line, which the trainee sees from the start, unlike its defects; empty for other hazards.
    fn pylons(&self) -> &[Point] {
        &[]
    }
}

/// Copies fields whose type is not known; every field with a copy has it.
pub(crate) trait FieldClone {
    fn boxed(&self) -> Box<dyn Field>;
}

impl<T: Field + Clone + 'static> FieldClone for T {
    fn boxed(&self) -> Box<dyn Field> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Field> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// A hazard's truth during one flight.
pub(crate) trait Field: FieldClone + Debug + Send + Sync {
    /// Advances by a [`TICK`](super::TICK); `now` is the mission time at the end of the tick.
    fn step(&mut self, _now: Duration, _weather: &Weather) {}

    /// The amount of a quantity, in its unit, that the hazard adds at a point and a height above
    /// the origin.
    fn amount(&self, _quantity: Quantity, _at: Point, _height_m: f64) -> f64 {
        0.0
    }

    /// The hazard's objects that detectors can find; their order and number never change during a
    /// flight.
    fn objects(&self) -> &[Object] {
        &[]
    }

    /// Whether a point is in the area where the hazard's objects may lie.
    fn may_lie_at(&self, _at: Point) -> bool {
        true
    }

    /// Applies a load that lands at a point; `None` if the load has no effect on this kind of hazard.
    fn affect(&mut self, _load: Load, _at: Point) -> Option<LoadEffect> {
        None
    }

    /// Lets a ground robot pass a point; returns what that does to a mine there, if there is one.
    fn pass(&mut self, _robot: Passage) -> Option<MinePassed> {
        None
    }

    /// The number of mines that ground robots have cleared.
    fn cleared(&self) -> usize {
        0
    }

    /// The help given to the hazard's people; `None` if it has no people.
    fn care(&self) -> Option<Care> {
        None
    }

    /// The distance of a place from the structure; `None` for hazards without one.
    fn distance_m(&self, _at: Point, _height_m: f64) -> Option<f64> {
        None
    }

    /// The fire, for hazards of this kind.
    fn fire(&self) -> Option<&Fire> {
        None
    }

    /// The parts of the hazard that the debrief shows on the map.
    fn truth(&self) -> Vec<TruthPiece> {
        Vec::new()
    }
}

/// All kinds, in the order in which they are listed.
pub(super) static KINDS: &[KindOf<Box<dyn Hazard>>] = &[
    flood::KIND,
    line::KIND,
    minefield::KIND,
    plume::KIND,
    puffs::KIND,
    radiation::KIND,
    survivors::KIND,
    fire::KIND,
];
