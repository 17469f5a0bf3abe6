//! Grading of flights by an instructor, with a rubric.
//!
//! A grade is a person's judgement. It stands beside the computed score and never changes it.
//!
//! # How the parts fit
//! - `rubric`: the categories and elements that are graded, from a TOML file.
//! - `evidence`: what the record of a flight says about an element.
//! - `sheet`: the grades that one grader gives a flight.
//! - `flight`: a flight with all of these.
//! - `agreement`: how far graders of the same flights agree.

mod agreement;
mod evidence;
mod flight;
mod rubric;
mod sheet;

pub use agreement::{Agreement, Disagreement, GradedElement, GraderMarks, agreement, marks_of};
pub use evidence::EvidenceKind;
pub use flight::{FlightChoice, GradedFlight, GradedRequest, RecordBookmark};
pub use rubric::{RUBRIC_KEYS, Rubric, RubricCategory, RubricElement};
pub use sheet::{Grade, GradeSheet, Mark};
