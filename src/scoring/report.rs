//! The report of a finished flight: the output of `sortie run --json`, the stored result, and the basis of a debrief.
//!
//! Texts are stored as messages, so that a debrief can be shown in any language; JSON contains the English texts.
//! Numbers are rounded to fixed decimals when the report is made, so that identical flights give identical bytes.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::{
    AlertFact, AlertLevel, Component, Improvement, Medal, SwarmFigures, TruthReport, VehicleUse,
    WorkloadReport,
};
use crate::crew::CrewViewpoint;
use crate::ledger::RowState;
use crate::pilot_in_command::Person;
use crate::record::InstructorPart;
use crate::text::{Text, rounded};

mod kind;
mod row_state;
mod soundness;

pub use kind::{EventKind, FlightBackend, FlightOutcome, FlownBy, MissionFile, ScoreGrade};

/// A flight's result with every point explained. The order of the fields is the order in the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Id of the mission.
    pub mission: String,
    /// Its revision; results are comparable only within one revision.
    pub revision: u32,
    /// Seed of the hazards and sensors.
    pub seed: u64,
    /// The simulator; set by the shell if it was not the embedded one.
    pub backend: FlightBackend,
    /// The source of the commands; `None` if unknown, as in old records.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flown_by: Option<FlownBy>,
    /// The members of a crew who gave commands; the host is not among them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub crew: Vec<String>,
    /// How the mission compares with that of the course; set by the shell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mission_file: Option<MissionFile>,
    /// Whether all mandatory objectives were met.
    pub passed: bool,
    /// Whether the trainee gave up, which earns no points.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub given_up: bool,
    /// The points, 0 to 1000.
    pub score: u16,
    /// The medal, if any.
    pub medal: Option<Medal>,
    /// Mission time used, in seconds.
    pub sim_time_s: f64,
    /// The objectives, in file order.
    pub objectives: Vec<ObjectiveReport>,
    /// The components of the score; their points sum to `subtotal`.
    pub components: Vec<ComponentReport>,
    /// The score before hints, to a tenth.
    pub subtotal: f64,
    /// The factor for hints, 0.7 to 1.
    pub hint_factor: f64,
    /// Every command of the flight.
    pub ledger: Vec<LedgerReport>,
    /// The events, oldest first.
    pub events: Vec<EventReport>,
    /// Title of the mission.
    pub title: Text,
    pub outcome: FlightOutcome,
    pub grade: ScoreGrade,
    /// The number of vehicles.
    pub vehicles: usize,
    /// Mission time allowed, in seconds.
    pub time_limit_s: f64,
    /// The maximum mission time for full points, in seconds.
    pub par_time_s: f64,
    /// Energy used by all vehicles in Wh, if reported.
    pub energy_wh: Option<f64>,
    /// The maximum energy for full points, in Wh.
    pub par_energy_wh: f64,
    /// Conditions for gold that are not met, including points and mandatory objectives.
    pub gold_missing: Vec<Text>,
    /// The improvements, biggest gain first.
    pub improvements: Vec<Improvement>,
    /// The number of the attempt, from 1.
    pub attempt: u32,
    /// The requested hints, oldest first.
    pub hints: Vec<HintReport>,
    /// The trainee's prediction, and its error.
    pub prediction: Option<PredictionReport>,
    /// The trainee's goal, and whether it was reached.
    pub goal: Option<GoalReport>,
    /// The alerts that had to be answered, oldest first.
    pub alerts: Vec<AlertReport>,
    /// The use of each vehicle.
    pub usage: Vec<UseReport>,
    /// Figures on the operator's handling of the swarm.
    pub swarm: SwarmFigures,
    /// The workload over the flight; empty in reports from before this field existed.
    #[serde(default, skip_serializing_if = "WorkloadReport::is_empty")]
    pub workload: WorkloadReport,
    /// The true state of the world, for the map of the debrief.
    pub truth: TruthReport,
    /// What an instructor did in the flight, from its journal; set by the shell.
    #[serde(default, skip_serializing_if = "InstructorPart::is_empty")]
    pub instructor: InstructorPart,
    /// The drill for the mission, if there is one; set by the shell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drill: Option<String>,
    /// The trainee's attempts at this revision of the mission, including this one, oldest first; set by the shell.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tries: Vec<TryReport>,
    /// The real time that the run took, in seconds. The shell sets it; no other field may differ between identical
    /// runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_time_s: Option<f64>,
}

/// The result of one objective.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectiveReport {
    /// Its id in the mission file.
    pub id: String,
    pub title: Text,
    /// Whether the mission fails without the objective.
    pub mandatory: bool,
    /// Whether it was reached.
    pub met: bool,
    /// The measured result as text.
    pub result: Text,
    /// The target as text.
    pub target: Text,
    /// Points within the objectives' component.
    pub points: f64,
    /// The maximum number of points possible.
    pub points_max: f64,
}

/// One component of the score.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ComponentReport {
    #[serde(rename = "name")]
    pub component: Component,
    /// Its weight after the redistribution.
    pub weight: f64,
    /// Its value, 0 to 1.
    pub value: f64,
    /// Its points of 1000, to a tenth.
    pub points: f64,
    /// Its main cause, as text.
    pub moved_by: Text,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LedgerReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// The line as typed.
    pub line: String,
    /// Who gave it, if that was not the trainee.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Person>,
    /// The result for each vehicle.
    pub rows: Vec<RowReport>,
}

impl Report {
    /// Who gave the commands, as texts about figures of the whole flight choose their words: `crew` if other persons gave
    /// some, otherwise `you`.
    pub fn commanders(&self) -> &'static str {
        if self.crew.is_empty() { "you" } else { "crew" }
    }

    /// Names the persons of a crew as one of its members knows them, who has the host's record.
    pub fn seen_from(&mut self, viewpoint: &CrewViewpoint) {
        for entry in &mut self.ledger {
            entry.by = viewpoint.by(entry.by.as_ref());
        }
        // An instructor's commands are not those of the crew.
        let crew = self.ledger.iter().filter_map(|entry| entry.by.as_ref());
        let crew: BTreeSet<&str> = crew
            .filter(|it| !it.is_instructor())
            .map(Person::name)
            .collect();
        self.crew = crew.into_iter().map(str::to_owned).collect();
    }
}

/// The result of a command for one vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "RowDocument")]
pub struct RowReport {
    pub vehicle: u16,
    #[serde(with = "row_state")]
    pub state: RowState,
    /// The number of transmissions.
    pub tries: u8,
    /// The reason for a refusal, or a remark.
    pub explanation: Option<Text>,
}

/// A row in JSON. Whether it failed follows from the state, but is repeated for programs that do
/// not interpret the states.
#[derive(Serialize)]
struct RowDocument {
    vehicle: u16,
    #[serde(with = "row_state")]
    state: RowState,
    failed: bool,
    tries: u8,
    explanation: Option<Text>,
}

impl From<RowReport> for RowDocument {
    fn from(row: RowReport) -> Self {
        Self {
            vehicle: row.vehicle,
            state: row.state,
            failed: row.state.is_failure(),
            tries: row.tries,
            explanation: row.explanation,
        }
    }
}

/// One of the trainee's attempts at a mission.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TryReport {
    /// The number of the attempt, from 1.
    pub attempt: u32,
    /// Its start in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The points; `None` if the attempt has no end.
    pub score: Option<u16>,
    /// The medal, if any.
    pub medal: Option<Medal>,
    /// Whether the mission was passed.
    pub passed: bool,
    /// Seed of hazards and sensors.
    pub seed: u64,
    /// Revision of the mission.
    pub revision: u32,
    /// Whether it was practice or flown by a script: such an attempt is never the best one and uses up no free hints.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_practice: bool,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HintReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// How much the hint reveals, 1 to 3.
    pub level: u8,
    /// The text of the hint.
    pub text: Text,
}

/// A predicted score, and the actual one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PredictionReport {
    /// The prediction, 0 to 1000.
    pub predicted: u16,
    /// The score minus the prediction: positive if the trainee underestimated it.
    pub error: i32,
}

/// The trainee's own goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalReport {
    /// The goal as text.
    pub text: Text,
    /// Whether it was reached.
    pub reached: bool,
    /// The margin by which it was reached or missed.
    pub result: Text,
}

/// An alert that had to be answered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AlertReport {
    /// Mission time when it was raised, in seconds.
    pub at_s: f64,
    pub level: AlertLevel,
    /// The text of the alert.
    pub text: Text,
    /// The time limit for full points, in seconds.
    pub limit_s: f64,
    /// The time until the answer, in seconds; `None` if there was none.
    pub answered_after_s: Option<f64>,
    /// Whether it was answered in time.
    pub in_time: bool,
}

/// The use of one vehicle. Times are in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UseReport {
    pub vehicle: u16,
    /// Time in the air.
    pub airborne_s: f64,
    /// The part of the air time with a task.
    pub productive_s: f64,
    /// The part of the air time without a task for more than [`IDLE_AFTER`](crate::scoring::IDLE_AFTER) at a time.
    pub idle_s: f64,
    /// Whether it crashed or was disarmed in the air.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub crashed: bool,
}

impl From<&VehicleUse> for UseReport {
    fn from(one: &VehicleUse) -> Self {
        let seconds = |time: std::time::Duration| rounded(time.as_secs_f64(), 1);
        Self {
            vehicle: one.vehicle,
            airborne_s: seconds(one.airborne),
            productive_s: seconds(one.productive),
            idle_s: seconds(one.idle),
            crashed: false,
        }
    }
}

impl From<&AlertFact> for AlertReport {
    fn from(alert: &AlertFact) -> Self {
        let seconds = |time: std::time::Duration| rounded(time.as_secs_f64(), 1);
        Self {
            at_s: seconds(alert.at),
            level: alert.level,
            text: alert.text.clone(),
            limit_s: seconds(alert.limit),
            answered_after_s: alert.answered_after.map(seconds),
            in_time: alert.is_in_time(),
        }
    }
}

/// An event of the flight, for the timeline.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EventReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    pub kind: EventKind,
    /// The vehicle, if the event concerns one.
    pub vehicle: Option<u16>,
    /// The event as text.
    pub text: Text,
    /// The related part of the report, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<EventSubject>,
}

/// A part of a report that an event belongs to. Indices start at 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EventSubject {
    /// An alert, by index in `alerts`.
    Alert(usize),
    /// A command, by index in `ledger`.
    Command(usize),
}
