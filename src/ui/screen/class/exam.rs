//! Where a seat is in an exam.

use std::time::Duration;

use super::columns::BoardColumn;
use super::seat_view::SeatLineView;
use crate::class::{Candidate, CandidateStage, Desk};
use crate::class_results::number_of_mission;
use crate::text;
use crate::text::clock;
use crate::ui::theme::Role;

/// The column of the exam, otherwise that of the lessons, if there are some.
pub(super) fn column(desk: &Desk) -> Option<(BoardColumn, usize)> {
    let mut seats = desk.seats().iter();
    let is_held = |candidate: &Candidate| {
        // Flights of an exam that was ended go on.
        let is_open = desk.exam().is_some_and(|exam| !exam.is_stopped());
        is_open || matches!(candidate.stage(), CandidateStage::Flying { .. })
    };
    if seats
        .clone()
        .any(|seat| desk.candidate(seat).is_some_and(is_held))
    {
        return Some(BoardColumn::EXAM);
    }
    let has_lesson = seats.any(|seat| seat.lesson.is_some());
    has_lesson.then_some(BoardColumn::LESSON)
}

/// The mission, the try and the time that is left; a seat that cannot open its try stands out.
pub(super) fn cell(view: &SeatLineView<'_>, base: Role) -> (String, Role) {
    let exam = view.desk.exam();
    let Some((exam, candidate)) = exam.zip(view.desk.candidate(view.seat)) else {
        return (String::new(), base);
    };
    let stage = candidate.stage();
    let mission = exam.plan().missions.get(candidate.mission());
    let (word, role) = match stage {
        CandidateStage::Done => (view.say(&text!("class-exam-cell-done")), Role::Muted),
        CandidateStage::Closed => (view.say(&text!("class-exam-cell-closed")), Role::Muted),
        CandidateStage::Waits => (view.say(&text!("class-exam-cell-waits")), base),
        CandidateStage::Asked { .. } | CandidateStage::Ordered(_) => {
            (view.say(&text!("class-exam-cell-opens")), base)
        }
        CandidateStage::Blocked => ("!".to_owned(), Role::Accent),
        CandidateStage::Flying { until } => {
            let left = until.saturating_sub(exam.at(view.now));
            (clock(Duration::from_secs(left)), base)
        }
    };
    let is_over = matches!(stage, CandidateStage::Done | CandidateStage::Closed);
    let text = match mission.filter(|_| !is_over) {
        Some(mission) => {
            let number = number_of_mission(mission.mission.as_str());
            format!("{number} {}/{} {word}", candidate.number(), mission.tries)
        }
        None => word,
    };
    (text, role)
}
