//! ATTITUDE: the vehicle's roll, pitch and yaw.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::ATTITUDE_DATA;

use crate::geo::wrap_360;
use crate::vehicle::{Attitude, Vehicle};

/// Applies ATTITUDE; a message with NaN changes nothing.
pub(super) fn apply(vehicle: &mut Vehicle, data: &ATTITUDE_DATA, now: Duration) {
    let [roll_deg, pitch_deg, yaw_deg] = [data.roll, data.pitch, data.yaw].map(f32::to_degrees);
    if roll_deg.is_finite() && pitch_deg.is_finite() && yaw_deg.is_finite() {
        vehicle.attitude = Some(Attitude {
            roll_deg,
            pitch_deg,
            yaw_deg: heading_deg(yaw_deg),
            at: now,
        });
    }
}

/// An angle as a heading from 0 (included) to 360 (excluded) degrees.
pub(super) fn heading_deg(angle_deg: f32) -> f32 {
    let wrapped = wrap_360(f64::from(angle_deg)) as f32;
    // Rounding to a narrower type may give 360 itself.
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
