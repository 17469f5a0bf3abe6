//! The figures of a design.

use serde::Serialize;

use super::air::Air;
use super::design::{Design, Drive};
use super::drive::VOLTAGE_SHARE;
use super::driving::DriveFigures;
use super::forward::Forward;
use super::kind::DesignKind;
use super::loss::{GROUND_ANTENNA_M, LOWEST_ANTENNA_M, reach_m};
use super::pack::Pack;
use super::part::Radio;
use crate::geo::maths;
use crate::sim::GRAVITY_M_S2;

/// The thrust over weight below which a drone cannot hold its position in wind.
pub const LEAST_THRUST: f64 = 1.3;
/// The thrust over weight below which gusts saturate the motors.
pub const GOOD_THRUST: f64 = 1.8;

/// The charge, in percent, at which thrust is stated: that in the middle of a flight.
const MIDDLE_CHARGE: f64 = 60.0;
/// The maximum lean of any drone, in degrees; low thrust reduces it, since a tenth is kept for control.
const MOST_LEAN_DEG: f64 = 35.0;
const CONTROL_SHARE: f64 = 0.9;
const SPEED_STEP_M_S: f64 = 0.5;
const SPEED_STEPS: u32 = 70;
/// The planned margin of a link, in decibels.
const FADE_MARGIN_DB: f64 = 20.0;

/// The figures of a complete drone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Figures {
    /// The mass ready to fly, in kilograms.
    pub mass_kg: f64,
    /// The price of all parts, in credits.
    pub credits: u32,
    /// Thrust of all motors at 60 % charge, in newtons.
    pub max_thrust_n: f64,
    /// Thrust over weight at 60 % charge.
    pub thrust_to_weight: f64,
    /// The same ratio with a full battery.
    pub thrust_to_weight_full: f64,
    /// Power of the hover from the battery, with electronics, in watts.
    pub hover_power_w: f64,
    /// Current of the hover at 60 % charge, in amperes.
    pub hover_current_a: f64,
    /// Voltage of the pack at that current.
    pub hover_voltage_v: f64,
    /// Revolutions per minute of the propellers in the hover.
    pub hover_rpm: f64,
    /// The share of the maximum thrust that the hover needs, with a full battery.
    pub hover_throttle: f64,
    /// Hover time with the usable part of the charge, in seconds.
    pub hover_time_s: f64,
    /// Hover time until 80 % of the charge is used, in seconds.
    pub hover_80_s: f64,
    /// The charge in percent below which the voltage is too low for the hover; `None` if that is within the reserve.
    pub sags_at: Option<f64>,
    /// The speed of least power and so of the longest flight time, in m/s.
    pub endurance_speed_m_s: f64,
    /// The flight time at that speed, in seconds.
    pub longest_s: f64,
    /// The speed of the longest range, in m/s.
    pub range_speed_m_s: f64,
    /// The range at that speed without wind, in metres.
    pub range_m: f64,
    /// The highest speed in level flight, limited by lean and thrust, in m/s.
    pub top_speed_m_s: f64,
    /// The greatest lean in level flight, in degrees.
    pub most_lean_deg: f64,
    /// Battery capacity, in ampere hours.
    pub capacity_ah: f64,
    /// Nominal energy of the battery, in watt hours.
    pub energy_wh: f64,
    /// The battery's continuous current limit, in amperes.
    pub max_current_a: f64,
    /// The mass that can be added until the thrust is [`GOOD_THRUST`] times the weight, in kilograms; negative if the
    /// drone is too heavy.
    pub spare_kg: f64,
}

/// The figures of a complete vehicle, by its kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Performance {
    Flight(Figures),
    Drive(DriveFigures),
}

impl Performance {
    /// The figures of a drone.
    pub fn flight(&self) -> Option<&Figures> {
        match self {
            Self::Flight(figures) => Some(figures),
            Self::Drive(_) => None,
        }
    }

    /// The figures of a ground robot or boat.
    pub fn drive(&self) -> Option<&DriveFigures> {
        match self {
            Self::Flight(_) => None,
            Self::Drive(figures) => Some(figures),
        }
    }
}

/// The reach of a design's radio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// The range with a margin of 20 dB, from an antenna 2 m high to a drone at a height, in metres.
    pub range_m: f64,
}

impl Design {
    /// The figures of the design's kind of vehicle; `None` while parts of the drive are missing.
    pub fn performance(&self, air: Air) -> Option<Performance> {
        match self.kind() {
            DesignKind::Drone => self.figures(air).map(Performance::Flight),
            DesignKind::Robot | DesignKind::Boat => self.drive_figures(air).map(Performance::Drive),
        }
    }

    /// The figures of a drone in given air; `None` while parts of the drive are missing, and for another kind of vehicle.
    pub fn figures(&self, air: Air) -> Option<Figures> {
        let drive = self.drive()?;
        let bench = FigureInputs::new(self, &drive, air);
        Some(bench.figures(self))
    }

    /// The power in watts at each speed, up to the fastest one: of level flight, in steps of half a metre per second, or
    /// of driving; empty while parts of the drive are missing.
    pub fn polar(&self, air: Air) -> Vec<(f64, f64)> {
        let Some(drive) = self.drive() else {
            return self.drive_polar(air);
        };
        let bench = FigureInputs::new(self, &drive, air);
        let top = bench.top_speed_m_s();
        speeds()
            .take_while(|speed| *speed <= top)
            .map(|speed| (speed, bench.forward.at(speed).power_w))
            .collect()
    }

    /// Hover time in seconds by added payload in kilograms, up to a thrust of [`LEAST_THRUST`] times the weight; or
    /// driving time, up to what the chassis or hull carries.
    pub fn endurance_by_payload(&self, air: Air) -> Vec<(f64, f64)> {
        let Some(drive) = self.drive() else {
            return self.drive_time_by_payload(air);
        };
        let bench = FigureInputs::new(self, &drive, air);
        let most_kg =
            bench.max_thrust_n(MIDDLE_CHARGE) / (LEAST_THRUST * GRAVITY_M_S2) - bench.mass_kg();
        let steps = 20;
        (0..=steps)
            .map(|step| most_kg.max(0.0) * f64::from(step) / f64::from(steps))
            .map(|added_kg| (added_kg, bench.hover_time_s(bench.mass_kg() + added_kg)))
            .collect()
    }

    /// The reach of the radio to a drone at a height; `None` without a radio.
    pub fn link(&self, height_m: f64) -> Option<Link> {
        self.radio().map(|radio| Link {
            range_m: radio.range_m(height_m, self.antenna_gain_dbi()),
        })
    }
}

/// The inputs of all figures, computed once.
struct FigureInputs<'a> {
    drive: &'a Drive<'a>,
    pack: Pack,
    forward: Forward<'a>,
}

impl<'a> FigureInputs<'a> {
    fn new(design: &Design, drive: &'a Drive<'a>, air: Air) -> Self {
        let density = air.density();
        let mass_kg = design.mass_kg();
        let electronics_w = design.electronics_w();
        let hover = drive.hovering(mass_kg, density);
        Self {
            drive,
            pack: Pack::of(drive, air.battery_c),
            forward: Forward {
                drive,
                mass_kg,
                density,
                electronics_w,
                hover,
                hover_power_w: drive.hover_power_w(&hover, electronics_w),
            },
        }
    }

    fn mass_kg(&self) -> f64 {
        self.forward.mass_kg
    }

    fn max_thrust_n(&self, charge: f64) -> f64 {
        let forward = &self.forward;
        self.drive
            .max_thrust_n(&self.pack, charge, forward.electronics_w, forward.density)
    }

    fn hover_time_s(&self, mass_kg: f64) -> f64 {
        let hover = self.drive.hovering(mass_kg, self.forward.density);
        let power_w = self.drive.hover_power_w(&hover, self.forward.electronics_w);
        let needed_v = hover.volts / VOLTAGE_SHARE;
        self.pack.lasts(power_w, self.pack.usable, needed_v).0
    }

    /// The greatest lean at which the thrust still carries the weight, in degrees; zero if it does not.
    fn most_lean_deg(&self) -> f64 {
        let weight_n = self.mass_kg() * GRAVITY_M_S2;
        let thrust_n = CONTROL_SHARE * self.max_thrust_n(MIDDLE_CHARGE);
        let share = (weight_n / thrust_n).min(1.0);
        maths::acos(share).to_degrees().min(MOST_LEAN_DEG)
    }

    fn top_speed_m_s(&self) -> f64 {
        let lean_deg = self.most_lean_deg();
        speeds()
            .take_while(|speed| self.forward.at(*speed).lean_deg <= lean_deg)
            .last()
            .unwrap_or_default()
    }

    /// The speed with the largest value of `worth`, and that value.
    fn best(&self, worth: impl Fn(f64, f64) -> f64) -> (f64, f64) {
        let top = self.top_speed_m_s().max(SPEED_STEP_M_S);
        speeds()
            .take_while(|speed| *speed <= top)
            .map(|speed| {
                let power_w = self.forward.at(speed).power_w;
                (speed, worth(speed, self.lasts_s(power_w)))
            })
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or_default()
    }

    fn lasts_s(&self, power_w: f64) -> f64 {
        self.pack.lasts(power_w, self.pack.usable, 0.0).0
    }

    fn figures(&self, design: &Design) -> Figures {
        let weight_n = self.mass_kg() * GRAVITY_M_S2;
        let (hover, power_w) = (self.forward.hover, self.forward.hover_power_w);
        let needed_v = hover.volts / VOLTAGE_SHARE;
        let loaded = self.pack.loaded(MIDDLE_CHARGE, power_w);
        let (hover_time_s, end) = self.pack.lasts(power_w, self.pack.usable, needed_v);
        let reserve = 100.0 * (1.0 - self.pack.usable);
        let max_thrust_n = self.max_thrust_n(MIDDLE_CHARGE);
        let full = self.max_thrust_n(100.0) / weight_n;
        let (endurance_speed_m_s, longest_s) = self.best(|_, lasts_s| lasts_s);
        let (range_speed_m_s, range_m) = self.best(|speed, lasts_s| speed * lasts_s);
        Figures {
            mass_kg: self.mass_kg(),
            credits: design.credits(),
            max_thrust_n,
            thrust_to_weight: max_thrust_n / weight_n,
            thrust_to_weight_full: full,
            hover_power_w: power_w,
            hover_current_a: loaded.map_or(f64::INFINITY, |loaded| loaded.amperes),
            hover_voltage_v: loaded.map_or(0.0, |loaded| loaded.volts),
            hover_rpm: hover.rpm,
            hover_throttle: 1.0 / full,
            hover_time_s,
            hover_80_s: self.pack.lasts(power_w, 0.8, needed_v).0,
            sags_at: (end > reserve + 0.25).then_some(end),
            endurance_speed_m_s,
            longest_s,
            range_speed_m_s,
            range_m,
            top_speed_m_s: self.top_speed_m_s(),
            most_lean_deg: self.most_lean_deg(),
            capacity_ah: self.pack.capacity_ah,
            energy_wh: self.pack.energy_wh(),
            max_current_a: self.pack.max_current_a,
            spare_kg: max_thrust_n / (GOOD_THRUST * GRAVITY_M_S2) - self.mass_kg(),
        }
    }
}

impl Figures {
    /// The maximum distance out and back along a wind, in metres: `t (v^2 - w^2) / 2 v` at the
    /// speed of the longest range; zero if the wind is at least as fast.
    pub fn radius_m(&self, wind_m_s: f64) -> f64 {
        let speed = self.range_speed_m_s;
        let time_s = self.range_m / speed.max(SPEED_STEP_M_S);
        (time_s * (speed * speed - wind_m_s * wind_m_s) / (2.0 * speed.max(SPEED_STEP_M_S)))
            .max(0.0)
    }
}

impl Radio {
    /// The maximum distance that leaves the fade margin, in metres. `more_dbi` is the additional
    /// gain of the drone's antenna.
    fn range_m(&self, height_m: f64, more_dbi: f64) -> f64 {
        let budget_db = self.budget_db(self.air_dbi, self.ground_dbi) - FADE_MARGIN_DB + more_dbi;
        let height_m = height_m.max(LOWEST_ANTENNA_M);
        reach_m(budget_db, self.frequency_mhz, height_m, GROUND_ANTENNA_M)
    }
}

fn speeds() -> impl Iterator<Item = f64> {
    (0..SPEED_STEPS).map(|step| f64::from(step) * SPEED_STEP_M_S)
}
