//! What happened at a seat, in order.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::{Deed, OrderId, Outcome, Words};

/// The maximum number of entries that a seat keeps, and a desk for each seat; the oldest are dropped.
pub const KEPT: usize = 20_000;
/// The maximum number of entries in one message.
pub const BATCH: usize = 32;

/// An entry of a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Its number, counted from 1 without gaps.
    pub number: u64,
    /// The time of the mission; `None` without a flight.
    pub clock_s: Option<f64>,
    /// What happened at the seat.
    pub what: Happening,
}

/// What happened at a seat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Happening {
    /// A flight began, with a mission or without one.
    Started {
        /// The id of the mission; `None` without one.
        mission: Option<Words>,
    },
    /// The trainee gave a command.
    Command {
        /// The line as the trainee gave it.
        line: Words,
    },
    /// A vehicle did not do what was commanded.
    Failed {
        /// The line that the vehicle did not carry out.
        line: Words,
        /// The number of the vehicle.
        vehicle: u16,
    },
    /// An objective was met.
    Objective {
        /// The title of the objective.
        title: Words,
    },
    /// The mission ended, with a final score.
    Ended {
        /// Its score, 0 to 1000.
        score: u16,
        /// Whether the mission was passed.
        passed: bool,
    },
    /// An order of the desk ended.
    Order {
        /// The id that the desk gave the order.
        id: OrderId,
        /// What the desk asked for, for a desk that was opened later.
        deed: Deed,
        /// How the order ended at the seat.
        outcome: Outcome,
        /// More about the outcome, such as the reason that a vehicle gave; in the language of the seat.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<Words>,
    },
}

/// A seat's own journal.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Journal {
    entries: VecDeque<Entry>,
    last: u64,
}

/// Entries on their way to the desk.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JournalBatch {
    /// The number of the oldest entry that the seat still keeps.
    pub kept_from: u64,
    /// The entries, in the order of their numbers and without gaps.
    pub entries: Vec<Entry>,
}

impl Journal {
    /// Adds an entry with the next number.
    pub fn note(&mut self, clock_s: Option<f64>, what: Happening) {
        self.last += 1;
        self.entries.push_back(Entry {
            number: self.last,
            clock_s: clock_s.filter(|it| it.is_finite()),
            what,
        });
        if self.entries.len() > KEPT {
            self.entries.pop_front();
        }
    }

    /// The number of the newest entry; 0 if there is none.
    pub fn last(&self) -> u64 {
        self.last
    }

    /// The number of the oldest entry that is kept.
    fn kept_from(&self) -> u64 {
        self.last + 1 - self.entries.len() as u64
    }

    /// The entries, oldest first.
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter()
    }

    /// The next entries from this number on, at most [`BATCH`]; `None` if there are none yet.
    pub fn from(&self, number: u64) -> Option<JournalBatch> {
        let kept_from = self.kept_from();
        let skipped = usize::try_from(number.max(kept_from) - kept_from).unwrap_or(usize::MAX);
        let entries: Vec<Entry> = self
            .entries
            .iter()
            .skip(skipped)
            .take(BATCH)
            .cloned()
            .collect();
        (!entries.is_empty()).then_some(JournalBatch { kept_from, entries })
    }
}

/// The desk's copy of a seat's journal: every entry once, in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JournalCopy {
    entries: VecDeque<Entry>,
    last: u64,
}

impl JournalCopy {
    /// The number of the newest entry; 0 if there is none.
    pub fn last(&self) -> u64 {
        self.last
    }

    /// The entries, oldest first.
    pub fn entries(&self) -> impl DoubleEndedIterator<Item = &Entry> {
        self.entries.iter()
    }

    /// The number of earlier entries that are not there: the seat had dropped them before they were asked for, or the
    /// desk has dropped them since.
    pub fn missing(&self) -> u64 {
        self.last.saturating_sub(self.entries.len() as u64)
    }

    /// The number of the entry that comes next.
    pub fn next_number(&self) -> u64 {
        // A seat may send any number.
        self.last.saturating_add(1)
    }

    /// Takes in entries, and returns those that are new. Entries after a gap are left out: they are asked for again.
    pub fn receive(&mut self, batch: JournalBatch) -> Vec<Entry> {
        if batch.kept_from > self.next_number() {
            self.last = batch.kept_from - 1;
        }
        let mut new = Vec::new();
        for entry in batch.entries {
            if entry.number == self.next_number() {
                self.last = entry.number;
                new.push(entry.clone());
                self.entries.push_back(entry);
                if self.entries.len() > KEPT {
                    self.entries.pop_front();
                }
            }
        }
        new
    }
}
