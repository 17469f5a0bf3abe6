//! The trainee's career, as the console shows it.

use crate::campaign::{
    Aids, CareerEntry, CareerStanding, ExamKey, Growth, LockReason, MissionCourse, MissionStage,
};
use crate::text;
use crate::text::{Language, Text};
use crate::workshop::Design;

mod outlook;

/// The trainee's name and progress. The shell supplies a new one after every change.
#[derive(Debug, Clone, PartialEq)]
pub struct Career {
    pub name: String,
    /// All flights and purchases, oldest first.
    pub history: Vec<CareerEntry>,
    /// The standing that follows from the history.
    pub standing: CareerStanding,
    /// Credits, attempts and skills over time.
    pub growth: Growth,
    /// The missions of the career.
    pub course: MissionCourse,
    /// The trainee's own designs, by name.
    pub designs: Vec<Design>,
    /// Today, in days since 1970 (UTC).
    pub day: i64,
    /// The key that makes the trainee's exams different from those of others.
    pub exams: ExamKey,
    /// The level of automatic advice.
    pub aids: Aids,
    /// The trainee's language; `None` keeps the one in use.
    pub language: Option<Language>,
}

impl Career {
    /// A career with this history.
    pub fn new(name: impl Into<String>, history: Vec<CareerEntry>, course: MissionCourse) -> Self {
        let translated = |entry| match entry {
            CareerEntry::Flight(flight) => CareerEntry::Flight(course.translated(flight)),
            CareerEntry::Purchase(purchase) => CareerEntry::Purchase(purchase),
        };
        let history: Vec<CareerEntry> = history.into_iter().map(translated).collect();
        Self {
            name: name.into(),
            standing: CareerStanding::of(&history),
            growth: Growth::of(&history),
            history,
            course,
            designs: Vec::new(),
            day: 0,
            exams: ExamKey::default(),
            aids: Aids::default(),
            language: None,
        }
    }

    /// Whether the trainee owns all parts of a design.
    pub fn may_fly(&self, design: &Design) -> bool {
        let missing = self.standing.missing_parts(design, &self.course);
        missing.is_empty()
    }

    /// Why a mission of the course is locked, if it is.
    pub fn lock(&self, mission: &str) -> Option<Text> {
        let offer = self.course.offer(mission)?;
        let MissionStage::Locked(reasons) = self.course.stage(offer, &self.standing, self.day)
        else {
            return None;
        };
        let reasons = reasons.iter().map(LockReason::text).collect();
        let why = Text::joined("; ", reasons);
        Some(text!(
            "mission-locked",
            mission = offer.title.clone(),
            why = why
        ))
    }
}
