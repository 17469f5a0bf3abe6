//! Situations of a flight that the desk captures and recalls. The shell keeps them, each in a place; here are their names.

use super::{BegunOrder, injects, instructor};
use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::snapshot::{FlightSnapshot, restore};
use crate::app::state::{Activity, OrderTrace, Room, SeatSituation, TimeFlow};
use crate::class::{Order, OrderId, Outcome, Refusal, Words};
use crate::mission::Stake;
use crate::record::DeskRecord;

/// The maximum number of situations of a flight.
const KEPT: usize = 10;

/// Keeps the situation of the flight under a name; another one of this name is replaced.
pub(super) fn capture(state: &State, id: OrderId, name: &Words) -> Result<BegunOrder, Refusal> {
    check(state)?;
    let slot = slot_of(state, name);
    if slot >= KEPT {
        return Err(Refusal::TooManySituations);
    }
    Ok(SessionEffect::Capture { id, slot }.into())
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
    let Some(place) = state.class.seat_mut() else {
        return;
    };
    let name = if name.is_empty() {
        (slot + 1).to_string().into()
    } else {
        name
    };
    let situation = SeatSituation {
        name,
        armed: place.armed.clone(),
    };
    match place.situations.get_mut(slot) {
        Some(before) => *before = situation,
        None => place.situations.push(situation),
    }
}

/// Returns to a situation, by its name or its number.
pub(super) fn recall(
    state: &mut State,
    order: &Order,
    wanted: &Words,
) -> Result<BegunOrder, Refusal> {
    check(state)?;
    let all = situations(state);
    let named = all.iter().position(|it| it.name == *wanted);
    let numbered = || {
        let number: usize = wanted.as_str().parse().ok()?;
        number.checked_sub(1).filter(|slot| *slot < all.len())
    };
    let slot = named.or_else(numbered).ok_or(Refusal::NoSituation)?;
    let line = DeskRecord {
        by: instructor(state),
        deed: order.deed.for_record(),
        outcome: Outcome::Done,
        why: None,
    };
    let kept = all[slot].armed.clone();
    let mut effects = injects::recalled(state, &kept);
    if let Some(place) = state.class.seat_mut() {
        place.is_frozen = true;
        place.has_passed = false;
        place.armed = kept;
    }
    let id = order.id;
    effects.extend(Effects::from(Effect::Session(SessionEffect::Recall {
        id,
        slot,
        line,
    })));
    Ok(BegunOrder {
        effects,
        trace: OrderTrace::State,
    })
}

/// The flight continues from an earlier state: frozen, and as practice. Who flies which vehicle stays as it is.
pub fn recalled(state: &mut State, flight: FlightSnapshot) {
    let pilots = std::mem::take(&mut state.session.pilots);
    restore(state, flight);
    let session = &mut state.session;
    session.pilots = pilots;
    if let Some(Activity::Mission { stake, .. }) = &mut session.activity {
        *stake = Stake::Practice;
    }
    session.timing.flow = TimeFlow::Paused;
    if state.room == Room::Debrief {
        state.room = Room::Fly;
    }
    state.overlay = None;
    let next = state.session.ledger().next();
    if let Some(place) = state.class.seat_mut() {
        // The entries of the ledger are numbered as before the situation, and its condition is no longer expected.
        place.desk_entries.retain(|entry| *entry < next);
        if let Some(step) = &mut place.step {
            step.asked = None;
        }
    }
}
