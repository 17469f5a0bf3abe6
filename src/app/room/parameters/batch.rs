//! Many values one after the other: a vehicle takes a few commands at a time.

use std::collections::VecDeque;

use super::edit;
use crate::app::effect::Effect;
use crate::app::state::State;
use crate::ledger::{EntryId, RowState};
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Commands that may be under way; each must be answered before its deadline, also on a slow link.
const UNDER_WAY: usize = 8;

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
#[derive(Debug, Clone, Default)]
pub struct Batch {
    /// What has not been sent yet.
    pub waiting: VecDeque<Setting>,
    /// What is under way.
    under_way: Vec<EntryId>,
    /// Vehicles' values that were confirmed.
    pub confirmed: usize,
    /// Vehicles' values that were refused or not answered.
    pub failed: usize,
}

impl Batch {
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
    let batch = state.rooms.parameters.batch.get_or_insert_default();
    batch.waiting.extend(settings);
    advance(state)
}

/// Counts what has ended and sends what may go out now. Call it when a row of the ledger has changed.
pub fn advance(state: &mut State) -> Vec<Effect> {
    let Some(mut batch) = state.rooms.parameters.batch.take() else {
        return Vec::new();
    };
    let ledger = &state.session.ledger;
    let mut ended = Vec::new();
    batch.under_way.retain(|&id| {
        // What has fallen out of the ledger is long over.
        let is_over = ledger.entry(id).is_none_or(|entry| entry.is_final());
        if is_over {
            ended.push(id);
        }
        !is_over
    });
    for row in ended
        .iter()
        .filter_map(|&id| ledger.entry(id))
        .flat_map(|entry| &entry.rows)
    {
        if row.state == RowState::Done {
            batch.confirmed += 1;
        } else {
            batch.failed += 1;
        }
    }
    let mut effects = Vec::new();
    while batch.under_way.len() < UNDER_WAY
        && let Some(setting) = batch.waiting.pop_front()
    {
        let sent = edit::send(state, &setting).unwrap_or_default();
        if sent.is_empty() {
            batch.failed += setting.vehicles.len();
        }
        batch.under_way.extend(sent.iter().filter_map(entry_of));
        effects.extend(sent);
    }
    if batch.under_way.is_empty() {
        let severity = if batch.failed == 0 {
            Severity::Info
        } else {
            Severity::Warning
        };
        let (confirmed, failed) = (batch.confirmed, batch.failed);
        state.say(
            severity,
            text!(
                "parameters-set-done",
                confirmed = confirmed,
                failed = failed
            ),
        );
    } else {
        state.rooms.parameters.batch = Some(batch);
    }
    effects
}

fn entry_of(effect: &Effect) -> Option<EntryId> {
    match effect {
        Effect::Command { entry, .. } => Some(*entry),
        _ => None,
    }
}
