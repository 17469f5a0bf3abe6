//! The trainee's earlier attempts.

use super::MissionPage;
use crate::scoring::{Medal, TryReport};
use crate::text;
use crate::text::Text;

/// The number of newest attempts shown; the best one is added if it is older.
const SHOWN: usize = 5;

impl MissionPage<'_> {
    /// Adds the earlier attempts before the flight, if there are any.
    pub(super) fn tries(&mut self) {
        let is_read = self.state.session.activity.is_none() || self.awaits_launch();
        let Some(tries) = self
            .state
            .training
            .tries
            .get(&self.mission.id)
            .filter(|_| is_read)
        else {
            return;
        };
        let from = tries.len().saturating_sub(SHOWN);
        let best = self.state.training().best_try(&self.mission.id);
        let earlier = best.filter(|best| !tries[from..].contains(best));
        let rows: Vec<(Text, Text)> = earlier
            .into_iter()
            .chain(&tries[from..])
            .map(|one| row(one, best == Some(one)))
            .collect();
        self.text.title(&text!("mission-tries"));
        self.text.rows(&rows);
    }
}

/// The time and the result of an attempt.
fn row(one: &TryReport, best: bool) -> (Text, Text) {
    // The day and the time without seconds: `2026-11-20 14:03`.
    let to_the_minute: String = one.when.chars().take(16).collect();
    let when = to_the_minute.replace('T', " ");
    let Some(score) = one.score else {
        return (when.into(), text!("mission-try-unfinished"));
    };
    if one.is_practice {
        return (when.into(), text!("mission-try-practice", score = score));
    }
    let medal = one.medal.map_or(text!("debrief-no-medal"), Medal::title);
    let result = if best {
        text!("mission-try-best", score = score, medal = medal)
    } else {
        text!("mission-try", score = score, medal = medal)
    };
    (when.into(), result)
}
