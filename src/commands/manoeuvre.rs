//! Manoeuvres of several vehicles.
//!
//! Pure data: the [`Conductor`](crate::swarm::Conductor) turns it into setpoints for each vehicle.

use strum::{EnumString, VariantNames};

use crate::geo::{LatLon, Outline};
use crate::vehicle::VehicleId;

/// A manoeuvre of several vehicles. A single vehicle can also fly it.
#[derive(Debug, Clone, PartialEq)]
pub enum Manoeuvre {
    /// Fly parallel lines over an area, each vehicle over a part of it.
    Survey {
        ground: Ground,
        /// The line spacing in metres; `None` for the width of the sensor's strip at the height of
        /// the lines, or for 20 m if there is no sensor or the strip is narrower than 0.3 m.
        spacing_m: Option<f64>,
        /// Height above home; `None` for that of the first vehicle.
        up_m: Option<f64>,
        /// Course of the lines, degrees clockwise from north; `None` for the fewest turns.
        course_deg: Option<f64>,
    },
    /// Take places around the first vehicle, and keep them while it moves.
    Formation {
        /// The arrangement of the places.
        shape: Shape,
        /// The distance between neighbours; `None` for a suitable one.
        spacing_m: Option<f64>,
        /// Height above home; `None` for that of the first vehicle.
        up_m: Option<f64>,
        /// The formation's heading, degrees clockwise from north; `None` to follow the course.
        face_deg: Option<f64>,
    },
    /// End a formation: all members stay where they are.
    Disband,
    /// Follow another vehicle in a line.
    Follow {
        leader: VehicleId,
        /// The distance between neighbours.
        distance_m: f64,
        /// The first follower's height above home; `None` for one step above the leader.
        up_m: Option<f64>,
    },
    /// Move apart until all vehicles are at least this far from each other.
    Spread { spacing_m: f64 },
    /// Search around a place.
    Search {
        pattern: Pattern,
        /// The most likely position of the object.
        datum: Datum,
        /// The radius of the search; `None` for the pattern's default.
        radius_m: Option<f64>,
        /// The spacing of the square's turns in metres; `None` as in [`Self::Survey`].
        spacing_m: Option<f64>,
        /// The lowest height above home; `None` for that of the first vehicle.
        up_m: Option<f64>,
    },
    /// Form a chain between home and a distant end, to relay messages.
    Chain {
        /// The far end, where no vehicle of the chain is placed.
        to: FarEnd,
        /// Height above home; `None` for that of the first vehicle.
        up_m: Option<f64>,
    },
}

/// A place in the form in which it was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Datum {
    Global(LatLon),
    /// Metres from the EKF origin of the first vehicle.
    Local {
        north_m: f64,
        east_m: f64,
    },
}

/// The end of a chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FarEnd {
    Place(Datum),
    /// A vehicle, wherever it goes.
    Vehicle(VehicleId),
}

/// An area in the form in which it was given.
#[derive(Debug, Clone, PartialEq)]
pub enum Ground {
    Outline(Outline),
    /// A rectangle with sides along north and east, given by two opposite corners.
    Between(Datum, Datum),
    Around {
        centre: Datum,
        radius_m: f64,
    },
}

/// The arrangement of a formation; the first vehicle is at the front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Shape {
    /// Side by side, the first in the middle.
    Line,
    /// One behind the other.
    Column,
    /// Two arms that trail behind the first.
    Wedge,
    /// As square as the number of vehicles allows.
    Grid,
    Circle,
}

/// A search pattern (IAMSAR Manual, volume II, chapter 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Pattern {
    /// Expanding square: outwards from the datum.
    Square,
    /// Sector search: repeatedly through the datum.
    Sector,
}
