//! Tries of exams without records.

use serde::Serialize;

use super::ClassTrainee;
use crate::class::{Exam, TryVerdict};

/// A try of an exam that was opened, and of which no record was handed in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TryWithoutRecord {
    pub user: String,
    /// The name of the exam.
    pub exam: String,
    /// The id of the mission.
    pub mission: String,
    /// The number of the try, from 1.
    pub number: u32,
    /// The number of tries at the mission.
    pub tries: u32,
    /// When it was opened, in seconds since 1970.
    pub opened: u64,
    /// Whether it may still be flown: it is not over for the desk.
    pub is_open: bool,
    /// What has become of it, as far as the desk has seen it.
    pub verdict: TryVerdict,
}

impl TryWithoutRecord {
    /// The tries of exams that none of the flights is, at a time in seconds since 1970.
    pub fn of(exams: &[Exam], trainees: &[ClassTrainee], now: u64) -> Vec<Self> {
        let of_exam = |exam| Self::of_exam(exam, trainees, now);
        exams.iter().flat_map(of_exam).collect()
    }

    fn of_exam(exam: &Exam, trainees: &[ClassTrainee], now: u64) -> Vec<Self> {
        let mut found = Vec::new();
        for (user, candidate) in exam.candidates() {
            let flown = trainees.iter().filter(|it| it.user == *user);
            let flights = flown.flat_map(|it| &it.flights);
            let recorded: Vec<_> = flights
                .filter_map(|it| exam.try_of(user, it.seed))
                .collect();
            let opened = candidate.tries().iter().filter(|it| it.opened.is_some());
            for missing in opened.filter(|it| !recorded.contains(it)) {
                let verdict = missing.verdict(now);
                let mut missions = exam.plan().missions.iter();
                let mission = missions.find(|it| it.mission == missing.name.mission);
                found.push(Self {
                    user: user.clone(),
                    exam: exam.plan().name.to_string(),
                    mission: missing.name.mission.to_string(),
                    number: missing.name.number,
                    tries: mission.map_or(0, |it| it.tries),
                    opened: missing.opened.unwrap_or_default(),
                    is_open: verdict == TryVerdict::Open,
                    verdict,
                });
            }
        }
        found
    }
}

#[cfg(test)]
mod tests;
