//! A flight that is being graded.

use std::sync::Arc;
use std::time::Duration;

use super::{GradeSheet, Rubric};
use crate::text::Text;

/// Which flight of a trainee is to be graded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FlightChoice {
    Newest,
    /// The one before the record with this name.
    Older(String),
    /// The one after it.
    Newer(String),
}

/// What is asked for to grade a flight.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GradedRequest {
    /// The trainee's user name.
    pub user: String,
    pub choice: FlightChoice,
    /// The name of the rubric; `None` for the standard one.
    pub rubric: Option<String>,
}

/// A bookmark in a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordBookmark {
    /// Its time in the record, by which grades refer to it.
    pub recorded: Duration,
    /// Its mission time: before the start of the mission's clock 0.
    pub at: Duration,
    pub text: String,
}

/// A flight with the grades of one grader, and what its record says.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedFlight {
    /// The trainee's user name.
    pub user: String,
    /// The name of the trainee's profile, if there was one.
    pub profile: Option<String>,
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
    pub bookmarks: Vec<RecordBookmark>,
    /// Why flights that are nearer to the one asked for were passed over.
    pub skipped: Vec<Text>,
}
