//! Steps of the desk's lessons: a seat notes them, and watches their conditions.

use super::end;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::state::{SeatPlace, WaitingStep};
use crate::class::{Deed, FlightMoment, NotedStep, OrderId, Outcome, Refusal};

/// Notes a step. The one before no longer waits for its condition.
pub(super) fn note(state: &mut State, id: OrderId, step: NotedStep) -> Effects {
    let before = state.class.seat_mut().and_then(|place| place.step.take());
    let mut effects = Effects::none();
    if let Some(before) = before {
        let deed = Deed::Step(before.step);
        effects.extend(end(state, before.id, deed, Outcome::Disarmed));
    }
    if step.when.is_none() {
        effects.extend(end(state, id, Deed::Step(step), Outcome::Done));
        return effects;
    }
    effects.extend(end(state, id, Deed::Step(step.clone()), Outcome::Armed));
    if let Some(place) = state.class.seat_mut() {
        let asked = None;
        place.step = Some(WaitingStep { id, step, asked });
    }
    effects
}

/// Whether the condition of a step holds.
enum Standing {
    Holds,
    HoldsNot,
    /// The flight is over: it cannot hold any more.
    Missed,
    /// The flight must be asked to watch it.
    Unwatched(String),
}

/// Ends the step whose condition holds.
pub(super) fn settle(state: &mut State) -> Effects {
    let place = state.class.seat();
    let Some(waiting) = place.and_then(|place| place.step.as_ref()) else {
        return Effects::none();
    };
    let id = waiting.id;
    match standing(state, waiting) {
        Standing::HoldsNot => Effects::none(),
        Standing::Holds => finish(state, Outcome::Done),
        Standing::Missed => finish(state, Outcome::Refused(Refusal::NotFlying)),
        Standing::Unwatched(when) => {
            if let Some(place) = state.class.seat_mut() {
                ask(place);
            }
            Effect::Class(ClassEffect::Expect { id, when }).into()
        }
    }
}

fn ask(place: &mut SeatPlace) {
    let flight = place.flights;
    if let Some(waiting) = &mut place.step {
        waiting.asked = Some(flight);
    }
}

fn finish(state: &mut State, outcome: Outcome) -> Effects {
    let waiting = state.class.seat_mut().and_then(|place| place.step.take());
    let Some(WaitingStep { id, step, .. }) = waiting else {
        return Effects::none();
    };
    end(state, id, Deed::Step(step), outcome)
}

/// The flight cannot watch the condition of this step.
pub(super) fn refused(state: &mut State, id: OrderId, refusal: Refusal) -> Effects {
    let place = state.class.seat();
    let waiting = place.and_then(|place| place.step.as_ref());
    // A flight that is over is followed by another one.
    if waiting.is_some_and(|it| it.id == id) && refusal == Refusal::Condition {
        finish(state, Outcome::Refused(refusal))
    } else {
        Effects::none()
    }
}

fn standing(state: &State, waiting: &WaitingStep) -> Standing {
    let session = &state.session;
    let (Some(place), Some(when)) = (state.class.seat(), &waiting.step.when) else {
        return Standing::HoldsNot;
    };
    let flown = state.flown_mission().filter(|_| {
        // A replay is not a flight.
        session.activity.is_some() && state.replay.is_none()
    });
    let is_meant = |id: &str| {
        let mission = waiting.step.mission.as_ref();
        mission.is_none_or(|mission| mission.as_str() == id)
    };
    if !flown.is_some_and(|mission| is_meant(&mission.id)) {
        return Standing::HoldsNot;
    }
    let holds = match FlightMoment::named(when.as_str()) {
        Some(FlightMoment::Started) => session.has_flight_begun(),
        Some(FlightMoment::Over) => session.task.over,
        Some(FlightMoment::Passed) => session.task.over && place.has_passed,
        None => return condition_standing(state, waiting, when.as_str()),
    };
    if holds {
        Standing::Holds
    } else {
        Standing::HoldsNot
    }
}

/// How a condition in the language of missions stands in the flight that is meant.
fn condition_standing(state: &State, waiting: &WaitingStep, when: &str) -> Standing {
    let flights = state.class.seat().map_or(0, |place| place.flights);
    let is_asked = waiting.asked == Some(flights);
    let progress = state.session.task.progress.as_ref();
    let expected = progress.and_then(|it| it.expected.as_ref());
    // The flight may not have looked since it was asked.
    let has_held = expected.is_some_and(|it| it.has_held && it.asked_by == waiting.id);
    if is_asked && has_held {
        Standing::Holds
    } else if state.session.task.over {
        Standing::Missed
    } else if is_asked {
        Standing::HoldsNot
    } else {
        Standing::Unwatched(when.to_owned())
    }
}
