//! Commands and their outcomes as lines.

use std::collections::BTreeMap;
use std::time::Duration;

use super::LISTED;
use crate::app::State;
use crate::ledger::{EntryId, ForeignCommand, ForeignId, LedgerEntry, LedgerItem, RowState};
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// How long the line of another station's command waits for the answer.
const ANSWERED_WITHIN: Duration = Duration::from_secs(2);

/// The commands whose outcomes have been printed.
#[derive(Debug, Default)]
pub(super) struct PrintedCommands {
    /// The first command that has not been checked.
    next: Option<EntryId>,
    /// Commands that had not ended at the last call.
    open: Vec<EntryId>,
    /// The printed states of the commands of other stations.
    foreign: BTreeMap<ForeignId, RowState>,
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
        texts.extend(self.foreign_news(state));
        texts
    }

    /// Commands of other stations, once with each answer; repetitions are not printed.
    fn foreign_news(&mut self, state: &State) -> Vec<Text> {
        let now = state.now();
        let foreign = state.session().ledger().foreign();
        let is_due = |command: &&ForeignCommand| {
            let may_be_answered =
                command.state == RowState::Sent && now < command.at + ANSWERED_WITHIN;
            !may_be_answered && self.foreign.get(&command.id) != Some(&command.state)
        };
        let news: Vec<&ForeignCommand> = foreign.filter(is_due).collect();
        let printed = news.iter().map(|command| (command.id, command.state));
        self.foreign.extend(printed.collect::<Vec<_>>());
        // The ledger drops the oldest ones.
        let oldest = state.session().ledger().foreign().next().map(|it| it.id);
        self.foreign
            .retain(|&id, _| oldest.is_some_and(|oldest| id >= oldest));
        news.into_iter().map(foreign_outcome).collect()
    }
}

/// The newest commands, on demand.
pub(super) fn newest(state: &State) -> Vec<Text> {
    let items = state.session().ledger().newest_first().take(LISTED);
    let mut texts: Vec<Text> = items
        .map(|item| match item {
            LedgerItem::Own(entry) => outcome(entry),
            LedgerItem::Foreign(command) => foreign_outcome(command),
        })
        .collect();
    texts.reverse();
    texts
}

fn foreign_outcome(command: &ForeignCommand) -> Text {
    Text::joined(": ", vec![command.line(), command.outcome()])
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
            RowState::Done if !row.is_over() => entry.state_of(row),
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
    Text::joined(": ", vec![entry.said(), parts])
}
