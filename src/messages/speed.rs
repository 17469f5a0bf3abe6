//! `VFR_HUD` and WIND: speeds, climb, throttle and wind.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{VFR_HUD_DATA, WIND_DATA};

use super::attitude::heading_deg;
use crate::vehicle::{Hud, Vehicle, Wind};

/// Applies `VFR_HUD`; a message with NaN changes nothing.
pub(super) fn apply_hud(vehicle: &mut Vehicle, data: &VFR_HUD_DATA, now: Duration) {
    let parts = [data.airspeed, data.groundspeed, data.alt, data.climb];
    if !parts.iter().all(|part| part.is_finite()) {
        return;
    }
    vehicle.hud = Some(Hud {
        airspeed_m_s: data.airspeed,
        ground_speed_m_s: data.groundspeed,
        climb_m_s: data.climb,
        altitude_amsl_m: data.alt,
        throttle_percent: data.throttle.min(100),
        heading_deg: heading_deg(f32::from(data.heading)),
        at: now,
    });
}

/// Applies WIND; a message with NaN changes nothing.
pub(super) fn apply_wind(vehicle: &mut Vehicle, data: &WIND_DATA) {
    if data.direction.is_finite() && data.speed.is_finite() {
        vehicle.wind = Some(Wind {
            from_deg: heading_deg(data.direction),
            speed_m_s: data.speed,
        });
        if vehicle.airborne() {
            vehicle.wind_height_m = vehicle.altitude_m().map(|metres| metres as f32);
        }
    }
}
