//! Forward flight of a design: power by speed, and the best speeds.

use super::design::Drive;
use super::drive::Turning;
use crate::geo::maths;
use crate::sim::GRAVITY_M_S2;

/// The induced power of a real rotor relative to the ideal one.
const INDUCED: f64 = 1.15;
/// The assumed share of the power that theory saves at speed. One half gives a known folding drone
/// its best endurance at 9 m/s with 0.87 of its hover power, as its maker states.
const SAVED: f64 = 0.5;
/// Profile power grows with the square of the advance ratio (Glauert).
const PROFILE: f64 = 4.65;
/// The speed above which the arms no longer block the air stream; below it, they block less as the
/// speed increases.
const CLEAN_M_S: f64 = 15.0;
const ROUNDS: u32 = 40;

/// Level flight at one speed through the air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    /// Power from the battery, in watts.
    pub power_w: f64,
    /// The lean in degrees.
    pub lean_deg: f64,
}

/// The quantities of forward flight that do not depend on speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forward<'a> {
    pub drive: &'a Drive<'a>,
    pub mass_kg: f64,
    pub density: f64,
    pub electronics_w: f64,
    pub hover: Turning,
    pub hover_power_w: f64,
}

impl Forward<'_> {
    /// The level flight at a speed: drag determines the lean, the airspeed reduces the induced power (momentum
    /// theory), and the blades' drag rises.
    pub fn at(&self, speed_m_s: f64) -> Level {
        let drive = self.drive;
        let weight_n = self.mass_kg * GRAVITY_M_S2;
        let drag_n = 0.5 * self.density * drive.frame.drag_area_m2 * speed_m_s * speed_m_s;
        let blocked = drive.frame.download * (1.0 - speed_m_s / CLEAN_M_S).max(0.0);
        let thrust_n = maths::hypot(weight_n, drag_n) * (1.0 + blocked);
        let lean = maths::atan2(drag_n, weight_n);
        let area_m2 = drive.disc_area_m2();
        let hover_m_s = (thrust_n / (2.0 * self.density * area_m2)).sqrt();
        let (across, through) = (speed_m_s * maths::cos(lean), speed_m_s * maths::sin(lean));
        let mut induced_m_s = hover_m_s;
        for _ in 0..ROUNDS {
            let flow = maths::hypot(across, through + induced_m_s);
            induced_m_s += 0.5 * (thrust_n / (2.0 * self.density * area_m2 * flow) - induced_m_s);
        }
        let one = drive.turning(thrust_n / drive.motors(), self.density);
        let shaft_w = one.shaft_w * drive.motors();
        let profile_w = (shaft_w - INDUCED * thrust_n * hover_m_s).max(0.1 * shaft_w);
        let turns_s = one.rpm / 60.0;
        let advance = across / (std::f64::consts::PI * turns_s * drive.diameter_m());
        let rotor_w = INDUCED * thrust_n * ((1.0 - SAVED) * hover_m_s + SAVED * induced_m_s)
            + profile_w * (1.0 + PROFILE * advance * advance)
            + drag_n * speed_m_s;
        // Motors and controllers have the efficiency of the hover.
        let efficiency =
            self.hover.shaft_w * drive.motors() / (self.hover_power_w - self.electronics_w);
        Level {
            power_w: rotor_w / efficiency + self.electronics_w,
            lean_deg: lean.to_degrees(),
        }
    }
}
