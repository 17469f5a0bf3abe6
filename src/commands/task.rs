//! Tasks for which each target gets a plan of its own.
//!
//! Pure data: the [`Conductor`](crate::swarm::Conductor) turns it into plans.

use super::{Datum, Ground, Pattern};
use crate::geo::LatLon;
use crate::plan::generate::Course;

/// A task that the plans of several vehicles share.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanTask {
    /// Parallel lines over an area.
    Survey {
        ground: Ground,
        /// The line spacing in metres; `None` as in [`Manoeuvre::Survey`](super::Manoeuvre::Survey).
        spacing_m: Option<f64>,
        /// Height above home in metres; `None` for the default.
        up_m: Option<f64>,
        /// The direction of the lines.
        course: Course,
    },
    /// A search around a place.
    Search {
        pattern: Pattern,
        /// The most likely position of the object.
        datum: Datum,
        /// The radius of the search in metres; `None` for the default of the pattern.
        radius_m: Option<f64>,
        /// The spacing of the square's turns in metres; `None` as for a survey.
        spacing_m: Option<f64>,
        /// Height above home in metres; `None` for the default.
        up_m: Option<f64>,
    },
    /// A lane for each vehicle, side by side along a line.
    Line {
        /// The points of the line, in order.
        points: Vec<LatLon>,
        /// The distance between lanes in metres; `None` for the width that the sensor covers.
        spacing_m: Option<f64>,
        /// Height above home in metres; `None` for the default.
        up_m: Option<f64>,
    },
    /// Circles around a place.
    Orbit {
        centre: Datum,
        radius_m: f64,
        /// The number of turns; `None` for the default.
        turns: Option<u8>,
        /// Height above home in metres; `None` for the default.
        up_m: Option<f64>,
    },
}

impl PlanTask {
    /// The task's height above home in metres; `None` for the default.
    pub fn up_m(&self) -> Option<f64> {
        match self {
            Self::Survey { up_m, .. }
            | Self::Search { up_m, .. }
            | Self::Line { up_m, .. }
            | Self::Orbit { up_m, .. } => *up_m,
        }
    }
}
