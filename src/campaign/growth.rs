//! The growth of a career: the same history as in [`CareerStanding`], step by step, for charts and to explain changes
//! in a skill.

use std::collections::BTreeMap;

use super::{CareerEntry, CareerFlight, CareerStanding, Skill, Stake};
use crate::scoring::Medal;
use crate::text::Text;

/// A career over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Growth {
    wealth: Vec<Wealth>,
    tries: BTreeMap<String, Vec<Try>>,
    moves: BTreeMap<Skill, Vec<SkillMove>>,
}

/// Credits and experience after an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wealth {
    /// Credits left after the entry.
    pub credits: u32,
    /// The experience points earned so far.
    pub experience: u64,
}

/// A finished flight of a mission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Try {
    /// The day on which the flight ended, in days since 1970 (UTC).
    pub day: i64,
    /// The score, 0 to 1000.
    pub score: u16,
    /// Whether all mandatory objectives were met.
    pub passed: bool,
    /// The medal, if any.
    pub medal: Option<Medal>,
    pub stake: Stake,
}

/// The change that one flight makes to a skill.
#[derive(Debug, Clone, PartialEq)]
pub struct SkillMove {
    /// Id of the mission.
    pub mission: String,
    /// The day, in days since 1970 (UTC).
    pub day: i64,
    /// The name of the evidence's basis.
    pub what: Text,
    /// The outcome, 0 to 1.
    pub outcome: f64,
    /// The probability of mastery on that day before the flight, 0 to 1.
    pub before: f64,
    pub after: f64,
}

impl Growth {
    /// The growth in a history, which begins with the oldest entry.
    pub fn of<'a>(history: impl IntoIterator<Item = &'a CareerEntry>) -> Self {
        let mut growth = Self::default();
        let mut standing = CareerStanding::default();
        for entry in history {
            if let CareerEntry::Flight(flight) = entry {
                growth.fly(flight, &standing);
            }
            standing.enter(entry);
            growth.wealth.push(Wealth {
                credits: standing.credits(),
                experience: standing.experience().0,
            });
        }
        growth
    }

    /// Adds a flight, with the standing before it.
    fn fly(&mut self, flight: &CareerFlight, standing: &CareerStanding) {
        let tries = self.tries.entry(flight.mission.clone()).or_default();
        tries.push(Try {
            day: flight.day,
            score: flight.score,
            passed: flight.passed,
            medal: flight.medal,
            stake: flight.stake,
        });
        if !standing.counts(flight) {
            return;
        }
        for shown in flight.shown_skills() {
            let mut known = standing.skill(shown.skill);
            let before = known.chance(flight.day);
            known.observe(shown.outcome, flight.tier, &flight.mission, flight.day);
            let moves = self.moves.entry(shown.skill).or_default();
            moves.push(SkillMove {
                mission: flight.mission.clone(),
                day: flight.day,
                what: shown.what,
                outcome: shown.outcome,
                before,
                after: known.chance(flight.day),
            });
        }
    }

    /// Credits and experience after each entry, oldest first.
    pub fn wealth(&self) -> &[Wealth] {
        &self.wealth
    }

    /// The flights of a mission, oldest first.
    pub fn tries(&self, mission: &str) -> &[Try] {
        self.tries.get(mission).map_or(&[], Vec::as_slice)
    }

    /// The changes in a skill, oldest first.
    pub fn moves(&self, skill: Skill) -> &[SkillMove] {
        self.moves.get(&skill).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Evidence, Purchase};
    use super::*;

    fn flight(mission: &str, day: i64, score: u16, outcomes: &[(Skill, f64)]) -> CareerEntry {
        let evidence = outcomes.iter().map(|&(skill, outcome)| Evidence {
            skill,
            outcome,
            basis: None,
            what: Text::default(),
        });
        CareerEntry::Flight(CareerFlight {
            flown_by: None,
            mission: mission.to_owned(),
            drill_of: None,
            tier: 1,
            reward: 400,
            vehicles: 1,
            stake: Stake::Graded,
            day,
            score,
            passed: score >= 550,
            medal: None,
            evidence: evidence.collect(),
            wear: 0,
            imported: false,
        })
    }

    fn history() -> Vec<CareerEntry> {
        vec![
            flight("one", 1, 500, &[(Skill::K3, 0.0), (Skill::K4, 1.0)]),
            flight("one", 2, 800, &[(Skill::K3, 1.0), (Skill::K3, 0.5)]),
            CareerEntry::Purchase(Purchase {
                part: "s_gas4".to_owned(),
                credits: 100,
            }),
            flight("two", 9, 900, &[(Skill::K3, 1.0)]),
        ]
    }

    #[test]
    fn the_last_step_is_the_standing() {
        let history = history();
        let (growth, standing) = (Growth::of(&history), CareerStanding::of(&history));
        let last = growth.wealth().last().expect("there were entries");
        assert_eq!(last.credits, standing.credits());
        assert_eq!(last.experience, standing.experience().0);
        assert_eq!(growth.wealth().len(), history.len());
        for skill in [Skill::K3, Skill::K4] {
            let last = growth.moves(skill).last().expect("it was shown");
            let now = standing.skill(skill).chance(last.day);
            assert!((last.after - now).abs() < 1e-12, "{skill:?}");
        }
    }

    #[test]
    fn every_flight_goes_on_from_the_one_before_less_what_was_forgotten() {
        let growth = Growth::of(&history());
        let moves = growth.moves(Skill::K3);
        assert_eq!(
            moves.len(),
            3,
            "one for each flight, however often it was shown"
        );
        assert!((moves[1].outcome - 0.75).abs() < 1e-12);
        assert!(moves[2].before < moves[1].after, "a week later");
        assert!(moves[1].after > moves[1].before && moves[2].after > moves[2].before);
        assert_eq!(growth.moves(Skill::K9), []);
    }

    #[test]
    fn tries_are_kept_by_mission() {
        let growth = Growth::of(&history());
        let scores = |mission| -> Vec<u16> {
            let tries = growth.tries(mission).iter();
            tries.map(|one| one.score).collect()
        };
        assert_eq!(scores("one"), [500, 800]);
        assert_eq!(scores("two"), [900]);
        assert!(scores("three").is_empty());
    }
}
