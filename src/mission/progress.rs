//! The content of the mission panel.

use std::collections::BTreeMap;
use std::time::Duration;

use super::{Area, Expected, Inject, Injected, LessonStep, MoverKind, OpenAlert, Phase, Pledge};
use crate::commands::FindKind;
use crate::geo::LatLon;
use crate::language::Findings;
use crate::scoring::SwarmFigures;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The current state of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    pub title: Text,
    pub elapsed: Duration,
    pub limit: Duration,
    /// The points earned so far, 0 to 1000, without the cap for mandatory objectives until the mission is over; `None`
    /// before the first takeoff.
    pub score_so_far: Option<u16>,
    /// The objectives, in file order.
    pub objectives: Vec<ObjectiveProgress>,
    /// The readings of the virtual sensors, by vehicle.
    pub readings: Vec<Reading>,
    /// The loads left on board, by vehicle.
    pub loads: Vec<LoadLeft>,
    /// The sensors' findings, for waits in scripts.
    pub findings: Findings,
    /// The phase of the flight.
    pub phase: Phase,
    /// Advice on what to do next, if the mission has any.
    pub hint: Option<Text>,
    /// The current step of the lesson, if the mission has one.
    pub lesson: Option<LessonStep>,
    /// The single line of feedback: the newest item that matters, at most one in 5 s unless critical.
    pub feedback: Option<Text>,
    /// Hints that the trainee can ask for.
    pub clues: ClueProgress,
    /// Whether the flight ends without any further command: all vehicles are down, and nothing is left to do.
    pub ends_itself: bool,
    /// Whether the trainee can still set a prediction and a goal.
    pub can_pledge: bool,
    /// The newest question about the workload that was answered, counted as by
    /// [`workload_question`](crate::scoring::workload_question).
    pub answered_question: Option<u64>,
    /// Figures on the operator's handling of the swarm so far.
    pub swarm: SwarmFigures,
    /// Places known so far, for the grammar: contacts (`c1`) and `peak`.
    pub places: BTreeMap<String, LatLon>,
    /// Whether the fleet carries two kinds of detectors, so that one can confirm the finds of the other.
    pub can_confirm: bool,
    /// The contacts of the detectors so far, by number.
    pub contacts: Vec<ShownContact>,
    /// The trainee's reports so far.
    pub marks: Vec<ShownMark>,
    /// The trainee's prediction and goal.
    pub pledge: Pledge,
    /// The injects that an instructor may trigger.
    pub injects: Vec<Inject>,
    /// The injects that the mission has carried out, in their order.
    pub injected: Vec<Injected>,
    /// The condition that the desk of a class wants to know of.
    pub expected: Option<Expected>,
    /// The cells of all surveys, from the south-west eastwards.
    pub cells: Vec<Cell>,
    /// The burnt ground on the trainee's map, as last seen.
    pub mapped: Vec<Ground>,
    /// The ground that has been searched as an objective requires.
    pub swept: Vec<Ground>,
    /// The active areas; events can add and remove them.
    pub areas: Vec<Area>,
    /// People, aircraft and other operators' drones that are under way.
    pub movers: Vec<MovingThing>,
    /// Unanswered alerts, the most urgent first.
    pub alerts: Vec<OpenAlert>,
    /// Each vehicle's link margin in dB; empty if the mission does not model the radio.
    pub margins_db: BTreeMap<VehicleId, f64>,
}

/// A moving person, aircraft or drone.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingThing {
    /// Its id in the mission's conditions.
    pub name: String,
    pub kind: MoverKind,
    pub at: LatLon,
    /// Its height in metres above the origin.
    pub height_m: f64,
    /// Its height in metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// Its velocity in m/s, north and east.
    pub velocity_m_s: [f64; 2],
    /// The callsign of an aircraft.
    pub callsign: String,
    /// The distance that vehicles must keep from it, in metres.
    pub keep_out_m: f64,
}

/// The state of the hints on request.
#[derive(Debug, Clone, PartialEq)]
pub struct ClueProgress {
    /// The hints given: level and text, oldest first.
    pub given: Vec<(u8, Text)>,
    /// Whether the newest hint is newer than the automatic advice.
    pub is_news: bool,
    /// The level of the next suitable hint, and the share of the score that it costs.
    pub next: Option<(u8, f64)>,
    /// The factor by which the score is multiplied for the hints given, 0.7 to 1.
    pub factor: f64,
}

impl ClueProgress {
    /// The key for the next hint, with its cost, as text; `None` if there is no next hint.
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

/// The current state of one objective.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveProgress {
    pub title: Text,
    /// Whether it is met, missed or open.
    pub state: ObjectiveState,
    /// Its progress as text, such as `7/9 cells`.
    pub detail: Text,
    /// The share of it that is reached, 0 to 1.
    pub fraction: f64,
}

/// Whether an objective is open, met or missed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ObjectiveState {
    Open,
    Met,
    /// Not reached at the end of the flight, or out of reach before.
    Missed,
}

impl ObjectiveProgress {
    /// Whether the objective is met.
    pub fn is_reached(&self) -> bool {
        self.state == ObjectiveState::Met
    }
}

/// A contact of the detectors, which may be a false alarm.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownContact {
    /// Its name, such as `c1`.
    pub name: String,
    /// The kind of object that the detectors report.
    pub kind: FindKind,
    pub at: LatLon,
    /// How well the contact is confirmed.
    pub trust: Trust,
}

/// How well a contact is confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Trust {
    /// A look has shown that it is harmless.
    Harmless,
    /// One kind of sensor has seen the contact.
    Seen,
    /// Two kinds of sensors have seen the contact.
    Confirmed,
    /// The trainee has reported the contact.
    Reported,
}

/// A report of the trainee.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownMark {
    /// The reported kind; `None` if the trainee gave none.
    pub kind: Option<FindKind>,
    pub at: LatLon,
}

/// The reading of a virtual sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The vehicle that carries it.
    pub vehicle: VehicleId,
    /// Name of the sensor.
    pub sensor: Text,
    pub value: f64,
    /// The unit of the value.
    pub unit: &'static str,
}

/// The remaining amount of a load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadLeft {
    /// The vehicle that carries it.
    pub vehicle: VehicleId,
    /// Name of the load.
    pub load: Text,
    /// The pieces left, or the seconds for spray.
    pub left: u32,
    /// The unit: `s` for spray, otherwise empty.
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
    /// The mean of its readings so far, in the sensor's unit; `None` without readings.
    pub value: Option<f64>,
}
