//! The components: what each is worth and what moved it.

use std::fmt::Write as _;
use std::time::Duration;

use super::{Facts, Rules, safety_value};

/// Time is worth nothing to a flight that reached less of its objectives than this (no credit for quitting early).
const TIME_NEEDS_OBJECTIVES: f64 = 0.6;
/// The same for energy.
const ENERGY_NEEDS_OBJECTIVES: f64 = 0.8;
/// A missed mandatory objective caps the objectives' component here.
const MISSED_MANDATORY_CAP: f64 = 0.5;

/// One part of the score.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Component {
    /// What was reached.
    Objective,
    /// How good the product is (map, detections).
    Quality,
    /// How fast.
    Time,
    /// How frugal.
    Energy,
    /// Which rules were kept.
    Safety,
    /// How clean the commands were.
    Command,
    /// How fast alerts were answered.
    Attention,
    /// How well all vehicles were used.
    Utilisation,
}

impl Component {
    /// All of them, in the order of the debrief.
    pub const ALL: [Self; 8] = [
        Self::Objective,
        Self::Quality,
        Self::Time,
        Self::Energy,
        Self::Safety,
        Self::Command,
        Self::Attention,
        Self::Utilisation,
    ];

    /// Its name in mission files, reports and debriefs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Objective => "objective",
            Self::Quality => "quality",
            Self::Time => "time",
            Self::Energy => "energy",
            Self::Safety => "safety",
            Self::Command => "command",
            Self::Attention => "attention",
            Self::Utilisation => "utilisation",
        }
    }
}

/// A weight per component, in the order of [`Component::ALL`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights(pub [f64; 8]);

impl Default for Weights {
    fn default() -> Self {
        Self([0.35, 0.15, 0.10, 0.05, 0.20, 0.05, 0.05, 0.05])
    }
}

impl Weights {
    /// The weight of one component.
    pub fn of(&self, component: Component) -> f64 {
        self.0[component as usize]
    }

    /// The weights of the components that apply: a single vehicle's utilisation goes to safety, what else does
    /// not apply is shared among the rest in proportion.
    fn applied(&self, applies: [bool; 8], vehicles: usize) -> [f64; 8] {
        let mut weights = self.0;
        if vehicles <= 1 {
            weights[Component::Safety as usize] += weights[Component::Utilisation as usize];
            weights[Component::Utilisation as usize] = 0.0;
        }
        for (weight, applies) in weights.iter_mut().zip(applies) {
            if !applies {
                *weight = 0.0;
            }
        }
        let sum: f64 = weights.iter().sum();
        if sum > 0.0 {
            weights = weights.map(|weight| weight / sum);
        }
        weights
    }
}

/// One component of a score.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentScore {
    /// Which.
    pub component: Component,
    /// Its weight after sharing out what does not apply.
    pub weight: f64,
    /// 0 to 1.
    pub value: f64,
    /// Its points, in tenths.
    pub points_tenths: u32,
    /// What moved it, in a few words.
    pub moved_by: String,
}

/// All components that apply and have a weight.
pub(super) fn all(rules: &Rules, facts: &Facts) -> Vec<ComponentScore> {
    let objective = objective_value(facts);
    let values: [Option<(f64, String)>; 8] = [
        Some((objective, objective_words(facts))),
        facts.quality.clone(),
        Some(time(rules, facts.elapsed, objective)),
        facts.energy_wh.map(|used| energy(rules, used, objective)),
        Some((safety_value(&facts.safety), safety_words(facts))),
        Some(facts.commands.value_and_words()),
        None,
        None,
    ];
    let applies = values.each_ref().map(Option::is_some);
    let weights = rules.weights.applied(applies, facts.vehicles);
    Component::ALL
        .into_iter()
        .zip(values)
        .filter_map(|(component, value)| {
            let (value, moved_by) = value?;
            let weight = weights[component as usize];
            let value = if value.is_finite() {
                value.clamp(0.0, 1.0)
            } else {
                0.0
            };
            (weight > 0.0).then(|| ComponentScore {
                component,
                weight,
                value,
                points_tenths: (10_000.0 * weight * value).round() as u32,
                moved_by,
            })
        })
        .collect()
}

/// `sum(value * fraction) / sum(value)`, capped where a mandatory objective was missed.
fn objective_value(facts: &Facts) -> f64 {
    let total: f64 = facts.objectives.iter().map(|o| o.value).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let reached: f64 = facts.objectives.iter().map(|o| o.value * o.fraction).sum();
    if facts.objectives.iter().any(|o| o.mandatory && !o.met) {
        (reached / total).min(MISSED_MANDATORY_CAP)
    } else {
        reached / total
    }
}

fn objective_words(facts: &Facts) -> String {
    let missed: Vec<&str> = facts
        .objectives
        .iter()
        .filter(|o| !o.met)
        .map(|o| o.id.as_str())
        .collect();
    if missed.is_empty() {
        format!("all {} objectives met", facts.objectives.len())
    } else {
        format!("missed: {}", missed.join(", "))
    }
}

fn time(rules: &Rules, elapsed: Duration, objective: f64) -> (f64, String) {
    let (used, par, limit) = (
        elapsed.as_secs_f64(),
        rules.par_time.as_secs_f64(),
        rules.time_limit.as_secs_f64(),
    );
    if objective < TIME_NEEDS_OBJECTIVES {
        return (0.0, "needs .60 of the objectives".to_owned());
    }
    let value = if used <= par {
        1.0
    } else {
        ((limit - used) / (limit - par)).clamp(0.0, 1.0)
    };
    (value, against_par(used, par, "s"))
}

fn energy(rules: &Rules, used_wh: f64, objective: f64) -> (f64, String) {
    if objective < ENERGY_NEEDS_OBJECTIVES {
        return (0.0, "needs .80 of the objectives".to_owned());
    }
    let value = (1.0 - (used_wh / rules.par_energy_wh - 1.0) / 0.6).clamp(0.0, 1.0);
    (value, against_par(used_wh, rules.par_energy_wh, "Wh"))
}

fn against_par(used: f64, par: f64, unit: &str) -> String {
    let side = if used <= par { "inside" } else { "over" };
    format!("{:.0} {unit} {side} par", (used - par).abs())
}

fn safety_words(facts: &Facts) -> String {
    let Some(worst) = facts
        .safety
        .iter()
        .max_by(|a, b| a.lambda().total_cmp(&b.lambda()))
    else {
        return "no rule broken".to_owned();
    };
    let mut words = worst.text.clone();
    if facts.safety.len() > 1 {
        let _ = write!(words, "; {} more", facts.safety.len() - 1);
    }
    words
}
