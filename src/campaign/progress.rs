//! A trainee's progress as tables: per mission and per skill.

use serde::Serialize;

use super::{
    CareerEntry, CareerFlight, CareerStanding, LockReason, Mastery, MissionCourse, MissionStage,
    Offer, Skill, is_practice,
};
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::workshop::DesignKind;

/// The progress on a day.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CareerProgress {
    /// Credits that can be spent.
    pub credits: u32,
    /// The experience points earned so far.
    pub experience: u64,
    pub level: u32,
    /// The total experience that the next level needs.
    pub next_level_experience: u64,
    /// The maximum number of drones that may be flown at a time.
    pub licence: u8,
    /// The kinds of vehicles, and which of them can be built.
    pub vehicles: Vec<VehicleProgress>,
    /// The number of finished flights.
    pub flights: u32,
    /// The number of flights from an imported profile, which are unverified.
    pub imported_flights: usize,
    pub next: Option<TrainingAdvice>,
    /// The missions, in the order of the course; other flown missions come last.
    pub missions: Vec<MissionProgress>,
    /// The skills, in the order of [`Skill::ALL`].
    pub skills: Vec<SkillProgress>,
}

/// A kind of vehicle in a career.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VehicleProgress {
    pub kind: &'static str,
    /// The kind's name on the screen.
    pub title: Text,
    /// The id of the mission that must be passed before such vehicles can be built; `None` if they can.
    pub after: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrainingAdvice {
    /// The skill to train.
    pub skill: Skill,
    /// The name of the skill on the screen.
    pub skill_title: Text,
    /// Id of the mission that trains the skill best.
    pub mission: String,
    /// The name of the mission on the screen.
    pub mission_title: Text,
}

/// The results of a trainee in one mission.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MissionProgress {
    /// The id of the mission.
    pub id: String,
    /// The mission's name on the screen.
    pub title: Text,
    /// The number of drones.
    pub vehicles: u8,
    /// Whether the mission is locked, open or passed.
    pub state: MissionState,
    /// Why the mission is locked, if it is.
    pub reasons: Vec<Text>,
    /// The number of attempts: flights by hand that were not practice.
    pub tries: usize,
    /// The best score of flights that count.
    pub best: Option<u16>,
    /// The best medal of flights that count.
    pub medal: Option<Medal>,
    /// The score of the first attempt.
    pub first: Option<u16>,
    /// The score of the last attempt.
    pub last: Option<u16>,
    /// Points per attempt, by least squares over all attempts; `None` for fewer than two.
    pub trend: Option<f64>,
}

/// Whether a mission is locked, open or passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MissionState {
    Locked,
    /// Open, but not passed yet.
    Open,
    /// Passed at least once.
    Passed,
}

/// How well a trainee masters a skill.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkillProgress {
    pub skill: Skill,
    /// The skill's name on the screen.
    pub title: Text,
    /// The probability of mastery today, in percent.
    pub percent: u8,
    /// The state of the skill.
    pub mastery: Mastery,
    /// The number of flights that gave evidence.
    pub opportunities: u32,
    /// The number of missions that gave evidence.
    pub missions: usize,
    /// The day on which the skill will be due, in days since 1970 (UTC), if it was ever mastered.
    pub due_day: Option<i64>,
}

impl CareerProgress {
    /// The progress of a history in a course, on a day.
    pub fn of(course: &MissionCourse, history: &[CareerEntry], day: i64) -> Self {
        let standing = CareerStanding::of(history);
        let (experience, level, next_level_experience) = standing.experience();
        let flights: Vec<&CareerFlight> = history
            .iter()
            .filter_map(|entry| match entry {
                CareerEntry::Flight(flight) => Some(flight),
                CareerEntry::Purchase(_) => None,
            })
            .collect();
        let next = course
            .next(&standing, day)
            .map(|(skill, offer)| TrainingAdvice {
                skill,
                skill_title: skill.title(),
                mission: offer.id.clone(),
                mission_title: offer.title.clone(),
            });
        Self {
            credits: standing.credits(),
            experience,
            level,
            next_level_experience,
            licence: standing.licence(),
            vehicles: VehicleProgress::all(&standing, course),
            flights: standing.flights(),
            imported_flights: flights.iter().filter(|it| it.imported).count(),
            next,
            missions: missions(course, &standing, &flights, day),
            skills: Skill::ALL
                .iter()
                .map(|&skill| SkillProgress::of(skill, &standing, day))
                .collect(),
        }
    }

    /// The mean probability of mastery over all skills, in percent.
    pub fn mean_skill_percent(&self) -> f64 {
        let sum: u32 = self.skills.iter().map(|it| u32::from(it.percent)).sum();
        f64::from(sum) / self.skills.len().max(1) as f64
    }
}

impl VehicleProgress {
    /// All kinds of vehicles for a trainee.
    pub fn all(standing: &CareerStanding, course: &MissionCourse) -> Vec<Self> {
        let of = |kind: DesignKind| Self {
            kind: kind.id(),
            title: kind.name(),
            after: standing
                .kind_lock(kind, course)
                .map(|offer| offer.id.clone()),
        };
        DesignKind::ALL.into_iter().map(of).collect()
    }

    /// The kinds on one line: those that can be built, and after which mission the others can, by the number that its id
    /// begins with.
    pub fn line(all: &[Self]) -> Text {
        let word = |one: &Self| match &one.after {
            None => one.title.clone(),
            Some(mission) => text!(
                "vehicle-after",
                kind = one.title.clone(),
                mission = mission.split('-').next().unwrap_or(mission)
            ),
        };
        let words = all.iter().map(word).collect();
        text!("vehicle-kinds", kinds = Text::joined(", ", words))
    }
}

fn missions(
    course: &MissionCourse,
    standing: &CareerStanding,
    flights: &[&CareerFlight],
    day: i64,
) -> Vec<MissionProgress> {
    let of_course = course.offers().iter().map(|offer| {
        let stage = course.stage(offer, standing, day);
        MissionProgress::of_offer(offer, stage, standing, flights)
    });
    let mut others: Vec<&CareerFlight> = Vec::new();
    for flight in flights {
        let is_known = others.iter().any(|known| known.mission == flight.mission);
        if course.offer(&flight.mission).is_none() && !is_known {
            others.push(flight);
        }
    }
    let others = others.into_iter().map(|flight| {
        let title = Text::verbatim(flight.mission.clone());
        let state = if standing.has_passed(&flight.mission) {
            MissionState::Passed
        } else {
            MissionState::Open
        };
        MissionProgress {
            state,
            ..MissionProgress::new(&flight.mission, title, flight.vehicles, standing, flights)
        }
    });
    of_course.chain(others).collect()
}

impl MissionProgress {
    fn of_offer(
        offer: &Offer,
        stage: MissionStage,
        standing: &CareerStanding,
        flights: &[&CareerFlight],
    ) -> Self {
        let (state, reasons) = match stage {
            MissionStage::Locked(reasons) => (
                MissionState::Locked,
                reasons.iter().map(LockReason::text).collect(),
            ),
            MissionStage::Open => (MissionState::Open, Vec::new()),
            MissionStage::Passed(_) => (MissionState::Passed, Vec::new()),
        };
        let title = offer.title.clone();
        Self {
            state,
            reasons,
            ..Self::new(&offer.id, title, offer.vehicles, standing, flights)
        }
    }

    /// The progress in a mission, as if it were open.
    fn new(
        id: &str,
        title: Text,
        vehicles: u8,
        standing: &CareerStanding,
        flights: &[&CareerFlight],
    ) -> Self {
        let tries = flights
            .iter()
            .filter(|it| it.mission == id && !is_practice(it.stake, it.flown_by));
        let scores: Vec<u16> = tries.map(|it| it.score).collect();
        let best = standing.best(id);
        Self {
            id: id.to_owned(),
            title,
            vehicles,
            state: MissionState::Open,
            reasons: Vec::new(),
            tries: scores.len(),
            best: best.and_then(|best| best.score),
            medal: best.and_then(|best| best.medal),
            first: scores.first().copied(),
            last: scores.last().copied(),
            trend: trend(&scores),
        }
    }
}

impl MissionProgress {
    /// Whether the mission was passed at least once.
    pub fn is_passed(&self) -> bool {
        self.state == MissionState::Passed
    }
}

impl SkillProgress {
    fn of(skill: Skill, standing: &CareerStanding, day: i64) -> Self {
        let known = standing.skill(skill);
        Self {
            skill,
            title: skill.title(),
            percent: (known.chance(day) * 100.0).round() as u8,
            mastery: known.mastery(day),
            opportunities: known.opportunities(),
            missions: known.missions(),
            due_day: known.due_day(),
        }
    }
}

/// The slope of the regression line through scores, in points per attempt, to a tenth.
fn trend(scores: &[u16]) -> Option<f64> {
    let count = scores.len() as f64;
    if scores.len() < 2 {
        return None;
    }
    let mean_try = (count - 1.0) / 2.0;
    let mean_score = scores.iter().map(|it| f64::from(*it)).sum::<f64>() / count;
    let (mut covariance, mut variance) = (0.0, 0.0);
    for (index, score) in scores.iter().enumerate() {
        let from_mean = index as f64 - mean_try;
        covariance += from_mean * (f64::from(*score) - mean_score);
        variance += from_mean * from_mean;
    }
    Some((covariance / variance * 10.0).round() / 10.0 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trend_is_the_slope_of_the_line_that_fits_best() {
        assert_eq!(trend(&[]), None);
        assert_eq!(trend(&[700]), None);
        assert_eq!(trend(&[500, 600, 700]), Some(100.0));
        assert_eq!(trend(&[700, 500, 600]), Some(-50.0));
        assert_eq!(trend(&[800, 800, 800]), Some(0.0));
    }
}
