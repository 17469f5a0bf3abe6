//! The seats of a mission's fleet. Either the mission lends drones for all of them, or the trainee
//! chooses a design for each.

use super::{lacking, mission};
use crate::app::State;
use crate::app::action::Step;
use crate::app::room::RoomRequest;
use crate::mission::Listing;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity as Weight;
use crate::workshop::{Design, FindingSeverity};

/// A drone's place in the fleet of a mission, and the design for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seat<'a> {
    /// The seat's number, from 1.
    pub number: usize,
    /// The design chosen for the seat; `None` if the mission lends a drone.
    pub design: Option<&'a Design>,
}

/// The seats of a mission, each with the design chosen for it.
pub fn seats<'a>(state: &'a State, mission: &Listing) -> Vec<Seat<'a>> {
    let fleet = state.training.fleets.get(&mission.id);
    let chosen = |seat: usize| match fleet.map(Vec::as_slice)? {
        [all] => Some(all),
        each => each.get(seat),
    };
    let seats = 0..mission.vehicles;
    seats
        .map(|seat| Seat {
            number: seat + 1,
            design: chosen(seat),
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

/// Chooses the design on the bench for every seat.
pub(super) fn assign_all(state: &mut State) {
    assign(state, None);
}

/// Chooses the design on the bench for a seat, or for all seats with `None`. The first choice is
/// for all seats: a mission does not lend only part of a fleet.
fn assign(state: &mut State, seat: Option<usize>) {
    let Some(mission) = mission(state) else {
        return state.say(Weight::Notice, text!("bench-no-mission"));
    };
    if let Err(reason) = check(state, mission) {
        return state.say(Weight::Warning, reason);
    }
    let (id, count) = (mission.id.clone(), mission.vehicles);
    let design = state.rooms.workshop.bench.design().clone();
    let before: Vec<Design> = seats(state, mission)
        .into_iter()
        .filter_map(|seat| seat.design.cloned())
        .collect();
    let mut fleet = before;
    let alone = seat.filter(|&seat| fleet.len() == count && seat < count);
    match alone {
        Some(seat) => fleet[seat] = design,
        None => fleet = vec![design; count],
    }
    let name = fleet[seat.unwrap_or_default()].name.clone();
    state.training.fleets.insert(id, fleet);
    let text = match seat {
        Some(seat) => text!("bench-seat-taken", seat = seat + 1, name = name),
        None => text!("bench-seats-taken", name = name),
    };
    state.say(Weight::Notice, text);
}

/// Checks whether the design on the bench can be chosen for a mission, in that mission's air.
///
/// # Errors
/// The first fault of the design, or a part that the trainee may not use.
fn check(state: &State, mission: &Listing) -> Result<(), Text> {
    let design = state.rooms.workshop.bench.design();
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
