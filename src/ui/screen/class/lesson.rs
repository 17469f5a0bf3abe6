//! The lesson of the seat under the cursor, and the lessons that can be begun.

use std::borrow::Cow;
use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::age;
use super::detail::title;
use crate::app::State;
use crate::app::keymap::{Meaning, Place};
use crate::app::room::Room;
use crate::class::{
    HoldReason, LessonPosition, LessonStep, LessonWait, SeatRecord, StepLimit, StepTarget,
};
use crate::class_text::deed_text;
use crate::lesson_plan::{Lesson, LessonList};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{put, wrap};

/// Lets a step begin; its key is shown.
const NEXT_STEP: Meaning = Meaning::Give(Cow::Borrowed("class lesson next"));

/// The step of a seat on the board; one that waits for the instructor stands out.
pub(super) fn cell(seat: &SeatRecord, base: Role) -> (String, Role) {
    let Some(lesson) = &seat.lesson else {
        return (String::new(), base);
    };
    let step = lesson.step().map_or("", |step| step.id.as_str());
    match lesson.wait() {
        LessonWait::Ended => ("-".to_owned(), Role::Muted),
        LessonWait::Instructor(_) => (format!("! {step}"), Role::Accent),
        LessonWait::Seat | LessonWait::Condition(_) | LessonWait::Others => (step.to_owned(), base),
    }
}

pub(super) fn draw(state: &State, seat: &SeatRecord, panel: Panel<'_>, buffer: &mut Buffer) {
    let lessons = state.rooms().class().lessons();
    let known = seat.lesson.as_ref();
    let known = known.and_then(|it| Some((it, lessons.of(it.plan())?)));
    let (title, lines) = match known {
        Some((position, lesson)) => (
            heading(seat, position, lesson),
            step_lines(state, position, lesson),
        ),
        None => (text!("class-lessons-title"), listed(lessons.listed())),
    };
    let inner = panel.titled(&panel.text(&title), buffer);
    let columns = usize::from(inner.width);
    let rows = lines.into_iter().flat_map(|(text, role)| {
        let wrapped = wrap(&panel.text(&text), columns);
        wrapped.into_iter().map(move |line| (line, role))
    });
    for (row, (line, role)) in (0..inner.height).zip(rows) {
        put(
            buffer,
            inner,
            row,
            &Line::from(Span::styled(line, panel.style(role))),
        );
    }
}

fn heading(seat: &SeatRecord, position: &LessonPosition, lesson: &Lesson) -> Text {
    let step = position.step().map_or("", |step| step.id.as_str());
    text!(
        "class-lesson-title",
        seat = title(seat),
        lesson = lesson.title.clone(),
        number = position.step_index() + 1,
        count = lesson.plan.steps.len(),
        step = step
    )
}

/// The lessons, first those that can be begun.
fn listed(lessons: Option<&LessonList>) -> Vec<(Text, Role)> {
    let Some(lessons) = lessons else {
        return vec![(text!("class-lessons-reading"), Role::Muted)];
    };
    let good = lessons.good.iter().map(|lesson| {
        let line = text!(
            "class-lesson-named",
            name = lesson.plan.name.as_str(),
            title = lesson.title.clone(),
            about = lesson.about.clone()
        );
        (line, Role::Text)
    });
    let faulty = lessons.faulty.iter().map(|lesson| {
        let name = lesson.name.as_str();
        let file = lesson.file.as_str();
        let line = text!("class-lesson-faulty", name = name, file = file);
        (line, Role::Warning)
    });
    let lines: Vec<_> = good.chain(faulty).collect();
    if lines.is_empty() {
        return vec![(text!("class-lessons-none"), Role::Muted)];
    }
    lines
}

/// What a seat waits for, what the instructor reads, and what follows.
fn step_lines(state: &State, position: &LessonPosition, lesson: &Lesson) -> Vec<(Text, Role)> {
    let wait = position.wait();
    let role = match wait {
        LessonWait::Instructor(_) => Role::Accent,
        LessonWait::Ended => Role::Muted,
        LessonWait::Seat | LessonWait::Condition(_) | LessonWait::Others => Role::Text,
    };
    let mut lines = vec![(wait_text(state, position), role)];
    let note = lesson.notes.get(position.step_index());
    let Some(step) = position.step().filter(|_| wait != LessonWait::Ended) else {
        return lines;
    };
    lines.extend(note.map(|note| (note.clone(), Role::Text)));
    if !step.deeds.is_empty() {
        let deeds = step.deeds.iter().map(deed_text).collect();
        let deeds = Text::joined("; ", deeds);
        lines.push((text!("class-lesson-does", deeds = deeds), Role::Muted));
    }
    let then = target_text(step.then, &lesson.plan.steps);
    lines.push((text!("class-lesson-then", step = then), Role::Muted));
    lines
}

fn target_text(target: StepTarget, steps: &[LessonStep]) -> Text {
    let step = match target {
        StepTarget::Step(index) => steps.get(index),
        StepTarget::End => None,
    };
    step.map_or_else(
        || text!("class-lesson-end"),
        |step| Text::verbatim(step.id.as_str()),
    )
}

/// What a seat waits for, with the time that is left.
fn wait_text(state: &State, position: &LessonPosition) -> Text {
    let key = || state.keymap().key(NEXT_STEP, Place::In(Room::Class));
    let wait = match position.wait() {
        LessonWait::Seat => text!("class-lesson-wait-seat"),
        LessonWait::Instructor(None) => text!("class-lesson-wait-manual", key = key()),
        LessonWait::Instructor(Some(reason)) => {
            return match reason {
                HoldReason::Back => text!("class-lesson-wait-back", key = key()),
                HoldReason::NotFlown => text!("class-lesson-wait-not-flown", key = key()),
                HoldReason::Condition => text!("class-lesson-wait-refused", key = key()),
                HoldReason::Circles => text!("class-lesson-wait-circles", key = key()),
            };
        }
        LessonWait::Condition(when) => {
            text!("class-lesson-wait-condition", when = when.as_str())
        }
        LessonWait::Others => text!("class-lesson-wait-others"),
        LessonWait::Ended => return text!("class-lesson-wait-ended"),
    };
    match position.step().and_then(|step| step.limit) {
        Some(limit) => with_limit(wait, limit, position.waited(state.wall()), position),
        None => wait,
    }
}

fn with_limit(wait: Text, limit: StepLimit, waited: Duration, position: &LessonPosition) -> Text {
    let left = limit.within.saturating_sub(waited);
    text!(
        "class-lesson-wait-limit",
        wait = wait,
        time = age(left.as_secs_f64()),
        step = target_text(limit.otherwise, &position.plan().steps)
    )
}
