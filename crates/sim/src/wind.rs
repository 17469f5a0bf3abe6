//! The moving air: a mean wind with a profile over height, and gusts after Dryden's model (MIL-F-8785C, low altitude).

use glam::DVec3;
use rand::{Rng as _, RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::kinematics::STEP_S;
use super::parameters::Parameters;
use sortie_geo::maths;

/// The minimum speed at which gusts drift past a vehicle, in metres per second, so gusts also reach
/// a vehicle that hovers in calm air.
const DRIFT_MIN_M_S: f64 = 5.0;
/// Standard deviation in m/s per unit of `SIM_WIND_TURB`: with 3, gusts move a hovering quad by about 0.1 m, as
/// measured. The real simulator's gusts are larger but last hundredths of a second.
const GUST_PER_TURBULENCE: f64 = 0.35;
const METRES_PER_FOOT: f64 = 0.3048;

/// The wind from the `SIM_WIND_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WindRules {
    speed_m_s: f64,
    /// Unit vector of the direction in which the air moves.
    towards: DVec3,
    turbulence_m_s: f64,
    profile: Profile,
}

/// The profile of the mean wind with height (`SIM_WIND_T`).
#[derive(Debug, Clone, Copy, PartialEq)]
enum Profile {
    /// Grows with the square root of the height, up to the height at which it reaches the full
    /// speed.
    Root {
        full_height_m: f64,
    },
    Constant,
    /// Grows linearly above a height.
    Linear {
        height_m: f64,
        per_s: f64,
    },
}

/// Gusts at one vehicle, and its random numbers.
#[derive(Debug, Clone)]
pub(super) struct Wind {
    rng: ChaCha8Rng,
    /// The gust along the mean wind, in m/s.
    along_m_s: f64,
    /// Filters for the gusts across the mean wind, and vertically.
    across: Filter,
    vertical: Filter,
}

/// A second-order filter for noise: two equal lags in series.
#[derive(Debug, Clone, Copy, Default)]
struct Filter {
    first: f64,
    second: f64,
}

impl WindRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let finite = |name| all.value(name).clamp(-1e6, 1e6);
        let (sin, cos) = maths::sin_cos(finite("SIM_WIND_DIR").to_radians());
        let (up, flat) = maths::sin_cos(finite("SIM_WIND_DIR_Z").to_radians());
        let height_m = finite("SIM_WIND_T_ALT");
        Self {
            speed_m_s: all.value("SIM_WIND_SPD").clamp(0.0, 100.0),
            towards: -DVec3::new(cos * flat, sin * flat, up),
            turbulence_m_s: all.value("SIM_WIND_TURB").clamp(0.0, 50.0),
            profile: match all.value("SIM_WIND_T") as i8 {
                0 => Profile::Root {
                    full_height_m: height_m.max(1.0),
                },
                2 => Profile::Linear {
                    height_m,
                    per_s: finite("SIM_WIND_T_COEF"),
                },
                _ => Profile::Constant,
            },
        }
    }

    /// The mean speed at a height above the start, in metres per second.
    fn speed_at(&self, height_m: f64) -> f64 {
        match self.profile {
            Profile::Root { full_height_m } => {
                self.speed_m_s * (height_m / full_height_m).clamp(0.0, 1.0).sqrt()
            }
            Profile::Constant => self.speed_m_s,
            Profile::Linear {
                height_m: at,
                per_s,
            } => (self.speed_m_s + (height_m - at) * per_s).clamp(0.0, 100.0),
        }
    }

    fn is_calm(&self) -> bool {
        self.speed_m_s <= 0.0
            && self.turbulence_m_s <= 0.0
            && !matches!(self.profile, Profile::Linear { .. })
    }
}

impl Wind {
    /// Gusts for one vehicle. Each vehicle has its own stream of random numbers, so adding a
    /// vehicle does not change the others.
    pub(super) fn new(seed: u64, vehicle: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(vehicle);
        Self {
            rng,
            along_m_s: 0.0,
            across: Filter::default(),
            vertical: Filter::default(),
        }
    }

    /// The air's velocity (north, east, down) at a height above the start, for one step.
    pub(super) fn step(&mut self, height_m: f64, rules: &WindRules) -> DVec3 {
        if rules.is_calm() {
            return DVec3::ZERO;
        }
        let speed_m_s = rules.speed_at(height_m);
        let mean = rules.towards * speed_m_s;
        if rules.turbulence_m_s <= 0.0 {
            return mean;
        }
        mean + self.gust(height_m, speed_m_s, rules)
    }

    /// A number that identifies this vehicle's board.
    pub(super) fn board_id(&mut self) -> u64 {
        self.rng.next_u64()
    }

    /// Dryden's gusts: near the ground the vertical ones are weaker than the horizontal ones, and all are shorter.
    fn gust(&mut self, height_m: f64, speed_m_s: f64, rules: &WindRules) -> DVec3 {
        let height_ft = (height_m / METRES_PER_FOOT).clamp(10.0, 1000.0);
        let shape = 0.177 + 0.000_823 * height_ft;
        let long_m = height_ft * METRES_PER_FOOT / maths::powf(shape, 1.2);
        let high_m = height_ft * METRES_PER_FOOT;
        let drift_m_s = speed_m_s.max(DRIFT_MIN_M_S);
        let (long_s, high_s) = (long_m / drift_m_s, high_m / drift_m_s);
        let keep = 1.0 - STEP_S / long_s.max(2.0 * STEP_S);
        self.along_m_s = self.along_m_s * keep + self.noise() * (1.0 - keep * keep).sqrt();
        let noise = self.noise();
        let across = self.across.step(noise, long_s);
        let noise = self.noise();
        let vertical = self.vertical.step(noise, high_s) * maths::powf(shape, 0.4).min(1.0);
        let ahead = rules.towards.truncate().normalize_or(glam::DVec2::X);
        let flat = ahead * self.along_m_s + ahead.perp() * across;
        flat.extend(vertical) * (rules.turbulence_m_s * GUST_PER_TURBULENCE)
    }

    /// Evenly distributed noise with a variance of 1.
    fn noise(&mut self) -> f64 {
        self.rng.random_range(-1.0..1.0) * 3.0_f64.sqrt()
    }
}

impl Filter {
    /// Dryden's filter for the gusts across the mean wind, `(1 + √3 T s) / (1 + T s)²`, with a
    /// variance of 1.
    fn step(&mut self, noise: f64, lag_s: f64) -> f64 {
        let blend = STEP_S / lag_s.max(2.0 * STEP_S);
        let root = 3.0_f64.sqrt();
        self.first += (noise / blend.sqrt() - self.first) * blend;
        self.second += (self.first - self.second) * blend;
        root * self.first + (1.0 - root) * self.second
    }
}

#[cfg(test)]
mod tests;
