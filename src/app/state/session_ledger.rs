//! All commands of a session, and the current one of each vehicle.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::ledger::{EntryId, Given, Ledger, LedgerEntry, LedgerRow, RowState, RowUpdate};
use crate::pilot_in_command::Person;
use crate::text;
use crate::vehicle::VehicleId;

/// The ledger with an index by vehicle.
#[derive(Debug, Clone, Default)]
pub struct SessionLedger {
    /// All commands of the session.
    pub(in crate::app) ledger: Ledger,
    /// For each vehicle, its newest ledger entry, that of its newest shown command, and the entries that were under way
    /// when the newest was opened.
    recent: BTreeMap<VehicleId, Vec<EntryId>>,
}

impl SessionLedger {
    /// Opens a ledger entry.
    pub fn open(&mut self, at: Duration, given: Given<'_>, targets: &[VehicleId]) -> EntryId {
        // An instructor's command may turn out not to be shown, so the one before stays in view.
        let keeps_shown = given.by.is_some_and(Person::is_instructor);
        let is_for_vehicles = given.verb.counts_as.is_for_vehicles();
        let entry = self.ledger.open(at, given, targets);
        // Hints and reports concern the mission: they leave the vehicles' commands in view.
        for &id in targets.iter().filter(|_| is_for_vehicles) {
            let shown = self.latest(id).map(|(shown, _)| shown.id);
            let under_way = |&known: &EntryId| {
                keeps_shown && Some(known) == shown
                    || row(&self.ledger, known, id).is_some_and(|(_, row)| !row.state.is_final())
            };
            let recent = self.recent.entry(id).or_default();
            recent.retain(under_way);
            recent.push(entry);
        }
        entry
    }

    /// A vehicle's current command and its row: the newest one under way; otherwise the one that ended last, so that
    /// the end of a survey is not hidden by a `speed` given meanwhile. Commands of others than its pilot do not reach it,
    /// and those that it does not take from an instructor are not shown.
    pub fn latest(&self, vehicle: VehicleId) -> Option<(&LedgerEntry, &LedgerRow)> {
        let recent = self.recent.get(&vehicle)?;
        let found = |&id: &EntryId| {
            let (entry, row) = row(&self.ledger, id, vehicle)?;
            entry.shows(row).then_some((entry, row))
        };
        let mut newest_first = recent.iter().rev().filter_map(found);
        newest_first
            .find(|(_, row)| !row.state.is_final())
            .or_else(|| {
                let all = recent.iter().filter_map(found);
                let reached = all.filter(|(_, row)| row.state != RowState::Barred);
                reached.max_by_key(|(_, row)| (!row.is_over(), row.changed_at))
            })
    }

    /// Ends the commands under way to a vehicle that is dropped.
    pub(super) fn forget(&mut self, vehicle: VehicleId, now: Duration) {
        for entry in self.recent.remove(&vehicle).unwrap_or_default() {
            let known = row(&self.ledger, entry, vehicle).map(|(_, row)| row.tries);
            self.ledger.apply(&RowUpdate {
                entry,
                vehicle,
                state: RowState::TimedOut,
                tries: known.unwrap_or_default(),
                at: now,
                explanation: Some(text!("outcome-forgotten")),
            });
        }
    }
}

fn row(ledger: &Ledger, entry: EntryId, vehicle: VehicleId) -> Option<(&LedgerEntry, &LedgerRow)> {
    let found = ledger.entry(entry)?;
    let row = found.rows.iter().find(|row| row.vehicle == vehicle)?;
    Some((found, row))
}
