//! The destination of a `goto`, and the heading on the way.

use crate::geo::LatLon;
use crate::vehicle::Vehicle;

/// The destination of a `goto`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Destination {
    /// A point on the earth.
    Global {
        at_point: LatLon,
        /// Metres above home; `None` keeps the height.
        altitude_m: Option<f64>,
    },
    /// Metres from the EKF origin (`LOCAL_POSITION_NED`).
    Local {
        /// North of the origin.
        north_m: f64,
        /// East of the origin.
        east_m: f64,
        /// Metres above the EKF origin; `None` keeps the height.
        up_m: Option<f64>,
    },
    /// Metres from the vehicle's position when the command is sent.
    Offset {
        north_m: f64,
        east_m: f64,
        up_m: f64,
    },
}

impl Destination {
    /// The place to which the destination leads a vehicle, and the height above home in metres
    /// unless the vehicle keeps its own; `None` if the vehicle's position is unknown.
    pub fn of(self, vehicle: &Vehicle) -> Option<(LatLon, Option<f64>)> {
        let here = vehicle.global?;
        Some(match self {
            Self::Global {
                at_point,
                altitude_m,
            } => (at_point, altitude_m),
            Self::Local {
                north_m,
                east_m,
                up_m,
            } => {
                let [north, east, down] = vehicle.local?.ned_m.map(f64::from);
                (
                    here.at_point.moved(north_m - north, east_m - east),
                    // Heights count from the origin here, and home may lie higher.
                    up_m.map(|up_m| here.altitude_m + up_m + down),
                )
            }
            Self::Offset {
                north_m,
                east_m,
                up_m,
            } => (
                here.at_point.moved(north_m, east_m),
                Some(here.altitude_m + up_m),
            ),
        })
    }
}

/// The vehicle's heading during a `goto`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heading {
    /// As the autopilot is configured (ArduCopter by default faces the direction of flight).
    Auto,
    Keep,
    /// A fixed heading, degrees clockwise from north.
    Fixed(f64),
}
