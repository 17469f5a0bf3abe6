//! The destination of a `goto`, and the heading on the way.

use crate::geo::LatLon;

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

/// The vehicle's heading during a `goto`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heading {
    /// As the autopilot is configured (ArduCopter by default faces the direction of flight).
    Auto,
    Keep,
    /// A fixed heading, degrees clockwise from north.
    Fixed(f64),
}
