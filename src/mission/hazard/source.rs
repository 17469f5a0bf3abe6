//! Sources of airborne substances: substance, place, and the seed's variation.

use std::slice;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::dispersion::{Stability, Terrain};
use super::gaussian::Plume;
use super::{Object, ObjectClass, Quantity, TruthPiece, TruthShape};
use crate::mission::format::{FileTable, POINT_RANGE, number, point, table as table_of, word};

/// The substance that a source emits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Substance {
    /// The vapour of a solvent.
    Vapour,
    Monoxide,
    Methane,
    Smoke,
}

impl Substance {
    const WORDS: [(&str, Self); 4] = [
        ("vapour", Self::Vapour),
        ("monoxide", Self::Monoxide),
        ("methane", Self::Methane),
        ("smoke", Self::Smoke),
    ];

    /// The quantity that sensors measure for the substance.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Vapour => Quantity::Vapour,
            Self::Monoxide => Quantity::Monoxide,
            Self::Methane => Quantity::Methane,
            Self::Smoke => Quantity::Particles,
        }
    }
}

/// A leak, before the seed has varied it.
#[derive(Debug, Clone)]
pub(super) struct LeakPlan {
    source: Plume,
    substance: Substance,
    jitter: Jitter,
}

/// The amount by which the seed varies a source.
#[derive(Debug, Clone, Copy, Default)]
struct Jitter {
    /// The maximum on each axis, in metres.
    position_m: f64,
    /// The maximum as a share of the rate, either way.
    rate: f64,
}

impl LeakPlan {
    /// Reads the keys of a leak.
    pub fn need(table: &mut FileTable<'_>) -> Option<Self> {
        let source = table.need("source", point(), "position of the leak");
        let height_m = table.need("height", number(0.0, 500.0, "m"), "height of the leak");
        let rate_g_s = table.need("rate", number(1e-6, 1e6, "g/s"), "amount released");
        let stability = table.need(
            "stability",
            word(&Stability::WORDS),
            "stability of the air: `A` very unstable (sun, spreads fast) to `F` stable (clear night, stays narrow); `D` is neutral",
        );
        let terrain = table.or(
            "terrain",
            word(&Terrain::WORDS),
            Terrain::Open,
            "`urban` ground spreads the plume more",
        );
        let substance = table.or(
            "substance",
            word(&Substance::WORDS),
            Substance::Vapour,
            "substance that leaks; `s_voc`, `s_gas4`, `s_tdlas` and `s_pm25` measure these, in this order",
        );
        let jitter = table.may("jitter", table_of(read_jitter), "variation by the seed");
        Some(Self {
            source: Plume {
                source: source?,
                height_m: height_m?,
                rate_g_s: rate_g_s?,
                stability: stability?,
                terrain,
            },
            substance,
            jitter: jitter.unwrap_or_default(),
        })
    }

    /// A source of vapour that the seed does not vary.
    #[cfg(test)]
    pub fn steady(source: Plume) -> Self {
        Self {
            source,
            substance: Substance::Vapour,
            jitter: Jitter::default(),
        }
    }

    /// The leak with the seed's variation.
    pub fn drawn(&self, random: &mut ChaCha8Rng) -> Leak {
        Leak::new(self.jitter.vary(&self.source, random), self.substance)
    }
}

fn read_jitter(table: &mut FileTable<'_>) -> Option<Jitter> {
    let position = number(0.0, POINT_RANGE, "m");
    let position_m = table.need(
        "position",
        position,
        "maximum shift of the source on each axis",
    );
    let rate = table.need(
        "rate",
        number(0.0, 0.9, ""),
        "maximum relative change of the rate",
    );
    Some(Jitter {
        position_m: position_m?,
        rate: rate?,
    })
}

impl Jitter {
    fn vary(self, source: &Plume, random: &mut ChaCha8Rng) -> Plume {
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

/// A leak of one flight.
#[derive(Debug, Clone)]
pub(super) struct Leak {
    pub source: Plume,
    substance: Substance,
    /// Its position, as an object that can be found.
    object: Object,
}

impl Leak {
    pub fn new(source: Plume, substance: Substance) -> Self {
        Self {
            object: Object {
                height_m: source.height_m,
                ..Object::new(ObjectClass::Leak, source.source)
            },
            source,
            substance,
        }
    }

    /// Whether the leak's substance is measured as this quantity.
    pub fn is_measured_in(&self, quantity: Quantity) -> bool {
        self.substance.quantity() == quantity
    }

    pub fn objects(&self) -> &[Object] {
        slice::from_ref(&self.object)
    }

    /// The leak's position, for the map of the debrief.
    pub fn truth(&self) -> TruthPiece {
        TruthPiece {
            at: self.source.source,
            shape: TruthShape::Object(ObjectClass::Leak, true),
        }
    }
}
