//! What would have brought more points. Every gain is the difference to the score of the same flight with that
//! one thing mended, so it is what the trainee would really have got. Two things may bring the same points, such as
//! those that need a share of the objectives: the smaller gains are cut so that all together are no more than what
//! everything mended would bring.

use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{
    CommandTally, Facts, HintsUsed, ObjectiveFact, ScoreRules, attention, score, utilisation,
};
use crate::text;
use crate::text::Text;

/// At most this many: more is not read.
const SHOWN: usize = 5;
/// The quality that advice aims at; a perfect map does not exist.
const GOOD_QUALITY: f64 = 0.9;

/// One thing to do better.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Improvement {
    /// The points that it would have brought.
    pub points: u16,
    pub text: Text,
}

/// The improvements of a flight, biggest gain first.
pub fn improvements(rules: &ScoreRules, facts: &Facts) -> Vec<Improvement> {
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

type Change<'a> = Box<dyn Fn(&mut Facts) + 'a>;

/// What to do, and how the flight would have gone with it.
struct Remedy<'a> {
    text: Text,
    changes: Vec<Change<'a>>,
}

impl Remedy<'_> {
    fn mended(&self, facts: &Facts) -> Facts {
        let mut mended = facts.clone();
        for change in &self.changes {
            change(&mut mended);
        }
        mended
    }

    /// The points that it brings to a flight.
    fn gain(&self, rules: &ScoreRules, facts: &Facts) -> u16 {
        let after = score(rules, &self.mended(facts)).points;
        after.saturating_sub(score(rules, facts).points)
    }
}

/// Everything that could be mended, each advice once.
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
    /// Adds a change; one with an advice that is there already belongs to that.
    fn mend(&mut self, text: Text, change: impl Fn(&mut Facts) + 'a) {
        let change: Change = Box::new(change);
        match self.list.iter_mut().find(|remedy| remedy.text == text) {
            Some(remedy) => remedy.changes.push(change),
            None => self.list.push(Remedy {
                text,
                changes: vec![change],
            }),
        }
    }

    fn reach_objectives(&mut self) {
        for (index, objective) in self.facts.objectives.iter().enumerate() {
            // Where the product is what is asked for, one advice is about both.
            let of_both =
                better(objective).filter(|_| objective.advice == objective.quality_advice);
            let text = of_both.unwrap_or_else(|| objective.advice.clone());
            self.mend(text, move |facts| reach(&mut facts.objectives[index]));
        }
    }

    /// While one that must be reached is missed, another one may bring nothing alone.
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
        self.mend(text, move |facts| {
            for &index in &missed {
                reach(&mut facts.objectives[index]);
            }
        });
    }

    fn improve_products(&mut self) {
        for (index, objective) in self.facts.objectives.iter().enumerate() {
            if let Some(text) = better(objective) {
                self.mend(text, move |facts| {
                    facts.objectives[index].quality = Some((GOOD_QUALITY, Text::default()));
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
        self.mend(text, |facts| {
            facts.elapsed = facts.elapsed.min(rules.par_time);
        });
        if let Some(used_wh) = self.facts.energy_wh {
            let over = used_wh - rules.par_energy_wh;
            let text = text!("scoring-use-less", energy = format!("{over:.1}"));
            self.mend(text, move |facts| {
                facts.energy_wh = Some(used_wh.min(rules.par_energy_wh));
            });
        }
    }

    fn keep_rules(&mut self) {
        let kinds: BTreeSet<_> = self.facts.safety.iter().map(|event| event.kind).collect();
        for kind in kinds {
            self.mend(kind.advice(), move |facts| {
                facts.safety.retain(|event| event.kind != kind);
            });
        }
        self.mend(text!("scoring-advice-commands"), |facts| {
            facts.commands = CommandTally {
                given: facts.commands.given,
                accepted: facts.commands.accepted,
                ..CommandTally::default()
            };
        });
    }

    fn use_vehicles(&mut self) {
        if let Some(text) = utilisation::advice(&self.facts.usage) {
            self.mend(text, |facts| {
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
            self.mend(text, |facts| {
                for alert in &mut facts.alerts {
                    alert.answered_after = Some(Duration::ZERO);
                }
            });
        }
    }

    fn ask_no_hints(&mut self) {
        let count = self.facts.hints.count();
        self.mend(text!("scoring-advice-hints", count = count), |facts| {
            facts.hints = HintsUsed::default();
        });
    }
}

fn reach(objective: &mut ObjectiveFact) {
    objective.fraction = 1.0;
    objective.met = true;
}

/// What to say about a product that could be better.
fn better(objective: &ObjectiveFact) -> Option<Text> {
    let (quality, words) = objective.quality.as_ref()?;
    if *quality >= GOOD_QUALITY {
        return None;
    }
    let (from, to) = (format!("{quality:.2}"), format!("{GOOD_QUALITY:.2}"));
    let how = &objective.quality_advice;
    Some(if how.is_empty() {
        text!("scoring-improve-quality", from = from, to = to, now = words)
    } else {
        text!(
            "scoring-improve-quality-how",
            from = from,
            to = to,
            now = words,
            how = how
        )
    })
}
