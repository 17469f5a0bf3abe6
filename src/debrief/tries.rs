//! The trainee's own attempts as bars, for comparison.

use super::DebriefPage;
use super::layout::right;
use crate::scoring::{Report, TryReport};

/// Points per column of a bar.
const PER_COLUMN: u16 = 20;
/// The maximum number of attempts that are shown: the newest, and the best if it is not among them.
const SHOWN: usize = 8;

impl DebriefPage<'_> {
    pub(super) fn tries(&mut self, report: &Report) {
        // An attempt without a score was abandoned before its end.
        let tries = report.tries.iter();
        let scored: Vec<(&TryReport, u16)> =
            tries.filter_map(|one| Some((one, one.score?))).collect();
        if scored.len() < 2 {
            return;
        }
        self.heading("debrief-tries");
        for (one, score) in shown(&scored) {
            let bar = "#".repeat(usize::from(score / PER_COLUMN));
            let (number, kind) = if one.is_practice {
                (String::new(), self.locale.say("debrief-practice"))
            } else {
                (one.attempt.to_string(), String::new())
            };
            let number = right(&number, 4);
            let words = format!("{number}  {score:>4}  {bar} {kind}");
            self.line(words.trim_end());
        }
        self.gap();
    }
}

fn shown<'a>(tries: &[(&'a TryReport, u16)]) -> Vec<(&'a TryReport, u16)> {
    let from = tries.len().saturating_sub(SHOWN);
    // Of equally good attempts the first one counts, because it was the best for the longest time.
    let counted = tries.iter().filter(|(one, _)| !one.is_practice);
    let best = counted.rev().max_by_key(|(_, score)| *score);
    let earlier = best.filter(|best| !tries[from..].contains(best));
    earlier.into_iter().chain(&tries[from..]).copied().collect()
}
