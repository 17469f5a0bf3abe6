//! The report of a finished flight: what `sortie run --json` prints, what is stored, what a debrief is made from.
//!
//! Words are kept as texts, so that a debrief can be read in any language; a document has the English ones.
//! Numbers are rounded to fixed decimals when the report is made, so that equal flights give equal bytes.

use serde::{Deserialize, Serialize};

use super::{AlertFact, AlertLevel, Improvement, Medal, SwarmFigures, TruthReport, VehicleUse};
use crate::ledger::RowState;
use crate::text::{Text, rounded};

mod kind;
mod row_state;
mod soundness;

pub use kind::{EventKind, FlightBackend, FlownBy, MissionFile, ScoreGrade};

/// A flight's result with every point explained. The order of the fields is the order in the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Id of the mission.
    pub mission: String,
    /// Its revision; results compare only within one.
    pub revision: u32,
    /// Seed of the hazards and sensors.
    pub seed: u64,
    /// What flew; the shell sets it where it was not the embedded simulator.
    pub backend: FlightBackend,
    /// What gave the commands; `None` where that is not known, as in old records.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flown_by: Option<FlownBy>,
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
    /// The medal, if one was earned.
    pub medal: Option<Medal>,
    /// Mission time used, in seconds.
    pub sim_time_s: f64,
    /// The objectives, in the mission's order.
    pub objectives: Vec<ObjectiveReport>,
    /// The components of the score; their points sum to `subtotal`.
    pub components: Vec<ComponentReport>,
    /// The score before hints, to a tenth.
    pub subtotal: f64,
    /// What hints leave of it, 0.7 to 1.
    pub hint_factor: f64,
    /// Every command of the flight.
    pub ledger: Vec<LedgerReport>,
    /// What happened, oldest first.
    pub events: Vec<EventReport>,
    /// Title of the mission.
    pub title: Text,
    /// `passed`, `failed`, `timed out`, `abandoned`, or `flying` for a flight that is not over.
    pub outcome: Text,
    /// The grade of the score.
    pub grade: ScoreGrade,
    /// How many vehicles took part.
    pub vehicles: usize,
    /// Mission time allowed, in seconds.
    pub time_limit_s: f64,
    /// Mission time that gets all points, in seconds.
    pub par_time_s: f64,
    /// Energy used by all vehicles in Wh, where they report it.
    pub energy_wh: Option<f64>,
    /// Energy that gets all points, in Wh.
    pub par_energy_wh: f64,
    /// What gold still needs besides points.
    pub gold_missing: Vec<Text>,
    /// What to do better, biggest gain first.
    pub improvements: Vec<Improvement>,
    /// Which try at the mission it was, from 1.
    pub attempt: u32,
    /// The hints that were asked for, oldest first.
    pub hints: Vec<HintReport>,
    /// What the trainee expected, and how far off that was.
    pub prediction: Option<PredictionReport>,
    /// What the trainee wanted to reach, and whether it was.
    pub goal: Option<GoalReport>,
    /// The alerts that had to be answered, oldest first.
    pub alerts: Vec<AlertReport>,
    /// How each vehicle was used.
    pub usage: Vec<UseReport>,
    /// How the operator handled the swarm.
    pub swarm: SwarmFigures,
    /// What the world really was, for the map of the debrief.
    pub truth: TruthReport,
    /// The mission that drills what this one needs, if there is one; set by the shell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drill: Option<String>,
    /// The trainee's tries at this revision of the mission, this one among them, oldest first; set by the shell.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tries: Vec<TryReport>,
    /// Real time that the run took, in seconds; set by the shell, the only field that may differ between equal runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_time_s: Option<f64>,
}

/// How one objective went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectiveReport {
    /// Its id in the mission file.
    pub id: String,
    pub title: Text,
    /// Whether the mission fails without it.
    pub mandatory: bool,
    /// Whether it was reached.
    pub met: bool,
    /// The measured result in words.
    pub result: Text,
    /// What was asked for, in words.
    pub target: Text,
    /// Points within the objectives' component.
    pub points: f64,
    /// The most that there are.
    pub points_max: f64,
}

/// One component of the score.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ComponentReport {
    /// Name of the component.
    pub name: Text,
    /// Its weight after sharing out what does not apply.
    pub weight: f64,
    /// How well it went, 0 to 1.
    pub value: f64,
    /// Its points of 1000, to a tenth.
    pub points: f64,
    /// What raised or lowered it, in words.
    pub moved_by: Text,
}

/// One command as it was given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LedgerReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// The line as it was typed.
    pub line: String,
    /// How it went with each vehicle.
    pub rows: Vec<RowReport>,
}

/// One vehicle's part in a command.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "RowDocument")]
pub struct RowReport {
    pub vehicle: u16,
    /// What became of the command.
    #[serde(with = "row_state")]
    pub state: RowState,
    /// How often it was sent.
    pub tries: u8,
    /// The reason of a refusal, or a remark.
    pub explanation: Option<Text>,
}

/// A row as documents have it: whether it failed follows from its state, and is written for programs that do not know the
/// states.
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

/// One of the trainee's tries at a mission.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TryReport {
    /// Which of the tries it was, from 1.
    pub attempt: u32,
    /// When it began, in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The points; `None` where it has no end.
    pub score: Option<u16>,
    /// The medal, if one was earned.
    pub medal: Option<Medal>,
    /// Whether the mission was passed.
    pub passed: bool,
    /// Seed of hazards and sensors.
    pub seed: u64,
    /// Revision of the mission.
    pub revision: u32,
    /// Whether it was flown for practice or by a script: such a try is never the best one and uses up no free hints.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_practice: bool,
}

/// A hint that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HintReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// How much it gave away, 1 to 3.
    pub level: u8,
    /// The words of the hint.
    pub text: Text,
}

/// A score as it was predicted, and as it came.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PredictionReport {
    /// What was expected, 0 to 1000.
    pub predicted: u16,
    /// What came less what was expected: above 0, the trainee can do more than they think.
    pub error: i32,
}

/// A goal of the trainee's own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GoalReport {
    /// The goal in words.
    pub text: Text,
    /// Whether it was reached.
    pub reached: bool,
    /// By how much it was reached or missed.
    pub result: Text,
}

/// An alert that had to be answered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AlertReport {
    /// When it came: mission time, in seconds.
    pub at_s: f64,
    /// How much it mattered.
    pub level: AlertLevel,
    /// The words of the alert.
    pub text: Text,
    /// An answer within this time gets everything, in seconds.
    pub limit_s: f64,
    /// How long the answer took, in seconds; `None` where none came.
    pub answered_after_s: Option<f64>,
    /// Whether that was in time.
    pub in_time: bool,
}

/// How one vehicle was used. Times are in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UseReport {
    pub vehicle: u16,
    /// Time in the air.
    pub airborne_s: f64,
    /// Of that, with a task.
    pub productive_s: f64,
    /// Of that, without one for longer than 30 s at a time.
    pub idle_s: f64,
    /// Whether it fell or was made to.
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
    /// What it is about.
    pub kind: EventKind,
    /// Which vehicle, where it is about one.
    pub vehicle: Option<u16>,
    /// What happened, in words.
    pub text: Text,
    /// What other part of the report tells of the same, if one does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<EventSubject>,
}

/// A part of a report that an event belongs to. Places are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EventSubject {
    /// An alert, by its place in `alerts`.
    Alert(usize),
    /// A command, by its place in `ledger`.
    Command(usize),
}
