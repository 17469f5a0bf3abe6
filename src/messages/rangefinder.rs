//! Distance to the ground.

use mavlink::dialects::ardupilotmega::{
    DISTANCE_SENSOR_DATA, MavSensorOrientation, RANGEFINDER_DATA,
};

use crate::vehicle::Vehicle;

/// `DISTANCE_SENSOR.signal_quality` of an invalid reading.
const SIGNAL_INVALID: u8 = 1;

pub(super) fn apply(vehicle: &mut Vehicle, data: &RANGEFINDER_DATA) {
    vehicle.rangefinder_m = data.distance.is_finite().then_some(data.distance);
}

/// Applies `DISTANCE_SENSOR` of a sensor that faces down; nothing in range means unknown.
pub(super) fn apply_sensor(vehicle: &mut Vehicle, data: &DISTANCE_SENSOR_DATA) {
    if data.orientation != MavSensorOrientation::MAV_SENSOR_ROTATION_PITCH_270 {
        return;
    }
    let in_range = (data.min_distance..=data.max_distance).contains(&data.current_distance);
    vehicle.rangefinder_m = (in_range && data.signal_quality != SIGNAL_INVALID)
        .then(|| f32::from(data.current_distance) * 0.01);
}
