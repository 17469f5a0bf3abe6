//! The commands that put plans on board and rehearse them, as the flight has seen them.
//!
//! Times are those of the mission's steps, so that a record gives the same account as the flight.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::ledger::{EntryId, Ledger, LedgerRow, RowState};
use crate::vehicle::VehicleId;
use crate::verb::CountsAs;

/// The plan commands of one flight.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlanLog {
    /// The revision of the ledger at the last look.
    looked: Option<u64>,
    rows: BTreeMap<(EntryId, VehicleId), PlanRow>,
}

/// One vehicle's part in a command.
#[derive(Debug, Clone, Copy)]
struct PlanRow {
    is_rehearsal: bool,
    /// When the command was given, or last seen waiting: a rehearsal waits for uploads.
    begun: Duration,
    /// The time at which its end was seen, and its state then.
    ended: Option<(Duration, RowState)>,
}

impl PlanLog {
    /// A flight without plan commands.
    pub const NONE: Self = Self {
        looked: None,
        rows: BTreeMap::new(),
    };

    /// Notes the new commands, and the outcome of earlier ones.
    pub fn step(&mut self, ledger: &Ledger, now: Duration) {
        if self.looked.replace(ledger.revision()) == Some(ledger.revision()) {
            return;
        }
        for entry in ledger.entries() {
            let is_rehearsal = match entry.verb.counts_as {
                CountsAs::PlanChange => false,
                CountsAs::Rehearsal => true,
                CountsAs::Task
                | CountsAs::Setting
                | CountsAs::Question
                | CountsAs::Report
                | CountsAs::Word
                | CountsAs::Pledge
                | CountsAs::SelfReport => continue,
            };
            for row in &entry.rows {
                self.note(entry.id, row, is_rehearsal, now);
            }
        }
    }

    fn note(&mut self, entry: EntryId, row: &LedgerRow, is_rehearsal: bool, now: Duration) {
        let known = self.rows.entry((entry, row.vehicle)).or_insert(PlanRow {
            is_rehearsal,
            begun: now,
            ended: None,
        });
        if row.state == RowState::Queued {
            known.begun = now;
        }
        if known.ended.is_none() && row.state.is_final() {
            known.ended = Some((now, row.state));
        }
    }

    /// Whether a command has changed the plan of a vehicle, or may still do so.
    pub fn is_changed(&self, vehicle: VehicleId) -> bool {
        self.changes(vehicle).next().is_some()
    }

    /// Whether the plan that a vehicle carries now was rehearsed without a fault.
    pub fn is_rehearsed(&self, vehicle: VehicleId) -> bool {
        let mut rehearsals = self.of(vehicle).filter(|row| row.is_rehearsal);
        rehearsals.any(|rehearsal| {
            let is_good = matches!(rehearsal.ended, Some((_, RowState::Done)));
            let is_before = |change: &PlanRow| {
                let ended = change.ended;
                ended.is_some_and(|(ended, _)| ended <= rehearsal.begun)
            };
            is_good && self.changes(vehicle).all(is_before)
        })
    }

    /// The commands that change a vehicle's plan. Refused commands are left out, because they do
    /// not change it.
    fn changes(&self, vehicle: VehicleId) -> impl Iterator<Item = &PlanRow> {
        let is_refused = |row: &PlanRow| matches!(row.ended, Some((_, RowState::Refused)));
        let rows = self.of(vehicle);
        rows.filter(move |row| !row.is_rehearsal && !is_refused(row))
    }

    fn of(&self, vehicle: VehicleId) -> impl Iterator<Item = &PlanRow> {
        let rows = self.rows.iter();
        rows.filter(move |((_, of), _)| *of == vehicle)
            .map(|(_, row)| row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::RowUpdate;
    use crate::mission::fake::given;

    /// A flight's ledger, checked after every change, a second apart.
    #[derive(Default)]
    struct Watch {
        ledger: Ledger,
        log: PlanLog,
        now: Duration,
    }

    impl Watch {
        fn give(&mut self, line: &str) -> EntryId {
            let entry = self.ledger.open(self.now, given(line), &[1]);
            self.look();
            entry
        }

        fn end(&mut self, entry: EntryId, state: RowState) {
            self.ledger.apply(&RowUpdate {
                entry,
                vehicle: 1,
                state,
                tries: 1,
                at: self.now,
                explanation: None,
            });
            self.look();
        }

        fn look(&mut self) {
            self.now += Duration::from_secs(1);
            self.log.step(&self.ledger, self.now);
        }
    }

    #[test]
    fn a_plan_is_rehearsed_until_it_is_changed() {
        let mut watch = Watch::default();
        let rehearsal = watch.give("1 plan rehearse");
        assert!(!watch.log.is_rehearsed(1), "it is still being flown");
        watch.end(rehearsal, RowState::Done);
        assert!(watch.log.is_rehearsed(1) && !watch.log.is_changed(1));
        let refused = watch.give("1 plan upload a.plan");
        assert!(!watch.log.is_rehearsed(1) && watch.log.is_changed(1));
        watch.end(refused, RowState::Refused);
        assert!(watch.log.is_rehearsed(1) && !watch.log.is_changed(1));
        let change = watch.give("1 plan clear");
        let early = watch.give("1 plan rehearse");
        watch.end(early, RowState::InProgress(0));
        watch.end(change, RowState::Done);
        watch.end(early, RowState::Done);
        assert!(!watch.log.is_rehearsed(1), "flown before the change ended");
    }

    /// A rehearsal that waits for an upload flies the new plan.
    #[test]
    fn a_rehearsal_counts_from_when_it_is_flown() {
        let mut watch = Watch::default();
        let change = watch.give("1 plan upload a.plan");
        let rehearsal = watch.give("1 plan rehearse");
        watch.end(rehearsal, RowState::Queued);
        watch.end(change, RowState::Done);
        // A rehearsal may begin and end between two checks.
        watch.end(rehearsal, RowState::Done);
        assert!(watch.log.is_rehearsed(1));
    }

    #[test]
    fn a_rehearsal_with_a_conflict_and_a_question_do_not_count() {
        let mut watch = Watch::default();
        let rehearsal = watch.give("1 plan rehearse");
        watch.end(rehearsal, RowState::NoEffect);
        let question = watch.give("1 plan show");
        watch.end(question, RowState::Done);
        assert!(!watch.log.is_rehearsed(1) && !watch.log.is_changed(1));
    }
}
