//! What the end of the desk means for its seats.

use crate::app::State;
use crate::class::{Desk, FlightReport, SeatRecord, Stage};
use crate::text;
use crate::text::Text;

/// What happens to seats if the desk closes now; empty if nothing does, and at consoles that are no desk.
pub fn left_behind(state: &State) -> Vec<Text> {
    let flown = flying(state, |flight| !flight.taken.is_empty());
    let frozen = flying(state, |flight| flight.stage == Stage::Frozen);
    let held = flying(state, |flight| flight.stage == Stage::Held);
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

/// The connected seats whose flight is so.
fn flying(state: &State, is_so: impl Fn(&FlightReport) -> bool) -> Vec<usize> {
    seats(state, |seat| {
        let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
        flight.is_some_and(&is_so)
    })
}

/// The connected seats that are so.
fn seats(state: &State, is_so: impl Fn(&SeatRecord) -> bool) -> Vec<usize> {
    let seats = state.class.desk().into_iter().flat_map(Desk::seats);
    let meant = seats
        .enumerate()
        .filter(|(_, seat)| seat.is_here() && is_so(seat));
    meant.map(|(index, _)| index).collect()
}
