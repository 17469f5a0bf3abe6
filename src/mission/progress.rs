//! The content of the mission panel.

use std::collections::BTreeMap;
use std::time::Duration;

use super::{Area, Inject, LessonStep, MoverKind, OpenAlert, Phase, Pledge};
use crate::commands::FindKind;
use crate::geo::LatLon;
use crate::language::Findings;
use crate::scoring::SwarmFigures;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A mission as it stands now.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    pub title: Text,
    /// How much mission time has passed.
    pub elapsed: Duration,
    pub limit: Duration,
    /// The score if it ended now, 0 to 1000; `None` before the first takeoff.
    pub score_so_far: Option<u16>,
    /// The objectives, in the mission's order.
    pub objectives: Vec<ObjectiveProgress>,
    /// What the virtual sensors show, in order of vehicle.
    pub readings: Vec<Reading>,
    /// What the vehicles still carry to let go of, in order of vehicle.
    pub loads: Vec<LoadLeft>,
    /// What sensors have found, for waits.
    pub findings: Findings,
    /// How far the flight has come.
    pub phase: Phase,
    /// What to do next, where the mission has advice.
    pub hint: Option<Text>,
    /// The step of the lesson, where the mission has one.
    pub lesson: Option<LessonStep>,
    /// The one line of feedback: the newest thing that matters, at most one new in 5 s unless it is critical.
    pub feedback: Option<Text>,
    /// Hints that can be asked for.
    pub clues: ClueProgress,
    /// Whether a prediction and a goal can still be given.
    pub can_pledge: bool,
    /// How the operator handles the swarm so far.
    pub swarm: SwarmFigures,
    /// Places that have come up during the flight, for the grammar: contacts (`c1`) and `peak`.
    pub places: BTreeMap<String, LatLon>,
    /// What detectors have found so far, in the order of its numbers.
    pub contacts: Vec<ShownContact>,
    /// What the trainee has reported so far.
    pub marks: Vec<ShownMark>,
    /// What the trainee has said before launch.
    pub pledge: Pledge,
    /// What an instructor may have happen.
    pub injects: Vec<Inject>,
    /// The cells of all surveys; south-west first, then to the east.
    pub cells: Vec<Cell>,
    /// The ground that the trainee's map has as burnt: what was seen, as it was when it was seen.
    pub mapped: Vec<Ground>,
    /// The ground that has been searched as an objective asks for it.
    pub swept: Vec<Ground>,
    /// The areas that are there now; events bring some and take others away.
    pub areas: Vec<Area>,
    /// People, aircraft and drones of others that are on the way.
    pub movers: Vec<MovingThing>,
    /// Alerts that wait for an answer, the most urgent first.
    pub alerts: Vec<OpenAlert>,
    /// How well vehicles are heard, in dB above what the receiver needs; empty where radio does not matter.
    pub margins_db: BTreeMap<VehicleId, f64>,
}

/// A person, an aircraft or a drone that moves through the mission.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingThing {
    /// What conditions of the mission call it.
    pub name: String,
    pub kind: MoverKind,
    pub at: LatLon,
    /// How high it moves, in metres above the origin.
    pub height_m: f64,
    /// How far from it vehicles have to stay, in metres.
    pub keep_out_m: f64,
}

/// The hints that can be asked for, as they stand.
#[derive(Debug, Clone, PartialEq)]
pub struct ClueProgress {
    /// Those that were given: level and text, oldest first.
    pub given: Vec<(u8, Text)>,
    /// Whether the newest is newer than the advice that comes by itself.
    pub is_news: bool,
    /// The level of the next one that fits now, and the share of the score that it would take.
    pub next: Option<(u8, f64)>,
    /// What is left of the score by those that were given, 0.7 to 1.
    pub factor: f64,
}

impl ClueProgress {
    /// How to get the next hint, by a key, and what it costs; `None` where there is none.
    pub fn price(&self, key: Text) -> Option<Text> {
        let (level, price) = self.next?;
        let percent = (price * 100.0).round() as u32;
        Some(text!(
            "mission-hint-price",
            key = key,
            level = level,
            percent = percent
        ))
    }
}

/// One objective as it stands now.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveProgress {
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
    Open,
    Met,
    /// Not reached when the flight ended.
    Missed,
}

impl ObjectiveProgress {
    /// Whether it is reached.
    pub fn is_reached(&self) -> bool {
        self.state == ObjectiveState::Met
    }
}

/// Something that detectors believe to have found.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownContact {
    /// What it is called: `c1`.
    pub name: String,
    /// What it is taken for.
    pub kind: FindKind,
    /// Where it is believed to be.
    pub at: LatLon,
    /// How far it is confirmed.
    pub trust: Trust,
}

/// How far a contact is trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Trust {
    /// One kind of sensor has seen it.
    Seen,
    /// Two kinds of sensors have seen it.
    Confirmed,
    /// The trainee has reported it.
    Reported,
}

/// What the trainee has reported.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownMark {
    /// What it is said to be.
    pub kind: Option<FindKind>,
    /// Where it was reported.
    pub at: LatLon,
}

/// What a virtual sensor shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Which vehicle carries it.
    pub vehicle: VehicleId,
    /// Name of the sensor.
    pub sensor: Text,
    pub value: f64,
    /// The unit of the value.
    pub unit: &'static str,
}

/// What is left of a load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadLeft {
    /// Which vehicle carries it.
    pub vehicle: VehicleId,
    /// Name of the load.
    pub load: Text,
    /// How many are left; seconds of what is sprayed.
    pub left: u32,
    /// The unit: `s` for what is sprayed, else nothing.
    pub unit: &'static str,
}

/// A square of ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    pub centre: LatLon,
    /// Length of its sides, in metres.
    pub side_m: f64,
}

/// One cell of a survey.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Its name, such as `A1`.
    pub name: String,
    pub centre: LatLon,
    /// Length of its sides, in metres.
    pub side_m: f64,
    /// Whether it has been sampled for long enough.
    pub sampled: bool,
    /// The mean of its readings so far, in the sensor's unit.
    pub value: Option<f64>,
}
