//! Injects of the desk: at once, or armed with a condition.

use super::ends::Ended;
use super::{BegunOrder, end};
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::state::{ArmedOrder, OrderTrace, PendingOrder, SeatPlace};
use crate::class::{Deed, OrderId, Outcome, Refusal, Words};
use crate::mission::{Injected, Progress};
use crate::text;
use crate::vehicle_id::ranges;

/// Triggers or arms an inject.
pub(super) fn inject(
    state: &State,
    id: OrderId,
    name: &Words,
    when: Option<&Words>,
) -> Result<BegunOrder, Refusal> {
    let session = &state.session;
    let progress = flown(state).ok_or(Refusal::NoMission)?;
    if session.task.over {
        return Err(Refusal::NotFlying);
    }
    if progress.injects.iter().all(|it| it.name != name.as_str()) {
        return Err(Refusal::NoInject);
    }
    if when.is_none() {
        if session.is_reading() || !session.has_flight_begun() {
            return Err(Refusal::NotFlying);
        }
        if session.is_paused() {
            return Err(Refusal::Paused);
        }
    }
    let when = when.map(Words::to_string);
    let name = name.to_string();
    let trace = OrderTrace::Injected(count(progress, &name, when.as_deref()));
    let effect = Effect::Class(ClassEffect::Inject { id, name, when });
    Ok(BegunOrder {
        effects: effect.into(),
        trace,
    })
}

/// Removes injects that wait for their conditions: those with this name, or all.
pub(super) fn disarm(
    state: &State,
    id: OrderId,
    name: Option<&Words>,
) -> Result<BegunOrder, Refusal> {
    let place = state.class.seat();
    let mut armed = place.into_iter().flat_map(|place| &place.armed);
    if !armed.any(|it| is_meant(it, name)) {
        return Err(Refusal::NotArmed);
    }
    let name = name.map(Words::to_string);
    Ok(Effect::Class(ClassEffect::Disarm { id, name }).into())
}

/// The mission that is flown.
fn flown(state: &State) -> Option<&Progress> {
    let is_flown = state.session.activity.is_some() && state.replay.is_none();
    let progress = state.session.task.progress.as_ref();
    progress.filter(|_| is_flown)
}

fn is_meant(armed: &ArmedOrder, name: Option<&Words>) -> bool {
    name.is_none_or(|name| armed.name == *name)
}

/// What the mission has carried out of an inject, in this order.
fn carried_out<'a>(
    progress: &'a Progress,
    name: &str,
    when: Option<&str>,
) -> impl Iterator<Item = &'a Injected> {
    let same = move |it: &&Injected| it.name == name && it.when.as_deref() == when;
    progress.injected.iter().filter(same)
}

/// How often the mission has carried out an inject.
fn count(progress: &Progress, name: &str, when: Option<&str>) -> usize {
    carried_out(progress, name, when).count()
}

/// How an inject has ended that the mission has carried out, after it had done so before this often: with the vehicles
/// that it has hit.
fn done(state: &State, name: &str, when: Option<&str>, before: usize) -> Option<Ended> {
    let injected = carried_out(flown(state)?, name, when).nth(before)?;
    let hit = ranges(injected.vehicles.iter().copied());
    let why = (!hit.is_empty()).then(|| {
        let count = injected.vehicles.len();
        let text = text!("class-inject-hit", count = count, vehicles = hit);
        state.locale.text(&text).as_str().into()
    });
    let outcome = Outcome::Done;
    Some(Ended { outcome, why })
}

/// How an inject has ended that was to come at once, if the mission has carried it out.
pub(super) fn outcome(state: &State, pending: &PendingOrder) -> Option<Ended> {
    let (Deed::Inject { name, when: None }, OrderTrace::Injected(before)) =
        (&pending.deed, pending.trace)
    else {
        return None;
    };
    done(state, name.as_str(), None, before)
}

/// An inject is armed now.
pub(super) fn armed(place: &mut SeatPlace, pending: &PendingOrder, name: &Words, when: &Words) {
    let before = match pending.trace {
        OrderTrace::Injected(before) => before,
        OrderTrace::State | OrderTrace::Entry(_) | OrderTrace::Flight(_) => 0,
    };
    place.armed.push(ArmedOrder {
        id: pending.id,
        name: name.clone(),
        when: when.clone(),
        before,
    });
}

/// Injects with this name, or all, are armed no more.
pub(super) fn disarmed(state: &mut State, name: Option<&Words>) -> Effects {
    end_armed(state, |_, armed| {
        is_meant(armed, name).then(|| Outcome::Disarmed.into())
    })
}

/// Ends the armed injects that a recalled situation does not have.
pub(super) fn recalled(state: &mut State, kept: &[ArmedOrder]) -> Effects {
    end_armed(state, |_, armed| {
        let is_kept = kept.iter().any(|it| it.id == armed.id);
        (!is_kept).then(|| Outcome::Disarmed.into())
    })
}

/// Ends the armed injects that have been carried out, and all when the flight is over.
pub(super) fn settle(state: &mut State) -> Effects {
    end_armed(state, |state, armed| {
        let when = Some(armed.when.as_str());
        let is_over = state.session.task.over || flown(state).is_none();
        done(state, armed.name.as_str(), when, armed.before)
            .or_else(|| is_over.then(|| Outcome::Disarmed.into()))
    })
}

/// Ends the armed injects for which there is an outcome.
fn end_armed(state: &mut State, outcome: impl Fn(&State, &ArmedOrder) -> Option<Ended>) -> Effects {
    let Some(place) = state.class.seat_mut() else {
        return Effects::none();
    };
    let mut effects = Effects::none();
    for armed in std::mem::take(&mut place.armed) {
        match outcome(state, &armed) {
            Some(outcome) => {
                let ArmedOrder { id, name, when, .. } = armed;
                let when = Some(when);
                effects.extend(end(state, id, Deed::Inject { name, when }, outcome));
            }
            None => {
                if let Some(place) = state.class.seat_mut() {
                    place.armed.push(armed);
                }
            }
        }
    }
    effects
}
