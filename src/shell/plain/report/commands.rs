//! Commands and their outcomes as lines.

use super::LISTED;
use crate::app::State;
use crate::ledger::{EntryId, LedgerEntry, RowState};
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The commands whose outcomes have been printed.
#[derive(Debug, Default)]
pub(super) struct PrintedCommands {
    /// The first command that has not been checked.
    next: Option<EntryId>,
    /// Commands that had not ended at the last call.
    open: Vec<EntryId>,
}

impl PrintedCommands {
    /// The outcomes since the last call.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let ledger = state.session().ledger();
        for entry in ledger.entries().rev() {
            if self.next.is_some_and(|next| entry.id < next) {
                break;
            }
            self.open.push(entry.id);
        }
        self.open.sort_unstable();
        if let Some(newest) = ledger.entries().next_back() {
            self.next = Some(EntryId(newest.id.0 + 1));
        }
        let mut texts = Vec::new();
        self.open.retain(|&id| match ledger.entry(id) {
            Some(entry) if !entry.is_final() => true,
            Some(entry) => {
                texts.push(outcome(entry));
                false
            }
            None => false,
        });
        texts
    }
}

/// The newest commands, on demand.
pub(super) fn newest(state: &State) -> Vec<Text> {
    let entries = state.session().ledger().entries();
    let skipped = entries.len().saturating_sub(LISTED);
    entries.skip(skipped).map(outcome).collect()
}

/// The outcome of a command for a vehicle: its state, and the reason.
type Fate = (Text, Option<Text>);

/// A command and its outcome; vehicles with the same outcome are merged.
fn outcome(entry: &LedgerEntry) -> Text {
    let mut groups: Vec<(Fate, Vec<VehicleId>)> = Vec::new();
    for row in &entry.rows {
        let explanation = row.remark().map(|text| text.regarding(""));
        let state = match row.state {
            RowState::NoEffect => entry.state_of(row),
            state => state.text(),
        };
        let fate = (state, explanation);
        match groups.iter_mut().find(|(known, _)| *known == fate) {
            Some((_, ids)) => ids.push(row.vehicle),
            None => groups.push((fate, vec![row.vehicle])),
        }
    }
    let parts = groups.into_iter().map(|((state, explanation), ids)| {
        let vehicles = ranges(ids);
        let explanation = explanation.map(|text| text.regarding(&vehicles));
        let state = Text::joined(" ", vec![vehicles.into(), state]);
        Text::joined(", ", std::iter::once(state).chain(explanation).collect())
    });
    let parts = Text::joined("; ", parts.collect());
    Text::joined(": ", vec![entry.line.as_str().into(), parts])
}
