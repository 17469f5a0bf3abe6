//! A flight that is being graded.

use std::sync::Arc;

use super::{GradeSheet, Rubric};
use crate::comparison::FlightBookmark;
use crate::text::Text;

/// A flight with the grades of one grader, and what its record says.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedFlight {
    /// The trainee's user name.
    pub user: String,
    /// The name of the record.
    pub record: String,
    /// The title of the mission.
    pub title: Text,
    /// The start of the flight in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The computed score, which grades never change.
    pub score: u16,
    /// The number of this flight among the trainee's, from 1, the oldest first.
    pub number: usize,
    /// How many flights the trainee has handed in.
    pub flights: usize,
    pub rubric: Arc<Rubric>,
    pub sheet: GradeSheet,
    /// What the record says about each element, in the order of the rubric's elements.
    pub evidence: Vec<Vec<Text>>,
    /// The bookmarks in the record, the oldest first.
    pub bookmarks: Vec<FlightBookmark>,
}
