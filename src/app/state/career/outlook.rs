//! The outlook: the recommended next mission, the rewards that a mission can still earn, and the
//! advice that the trainee still needs.

use super::Career;
use crate::campaign::{
    Aids, CareerEntry, CareerFlight, Mastery, MissionStage, Offer, Skill, Stake,
};
use crate::mission::Progress;

const PERFECT: u16 = 1000;

impl Career {
    /// The state of a mission in the career, if it is in the course.
    pub fn stage(&self, mission: &str) -> Option<MissionStage> {
        let offer = self.course.offer(mission)?;
        Some(self.course.stage(offer, &self.standing, self.day))
    }

    /// The skill to train next, and the mission or drill that trains it; `None` if nothing can be
    /// recommended.
    pub fn next(&self) -> Option<(Skill, &Offer)> {
        self.course.next(&self.standing, self.day)
    }

    /// The id of the mission to show next; for a drill, of the mission to which it belongs.
    pub fn next_mission(&self) -> Option<&str> {
        let (_, offer) = self.next()?;
        let id = offer.drill_of.as_deref();
        Some(id.unwrap_or(&offer.id))
    }

    /// The mission or drill to fly for a skill; `None` if none that is open trains it.
    pub fn training(&self, skill: Skill) -> Option<&Offer> {
        self.course.training(skill, &self.standing, self.day)
    }

    /// The skills trained by a mission that are due for a refresher; empty if the mission has not
    /// been passed.
    pub fn due(&self, offer: &Offer) -> Vec<Skill> {
        if !self.standing.has_passed(&offer.id) {
            return Vec::new();
        }
        let is_due = |skill: &Skill| self.standing.skill(*skill).mastery(self.day) == Mastery::Due;
        offer.skills.iter().copied().filter(is_due).collect()
    }

    /// Credits that a perfect flight of a mission would still earn.
    pub fn credits_left(&self, offer: &Offer) -> u32 {
        let best = self.standing.best(&offer.id).and_then(|best| best.passed);
        let open = best.map_or(PERFECT, |best| PERFECT.saturating_sub(best));
        (f64::from(offer.credits) * f64::from(open) / f64::from(PERFECT)).round() as u32
    }

    /// Whether a mission was flown today with the seed of the day.
    pub fn flew_daily(&self, mission: &str) -> bool {
        self.history.iter().rev().any(|entry| {
            let CareerEntry::Flight(flight) = entry else {
                return false;
            };
            let CareerFlight { stake, day, .. } = flight;
            flight.mission == mission && *stake == Stake::Daily && *day == self.day
        })
    }

    /// Removes advice that the trainee no longer needs.
    pub fn fade(&self, mission: &str, progress: &mut Progress) {
        let offer = self.course.offer(mission);
        let skills = offer.iter().flat_map(|offer| &offer.skills);
        // Advice concerns the whole mission: it stays while one of its skills needs it.
        let least = skills
            .map(|skill| self.standing.skill(*skill).chance(self.day))
            .fold(1.0, f64::min);
        let chance = if offer.is_some() { least } else { 0.0 };
        if !self.aids.shows_hint(progress.phase.level(), chance) {
            progress.hint = None;
        }
        if self.aids == Aids::None || self.standing.has_passed(mission) {
            progress.lesson = None;
        }
        if !self.aids.shows_feedback() {
            progress.feedback = None;
        }
    }
}
