//! What is flown in an exam.

use std::time::Duration;

use crate::Words;

/// An exam, as its file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExamPlan {
    /// The name by which the exam is begun.
    pub name: Words,
    /// Its title in English.
    pub title: Words,
    /// Its title in Ukrainian, if the file has one.
    pub title_uk: Option<Words>,
    /// Whether all trainees get the same seeds.
    pub layout: ExamLayout,
    /// When the first try may be opened, in seconds since 1970 (UTC); at once without it.
    pub opens: Option<u64>,
    /// When all flights end, in seconds since 1970 (UTC).
    pub closes: Option<u64>,
    /// The missions in their order; there is at least one.
    pub missions: Vec<ExamMission>,
}

/// A mission of an exam.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExamMission {
    /// The id of the mission in the course.
    pub mission: Words,
    /// How often it may be flown. The first pass is the last try.
    pub tries: u32,
    /// The time for a try, from the moment when its brief is shown.
    pub limit: Duration,
}

/// Whose layouts are the same.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ExamLayout {
    /// Each trainee gets seeds of their own.
    #[default]
    Own,
    /// The same try has the same seed for all.
    Same,
}

impl ExamPlan {
    /// The time at which a try must end that is opened at a time, in seconds since 1970.
    pub(super) fn until(&self, mission: &ExamMission, opened: u64) -> u64 {
        let end = opened.saturating_add(mission.limit.as_secs());
        self.closes.map_or(end, |closes| closes.min(end))
    }

    pub(super) fn is_open_at(&self, at: u64) -> bool {
        self.opens.is_none_or(|opens| at >= opens)
    }

    pub(super) fn is_closed_at(&self, at: u64) -> bool {
        self.closes.is_some_and(|closes| at >= closes)
    }
}
