//! The truth in a debrief: objects, reports, tracks, and gaps.

use serde::{Deserialize, Serialize};

use crate::commands::FindKind;

/// A position in metres east and north of the mission's origin.
type Place = [f64; 2];

/// The truth, in metres east and north of the mission's origin.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct TruthReport {
    /// The strength of hazards, in squares.
    pub squares: Vec<SquareReport>,
    pub objects: Vec<ObjectReport>,
    pub marks: Vec<MarkReport>,
    /// The ground not covered and the cells not sampled, as squares with strength 0.
    pub gaps: Vec<SquareReport>,
    pub pads: Vec<Place>,
    /// The corners of the fences; empty in records of earlier versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fences: Vec<Vec<Place>>,
    /// The gates, at the positions drawn from the seed; empty in records of earlier versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gates: Vec<Place>,
    /// The pylons of each power line, in order; empty in records of earlier versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wires: Vec<Vec<Place>>,
    /// The tracks of the vehicles.
    pub tracks: Vec<TrackReport>,
}

/// A square of ground.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SquareReport {
    pub at: Place,
    /// Length of its sides, in metres.
    pub side_m: f64,
    /// The strength of the hazard, 0 to 1.
    pub strength: f64,
    /// Whether the hazard is a fire: burning at full strength, otherwise burnt.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_fire: bool,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectReport {
    pub at: Place,
    pub kind: ObjectKind,
    /// Whether it was still there at the end.
    pub present: bool,
    /// Whether it was reported.
    pub found: bool,
    /// Whether an objective required a report of it.
    pub sought: bool,
}

/// The kind of an object in the truth: a find to report, or a decoy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObjectKind {
    /// An object that should not be reported.
    Decoy,
    #[serde(untagged)]
    Find(FindKind),
}

/// A report by the trainee.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MarkReport {
    pub at: Place,
    /// The reported kind, if any.
    pub kind: Option<FindKind>,
    /// Whether an object of the kind was there.
    pub right: bool,
}

/// The track of a vehicle in the air.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrackReport {
    pub vehicle: u16,
    /// Points of the track, at least 5 m apart.
    pub points: Vec<Place>,
}
