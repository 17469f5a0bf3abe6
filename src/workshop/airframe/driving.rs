//! The airframe of a ground robot or boat.

use super::{Airframe, AirframeBuild, battery_limits};
use crate::sim::RunningGear;
use crate::text::rounded;
use crate::workshop::air::Air;
use crate::workshop::design::Design;
use crate::workshop::driving::DriveFigures;
use crate::workshop::pack::Pack;
use crate::workshop::surface::SurfaceDrive;

/// The acceleration on a path, as a share of the greatest one, and its limit: that of `ArduRover`'s defaults.
const ACCEL_SHARE: f64 = 0.7;
const PATH_ACCEL_M_S2: f64 = 1.0;
/// The greatest acceleration of any vehicle: faster ones are limited by their controllers.
const MOST_ACCEL_M_S2: f64 = 10.0;
/// The turn rate towards a waypoint, as a share of the fastest one, and its limit: that of `ArduRover`'s defaults.
const PIVOT_SHARE: f64 = 0.6;
const PIVOT_DEG_S: f64 = 60.0;

impl Design {
    pub(super) fn driving_airframe(&self) -> Option<Airframe> {
        let drive = self.surface_drive()?;
        // A vehicle that cannot move has no gear to simulate.
        let figures = self.drive_figures(Air::default());
        let figures = figures.filter(|it| it.cruise_speed_m_s > 0.0)?;
        let pack = Pack::of_cells(drive.battery, drive.packs, Air::default().battery_c);
        let gear = self.gear(&drive, &figures, &pack);
        Some(Airframe {
            model: self.vehicle_kind().name(),
            parameters: parameters(&drive, &gear, &pack),
            build: AirframeBuild::Gear(gear),
        })
    }

    fn gear(&self, drive: &SurfaceDrive, figures: &DriveFigures, pack: &Pack) -> RunningGear {
        let gained_n = figures.pull_n - drive.resistance_n(0.0);
        let half_m_s = 0.5 * figures.top_speed_m_s;
        let at_half_n = drive.resistance_n(half_m_s);
        // Twice the resistance at half the top speed: the power that this needs beyond steady driving.
        let more_w = drive.power_w(2.0 * at_half_n, half_m_s) - drive.steady_w(half_m_s);
        RunningGear {
            mass_kg: figures.mass_kg,
            length_m: drive.length_m(),
            top_speed_m_s: figures.top_speed_m_s,
            cruise_speed_m_s: figures.cruise_speed_m_s,
            cruise_current_a: figures.cruise_current_a,
            accel_m_s2: (gained_n / figures.mass_kg).clamp(0.05, MOST_ACCEL_M_S2),
            turning_radius_m: figures.turning_radius_m,
            turn_rate_deg_s: drive.turn_rate_deg_s(figures.top_speed_m_s),
            power_w: self.drive_polar(Air::default()),
            efficiency: (at_half_n * half_m_s / more_w).clamp(0.05, 1.0),
            full_voltage_v: pack.full_v(),
            battery_capacity_ah: pack.capacity_ah,
            battery_resistance_ohm: pack.resistance_ohm,
        }
    }
}

/// Battery limits of its chemistry, the speed on paths, and the turns that the vehicle makes.
fn parameters(drive: &SurfaceDrive, gear: &RunningGear, pack: &Pack) -> Vec<(&'static str, f64)> {
    let mut all = battery_limits(drive.battery, pack).to_vec();
    let cruise_m_s = gear.cruise_speed_m_s;
    all.extend([
        // Return with a low battery, and stop with a critical one.
        ("BATT_FS_LOW_ACT", 1.0),
        ("BATT_FS_CRT_ACT", 2.0),
        ("CRUISE_SPEED", cruise_m_s),
        ("WP_SPEED", cruise_m_s),
        ("SPEED_MAX", rounded(gear.top_speed_m_s, 2)),
        (
            "ATC_ACCEL_MAX",
            rounded((ACCEL_SHARE * gear.accel_m_s2).min(PATH_ACCEL_M_S2), 2),
        ),
    ]);
    if gear.turn_rate_deg_s > 0.0 {
        let rate = (PIVOT_SHARE * gear.turn_rate_deg_s).min(PIVOT_DEG_S);
        all.push(("WP_PIVOT_RATE", rate.round()));
    } else {
        all.push(("TURN_RADIUS", gear.turning_radius_m));
    }
    all
}
