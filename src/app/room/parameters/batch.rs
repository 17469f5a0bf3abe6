//! Many values one after the other: a vehicle takes a few commands at a time.

use std::collections::VecDeque;

use super::edit;
use crate::app::effect::Effect;
use crate::app::state::State;
use crate::ledger::{Entry, EntryId, Ledger, Row, RowState};
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Commands that may be under way at most. A command that waits behind others may be over its deadline before it is
/// sent, so that fewer are given where answers are slow.
const MOST_UNDER_WAY: usize = 8;

/// One value for some vehicles.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The parameter's name.
    pub name: String,
    /// The value to take.
    pub value: f32,
    /// The vehicles, sorted.
    pub vehicles: Vec<VehicleId>,
}

/// Values that are being set.
#[derive(Debug, Clone)]
pub struct Batch {
    /// What has not been given yet.
    waiting: VecDeque<Setting>,
    /// What is under way.
    under_way: Vec<(EntryId, Setting)>,
    /// How many commands may be under way now.
    window: usize,
    /// Vehicles' values that were confirmed.
    confirmed: usize,
    /// Vehicles' values that were refused or not answered.
    failed: usize,
}

impl Batch {
    fn new() -> Self {
        Self {
            waiting: VecDeque::new(),
            under_way: Vec::new(),
            window: 1,
            confirmed: 0,
            failed: 0,
        }
    }

    /// Parameters that have not been answered for yet.
    pub fn left(&self) -> usize {
        self.waiting.len() + self.under_way.len()
    }
}

/// Begins to set values; what another batch has not sent yet is added to.
pub fn begin(state: &mut State, settings: Vec<Setting>) -> Vec<Effect> {
    if let Some(comparison) = &mut state.rooms.parameters.comparison {
        let names = settings.iter().map(|setting| setting.name.clone());
        comparison.set.extend(names);
    }
    let room = &mut state.rooms.parameters;
    let batch = room.batch.get_or_insert_with(Batch::new);
    batch.waiting.extend(settings);
    advance(state)
}

/// Counts what has ended and gives what may go out now. Call it when a row of the ledger has changed.
pub fn advance(state: &mut State) -> Vec<Effect> {
    let Some(mut batch) = state.rooms.parameters.batch.take() else {
        return Vec::new();
    };
    batch.count(&state.session.ledger);
    let mut effects = Vec::new();
    while batch.under_way.len() < batch.window
        && let Some(setting) = batch.waiting.pop_front()
    {
        match edit::send(state, &setting).as_deref() {
            Ok([effect @ Effect::Command { entry, .. }]) => {
                batch.under_way.push((*entry, setting));
                effects.push(effect.clone());
            }
            // The vehicle is not there any more.
            _ => batch.failed += setting.vehicles.len(),
        }
    }
    if batch.under_way.is_empty() {
        let severity = match batch.failed {
            0 => Severity::Info,
            _ => Severity::Warning,
        };
        let (confirmed, failed) = (batch.confirmed, batch.failed);
        let text = text!(
            "parameters-set-done",
            confirmed = confirmed,
            failed = failed
        );
        state.say(severity, text);
    } else {
        state.rooms.parameters.batch = Some(batch);
    }
    effects
}

impl Batch {
    /// Takes note of commands that have ended.
    fn count(&mut self, ledger: &Ledger) {
        let is_over = |(id, _): &mut (EntryId, Setting)| {
            // What has fallen out of the ledger is long over.
            ledger.entry(*id).is_none_or(Entry::is_final)
        };
        let ended: Vec<_> = self.under_way.extract_if(.., is_over).collect();
        for (id, setting) in ended {
            let rows = ledger.entry(id).map_or(&[][..], |entry| &entry.rows);
            let unsent: Vec<VehicleId> = rows
                .iter()
                .filter(|row| is_unsent(row))
                .map(|row| row.vehicle)
                .collect();
            let done = rows
                .iter()
                .filter(|row| row.state == RowState::Done)
                .count();
            let failed = rows.len() - done - unsent.len();
            self.confirmed += done;
            self.failed += failed;
            self.window = if done == rows.len() {
                (self.window * 2).min(MOST_UNDER_WAY)
            } else {
                1
            };
            if !unsent.is_empty() {
                self.waiting.push_back(Setting {
                    vehicles: unsent,
                    ..setting
                });
            }
        }
    }
}

/// It waited for the line until its time was over, so that it can be given again.
fn is_unsent(row: &Row) -> bool {
    row.state == RowState::TimedOut && row.tries == 0
}
