//! Mines that ground robots pass.

use super::Flight;
use super::journal::JournalEntry;
use crate::mission::ground_truth::MinePassed;
use crate::scoring::{EventKind, SafetyKind};
use crate::text;
use crate::vehicle::Severity;

impl Flight {
    /// Clears the mines under flails, and destroys robots that have set off a mine.
    pub(super) fn step_mines(&mut self) {
        for craft in &mut self.crafts {
            match craft.passage().and_then(|robot| self.world.pass(robot)) {
                Some(MinePassed::Cleared) => {
                    let text = text!("mission-mine-cleared");
                    self.journal.say(JournalEntry {
                        vehicle: Some(craft.id),
                        ..JournalEntry::new(EventKind::Load, Severity::Notice, text)
                    });
                }
                Some(MinePassed::SetOff) => {
                    craft.lost = true;
                    let text = text!("mission-mine-set-off");
                    self.journal.break_rule(SafetyKind::Crash, craft.id, &text);
                }
                None => {}
            }
        }
    }
}
