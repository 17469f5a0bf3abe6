//! Situations of a flight that the desk captures and recalls. The shell keeps them, each in a place; here are their names.

use super::{BegunOrder, injects, instructor, pilots};
use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect, SituationEffect};
use crate::app::snapshot::{FlightSnapshot, restore};
use crate::app::state::{Activity, OrderTrace, Room, SeatSituation, TimeFlow};
use crate::class::{Deed, Order, OrderId, Outcome, Refusal, Words};
use crate::ledger::{RowState, RowUpdate};
use crate::mission::Stake;
use crate::record::DeskRecord;
use crate::verb::CountsAs;

/// The maximum number of situations of a flight.
const KEPT: usize = 10;

/// Keeps the situation of the flight under a name; another one of this name is replaced.
pub(super) fn capture(state: &State, id: OrderId, name: &Words) -> Result<BegunOrder, Refusal> {
    check(state)?;
    let slot = slot_of(state, name);
    if slot >= KEPT {
        return Err(Refusal::TooManySituations);
    }
    let effect = SituationEffect::Capture { id, slot };
    Ok(SessionEffect::Situation(effect).into())
}

/// Checks that the whole flight is simulated by the console, and that its brief is left.
fn check(state: &State) -> Result<(), Refusal> {
    let session = &state.session;
    if session.activity.is_none() || state.replay.is_some() || session.is_reading() {
        return Err(Refusal::NotFlying);
    }
    // Also after its end: the record of a try is not to be changed.
    if matches!(
        session.activity,
        Some(Activity::Mission {
            stake: Stake::Exam,
            ..
        })
    ) {
        return Err(Refusal::Exam);
    }
    let is_connected = matches!(session.activity, Some(Activity::Connected { .. }));
    if is_connected || session.hangar.is_some() {
        return Err(Refusal::CannotFreeze);
    }
    Ok(())
}

fn situations(state: &State) -> &[SeatSituation] {
    let place = state.class.seat();
    place.map_or(&[][..], |place| &place.situations)
}

/// The place of the situation with this name; the next free one if there is none, or without a name.
fn slot_of(state: &State, name: &Words) -> usize {
    let all = situations(state);
    let same = all
        .iter()
        .position(|it| it.name == *name && !name.is_empty());
    same.unwrap_or(all.len())
}

/// The shell keeps a situation.
pub(super) fn captured(state: &mut State, name: Words) {
    let slot = slot_of(state, &name);
    let at = state.session.time(state.now);
    let Some(place) = state.class.seat_mut() else {
        return;
    };
    let is_named = !name.is_empty();
    let name = if is_named {
        name
    } else {
        (slot + 1).to_string().into()
    };
    let situation = SeatSituation {
        name,
        is_named,
        at,
        armed: place.armed.clone(),
    };
    match place.situations.get_mut(slot) {
        Some(before) => *before = situation,
        None => place.situations.push(situation),
    }
}

/// The place of the situation that is meant by its name or its number.
fn place_of(state: &State, wanted: &Words) -> Option<usize> {
    let all = situations(state);
    let named = all.iter().position(|it| it.name == *wanted);
    let numbered = || {
        let number: usize = wanted.as_str().parse().ok()?;
        number.checked_sub(1).filter(|slot| *slot < all.len())
    };
    named.or_else(numbered)
}

/// The name of the situation that is meant by its name or its number; as it is written if there is none.
pub(super) fn named(state: &State, wanted: Words) -> Words {
    match place_of(state, &wanted) {
        Some(slot) => situations(state)[slot].name.clone(),
        None => wanted,
    }
}

/// Returns to a situation.
pub(super) fn recall(
    state: &mut State,
    order: &Order,
    wanted: &Words,
) -> Result<BegunOrder, Refusal> {
    check(state)?;
    let slot = place_of(state, wanted).ok_or(Refusal::NoSituation)?;
    let line = DeskRecord {
        by: instructor(state),
        deed: order.deed.for_record(),
        outcome: Outcome::Done,
        why: None,
    };
    let kept = situations(state)[slot].armed.clone();
    let mut effects = injects::recalled(state, &kept);
    if let Some(place) = state.class.seat_mut() {
        place.is_frozen = true;
        place.has_passed = false;
        place.armed = kept;
    }
    let id = order.id;
    let effect = SituationEffect::Recall { id, slot, line };
    effects.extend(Effects::from(Effect::Session(SessionEffect::Situation(
        effect,
    ))));
    Ok(BegunOrder {
        effects,
        trace: OrderTrace::State,
    })
}

/// The flight continues from an earlier state: frozen, and as practice. Who flies which vehicle stays as it is.
pub fn recalled(state: &mut State, flight: FlightSnapshot) {
    let pilots = std::mem::take(&mut state.session.pilots);
    let instructor = std::mem::take(&mut state.session.instructor);
    restore(state, flight);
    let session = &mut state.session;
    (session.pilots, session.instructor) = (pilots, instructor);
    leave_behind(state);
    let session = &mut state.session;
    if let Some(Activity::Mission { stake, .. }) = &mut session.activity {
        *stake = Stake::Practice;
    }
    session.timing.flow = TimeFlow::Paused;
    if state.room == Room::Debrief {
        state.room = Room::Fly;
    }
    state.overlay = None;
    end_rehearsals(state);
    go_on_flying(state);
    // The condition of a step is no longer expected.
    let place = state.class.seat_mut();
    if let Some(step) = place.and_then(|place| place.step.as_mut()) {
        step.asked = None;
    }
}

/// What the instructor did after the situation is no longer part of the flight.
fn leave_behind(state: &mut State) {
    let pending = state.class.seat().map_or(&[][..], |place| &place.pending);
    let recalled = pending.iter().find_map(|one| match &one.deed {
        Deed::Recall { situation } => Some(situation.to_string()),
        _ => None,
    });
    if let Some(situation) = recalled {
        let by = instructor(state);
        let to = state.session.elapsed(state.now);
        state.session.instructor.go_back(to, &by, &situation);
    }
}

/// Ends the rehearsals that were under way then: their results do not come any more.
fn end_rehearsals(state: &mut State) {
    let at = state.now;
    let entries = state.session.ledger().entries();
    let rehearsals = entries.filter(|entry| entry.verb.counts_as == CountsAs::Rehearsal);
    let under_way = rehearsals.flat_map(|entry| {
        let rows = entry.rows.iter().filter(|row| !row.state.is_final());
        rows.map(|row| RowUpdate {
            entry: entry.id,
            vehicle: row.vehicle,
            state: RowState::Superseded,
            tries: row.tries,
            at,
            explanation: None,
        })
    });
    let ended: Vec<RowUpdate> = under_way.collect();
    for row in &ended {
        state.session.commands.ledger.apply(row);
    }
}

/// Notes which vehicles the instructor flies on after a recall.
fn go_on_flying(state: &mut State) {
    let vehicles = pilots::flown(state);
    if !vehicles.is_empty() {
        let deed = Deed::TakeOver { vehicles };
        let line = DeskRecord {
            by: instructor(state),
            deed,
            outcome: Outcome::Done,
            why: None,
        };
        state.session.note_instructor(&line, state.now);
    }
}
