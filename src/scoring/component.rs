//! The components: their values and the main causes.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use super::{ALL_POINTS, Facts, ScoreRules, attention, rounded_below, safety_value, utilisation};
use crate::text;
use crate::text::Text;

/// The minimum share of the objectives required for points for time, so that quitting early earns none.
const TIME_NEEDS_OBJECTIVES: f64 = 0.6;
/// The minimum share of the objectives required for points for energy.
pub const ENERGY_NEEDS_OBJECTIVES: f64 = 0.8;
/// The cap of the objectives' component if a mandatory objective is missed.
const MISSED_MANDATORY_CAP: f64 = 0.5;

/// One part of the score.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, IntoStaticStr,
)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Component {
    /// The share of the objectives reached.
    Objective,
    /// The quality of the product (map, detections).
    Quality,
    /// The flight time, compared with par.
    Time,
    /// The energy used, compared with par.
    Energy,
    /// Keeping the safety rules.
    Safety,
    /// The quality of the commands.
    Command,
    /// The speed of answers to alerts.
    Attention,
    /// The use of the vehicles.
    Utilisation,
}

impl Component {
    /// All components, in the order of the debrief.
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

    /// Its name in mission files and reports.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Its name on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::Objective => text!("scoring-objective"),
            Self::Quality => text!("scoring-quality"),
            Self::Time => text!("scoring-time"),
            Self::Energy => text!("scoring-energy"),
            Self::Safety => text!("scoring-safety"),
            Self::Command => text!("scoring-command"),
            Self::Attention => text!("scoring-attention"),
            Self::Utilisation => text!("scoring-utilisation"),
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

    /// The weights of the components that apply. The weight of utilisation goes to safety if there
    /// is a single vehicle; the weights of other missing components are distributed over the
    /// remaining components in proportion.
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

/// The value of a component, and the points that it earns.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentScore {
    pub component: Component,
    /// Its weight after the redistribution.
    pub weight: f64,
    /// Its value, 0 to 1.
    pub value: f64,
    /// Its points, in tenths.
    pub points_tenths: u32,
    /// Its main cause, in a few words.
    pub moved_by: Text,
}

/// All components that apply and have a weight.
pub(super) fn all(rules: &ScoreRules, facts: &Facts) -> Vec<ComponentScore> {
    let reached = if_flown(facts, |facts| {
        (objective_value(facts), objective_words(facts))
    });
    let objective = reached.0;
    let values: [Option<(f64, Text)>; 8] = [
        Some(reached),
        quality(facts).map(|product| if_flown(facts, |_| product)),
        Some(time(rules, facts, objective)),
        energy(rules, facts, objective),
        Some(if_flown(facts, |facts| {
            (safety_value(&facts.safety), safety_words(facts))
        })),
        Some(if_flown(facts, |facts| {
            facts.commands.value_and_words(facts.vehicles)
        })),
        attention::value_and_words(&facts.alerts).map(|conduct| if_flown(facts, |_| conduct)),
        Some(utilisation::value_and_words(&facts.usage)),
    ];
    let applies = values.each_ref().map(Option::is_some);
    let weights = rules.weights.applied(applies, facts.vehicles);
    let mut components: Vec<ComponentScore> = Component::ALL
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
            (weight > 0.0).then_some(ComponentScore {
                component,
                weight,
                value,
                points_tenths: 0,
                moved_by,
            })
        })
        .collect();
    share_points(&mut components);
    components
}

/// Rounds the components to tenths that add up to the rounded sum: the components with the largest
/// remainders are rounded up (Hamilton's method).
fn share_points(components: &mut [ComponentScore]) {
    let exact = |c: &ComponentScore| 10_000.0 * c.weight * c.value;
    let sum: f64 = components.iter().map(exact).sum();
    for component in components.iter_mut() {
        component.points_tenths = exact(component).floor() as u32;
    }
    let given: u32 = components.iter().map(|c| c.points_tenths).sum();
    let rounded = rounded_below(sum, 10.0 * f64::from(ALL_POINTS));
    let left = (rounded as u32).saturating_sub(given);
    let mut order: Vec<usize> = (0..components.len()).collect();
    let remainder = |index: &usize| exact(&components[*index]).fract();
    order.sort_by(|a, b| remainder(b).total_cmp(&remainder(a)));
    for index in order.into_iter().take(left as usize) {
        components[index].points_tenths += 1;
    }
}

/// `sum(value * fraction) / sum(value)`, capped if a mandatory objective was missed.
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

fn is_capped(facts: &Facts) -> bool {
    let total: f64 = facts.objectives.iter().map(|o| o.value).sum();
    let reached: f64 = facts.objectives.iter().map(|o| o.value * o.fraction).sum();
    let missed = facts.objectives.iter().any(|o| o.mandatory && !o.met);
    missed && reached > total * MISSED_MANDATORY_CAP
}

fn objective_words(facts: &Facts) -> Text {
    let missed: Vec<Text> = facts
        .objectives
        .iter()
        .filter(|o| !o.met)
        .map(|o| o.title.clone())
        .collect();
    if missed.is_empty() {
        text!("scoring-all-met", count = facts.objectives.len())
    } else {
        let objectives = Text::joined(", ", missed);
        let most = format!("{MISSED_MANDATORY_CAP:.3}");
        if is_capped(facts) {
            text!(
                "scoring-missed-capped",
                objectives = objectives,
                most = most
            )
        } else {
            text!("scoring-missed", objectives = objectives)
        }
    }
}

/// The mean over all products; `None` for a mission without products.
fn quality(facts: &Facts) -> Option<(f64, Text)> {
    let all = facts.objectives.iter().filter_map(|o| o.product.as_ref());
    let (values, words): (Vec<f64>, Vec<Text>) = all
        .map(|product| (product.quality, product.words.clone()))
        .unzip();
    let sum: f64 = values.iter().sum();
    (!values.is_empty()).then(|| (sum / values.len() as f64, Text::joined(", ", words)))
}

/// Why a component earns nothing while too few objectives are reached.
fn too_few(facts: &Facts, needed: f64) -> (f64, Text) {
    let words = if is_capped(facts) {
        text!("scoring-needs-mandatory")
    } else {
        text!("scoring-needs-objectives", percent = percent(needed))
    };
    (0.0, words)
}

fn time(rules: &ScoreRules, facts: &Facts, objective: f64) -> (f64, Text) {
    let (used, par, limit) = (
        facts.elapsed.as_secs_f64(),
        rules.par_time.as_secs_f64(),
        rules.time_limit.as_secs_f64(),
    );
    if objective < TIME_NEEDS_OBJECTIVES {
        return too_few(facts, TIME_NEEDS_OBJECTIVES);
    }
    let value = if used <= par {
        1.0
    } else {
        ((limit - used) / (limit - par)).clamp(0.0, 1.0)
    };
    (value, against_par(used, par, text!("scoring-seconds")))
}

fn energy(rules: &ScoreRules, facts: &Facts, objective: f64) -> Option<(f64, Text)> {
    let used_wh = facts.energy_wh?;
    if objective < ENERGY_NEEDS_OBJECTIVES {
        return Some(too_few(facts, ENERGY_NEEDS_OBJECTIVES));
    }
    let value = (1.0 - (used_wh / rules.par_energy_wh - 1.0) / 0.6).clamp(0.0, 1.0);
    Some((
        value,
        against_par(used_wh, rules.par_energy_wh, text!("scoring-watt-hours")),
    ))
}

fn percent(share: f64) -> String {
    format!("{:.0}", share * 100.0)
}

fn against_par(used: f64, par: f64, unit: Text) -> Text {
    let apart = (used - par).abs();
    // What is over par costs points, so it is never shown as 0.
    let by = if apart < 1.0 {
        format!("{:.1}", (apart * 10.0 - 1e-6).ceil() / 10.0)
    } else {
        format!("{apart:.0}")
    };
    if used <= par && apart < 0.5 {
        text!("scoring-at-par")
    } else if used <= par {
        text!("scoring-inside-par", by = by, unit = unit)
    } else {
        text!("scoring-over-par", by = by, unit = unit)
    }
}

/// A value that only counts if any vehicle has flown: parked vehicles earn nothing.
fn if_flown(facts: &Facts, conduct: impl FnOnce(&Facts) -> (f64, Text)) -> (f64, Text) {
    let flown = facts.usage.iter().any(|one| !one.airborne.is_zero());
    if flown {
        conduct(facts)
    } else {
        (0.0, text!("scoring-none-flown"))
    }
}

fn safety_words(facts: &Facts) -> Text {
    let Some(worst) = facts
        .safety
        .iter()
        .max_by(|a, b| a.lambda().total_cmp(&b.lambda()))
    else {
        return text!("scoring-no-rule-broken");
    };
    match facts.safety.len() - 1 {
        0 => worst.text.clone(),
        more => text!("scoring-rules-broken", worst = &worst.text, more = more),
    }
}
