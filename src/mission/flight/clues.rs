//! Hints given on request.

use std::time::Duration;

use super::Flight;
use super::journal::JournalEntry;
use crate::mission::hint::{Clue, next_clue};
use crate::mission::{ClueProgress, Mission, Phase};
use crate::scoring::{EventKind, HintsUsed};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The hints given so far.
#[derive(Debug, Clone)]
pub(super) struct CluesGiven {
    /// The number of this trainee's attempt, from 1.
    attempt: u32,
    given: Vec<GivenClue>,
}

#[derive(Debug, Clone)]
struct GivenClue {
    at: Duration,
    /// Its index among the mission's hints on request.
    index: usize,
    /// The advice at that time.
    beside: RunningAdvice,
}

/// The automatic advice: the phase of the flight, the index of the lesson's step, and the hint.
#[derive(Debug, Clone, PartialEq)]
struct RunningAdvice {
    phase: Phase,
    lesson_step: Option<usize>,
    hint: Option<Text>,
}

impl Default for CluesGiven {
    fn default() -> Self {
        Self {
            attempt: 1,
            given: Vec::new(),
        }
    }
}

impl CluesGiven {
    pub fn set_attempt(&mut self, attempt: u32) {
        self.attempt = attempt.max(1);
    }

    pub fn attempt(&self) -> u32 {
        self.attempt
    }

    /// The cost of the hints so far. On the first attempt, only the hint with the whole command
    /// costs points; in lessons about the console, all hints are free.
    pub fn used(&self, mission: &Mission) -> HintsUsed {
        let mut used = HintsUsed {
            free_level: match (self.attempt, mission.summary.tier) {
                (1, 0) => 3,
                (1, _) => 2,
                _ => 0,
            },
            ..HintsUsed::default()
        };
        for (_, clue) in self.all(&mission.advice.clues) {
            if let Some(count) = used.levels.get_mut(usize::from(clue.level).wrapping_sub(1)) {
                *count += 1;
            }
        }
        used
    }

    /// The clues given, oldest first, each with its mission time in seconds.
    pub fn all<'a>(&'a self, clues: &'a [Clue]) -> impl Iterator<Item = (f64, &'a Clue)> {
        let given = self.given.iter();
        given.filter_map(|given| Some((given.at.as_secs_f64(), clues.get(given.index)?)))
    }
}

impl Flight {
    /// Gives the next suitable hint; returns its text, or the reason for the refusal.
    pub(super) fn give_clue(&mut self) -> Result<Text, Text> {
        if !self.mission.advice.gives_hints {
            return Err(text!("deed-exam-hint"));
        }
        let index = self.next_clue().ok_or_else(|| text!("deed-no-hint"))?;
        let clue = &self.mission.advice.clues[index];
        let price = self.clues.used(&self.mission).price(clue.level);
        let text = text!(
            "mission-hint-given",
            level = clue.level,
            percent = (price * 100.0).round() as u32,
            hint = self.filled(&clue.text)
        );
        let given = GivenClue {
            at: self.elapsed,
            index,
            beside: self.running_advice(),
        };
        self.clues.given.push(given);
        let kind = EventKind::Hint;
        self.journal
            .record(JournalEntry::new(kind, Severity::Info, text.clone()));
        Ok(text)
    }

    /// The state of the hints, for the mission panel.
    pub(super) fn clue_progress(&self) -> ClueProgress {
        let clues = &self.mission.advice.clues;
        let used = self.clues.used(&self.mission);
        let next = self.next_clue().map(|index| clues[index].level);
        let given = self.clues.all(clues);
        ClueProgress {
            given: given
                .map(|(_, clue)| (clue.level, self.filled(&clue.text)))
                .collect(),
            is_news: self
                .clues
                .given
                .last()
                .is_some_and(|it| it.beside == self.running_advice()),
            next: next.map(|level| (level, used.price(level))),
            factor: used.factor(),
        }
    }

    fn running_advice(&self) -> RunningAdvice {
        let standings = self.standings();
        RunningAdvice {
            phase: self.phase(&standings),
            lesson_step: self.lesson_step,
            hint: self.hint(&standings),
        }
    }

    fn next_clue(&self) -> Option<usize> {
        let given: Vec<usize> = self.clues.given.iter().map(|given| given.index).collect();
        let standings = self.standings();
        let is_open = |id: &str| {
            let objectives = self.mission.objectives.iter().zip(&standings);
            let mut named = objectives.filter(|(objective, _)| objective.id == id);
            named.next().is_none_or(|(_, standing)| !standing.met)
        };
        let phase: Phase = self.phase(&standings);
        next_clue(&self.mission.advice.clues, &given, phase, is_open)
    }
}
