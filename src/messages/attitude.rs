//! ATTITUDE.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::ATTITUDE_DATA;

use crate::geo::wrap_360;
use crate::vehicle::{Attitude, Vehicle};

/// Applies ATTITUDE; one without numbers in it changes nothing.
pub(super) fn apply(vehicle: &mut Vehicle, data: &ATTITUDE_DATA, now: Duration) {
    if !(data.roll.is_finite() && data.pitch.is_finite() && data.yaw.is_finite()) {
        return;
    }
    vehicle.attitude = Some(Attitude {
        roll_deg: data.roll.to_degrees(),
        pitch_deg: data.pitch.to_degrees(),
        yaw_deg: heading_deg(data.yaw.to_degrees()),
        at: now,
    });
}

/// A heading within 0 (included) to 360 (excluded) degrees.
pub(super) fn heading_deg(angle_deg: f32) -> f32 {
    let wrapped = wrap_360(f64::from(angle_deg)) as f32;
    // Narrowing may round up to 360 itself.
    if wrapped >= 360.0 { 0.0 } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_stay_below_360() {
        for (angle_deg, expected_deg) in [
            (-90.0, 270.0),
            (0.0, 0.0),
            (-1e-9, 0.0),
            (360.0, 0.0),
            (450.0, 90.0),
        ] {
            assert!(
                (heading_deg(angle_deg) - expected_deg).abs() < 1e-4,
                "{angle_deg}"
            );
        }
    }
}
