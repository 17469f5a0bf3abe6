//! A class: what a seat notes for the desk, the desk's orders to it, and the desk itself.
//!
//! # How the parts fit
//! - At a seat: `witness` finds what happened in an event, `orders` carries out what the desk asks for.
//! - After a flight: `hand_in`, the records that a seat hands in.
//! - What the desk shows to the class: `showing`, at the desk and at a seat.
//! - At the desk: `desk` takes in what seats say, and gives orders; `calls` tells how they ended, `closing` what
//!   the end of the desk means; `lessons` gives them by a plan; `exams` holds an
//!   exam; `grading` is the instructor's judgement of a flight.

use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::app::event::ClassEvent;
use crate::app::state::{ClassRole, Consequence};
use crate::class::protocol::DeskMessage;
use crate::class::{Consent, Happening};
use crate::language::ClassLine;
use crate::notice::{Notice, NoticeSource};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

mod calls;
mod closing;
mod desk;
mod exams;
mod grading;
mod hand_in;
mod lessons;
mod orders;
mod showing;
mod witness;

pub use closing::left_behind;
pub use desk::instruct;
pub use exams::{begin_at_desk as begin_exam, end_at_desk as end_exam};
pub use orders::{instructed, recalled};
pub use showing::{look_away, replay_found};
pub use witness::witnessed;

/// The interval between searches for dangers, in milliseconds.
const LOOK_MS: u128 = 500;

/// Handles an event of a class.
pub fn happened(state: &mut State, event: ClassEvent) -> Effects {
    state.touch();
    match event {
        ClassEvent::Found { instructor } => found(state, &instructor),
        ClassEvent::Said(message) => return said(state, message),
        ClassEvent::Lost => lost(state),
        ClassEvent::Refused(text) => refused(state, text),
        ClassEvent::Begun { id, refusal } => return orders::begun(state, id, refusal),
        ClassEvent::TryRefused(why) => return orders::try_refused(state, why),
        ClassEvent::Heard {
            connection,
            user,
            message,
        } => return desk::heard(state, connection, &user, message),
        ClassEvent::Left(connection) => desk::left(state, connection),
        ClassEvent::Recorded(record) => return hand_in::recorded(state, record),
        ClassEvent::Offered(submission) => hand_in::offered(state, submission),
        ClassEvent::Unreadable { record, error } => {
            return hand_in::unreadable(state, record, error);
        }
        ClassEvent::Kept {
            user,
            mission,
            score,
        } => {
            let text = text!("class-kept", user = user, mission = mission, score = score);
            tell(state, Severity::Notice, text);
        }
        ClassEvent::NotKept {
            user,
            record,
            refusal,
            words,
        } => hand_in::not_kept(state, &user, &record, refusal, words),
        ClassEvent::Unscored(fault) => {
            tell(
                state,
                Severity::Warning,
                text!("class-unscored", fault = fault),
            );
        }
        ClassEvent::Lessons(lessons) => state.rooms.class.lessons.listed = Some(lessons),
        ClassEvent::LessonRead {
            name,
            lesson,
            seats,
        } => lessons::read(state, &name, lesson, &seats),
        ClassEvent::Graded { asked, flight } => grading::read(state, &asked, flight),
        ClassEvent::GradesWait { count, fault } => grading::wait(state, count, fault),
        ClassEvent::Exam(event) => return exams::happened(state, event),
        ClassEvent::FlightsFound(found) => return showing::found(state, found),
        ClassEvent::Results(results) => state.rooms.class.results = Some(results),
    }
    Effects::none()
}

fn found(state: &mut State, instructor: &str) {
    if let Some(place) = state.class.seat_mut() {
        place.seat.find(instructor);
        place.search.refused = None;
    }
}

fn refused(state: &mut State, text: Text) {
    if let Some(place) = state.class.seat_mut() {
        place.search.refused = Some(text.clone());
    }
    tell(state, Severity::Warning, text);
}

fn lost(state: &mut State) {
    let was_watched = state.class.watcher().is_some();
    let was_frozen = state.class.is_frozen() && state.session.is_paused();
    showing::look_away(state, text!("class-shown-over"));
    if let Some(place) = state.class.seat_mut() {
        place.seat.lose();
    }
    if was_watched {
        let text = if was_frozen {
            text!("class-lost-frozen")
        } else if state.session.activity.is_some() {
            text!("class-lost")
        } else {
            text!("class-lost-home")
        };
        tell(state, Severity::Notice, text);
    }
}

fn said(state: &mut State, message: DeskMessage) -> Effects {
    let wall = state.wall;
    // A desk that denies the seat has nothing to say about its flight.
    if let Some(place) = state.class.seat_mut()
        && !matches!(message, DeskMessage::Denied(_))
    {
        place.heard_at = wall;
    }
    match message {
        DeskMessage::Welcome {
            class,
            name,
            instructor,
            ..
        } => {
            let Some(place) = state.class.seat_mut() else {
                return Effects::none();
            };
            place.seat.enter(class.clone(), name, &instructor);
            let instructor = place.seat.instructor().unwrap_or_default().to_owned();
            let text = text!(
                "class-joined",
                class = class.as_str(),
                instructor = instructor
            );
            tell(state, Severity::Notice, text);
        }
        DeskMessage::Denied(denial) => {
            let text = text!("class-denied", reason = desk::denial_text(denial));
            tell(state, Severity::Warning, text);
        }
        DeskMessage::Order(given) => return orders::given(state, given),
        DeskMessage::Watch { on, .. } => {
            if let Some(place) = state.class.seat_mut() {
                place.seat.let_watch(on);
            }
        }
        DeskMessage::Show(part) => {
            if let Some(place) = state.class.seat_mut() {
                place.seat.see(&part);
            }
        }
        DeskMessage::Hide => showing::look_away(state, text!("class-shown-over")),
        DeskMessage::Settled { record, end } => return hand_in::settled(state, record, end),
        // What is to be sent is a matter of the connection.
        DeskMessage::Ask { .. }
        | DeskMessage::Fetch(_)
        | DeskMessage::Witnessed { .. }
        | DeskMessage::Here => {}
    }
    Effects::none()
}

/// Shows a text on the last line, and keeps it among the notices.
fn tell(state: &mut State, severity: Severity, text: Text) {
    state.notices.push(Notice {
        source: NoticeSource::Class,
        ..Notice::general(state.now, severity, text.clone())
    });
    state.say(severity, text);
}

/// What follows from an event for a class, after the console has handled it: entries of the journal, the ends of orders,
/// and the question whether the trainee joins.
pub fn follow(state: &mut State, is_tick: bool, noted: Vec<Happening>, effects: &mut Effects) {
    match &state.class {
        ClassRole::Desk(_) if is_tick => {
            desk::tick(state);
            effects.extend(showing::tick(state));
            effects.extend(lessons::tick(state));
            effects.extend(exams::tick(state));
            return;
        }
        ClassRole::None | ClassRole::Desk(_) => return,
        ClassRole::Seat(_) => {}
    }
    let commands = effects.iter().filter_map(|effect| match effect {
        Effect::Order { order, .. } if order.by.is_none() => Some(Happening::Command {
            line: order.given().line.into(),
        }),
        _ => None,
    });
    let noted: Vec<Happening> = noted.into_iter().chain(commands).collect();
    let clock_s = clock_s(state);
    if let Some(place) = state.class.seat_mut() {
        for what in noted {
            place.note(clock_s, what);
        }
    }
    effects.extend(orders::settle(state));
    if is_tick {
        look(state);
        ask(state);
        search(state);
    }
}

/// Says that no desk answers, if the trainee wants to join and none has answered yet.
fn search(state: &mut State) {
    let wall = state.wall;
    let Some(place) = state.class.seat_mut() else {
        return;
    };
    let is_sought = place.seat.consent() == Consent::Given;
    if !is_sought || place.seat.last_instructor().is_some() {
        return;
    }
    if let Some(text) = place.search.report(wall) {
        tell(state, Severity::Notice, text);
    }
}

/// The time of the mission, in seconds.
fn clock_s(state: &State) -> Option<f64> {
    let progress = state.session.task.progress.as_ref();
    progress.map(|it| crate::text::rounded(it.elapsed.as_secs_f64(), 1))
}

/// Looks for dangers, twice a second while a desk watches.
fn look(state: &mut State) {
    let is_due = state.now.as_millis() / LOOK_MS != looked_ms(state) / LOOK_MS;
    if !is_due || state.replay.is_some() || state.class.watcher().is_none() {
        return;
    }
    let near = state.session.nearness(&state.config.alerts);
    let now = state.now;
    if let Some(place) = state.class.seat_mut() {
        place.looked_at = now;
        place.danger = near.danger;
        let both = place
            .least_separation_m
            .into_iter()
            .chain(near.separation_m);
        place.least_separation_m = both.min_by(f64::total_cmp);
    }
}

fn looked_ms(state: &State) -> u128 {
    let place = state.class.seat();
    place.map_or(0, |place| place.looked_at.as_millis())
}

/// Asks the trainee once whether to join a class that the configuration names.
fn ask(state: &mut State) {
    let is_free = state.overlay.is_none() && !state.is_deaf();
    let Some(place) = state.class.seat_mut().filter(|_| is_free) else {
        return;
    };
    if place.seat.consent() != Consent::Unasked {
        return;
    }
    let Some(instructor) = place.seat.instructor().map(str::to_owned) else {
        return;
    };
    // Any answer but yes is no.
    place.seat.decide(false);
    let question = text!("class-ask", instructor = instructor);
    let reason = text!("class-ask-reason");
    state.ask(question, reason, Consequence::JoinClass);
}

/// Carries out a line about the class.
///
/// # Errors
/// Why it is not possible.
pub fn carry_out(state: &mut State, line: ClassLine) -> Result<Effects, Text> {
    match line {
        ClassLine::Join | ClassLine::Leave => {
            let joins = line == ClassLine::Join;
            if !joins {
                may_leave(state)?;
            }
            let place = state.class.seat_mut().ok_or_else(|| text!("class-none"))?;
            place.seat.decide(joins);
            if !joins {
                place.seat.lose();
            }
            let text = if joins {
                text!("class-joining")
            } else {
                text!("class-left")
            };
            state.say(Severity::Notice, text);
            Ok(Effects::none())
        }
        ClassLine::Give { seats, deed } => desk::give(state, &seats, deed),
        ClassLine::Lessons => lessons::show_lessons(state),
        ClassLine::Teach { seats, lesson } => lessons::teach(state, &seats, lesson),
        ClassLine::Direct { seats, direction } => lessons::direct(state, &seats, direction),
        ClassLine::Examine { seats, exam } => exams::begin(state, &seats, exam),
        ClassLine::StopExam => exams::stop(state),
        ClassLine::Injects(seat) => desk::show_injects(state, &seat),
        ClassLine::Results => desk::show_results(state),
        ClassLine::Grading(line) => grading::carry_out(state, line),
        ClassLine::Watch(choice) => desk::watch(state, &choice),
        ClassLine::Unwatch => desk::unwatch(state),
        ClassLine::Tiles => desk::show_tiles(state),
        ClassLine::State => desk::show_state(state),
        ClassLine::Replay(trainees) => showing::replay(state, trainees),
        ClassLine::Show(seats) => showing::show_class(state, &seats),
        ClassLine::StopShow => showing::stop(state),
    }
}

/// Checks that nothing keeps the trainee in the class.
///
/// # Errors
/// What does.
fn may_leave(state: &State) -> Result<(), Text> {
    if state.has_open_try() {
        return Err(text!("class-exam-no-leave"));
    }
    let kept = state
        .keeps_frozen()
        .or_else(|| state.keeps_vehicles())
        .or_else(|| state.holds_brief());
    kept.map_or(Ok(()), Err)
}

/// The trainee joins the class.
pub fn join(state: &mut State) {
    if let Some(place) = state.class.seat_mut() {
        place.seat.decide(true);
    }
}
