//! What would have brought more points. Every gain is the difference to the score of the same flight with that
//! one thing mended, so it is what the trainee would really have got.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::{CommandTally, Facts, Rules, score};

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
    pub text: String,
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
fn remedies(rules: &Rules, facts: &Facts) -> Vec<(String, Facts)> {
    let mut remedies = Vec::new();
    let mut mend = |text: String, change: &dyn Fn(&mut Facts)| {
        let mut mended = facts.clone();
        change(&mut mended);
        remedies.push((text, mended));
    };
    for (index, objective) in facts.objectives.iter().enumerate() {
        mend(objective.advice.clone(), &|facts| {
            facts.objectives[index].fraction = 1.0;
            facts.objectives[index].met = true;
        });
    }
    if let Some((quality, words)) = facts
        .quality
        .as_ref()
        .filter(|(quality, _)| *quality < GOOD_QUALITY)
    {
        let text = format!("Bring the quality from {quality:.2} to {GOOD_QUALITY:.2} ({words}).");
        mend(text, &|facts| {
            facts.quality = Some((GOOD_QUALITY, String::new()));
        });
    }
    if facts.elapsed > rules.par_time {
        let late_s = facts.elapsed.saturating_sub(rules.par_time).as_secs_f64();
        let text = format!("Be {late_s:.0} s faster: that is par.");
        mend(text, &|facts| facts.elapsed = rules.par_time);
    }
    if let Some(used) = facts.energy_wh.filter(|&used| used > rules.par_energy_wh) {
        let text = format!(
            "Use {:.1} Wh less: that is par.",
            used - rules.par_energy_wh
        );
        mend(text, &|facts| facts.energy_wh = Some(rules.par_energy_wh));
    }
    let kinds: BTreeSet<_> = facts.safety.iter().map(|event| event.kind).collect();
    for kind in kinds {
        mend(kind.advice().to_owned(), &|facts| {
            facts.safety.retain(|event| event.kind != kind);
        });
    }
    if facts.commands.value() < 1.0 {
        let text =
            "Give commands that can work, once: read the reason of a refusal first.".to_owned();
        mend(text, &|facts| {
            facts.commands = CommandTally {
                accepted: facts.commands.accepted,
                ..CommandTally::default()
            };
        });
    }
    remedies
}
