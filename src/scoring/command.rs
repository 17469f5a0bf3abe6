//! Command quality: how many commands were refused, unsafe or given twice.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::ledger::{EntryId, Ledger, LedgerEntry, LedgerRow, Risk, RowState};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle::Vehicles;
use crate::verb::{CountsAs, Verb};

/// The same line to the same vehicle within this time is a duplicate.
const DUPLICATE_WITHIN: Duration = Duration::from_secs(2);

/// Counts of a flight's commands, one per command and vehicle: a command to four vehicles counts four times, whether it
/// is accepted or refused, by the vehicle or by the console.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CommandTally {
    /// All commands; no other count is larger.
    pub given: u32,
    /// Accepted, with an effect.
    pub accepted: u32,
    /// Accepted without an effect, because the goal was already met; such commands do not offset
    /// faults.
    pub empty: u32,
    /// Refused, or unanswered by a vehicle with a link.
    pub rejected: u32,
    /// Refused as the lesson intends, at no cost.
    pub forgiven: u32,
    /// Commands with a risk ([`Risk`]).
    pub dangerous: u32,
    /// Repeated within 2 s.
    pub duplicates: u32,
}

impl CommandTally {
    /// `max(0, 1 - (rejected + 0.5 dangerous + 0.25 duplicates) / (0.25 accepted + 2))`.
    pub fn value(&self) -> f64 {
        let faults: f64 = self.costs().iter().sum();
        (1.0 - faults / (0.25 * f64::from(self.accepted) + 2.0)).max(0.0)
    }

    /// The weighted faults: of refused, of unsafe and of repeated commands.
    pub(super) fn costs(&self) -> [f64; 3] {
        [
            f64::from(self.rejected),
            0.5 * f64::from(self.dangerous),
            0.25 * f64::from(self.duplicates),
        ]
    }

    /// The tally with this many refusals forgiven.
    #[must_use]
    pub fn forgiving(self, refusals: u32) -> Self {
        let forgiven = self.rejected.min(refusals);
        Self {
            rejected: self.rejected - forgiven,
            forgiven,
            ..self
        }
    }

    pub(super) fn value_and_words(&self, vehicles: usize) -> (f64, Text) {
        let counted = self.accepted + self.empty + self.rejected + self.duplicates;
        let mut faults = Vec::new();
        for (count, words) in [
            (
                self.rejected,
                text!("scoring-rejected", count = self.rejected),
            ),
            (
                self.dangerous,
                text!("scoring-unsafe", count = self.dangerous),
            ),
            (
                self.duplicates,
                text!("scoring-twice", count = self.duplicates),
            ),
        ] {
            if count > 0 {
                faults.push(words);
            }
        }
        let words = match (counted, faults.is_empty()) {
            (0, true) => text!("scoring-no-commands"),
            (_, true) if self.forgiven > 0 => text!(
                "scoring-commands-forgiven",
                count = self.given,
                forgiven = self.forgiven
            ),
            (_, true) => text!(
                "scoring-commands-clean",
                count = self.given,
                vehicles = vehicles
            ),
            _ => text!(
                "scoring-commands-faulty",
                faults = Text::joined(", ", faults),
                count = self.given,
                vehicles = vehicles
            ),
        };
        // Without any commands, there are no good ones.
        let value = if counted == 0 { 0.0 } else { self.value() };
        (value, words)
    }
}

/// Follows the ledger during a mission: adds mission times, and notes which vehicles had a link.
#[derive(Debug, Clone, Default)]
pub struct CommandLog {
    given_at: BTreeMap<EntryId, Duration>,
    last_given: Option<Duration>,
    /// Rows that failed; true if the vehicle was out of contact, which excuses the operator.
    excused: BTreeMap<(EntryId, VehicleId), bool>,
}

/// A faulty command, found by [`CommandLog::step`].
#[derive(Debug, Clone, PartialEq)]
pub enum CommandEvent {
    Rejected {
        /// The command that failed.
        command: EntryId,
        vehicle: VehicleId,
        /// The line and the reason.
        text: Text,
    },
    /// Arming was forced or its checks were switched off.
    Forced {
        /// The vehicle that was armed.
        vehicle: VehicleId,
    },
}

impl CommandLog {
    /// Mission time of the last command; `None` before the first.
    pub fn last_given(&self) -> Option<Duration> {
        self.last_given
    }

    /// Reads the ledger again; returns the new events, oldest first.
    pub fn step(
        &mut self,
        now: Duration,
        vehicles: &Vehicles,
        ledger: &Ledger,
    ) -> Vec<CommandEvent> {
        let mut events = Vec::new();
        for entry in ledger.entries() {
            let is_new = !self.given_at.contains_key(&entry.id);
            self.given_at.entry(entry.id).or_insert(now);
            if !entry.is_judged() {
                continue;
            }
            if is_new {
                if entry.verb.counts_as != CountsAs::SelfReport {
                    self.last_given = Some(now);
                }
                if entry.risk == Risk::SkipsChecks {
                    let forced = |row: &LedgerRow| CommandEvent::Forced {
                        vehicle: row.vehicle,
                    };
                    events.extend(entry.rows.iter().map(forced));
                }
            }
            // A refusal because no hint is left is not a piloting fault.
            if is_word(entry) {
                continue;
            }
            for row in &entry.rows {
                events.extend(self.look_at_row(entry, row, vehicles));
            }
        }
        events
    }

    fn look_at_row(
        &mut self,
        entry: &LedgerEntry,
        row: &LedgerRow,
        vehicles: &Vehicles,
    ) -> Option<CommandEvent> {
        let key = (entry.id, row.vehicle);
        if !is_rejected(row) || self.excused.contains_key(&key) {
            return None;
        }
        let unheard = vehicles
            .get(&row.vehicle)
            .is_none_or(|vehicle| vehicle.link.lost);
        self.excused
            .insert(key, unheard && row.state == RowState::TimedOut);
        let reason = row.explanation.clone().unwrap_or_else(|| row.state.text());
        Some(CommandEvent::Rejected {
            command: entry.id,
            vehicle: row.vehicle,
            text: Text::joined(": ", vec![entry.line.as_str().into(), reason]),
        })
    }

    /// The entries of this mission with the mission time at which each was given, oldest first.
    pub fn entries<'a>(
        &'a self,
        ledger: &'a Ledger,
    ) -> impl Iterator<Item = (Duration, &'a LedgerEntry)> {
        ledger
            .entries()
            .filter_map(|entry| Some((*self.given_at.get(&entry.id)?, entry)))
    }

    /// Counts the mission's commands in the current ledger.
    pub fn tally(&self, ledger: &Ledger) -> CommandTally {
        let mut tally = CommandTally::default();
        let mut last: BTreeMap<(VehicleId, &str), (Duration, bool)> = BTreeMap::new();
        let mut standing: BTreeMap<(VehicleId, Slot), &str> = BTreeMap::new();
        let orders = self.entries(ledger);
        for (given_at, entry) in orders.filter(|(_, entry)| entry.is_judged() && !is_word(entry)) {
            for row in &entry.rows {
                let before = last.insert((row.vehicle, &entry.line), (given_at, is_rejected(row)));
                // A retry after a refusal is not a duplicate.
                let duplicate = before.is_some_and(|(at, rejected)| {
                    !rejected && given_at.saturating_sub(at) <= DUPLICATE_WITHIN
                });
                let excused = self.excused.get(&(entry.id, row.vehicle)) == Some(&true);
                let accepted = matches!(
                    row.state,
                    RowState::Accepted | RowState::Done | RowState::InProgress(_)
                );
                tally.given += 1;
                tally.dangerous += u32::from(entry.risk != Risk::None);
                tally.rejected += u32::from(is_rejected(row) && !excused);
                tally.duplicates += u32::from(accepted && duplicate);
                let mut changes_nothing = || match slot(entry.verb) {
                    None => true,
                    Some(slot) => {
                        let before = standing.insert((row.vehicle, slot), &entry.line);
                        before == Some(&*entry.line)
                    }
                };
                let empty = accepted && changes_nothing();
                tally.empty += u32::from(empty && !duplicate);
                tally.accepted += u32::from(accepted && !duplicate && !empty);
            }
        }
        tally
    }
}

/// The part of the vehicle's state that a command sets. Repeating a line for the same slot changes nothing.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Slot {
    /// The vehicle's task, shared by all movement commands.
    Task,
    /// A setting, by its verb.
    Setting(&'static str),
}

fn slot(verb: &'static Verb) -> Option<Slot> {
    match verb.counts_as {
        CountsAs::Task => Some(Slot::Task),
        CountsAs::Setting | CountsAs::PlanChange | CountsAs::Rehearsal => {
            Some(Slot::Setting(verb.name))
        }
        CountsAs::Question
        | CountsAs::Report
        | CountsAs::Word
        | CountsAs::Pledge
        | CountsAs::SelfReport => None,
    }
}

fn is_word(entry: &LedgerEntry) -> bool {
    entry.verb.counts_as.is_said_to_mission()
}

fn is_rejected(row: &LedgerRow) -> bool {
    matches!(row.state, RowState::Refused | RowState::TimedOut)
}
