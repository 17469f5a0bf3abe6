//! The truth that a debrief reveals: what was there, what was reported, what was flown and what was left out.

use serde::{Deserialize, Serialize};

use crate::commands::FindKind;

/// Metres east and north of the mission's origin.
type Place = [f64; 2];

/// What there was, in metres east and north of the mission's origin.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct TruthReport {
    /// How strong hazards were, by squares.
    pub squares: Vec<SquareReport>,
    /// The things that could be found.
    pub objects: Vec<ObjectReport>,
    /// What the trainee reported.
    pub marks: Vec<MarkReport>,
    /// What of the task was not covered, by squares; their strength is 0.
    pub gaps: Vec<SquareReport>,
    pub pads: Vec<Place>,
    /// The corners of the fences that had to be kept; none in records of earlier versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fences: Vec<Vec<Place>>,
    /// The gates that had to be flown through, where the seed had put them; none in records of earlier versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gates: Vec<Place>,
    /// The ways of the vehicles.
    pub tracks: Vec<TrackReport>,
}

/// A square of ground.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SquareReport {
    pub at: Place,
    /// Length of its sides, in metres.
    pub side_m: f64,
    /// How strong the hazard was there, 0 to 1.
    pub strength: f64,
}

/// A thing that could be found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectReport {
    pub at: Place,
    pub kind: ObjectKind,
    /// Whether it was still there at the end.
    pub present: bool,
    /// Whether it was reported.
    pub found: bool,
    /// Whether an objective asked for its report.
    pub sought: bool,
}

/// What a thing is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObjectKind {
    /// What should not be reported.
    Decoy,
    #[serde(untagged)]
    Find(FindKind),
}

/// A report of the trainee's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MarkReport {
    /// Where it was reported.
    pub at: Place,
    /// What it was said to be, if anything.
    pub kind: Option<FindKind>,
    /// Whether there was something of the kind.
    pub right: bool,
}

/// The way of a vehicle in the air.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrackReport {
    /// The vehicle that flew it.
    pub vehicle: u16,
    /// Points of its way, at least 5 m apart.
    pub points: Vec<Place>,
}
