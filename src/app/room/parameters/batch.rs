//! Many values one after the other: a vehicle takes a few commands at a time.

use std::collections::VecDeque;

use super::{Parameters, edit};
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
    /// How often it is given again where no answer comes: taking the same value twice does no harm.
    pub again: u8,
}

impl Setting {
    /// A value for some vehicles.
    pub fn new(name: &str, value: f32, vehicles: Vec<VehicleId>) -> Self {
        Self {
            name: name.to_owned(),
            value,
            vehicles,
            again: AGAIN,
        }
    }
}

/// A setting is given again so often.
const AGAIN: u8 = 2;

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

    /// Gives nothing more, and says how many were not given.
    pub fn stop(&mut self) -> usize {
        let left = self.waiting.len();
        self.waiting.clear();
        left
    }

    /// Whether a command is one of them.
    pub fn has(&self, entry: EntryId) -> bool {
        self.under_way.iter().any(|(known, _)| *known == entry)
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
    batch.count(&state.session.ledger, &state.rooms.parameters);
    let mut effects = Vec::new();
    while batch.under_way.len() < batch.window
        && let Some(setting) = batch.waiting.pop_front()
    {
        match edit::send(state, &setting).as_deref() {
            Ok([effect @ Effect::Order { entry, .. }]) => {
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
    fn count(&mut self, ledger: &Ledger, known: &Parameters) {
        let is_over = |(id, _): &mut (EntryId, Setting)| {
            // What has fallen out of the ledger is long over.
            ledger.entry(*id).is_none_or(Entry::is_final)
        };
        let ended: Vec<_> = self.under_way.extract_if(.., is_over).collect();
        for (id, setting) in ended {
            let rows = ledger.entry(id).map_or(&[][..], |entry| &entry.rows);
            let done = rows.iter().filter(|row| row.state == RowState::Done);
            let done = done.count();
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
                    let setting = Setting::new(&setting.name, setting.value, vehicles);
                    self.waiting.push_back(Setting { again, ..setting });
                }
            }
        }
    }
}

/// The vehicles for which the line was not free in time, and those that did not answer although they have such a
/// parameter.
fn to_give_again(
    rows: &[Row],
    setting: &Setting,
    known: &Parameters,
) -> (Vec<VehicleId>, Vec<VehicleId>) {
    let timed_out = rows.iter().filter(|row| row.state == RowState::TimedOut);
    let (unsent, mut unanswered): (Vec<&Row>, Vec<&Row>) =
        timed_out.partition(|row| row.tries == 0);
    let has = |row: &&Row| known.get(row.vehicle, &setting.name).is_some();
    unanswered.retain(|row| setting.again > 0 && has(row));
    let ids = |rows: Vec<&Row>| rows.into_iter().map(|row| row.vehicle).collect();
    (ids(unsent), ids(unanswered))
}
