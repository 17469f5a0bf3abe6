//! The figures of a ground robot or boat.

use serde::Serialize;

use super::air::Air;
use super::design::Design;
use super::pack::Pack;
use super::surface::SurfaceDrive;
use crate::text::rounded;

/// The charge, in percent, at which forces and speeds are stated: that in the middle of a drive.
const MIDDLE_CHARGE: f64 = 60.0;
/// The cruise speed as a share of the top speed.
const CRUISE_SHARE: f64 = 0.6;
const CURVE_STEPS: u32 = 20;

/// The figures of a complete ground robot or boat, on short grass or calm water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DriveFigures {
    /// The mass ready to drive, in kilograms.
    pub mass_kg: f64,
    /// The price of all parts, in credits.
    pub credits: u32,
    /// The greatest pull of the wheels or thrust of the thrusters from a standstill at 60 % charge, in newtons.
    pub pull_n: f64,
    /// The resistance at cruise speed, in newtons.
    pub resistance_n: f64,
    /// 60 % of the top speed, in m/s.
    pub cruise_speed_m_s: f64,
    /// Power from the battery at cruise speed, with electronics and payload, in watts.
    pub cruise_power_w: f64,
    /// Current at cruise speed at 60 % charge, in amperes.
    pub cruise_current_a: f64,
    /// The time at cruise speed with the usable part of the charge, in seconds.
    pub drive_time_s: f64,
    /// The same until 80 % of the charge is used.
    pub drive_80_s: f64,
    /// The distance at cruise speed with the usable part of the charge, in metres.
    pub range_m: f64,
    /// The fastest steady speed on level ground or calm water at 60 % charge, in m/s.
    pub top_speed_m_s: f64,
    /// The radius of the tightest turn, in metres; 0 for a vehicle that turns on the spot.
    pub turning_radius_m: f64,
    /// The steepest slope that it climbs, in degrees; `None` on water.
    pub slope_deg: Option<f64>,
    /// Battery capacity, in ampere hours.
    pub capacity_ah: f64,
    /// Nominal energy of the battery, in watt hours.
    pub energy_wh: f64,
    /// The battery's continuous current limit, in amperes.
    pub max_current_a: f64,
    /// The current of the greatest pull from a standstill and at top speed, whichever is larger, in amperes.
    pub peak_current_a: f64,
    /// The mass that can be added until the chassis or hull carries no more, in kilograms; negative if it is too heavy.
    pub spare_kg: f64,
}

impl Design {
    /// The figures of a ground robot or boat; `None` while parts of the drive are missing, and for a drone.
    pub fn drive_figures(&self, air: Air) -> Option<DriveFigures> {
        let drive = self.surface_drive()?;
        let pack = Pack::of_cells(drive.battery, drive.packs, air.battery_c);
        let top_speed_m_s = drive.top_speed_m_s(&pack, MIDDLE_CHARGE);
        let cruise_speed_m_s = rounded(CRUISE_SHARE * top_speed_m_s, 2);
        let cruise_power_w = drive.steady_w(cruise_speed_m_s);
        let pull_n = drive.max_force_n(&pack, MIDDLE_CHARGE, 0.0);
        let amperes = |power_w| {
            let loaded = pack.loaded(MIDDLE_CHARGE, power_w);
            loaded.map_or(f64::INFINITY, |loaded| loaded.amperes)
        };
        // A vehicle that cannot move does not drive for any time.
        let moves = cruise_speed_m_s > 0.0;
        let lasts_s = |share| {
            let lasts = moves.then(|| pack.lasts(cruise_power_w, share, 0.0).0);
            lasts.unwrap_or_default()
        };
        let drive_time_s = lasts_s(pack.usable);
        Some(DriveFigures {
            mass_kg: drive.mass_kg,
            credits: self.credits(),
            pull_n,
            resistance_n: drive.resistance_n(cruise_speed_m_s),
            cruise_speed_m_s,
            cruise_power_w,
            cruise_current_a: amperes(cruise_power_w),
            drive_time_s,
            drive_80_s: lasts_s(0.8),
            range_m: drive_time_s * cruise_speed_m_s,
            top_speed_m_s,
            turning_radius_m: drive.turning_radius_m(),
            slope_deg: drive.climbs().then(|| drive.slope_deg(pull_n)),
            capacity_ah: pack.capacity_ah,
            energy_wh: pack.energy_wh(),
            max_current_a: pack.max_current_a,
            peak_current_a: amperes(drive.power_w(pull_n, 0.0))
                .max(amperes(drive.steady_w(top_speed_m_s))),
            spare_kg: drive.max_mass_kg() - drive.mass_kg,
        })
    }

    /// The power at each steady speed from 0 to the top speed, in watts and m/s; empty while parts of the drive are
    /// missing.
    pub(super) fn drive_polar(&self, air: Air) -> Vec<(f64, f64)> {
        let Some(drive) = self.surface_drive() else {
            return Vec::new();
        };
        let pack = Pack::of_cells(drive.battery, drive.packs, air.battery_c);
        let top_m_s = drive.top_speed_m_s(&pack, MIDDLE_CHARGE);
        steps(top_m_s)
            .map(|speed| (speed, drive.steady_w(speed)))
            .collect()
    }

    /// Driving time in seconds at cruise speed by added payload in kilograms, up to what the chassis or hull carries.
    pub(super) fn drive_time_by_payload(&self, air: Air) -> Vec<(f64, f64)> {
        let (Some(drive), Some(figures)) = (self.surface_drive(), self.drive_figures(air)) else {
            return Vec::new();
        };
        let pack = Pack::of_cells(drive.battery, drive.packs, air.battery_c);
        let lasts_s = |drive: SurfaceDrive| {
            let power_w = drive.steady_w(figures.cruise_speed_m_s);
            pack.lasts(power_w, pack.usable, 0.0).0
        };
        steps(figures.spare_kg.max(0.0))
            .map(|added_kg| (added_kg, lasts_s(drive.laden(added_kg))))
            .collect()
    }
}

impl DriveFigures {
    /// The maximum distance out and back at cruise speed, in metres.
    pub fn radius_m(&self) -> f64 {
        0.5 * self.range_m
    }
}

fn steps(most: f64) -> impl Iterator<Item = f64> {
    (0..=CURVE_STEPS).map(move |step| most * f64::from(step) / f64::from(CURVE_STEPS))
}
