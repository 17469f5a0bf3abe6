//! What lets something out into the air, whatever becomes of it there: what it is, where, and how the seed varies it.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;
use toml::Spanned;

use super::plume::Plume;
use super::{Object, ObjectClass, Quantity};
use crate::mission::Point;
use crate::mission::file::{Faults, POINT_RANGE};

pub(super) const UG_PER_G: f64 = 1e6;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JitterFile {
    position: Spanned<f64>,
    rate: Spanned<f64>,
}

/// What comes out of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Substance {
    /// The vapour of a solvent.
    #[default]
    Vapour,
    /// Carbon monoxide.
    Monoxide,
    /// Natural gas.
    Methane,
    /// Smoke.
    Smoke,
}

impl Substance {
    /// What it is measured in.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Vapour => Quantity::Vapour,
            Self::Monoxide => Quantity::Monoxide,
            Self::Methane => Quantity::Methane,
            Self::Smoke => Quantity::Particles,
        }
    }
}

/// By how much the seed varies a source.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Jitter {
    /// On each axis.
    position_m: f64,
    /// As a share.
    rate: f64,
}

impl Jitter {
    /// As a mission file has it; none where it says nothing.
    pub fn read(file: Option<&JitterFile>, faults: &mut Faults) -> Self {
        file.map_or_else(Self::default, |file| Self {
            position_m: faults.number(&file.position, 0.0..=POINT_RANGE, "jitter.position"),
            rate: faults.number(&file.rate, 0.0..=0.9, "jitter.rate"),
        })
    }

    /// The source as it is this time.
    pub fn vary(self, source: &Plume, random: &mut ChaCha8Rng) -> Plume {
        let mut sway = |by: f64| by * (2.0 * random.random::<f64>() - 1.0);
        let [east_m, north_m] = source.source;
        Plume {
            source: [
                east_m + sway(self.position_m),
                north_m + sway(self.position_m),
            ],
            rate_g_s: source.rate_g_s * (1.0 + sway(self.rate)),
            ..source.clone()
        }
    }
}

/// Where something comes out.
pub(super) fn leak(at: Point, height_m: f64) -> Object {
    Object {
        height_m,
        ..Object::new(ObjectClass::Leak, at)
    }
}
