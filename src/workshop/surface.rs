//! Wheels on the ground and thrusters in water at work: the resistance at a speed, the power for a force, and the
//! greatest force.

use super::design::Design;
use super::pack::{Loaded, Pack};
use super::part::{Battery, Chassis, Hull, PartSlot, Spec, Thruster, WheelDrive};
use crate::geo::maths;
use crate::sim::{Chassis as Steering, GRAVITY_M_S2, SEA_LEVEL_DENSITY};

const WATER_DENSITY: f64 = 1000.0;
/// The share of the weight that tyres can pull with on short grass (Wong: 0.5 to 0.7 on dry soil).
const GRIP: f64 = 0.6;
/// The share of the pulling sides' speed that remains when a skid-steered robot turns on the spot: its wheels scrub.
const SKID_SHARE: f64 = 0.5;
/// The wetted surface, and with it the drag, grows with this power of the displacement.
const DISPLACEMENT_POWER: f64 = 2.0 / 3.0;
/// Steps of the searches for a force and a speed.
const ROUNDS: u32 = 40;
const MOST_FORCE_N: f64 = 5000.0;
const MOST_SPEED_M_S: f64 = 40.0;

/// The parts that turn a battery's charge into motion on the ground or on water, and the mass that they move.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfaceDrive {
    pub propulsion: Propulsion,
    pub battery: &'static Battery,
    pub packs: u8,
    pub mass_kg: f64,
    pub electronics_w: f64,
}

/// A chassis or a hull with its motors.
#[derive(Debug, Clone, Copy)]
pub(super) enum Propulsion {
    Wheels(&'static Chassis, &'static WheelDrive),
    Water(&'static Hull, &'static Thruster),
}

impl Design {
    /// The drive of a ground robot or boat; `None` if one of its slots is empty or has a part of another kind of
    /// vehicle.
    pub(super) fn surface_drive(&self) -> Option<SurfaceDrive> {
        let propulsion = match (self.spec(PartSlot::Frame)?, self.spec(PartSlot::Motor)?) {
            (Spec::Chassis(chassis), Spec::WheelDrive(drive)) => Propulsion::Wheels(chassis, drive),
            (Spec::Hull(hull), Spec::Thruster(thruster)) => Propulsion::Water(hull, thruster),
            _ => return None,
        };
        let Spec::Battery(battery) = self.spec(PartSlot::Battery)? else {
            return None;
        };
        Some(SurfaceDrive {
            propulsion,
            battery,
            packs: self.in_slot(PartSlot::Battery).len() as u8,
            mass_kg: self.mass_kg(),
            electronics_w: self.electronics_w(),
        })
    }
}

impl SurfaceDrive {
    /// The same drive with more mass on board.
    pub fn laden(self, more_kg: f64) -> Self {
        Self {
            mass_kg: self.mass_kg + more_kg,
            ..self
        }
    }

    /// The force that holds a speed on level ground or calm water, in newtons.
    pub fn resistance_n(&self, speed_m_s: f64) -> f64 {
        let dynamic = |density: f64| 0.5 * density * speed_m_s * speed_m_s;
        match self.propulsion {
            Propulsion::Wheels(chassis, _) => {
                chassis.rolling * self.weight_n()
                    + dynamic(SEA_LEVEL_DENSITY) * chassis.drag_area_m2
            }
            Propulsion::Water(hull, _) => {
                let laden = maths::powf(self.mass_kg / hull.built_for_kg, DISPLACEMENT_POWER);
                dynamic(WATER_DENSITY) * hull.drag_area_m2 * laden
            }
        }
    }

    /// The power from the battery for a force at a speed, in watts, with electronics and payload. A motor is a resistance
    /// and a back-EMF; a thruster is an ideal disc in water (momentum theory) with losses.
    pub fn power_w(&self, force_n: f64, speed_m_s: f64) -> f64 {
        let motors = self.motors();
        let one_n = force_n / motors;
        let one_w = match self.propulsion {
            Propulsion::Wheels(chassis, drive) => {
                let turning = drive.turning(one_n * chassis.wheel_radius_m, speed_m_s, chassis);
                turning.volts * turning.amperes
            }
            Propulsion::Water(_, thruster) => thruster.power_w(one_n, speed_m_s),
        };
        motors * one_w + self.electronics_w
    }

    /// The power at a steady speed on level ground or calm water; of a vehicle that stands, that of its electronics.
    pub fn steady_w(&self, speed_m_s: f64) -> f64 {
        if speed_m_s <= 0.0 {
            return self.electronics_w;
        }
        self.power_w(self.resistance_n(speed_m_s), speed_m_s)
    }

    /// The greatest force at a speed and a charge in percent, in newtons: limited by voltage, currents and power, and for
    /// wheels by their grip, whichever is reached first.
    pub fn max_force_n(&self, pack: &Pack, charge: f64, speed_m_s: f64) -> f64 {
        let bears = |force_n: f64| {
            let loaded = pack.loaded(charge, self.power_w(force_n, speed_m_s));
            loaded.is_some_and(|loaded| {
                loaded.amperes <= pack.max_current_a && self.bears(force_n, speed_m_s, &loaded)
            })
        };
        let most_n = match self.propulsion {
            Propulsion::Wheels(..) => GRIP * self.weight_n(),
            Propulsion::Water(..) => MOST_FORCE_N,
        };
        largest(most_n, bears)
    }

    /// Whether the motors bear a force at a speed from a battery at this voltage.
    fn bears(&self, force_n: f64, speed_m_s: f64, loaded: &Loaded) -> bool {
        let one_n = force_n / self.motors();
        match self.propulsion {
            Propulsion::Wheels(chassis, drive) => {
                let turning = drive.turning(one_n * chassis.wheel_radius_m, speed_m_s, chassis);
                turning.volts <= loaded.volts && turning.amperes <= drive.max_current_a
            }
            Propulsion::Water(_, thruster) => {
                let voltage_share = (loaded.volts / thruster.rated_v).min(1.0);
                let most_w = thruster.max_power_w * voltage_share * voltage_share;
                thruster.power_w(one_n, speed_m_s) <= most_w
            }
        }
    }

    /// The fastest steady speed at a charge, in m/s; 0 if the vehicle cannot move.
    pub fn top_speed_m_s(&self, pack: &Pack, charge: f64) -> f64 {
        largest(MOST_SPEED_M_S, |speed_m_s| {
            self.resistance_n(speed_m_s) <= self.max_force_n(pack, charge, speed_m_s)
        })
    }

    /// The steepest slope on which a robot can climb with a pull, in degrees.
    pub fn slope_deg(&self, pull_n: f64) -> f64 {
        largest(45.0, |slope_deg: f64| {
            let (sin, cos) = maths::sin_cos(slope_deg.to_radians());
            let holds_n = self.weight_n() * sin + self.resistance_n(0.0) * cos;
            holds_n <= pull_n.min(GRIP * self.weight_n() * cos)
        })
    }

    /// The radius of the tightest turn, in metres; 0 for a vehicle that turns on the spot.
    pub fn turning_radius_m(&self) -> f64 {
        match self.propulsion {
            Propulsion::Wheels(chassis, _) => chassis.turning_radius_m,
            Propulsion::Water(hull, _) => hull.turning_radius_m,
        }
    }

    /// The fastest turn on the spot at a top speed, in degrees per second; 0 for a vehicle that steers.
    pub fn turn_rate_deg_s(&self, top_speed_m_s: f64) -> f64 {
        match self.propulsion {
            Propulsion::Wheels(chassis, _) if chassis.steering == Steering::Skid => {
                (2.0 * SKID_SHARE * top_speed_m_s / chassis.track_m).to_degrees()
            }
            Propulsion::Wheels(..) | Propulsion::Water(..) => 0.0,
        }
    }

    /// Whether slopes matter to the vehicle.
    pub fn climbs(&self) -> bool {
        matches!(self.propulsion, Propulsion::Wheels(..))
    }

    /// The length of the chassis or hull.
    pub fn length_m(&self) -> f64 {
        match self.propulsion {
            Propulsion::Wheels(chassis, _) => chassis.length_m,
            Propulsion::Water(hull, _) => hull.length_m,
        }
    }

    /// The greatest mass that the chassis or hull carries, with its own.
    pub fn max_mass_kg(&self) -> f64 {
        match self.propulsion {
            Propulsion::Wheels(chassis, _) => chassis.max_mass_kg,
            Propulsion::Water(hull, _) => hull.max_mass_kg,
        }
    }

    /// The numbers of battery cells that the motors take.
    pub fn cells(&self) -> (u8, u8) {
        match self.propulsion {
            Propulsion::Wheels(_, drive) => (drive.fewest_cells, drive.most_cells),
            Propulsion::Water(_, thruster) => (thruster.fewest_cells, thruster.most_cells),
        }
    }

    fn motors(&self) -> f64 {
        f64::from(match self.propulsion {
            Propulsion::Wheels(chassis, _) => chassis.motors,
            Propulsion::Water(hull, _) => hull.motors,
        })
    }

    pub fn weight_n(&self) -> f64 {
        self.mass_kg * GRAVITY_M_S2
    }
}

/// A motor at the wheel under a load.
struct WheelTurning {
    volts: f64,
    amperes: f64,
}

impl WheelDrive {
    /// One motor at a torque at the wheel and a speed: the torque constant is `30 / (pi Kv)`, as for a drone's motor.
    fn turning(&self, torque_n_m: f64, speed_m_s: f64, chassis: &Chassis) -> WheelTurning {
        let rpm = speed_m_s / chassis.wheel_radius_m * 30.0 / std::f64::consts::PI;
        let torque_constant = 30.0 / std::f64::consts::PI / self.kv_rpm_v;
        let idle_a = if speed_m_s > 0.0 {
            self.idle_current_a
        } else {
            0.0
        };
        let amperes = torque_n_m / (self.efficiency * torque_constant) + idle_a;
        WheelTurning {
            volts: self.resistance_ohm * amperes + rpm / self.kv_rpm_v,
            amperes,
        }
    }
}

impl Thruster {
    /// The electrical power for a thrust at a speed through water, in watts: `T (v + w) / efficiency` with the induced
    /// speed `w` of `T = 2 rho A w (v + w)`.
    fn power_w(&self, thrust_n: f64, speed_m_s: f64) -> f64 {
        let area_m2 = std::f64::consts::PI * self.diameter_m * self.diameter_m / 4.0;
        let loading = thrust_n / (2.0 * WATER_DENSITY * area_m2);
        let half = 0.5 * speed_m_s;
        let induced_m_s = (half * half + loading).sqrt() - half;
        thrust_n * (speed_m_s + induced_m_s) / self.efficiency
    }
}

/// The largest value up to `most` for which `holds` is true, if it is true for all smaller ones.
fn largest(most: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..ROUNDS {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
