//! How orders of the desk end: in the journal for the desk, in the record of the flight, and for the trainee.

use super::super::{clock_s, tell};
use super::instructor;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::state::PendingOrder;
use crate::class::{Deed, Order, OrderId, Outcome, Words};
use crate::notice::Notice;
use crate::record::DeskRecord;
use crate::vehicle::Severity;

/// How an order has ended, and more about it.
pub(super) struct Ended {
    pub outcome: Outcome,
    pub why: Option<Words>,
}

impl From<Outcome> for Ended {
    fn from(outcome: Outcome) -> Self {
        Self { outcome, why: None }
    }
}

/// Notes the end of an order: in the journal for the desk, in the record of the flight, and for the trainee.
pub(super) fn end(state: &mut State, id: OrderId, deed: Deed, ended: impl Into<Ended>) -> Effects {
    let Ended { outcome, why } = ended.into();
    let line = DeskRecord {
        by: instructor(state),
        deed: deed.for_record(),
        outcome,
        why: why.clone(),
    };
    let clock_s = clock_s(state);
    if let Some(place) = state.class.seat_mut() {
        place.seat.settle(clock_s, Order { id, deed }, outcome, why);
    }
    if concerns_trainee(&line) {
        tell(state, Severity::Notice, line.text());
    }
    // What a recall changes is noted with it.
    if !matches!(line.deed, Deed::Recall { .. }) {
        state.session.note_instructor(&line, state.now);
    }
    Effects::from(Effect::Class(ClassEffect::Note(line)))
}

/// Whether the trainee gets a notice of an order: not of one that failed, which concerns the desk only, nor of a
/// command of the instructor, which is in the ledger.
fn concerns_trainee(line: &DeskRecord) -> bool {
    // The trainee has just read a message.
    let is_known = matches!(line.deed, Deed::Message { .. } | Deed::Command { .. });
    line.outcome == Outcome::Done && !is_known && !line.deed.is_hidden()
}

/// In a replay: an order of the instructor ended.
pub fn instructed(state: &mut State, line: &DeskRecord) {
    let notice = Notice::general(state.now, Severity::Notice, line.text());
    state.notices.push(notice);
}

/// Enters an outcome that is not the last one into the journal. The trainee gets no notice.
pub(super) fn note(state: &mut State, pending: &PendingOrder, outcome: Outcome) {
    let clock_s = clock_s(state);
    let order = Order {
        id: pending.id,
        deed: pending.deed.clone(),
    };
    if let Some(place) = state.class.seat_mut() {
        place.seat.settle(clock_s, order, outcome, None);
    }
}
