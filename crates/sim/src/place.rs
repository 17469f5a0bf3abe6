//! Places on the earth, the corresponding points in metres from the start, and the references of heights.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{GPS_GLOBAL_ORIGIN_DATA, HOME_POSITION_DATA, MavMessage};

use super::Start;
use super::frame::HeightOrigin;
use sortie_geo::LatLon;

/// Home lies at most this far above or below the origin, in metres.
const HOME_HEIGHT_MAX_M: f64 = 50_000.0;

/// A place with its altitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) at: LatLon,
    pub(super) altitude_amsl_m: f64,
}

/// The altitude above sea level of a height in a global frame (`MAV_FRAME`); `None` for a frame that the vehicle does
/// not support. `home_m` is home relative to the start, with z downwards. Without terrain data the ground counts as
/// level with the start.
pub(super) fn altitude_amsl_m(
    frame: u8,
    height_m: f64,
    start: &Start,
    home_m: DVec3,
) -> Option<f64> {
    Some(match HeightOrigin::of(frame)? {
        HeightOrigin::Sea => height_m,
        HeightOrigin::Home => start.altitude_amsl_m - home_m.z + height_m,
        HeightOrigin::Terrain => start.altitude_amsl_m + height_m,
    })
}

/// The origin of a vehicle's north-east-down frame, and its home.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LocalDatum {
    pub(super) start: Start,
    home: Option<Place>,
    /// Home as a point, computed once because every step needs it.
    home_m: DVec3,
    /// Whether a ground station has set home: arming then leaves it where it is.
    home_locked: bool,
}

impl LocalDatum {
    /// The origin at a start, without a home.
    pub(super) fn at(start: Start) -> Self {
        Self {
            start,
            home: None,
            home_m: DVec3::ZERO,
            home_locked: false,
        }
    }

    /// Makes arming leave home where it is, until the vehicle reboots.
    pub(super) fn lock_home(&mut self) {
        self.home_locked = true;
    }

    /// Whether arming moves home to the vehicle: only a home that no ground station has set.
    pub(super) fn arming_moves_home(&self) -> bool {
        self.home.is_some() && !self.home_locked
    }

    /// The position of home; `None` until it is set.
    pub(super) fn home(&self) -> Option<Place> {
        self.home
    }

    /// Sets home to a place.
    pub(super) fn set_home(&mut self, home: Place) {
        self.home = Some(home);
        self.home_m = self.point_of(home);
    }

    /// The place of a point in metres north, east and down from the start.
    pub(super) fn place_of(&self, point_m: DVec3) -> Place {
        Place {
            at: self.start.at.moved(point_m.x, point_m.y),
            altitude_amsl_m: self.start.altitude_amsl_m - point_m.z,
        }
    }

    /// The point of a place in metres north, east and down from the start.
    pub(super) fn point_of(&self, place: Place) -> DVec3 {
        let (north, east) = self.start.at.offset_to(place.at);
        DVec3::new(
            north,
            east,
            self.start.altitude_amsl_m - place.altitude_amsl_m,
        )
    }

    /// Home as a point; the start until home is set.
    pub(super) fn home_point(&self) -> DVec3 {
        self.home_m
    }

    /// [`altitude_amsl_m`] for this vehicle.
    pub(super) fn altitude_amsl_m(&self, frame: u8, height_m: f64) -> Option<f64> {
        altitude_amsl_m(frame, height_m, &self.start, self.home_point())
    }

    /// Whether a place is valid as home.
    pub(super) fn may_be_home(&self, place: Place) -> bool {
        let above_m = place.altitude_amsl_m - self.start.altitude_amsl_m;
        place.at.is_valid() && above_m.abs() <= HOME_HEIGHT_MAX_M
    }

    /// `HOME_POSITION`, once there is a home.
    pub(super) fn home_position(&self, boot_us: u64) -> Option<MavMessage> {
        let home = self.home?;
        let (latitude, longitude) = home.at.to_e7();
        let point = self.home_point();
        Some(MavMessage::HOME_POSITION(HOME_POSITION_DATA {
            latitude,
            longitude,
            altitude: (home.altitude_amsl_m * 1000.0) as i32,
            x: point.x as f32,
            y: point.y as f32,
            z: point.z as f32,
            q: [f32::NAN; 4],
            time_usec: boot_us,
            ..Default::default()
        }))
    }

    /// `GPS_GLOBAL_ORIGIN`, once there is a home.
    pub(super) fn global_origin(&self, boot_us: u64) -> Option<MavMessage> {
        self.home?;
        let (latitude, longitude) = self.start.at.to_e7();
        Some(MavMessage::GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA {
            latitude,
            longitude,
            altitude: (self.start.altitude_amsl_m * 1000.0) as i32,
            time_usec: boot_us,
        }))
    }
}
