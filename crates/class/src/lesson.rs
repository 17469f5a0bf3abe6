//! Lessons: orders that a desk gives to seats in steps.
//!
//! A [`LessonPlan`] has steps. A seat waits at a step until its start ([`StepStart`]): at once, the key of the
//! instructor, or a condition that the seat itself watches. Then the desk gives the orders of the step, waits for their
//! outcomes, and goes to the next step. A step may also have a time limit, after which another step follows instead.
//!
//! Each seat has a [`LessonPosition`] of its own. Steps with `together` wait for all seats of the lesson.
//!
//! # What survives
//! Each step that a seat comes to is an order, [`NotedStep`], so it is in the seat's journal, with its outcome: armed
//! while its condition does not hold, then done. A desk that is opened again finds there at which step each seat is.
//!
//! # How the parts fit
//! `plan` is the plan, `position` where one seat is and what follows, and `resume` finds the position in a journal.
//! What the desk does for all seats is in `conduct`.

mod plan;
mod position;
mod resume;

pub use plan::{FlightMoment, LessonPlan, LessonStep, StepLimit, StepStart, StepTarget};
pub(super) use position::{GivenDeed, LessonMove};
pub use position::{HoldReason, LessonPosition, LessonWait};
pub(super) use resume::{FoundPosition, lesson_in, position_in};
