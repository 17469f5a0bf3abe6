//! What the mission panel shows.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Pledge;
use crate::geo::LatLon;
use crate::language::Findings;
use crate::scoring::SwarmFigures;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A mission as it stands now.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// Its title.
    pub title: Text,
    /// Mission time used.
    pub elapsed: Duration,
    /// Mission time allowed.
    pub limit: Duration,
    /// The score if it ended now, 0 to 1000; `None` before the first takeoff.
    pub score_so_far: Option<u16>,
    /// The objectives, in the mission's order.
    pub objectives: Vec<ObjectiveProgress>,
    /// What the virtual sensors show, in order of vehicle.
    pub readings: Vec<Reading>,
    /// What sensors have found, for waits.
    pub findings: Findings,
    /// What to do next, where the mission has advice.
    pub hint: Option<Text>,
    /// The one line of feedback: the newest thing that matters, at most one new in 5 s unless it is critical.
    pub feedback: Option<Text>,
    /// Hints that can be asked for.
    pub clues: ClueProgress,
    /// What the trainee has said before launch.
    pub pledge: Pledge,
    /// Whether a prediction and a goal can still be given.
    pub can_pledge: bool,
    /// How the operator handles the swarm so far.
    pub swarm: SwarmFigures,
    /// Places that have come up during the flight, for the grammar: contacts (`c1`) and `peak`.
    pub places: BTreeMap<String, LatLon>,
    /// The cells of all surveys; south-west first, then to the east.
    pub cells: Vec<Cell>,
}

/// The hints that can be asked for, as they stand.
#[derive(Debug, Clone, PartialEq)]
pub struct ClueProgress {
    /// Those that were given: level and text, oldest first.
    pub given: Vec<(u8, Text)>,
    /// The level of the next one that fits now, and the share of the score that it would take.
    pub next: Option<(u8, f64)>,
    /// What is left of the score by those that were given, 0.7 to 1.
    pub factor: f64,
}

/// One objective as it stands now.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveProgress {
    /// Its title.
    pub title: Text,
    /// Whether it is decided.
    pub state: ObjectiveState,
    /// How it stands, such as `7/9 cells`.
    pub detail: Text,
    /// How far it is reached, 0 to 1.
    pub fraction: f64,
}

/// Whether an objective is decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ObjectiveState {
    /// Not reached yet.
    Open,
    /// Reached.
    Met,
    /// Not reached when the flight ended.
    Missed,
}

/// What a virtual sensor shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Which vehicle carries it.
    pub vehicle: VehicleId,
    /// Its name.
    pub sensor: Text,
    /// What it shows.
    pub value: f64,
    /// In this unit.
    pub unit: &'static str,
}

/// One cell of a survey.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Its name, such as `A1`.
    pub name: String,
    /// Its centre.
    pub centre: LatLon,
    /// Length of its sides, in metres.
    pub side_m: f64,
    /// Whether it has been sampled for long enough.
    pub sampled: bool,
    /// The mean of its readings so far, in the sensor's unit.
    pub value: Option<f64>,
}
