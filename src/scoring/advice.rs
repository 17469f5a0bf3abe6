//! Advice: changes that would have gained points. Each gain is the difference from the score of the
//! same flight with one fault corrected. Gains can overlap, for example if components require a
//! share of the objectives. The smaller gains are then cut, so that their sum does not exceed the
//! gain of correcting all faults.

use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{
    CommandTally, Facts, HintsUsed, ObjectiveFact, SafetyAdvice, ScoreRules, attention, score,
    utilisation,
};
use crate::text;
use crate::text::Text;

const SHOWN: usize = 5;
/// The quality that advice aims at, since no map is perfect.
const GOOD_QUALITY: f64 = 0.9;

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Improvement {
    /// The points that the advice would have gained.
    pub points: u16,
    /// The advice as text.
    pub text: Text,
}

/// The improvements of a flight, biggest gain first. For an abandoned flight, the gains as if it had ended normally at
/// that point.
pub fn improvements(rules: &ScoreRules, facts: &Facts) -> Vec<Improvement> {
    let facts = &Facts {
        given_up: false,
        ..facts.clone()
    };
    let remedies = remedies(rules, facts).into_iter();
    let mut alone: Vec<(u16, Remedy)> = remedies
        .map(|remedy| (remedy.gain(rules, facts), remedy))
        .filter(|(gain, _)| *gain > 0)
        .collect();
    alone.sort_by_key(|(gain, _)| Reverse(*gain));
    let all = alone
        .iter()
        .fold(facts.clone(), |flight, (_, remedy)| remedy.mended(&flight));
    let mut left = score(rules, &all)
        .points
        .saturating_sub(score(rules, facts).points);
    let mut found = Vec::new();
    for (gain, remedy) in alone {
        let points = gain.min(left);
        left -= points;
        found.push(Improvement {
            points,
            text: remedy.text,
        });
    }
    found.retain(|improvement| improvement.points > 0);
    found.sort_by_key(|improvement| Reverse(improvement.points));
    found.truncate(SHOWN);
    found
}

type ScoreChange<'a> = Box<dyn Fn(&mut Facts) + 'a>;

/// The subject of a remedy; remedies with the same subject are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RemedyTopic {
    /// An objective, by index.
    Objective(usize),
    /// All missed mandatory objectives.
    Mandatory,
    /// The product of an objective, by index.
    Product(usize),
    Time,
    Energy,
    Safety(SafetyAdvice),
    Commands,
    Vehicles,
    Alerts,
    Hints,
}

/// A piece of advice, and the flight as it would have been if the trainee had followed the advice.
struct Remedy<'a> {
    topic: RemedyTopic,
    text: Text,
    changes: Vec<ScoreChange<'a>>,
}

impl Remedy<'_> {
    fn mended(&self, facts: &Facts) -> Facts {
        let mut mended = facts.clone();
        for change in &self.changes {
            change(&mut mended);
        }
        mended
    }

    fn gain(&self, rules: &ScoreRules, facts: &Facts) -> u16 {
        let after = score(rules, &self.mended(facts)).points;
        after.saturating_sub(score(rules, facts).points)
    }
}

fn remedies<'a>(rules: &'a ScoreRules, facts: &'a Facts) -> Vec<Remedy<'a>> {
    let mut remedies = Remedies {
        facts,
        list: Vec::new(),
    };
    remedies.reach_objectives();
    remedies.reach_what_must_be(rules);
    remedies.improve_products();
    remedies.reach_par(rules);
    remedies.keep_rules();
    remedies.use_vehicles();
    remedies.answer_alerts();
    remedies.ask_no_hints();
    remedies.list
}

struct Remedies<'a> {
    facts: &'a Facts,
    list: Vec<Remedy<'a>>,
}

impl<'a> Remedies<'a> {
    /// Adds a change, merging it with one on the same subject.
    fn mend(&mut self, topic: RemedyTopic, text: Text, change: impl Fn(&mut Facts) + 'a) {
        let change: ScoreChange = Box::new(change);
        match self.list.iter_mut().find(|remedy| remedy.topic == topic) {
            Some(remedy) => remedy.changes.push(change),
            None => self.list.push(Remedy {
                topic,
                text,
                changes: vec![change],
            }),
        }
    }

    fn reach_objectives(&mut self) {
        for (index, objective) in self.facts.objectives.iter().enumerate() {
            let (topic, text) = match ProductAdvice::of(objective) {
                // One piece of advice covers both.
                Some(better) if better.is_measured => (RemedyTopic::Product(index), better.text),
                _ => (RemedyTopic::Objective(index), objective.advice.clone()),
            };
            self.mend(topic, text, move |facts| {
                reach(&mut facts.objectives[index]);
            });
        }
    }

    /// Combines objectives with a missed mandatory one, since they may gain nothing without it.
    fn reach_what_must_be(&mut self, rules: &ScoreRules) {
        let objectives = self.facts.objectives.iter().enumerate();
        let missed = objectives.filter(|(_, objective)| objective.mandatory && !objective.met);
        let (missed, ids): (Vec<usize>, Vec<&str>) =
            missed.map(|(index, o)| (index, o.id.as_str())).unzip();
        let brings = self.list.iter().any(|it| it.gain(rules, self.facts) > 0);
        if missed.len() < 2 || brings {
            return;
        }
        let text = text!("scoring-advice-mandatory", objectives = ids.join(", "));
        self.mend(RemedyTopic::Mandatory, text, move |facts| {
            for &index in &missed {
                reach(&mut facts.objectives[index]);
            }
        });
    }

    fn improve_products(&mut self) {
        for (index, objective) in self.facts.objectives.iter().enumerate() {
            if let Some(better) = ProductAdvice::of(objective) {
                self.mend(RemedyTopic::Product(index), better.text, move |facts| {
                    if let Some(product) = &mut facts.objectives[index].product {
                        product.quality = GOOD_QUALITY;
                    }
                });
            }
        }
    }

    fn reach_par(&mut self, rules: &'a ScoreRules) {
        let late = self.facts.elapsed.saturating_sub(rules.par_time);
        let text = text!(
            "scoring-be-faster",
            seconds = format!("{:.0}", late.as_secs_f64())
        );
        self.mend(RemedyTopic::Time, text, |facts| {
            facts.elapsed = facts.elapsed.min(rules.par_time);
        });
        if let Some(used_wh) = self.facts.energy_wh {
            let over = used_wh - rules.par_energy_wh;
            let text = text!("scoring-use-less", energy = format!("{over:.1}"));
            self.mend(RemedyTopic::Energy, text, move |facts| {
                facts.energy_wh = Some(used_wh.min(rules.par_energy_wh));
            });
        }
    }

    fn keep_rules(&mut self) {
        let kinds: BTreeSet<_> = self.facts.safety.iter().map(|event| event.kind).collect();
        for kind in kinds {
            let advice = kind.advice();
            self.mend(RemedyTopic::Safety(advice), advice.text(), move |facts| {
                facts.safety.retain(|event| event.kind != kind);
            });
        }
        let text = command_advice(&self.facts.commands);
        self.mend(RemedyTopic::Commands, text, |facts| {
            facts.commands = CommandTally {
                given: facts.commands.given,
                accepted: facts.commands.accepted,
                ..CommandTally::default()
            };
        });
    }

    fn use_vehicles(&mut self) {
        if let Some(text) = utilisation::advice(&self.facts.usage) {
            self.mend(RemedyTopic::Vehicles, text, |facts| {
                let longest = facts.usage.iter().map(|one| one.airborne).max();
                for one in &mut facts.usage {
                    one.airborne = longest.unwrap_or_default();
                    one.productive = one.airborne;
                    one.idle = Duration::ZERO;
                }
            });
        }
    }

    fn answer_alerts(&mut self) {
        if let Some(text) = attention::advice(&self.facts.alerts) {
            self.mend(RemedyTopic::Alerts, text, |facts| {
                for alert in &mut facts.alerts {
                    alert.answered_after = Some(Duration::ZERO);
                }
            });
        }
    }

    fn ask_no_hints(&mut self) {
        let count = self.facts.hints.count();
        let text = text!("scoring-advice-hints", count = count);
        self.mend(RemedyTopic::Hints, text, |facts| {
            facts.hints = HintsUsed::default();
        });
    }
}

/// The advice against the fault of commands that cost most.
fn command_advice(tally: &CommandTally) -> Text {
    let [refused, dangerous, repeated] = tally.costs();
    if refused >= dangerous.max(repeated) {
        text!("scoring-advice-commands")
    } else if dangerous >= repeated {
        text!("scoring-advice-unsafe")
    } else {
        text!("scoring-advice-twice")
    }
}

fn reach(objective: &mut ObjectiveFact) {
    objective.fraction = 1.0;
    objective.met = true;
}

struct ProductAdvice {
    text: Text,
    /// Whether the objective measures the product.
    is_measured: bool,
}

impl ProductAdvice {
    /// Advice on the product of an objective; `None` if it has no product, or a good one.
    fn of(objective: &ObjectiveFact) -> Option<Self> {
        let product = objective
            .product
            .as_ref()
            .filter(|product| product.quality < GOOD_QUALITY)?;
        let from = format!("{:.2}", product.quality);
        let to = format!("{GOOD_QUALITY:.2}");
        let (now, how) = (&product.words, &product.advice);
        let text = if how.is_empty() {
            text!("scoring-improve-quality", from = from, to = to, now = now)
        } else {
            text!(
                "scoring-improve-quality-how",
                from = from,
                to = to,
                now = now,
                how = how
            )
        };
        Some(Self {
            text,
            is_measured: product.is_measured,
        })
    }
}
