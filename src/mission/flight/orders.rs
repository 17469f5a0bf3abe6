//! The quality of the commands that were given.

use std::time::Duration;

use super::journal::{FlightJournal, JournalEntry, JournalSubject};
use crate::ledger::{Ledger, LedgerEntry};
use crate::scoring::{CommandEvent, CommandLog, CommandTally, EventKind, SafetyKind};
use crate::text;
use crate::vehicle::{Severity, Vehicles};

/// The tally of a flight's commands.
#[derive(Debug, Clone, Default)]
pub(super) struct OrderCount {
    log: CommandLog,
    /// The revision of the ledger at the last count.
    counted: Option<u64>,
    tally: CommandTally,
}

impl OrderCount {
    /// Counts the new entries of the ledger.
    pub fn step(&mut self, vehicles: &Vehicles, ledger: &Ledger, journal: &mut FlightJournal) {
        // The ledger changes rarely, and has thousands of rows late in a mission with a swarm.
        if self.counted.replace(ledger.revision()) == Some(ledger.revision()) {
            return;
        }
        for event in self.log.step(journal.now(), vehicles, ledger) {
            match event {
                // The fleet reports refusals to the operator; here they are only recorded.
                CommandEvent::Rejected {
                    command,
                    vehicle,
                    text,
                } => journal.record(JournalEntry {
                    vehicle: Some(vehicle),
                    about: Some(JournalSubject::Command(command)),
                    ..JournalEntry::new(EventKind::Rejected, Severity::Info, text)
                }),
                CommandEvent::Forced { vehicle } => {
                    let text = text!("mission-checks-bypassed");
                    journal.break_rule(SafetyKind::ForcedArm, vehicle, &text);
                }
            }
        }
        self.tally = self.log.tally(ledger);
    }

    /// The tally as of the last step.
    pub fn tally(&self) -> CommandTally {
        self.tally
    }

    /// The tally of the ledger in its current state.
    pub fn tally_of(&self, ledger: &Ledger) -> CommandTally {
        self.log.tally(ledger)
    }

    /// The commands with their mission times.
    pub fn entries<'a>(
        &'a self,
        ledger: &'a Ledger,
    ) -> impl Iterator<Item = (Duration, &'a LedgerEntry)> {
        self.log.entries(ledger)
    }

    /// Mission time of the last command; `None` before the first.
    pub fn last_given(&self) -> Option<Duration> {
        self.log.last_given()
    }
}
