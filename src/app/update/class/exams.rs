//! The exam of the desk.

use super::desk::{connected, exam_notes};
use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::event::ExamEvent;
use crate::app::state::Consequence;
use crate::class::{Desk, Exam, natural};
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

/// Handles an exam that was read: asks before it begins, or before more seats take part in it, because a try that has
/// opened is used up.
fn read(state: &mut State, name: &str, exam: Result<Box<Exam>, Text>, seats: &[usize]) -> Effects {
    let exam = exam.and_then(|exam| may_hold(state, &exam).map(|()| exam));
    match exam {
        Ok(exam) => {
            let question = question(state, &exam, seats);
            let seats = seats.to_vec();
            let reason = text!("class-exam-ask-begin-reason");
            state.ask(question, reason, Consequence::BeginExam { exam, seats });
        }
        Err(fault) => state.say(
            Severity::Warning,
            text!("class-exam-unread", exam = name, fault = fault),
        ),
    }
    Effects::none()
}

/// The exam, and who takes part: all names, so that one that is missing is noticed.
fn question(state: &State, exam: &Exam, seats: &[usize]) -> Text {
    let known = state.class.desk().map_or(&[][..], Desk::seats);
    let names = seats.iter().filter_map(|&seat| known.get(seat));
    let mut names: Vec<&str> = names.map(|seat| seat.name.as_str()).collect();
    // Not as they are on the board, where rows move.
    names.sort_by_key(|name| natural(name));
    let here = known.iter().filter(|seat| seat.is_here()).count();
    text!(
        "class-exam-ask-begin",
        exam = exam_title(exam.plan()),
        count = names.len(),
        here = here,
        seats = names.join(", ")
    )
}

/// The exam that the desk holds and that has not ended.
fn held(desk: &Desk) -> Option<&Exam> {
    desk.exam().filter(|it| !it.is_stopped())
}

/// Checks that the desk holds no other exam than this one.
///
/// # Errors
/// It does.
fn may_hold(state: &State, exam: &Exam) -> Result<(), Text> {
    let held = state.class.desk().and_then(held);
    match held.filter(|it| it.plan().name != exam.plan().name) {
        Some(other) => Err(text!("class-exam-other", exam = exam_title(other.plan()))),
        None => Ok(()),
    }
}

/// Lets seats take part in an exam; if the desk holds it already, in that one. A new one begins once its first note is
/// on disk.
pub fn begin_at_desk(state: &mut State, exam: Exam, seats: &[usize]) -> Effects {
    let wall = state.wall;
    let Some(desk) = state.class.desk_mut() else {
        return Effects::none();
    };
    let title = exam_title(exam.plan());
    if held(desk).is_none() {
        desk.hold(exam);
    }
    desk.seat_candidates(seats, wall);
    if desk.exam().is_some_and(Exam::has_begun) {
        let seats = state.seat_names(seats);
        let text = text!("class-exam-begun", exam = title, seats = seats);
        state.say(Severity::Notice, text);
    }
    exam_notes(state)
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
    if exam.is_stopped() {
        // Only the tries that are under way are watched, whatever exam is held.
        let flying: Vec<&str> = exam.flown_at(exam.at(state.wall)).collect();
        let seats = flying.join(", ");
        desk.see_out(exam);
        let text = text!("class-exam-found-ended", exam = title, seats = seats);
        tell(state, Severity::Notice, text);
    } else if desk.hold(exam) {
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
