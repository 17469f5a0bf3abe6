//! What would have brought more points. Every gain is the difference to the score of the same flight with that
//! one thing mended, so it is what the trainee would really have got.

use std::collections::BTreeSet;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{CommandTally, Facts, HintsUsed, Rules, attention, score, utilisation};
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
    /// What to do.
    pub text: Text,
}

/// The improvements of a flight, biggest gain first.
pub fn improvements(rules: &Rules, facts: &Facts) -> Vec<Improvement> {
    let points = score(rules, facts).points;
    let mut found: Vec<Improvement> = remedies(rules, facts)
        .into_iter()
        .map(|(text, mended)| Improvement {
            points: score(rules, &mended).points.saturating_sub(points),
            text,
        })
        .filter(|improvement| improvement.points > 0)
        .collect();
    found.sort_by_key(|improvement| std::cmp::Reverse(improvement.points));
    found.truncate(SHOWN);
    found
}

/// The same flight with one thing mended, for each thing that could be.
fn remedies(rules: &Rules, facts: &Facts) -> Vec<(Text, Facts)> {
    let mut remedies = Remedies {
        facts,
        list: Vec::new(),
    };
    for (index, objective) in facts.objectives.iter().enumerate() {
        remedies.mend(objective.advice.clone(), |facts| {
            facts.objectives[index].fraction = 1.0;
            facts.objectives[index].met = true;
        });
    }
    if let Some((quality, words)) = &facts.quality
        && *quality < GOOD_QUALITY
    {
        let (from, to) = (format!("{quality:.2}"), format!("{GOOD_QUALITY:.2}"));
        let how = &facts.quality_advice;
        let text = if how.is_empty() {
            text!("scoring-improve-quality", from = from, to = to, now = words)
        } else {
            text!(
                "scoring-improve-quality-how",
                from = from,
                to = to,
                now = words,
                how = how
            )
        };
        remedies.mend(text, |facts| {
            facts.quality = Some((GOOD_QUALITY, Text::default()));
        });
    }
    remedies.reach_par(rules);
    remedies.keep_rules();
    remedies.use_vehicles();
    remedies.answer_alerts();
    remedies.ask_no_hints();
    remedies.list
}

struct Remedies<'a> {
    facts: &'a Facts,
    list: Vec<(Text, Facts)>,
}

impl Remedies<'_> {
    fn mend(&mut self, text: Text, change: impl FnOnce(&mut Facts)) {
        let mut mended = self.facts.clone();
        change(&mut mended);
        self.list.push((text, mended));
    }

    fn reach_par(&mut self, rules: &Rules) {
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
            self.mend(text, |facts| {
                facts.energy_wh = Some(used_wh.min(rules.par_energy_wh));
            });
        }
    }

    fn keep_rules(&mut self) {
        let kinds: BTreeSet<_> = self.facts.safety.iter().map(|event| event.kind).collect();
        for kind in kinds {
            self.mend(kind.advice(), |facts| {
                facts.safety.retain(|event| event.kind != kind);
            });
        }
        self.mend(text!("scoring-advice-commands"), |facts| {
            facts.commands = CommandTally {
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
