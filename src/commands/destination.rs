//! Where a `goto` leads, and what the nose does on the way.

use crate::geo::LatLon;

/// Where a `goto` leads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Destination {
    /// A point on the earth; `None` keeps the present height.
    Global {
        at_point: LatLon,
        /// Metres above home; `None` keeps the height.
        altitude_m: Option<f64>,
    },
    /// Metres from the EKF origin (`LOCAL_POSITION_NED`); `None` keeps the present height.
    Local {
        /// North of the origin.
        north_m: f64,
        /// East of the origin.
        east_m: f64,
        /// Metres above the estimator's origin; `None` keeps the height.
        up_m: Option<f64>,
    },
    /// Metres from where the vehicle is when the command is sent.
    Offset {
        north_m: f64,
        east_m: f64,
        up_m: f64,
    },
}

/// What the nose does during a `goto`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heading {
    /// As the autopilot is set up (ArduCopter by default faces the way it flies).
    Auto,
    /// Stays as it is.
    Keep,
    /// A fixed heading, degrees clockwise from north.
    Fixed(f64),
}
