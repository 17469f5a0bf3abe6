//! The trainee's own tries, as bars: the comparison that tells most.

use super::Page;
use super::layout::right;
use crate::scoring::{Report, TryReport, grade};

/// Points per column of a bar.
const PER_COLUMN: u16 = 20;
/// Tries that are shown: the newest, and the best if it is not among them.
const SHOWN: usize = 8;

impl Page<'_> {
    pub(super) fn tries(&mut self, report: &Report) {
        if report.tries.len() < 2 {
            return;
        }
        self.heading("debrief-tries");
        for one in shown(&report.tries) {
            let number = right(&one.attempt.to_string(), 4);
            let words = match one.score {
                Some(score) => {
                    let bar = "#".repeat(usize::from(score / PER_COLUMN));
                    format!("{number}  {score:>4} {}  {bar}", grade(score))
                }
                None => format!("{number}     -"),
            };
            self.line(&words);
        }
        self.gap();
    }
}

fn shown(tries: &[TryReport]) -> Vec<&TryReport> {
    let from = tries.len().saturating_sub(SHOWN);
    // Of equal ones the first was the best for longest.
    let best = tries.iter().rev().max_by_key(|one| one.score);
    let earlier = best.filter(|best| !tries[from..].contains(best));
    earlier.into_iter().chain(&tries[from..]).collect()
}
