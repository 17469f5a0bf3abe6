//! Fuels, and the speed of a fire front in them.

use crate::geo::maths;
use crate::mission::weather::Wind;

/// The cover of the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Fuel {
    Grass,
    Shrub,
    /// Leaves and needles on the ground under trees.
    Timber,
    /// Roads, water, bare soil: nothing burns.
    Bare,
}

struct Burning {
    /// Speed of a front in calm air, in m/s.
    calm_m_s: f64,
    /// The share of the wind's speed that is added to the front's speed.
    of_wind: f64,
    stays_s: f64,
    smoke_g_s_m2: f64,
}

/// Estimates, to be replaced by the values of a fire expert. The factor 0.1 of the wind's speed is
/// the rule of thumb of Cruz and Alexander (2019) for fuels in the open. Shrubs are sheltered, and
/// litter lies under trees, so their factors are lower.
const GRASS: Burning = Burning {
    calm_m_s: 0.05,
    of_wind: 0.10,
    stays_s: 20.0,
    smoke_g_s_m2: 0.05,
};
const SHRUB: Burning = Burning {
    calm_m_s: 0.025,
    of_wind: 0.06,
    stays_s: 80.0,
    smoke_g_s_m2: 0.08,
};
const TIMBER: Burning = Burning {
    calm_m_s: 0.008,
    of_wind: 0.015,
    stays_s: 600.0,
    smoke_g_s_m2: 0.03,
};

/// How moisture above 5 % slows a front: `exp(-7 (moisture - 0.05))`.
const MOISTURE_SLOWS: f64 = 7.0;
const DRY: f64 = 0.05;
/// How much slower a front is across and against the wind: `exp(0.131 V (cos - 1))` (Alexandridis et al. 2008).
const SHAPE_PER_M_S: f64 = 0.131;

impl Fuel {
    pub const WORDS: [(&str, Self); 4] = [
        ("grass", Self::Grass),
        ("shrub", Self::Shrub),
        ("timber", Self::Timber),
        ("bare", Self::Bare),
    ];

    fn burning(self) -> Option<&'static Burning> {
        match self {
            Self::Grass => Some(&GRASS),
            Self::Shrub => Some(&SHRUB),
            Self::Timber => Some(&TIMBER),
            Self::Bare => None,
        }
    }

    /// Whether the fuel can burn.
    pub fn burns(self) -> bool {
        self.burning().is_some()
    }

    /// The speed of a front with the wind, in m/s: `(R0 + share U) exp(-7 (moisture - 0.05))`.
    pub fn rate_m_s(self, wind_m_s: f64, moisture: f64) -> f64 {
        let damp = maths::exp(-MOISTURE_SLOWS * (moisture - DRY));
        self.burning().map_or(0.0, |burning| {
            (burning.calm_m_s + burning.of_wind * wind_m_s) * damp
        })
    }

    /// How long the fuel burns after the front has passed, in seconds.
    pub fn stays_s(self) -> f64 {
        self.burning().map_or(0.0, |burning| burning.stays_s)
    }

    /// The smoke of a burning square metre, in g/s.
    pub fn smoke_g_s_m2(self) -> f64 {
        self.burning().map_or(0.0, |burning| burning.smoke_g_s_m2)
    }

    /// Whether the fuel throws embers.
    pub fn throws_embers(self) -> bool {
        matches!(self, Self::Shrub | Self::Timber)
    }
}

/// The speed of a front in a direction (east, north; any length), as a share of the speed with the wind.
pub(super) fn share_of_rate(wind: Wind, [east, north]: [f64; 2]) -> f64 {
    let drift = wind.drift_m_s();
    let length = maths::hypot(east, north) * wind.speed_m_s;
    if length <= 0.0 {
        return 1.0;
    }
    let cos = (drift[0] * east + drift[1] * north) / length;
    maths::exp(SHAPE_PER_M_S * wind.speed_m_s * (cos - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fronts_run_at_the_speeds_of_the_formula() {
        for (fuel, wind, moisture, expected) in [
            (Fuel::Grass, 0.0, 0.05, 0.05),
            (Fuel::Grass, 5.0, 0.05, 0.55),
            (Fuel::Grass, 5.0, 0.15, 0.2731),
            (Fuel::Shrub, 5.0, 0.05, 0.325),
            (Fuel::Timber, 5.0, 0.05, 0.083),
            (Fuel::Bare, 5.0, 0.05, 0.0),
        ] {
            let rate = fuel.rate_m_s(wind, moisture);
            assert!((rate - expected).abs() < 1e-3, "{fuel:?} {wind}: {rate}");
        }
    }

    #[test]
    fn fronts_are_slower_across_the_wind_and_slowest_against_it() {
        let wind = Wind {
            speed_m_s: 5.0,
            from_deg: 270.0,
        };
        for (way, expected) in [
            ([1.0, 0.0], 1.0),
            ([0.0, 3.0], 0.5194),
            ([-2.0, 0.0], 0.2698),
        ] {
            let share = share_of_rate(wind, way);
            assert!((share - expected).abs() < 1e-3, "{way:?}: {share}");
        }
        let calm = crate::mission::weather::Weather::CALM.wind;
        assert!((share_of_rate(calm, [0.3, 0.1]) - 1.0).abs() < 1e-12);
    }
}
