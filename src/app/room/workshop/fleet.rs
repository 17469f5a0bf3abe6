//! The seats of a mission's fleet. For each kind of vehicle, either the mission lends all of them, or
//! the trainee chooses a design for each.

use super::{lacking, mission};
use crate::app::State;
use crate::app::action::Step;
use crate::app::room::RoomRequest;
use crate::mission::{Listing, dealt};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity as Weight;
use crate::workshop::{Design, DesignKind, FindingSeverity};

/// A vehicle's place in the fleet of a mission, and the design for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seat<'a> {
    /// The seat's number, from 1.
    pub number: usize,
    /// The kind of vehicle that the seat takes.
    pub kind: DesignKind,
    /// The design chosen for the seat; `None` if the mission lends a vehicle.
    pub design: Option<&'a Design>,
}

/// The seats of a mission, each with the design chosen for it.
pub fn seats<'a>(state: &'a State, mission: &Listing) -> Vec<Seat<'a>> {
    let fleet = state.training.fleets.get(&mission.id);
    let designs = dealt(&mission.seats, fleet.map_or(&[], Vec::as_slice));
    let numbered = (1..).zip(&mission.seats).zip(designs);
    numbered
        .map(|((number, kind), design)| Seat {
            number,
            kind: *kind,
            design,
        })
        .collect()
}

/// The price of all chosen designs, in credits.
pub fn bill(state: &State, mission: &Listing) -> u32 {
    let seats = seats(state, mission).into_iter();
    seats
        .filter_map(|seat| seat.design)
        .map(Design::credits)
        .sum()
}

pub(super) fn step(state: &mut State, step: Step) {
    let count = mission(state).map_or(0, |mission| mission.vehicles);
    let seat = &mut state.rooms.workshop.seat;
    *seat = step.apply((*seat).min(count.saturating_sub(1)), count);
}

/// Chooses the design on the bench for the seat under the cursor.
pub(super) fn assign_one(state: &mut State) {
    let count = mission(state).map_or(0, |mission| mission.vehicles);
    let seat = state.rooms.workshop.seat;
    assign(state, Some(seat.min(count.saturating_sub(1))));
}

/// Chooses the design on the bench for every seat of its kind.
pub(super) fn assign_all(state: &mut State) {
    assign(state, None);
}

/// Chooses the design on the bench for a seat, or for all seats of its kind with `None`. The first choice is
/// for all of them: a mission does not lend only some of the vehicles of a kind.
fn assign(state: &mut State, seat: Option<usize>) {
    let Some(mission) = mission(state) else {
        return state.say(Weight::Notice, text!("bench-no-mission"));
    };
    if let Err(reason) = check(state, mission, seat) {
        return state.say(Weight::Warning, reason);
    }
    let design = state.rooms.workshop.bench.design();
    let kind = design.kind();
    let seats = seats(state, mission);
    let has_own = |it: &Seat<'_>| it.kind == kind && it.design.is_some();
    let alone = seat.filter(|_| seats.iter().any(has_own));
    let chosen = |(at, it): (usize, &Seat<'_>)| match alone {
        Some(alone) if alone == at => Some(design.clone()),
        None if it.kind == kind => Some(design.clone()),
        _ => it.design.cloned(),
    };
    let fleet: Vec<Design> = seats.iter().enumerate().filter_map(chosen).collect();
    let (id, name) = (mission.id.clone(), design.name.clone());
    let are_alike = seats.iter().all(|it| it.kind == kind);
    state.training.fleets.insert(id, fleet);
    let text = match seat {
        Some(seat) => text!("bench-seat-taken", seat = seat + 1, name = name),
        None if are_alike => text!("bench-seats-taken", name = name),
        None => text!("bench-kind-seats-taken", name = name, kind = kind.id()),
    };
    state.say(Weight::Notice, text);
}

/// Checks whether the design on the bench can be chosen for a seat of a mission, or for some seat, in that mission's
/// air.
///
/// # Errors
/// The seat takes another kind of vehicle; the first fault of the design; or a part that the trainee may not use.
fn check(state: &State, mission: &Listing, seat: Option<usize>) -> Result<(), Text> {
    let design = state.rooms.workshop.bench.design();
    unseated(design.kind(), mission, seat)?;
    let air = mission.needs.first().map(|need| need.air);
    let findings = design.findings(air.unwrap_or_default());
    if let Some(fault) = findings
        .iter()
        .find(|it| it.severity() == FindingSeverity::Fault)
    {
        return Err(text!("bench-does-not-fly", reason = fault.text.clone()));
    }
    match lacking(state, design).first() {
        Some(part) => Err(text!("bench-lacks-licence", part = part.name())),
        None => Ok(()),
    }
}

/// Checks that a seat takes a kind of vehicle; with `None`, that some seat does.
fn unseated(kind: DesignKind, mission: &Listing, seat: Option<usize>) -> Result<(), Text> {
    match seat.and_then(|seat| Some((seat, mission.seats.get(seat)?))) {
        Some((seat, taken)) if *taken != kind => Err(text!(
            "bench-seat-kind",
            seat = seat + 1,
            taken = taken.name(),
            kind = kind.name()
        )),
        None if !mission.seats.contains(&kind) => Err(text!("bench-no-seat", kind = kind.name())),
        _ => Ok(()),
    }
}

pub(super) fn give_back(state: &mut State) {
    let id = mission(state).map(|mission| mission.id.clone());
    if id.is_some_and(|id| state.training.fleets.remove(&id).is_some()) {
        state.say(Weight::Notice, text!("bench-seats-lent"));
    }
}

/// Flies the mission with the fleet, if it is within the budget.
pub(super) fn fly(state: &mut State) -> Vec<RoomRequest> {
    let Some(mission) = mission(state) else {
        state.say(Weight::Notice, text!("bench-no-mission"));
        return Vec::new();
    };
    let (id, cost) = (mission.id.clone(), bill(state, mission));
    if let Some(budget) = mission.outlay.budget.filter(|budget| cost > *budget) {
        let text = text!("bench-over-budget", cost = cost, budget = budget);
        state.say(Weight::Warning, text);
        return Vec::new();
    }
    vec![RoomRequest::Fly(state.training().launch(&id))]
}
