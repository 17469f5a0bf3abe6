//! Hazards: fields of something harmful that sensors can measure, and things that they can find. One file per kind.

use std::fmt::Debug;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;

use super::Point;
use super::format::KindOf;
use super::ground_truth::{
    Load, LoadEffect, Object, ObjectClass, Quantity, TruthPiece, TruthShape,
};
use super::weather::Weather;

mod dispersion;
mod fire;
mod flood;
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

    /// Whether a point is where its things are known to lie, in one place or another.
    fn may_lie_at(&self, _at: Point) -> bool {
        true
    }

    /// What a load does to it where it comes down; `None` where the load does not concern it.
    fn affect(&mut self, _load: Load, _at: Point) -> Option<LoadEffect> {
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
