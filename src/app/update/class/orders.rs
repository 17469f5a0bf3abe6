//! Carries out what the desk asks of a seat, and reports how it ended.

use std::time::Duration;

use super::super::order::{self, Given};
use super::{showing, tell};
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects, SessionEffect, TerminalEffect};
use crate::app::state::{Activity, HeldBrief, OrderTrace, PendingOrder, SeatPlace};
use crate::class::{Deed, Order, OrderId, Outcome, Refusal, Words};
use crate::commands;
use crate::ledger::RowState;
use crate::mission::Stake;
use crate::text;
use crate::vehicle::Severity;

mod ends;
mod flights;
mod injects;
mod pilots;
mod situations;
mod steps;

pub use ends::instructed;
use ends::{Ended, end, note};
pub use situations::recalled;

/// How long the effect of an order may take.
const SEEN_WITHIN: Duration = Duration::from_secs(5);

/// Takes in an order; one that came before is not carried out again.
pub fn given(state: &mut State, order: Order) -> Effects {
    let Some(place) = state.class.seat_mut() else {
        return Effects::none();
    };
    if !place.seat.is_new(&order) {
        return Effects::none();
    }
    if let Deed::Step(step) = order.deed {
        return steps::note(state, order.id, step);
    }
    let order = Order {
        deed: spelled_out(state, order.deed),
        ..order
    };
    match carry_out(state, &order) {
        Ok(begun) => {
            let pending = PendingOrder {
                id: order.id,
                deed: order.deed,
                trace: begun.trace,
                due: state.wall + SEEN_WITHIN,
            };
            if let Some(place) = state.class.seat_mut() {
                place.pending.push(pending);
            }
            begun.effects
        }
        Err(OrderFault { refusal, why }) => {
            let outcome = Outcome::Refused(refusal);
            end(state, order.id, order.deed, Ended { outcome, why })
        }
    }
}

/// The same deed with what it leaves open: the numbers of all vehicles, the name of a situation.
fn spelled_out(state: &State, deed: Deed) -> Deed {
    match deed {
        Deed::TakeOver { vehicles } if vehicles.is_empty() => Deed::TakeOver {
            vehicles: pilots::all(state),
        },
        Deed::HandBack { vehicles } if vehicles.is_empty() => Deed::HandBack {
            vehicles: pilots::flown(state),
        },
        Deed::Recall { situation } => Deed::Recall {
            situation: situations::named(state, situation),
        },
        other => other,
    }
}

/// Why an order is not carried out.
struct OrderFault {
    refusal: Refusal,
    why: Option<Words>,
}

impl From<Refusal> for OrderFault {
    fn from(refusal: Refusal) -> Self {
        Self { refusal, why: None }
    }
}

/// An order that is being carried out.
#[derive(Default)]
struct BegunOrder {
    effects: Effects,
    trace: OrderTrace,
}

impl From<Effect> for BegunOrder {
    fn from(effect: Effect) -> Self {
        Self {
            effects: effect.into(),
            trace: OrderTrace::State,
        }
    }
}

impl From<SessionEffect> for BegunOrder {
    fn from(effect: SessionEffect) -> Self {
        Effect::Session(effect).into()
    }
}

fn carry_out(state: &mut State, order: &Order) -> Result<BegunOrder, OrderFault> {
    if is_exam(state) && !order.deed.is_for_exams() {
        return Err(Refusal::Exam.into());
    }
    let begun = match &order.deed {
        Deed::Message { text } => message(state, text.as_str()),
        Deed::Hint => hint(state)?,
        Deed::Mark { text } => {
            if state.session.activity.is_none() || state.replay.is_some() {
                return Err(Refusal::NotFlying.into());
            }
            let text = format!("{}: {text}", instructor(state));
            let text = text.trim_end_matches([':', ' ']).to_owned();
            Effect::Class(ClassEffect::Mark { id: order.id, text }).into()
        }
        Deed::Freeze => freeze(state)?,
        Deed::Resume if state.session.is_paused() => SessionEffect::Continue.into(),
        Deed::Resume => return Err(Refusal::NotFrozen.into()),
        Deed::Inject { name, when } => injects::inject(state, order.id, name, when.as_ref())?,
        Deed::Disarm { name } => injects::disarm(state, order.id, name.as_ref())?,
        Deed::Capture { name } => situations::capture(state, order.id, name)?,
        Deed::Recall { situation } => situations::recall(state, order, situation)?,
        Deed::End => flights::stop(state)?,
        Deed::TakeOver { vehicles } => pilots::take_over(state, vehicles)?,
        Deed::HandBack { vehicles } => pilots::hand_back(state, vehicles)?,
        Deed::Command { line } => pilots::command(state, line.as_str())?,
        Deed::Fly {
            mission,
            exam,
            hold,
        } => {
            let is_new = !flights::is_under_way(state, mission.as_str(), *exam);
            let begun = flights::fly(state, mission.as_str(), *exam)?;
            if let Some(place) = state.class.seat_mut() {
                place.held = (*hold && is_new).then(|| HeldBrief {
                    flight: place.flights + 1,
                    mission: mission.clone(),
                });
            }
            begun
        }
        Deed::Examine(opened) => {
            let begun = flights::examine(state, opened)?;
            if let Some(place) = state.class.seat_mut() {
                // The time of a try begins with its brief, so its start cannot wait for the desk.
                place.held = None;
            }
            begun
        }
        Deed::Start => flights::start(state)?,
        Deed::LookOn => {
            showing::look_on(state)?;
            BegunOrder::default()
        }
        // It is noted without being carried out.
        Deed::Step(_) => BegunOrder::default(),
    };
    Ok(begun)
}

fn is_exam(state: &State) -> bool {
    let session = &state.session;
    let is_exam = matches!(
        session.activity,
        Some(Activity::Mission {
            stake: Stake::Exam,
            ..
        })
    );
    is_exam && !session.task.over
}

fn instructor(state: &State) -> String {
    let place = state.class.seat();
    let instructor = place.and_then(|place| place.seat.last_instructor());
    instructor.unwrap_or_default().to_owned()
}

fn message(state: &mut State, text: &str) -> BegunOrder {
    let text = text!("class-message", instructor = instructor(state), text = text);
    tell(state, Severity::Warning, text);
    if state.config.alerts.bell {
        Effect::Terminal(TerminalEffect::Bell).into()
    } else {
        BegunOrder::default()
    }
}

/// Gives the trainee the mission's next hint, as if the trainee had asked for it.
fn hint(state: &mut State) -> Result<BegunOrder, Refusal> {
    let progress = state.session.task.progress.as_ref();
    let progress = progress.filter(|_| !state.session.task.over && state.replay.is_none());
    let clues = &progress.ok_or(Refusal::NoMission)?.clues;
    if clues.next.is_none() {
        return Err(Refusal::NoHint);
    }
    match order::read_for(state, "all hint", None, &[]) {
        Ok(Given::Order(asked)) => {
            // The trainee has not asked for it.
            let by = state.class.seat().and_then(SeatPlace::instructor);
            let sent = order::send(state, commands::Order { by, ..asked });
            Ok(BegunOrder {
                effects: sent.effect.into(),
                trace: OrderTrace::Entry(sent.entry),
            })
        }
        Ok(Given::Own(_)) | Err(_) => Err(Refusal::NotFlying),
    }
}

fn freeze(state: &mut State) -> Result<BegunOrder, Refusal> {
    let session = &state.session;
    let is_simulated = session.hangar.is_none()
        && matches!(
            session.activity,
            Some(Activity::Mission { .. } | Activity::Free)
        );
    if session.activity.is_none() || state.replay.is_some() || session.task.over {
        return Err(Refusal::NotFlying);
    }
    if !is_simulated {
        return Err(Refusal::CannotFreeze);
    }
    if session.is_reading() {
        return Err(Refusal::NotFlying);
    }
    let is_paused = session.is_paused();
    if let Some(place) = state.class.seat_mut() {
        place.is_frozen = true;
    }
    Ok(if is_paused {
        BegunOrder::default()
    } else {
        SessionEffect::Pause.into()
    })
}

/// Ends the orders whose effect is seen, or was not seen in time.
pub fn settle(state: &mut State) -> Effects {
    let Some(place) = state.class.seat_mut() else {
        return Effects::none();
    };
    if !state.session.is_paused() && !awaits_freeze(&place.pending) {
        place.is_frozen = false;
    }
    let pending = std::mem::take(&mut place.pending);
    let mut effects = Effects::none();
    for mut one in pending {
        let is_late = state.wall >= one.due;
        let outcome = match (&one.deed, one.trace) {
            // Vehicles may take minutes to start, and to carry out a command.
            (Deed::Start, OrderTrace::Flight(flight)) => {
                flights::begin(state, flight).map(Ended::from)
            }
            (Deed::Command { .. }, _) => pilots::command_end(state, &mut one),
            (Deed::Inject { .. }, _) => {
                injects::outcome(state, &one).or_else(|| is_late.then(|| Outcome::NoEffect.into()))
            }
            (Deed::Examine(opened), trace) => flights::try_outcome(state, opened, trace)
                .or_else(|| is_late.then_some(Outcome::NoEffect))
                .map(Ended::from),
            _ => effect_of(state, &one)
                .or_else(|| is_late.then_some(Outcome::NoEffect))
                .map(Ended::from),
        };
        match outcome {
            Some(ended) => effects.extend(end(state, one.id, one.deed, ended)),
            None => {
                if let Some(place) = state.class.seat_mut() {
                    place.pending.push(one);
                }
            }
        }
    }
    effects.extend(flights::end_late(state));
    flights::free_brief(state);
    effects.extend(pilots::settle(state));
    effects.extend(injects::settle(state));
    effects.extend(steps::settle(state));
    effects
}

fn awaits_freeze(pending: &[PendingOrder]) -> bool {
    let mut deeds = pending.iter().map(|one| &one.deed);
    deeds.any(|deed| matches!(deed, Deed::Freeze | Deed::Recall { .. }))
}

/// How an order has ended, if its effect can be seen.
fn effect_of(state: &State, pending: &PendingOrder) -> Option<Outcome> {
    let session = &state.session;
    let is_done = match &pending.deed {
        Deed::Message { .. }
        | Deed::TakeOver { .. }
        | Deed::HandBack { .. }
        | Deed::Step(_)
        | Deed::LookOn => true,
        // The shell reports it, or what begins the flight, or the ledger.
        Deed::Mark { .. }
        | Deed::Command { .. }
        | Deed::Capture { .. }
        | Deed::Recall { .. }
        | Deed::Disarm { .. }
        | Deed::Inject { .. }
        | Deed::Examine(_)
        | Deed::Start => false,
        Deed::Hint => return hint_outcome(state, pending.trace),
        Deed::Freeze => session.is_paused(),
        Deed::Resume => !session.is_paused(),
        Deed::End => session.task.over || session.activity.is_none(),
        Deed::Fly { mission, .. } => match pending.trace {
            OrderTrace::Flight(before) => flights::is_flown(state, mission.as_str(), before),
            OrderTrace::State | OrderTrace::Entry(_) | OrderTrace::Injected(_) => false,
        },
    };
    is_done.then_some(Outcome::Done)
}

fn hint_outcome(state: &State, trace: OrderTrace) -> Option<Outcome> {
    let OrderTrace::Entry(entry) = trace else {
        return None;
    };
    let entry = state.session.ledger().entry(entry)?;
    if !entry.is_final() {
        return None;
    }
    let is_given = entry.rows.iter().any(|row| row.state == RowState::Done);
    Some(if is_given {
        Outcome::Done
    } else {
        Outcome::Refused(Refusal::NoHint)
    })
}

/// The shell has begun an order, or cannot do it.
pub fn begun(state: &mut State, id: OrderId, refusal: Option<Refusal>) -> Effects {
    let Some(place) = state.class.seat_mut() else {
        return Effects::none();
    };
    let Some(at) = place.pending.iter().position(|one| one.id == id) else {
        return refusal.map_or_else(Effects::none, |refusal| steps::refused(state, id, refusal));
    };
    let pending = place.pending.swap_remove(at);
    if let Some(refusal) = refusal {
        return end(state, id, pending.deed, Outcome::Refused(refusal));
    }
    match &pending.deed {
        Deed::Inject { when: None, .. } => {
            // Its effect follows.
            place.pending.push(pending);
            Effects::none()
        }
        Deed::Inject {
            name,
            when: Some(when),
        } => {
            injects::armed(place, &pending, name, when);
            end(state, id, pending.deed, Outcome::Armed)
        }
        Deed::Capture { name } => {
            situations::captured(state, name.clone());
            end(state, id, pending.deed, Outcome::Done)
        }
        Deed::Disarm { name } => {
            let mut effects = injects::disarmed(state, name.as_ref());
            effects.extend(end(state, id, pending.deed, Outcome::Done));
            effects
        }
        _ => end(state, id, pending.deed, Outcome::Done),
    }
}

/// The flight of a try that the desk has ordered was not begun.
pub fn try_refused(state: &mut State, why: Refusal) -> Effects {
    let pending = state.class.seat().map_or(&[][..], |place| &place.pending);
    let is_try = |one: &&PendingOrder| matches!(one.deed, Deed::Examine(_));
    let ordered = pending.iter().find(is_try).map(|one| one.id);
    if let Some(place) = state.class.seat_mut() {
        place.exam = None;
    }
    ordered.map_or_else(Effects::none, |id| begun(state, id, Some(why)))
}
