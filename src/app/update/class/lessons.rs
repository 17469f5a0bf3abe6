//! The lessons of the desk.

use std::sync::Arc;

use super::super::show::show;
use super::desk::connected;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::room::class::{BoardDetail, DeskPage, show_page};
use crate::app::state::Room;
use crate::class::{Desk, LessonDirection, LessonFault};
use crate::language::SeatChoice;
use crate::lesson_plan::Lesson;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Goes on with the lessons of all seats, and reads those that only the seats' journals know.
pub(super) fn tick(state: &mut State) -> Effects {
    let wall = state.wall;
    let Some(desk) = state.class.desk_mut() else {
        return Effects::none();
    };
    let has_changed = desk.conduct(wall);
    let unknown = desk.unknown_lessons();
    if has_changed {
        state.touch();
    }
    let asked = &mut state.rooms.class.lessons.asked;
    let new = unknown.into_iter().filter_map(|name| {
        let name = name.to_string();
        asked.insert(name.clone()).then_some(name)
    });
    let seats = Vec::new;
    new.map(|name| {
        Effect::Class(ClassEffect::ReadLesson {
            name,
            seats: seats(),
        })
    })
    .collect()
}

/// Shows the lesson of the seat under the cursor, or all lessons.
///
/// # Errors
/// This console is no desk.
pub(super) fn show_lessons(state: &mut State) -> Result<Effects, Text> {
    state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    show(state, Room::Class);
    show_page(state, DeskPage::Board);
    state.rooms.class.detail = BoardDetail::Lesson;
    Ok(Effect::Class(ClassEffect::ListLessons).into())
}

/// Reads a lesson, to begin it with seats.
///
/// # Errors
/// This console is no desk, or no connected seat is meant.
pub(super) fn teach(state: &State, choice: &SeatChoice, lesson: String) -> Result<Effects, Text> {
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let seats = connected(state, desk, choice)?;
    let name = lesson;
    Ok(Effect::Class(ClassEffect::ReadLesson { name, seats }).into())
}

/// Handles a plan that was read: the lesson begins with these seats or continues, or its faults are shown.
pub(super) fn read(
    state: &mut State,
    name: &str,
    lesson: Result<Arc<Lesson>, Text>,
    seats: &[usize],
) {
    let wall = state.wall;
    let lesson = match lesson {
        Ok(lesson) => lesson,
        Err(fault) => {
            if let Some(desk) = state.class.desk_mut().filter(|_| seats.is_empty()) {
                desk.give_up_lesson(&name.into());
            }
            let text = text!("class-lesson-unread", lesson = name, fault = fault);
            state.say(Severity::Warning, text);
            return;
        }
    };
    if let Some(desk) = state.class.desk_mut() {
        if seats.is_empty() {
            desk.resume(&lesson.plan, wall);
        } else {
            desk.teach(&lesson.plan, seats, wall);
        }
    }
    let title = lesson.title.clone();
    // What was asked for once is known for the seats that come back later, too.
    state.rooms.class.lessons.asked.remove(name);
    keep(state, lesson);
    let text = if seats.is_empty() {
        text!("class-lesson-resumed", lesson = title)
    } else {
        state.rooms.class.detail = BoardDetail::Lesson;
        let seats = state.seat_names(seats);
        text!("class-lesson-begun", lesson = title, seats = seats)
    };
    state.say(Severity::Notice, text);
    state.touch();
}

/// Keeps the texts of a lesson, and of those in which seats are.
fn keep(state: &mut State, lesson: Arc<Lesson>) {
    let seats = state.class.desk().map_or(&[][..], Desk::seats);
    let plans = seats.iter().filter_map(|seat| seat.lesson.as_ref());
    let plans: Vec<_> = plans.map(|it| Arc::clone(it.plan())).collect();
    let begun = &mut state.rooms.class.lessons.begun;
    begun.retain(|it| plans.iter().any(|plan| Arc::ptr_eq(plan, &it.plan)));
    begun.push(lesson);
}

/// Directs the lessons of seats.
///
/// # Errors
/// This console is no desk, or it is possible at none of the seats.
pub(super) fn direct(
    state: &mut State,
    choice: &SeatChoice,
    direction: LessonDirection,
) -> Result<Effects, Text> {
    let wall = state.wall;
    let desk = state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let seats = connected(state, desk, choice)?;
    let meant = state.seat_names(&seats);
    let mut directed = Vec::new();
    let mut fault = None;
    for seat in seats {
        let is_directed = directed.contains(&seat);
        let Some(desk) = state.class.desk_mut().filter(|_| !is_directed) else {
            continue;
        };
        match desk.direct(seat, direction, wall) {
            Ok(seats) => directed.extend(seats),
            Err(new) => fault = fault.or(Some(new)),
        }
    }
    if let Some(fault) = fault.filter(|_| directed.is_empty()) {
        return Err(match fault {
            LessonFault::NoLesson => text!("class-lesson-none", seats = meant),
            LessonFault::NotWaiting => text!("class-lesson-not-waiting", seats = meant),
            LessonFault::First => text!("class-lesson-first", seats = meant),
        });
    }
    let seats = state.seat_names(&directed);
    let text = match direction {
        LessonDirection::Next => text!("class-lesson-next", seats = seats),
        LessonDirection::Skip => text!("class-lesson-skip", seats = seats),
        LessonDirection::Back => text!("class-lesson-back", seats = seats),
        LessonDirection::Stop => text!("class-lesson-stop", seats = seats),
    };
    state.say(Severity::Notice, text);
    state.touch();
    Ok(Effects::none())
}
