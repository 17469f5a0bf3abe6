//! Hints that the trainee asks for.

use super::Flight;
use crate::mission::hint::{Clue, next_clue};
use crate::mission::{ClueProgress, Phase};
use crate::scoring::{EventKind, HintsUsed};
use crate::text;
use crate::text::Text;

impl Flight {
    /// What hints have cost so far.
    pub(super) fn hints_used(&self) -> HintsUsed {
        let mut used = HintsUsed {
            free: self.attempt == 1,
            ..HintsUsed::default()
        };
        for (_, clue) in self.given_clues() {
            if let Some(count) = used.levels.get_mut(usize::from(clue.level).wrapping_sub(1)) {
                *count += 1;
            }
        }
        used
    }

    /// The clues that were given, oldest first, with the mission time in seconds.
    pub(super) fn given_clues(&self) -> impl Iterator<Item = (f64, &Clue)> {
        let given = self.clues_given.iter();
        given.filter_map(|(at, index)| {
            let clue = self.mission.clues.get(*index)?;
            Some((at.as_secs_f64(), clue))
        })
    }

    /// Gives the next clue that fits.
    pub(super) fn give_clue(&mut self) -> Result<Text, Text> {
        let index = self.next_clue().ok_or_else(|| text!("deed-no-hint"))?;
        let clue = &self.mission.clues[index];
        let price = self.hints_used().price(clue.level);
        let text = self.filled(&clue.text);
        let text = text!(
            "mission-hint-given",
            level = clue.level,
            percent = (price * 100.0).round() as u32,
            hint = text
        );
        self.clues_given.push((self.elapsed, index));
        self.record(EventKind::Hint, None, text.clone());
        Ok(text)
    }

    /// How the hints stand, for the mission panel.
    pub(super) fn clue_progress(&self) -> ClueProgress {
        let used = self.hints_used();
        let next = self
            .next_clue()
            .map(|index| self.mission.clues[index].level);
        ClueProgress {
            given: self
                .given_clues()
                .map(|(_, clue)| (clue.level, self.filled(&clue.text)))
                .collect(),
            next: next.map(|level| (level, used.price(level))),
            factor: used.factor(),
        }
    }

    fn next_clue(&self) -> Option<usize> {
        let given: Vec<usize> = self.clues_given.iter().map(|(_, index)| *index).collect();
        let standings = self.standings();
        let is_open = |id: &str| {
            let objectives = self.mission.objectives.iter().zip(&standings);
            let mut named = objectives.filter(|(objective, _)| objective.id == id);
            named.next().is_none_or(|(_, standing)| !standing.met)
        };
        let phase: Phase = self.phase(&standings);
        next_clue(&self.mission.clues, &given, phase, is_open)
    }
}
