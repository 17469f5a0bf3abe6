//! The score of a flight: eight components between 0 and 1, their weights, medals and grades.
//!
//! `score = 1000 * hint factor * sum(weight * value)`. The input is the facts of a flight; the
//! output is points with reasons. Only [`CommandLog`] needs more than the facts: it reads the
//! ledger. Points are stored in tenths, so that the components printed in a debrief add up to the
//! score exactly.

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
mod workload;

pub use advice::{Improvement, improvements};
pub use attention::{AlertFact, AlertLevel, attention_value};
pub use command::{CommandEvent, CommandLog, CommandTally};
pub use component::{Component, ComponentScore, ENERGY_NEEDS_OBJECTIVES, Weights};
pub use gate::{Gate, GateSubject};
pub use hints::HintsUsed;
pub use report::{
    AlertReport, ComponentReport, EventKind, EventReport, EventSubject, FlightBackend,
    FlightOutcome, FlownBy, GoalReport, HintReport, LedgerReport, MissionFile, ObjectiveReport,
    PredictionReport, Report, RowReport, ScoreGrade, TryReport, UseReport,
};
use safety::SafetyAdvice;
pub use safety::{SafetyEvent, SafetyKind, SafetyLog, safety_value};
pub use swarm::{SwarmFigures, SwarmTimes};
pub use truth::{MarkReport, ObjectKind, ObjectReport, SquareReport, TrackReport, TruthReport};
pub use utilisation::{IDLE_AFTER, VehicleUse, utilisation_value};
pub use workload::{
    OverloadedStretch, VehicleLoad, WorkloadAnswer, WorkloadCourse, WorkloadReport, utilisation,
    workload_question,
};

use crate::text;
use crate::text::Text;
use serde::{Deserialize, Serialize};

/// The scoring rules of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreRules {
    /// The components' weights; they sum to 1.
    pub weights: Weights,
    /// The maximum flight time for full points.
    pub par_time: Duration,
    /// The maximum energy for full points, in Wh.
    pub par_energy_wh: f64,
    /// The flight time from which no points for time are awarded.
    pub time_limit: Duration,
    /// Points needed for gold, silver and bronze.
    pub medals: Medals,
    /// Conditions for gold besides points.
    pub gold_requires: Vec<Gate>,
    /// The number of refusals that cost nothing, because the lesson causes them.
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
    /// The medal for a number of points; gold only if its other conditions are met.
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

/// A medal. Every medal requires all mandatory objectives.
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

/// The result of one objective.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveFact {
    /// Its id in the mission file.
    pub id: String,
    pub title: Text,
    /// Its weight among the objectives.
    pub value: f64,
    /// The share of it that was reached, 0 to 1.
    pub fraction: f64,
    /// The measured quantity that gates compare, such as cells sampled.
    pub measure: f64,
    /// The unit of the measured quantity; empty for counts and shares.
    pub measure_unit: &'static str,
    /// Whether it was reached.
    pub met: bool,
    /// Whether the mission fails without the objective.
    pub mandatory: bool,
    /// The measured result as text.
    pub result: Text,
    /// The target as text.
    pub target: Text,
    /// Advice on how to reach the objective.
    pub advice: Text,
    /// Its product, if it has one.
    pub product: Option<Product>,
}

/// A product of the trainee's work: a map, or reports.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// Its quality, 0 to 1.
    pub quality: f64,
    /// The reasons for the quality, as text.
    pub words: Text,
    /// Advice on how to improve the product; may be empty.
    pub advice: Text,
    /// Whether the objective measures it, so that a better product reaches the objective.
    pub is_measured: bool,
}

/// Everything about a flight that the score depends on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    /// The results of the objectives, in file order.
    pub objectives: Vec<ObjectiveFact>,
    pub elapsed: Duration,
    /// Energy used by all vehicles in Wh; `None` if no vehicle reports it.
    pub energy_wh: Option<f64>,
    pub safety: Vec<SafetyEvent>,
    pub commands: CommandTally,
    /// Alerts that had to be answered.
    pub alerts: Vec<AlertFact>,
    /// The number of vehicles.
    pub vehicles: usize,
    pub usage: Vec<VehicleUse>,
    /// Hints given on request.
    pub hints: HintsUsed,
    /// Whether the trainee gave up.
    pub given_up: bool,
}

impl Facts {
    /// Whether all mandatory objectives were reached, as every medal requires.
    fn mandatory_met(&self) -> bool {
        self.objectives.iter().all(|o| o.met || !o.mandatory)
    }
}

/// The points of a flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// All components that apply, in the order of [`Component::ALL`].
    pub components: Vec<ComponentScore>,
    /// The sum of the components, in tenths of a point, before hints.
    pub subtotal_tenths: u32,
    /// The factor for hints, 0.7 to 1.
    pub hint_factor: f64,
    /// The points, 0 to 1000.
    pub points: u16,
    /// The medal, if any.
    pub medal: Option<Medal>,
    /// The conditions for gold that are not met, as text; empty for a flight that earns gold if it
    /// ends normally.
    pub gold_missing: Vec<Text>,
}

impl Score {
    /// The value of a component, if it applies.
    pub fn value(&self, component: Component) -> Option<f64> {
        let found = self.components.iter().find(|c| c.component == component)?;
        Some(found.value)
    }
}

/// The points of a perfect flight.
pub const ALL_POINTS: u16 = 1000;
/// The maximum number of points of a flight that harmed people.
pub const HARM_POINTS: u16 = 300;

/// The score of a flight from its facts.
pub fn score(rules: &ScoreRules, facts: &Facts) -> Score {
    let components = component::all(rules, facts);
    let tenths: u32 = components.iter().map(|c| c.points_tenths).sum();
    let hint_factor = facts.hints.factor();
    let earned = rounded_below(f64::from(tenths) * hint_factor / 10.0, ALL_POINTS.into());
    let points = (earned as u16).min(most_points(facts));
    let gold_missing = gold_missing(rules, facts, &components, points);
    let medal = rules.medals.won(points, gold_missing.is_empty());
    Score {
        components,
        subtotal_tenths: tenths,
        hint_factor,
        points,
        medal: medal.filter(|_| facts.mandatory_met()),
        gold_missing,
    }
}

/// The points earned so far in a flight. Mandatory objectives that are still open cap nothing yet: the cap would hide
/// what the other objectives have earned.
pub fn points_so_far(rules: &ScoreRules, facts: &Facts) -> u16 {
    let mut facts = facts.clone();
    for objective in &mut facts.objectives {
        objective.mandatory = false;
    }
    score(rules, &facts).points
}

fn gold_missing(
    rules: &ScoreRules,
    facts: &Facts,
    components: &[ComponentScore],
    points: u16,
) -> Vec<Text> {
    let gates = rules.gold_requires.iter();
    let missing = gates.filter(|gate| !gate.holds(facts, components));
    // Copied commands show no skill.
    let is_copied = facts.hints.gave_commands();
    let copied = is_copied.then(|| text!("gold-without-commands"));
    let has_points = rules.medals.won(points, true) == Some(Medal::Gold);
    let short = (!has_points).then(|| text!("gold-points", points = rules.medals.gold));
    let failed = (!facts.mandatory_met()).then(|| text!("gold-mandatory"));
    let others = copied.into_iter().chain(short).chain(failed);
    let subject = |id: &str| {
        let named = facts.objectives.iter().find(|it| it.id == id);
        named.map(|objective| GateSubject {
            title: objective.title.clone(),
            unit: objective.measure_unit,
        })
    };
    let missing = missing.map(|gate| gate.text(subject));
    missing.chain(others).collect()
}

/// Rounds an amount, but returns `all` only if nothing was lost, so that an incomplete amount never
/// looks complete.
pub(crate) fn rounded_below(amount: f64, all: f64) -> f64 {
    if amount < all - 1e-6 {
        amount.round().min(all - 1.0)
    } else {
        all
    }
}

/// The cap on a flight's points: giving up earns none.
fn most_points(facts: &Facts) -> u16 {
    if facts.given_up {
        0
    } else if facts.safety.iter().any(|event| event.kind.is_harm()) {
        HARM_POINTS
    } else {
        ALL_POINTS
    }
}

#[cfg(test)]
mod tests;
