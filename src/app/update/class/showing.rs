//! The class debrief: the desk replays flights that were handed in, and shows the replay to seats.

use super::super::loss::loss;
use super::super::show::show;
use super::desk::{connected, instruct};
use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects, SessionEffect};
use crate::app::room::class::{DeskPage, GradingPage, ReplayedFlights, is_for_class, show_page};
use crate::app::state::{Consequence, Room};
use crate::class::{Deed, Desk, Refusal, SeatRecord};
use crate::class_results::FoundFlights;
use crate::grading::GradedFlight;
use crate::language::{GhostSource, ReplayedTrainees, SeatChoice};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Asks for the flight that is being graded, otherwise for the newest one of a trainee, and for one of another trainee
/// in the same mission.
///
/// # Errors
/// This console is no desk, or no trainee is meant.
pub(super) fn replay(state: &mut State, trainees: ReplayedTrainees) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let ReplayedTrainees { trainee, beside } = trainees;
    let room = &state.rooms.class;
    let graded = room.grading().map(GradingPage::flight);
    let graded = graded.filter(|it| trainee.as_ref().is_none_or(|user| it.user == *user));
    let under_cursor = || {
        let seat = desk.seats().get(room.cursor()?)?;
        Some(seat.user().to_owned())
    };
    let user = trainee.or_else(|| graded.map(|it| it.user.clone()));
    let user = user.or_else(under_cursor);
    let user = user.ok_or_else(|| text!("grading-no-trainee"))?;
    Ok(Effect::Class(ClassEffect::FindFlights {
        user,
        record: graded.map(|it: &GradedFlight| it.record.clone()),
        beside,
    })
    .into())
}

/// Replays the flights that were asked for.
pub(super) fn found(state: &mut State, found: Result<FoundFlights, Text>) -> Effects {
    let found = match found {
        Ok(found) => found,
        Err(fault) => {
            state.say(Severity::Warning, fault);
            return Effects::none();
        }
    };
    if let Some(reason) = loss(state) {
        let then = Consequence::ReplayHandedIn(found);
        state.ask(text!("ask-replay"), reason, then);
        return Effects::none();
    }
    replay_found(state, found)
}

/// Replays flights that were handed in.
pub fn replay_found(state: &mut State, found: FoundFlights) -> Effects {
    let path = Some(found.frames.clone());
    state.rooms.class.replay_asked = Some(found);
    let review = false;
    Effect::Session(SessionEffect::Replay { path, review }).into()
}

/// Shows the second flight once the first is there, and ends showing when nothing is replayed any more.
pub(super) fn tick(state: &mut State) -> Effects {
    let replayed = state.replay.as_ref().map(|view| view.name.clone());
    let is_over = replayed.is_none();
    let is_exam = state.class.desk().is_some_and(holds_exam);
    if let Some(desk) = state.class.desk_mut().filter(|_| is_over || is_exam)
        && desk.is_showing()
    {
        desk.show(false);
        state.say(Severity::Notice, text!("class-show-over"));
    }
    if is_over && std::mem::take(&mut state.rooms.class.replays) {
        if matches!(state.rooms.class.page(), DeskPage::Replay(_)) {
            show_page(state, DeskPage::Board);
        }
        if state.room == Room::Home {
            show(state, Room::Class);
        }
    }
    let asked = &mut state.rooms.class.replay_asked;
    if replayed.is_some() && asked.as_ref().map(|it| &it.record) != replayed.as_ref() {
        // Another flight was opened instead.
        *asked = None;
    }
    let is_there = |it: &mut FoundFlights| replayed.as_ref() == Some(&it.record);
    let Some(found) = asked.take_if(is_there) else {
        return Effects::none();
    };
    state.rooms.class.replays = true;
    let Some(beside) = found.beside else {
        return Effects::none();
    };
    show(state, Room::Class);
    let flights = ReplayedFlights {
        own: found.trainee,
        other: beside.trainee,
    };
    show_page(state, DeskPage::Replay(flights));
    let source = GhostSource::File(beside.run);
    Effect::Session(SessionEffect::Ghost(source)).into()
}

/// Lets seats look on at the replay: those that are named, otherwise the marked ones, otherwise all.
///
/// # Errors
/// This console is no desk, nothing is replayed, an exam is held, or no connected seat is meant.
pub(super) fn show_class(state: &mut State, choice: &SeatChoice) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    if state.replay.is_none() {
        return Err(text!("class-show-nothing"));
    }
    if holds_exam(desk) {
        return Err(text!("class-show-exam"));
    }
    let seats = match choice {
        SeatChoice::Addressed => marked_or_all(state, desk)?,
        named => connected(state, desk, named)?,
    };
    if let Some(desk) = state.class.desk_mut() {
        desk.show(true);
    }
    if !is_for_class(state) {
        show(state, Room::Map);
    }
    instruct(state, &seats, &Deed::LookOn);
    Ok(Effects::none())
}

/// Whether an exam is under way, during which nothing is shown.
fn holds_exam(desk: &Desk) -> bool {
    desk.exam().is_some_and(|exam| !exam.is_stopped())
}

/// The marked seats that are connected; without marks, all that are.
fn marked_or_all(state: &State, desk: &Desk) -> Result<Vec<usize>, Text> {
    let room = &state.rooms.class;
    let is_meant = |seat: &usize| room.marked() == 0 || room.is_marked(*seat);
    let is_here = |seat: &usize| desk.seats().get(*seat).is_some_and(SeatRecord::is_here);
    let seats: Vec<usize> = (0..desk.seats().len())
        .filter(is_meant)
        .filter(is_here)
        .collect();
    if seats.is_empty() {
        return Err(text!("class-no-seat"));
    }
    Ok(seats)
}

/// No longer shows anything to seats.
///
/// # Errors
/// This console is no desk, or shows nothing.
pub(super) fn stop(state: &mut State) -> Result<Effects, Text> {
    let desk = state.class.desk_mut();
    let desk = desk.ok_or_else(|| text!("class-no-desk"))?;
    if !desk.is_showing() {
        return Err(text!("class-show-none"));
    }
    desk.show(false);
    state.say(Severity::Notice, text!("class-show-stopped"));
    Ok(Effects::none())
}

/// At a seat: the trainee looks on at what the desk shows, unless a flight is under way.
pub(super) fn look_on(state: &mut State) -> Result<(), Refusal> {
    let session = &state.session;
    let is_flying = session.activity.is_some() && state.replay.is_none() && !session.task.over;
    if is_flying {
        return Err(Refusal::Flying);
    }
    let room = state.room;
    if let Some(place) = state.class.seat_mut() {
        place.seat.look_on(true);
        place.looked_from = Some(room).filter(|room| *room != Room::Class);
    }
    show(state, Room::Class);
    Ok(())
}

/// At a seat: what the desk showed is closed, and the room from before is shown.
pub fn look_away(state: &mut State, text: Text) {
    let Some(place) = state.class.seat_mut().filter(|place| place.seat.looks_on()) else {
        return;
    };
    place.seat.look_on(false);
    let back = place.looked_from.take();
    if state.room == Room::Class {
        show(state, back.unwrap_or(Room::Home));
    }
    tell(state, Severity::Notice, text);
}
