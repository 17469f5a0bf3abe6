//! The instructor flies vehicles of the trainee.

use std::time::Duration;

use super::super::super::order::{self, LineFor, OrderFor, UnfitLine};
use super::super::tell;
use super::{BegunOrder, Ended, OrderFault, instructor, note};
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::state::{Activity, OrderTrace, PendingOrder, SeatPlace};
use crate::class::{Deed, Outcome, Refusal};
use crate::commands::Order;
use crate::crew::protocol::Confirmed;
use crate::ledger::{LedgerEntry, RowState};
use crate::pilot_in_command::Person;
use crate::record::DeskRecord;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

/// Makes the instructor the pilot in command of these vehicles. They go on with what they do.
pub(super) fn take_over(state: &mut State, vehicles: &[VehicleId]) -> Result<BegunOrder, Refusal> {
    let session = &state.session;
    if session.activity.is_none() || state.replay.is_some() {
        return Err(Refusal::NotFlying);
    }
    let may_be_real = matches!(session.activity, Some(Activity::Connected { .. }));
    if may_be_real && !state.config.class.take_over {
        return Err(Refusal::RealVehicle);
    }
    let all = all(state);
    if vehicles.is_empty() || vehicles.iter().any(|id| !all.contains(id)) {
        return Err(Refusal::NoVehicle);
    }
    let person = Person::instructor(instructor(state));
    state.session.pilots.take_over(vehicles, &person);
    Ok(BegunOrder::default())
}

/// All vehicles of the flight, as far as they were heard.
pub(super) fn all(state: &State) -> Vec<VehicleId> {
    let heard = state.session.vehicles.keys().copied();
    heard.filter(|&id| state.session.expects(id)).collect()
}

/// The vehicles that the instructor flies.
pub(super) fn flown(state: &State) -> Vec<VehicleId> {
    let person = Person::instructor(instructor(state));
    state.session.pilots.flown_by(&person)
}

/// Hands vehicles that the instructor flies back to the trainee.
pub(super) fn hand_back(state: &mut State, vehicles: &[VehicleId]) -> Result<BegunOrder, Refusal> {
    let person = Person::instructor(instructor(state));
    let flown = state.session.pilots.flown_by(&person);
    if vehicles.is_empty() || vehicles.iter().any(|id| !flown.contains(id)) {
        return Err(Refusal::NotTaken);
    }
    state.session.pilots.hand_back(vehicles, &person);
    Ok(BegunOrder::default())
}

/// Gives the vehicles that the instructor flies a command; without targets, it is for all of them.
pub(super) fn command(state: &mut State, line: &str) -> Result<BegunOrder, OrderFault> {
    if state.session.activity.is_none() || state.session.is_reading() {
        return Err(Refusal::NotFlying.into());
    }
    let person = Person::instructor(instructor(state));
    let flown = state.session.pilots.flown_by(&person);
    if flown.is_empty() {
        return Err(Refusal::NotTaken.into());
    }
    let said = LineFor {
        by: &person,
        line,
        selection: &flown,
        // The desk has asked about the danger of the verb, but cannot know of any other hazard.
        confirmed: Confirmed::Danger,
    };
    let is_open = |order: &Order| order.verb.counts_as.is_for_vehicles();
    match order::give_for(state, said, is_open) {
        Ok(OrderFor { sent, .. }) => Ok(BegunOrder {
            effects: sent.effect.into(),
            trace: OrderTrace::Entry(sent.entry),
        }),
        Err(UnfitLine::NoCommand) => Err(Refusal::Line.into()),
        Err(UnfitLine::Because(why)) => Err(OrderFault {
            refusal: Refusal::Line,
            why: Some(state.locale.text(&why).as_str().into()),
        }),
    }
}

/// How a command of the instructor has ended; `None` while vehicles carry it out. The desk hears of that once.
pub(super) fn command_end(state: &mut State, pending: &mut PendingOrder) -> Option<Ended> {
    let OrderTrace::Entry(entry) = pending.trace else {
        return Some(Outcome::NoEffect.into());
    };
    let Some(entry) = state.session.ledger().entry(entry) else {
        return Some(Outcome::NoEffect.into());
    };
    if entry.is_final() {
        let (outcome, reasons) = outcome_of(entry);
        let why = reasons.map(|it| state.locale.text(&it).as_str().into());
        return Some(Ended { outcome, why });
    }
    if state.wall >= pending.due {
        pending.due = Duration::MAX;
        note(state, pending, Outcome::UnderWay);
    }
    None
}

/// The outcome of a command that has ended for all of its vehicles, and what went wrong with some of them.
fn outcome_of(entry: &LedgerEntry) -> (Outcome, Option<Text>) {
    let failed = entry.rows.iter().filter(|row| !row.state.is_success());
    let reasons: Vec<Text> = failed
        .map(|row| {
            let reason = row.explanation.clone().unwrap_or_else(|| row.state.name());
            Text::joined(": ", vec![row.vehicle.to_string().into(), reason])
        })
        .collect();
    let not_taken = [RowState::Refused, RowState::Barred];
    let is_refused = entry.rows.iter().any(|row| not_taken.contains(&row.state));
    match (reasons.is_empty(), is_refused) {
        (true, _) => (Outcome::Done, None),
        (false, true) => (
            Outcome::Refused(Refusal::Vehicle),
            Some(Text::joined("; ", reasons)),
        ),
        (false, false) => (Outcome::NoEffect, Some(Text::joined("; ", reasons))),
    }
}

/// Hands the vehicles back to the trainee when the desk is gone.
pub(super) fn settle(state: &mut State) -> Effects {
    let wall = state.wall;
    let place = state.class.seat();
    let is_gone = place.is_some_and(|place| !place.hears_desk(wall));
    let person = place.and_then(SeatPlace::instructor);
    let Some(person) = person.filter(|_| is_gone) else {
        return Effects::none();
    };
    let vehicles = state.session.pilots.flown_by(&person);
    if vehicles.is_empty() {
        return Effects::none();
    }
    state.session.pilots.hand_back(&vehicles, &person);
    let text = text!(
        "pilot-desk-gone",
        pilot = person.name(),
        vehicles = ranges(vehicles.iter().copied())
    );
    tell(state, Severity::Warning, text);
    let line = DeskRecord {
        by: person.name().to_owned(),
        deed: Deed::HandBack { vehicles },
        outcome: Outcome::Done,
        why: None,
    };
    state.session.note_instructor(&line, state.now);
    Effects::from(Effect::Class(ClassEffect::Note(line)))
}
