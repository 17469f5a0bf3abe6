//! A career flown by pilot scripts: whether a course can be completed from its beginning.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use super::Exercise;
use crate::campaign::{
    CareerEntry, CareerFlight, CareerProgress, CareerStanding, MissionCourse, MissionStage, Offer,
    PartState, Stake, licence_price,
};
use crate::language::Script;
use crate::mission::Mission;
use crate::scoring::Medal;
use crate::workshop::part;

const FLIGHTS_A_DAY: usize = 4;
/// The number of latest flights whose missions are avoided, if another mission is available.
const TIRED_FOR: usize = 2;
/// The minimum number of credits to keep when parts are bought.
const RESERVE_CREDITS: u32 = 200;

/// A simulated trainee who flies the pilot scripts as the campaign advises, and buys new parts.
pub struct Playthrough {
    course: MissionCourse,
    pilots: BTreeMap<String, (Arc<Mission>, Script)>,
    history: Vec<CareerEntry>,
    standing: CareerStanding,
    flown: Vec<String>,
    first_day: i64,
    seed: u64,
}

/// One flight of a playthrough, with its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlaythroughFlight {
    /// Id of the mission.
    pub mission: String,
    /// The day of the flight, in days since 1970.
    pub day: i64,
    /// The seed of the mission's world.
    pub seed: u64,
    /// The score, 0 to 1000.
    pub score: u16,
    /// Whether the mission was passed.
    pub passed: bool,
    /// The medal, if one was won.
    pub medal: Option<Medal>,
    /// The parts bought afterwards, by id.
    pub bought: Vec<String>,
    /// Credits after the purchases.
    pub credits: u32,
    /// The level of experience.
    pub level: u32,
    /// The maximum number of drones that may be flown at a time.
    pub licence: u8,
    /// The mean probability of mastery of all skills, in percent.
    pub mean_skill_percent: f64,
}

impl Playthrough {
    /// A career on these missions, with a pilot for each; the seeds of the flights count up from
    /// `seed`.
    pub fn new(
        pilots: impl IntoIterator<Item = (Mission, Script)>,
        first_day: i64,
        seed: u64,
    ) -> Self {
        let pilots: Vec<(Mission, Script)> = pilots.into_iter().collect();
        let course = MissionCourse::new(pilots.iter().map(|(mission, _)| Offer::of(mission)));
        let pilots = pilots.into_iter();
        Self {
            course,
            pilots: pilots
                .map(|(mission, script)| (mission.id.clone(), (Arc::new(mission), script)))
                .collect(),
            history: Vec::new(),
            standing: CareerStanding::default(),
            flown: Vec::new(),
            first_day,
            seed,
        }
    }

    /// All flights and purchases so far.
    pub fn history(&self) -> &[CareerEntry] {
        &self.history
    }

    /// Whether all missions are passed; drills are optional.
    pub fn is_complete(&self) -> bool {
        let mut missions = self.course.offers().iter();
        missions.all(|offer| offer.drill_of.is_some() || self.standing.has_passed(&offer.id))
    }

    /// Flies the next flight; `None` if no mission may be flown.
    pub fn fly(&mut self) -> Option<PlaythroughFlight> {
        let day = self.first_day + (self.flown.len() / FLIGHTS_A_DAY) as i64;
        let id = self.choose(day)?;
        let (mission, script) = self.pilots.get(&id)?.clone();
        let seed = self.seed + self.flown.len() as u64;
        let mut exercise = Exercise::new(Arc::clone(&mission), seed, script, Vec::new());
        while !exercise.is_over() {
            exercise.step();
            exercise.take_notices();
        }
        let flight = CareerFlight::of(&mission, &exercise.report(), Stake::Graded, day);
        self.enter(CareerEntry::Flight(flight.clone()));
        self.flown.push(id.clone());
        let bought = self.shop();
        let progress = CareerProgress::of(&self.course, &self.history, day);
        Some(PlaythroughFlight {
            mission: id,
            day,
            seed,
            score: flight.score,
            passed: flight.passed,
            medal: flight.medal,
            bought,
            credits: progress.credits,
            level: progress.level,
            licence: progress.licence,
            mean_skill_percent: progress.mean_skill_percent(),
        })
    }

    /// The recommended mission; otherwise, or if it was flown recently, an open mission, then a passed one with a
    /// better medal left to win.
    fn choose(&self, day: i64) -> Option<String> {
        let stage = |offer: &Offer| self.course.stage(offer, &self.standing, day);
        let offers = || self.course.offers().iter();
        let next = self.course.next(&self.standing, day);
        let advised = next.map(|(_, offer)| offer);
        let open = offers().filter(|offer| stage(offer) == MissionStage::Open);
        let improvable = offers().filter(
            |offer| matches!(stage(offer), MissionStage::Passed(medal) if medal < Some(Medal::Gold)),
        );
        let flown = self.flown.iter().rev().take(TIRED_FOR);
        let is_fresh = |offer: &&Offer| !flown.clone().any(|id| *id == offer.id);
        let mut wanted = advised.into_iter().chain(open).chain(improvable);
        let mission = wanted.find(is_fresh).or(advised)?;
        Some(mission.id.clone())
    }

    /// Buys parts that passed missions have unlocked, the cheapest first, while the credits last.
    fn shop(&mut self) -> Vec<String> {
        let offers = self.course.offers().iter();
        let passed = offers.filter(|offer| self.standing.has_passed(&offer.id));
        let ids = passed.flat_map(|offer| &offer.parts);
        let mut parts: Vec<_> = ids.filter_map(|id| part(id)).collect();
        parts.sort_by_key(|part| part.credits);
        let mut bought = Vec::new();
        for part in parts {
            let is_for_sale = matches!(
                self.standing.part_state(part, &self.course),
                PartState::ForSale(_)
            );
            let price = licence_price(part.credits);
            if is_for_sale
                && self.standing.credits() >= price + RESERVE_CREDITS
                && let Ok(purchase) = self.standing.buy(part.id, &self.course)
            {
                self.enter(CareerEntry::Purchase(purchase));
                bought.push(part.id.to_owned());
            }
        }
        bought
    }

    fn enter(&mut self, entry: CareerEntry) {
        self.standing.enter(&entry);
        self.history.push(entry);
    }
}

#[cfg(test)]
mod tests;
