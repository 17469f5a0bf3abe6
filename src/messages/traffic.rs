//! `ADSB_VEHICLE`: other aircraft that a vehicle's receiver hears.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{ADSB_VEHICLE_DATA, AdsbFlags};

use crate::geo::{LatLon, maths};
use crate::notice::sanitised;
use crate::vehicle::{Aircraft, Vehicle};

/// The component of an ADS-B receiver that sends its own reports, not through the autopilot
/// (`MAV_COMP_ID_ADSB`).
pub(super) const RECEIVER: u8 = 156;

/// Notes an aircraft, if its report has a place and a height.
pub(super) fn apply(vehicle: &mut Vehicle, data: &ADSB_VEHICLE_DATA, now: Duration) {
    let has = |flags| data.flags.contains(flags);
    let is_placed = has(AdsbFlags::ADSB_FLAGS_VALID_COORDS)
        && has(AdsbFlags::ADSB_FLAGS_VALID_ALTITUDE)
        && data.lat.abs() <= 900_000_000
        && data.lon.abs() <= 1_800_000_000
        && data.altitude != i32::MAX;
    if !is_placed {
        return;
    }
    let is_moving =
        has(AdsbFlags::ADSB_FLAGS_VALID_HEADING) && has(AdsbFlags::ADSB_FLAGS_VALID_VELOCITY);
    let velocity = is_moving.then(|| {
        let course = f64::from(data.heading) / 100.0;
        let speed_m_s = f64::from(data.hor_velocity) / 100.0;
        let (sin, cos) = maths::sin_cos(course.to_radians());
        [speed_m_s * cos, speed_m_s * sin]
    });
    let climbs = has(AdsbFlags::ADSB_FLAGS_VERTICAL_VELOCITY_VALID);
    let callsign = if has(AdsbFlags::ADSB_FLAGS_VALID_CALLSIGN) {
        sanitised(data.callsign.to_str().unwrap_or_default())
    } else {
        String::new()
    };
    let aircraft = Aircraft {
        icao: Some(data.ICAO_address),
        callsign: callsign.trim().to_owned(),
        at_point: LatLon::new(f64::from(data.lat) / 1e7, f64::from(data.lon) / 1e7),
        altitude_amsl_m: f64::from(data.altitude) / 1000.0,
        velocity_m_s: velocity,
        climb_m_s: climbs.then(|| f64::from(data.ver_velocity) / 100.0),
        at: now.saturating_sub(Duration::from_secs(data.tslc.into())),
    };
    vehicle.traffic.note(data.ICAO_address, aircraft);
}
