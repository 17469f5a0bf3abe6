//! The local frame in which manoeuvres are planned.

use glam::{DVec2, DVec3};

use super::geometry::MovingPoint;
use crate::commands::Datum;
use crate::geo::LatLon;
use crate::vehicle::Vehicle;

/// A frame around a place: x is metres to the north, y to the east, z above home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Site {
    origin: LatLon,
}

impl Site {
    pub fn new(origin: LatLon) -> Self {
        Self { origin }
    }

    /// A place on the ground as a point, in metres north and east of the origin.
    pub fn flat(&self, place: LatLon) -> DVec2 {
        let (north_m, east_m) = self.origin.offset_to(place);
        DVec2::new(north_m, east_m)
    }

    /// The place of a point, given in metres north and east of the origin.
    pub fn place(&self, point: DVec2) -> LatLon {
        self.origin.moved(point.x, point.y)
    }

    /// A vehicle's position, if known.
    pub fn point(&self, vehicle: &Vehicle) -> Option<DVec3> {
        let global = vehicle.global?;
        Some(self.flat(global.at_point).extend(global.altitude_m))
    }

    /// A given place in the frame, if it is known; offsets from an EKF origin refer to that of the
    /// vehicle `reference`.
    pub fn spot(&self, spot: Datum, reference: &Vehicle) -> Option<DVec2> {
        match spot {
            Datum::Global(place) => place.is_valid().then(|| self.flat(place)),
            Datum::Local { north_m, east_m } => {
                let here = self.point(reference)?.truncate();
                let local = reference.local?.ned_m.map(f64::from);
                Some(here + DVec2::new(north_m - local[0], east_m - local[1]))
            }
        }
    }
}

/// A vehicle's position and velocity, if known.
pub(super) fn moving(site: &Site, vehicle: &Vehicle) -> Option<MovingPoint> {
    Some(MovingPoint {
        at: site.point(vehicle)?,
        velocity_m_s: velocity(vehicle),
    })
}

/// The velocity of a vehicle: north, east, up, in m/s.
pub(super) fn velocity(vehicle: &Vehicle) -> DVec3 {
    vehicle.global.map_or(DVec3::ZERO, |global| {
        DVec3::new(
            f64::from(global.north_m_s),
            f64::from(global.east_m_s),
            -f64::from(global.down_m_s),
        )
    })
}
