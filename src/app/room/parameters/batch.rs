//! Setting many values in sequence: a vehicle accepts only a few commands at a time.

use std::collections::VecDeque;

use super::Parameters;
use crate::app::state::ParameterSetting;
use crate::ledger::{EntryId, Ledger, LedgerEntry, LedgerRow, RowState};
use crate::vehicle::VehicleId;

/// The maximum number of commands under way. A command that waits behind others may miss its deadline before it is
/// sent, so fewer are sent where answers are slow.
const MOST_UNDER_WAY: usize = 8;

/// The values being set.
#[derive(Debug, Clone)]
pub struct Batch {
    waiting: VecDeque<ParameterSetting>,
    under_way: Vec<(EntryId, ParameterSetting)>,
    /// The number of commands that may be under way now.
    window: usize,
    confirmed: usize,
    /// Number of values that vehicles refused or did not answer.
    failed: usize,
}

impl Default for Batch {
    fn default() -> Self {
        Self {
            waiting: VecDeque::new(),
            under_way: Vec::new(),
            window: 1,
            confirmed: 0,
            failed: 0,
        }
    }
}

impl Batch {
    /// Adds values to the batch.
    pub fn add(&mut self, settings: Vec<ParameterSetting>) {
        self.waiting.extend(settings);
    }

    /// The next value, if one may be sent now.
    pub fn take_next(&mut self) -> Option<ParameterSetting> {
        if self.under_way.len() < self.window {
            self.waiting.pop_front()
        } else {
            None
        }
    }

    /// Records that a value was sent with this ledger entry.
    pub fn sent(&mut self, entry: EntryId, setting: ParameterSetting) {
        self.under_way.push((entry, setting));
    }

    /// Counts a value that could not be sent because its vehicles are gone.
    pub fn not_sent(&mut self, setting: &ParameterSetting) {
        self.failed += setting.vehicles.len();
    }

    /// The numbers of confirmed and of failed values, once nothing is under way.
    pub fn result(&self) -> Option<(usize, usize)> {
        let is_over = self.under_way.is_empty();
        is_over.then_some((self.confirmed, self.failed))
    }

    /// Stops sending; returns the number of values not sent.
    pub fn stop(&mut self) -> usize {
        let left = self.waiting.len();
        self.waiting.clear();
        left
    }

    /// Whether a command belongs to the batch.
    pub fn has(&self, entry: EntryId) -> bool {
        self.under_way.iter().any(|(known, _)| *known == entry)
    }

    /// The number of parameters without an answer yet.
    pub fn left(&self) -> usize {
        self.waiting.len() + self.under_way.len()
    }
}

impl Batch {
    /// Counts commands that have ended.
    pub fn count(&mut self, ledger: &Ledger, known: &Parameters) {
        let is_over = |(id, _): &mut (EntryId, ParameterSetting)| {
            // A command dropped from the ledger ended long ago.
            ledger.entry(*id).is_none_or(LedgerEntry::is_final)
        };
        let ended: Vec<_> = self.under_way.extract_if(.., is_over).collect();
        for (id, setting) in ended {
            let rows = ledger.entry(id).map_or(&[][..], |entry| &entry.rows);
            let done_rows = rows.iter().filter(|row| row.state == RowState::Done);
            let done = done_rows.count();
            let (unsent, unanswered) = to_give_again(rows, &setting, known);
            self.confirmed += done;
            self.failed += rows.len() - done - unsent.len() - unanswered.len();
            self.window = if done == rows.len() {
                (self.window * 2).min(MOST_UNDER_WAY)
            } else {
                1
            };
            let again = setting.again;
            for (vehicles, again) in [(unsent, again), (unanswered, again.saturating_sub(1))] {
                if !vehicles.is_empty() {
                    let setting = ParameterSetting::new(&setting.name, setting.value, vehicles);
                    self.waiting
                        .push_back(ParameterSetting { again, ..setting });
                }
            }
        }
    }
}

/// The vehicles to which a value must be sent again: first those whose command expired before it
/// was sent, then those that have the parameter but did not answer, while repeats are left.
fn to_give_again(
    rows: &[LedgerRow],
    setting: &ParameterSetting,
    known: &Parameters,
) -> (Vec<VehicleId>, Vec<VehicleId>) {
    let timed_out = rows.iter().filter(|row| row.state == RowState::TimedOut);
    let (unsent, mut unanswered): (Vec<&LedgerRow>, Vec<&LedgerRow>) =
        timed_out.partition(|row| row.tries == 0);
    let has = |row: &&LedgerRow| known.get(row.vehicle, &setting.name).is_some();
    unanswered.retain(|row| setting.again > 0 && has(row));
    let ids = |rows: Vec<&LedgerRow>| rows.into_iter().map(|row| row.vehicle).collect();
    (ids(unsent), ids(unanswered))
}
