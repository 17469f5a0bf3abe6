//! The standing that follows from a history.

use std::collections::{BTreeMap, BTreeSet};

use super::economy::{self, START_CREDITS, STARTER_PARTS};
use super::knowledge::Skills;
use super::{
    CareerEntry, CareerFlight, Knowledge, Mastery, MissionCourse, Offer, Purchase, Skill, Stake,
};
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::workshop::{Design, DesignKind, Part, part};

/// Credits, experience, parts, skills and results of a trainee.
#[derive(Debug, Clone, PartialEq)]
pub struct CareerStanding {
    credits: u32,
    experience: u64,
    missions: BTreeMap<String, Best>,
    /// The daily flights that counted, by mission and day.
    daily: BTreeSet<(String, i64)>,
    owned: BTreeSet<String>,
    skills: Skills,
    licence: u8,
    flights: u32,
    /// The mission of the last flight that counted; for a drill, the mission that it prepares for.
    last: Option<String>,
}

/// A trainee's best results in one mission, without practice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Best {
    /// The number of graded flights.
    pub tries: u32,
    /// The highest score; `None` if no flight earned a point.
    pub score: Option<u16>,
    /// The highest score of passed flights; `None` if no flight was passed.
    pub passed: Option<u16>,
    /// The best medal of all graded flights.
    pub medal: Option<Medal>,
    /// The best exam result, if one was taken.
    pub exam: Option<ExamResult>,
    exams: u32,
    /// The maximum number of drones in a flight with at least silver.
    silver_with: u8,
    /// The maximum number of drones in a flight with gold.
    gold_with: u8,
}

/// The result of an exam, ordered by quality.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ExamResult {
    /// Whether the exam was passed.
    pub passed: bool,
    /// The points, 0 to 1000.
    pub score: u16,
}

/// Whether a part may be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PartState {
    /// The trainee owns the part's licence.
    Owned,
    /// The part may be used after paying this many credits.
    ForSale(u32),
    /// The part may be used after passing the mission with this id.
    Locked(String),
}

/// Why a part cannot be bought.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PurchaseRefusal {
    /// The part is unknown.
    Unknown,
    /// The part is already owned.
    Owned,
    /// The mission with this id must be passed first.
    Locked(String),
    /// The part costs the first number of credits, but only the second is available.
    TooDear(u32, u32),
}

impl PurchaseRefusal {
    /// The reason as text.
    pub fn text(&self) -> Text {
        match self {
            Self::Unknown => text!("buy-unknown"),
            Self::Owned => text!("buy-owned"),
            Self::Locked(mission) => text!("buy-locked", mission = mission.as_str()),
            Self::TooDear(price, credits) => {
                text!("buy-too-dear", price = *price, credits = *credits)
            }
        }
    }
}

impl Default for CareerStanding {
    fn default() -> Self {
        Self {
            credits: START_CREDITS,
            experience: 0,
            missions: BTreeMap::new(),
            daily: BTreeSet::new(),
            owned: STARTER_PARTS.iter().map(|id| (*id).to_owned()).collect(),
            skills: Skills::new(),
            licence: 1,
            flights: 0,
            last: None,
        }
    }
}

impl CareerStanding {
    /// The standing after a history, which begins with the oldest entry.
    pub fn of<'a>(history: impl IntoIterator<Item = &'a CareerEntry>) -> Self {
        let mut standing = Self::default();
        for entry in history {
            standing.enter(entry);
        }
        standing
    }

    /// Adds one entry. Wear never takes more credits than available; a purchase without enough credits has no effect.
    pub fn enter(&mut self, entry: &CareerEntry) {
        match entry {
            CareerEntry::Flight(flight) => self.fly(flight),
            CareerEntry::Purchase(purchase) => {
                if let Some(left) = self.credits.checked_sub(purchase.credits)
                    && self.owned.insert(purchase.part.clone())
                {
                    self.credits = left;
                }
            }
        }
    }

    fn fly(&mut self, flight: &CareerFlight) {
        let best = self.missions.get(&flight.mission).copied();
        let refreshes = flight
            .evidence
            .iter()
            .any(|evidence| self.skill(evidence.skill).mastery(flight.day) == Mastery::Due);
        let counts = self.counts(flight);
        if counts {
            self.credits = self.credits.saturating_add(self.pay(flight));
            let best_score = best.and_then(|best| best.passed);
            self.experience += u64::from(economy::experience(flight, best_score, refreshes));
        }
        self.credits = self.credits.saturating_sub(flight.wear);
        self.flights += 1;
        // A flight on a known layout shows memory, not skill.
        if counts {
            for shown in flight.shown_skills() {
                let known = self.skills.entry(shown.skill).or_default();
                known.observe(shown.outcome, flight.tier, &flight.mission, flight.day);
            }
            if flight.stake == Stake::Daily {
                self.daily.insert((flight.mission.clone(), flight.day));
            }
            self.missions
                .entry(flight.mission.clone())
                .or_default()
                .take(flight);
            self.licence = self.earned_licence();
            let mission = flight.drill_of.as_ref().unwrap_or(&flight.mission);
            self.last = Some(mission.clone());
        }
    }

    /// Whether a flight counts for more than practice. Of daily flights, only the first one of the day counts.
    pub(super) fn counts(&self, flight: &CareerFlight) -> bool {
        match flight.stake {
            Stake::Graded | Stake::Exam => true,
            Stake::Practice => false,
            Stake::Daily => !self.daily.contains(&(flight.mission.clone(), flight.day)),
        }
    }

    /// The payment for a flight in credits, before wear.
    pub(super) fn pay(&self, flight: &CareerFlight) -> u32 {
        if !self.counts(flight) {
            return 0;
        }
        let best = self.best(&flight.mission);
        economy::pay(flight, best.and_then(|best| best.passed))
    }

    /// The purchase of a part's licence.
    ///
    /// # Errors
    /// The reason why the part cannot be bought.
    pub fn buy(&self, id: &str, course: &MissionCourse) -> Result<Purchase, PurchaseRefusal> {
        let part = part(id).ok_or(PurchaseRefusal::Unknown)?;
        match self.part_state(part, course) {
            PartState::Owned => Err(PurchaseRefusal::Owned),
            PartState::Locked(mission) => Err(PurchaseRefusal::Locked(mission)),
            PartState::ForSale(price) if price > self.credits => {
                Err(PurchaseRefusal::TooDear(price, self.credits))
            }
            PartState::ForSale(credits) => Ok(Purchase {
                part: id.to_owned(),
                credits,
            }),
        }
    }

    /// Whether a part may be used. Parts that no mission unlocks are for sale from the start.
    pub fn part_state(&self, part: &Part, course: &MissionCourse) -> PartState {
        if self.owned.contains(part.id) {
            return PartState::Owned;
        }
        let mut unlocking = course.unlocking(part).peekable();
        let first = unlocking.peek().map(|offer| offer.id.clone());
        let is_unlocked = unlocking.any(|offer| self.has_passed(&offer.id));
        match first {
            Some(mission) if !is_unlocked => PartState::Locked(mission),
            _ => PartState::ForSale(economy::licence_price(part.credits)),
        }
    }

    /// The mission that must be passed before vehicles of a kind can be built; `None` if they can.
    pub fn kind_lock<'a>(&self, kind: DesignKind, course: &'a MissionCourse) -> Option<&'a Offer> {
        let offers = course.offers().iter();
        let mut unlocking = offers.filter(|offer| offer.kinds.contains(&kind));
        let first = unlocking.clone().next()?;
        let is_unlocked = unlocking.any(|offer| self.has_passed(&offer.id));
        (!is_unlocked).then_some(first)
    }

    /// The parts of a design without a licence, in the order of its slots, each once.
    pub fn missing_parts(
        &self,
        design: &Design,
        course: &MissionCourse,
    ) -> Vec<(&'static Part, PartState)> {
        let mut missing: Vec<(&'static Part, PartState)> = Vec::new();
        for (part, _) in design.pieces() {
            let state = self.part_state(part, course);
            let is_listed = missing.iter().any(|(other, _)| other.id == part.id);
            if state != PartState::Owned && !is_listed {
                missing.push((part, state));
            }
        }
        missing
    }

    /// Credits that can be spent.
    pub fn credits(&self) -> u32 {
        self.credits
    }

    /// Total experience, the level, and the total experience needed for the next level.
    pub fn experience(&self) -> (u64, u32, u64) {
        let level = economy::level(self.experience);
        (self.experience, level, economy::level_experience(level + 1))
    }

    /// The number of finished flights.
    pub fn flights(&self) -> u32 {
        self.flights
    }

    /// The best results of a mission; `None` before the first graded flight.
    pub fn best(&self, mission: &str) -> Option<&Best> {
        self.missions.get(mission)
    }

    /// The number of a mission's exams that were taken, including abandoned ones.
    pub fn exams(&self, mission: &str) -> u32 {
        self.best(mission).map_or(0, |best| best.exams)
    }

    /// The mission of the last flight that counted; for a drill, the mission that it prepares for.
    pub fn last_mission(&self) -> Option<&str> {
        self.last.as_deref()
    }

    /// Whether a mission was passed.
    pub fn has_passed(&self, mission: &str) -> bool {
        self.best(mission).is_some_and(|best| best.passed.is_some())
    }

    /// The trainee's knowledge of a skill; without evidence, the initial knowledge.
    pub fn skill(&self, skill: Skill) -> Knowledge {
        self.skills.get(&skill).cloned().unwrap_or_default()
    }

    /// The maximum number of drones that may be flown in missions at a time.
    pub fn licence(&self) -> u8 {
        self.licence
    }

    /// The licence earned by results: two drones after the first pass, four after the second, eight after silver in two
    /// missions with three drones or more, 16 after silver with eight, 32 after gold with eight.
    fn earned_licence(&self) -> u8 {
        let missions = || self.missions.values();
        let passes = missions().filter(|best| best.passed.is_some()).count();
        let silver = |vehicles| {
            missions()
                .filter(move |best| best.silver_with >= vehicles)
                .count()
        };
        if missions().any(|best| best.gold_with >= 8) {
            32
        } else if silver(8) >= 1 {
            16
        } else if silver(3) >= 2 {
            8
        } else if passes >= 2 {
            4
        } else if passes == 1 {
            2
        } else {
            1
        }
    }
}

impl Best {
    fn take(&mut self, flight: &CareerFlight) {
        self.tries += 1;
        self.score = self.score.max((flight.score > 0).then_some(flight.score));
        if flight.passed {
            self.passed = self.passed.max(Some(flight.score));
        }
        self.medal = self.medal.max(flight.medal);
        if flight.stake == Stake::Exam {
            self.exams += 1;
            self.exam = self.exam.max(Some(ExamResult {
                passed: flight.passed,
                score: flight.score,
            }));
        }
        if flight.medal >= Some(Medal::Silver) {
            self.silver_with = self.silver_with.max(flight.vehicles);
        }
        if flight.medal >= Some(Medal::Gold) {
            self.gold_with = self.gold_with.max(flight.vehicles);
        }
    }
}
