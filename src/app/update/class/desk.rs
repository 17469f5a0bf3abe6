//! The instructor's desk: what seats say, and orders to them.

use super::super::show::show;
use super::calls;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::room::class::{
    self, BesideScreen, BoardDetail, DeskPage, ResultsPage, ResultsView,
};
use crate::app::state::{Consequence, Room};
use crate::class::protocol::{Denial, SeatMessage};
use crate::class::{ConnectionId, Deed, Desk, DeskHeard, SeatRecord, Words};
use crate::class_text::deed_text;
use crate::language::{self, Meaning, SeatChoice};
use crate::mission::check_condition;
use crate::text;
use crate::text::{Text, clock_s};
use crate::vehicle::Severity;
use crate::verb::{Danger, Verb};

/// Takes in a line of a seat.
pub fn heard(
    state: &mut State,
    connection: ConnectionId,
    user: &str,
    message: SeatMessage,
) -> Effects {
    let wall = state.wall;
    let Some(desk) = state.class.desk_mut() else {
        return Effects::none();
    };
    let outcome = desk.hear(connection, user, message, wall);
    calls::tell(state);
    class::keep_cursor(state);
    match outcome {
        Ok(DeskHeard::Known) => Effects::none(),
        Ok(heard) => {
            // The desk notes what a seat has reported before it confirms the report.
            let mut effects = exam_notes(state);
            effects.extend(Effects::from(Effect::Class(ClassEffect::Receive {
                connection,
                user: user.to_owned(),
                heard,
            })));
            effects
        }
        Err(denial) => Effects::from(Effect::Class(ClassEffect::Deny { connection, denial })),
    }
}

/// The notes that the desk has made, to be kept.
pub(super) fn exam_notes(state: &mut State) -> Effects {
    let Some(desk) = state.class.desk_mut() else {
        return Effects::none();
    };
    let taken = desk.take_exam_notes().into_iter();
    let mut effects = Effects::none();
    for (begun, notes) in taken {
        effects.extend(Effects::from(Effect::Class(ClassEffect::KeepNotes {
            begun,
            notes,
        })));
    }
    effects
}

/// A seat's connection has ended.
pub fn left(state: &mut State, connection: ConnectionId) {
    let wall = state.wall;
    if let Some(desk) = state.class.desk_mut() {
        desk.leave(connection, wall);
    }
}

/// Gives up waiting for answers to old orders, and ends watching a screen that is not shown any more.
pub fn tick(state: &mut State) {
    let wall = state.wall;
    let is_watching = state.rooms.class.page().seat().is_some();
    if state.room != Room::Class && is_watching {
        class::show_page(state, DeskPage::Board);
    }
    if state.class.desk_mut().is_some_and(|desk| desk.expire(wall)) {
        state.touch();
        calls::tell(state);
    }
}

/// Gives an order to seats; asks first before one that ends flights.
///
/// # Errors
/// This console is no desk, or no seat is meant.
pub fn give(state: &mut State, choice: &SeatChoice, deed: Deed) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    if let Deed::Inject {
        when: Some(when), ..
    } = &deed
    {
        check_condition(when.as_str()).map_err(|fault| fault.message)?;
    }
    if *choice == SeatChoice::Addressed && !state.rooms.class.page().is_about_seats() {
        return Err(text!("class-no-seat"));
    }
    let here = connected(state, desk, choice)?;
    if let Some((question, reason)) = question(state, &here, &deed)? {
        let then = Consequence::Instruct { seats: here, deed };
        state.ask(question, reason, then);
        return Ok(Effects::none());
    }
    instruct(state, &here, &deed);
    Ok(Effects::none())
}

/// What is asked before an order is given, and why; `None` if nothing is.
///
/// # Errors
/// A line for vehicles is not one.
fn question(state: &State, seats: &[usize], deed: &Deed) -> Result<Option<(Text, Text)>, Text> {
    let names = || state.seat_names(seats);
    if deed.is_final() {
        let question = text!("class-ask-end", seats = names());
        return Ok(Some((question, text!("class-ask-end-reason"))));
    }
    let line = match deed {
        Deed::Recall { situation } => return Ok(recall_question(state, seats, situation)),
        Deed::Command { line } => line,
        _ => return Ok(None),
    };
    let ask = |verb: &Verb| {
        let question = text!(
            "class-ask-command",
            line = line.as_str().to_uppercase(),
            seats = names()
        );
        let reason = Text::new(format!("verb-{}", verb.name), Vec::new());
        (verb.danger == Danger::Confirm).then_some((question, reason))
    };
    // Names that only the seat knows are for the seat to judge.
    let Ok(read) = state.with_context(|context| language::parse(line.as_str(), context)) else {
        let words = language::words(line.as_str()).into_iter();
        return Ok(words
            .filter_map(|word| language::verb(word.text))
            .find_map(ask));
    };
    if !read.verb.counts_as.is_for_vehicles() || !matches!(read.meaning, Meaning::Act(_)) {
        return Err(text!("class-say-vehicles"));
    }
    Ok(ask(read.verb))
}

/// What is asked before seats return to a situation: how much of each flight is thrown away. `None` if no seat has it.
fn recall_question(state: &State, seats: &[usize], wanted: &Words) -> Option<(Text, Text)> {
    let known = state.class.desk().map_or(&[][..], Desk::seats);
    let (mut back, mut losses) = (Vec::new(), Vec::new());
    for &seat in seats {
        let Some(known) = known.get(seat) else {
            continue;
        };
        let flight = known.report.as_ref().and_then(|it| it.flight.as_ref());
        let situation = flight.and_then(|flight| Some((flight, flight.situation(wanted)?)));
        if let Some((flight, situation)) = situation {
            back.push(seat);
            losses.push(text!(
                "class-ask-recall-seat",
                seat = known.name.as_str(),
                at = clock_s(situation.clock_s),
                lost = clock_s(flight.clock_s - situation.clock_s)
            ));
        }
    }
    if back.is_empty() {
        return None;
    }
    let question = text!(
        "class-ask-recall",
        situation = wanted.as_str(),
        seats = state.seat_names(&back)
    );
    let practice = text!("class-ask-recall-practice");
    let reasons = losses.into_iter().chain([practice]).collect();
    Some((question, Text::joined("; ", reasons)))
}

/// The connected seats that are meant.
///
/// # Errors
/// There is none.
pub(super) fn connected(
    state: &State,
    desk: &Desk,
    choice: &SeatChoice,
) -> Result<Vec<usize>, Text> {
    let seats = match choice {
        SeatChoice::Addressed => class::addressed(state),
        SeatChoice::All => (0..desk.seats().len()).collect(),
        SeatChoice::Named(name) => {
            let named = |seat: &SeatRecord| seat.name == *name;
            desk.seats().iter().position(named).into_iter().collect()
        }
    };
    let is_here = |seat: &usize| desk.seats().get(*seat).is_some_and(SeatRecord::is_here);
    let here: Vec<usize> = seats.into_iter().filter(is_here).collect();
    if here.is_empty() {
        return Err(text!("class-no-seat"));
    }
    Ok(here)
}

/// Shows the screen of the seat that is meant: of several, the first one.
///
/// # Errors
/// This console is no desk, or no connected seat is meant.
pub fn watch(state: &mut State, choice: &SeatChoice) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let seat = match (choice, state.rooms.class.cursor()) {
        (SeatChoice::Addressed, Some(cursor)) => cursor,
        _ => connected(state, desk, choice)?[0],
    };
    if !desk.seats().get(seat).is_some_and(SeatRecord::is_here) {
        return Err(text!("class-no-seat"));
    }
    show(state, Room::Class);
    class::show_screen(state, seat);
    Ok(Effects::none())
}

/// Shows the board again.
///
/// # Errors
/// This console is no desk.
pub fn unwatch(state: &mut State) -> Result<Effects, Text> {
    state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    class::show_page(state, DeskPage::Board);
    Ok(Effects::none())
}

/// Shows what is behind the screens of the marked seats; without marks, of the first ones of the board.
///
/// # Errors
/// This console is no desk, or no seat is connected.
pub fn show_tiles(state: &mut State) -> Result<Effects, Text> {
    state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    show(state, Room::Class);
    if class::show_tiles(state) {
        Ok(Effects::none())
    } else {
        Err(text!("class-no-seat"))
    }
}

/// Shows the state of the flight instead of the watched screen, or the screen again; without a watched screen, that of
/// the seat under the cursor.
///
/// # Errors
/// This console is no desk, or no connected seat is meant.
pub fn show_state(state: &mut State) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    if state.rooms.class.screen_mut().is_none() {
        let seat = connected(state, desk, &SeatChoice::Addressed)?[0];
        show(state, Room::Class);
        class::show_screen(state, seat);
    }
    if let Some(page) = state.rooms.class.screen_mut() {
        page.beside = match page.beside() {
            BesideScreen::Flight => BesideScreen::IfRoom,
            BesideScreen::IfRoom | BesideScreen::Injects => BesideScreen::Flight,
        };
    }
    state.touch();
    Ok(Effects::none())
}

/// Shows the injects of a seat, by default the one under the cursor, instead of what happened there, or beside its
/// screen.
///
/// # Errors
/// This console is no desk, or no seat is meant.
pub fn show_injects(state: &mut State, choice: &SeatChoice) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let meant = match choice {
        SeatChoice::Addressed => None,
        named => Some(connected(state, desk, named)?[0]),
    };
    show(state, Room::Class);
    if meant.is_some() && meant != state.rooms.class.page().seat() {
        class::show_page(state, DeskPage::Board);
        state.rooms.class.cursor = meant;
    }
    if let Some(page) = state.rooms.class.screen_mut() {
        page.beside = BesideScreen::Injects;
        return Ok(Effects::none());
    }
    class::show_page(state, DeskPage::Board);
    state.rooms.class.detail = BoardDetail::Injects;
    Ok(Effects::none())
}

/// Shows the results of the class, or their next page.
///
/// # Errors
/// This console is no desk.
pub fn show_results(state: &mut State) -> Result<Effects, Text> {
    state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    show(state, Room::Class);
    let view = match state.rooms.class.page() {
        DeskPage::Results(view) => view.next(),
        _ => ResultsView::of(ResultsPage::Objectives),
    };
    class::show_page(state, DeskPage::Results(view));
    Ok(Effects::none())
}

/// Gives an order to these seats.
pub fn instruct(state: &mut State, seats: &[usize], deed: &Deed) {
    let wall = state.wall;
    if let Some(desk) = state.class.desk_mut() {
        desk.give(seats, deed, wall);
    }
    let text = text!(
        "class-given",
        deed = deed_text(deed),
        seats = state.seat_names(seats)
    );
    state.say(Severity::Notice, text);
    state.touch();
}

pub(super) fn denial_text(denial: Denial) -> Text {
    match denial {
        Denial::Version { desk } => text!("class-denial-version", desk = desk),
        Denial::Full => text!("class-denial-full"),
        Denial::NoHello => text!("class-denial-hello"),
    }
}
