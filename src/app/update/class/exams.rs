//! The exam of the desk.

use super::desk::{connected, exam_notes};
use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::event::ExamEvent;
use crate::app::state::Consequence;
use crate::class::{Desk, Exam};
use crate::class_text::exam_title;
use crate::language::SeatChoice;
use crate::text;
use crate::text::{Text, utc_minute_of};
use crate::vehicle::Severity;

/// Handles what happened to the exam.
pub(super) fn happened(state: &mut State, event: ExamEvent) -> Effects {
    match event {
        ExamEvent::Read { name, exam, seats } => return read(state, &name, exam, &seats),
        ExamEvent::Listed(exams) => state.rooms.class.exams = Some(exams),
        ExamEvent::Found(exam) => found(state, *exam),
        ExamEvent::NotesKept { begun, count } => kept(state, begun, count),
        ExamEvent::Damaged(fault) => tell(state, Severity::Warning, fault),
        ExamEvent::Failed(fault) => {
            let text = text!("class-exam-failed", fault = fault);
            tell(state, Severity::Warning, text);
        }
    }
    Effects::none()
}

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
fn read(state: &mut State, name: &str, exam: Result<Box<Exam>, Text>, seats: &[usize]) -> Effects {
    let wall = state.wall;
    let meant = state.seat_names(seats);
    let title = exam.as_ref().ok().map(|exam| exam_title(exam.plan()));
    let seated = exam.and_then(|exam| {
        let desk = state.class.desk_mut();
        let desk = desk.ok_or_else(|| text!("class-no-desk"))?;
        seat(desk, *exam, seats, wall)
    });
    match seated {
        Ok(true) => state.say(
            Severity::Notice,
            text!(
                "class-exam-begun",
                exam = title.unwrap_or_default(),
                seats = meant
            ),
        ),
        Ok(false) => {}
        Err(fault) => state.say(
            Severity::Warning,
            text!("class-exam-unread", exam = name, fault = fault),
        ),
    }
    exam_notes(state)
}

/// Lets seats take part in an exam; if the desk holds it already, in that one. Returns whether it has begun: a new one
/// begins once its first note is on disk.
fn seat(
    desk: &mut Desk,
    exam: Exam,
    seats: &[usize],
    wall: std::time::Duration,
) -> Result<bool, Text> {
    let held = desk.exam().filter(|it| !it.is_stopped());
    let is_same = held.is_some_and(|it| it.plan().name == exam.plan().name);
    let held = held.map(|it| exam_title(it.plan()));
    if !is_same && !desk.hold(exam) {
        return Err(text!("class-exam-other", exam = held.unwrap_or_default()));
    }
    desk.seat_candidates(seats, wall);
    Ok(desk.exam().is_some_and(Exam::has_begun))
}

/// Notes of the exam that began at a time are on disk.
fn kept(state: &mut State, begun: u64, count: usize) {
    let Some(desk) = state.class.desk_mut() else {
        return;
    };
    if !desk.exam_notes_kept(begun, count) {
        return;
    }
    let Some(exam) = desk.exam() else { return };
    let users: Vec<&str> = exam.candidates().keys().map(String::as_str).collect();
    let text = text!(
        "class-exam-begun",
        exam = exam_title(exam.plan()),
        seats = users.join(", ")
    );
    state.say(Severity::Notice, text);
}

/// Goes on with an exam that an earlier desk has begun.
fn found(state: &mut State, exam: Exam) {
    let title = exam_title(exam.plan());
    let Some(desk) = state.class.desk_mut() else {
        return;
    };
    let began = utc_minute_of(exam.begun() * 1_000_000);
    if desk.hold(exam) {
        state.say(
            Severity::Notice,
            text!("class-exam-found", exam = title.clone()),
        );
        // The exam may belong to an earlier lesson that ended without `class exam stop`.
        let question = text!("class-exam-ask-end", exam = title, began = began);
        let reason = text!("class-exam-ask-end-reason");
        state.ask(question, reason, Consequence::EndExam);
    } else {
        // The instructor was faster than the reading of the notes.
        let held = desk.exam().map(|it| exam_title(it.plan()));
        let held = held.unwrap_or_default();
        let text = text!("class-exam-found-other", exam = title, held = held);
        tell(state, Severity::Warning, text);
    }
    state.touch();
}

/// Ends the exam that the instructor does not want to go on with.
pub fn end_at_desk(state: &mut State) -> Effects {
    stop(state).unwrap_or_else(|_| Effects::none())
}

/// Ends the exam: no more tries are opened, and flights go on.
///
/// # Errors
/// This console is no desk, or holds no exam.
pub(super) fn stop(state: &mut State) -> Result<Effects, Text> {
    let wall = state.wall;
    let desk = state.class.desk_mut();
    let stopped = desk.ok_or_else(|| text!("class-no-desk"))?.stop_exam(wall);
    let title = exam_title(stopped.ok_or_else(|| text!("class-exam-none"))?);
    state.say(Severity::Notice, text!("class-exam-stopped", exam = title));
    state.touch();
    Ok(exam_notes(state))
}
