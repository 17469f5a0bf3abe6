//! The vehicle's position, and the origins of its coordinates.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    GLOBAL_POSITION_INT_DATA, GPS_GLOBAL_ORIGIN_DATA, HOME_POSITION_DATA, LOCAL_POSITION_NED_DATA,
};

use super::attitude::heading_deg;
use crate::geo::LatLon;
use crate::vehicle::{GlobalPosition, LegSpeed, LocalPosition, Place, PositionJump, Vehicle};

/// The distance between two positions that a correction of the estimate may explain.
const JUMP_M: f64 = 200.0;
/// No vehicle is faster.
const FASTEST_M_S: f64 = 200.0;
/// A point this close to 0, 0, in latitude and in longitude (0.01° in units of 1e-7°), is not known. Before the first
/// fix, `ArduPlane` with an airspeed sensor integrates its airspeed from there.
const NOWHERE_E7: u32 = 100_000;

/// Applies `GLOBAL_POSITION_INT`. A point at 0, 0 means an unknown position from `ArduPilot`; so does a height at an end
/// of the range.
pub(super) fn apply_global(vehicle: &mut Vehicle, data: &GLOBAL_POSITION_INT_DATA, now: Duration) {
    let is_height = |height_mm| !matches!(height_mm, i32::MIN | i32::MAX);
    let has_heights = is_height(data.alt) && is_height(data.relative_alt);
    let place = point(data.lat, data.lon).filter(|_| has_heights);
    let position = place.map(|at_point| GlobalPosition {
        at_point,
        altitude_amsl_m: f64::from(data.alt) * 1e-3,
        altitude_m: f64::from(data.relative_alt) * 1e-3,
        north_m_s: f32::from(data.vx) * 0.01,
        east_m_s: f32::from(data.vy) * 0.01,
        down_m_s: f32::from(data.vz) * 0.01,
        heading_deg: (data.hdg != u16::MAX).then(|| heading_deg(f32::from(data.hdg) * 0.01)),
        at: now,
    });
    let before = std::mem::replace(&mut vehicle.global, position);
    vehicle.jump = before.zip(position).and_then(jump).or(vehicle.jump);
    if let Some(position) = position {
        vehicle.note_speed(position.speed_m_s());
    }
    if let Some(position) = position
        && vehicle.flies_plan()
        && vehicle.is_under_way()
    {
        let at = Duration::from_millis(data.time_boot_ms.into());
        vehicle.cruise = LegSpeed::after(vehicle.cruise, position.ground_speed_m_s(), at);
        vehicle.note_arrival(at);
    }
}

/// The jump between two positions that no flight explains.
fn jump((before, now): (GlobalPosition, GlobalPosition)) -> Option<PositionJump> {
    let passed_s = now.at.saturating_sub(before.at).as_secs_f64();
    let distance_m = before.at_point.distance_m(now.at_point);
    (distance_m > JUMP_M + FASTEST_M_S * passed_s).then_some(PositionJump {
        distance_m,
        at: now.at,
    })
}

/// Applies `LOCAL_POSITION_NED`; a message with NaN changes nothing.
pub(super) fn apply_local(vehicle: &mut Vehicle, data: &LOCAL_POSITION_NED_DATA, now: Duration) {
    let ned_m = [data.x, data.y, data.z];
    let velocity_m_s = [data.vx, data.vy, data.vz];
    if ned_m
        .iter()
        .chain(&velocity_m_s)
        .all(|value| value.is_finite())
    {
        vehicle.local = Some(LocalPosition {
            ned_m,
            velocity_m_s,
            at: now,
        });
    }
}

pub(super) fn apply_home(vehicle: &mut Vehicle, data: &HOME_POSITION_DATA) {
    vehicle.home = place(data.latitude, data.longitude, data.altitude);
}

/// The origin of local coordinates; `None` if its position is not valid.
pub(super) fn origin(data: &GPS_GLOBAL_ORIGIN_DATA) -> Option<Place> {
    place(data.latitude, data.longitude, data.altitude)
}

/// A valid point: on the earth, and not at 0, 0.
pub(super) fn point(lat_e7: i32, lon_e7: i32) -> Option<LatLon> {
    let at_point = LatLon::from_e7(lat_e7, lon_e7);
    let is_nowhere = lat_e7.unsigned_abs().max(lon_e7.unsigned_abs()) < NOWHERE_E7;
    (!is_nowhere && at_point.is_valid()).then_some(at_point)
}

fn place(lat_e7: i32, lon_e7: i32, altitude_mm: i32) -> Option<Place> {
    point(lat_e7, lon_e7).map(|at_point| Place {
        at_point,
        altitude_amsl_m: f64::from(altitude_mm) * 1e-3,
    })
}
