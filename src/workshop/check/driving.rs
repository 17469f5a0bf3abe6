//! Problems of a ground robot or boat.

use super::{FindingKind, PackFindings, tenths};
use crate::text;
use crate::workshop::design::Design;
use crate::workshop::driving::DriveFigures;
use crate::workshop::part::PartSlot;
use crate::workshop::surface::SurfaceDrive;

/// A slower vehicle hardly moves, in m/s.
const SLOWEST_M_S: f64 = 0.2;
/// The slope that a robot on open ground should climb, in degrees.
const GOOD_SLOPE_DEG: f64 = 10.0;

impl PackFindings {
    /// Checks that the drive takes the battery, the chassis or hull carries the vehicle, and the battery lasts.
    pub(super) fn drives(&mut self, design: &Design, figures: &DriveFigures) {
        let Some(drive) = design.surface_drive() else {
            return;
        };
        self.drive_cells(&drive);
        if figures.spare_kg < 0.0 {
            let text = text!(
                "finding-overload",
                mass = tenths(figures.mass_kg),
                most = tenths(drive.max_mass_kg())
            );
            self.add(FindingKind::Overload, PartSlot::Frame, text);
        }
        self.moves(figures, &drive);
        self.drive_current(figures);
    }

    fn drive_cells(&mut self, drive: &SurfaceDrive) {
        let (fewest, most) = drive.cells();
        let cells = drive.battery.cells;
        if !(fewest..=most).contains(&cells) {
            let text = text!(
                "finding-motor-cells",
                cells = u32::from(cells),
                fewest = u32::from(fewest),
                most = u32::from(most)
            );
            self.add(FindingKind::MotorCells, PartSlot::Battery, text);
        }
    }

    fn moves(&mut self, figures: &DriveFigures, drive: &SurfaceDrive) {
        if figures.top_speed_m_s < SLOWEST_M_S {
            let text = text!(
                "finding-stuck",
                pull = tenths(figures.pull_n),
                needed = tenths(drive.resistance_n(SLOWEST_M_S))
            );
            self.add(FindingKind::Stuck, PartSlot::Motor, text);
        } else if let Some(slope_deg) = figures.slope_deg.filter(|it| *it < GOOD_SLOPE_DEG) {
            let text = text!(
                "finding-slope",
                slope = slope_deg.round() as i64,
                good = GOOD_SLOPE_DEG as i64
            );
            self.add(FindingKind::Slope, PartSlot::Motor, text);
        }
    }

    fn drive_current(&mut self, figures: &DriveFigures) {
        let most_a = figures.max_current_a;
        if figures.peak_current_a > 0.95 * most_a {
            let text = text!("finding-peak-current", most = tenths(most_a));
            self.add(FindingKind::PeakCurrent, PartSlot::Battery, text);
        }
    }
}
