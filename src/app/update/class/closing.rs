//! What the end of the desk means for its seats.

use crate::app::State;
use crate::class::{Deed, Desk, FlightReport, SeatRecord, Stage};
use crate::text;
use crate::text::Text;

/// What happens to seats if the desk closes now; empty if nothing does, and at consoles that are no desk.
pub fn left_behind(state: &State) -> Vec<Text> {
    let flown = seats(state, |seat| {
        is_so(seat, |flight| !flight.taken.is_empty(), takes)
    });
    let frozen = seats(state, |seat| {
        is_so(seat, |flight| flight.stage == Stage::Frozen, freezes)
    });
    let held = seats(state, |seat| {
        is_so(seat, |flight| flight.stage == Stage::Held, holds)
    });
    let taught = seats(state, |seat| {
        seat.lesson
            .as_ref()
            .is_some_and(|lesson| !lesson.has_ended())
    });
    let named = |seats: Vec<usize>| (!seats.is_empty()).then(|| state.seat_names(&seats));
    [
        named(flown).map(|seats| text!("class-quit-taken", seats = seats)),
        named(frozen).map(|seats| text!("class-quit-frozen", seats = seats)),
        named(held).map(|seats| text!("class-quit-held", seats = seats)),
        named(taught).map(|seats| text!("class-quit-lesson", seats = seats)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Whether a seat's flight is so, by its newest report or by what was ordered since then: a report comes twice a second.
fn is_so(
    seat: &SeatRecord,
    is_reported: impl Fn(&FlightReport) -> bool,
    ordered: impl Fn(&Deed) -> Option<bool>,
) -> bool {
    let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
    let newest = seat.unreported().rev().find_map(ordered);
    newest == Some(true) || flight.is_some_and(is_reported)
}

/// Whether an order stops the time of a flight, or lets it pass.
fn freezes(deed: &Deed) -> Option<bool> {
    match deed {
        Deed::Freeze | Deed::Recall { .. } => Some(true),
        Deed::Resume | Deed::End => Some(false),
        _ => None,
    }
}

/// Whether an order holds a mission, or no longer does.
fn holds(deed: &Deed) -> Option<bool> {
    match deed {
        Deed::Fly { hold, .. } => Some(*hold),
        Deed::Start | Deed::End => Some(false),
        _ => None,
    }
}

/// Whether an order takes vehicles over. Only some of them may have been handed back since.
fn takes(deed: &Deed) -> Option<bool> {
    matches!(deed, Deed::TakeOver { .. }).then_some(true)
}

/// The connected seats that are so.
fn seats(state: &State, is_so: impl Fn(&SeatRecord) -> bool) -> Vec<usize> {
    let seats = state.class.desk().into_iter().flat_map(Desk::seats);
    let meant = seats
        .enumerate()
        .filter(|(_, seat)| seat.is_here() && is_so(seat));
    meant.map(|(index, _)| index).collect()
}
