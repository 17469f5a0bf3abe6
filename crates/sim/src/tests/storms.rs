//! Wind that the allowed lean cannot hold, beside the real `ArduCopter`.

use super::flight::close;
use super::*;

/// Hovers 20 m high in 20 m/s from the east for 20 s, then in calm air for 25 s; returns the drift in m/s and the place
/// east of the start at the end.
fn storm(ground: &mut Ground) -> (f64, f64) {
    ground.set("SIM_WIND_DIR", 90.0);
    ground.set("SIM_WIND_SPD", 20.0);
    ground.run(20.0);
    let drift_m_s = ground.truth().velocity_ned_m_s[1];
    ground.set("SIM_WIND_SPD", 0.0);
    ground.run(25.0);
    (drift_m_s, ground.truth().position_ned_m[1])
}

#[test]
fn after_a_storm_a_takeoff_is_held_downwind_and_a_place_is_flown_to_again() {
    let mut ground = Ground::hovering(20.0);
    let (drift_m_s, east_m) = storm(&mut ground);
    close("drift in 20 m/s of wind", drift_m_s, -1.27, 0.1);
    assert!(
        (east_m + 5.0).abs() < 1.5,
        "the real one holds -5.0 m: {east_m}"
    );

    let mut ground = Ground::hovering(20.0);
    ground.goto([5.0, 0.0, -20.0]);
    ground.run(8.0);
    let (drift_m_s, east_m) = storm(&mut ground);
    close("drift in 20 m/s of wind", drift_m_s, -1.28, 0.1);
    assert!(
        east_m.abs() < 0.5,
        "the real one returns to 0.0 m: {east_m}"
    );
}
