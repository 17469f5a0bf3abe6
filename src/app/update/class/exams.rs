//! The exam of the desk.

use super::desk::{connected, exam_notes, names};
use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::class::{Desk, Exam, ExamFault};
use crate::language::SeatChoice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Goes on with the exam of all trainees.
pub(super) fn tick(state: &mut State) -> Effects {
    let wall = state.wall;
    if state
        .class
        .desk_mut()
        .is_some_and(|desk| desk.examine(wall))
    {
        state.touch();
    }
    exam_notes(state)
}

/// Reads an exam, to let seats take part.
///
/// # Errors
/// This console is no desk, no connected seat is meant, or another exam is held.
pub(super) fn begin(state: &State, choice: &SeatChoice, exam: String) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let seats = connected(state, desk, choice)?;
    Ok(Effect::Class(ClassEffect::ReadExam { name: exam, seats }).into())
}

/// Handles an exam that was read: it begins, or more seats take part in it.
pub(super) fn read(
    state: &mut State,
    name: &str,
    exam: Result<Box<Exam>, Text>,
    seats: &[usize],
) -> Effects {
    let wall = state.wall;
    let meant = names(state, seats);
    let begun = exam.and_then(|exam| {
        let desk = state.class.desk_mut();
        let desk = desk.ok_or_else(|| text!("class-no-desk"))?;
        seat(desk, *exam, seats, wall)
    });
    let (severity, text) = match begun {
        Ok(()) => (
            Severity::Notice,
            text!("class-exam-begun", exam = name, seats = meant),
        ),
        Err(fault) => (
            Severity::Warning,
            text!("class-exam-unread", exam = name, fault = fault),
        ),
    };
    state.say(severity, text);
    exam_notes(state)
}

/// Lets seats take part in an exam; if the desk holds it already, in that one.
fn seat(
    desk: &mut Desk,
    exam: Exam,
    seats: &[usize],
    wall: std::time::Duration,
) -> Result<(), Text> {
    let held = desk.exam().filter(|it| !it.is_stopped());
    let held = held.map(|it| it.plan().name.clone());
    if held.as_ref() != Some(&exam.plan().name) {
        desk.hold(exam).map_err(|_| {
            let held = held.map(|it| it.to_string()).unwrap_or_default();
            text!("class-exam-other", exam = held)
        })?;
    }
    let seated = desk.seat_candidates(seats, wall);
    seated.map_err(|_| text!("class-exam-none"))
}

/// Goes on with an exam that an earlier desk has begun.
pub(super) fn found(state: &mut State, exam: Exam) {
    let name = exam.plan().name.to_string();
    let Some(desk) = state.class.desk_mut() else {
        return;
    };
    if desk.hold(exam).is_ok() {
        state.say(Severity::Notice, text!("class-exam-found", exam = name));
    } else {
        // The instructor was faster than the reading of the notes.
        let held = desk.exam().map(|it| it.plan().name.to_string());
        let held = held.unwrap_or_default();
        let text = text!("class-exam-found-other", exam = name, held = held);
        tell(state, Severity::Warning, text);
    }
    state.touch();
}

/// Ends the exam.
///
/// # Errors
/// This console is no desk, or holds no exam.
pub(super) fn stop(state: &mut State) -> Result<Effects, Text> {
    let wall = state.wall;
    let desk = state.class.desk_mut();
    let stopped = desk.ok_or_else(|| text!("class-no-desk"))?.stop_exam(wall);
    let name = stopped.map_err(|fault| match fault {
        ExamFault::None | ExamFault::Other => text!("class-exam-none"),
    })?;
    state.say(
        Severity::Notice,
        text!("class-exam-stopped", exam = name.as_str()),
    );
    state.touch();
    Ok(exam_notes(state))
}
