//! Lines about a class.

use super::grading::GradingLine;
use crate::class::{Deed, LessonDirection};

/// A command about the class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClassLine {
    /// At a seat: join the class that the configuration names.
    Join,
    /// At a seat: leave it.
    Leave,
    /// At the desk: show the injects that the mission of a seat permits.
    Injects(SeatChoice),
    /// At the desk: show the results of the class, or their next page.
    Results,
    /// At the desk: grade a flight.
    Grading(GradingLine),
    /// At the desk: show the screen of a seat.
    Watch(SeatChoice),
    /// At the desk: show the board again.
    Unwatch,
    /// At the desk: show what is behind the screens of several seats.
    Tiles,
    /// At the desk: show the state of the flight instead of the watched screen, or the screen again.
    State,
    /// At the desk: replay a flight that was handed in, or two of them beside each other.
    Replay(ReplayedTrainees),
    /// At the desk: let seats look on at the replay; without seats, the marked ones, otherwise all.
    Show(SeatChoice),
    /// At the desk: no longer show anything to seats.
    StopShow,
    /// At the desk: show the lesson of the seat under the cursor, or all lessons.
    Lessons,
    /// At the desk: begin a lesson, given by its name or its file, with seats.
    Teach { seats: SeatChoice, lesson: String },
    /// At the desk: direct the lesson of seats.
    Direct {
        seats: SeatChoice,
        direction: LessonDirection,
    },
    /// At the desk: let seats take part in an exam, given by its name or its file.
    Examine { seats: SeatChoice, exam: String },
    /// At the desk: end the exam.
    StopExam,
    /// At the desk: give an order to seats.
    Give { seats: SeatChoice, deed: Deed },
}

/// The trainees whose flights are replayed, by their user names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReplayedTrainees {
    /// The trainee; without one, that of the seat under the cursor.
    pub trainee: Option<String>,
    /// Another trainee, whose flight of the same mission is shown beside it.
    pub beside: Option<String>,
}

/// The seats that an order is for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SeatChoice {
    /// The marked seats; with none marked, the one under the cursor.
    Addressed,
    All,
    /// The seat with this name.
    Named(String),
}
