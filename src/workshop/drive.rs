//! Motors and propellers at work: power for a thrust, and the available thrust.

use super::design::Drive;
use super::pack::Pack;
use crate::geo::maths;
use crate::sim::GRAVITY_M_S2;

const INCH_M: f64 = 0.0254;
/// The resistance of warm copper, relative to the data sheet.
const WARM_COPPER: f64 = 1.10;
/// The voltage at which the no-load current is stated, and the share of that current at work (fitted to bench tests).
const NO_LOAD_V: f64 = 20.0;
const NO_LOAD_SHARE: f64 = 0.5;
/// The maximum share of the battery's voltage that a motor gets at full throttle (mean of bench tables, 0.76 to 0.88).
pub(super) const VOLTAGE_SHARE: f64 = 0.83;
/// The multiple of its rated power that a motor can give for the duration of a climb.
const SHORT_POWER: f64 = 1.25;
/// The factor on hover power for interacting rotors and control, compared with single rotors on a test bench.
const INTERACTION: f64 = 1.03;
/// Steps of the bisection for the largest thrust: from 400 N to less than a micronewton.
const ROUNDS: u32 = 32;
const MOST_THRUST_N: f64 = 400.0;

/// One motor with its propeller at a given thrust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turning {
    pub rpm: f64,
    /// Mechanical power, in watts.
    pub shaft_w: f64,
    pub volts: f64,
    /// Power from the battery, in watts.
    pub electric_w: f64,
}

impl Drive<'_> {
    /// Area that all rotors sweep, in square metres.
    pub fn disc_area_m2(&self) -> f64 {
        let diameter_m = self.diameter_m();
        self.motors() * std::f64::consts::PI * diameter_m * diameter_m / 4.0
    }

    pub fn diameter_m(&self) -> f64 {
        self.propeller.diameter_in * INCH_M
    }

    pub fn motors(&self) -> f64 {
        f64::from(self.frame.motors)
    }

    /// One motor at this thrust, in air of this density: the propeller's coefficients give speed
    /// and torque, the torque constant `30 / (pi Kv)` gives the current, and resistance and
    /// back-EMF give the voltage.
    pub fn turning(&self, thrust_n: f64, density: f64) -> Turning {
        let propeller = self.propeller;
        let diameter_m = self.diameter_m();
        let turns_s =
            (thrust_n.max(1e-6) / (propeller.thrust * density * maths::powi(diameter_m, 4))).sqrt();
        let shaft_w =
            propeller.power * density * maths::powi(turns_s, 3) * maths::powi(diameter_m, 5);
        let torque_n_m = shaft_w / (std::f64::consts::TAU * turns_s);
        let rpm = turns_s * 60.0;
        let motor = self.motor;
        let torque_constant = 30.0 / std::f64::consts::PI / motor.kv_rpm_v;
        let idle_a = motor.idle_current_a * NO_LOAD_SHARE * rpm / (motor.kv_rpm_v * NO_LOAD_V);
        let amperes = torque_n_m / torque_constant + idle_a;
        let volts = WARM_COPPER * motor.resistance_ohm * amperes + rpm / motor.kv_rpm_v;
        Turning {
            rpm,
            shaft_w,
            volts,
            electric_w: volts * amperes / self.esc.efficiency,
        }
    }

    /// One motor in the hover of a drone with a given mass. The arms block a part of the downwash, which reduces the
    /// thrust.
    pub fn hovering(&self, mass_kg: f64, density: f64) -> Turning {
        let thrust_n = mass_kg * GRAVITY_M_S2 * (1.0 + self.frame.download) / self.motors();
        self.turning(thrust_n, density)
    }

    /// The power of the hover from the battery, in watts.
    pub fn hover_power_w(&self, hover: &Turning, electronics_w: f64) -> f64 {
        self.motors() * hover.electric_w * INTERACTION + electronics_w
    }

    /// The maximum thrust of all motors together, in newtons, at a charge in percent: limited by
    /// the motor's voltage and power, the speed controller's current, the propeller's speed, and
    /// the battery's current, whichever is reached first.
    pub fn max_thrust_n(&self, pack: &Pack, charge: f64, electronics_w: f64, density: f64) -> f64 {
        let bears = |thrust_n: f64| {
            let one = self.turning(thrust_n, density);
            let power_w = self.motors() * one.electric_w + electronics_w;
            pack.loaded(charge, power_w).is_some_and(|loaded| {
                one.volts <= VOLTAGE_SHARE * loaded.volts
                    && one.electric_w <= SHORT_POWER * self.motor.max_power_w
                    && one.electric_w / loaded.volts <= self.esc.max_current_a
                    && one.rpm <= self.propeller.max_rpm
                    && loaded.amperes <= pack.max_current_a
            })
        };
        let (mut low, mut high) = (0.0, MOST_THRUST_N);
        for _ in 0..ROUNDS {
            let middle = f64::midpoint(low, high);
            if bears(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low * self.motors()
    }
}
