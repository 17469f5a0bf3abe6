//! Manoeuvres of several vehicles.
//!
//! Pure data: the [`Conductor`](crate::swarm::Conductor) turns it into setpoints for each of them.

use crate::geo::{LatLon, Outline};
use crate::vehicle::VehicleId;

/// Something that several vehicles do together. One alone may do it, too.
#[derive(Debug, Clone, PartialEq)]
pub enum Manoeuvre {
    /// Fly parallel lines over an area, each vehicle its share.
    Survey {
        ground: Ground,
        /// Between two lines; `None` takes the width that the sensor sees.
        spacing_m: Option<f64>,
        /// Height above home; `None` is that of the first vehicle.
        up_m: Option<f64>,
        /// Course of the lines, degrees clockwise from north; `None` is the one with the fewest turns.
        course_deg: Option<f64>,
    },
    /// Take places around the first vehicle, and keep them while it goes somewhere.
    Formation {
        /// How the places lie.
        shape: Shape,
        /// Between neighbours; `None` takes a width that suits.
        spacing_m: Option<f64>,
        /// Height above home; `None` is that of the first vehicle.
        up_m: Option<f64>,
        /// Which way it faces, degrees clockwise from north; `None` turns it into the course.
        face_deg: Option<f64>,
    },
    /// End a formation: all members stay where they are.
    Disband,
    /// Fly behind another vehicle, one after the other.
    Follow {
        leader: VehicleId,
        /// Between one and the next.
        distance_m: f64,
        /// Height of the first of them above home; `None` begins one step above the leader.
        up_m: Option<f64>,
    },
    /// Move apart until no vehicle has a neighbour nearer than this.
    Spread { spacing_m: f64 },
    /// Search around a place.
    Search {
        /// The way it is flown.
        pattern: Pattern,
        /// Where what is searched for is most likely to be.
        datum: Datum,
        /// How far from there.
        radius_m: Option<f64>,
        /// Between two turns of the square; `None` takes the width that the sensor sees.
        spacing_m: Option<f64>,
        /// Height above home of the lowest; `None` is that of the first vehicle.
        up_m: Option<f64>,
    },
    /// Stand in a chain between home and something far away, so that messages can be handed on.
    Chain {
        /// The far end, where no vehicle of the chain stands.
        to: FarEnd,
        /// Height above home; `None` is that of the first vehicle.
        up_m: Option<f64>,
    },
}

/// A place as it was said.
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

/// An area as it was said.
#[derive(Debug, Clone, PartialEq)]
pub enum Ground {
    /// One that is known by name.
    Outline(Outline),
    /// An upright rectangle, by two opposite corners.
    Between(Datum, Datum),
    Around {
        centre: Datum,
        radius_m: f64,
    },
}

/// How the places of a formation lie; the first vehicle is at the front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

impl Shape {
    /// The words of the grammar.
    pub const NAMES: &'static [&'static str] = &["line", "column", "wedge", "grid", "circle"];

    /// The one that is called so.
    pub fn named(word: &str) -> Option<Self> {
        Some(match word {
            "line" => Self::Line,
            "column" => Self::Column,
            "wedge" => Self::Wedge,
            "grid" => Self::Grid,
            "circle" => Self::Circle,
            _ => return None,
        })
    }
}

/// How a search goes (IAMSAR Manual, volume II, chapter 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// Expanding square: outwards from the datum.
    Square,
    /// Sector search: through the datum again and again.
    Sector,
}

impl Pattern {
    /// The words of the grammar.
    pub const NAMES: &'static [&'static str] = &["square", "sector"];

    /// The one that is called so.
    pub fn named(word: &str) -> Option<Self> {
        Some(match word {
            "square" => Self::Square,
            "sector" => Self::Sector,
            _ => return None,
        })
    }
}
