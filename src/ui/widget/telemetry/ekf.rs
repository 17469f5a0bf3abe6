//! The telemetry line of the EKF.

use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{EkfFlags, Grade, Vehicle};

/// All test ratios while they are good; otherwise the fault, and the worst ratios.
pub fn text(vehicle: &Vehicle) -> Text {
    let Some(ekf) = vehicle.ekf else {
        return Text::default();
    };
    let position = EkfFlags::POSITION_HORIZONTAL_ABSOLUTE;
    let state = match Grade::of_ekf(&ekf) {
        _ if vehicle.link.lost => text!("vehicle-grade-old"),
        _ if !ekf.flags.has(position) => text!("telemetry-ekf-lost"),
        Grade::Good => text!("telemetry-ekf-ok"),
        Grade::Poor => text!("vehicle-grade-poor"),
        Grade::Bad => text!("vehicle-grade-bad"),
    };
    let mut ratios = vec![
        ("vel", ekf.velocity_variance),
        ("pos", ekf.position_horizontal_variance),
        ("mag", ekf.compass_variance),
    ];
    if Grade::of_ekf(&ekf) != Grade::Good || vehicle.link.lost {
        ratios.sort_by(|a, b| badness(b.1).total_cmp(&badness(a.1)));
        ratios.truncate(1);
    }
    let figures: Vec<String> = ratios
        .iter()
        .map(|(name, ratio)| format!("{name} {}", figure(*ratio, 2)))
        .collect();
    Text::joined("  ", vec![state, figures.join(" ").into()])
}

/// A ratio for comparison: an unknown one counts as the worst.
fn badness(ratio: f32) -> f32 {
    if ratio >= 0.0 { ratio } else { f32::INFINITY }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::text::{Language, Locale};
    use crate::vehicle::Ekf;

    /// The width of a value beside its label in the narrowest pane, in columns.
    const ROOM: usize = 31;

    #[test]
    fn the_row_of_the_ekf_is_never_cut() {
        let position = EkfFlags::POSITION_HORIZONTAL_ABSOLUTE;
        for language in Language::ALL {
            let locale = Locale::new(language);
            for (ratio, flags, is_lost) in [
                (0.05, position, false),
                (0.6, position, false),
                (123.456, position, false),
                (123.456, 0, false),
                (123.456, position, true),
            ] {
                let mut vehicle = Vehicle::new(1, 1);
                vehicle.link.lost = is_lost;
                vehicle.ekf = Some(Ekf {
                    flags: EkfFlags(flags),
                    velocity_variance: ratio,
                    position_horizontal_variance: ratio,
                    compass_variance: ratio,
                    position_vertical_variance: ratio,
                    at: Duration::ZERO,
                });
                let words = locale.text(&text(&vehicle));
                assert!(words.chars().count() <= ROOM, "{words}");
            }
        }
    }
}
