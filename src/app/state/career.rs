//! The career of the trainee who sits here, as the console shows it.

use crate::campaign::{
    Aids, CareerEntry, CareerStanding, Growth, LockReason, MissionCourse, MissionStage,
};
use crate::text;
use crate::text::{Language, Text};
use crate::workshop::Design;

mod outlook;

/// Who trains here, and how far they have come. The shell hands in a new one after every change.
#[derive(Debug, Clone, PartialEq)]
pub struct Career {
    pub name: String,
    /// Everything flown and bought, oldest first.
    pub history: Vec<CareerEntry>,
    /// What the history amounts to.
    pub standing: CareerStanding,
    /// How it came to that.
    pub growth: Growth,
    /// The missions that a career consists of.
    pub course: MissionCourse,
    /// The trainee's own designs, by name.
    pub designs: Vec<Design>,
    /// Today: days since 1970 in UTC.
    pub day: i64,
    /// How much advice comes by itself.
    pub aids: Aids,
    /// The language in which the trainee is to be met; `None` keeps the one that is in use.
    pub language: Option<Language>,
}

impl Career {
    /// A career by its history.
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
            aids: Aids::default(),
            language: None,
        }
    }

    /// Whether all parts of a design are the trainee's.
    pub fn may_fly(&self, design: &Design) -> bool {
        let missing = self.standing.missing_parts(design, &self.course);
        missing.is_empty()
    }

    /// Why a mission may not be flown yet, if it is one of the course.
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
