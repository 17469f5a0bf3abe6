//! Where a seat is in an exam.

use std::time::Duration;

use super::columns::BoardColumn;
use super::seat_view::SeatLineView;
use crate::class::{CandidateStage, Desk};
use crate::class_results::number_of_mission;
use crate::text;
use crate::text::clock;
use crate::ui::theme::Role;

/// The columns of the exam, as long as tries are opened or flown, and of the lessons, if there are some.
pub(super) fn columns(desk: &Desk, now: Duration) -> Vec<(BoardColumn, usize)> {
    let seats = desk.seats();
    let is_watched = desk.watched_exams(now).next().is_some();
    let has_exam = is_watched && seats.iter().any(|seat| desk.candidacy(seat, now).is_some());
    let has_lesson = seats.iter().any(|seat| seat.lesson.is_some());
    let exam = has_exam.then_some(BoardColumn::EXAM);
    let lesson = has_lesson.then_some(BoardColumn::LESSON);
    exam.into_iter().chain(lesson).collect()
}

/// The mission, the try and the time that is left; a seat that cannot open its try stands out.
pub(super) fn cell(view: &SeatLineView<'_>, base: Role) -> (String, Role) {
    let Some((exam, candidate)) = view.desk.candidacy(view.seat, view.now) else {
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
