//! The report of a finished flight: what `sortie run --json` prints, what is stored, what a debrief is made from.
//!
//! Words are kept as texts, so that a debrief can be read in any language; a document has the English ones.
//! Numbers are rounded to fixed decimals when the report is made, so that equal flights give equal bytes.

use serde::{Deserialize, Serialize};

use super::{Improvement, Medal};
use crate::text::Text;

/// A flight's result with every point explained. The order of the fields is the order in the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Id of the mission.
    pub mission: String,
    /// Its revision; results compare only within one.
    pub revision: u32,
    /// Seed of the hazards and sensors.
    pub seed: u64,
    /// What flew: `embedded`, `ardupilot` or `live`. The shell corrects it; `embedded` to begin with.
    pub backend: String,
    /// Whether all mandatory objectives were met.
    pub passed: bool,
    /// 0 to 1000.
    pub score: u16,
    /// The medal, if one was earned.
    pub medal: Option<Medal>,
    /// Mission time used, in seconds.
    pub sim_time_s: f64,
    /// The objectives, in the mission's order.
    pub objectives: Vec<ObjectiveReport>,
    /// The components of the score; their points sum to `score` before rounding to a whole number.
    pub components: Vec<ComponentReport>,
    /// Every command of the flight.
    pub ledger: Vec<LedgerReport>,
    /// What happened, oldest first.
    pub events: Vec<EventReport>,
    /// Title of the mission.
    pub title: Text,
    /// `passed`, `failed`, `timed out`, `abandoned`, or `flying` for a flight that is not over.
    pub outcome: Text,
    /// S, A, B, C, D or F.
    pub grade: String,
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
    /// Real time that the run took, in seconds; set by the shell, the only field that may differ between equal runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_time_s: Option<f64>,
}

/// One objective.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ObjectiveReport {
    /// Its id in the mission file.
    pub id: String,
    /// Its title.
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
    /// Its name.
    pub name: Text,
    /// Its weight after sharing out what does not apply.
    pub weight: f64,
    /// 0 to 1.
    pub value: f64,
    /// Its points of 1000, to a tenth.
    pub points: f64,
    /// What moved it.
    pub moved_by: Text,
}

/// One command as it was given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LedgerReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// The whole line.
    pub line: String,
    /// How it went with each vehicle.
    pub rows: Vec<RowReport>,
}

/// One vehicle's part in a command.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowReport {
    /// Which vehicle.
    pub vehicle: u16,
    /// How it ended, in words.
    pub state: Text,
    /// Whether that is otherwise than the operator wanted.
    pub failed: bool,
    /// How often it was sent.
    pub tries: u8,
    /// The reason of a refusal, or a remark.
    pub explanation: Option<Text>,
}

/// Something that happened.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EventReport {
    /// Mission time, in seconds.
    pub at_s: f64,
    /// `objective`, `alert`, `rule`, `rejected` or `phase`.
    pub kind: String,
    /// Which vehicle, where it is about one.
    pub vehicle: Option<u16>,
    /// In words.
    pub text: Text,
}

/// A number rounded to `decimals` places; what is not finite becomes 0.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10f64.powi(decimals);
    let rounded = (value * scale).round() / scale;
    // Adding zero turns -0.0, which would print its sign, into 0.0.
    if rounded.is_finite() {
        rounded + 0.0
    } else {
        0.0
    }
}
