//! Positions on the earth and in the local north-east-down frame.
//!
//! Metres are converted to degrees with the WGS-84 radii of curvature at the reference latitude. Within 1 km of the
//! reference the error is below 0.2 m, far below the error of a GPS fix; ArduPilot's own spherical scale is 0.67 %
//! off (6.7 m at 1 km).

#![warn(missing_docs)]

use serde::{Deserialize, Serialize};

pub mod maths;
mod outline;
mod terrain;
mod viewport;

pub use outline::Outline;
pub use terrain::{Square, Terrain, WrongSize};
pub use viewport::{DOTS_ACROSS, DOTS_DOWN, Dot, Extent, GridSize, Viewport, Zoom, scale_bar};

/// WGS-84 semi-major axis, in metres.
const SEMI_MAJOR_AXIS_M: f64 = 6_378_137.0;
/// WGS-84 first eccentricity squared.
const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_14e-3;

/// Metres per degree along the equator, for offsets in degrees such as `SIM_GPS1_GLTCH_X`.
pub const METRES_PER_DEGREE: f64 = 111_319.49;

/// A point on the ellipsoid, in degrees.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LatLon {
    /// Latitude, -90 to 90, north positive.
    pub lat_deg: f64,
    /// Longitude, -180 to 180, east positive.
    pub lon_deg: f64,
}

impl LatLon {
    /// A point from its latitude and longitude in degrees.
    pub const fn new(lat_deg: f64, lon_deg: f64) -> Self {
        Self { lat_deg, lon_deg }
    }

    /// A point from MAVLink's integers (degrees times 1e7).
    pub fn from_e7(lat_e7: i32, lon_e7: i32) -> Self {
        Self::new(f64::from(lat_e7) * 1e-7, f64::from(lon_e7) * 1e-7)
    }

    /// MAVLink's integers (degrees times 1e7), latitude first.
    pub fn to_e7(self) -> (i32, i32) {
        (
            (self.lat_deg * 1e7).round() as i32,
            (self.lon_deg * 1e7).round() as i32,
        )
    }

    /// True when both angles are finite and within their ranges.
    pub fn is_valid(self) -> bool {
        self.lat_deg.abs() <= 90.0 && self.lon_deg.abs() <= 180.0
    }

    /// Metres north and east from `self` to `other`.
    pub fn offset_to(self, other: Self) -> (f64, f64) {
        LocalFrame::at(self).offset_to(other)
    }

    /// The point `north_m` and `east_m` metres away.
    #[must_use]
    pub fn moved(self, north_m: f64, east_m: f64) -> Self {
        let (north_m_per_deg, east_m_per_deg) = self.metres_per_degree();
        let lon = self.lon_deg + east_m / east_m_per_deg;
        Self::new(
            self.lat_deg + north_m / north_m_per_deg,
            (lon + 180.0).rem_euclid(360.0) - 180.0,
        )
    }

    /// Horizontal distance in metres.
    pub fn distance_m(self, other: Self) -> f64 {
        LocalFrame::at(self).distance_m(other)
    }

    /// Bearing towards `other`, 0 to 360 degrees clockwise from north.
    pub fn bearing_deg(self, other: Self) -> f64 {
        let (north, east) = self.offset_to(other);
        wrap_360(maths::atan2(east, north).to_degrees())
    }

    /// Metres per degree of latitude and of longitude at this point.
    fn metres_per_degree(self) -> (f64, f64) {
        let lat = self.lat_deg.clamp(-89.9, 89.9).to_radians();
        let w2 = 1.0 - ECCENTRICITY_SQUARED * maths::powi(maths::sin(lat), 2);
        let meridian_m = SEMI_MAJOR_AXIS_M * (1.0 - ECCENTRICITY_SQUARED) / maths::powf(w2, 1.5);
        let parallel_m = SEMI_MAJOR_AXIS_M / w2.sqrt() * maths::cos(lat);
        (meridian_m.to_radians(), parallel_m.to_radians())
    }
}

/// The local frame of a place: metres north and east of it. For many offsets from the same place, it saves most of the
/// arithmetic of [`LatLon::offset_to`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalFrame {
    origin: LatLon,
    north_m_per_deg: f64,
    east_m_per_deg: f64,
}

impl LocalFrame {
    /// The local frame of a place.
    pub fn at(origin: LatLon) -> Self {
        let (north_m_per_deg, east_m_per_deg) = origin.metres_per_degree();
        Self {
            origin,
            north_m_per_deg,
            east_m_per_deg,
        }
    }

    /// The place that is zero metres north and east.
    pub fn origin(&self) -> LatLon {
        self.origin
    }

    /// Metres north and east from the origin to a place.
    pub fn offset_to(&self, place: LatLon) -> (f64, f64) {
        let mut delta_lon = place.lon_deg - self.origin.lon_deg;
        if delta_lon > 180.0 {
            delta_lon -= 360.0;
        } else if delta_lon < -180.0 {
            delta_lon += 360.0;
        }
        (
            (place.lat_deg - self.origin.lat_deg) * self.north_m_per_deg,
            delta_lon * self.east_m_per_deg,
        )
    }

    /// Horizontal distance from the origin to a place, in metres.
    pub fn distance_m(&self, place: LatLon) -> f64 {
        let (north, east) = self.offset_to(place);
        maths::hypot(north, east)
    }
}

/// An angle wrapped into the range from 0 (inclusive) to 360 (exclusive) degrees.
pub fn wrap_360(angle_deg: f64) -> f64 {
    let wrapped = angle_deg.rem_euclid(360.0);
    // rem_euclid of a tiny negative number rounds up to 360 itself.
    if wrapped >= 360.0 { 0.0 } else { wrapped }
}

/// An angle wrapped into the range from -180 (exclusive) to 180 (inclusive) degrees.
pub fn wrap_180(angle_deg: f64) -> f64 {
    let wrapped = wrap_360(angle_deg);
    if wrapped > 180.0 {
        wrapped - 360.0
    } else {
        wrapped
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn moving_and_measuring_agree(lat in -80.0..80.0f64, lon in -180.0..180.0f64,
                                      north in -2000.0..2000.0f64, east in -2000.0..2000.0f64) {
            let start = LatLon::new(lat, lon);
            let (n, e) = start.offset_to(start.moved(north, east));
            prop_assert!((n - north).abs() < 1e-6 && (e - east).abs() < 1e-6);
        }

        #[test]
        fn wrapped_angles_stay_in_range(angle in -1e6..1e6f64) {
            prop_assert!((0.0..360.0).contains(&wrap_360(angle)));
            let signed = wrap_180(angle);
            prop_assert!(signed > -180.0 && signed <= 180.0);
        }
    }

    /// One degree of latitude at 45 degrees is 111.1317 km, one of longitude 78.8468 km
    /// (WGS-84; NGA.STND.0036, radii of curvature).
    #[test]
    fn a_degree_has_its_published_length() {
        let here = LatLon::new(45.0, 10.0);
        let (n, e) = here.offset_to(LatLon::new(46.0, 11.0));
        assert!((n - 111_131.7).abs() < 1.0, "{n}");
        assert!((e - 78_846.8).abs() < 1.0, "{e}");
    }

    #[test]
    fn bearings_run_clockwise_from_north() {
        let here = LatLon::new(50.0, 30.0);
        assert!((here.bearing_deg(here.moved(0.0, 100.0)) - 90.0).abs() < 1e-6);
        assert!((here.bearing_deg(here.moved(-100.0, 0.0)) - 180.0).abs() < 1e-6);
    }
}
