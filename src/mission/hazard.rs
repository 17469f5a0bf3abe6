//! Hazards: fields of something harmful that sensors can measure. One file per kind.

use std::fmt::Debug;

use rand_chacha::ChaCha8Rng;

use super::file::Reader;
use super::{Point, Wind};

pub(super) mod plume;

/// A hazard as the file describes it.
pub(crate) trait Hazard: Debug + Send + Sync {
    /// The hazard of one flight: what the file leaves to chance is drawn from `random`.
    fn release(&self, wind: Wind, random: &mut ChaCha8Rng) -> Box<dyn Field>;
}

/// A hazard's truth, the same at every time of the flight.
pub(crate) trait Field: Debug + Send + Sync {
    /// Concentration in ug/m3 at a point and a height above the origin.
    fn concentration_ug_m3(&self, at: Point, height_m: f64) -> f64;
}

/// All kinds by name.
pub(super) const KINDS: &[(&str, Reader<Box<dyn Hazard>>)] = &[("plume", plume::read)];
