//! The probability that a skill is mastered: Bayesian knowledge tracing (Corbett and Anderson 1995) with forgetting.

use std::collections::BTreeSet;

use serde::Serialize;

use super::Skill;
use crate::geo::maths;
use crate::text;
use crate::text::Text;

/// The probability before any evidence.
const START: f64 = 0.20;
/// The probability of a failure despite mastery of the skill.
const SLIP: f64 = 0.08;
/// The probability of a success by luck; lower in hard missions.
const GUESS: f64 = 0.20;
const GUESS_HARD: f64 = 0.10;
const HARD_TIER: u8 = 3;
/// The probability of learning a skill at an opportunity.
const LEARN: f64 = 0.12;
/// The probability left after complete forgetting.
const FLOOR: f64 = 0.15;
/// The half-life of forgetting in days; each timely review extends it.
const HALF_LIFE_DAYS: f64 = 14.0;
const REVIEW_GROWTH: f64 = 1.8;
const LONGEST_HALF_LIFE_DAYS: f64 = 180.0;
/// The probability required for mastery.
pub const MASTERY_CHANCE: f64 = 0.95;
const OPPORTUNITIES: u32 = 4;
const MISSIONS: usize = 2;
const DAYS: usize = 2;
/// The probability below which a mastered skill is due for a refresher.
const DUE: f64 = 0.80;
/// The maximum change by one flight, since a single flight proves little.
const MOST_AT_ONCE: f64 = 0.25;
/// The minimum outcome of a success.
const SUCCESS: f64 = 0.5;

/// The knowledge of one skill.
#[derive(Debug, Clone, PartialEq)]
pub struct Knowledge {
    chance: f64,
    last_day: i64,
    opportunities: u32,
    missions: BTreeSet<String>,
    days: BTreeSet<i64>,
    reviews: i32,
    was_mastered: bool,
}

/// A trainee's standing in a skill.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Mastery {
    /// No opportunity so far.
    Unknown,
    /// Shown, but not mastered yet.
    Learning,
    /// Probable, and shown often, in several missions, on several days.
    Mastered,
    /// Mastered before, and due for a refresher.
    Due,
}

/// A requirement of mastery that is not met yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lack {
    /// At least this probability that the skill is mastered, in percent.
    Chance(u8),
    /// This many more flights.
    Flights(usize),
    /// Flights in this many more missions.
    Missions(usize),
    /// Flights on this many more days.
    Days(usize),
}

impl Lack {
    /// The requirement as text.
    pub fn text(self) -> Text {
        match self {
            Self::Chance(percent) => text!("lack-chance", percent = percent),
            Self::Flights(count) => text!("lack-flights", count = count),
            Self::Missions(count) => text!("lack-missions", count = count),
            Self::Days(count) => text!("lack-days", count = count),
        }
    }
}

impl Mastery {
    /// The state's name on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::Unknown => text!("mastery-unknown"),
            Self::Learning => text!("mastery-learning"),
            Self::Mastered => text!("mastery-mastered"),
            Self::Due => text!("mastery-due"),
        }
    }
}

impl Default for Knowledge {
    fn default() -> Self {
        Self {
            chance: START,
            last_day: 0,
            opportunities: 0,
            missions: BTreeSet::new(),
            days: BTreeSet::new(),
            reviews: 0,
            was_mastered: false,
        }
    }
}

impl Knowledge {
    /// The probability of mastery on a day, 0 to 1.
    pub fn chance(&self, day: i64) -> f64 {
        if self.opportunities == 0 {
            return START;
        }
        let idle_days = (day - self.last_day).max(0) as f64;
        let left = maths::powf(2f64, -idle_days / self.half_life_days());
        FLOOR + (self.chance - FLOOR).max(0.0) * left
    }

    /// The state of the skill on a day.
    pub fn mastery(&self, day: i64) -> Mastery {
        if self.opportunities == 0 {
            Mastery::Unknown
        } else if self.was_mastered && self.is_due(day) {
            Mastery::Due
        } else if self.was_mastered {
            Mastery::Mastered
        } else {
            Mastery::Learning
        }
    }

    /// The day on which the skill will be due, in days since 1970 (UTC); `None` if it was never
    /// mastered.
    pub fn due_day(&self) -> Option<i64> {
        if !self.was_mastered {
            return None;
        }
        // This solves chance(day) = DUE for the day; the result is no later than the half-life.
        let above = (self.chance - FLOOR).max(1e-9) / (DUE - FLOOR);
        let days = self.half_life_days() * maths::log2(above).clamp(0.0, 1.0);
        Some(self.last_day + days.ceil() as i64)
    }

    /// The requirements of mastery that are not met on a day; empty once mastered.
    pub fn lacks(&self, day: i64) -> Vec<Lack> {
        if self.was_mastered {
            return Vec::new();
        }
        let more = |have: usize, needed: usize| needed.saturating_sub(have);
        let mut lacks = Vec::new();
        if self.chance(day) < MASTERY_CHANCE {
            lacks.push(Lack::Chance((MASTERY_CHANCE * 100.0).round() as u8));
        }
        let flights = more(self.opportunities as usize, OPPORTUNITIES as usize);
        lacks.extend((flights > 0).then_some(Lack::Flights(flights)));
        let missions = more(self.missions.len(), MISSIONS);
        lacks.extend((missions > 0).then_some(Lack::Missions(missions)));
        let days = more(self.days.len(), DAYS);
        lacks.extend((days > 0).then_some(Lack::Days(days)));
        if lacks.is_empty() {
            // All requirements were met, but not at the same time: one more good flight is needed.
            lacks.push(Lack::Flights(1));
        }
        lacks
    }

    /// The number of flights that gave evidence.
    pub fn opportunities(&self) -> u32 {
        self.opportunities
    }

    /// The number of missions that gave evidence.
    pub fn missions(&self) -> usize {
        self.missions.len()
    }

    /// Updates the knowledge with a flight's outcome, 0 to 1.
    pub(super) fn observe(&mut self, outcome: f64, tier: u8, mission: &str, day: i64) {
        let before = self.chance(day);
        if self.mastery(day) == Mastery::Due && outcome >= SUCCESS {
            self.reviews += 1;
        }
        let guess = if tier >= HARD_TIER { GUESS_HARD } else { GUESS };
        let right = before * (1.0 - SLIP) / (before * (1.0 - SLIP) + (1.0 - before) * guess);
        let wrong = before * SLIP / (before * SLIP + (1.0 - before) * (1.0 - guess));
        let seen = outcome * right + (1.0 - outcome) * wrong;
        let learnt = seen + (1.0 - seen) * LEARN;
        self.chance = learnt.clamp(before - MOST_AT_ONCE, before + MOST_AT_ONCE);
        self.last_day = day.max(self.last_day);
        self.opportunities += 1;
        self.missions.insert(mission.to_owned());
        self.days.insert(day);
        self.was_mastered |= self.chance >= MASTERY_CHANCE
            && self.opportunities >= OPPORTUNITIES
            && self.missions.len() >= MISSIONS
            && self.days.len() >= DAYS;
    }

    fn is_due(&self, day: i64) -> bool {
        self.chance(day) < DUE || (day - self.last_day) as f64 > self.half_life_days()
    }

    fn half_life_days(&self) -> f64 {
        (HALF_LIFE_DAYS * maths::powi(REVIEW_GROWTH, self.reviews)).min(LONGEST_HALF_LIFE_DAYS)
    }
}

/// The knowledge of every skill.
pub(super) type Skills = std::collections::BTreeMap<Skill, Knowledge>;
