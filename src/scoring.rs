//! The score of a flight: eight components between 0 and 1, their weights, medals and grades.
//!
//! `score = 1000 * hint factor * sum(weight * value)`. The facts of a flight go in, points and the reasons for them come out;
//! nothing here knows mission files or telemetry formats except [`CommandLog`] (reads the ledger).
//! Points are kept in tenths, so that the components printed in a debrief add up to the score exactly.

use std::time::Duration;

mod advice;
mod attention;
mod command;
mod component;
mod gate;
mod hints;
mod report;
mod safety;
mod swarm;
mod truth;
mod utilisation;

pub use advice::{Improvement, improvements};
pub use attention::{AlertFact, AlertLevel, attention_value};
pub use command::{CommandEvent, CommandLog, CommandTally};
pub use component::{Component, ComponentScore, ENERGY_NEEDS_OBJECTIVES, Weights};
pub use gate::Gate;
pub use hints::HintsUsed;
pub use report::{
    AlertReport, ComponentReport, EventKind, EventReport, EventSubject, FlightBackend, FlownBy,
    GoalReport, HintReport, LedgerReport, MissionFile, ObjectiveReport, PredictionReport, Report,
    RowReport, ScoreGrade, TryReport, UseReport,
};
use safety::SafetyAdvice;
pub use safety::{SafetyEvent, SafetyKind, SafetyLog, safety_value};
pub use swarm::{SwarmFigures, SwarmTimes};
pub use truth::{MarkReport, ObjectKind, ObjectReport, SquareReport, TrackReport, TruthReport};
pub use utilisation::{VehicleUse, utilisation_value};

use crate::text;
use crate::text::Text;
use serde::{Deserialize, Serialize};

/// How a mission wants to be scored.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreRules {
    /// The components' weights; they sum to 1.
    pub weights: Weights,
    /// A flight this short gets all points for time.
    pub par_time: Duration,
    /// A flight this frugal gets all points for energy, in Wh.
    pub par_energy_wh: f64,
    /// A flight this long gets none for time.
    pub time_limit: Duration,
    /// Points needed for gold, silver and bronze.
    pub medals: Medals,
    /// What gold needs besides points.
    pub gold_requires: Vec<Gate>,
    /// Refusals that cost nothing, because the lesson asks for them.
    pub free_refusals: u32,
}

/// Points needed for each medal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Medals {
    pub gold: u16,
    pub silver: u16,
    pub bronze: u16,
}

impl Medals {
    /// The medal for so many points; gold only where nothing else is missing for it.
    pub fn won(self, points: u16, gold_open: bool) -> Option<Medal> {
        if points >= self.gold && gold_open {
            Some(Medal::Gold)
        } else if points >= self.silver {
            Some(Medal::Silver)
        } else if points >= self.bronze {
            Some(Medal::Bronze)
        } else {
            None
        }
    }
}

/// A medal. Every medal needs all mandatory objectives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Medal {
    Bronze,
    Silver,
    Gold,
}

impl Medal {
    /// Its name in lower case.
    pub fn title(self) -> Text {
        match self {
            Self::Bronze => text!("scoring-bronze"),
            Self::Silver => text!("scoring-silver"),
            Self::Gold => text!("scoring-gold"),
        }
    }
}

/// How one objective went.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveFact {
    /// Its id in the mission file.
    pub id: String,
    pub title: Text,
    /// Its share of the objectives' points.
    pub value: f64,
    /// How far it was reached, 0 to 1.
    pub fraction: f64,
    /// The measured quantity that gates may compare, such as cells sampled.
    pub measure: f64,
    /// Whether it was reached.
    pub met: bool,
    /// Whether the mission fails without it.
    pub mandatory: bool,
    /// The measured result in words.
    pub result: Text,
    /// What was asked for, in words.
    pub target: Text,
    /// What would have reached it, in words.
    pub advice: Text,
    /// Its product; `None` where it makes none.
    pub product: Option<Product>,
}

/// What an objective has the trainee make: a map, reports.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// How good it is, 0 to 1.
    pub quality: f64,
    /// What the quality comes from, in words.
    pub words: Text,
    /// What would make it better, in words; may be empty.
    pub advice: Text,
    /// Whether the objective measures it, so that what makes it better reaches the objective.
    pub is_measured: bool,
}

/// Everything about a flight that the score depends on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    /// How the objectives went, in the mission's order.
    pub objectives: Vec<ObjectiveFact>,
    /// How much mission time has passed.
    pub elapsed: Duration,
    /// Energy used by all vehicles in Wh; `None` where no vehicle reports it.
    pub energy_wh: Option<f64>,
    /// The rules that were broken.
    pub safety: Vec<SafetyEvent>,
    /// How the commands went.
    pub commands: CommandTally,
    /// Alerts that had to be answered.
    pub alerts: Vec<AlertFact>,
    /// How many vehicles took part.
    pub vehicles: usize,
    /// How each of them was used.
    pub usage: Vec<VehicleUse>,
    /// Hints that were asked for.
    pub hints: HintsUsed,
    /// Whether the trainee gave up.
    pub given_up: bool,
}

/// The points of a flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// All components that apply, in the order of [`Component::ALL`].
    pub components: Vec<ComponentScore>,
    /// What the components sum to, in tenths of a point, before hints.
    pub subtotal_tenths: u32,
    /// What hints leave of it, 0.7 to 1.
    pub hint_factor: f64,
    /// The points, 0 to 1000.
    pub points: u16,
    /// The medal, if it earned one.
    pub medal: Option<Medal>,
    /// What kept it from gold although the points would do, in words.
    pub gold_missing: Vec<Text>,
}

impl Score {
    /// The value of a component, if it applies.
    pub fn value(&self, component: Component) -> Option<f64> {
        let found = self.components.iter().find(|c| c.component == component)?;
        Some(found.value)
    }
}

/// A flight that did people harm gets no more than this.
pub const HARM_POINTS: u16 = 300;

/// Scores a flight by its facts.
pub fn score(rules: &ScoreRules, facts: &Facts) -> Score {
    let components = component::all(rules, facts);
    let tenths: u32 = components.iter().map(|c| c.points_tenths).sum();
    let hint_factor = facts.hints.factor();
    let earned = (f64::from(tenths) * hint_factor / 10.0).round();
    let points = (earned as u16).min(most_points(facts));
    let mandatory_met = facts.objectives.iter().all(|o| o.met || !o.mandatory);
    let gold_missing: Vec<Text> = rules
        .gold_requires
        .iter()
        .filter(|gate| !gate.holds(facts, &components))
        .map(Gate::text)
        .collect();
    let medal = rules.medals.won(points, gold_missing.is_empty());
    Score {
        components,
        subtotal_tenths: tenths,
        hint_factor,
        points,
        medal: medal.filter(|_| mandatory_met),
        gold_missing,
    }
}

/// What a flight cannot get more than: giving up earns nothing.
fn most_points(facts: &Facts) -> u16 {
    if facts.given_up {
        0
    } else if facts.safety.iter().any(|event| event.kind.is_harm()) {
        HARM_POINTS
    } else {
        1000
    }
}

#[cfg(test)]
mod tests;
