//! The results of a class: what each trainee has reached, and what the whole class does not know yet.
//!
//! All figures follow from the records that the trainees have handed in: those of a trainee from the same
//! [`CareerProgress`] as in the trainee's own career, those of the class from each trainee's best flight that counts.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::campaign::{
    CareerEntry, CareerFlight, CareerProgress, Mastery, MissionCourse, MissionProgress, Skill,
    SkillProgress, Stake, is_practice,
};
use crate::exam_seal::SealCheck;
use crate::mission::Mission;
use crate::mission::record::Head;
use crate::record::InstructorPart;
use crate::scoring::{MissionFile, ObjectiveReport, Report};
use crate::text::{Text, rounded};

mod found;
mod missing;

pub use found::{BesideFlight, FoundFlights};
pub use missing::TryWithoutRecord;

/// A trainee's flight of a mission, from its record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClassFlight {
    /// The name of the record.
    pub record: String,
    /// Its start in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The name of the trainee's profile, if there was one.
    pub profile: Option<String>,
    /// The title of the mission.
    pub title: Text,
    /// The revision of the mission.
    pub revision: u32,
    /// How the mission compares with that of the course.
    pub mission_file: Option<MissionFile>,
    /// The seed of hazards and sensors.
    pub seed: u64,
    /// Mission time used, in seconds.
    pub sim_time_s: f64,
    /// Whether designs of the trainee were flown instead of the mission's own vehicles.
    pub has_own_fleet: bool,
    /// Whether the flight was paused.
    pub has_pause: bool,
    /// Whether the record has an end: the flight was flown, or given up, to its end.
    pub has_end: bool,
    /// The objectives, in file order.
    pub objectives: Vec<FlownObjective>,
    /// The entry in a career.
    pub flight: CareerFlight,
    /// What an instructor did in it.
    pub instructor: InstructorPart,
    /// The seal of the desk, if it is a try of an exam.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seal: Option<SealCheck>,
}

/// The result of an objective, and the skill that it trains.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FlownObjective {
    /// The skill, if the objective trains one.
    pub skill: Option<Skill>,
    #[serde(flatten)]
    pub result: ObjectiveReport,
}

impl FlownObjective {
    /// The share of the points that was reached, 0 to 1.
    pub fn share(&self) -> f64 {
        if self.result.points_max > 0.0 {
            (self.result.points / self.result.points_max).clamp(0.0, 1.0)
        } else {
            f64::from(u8::from(self.result.met))
        }
    }
}

impl ClassFlight {
    /// The flight of a record that was scored again; it began on the day `began`, in days since 1970 (UTC).
    pub fn of(record: String, head: &Head, mission: &Mission, report: Report, began: i64) -> Self {
        let flight = CareerFlight::of(mission, &report, head.stake, began);
        let skills: BTreeMap<&str, Option<Skill>> = mission.objective_skills().collect();
        let objectives = report.objectives.into_iter().map(|result| FlownObjective {
            skill: skills.get(result.id.as_str()).copied().flatten(),
            result,
        });
        Self {
            record,
            when: head.when.clone(),
            profile: head.profile.clone(),
            title: report.title,
            revision: report.revision,
            mission_file: report.mission_file,
            seed: report.seed,
            sim_time_s: report.sim_time_s,
            has_own_fleet: !head.designs.is_empty(),
            has_pause: false,
            has_end: false,
            objectives: objectives.collect(),
            flight,
            instructor: InstructorPart::default(),
            seal: None,
        }
    }

    /// The entry in a career. A guest's flight by script claims to be graded, which a career would not have allowed.
    fn entry(&self) -> CareerFlight {
        let stake = if self.counts() {
            self.flight.stake
        } else {
            Stake::Practice
        };
        CareerFlight {
            stake,
            ..self.flight.clone()
        }
    }

    /// Whether the flight counts as a try: practice and flights by script do not, nor do tries of an exam without a valid
    /// seal of the expected key which says that they count.
    pub fn counts(&self) -> bool {
        let is_sealed_so = self.seal.as_ref().is_none_or(SealCheck::counts);
        is_sealed_so && !is_practice(self.flight.stake, self.flight.flown_by)
    }
}

/// A trainee and the flights that were handed in.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClassTrainee {
    /// The trainee's user name on the host of the class.
    pub user: String,
    /// The flights, oldest first.
    pub flights: Vec<ClassFlight>,
}

impl ClassTrainee {
    /// The names of the trainee's profiles.
    pub fn profiles(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for name in self.flights.iter().filter_map(|it| it.profile.as_deref()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// The flights in which an instructor flew vehicles, or recalled a situation.
    pub fn instructed(&self) -> impl Iterator<Item = &ClassFlight> {
        self.flights.iter().filter(|it| !it.instructor.is_empty())
    }

    /// The progress that the handed-in flights show.
    pub fn progress(&self, course: &MissionCourse, day: i64) -> CareerProgress {
        let flights = self.flights.iter().map(ClassFlight::entry);
        let history: Vec<CareerEntry> = flights.map(CareerEntry::Flight).collect();
        CareerProgress::of(course, &history, day)
    }

    /// The best flight that counts of each mission; of equal ones, the first.
    pub fn best_flights(&self) -> Vec<&ClassFlight> {
        let mut best: BTreeMap<&str, &ClassFlight> = BTreeMap::new();
        for flight in self.flights.iter().filter(|it| it.counts()) {
            let known = best.entry(&flight.flight.mission).or_insert(flight);
            if flight.flight.score > known.flight.score {
                *known = flight;
            }
        }
        best.into_values().collect()
    }
}

/// Adds a flight to those of its trainee. One that is known already changes nothing.
pub fn add_flight(trainees: &mut Vec<ClassTrainee>, user: &str, flight: ClassFlight) {
    let place = trainees.binary_search_by(|it| it.user.as_str().cmp(user));
    let index = place.unwrap_or_else(|index| {
        let user = user.to_owned();
        let flights = Vec::new();
        trainees.insert(index, ClassTrainee { user, flights });
        index
    });
    let flights = &mut trainees[index].flights;
    // The names of records begin with their time.
    if let Err(place) = flights.binary_search_by(|it| it.record.cmp(&flight.record)) {
        flights.insert(place, flight);
    }
}

/// The results of a class on a day.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ClassResults {
    /// The trainees, by user name.
    pub trainees: Vec<TraineeResults>,
    /// The missions that were tried, by id.
    pub missions: Vec<MissionSpread>,
    /// The objectives of these missions; those that the class knows least come first.
    pub objectives: Vec<ObjectiveSpread>,
    /// The skills that were shown; those that the class knows least come first.
    pub skills: Vec<SkillSpread>,
}

/// The results of one trainee.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TraineeResults {
    pub user: String,
    /// The names of the trainee's profiles.
    pub profiles: Vec<String>,
    /// The number of flights that count.
    pub tries: usize,
    /// The number of flights that do not count: practice, and flights by script.
    pub practice: usize,
    /// The missions that were tried.
    pub missions: Vec<MissionProgress>,
    /// The skills, in the order of [`Skill::ALL`].
    pub skills: Vec<SkillProgress>,
}

/// How the best scores of the trainees in a mission are spread.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MissionSpread {
    /// The id of the mission.
    pub mission: String,
    pub title: Text,
    /// The number of trainees who tried it.
    pub trainees: usize,
    /// The number of trainees who passed it.
    pub passed: usize,
    /// The number of tries of all trainees.
    pub tries: usize,
    pub scores: Spread,
}

/// How well the class meets an objective, in each trainee's best flight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObjectiveSpread {
    /// The id of the mission.
    pub mission: String,
    /// The id of the objective in its mission.
    pub objective: String,
    pub title: Text,
    /// The skill that it trains.
    pub skill: Option<Skill>,
    /// Whether the mission fails without it.
    pub mandatory: bool,
    /// The number of trainees who tried the mission.
    pub trainees: usize,
    /// The number of them who met the objective.
    pub met: usize,
    /// The mean share of its points, in percent.
    pub mean_percent: f64,
}

/// How well the class masters a skill.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkillSpread {
    pub skill: Skill,
    pub title: Text,
    /// The number of trainees who have shown it.
    pub trainees: usize,
    /// The number of trainees who master it.
    pub mastered: usize,
    /// The probability of mastery, in percent.
    pub percent: Spread,
}

/// How some figures are spread: their least, greatest and quartiles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Spread {
    pub least: f64,
    pub lower_quartile: f64,
    pub median: f64,
    pub upper_quartile: f64,
    pub most: f64,
}

impl Spread {
    /// The quartiles of figures, by linear interpolation between neighbours; `None` without any.
    pub fn of(mut figures: Vec<f64>) -> Option<Self> {
        figures.sort_by(f64::total_cmp);
        let last = figures.len().checked_sub(1)?;
        let at = |share: f64| {
            let place = share * last as f64;
            let below = place.floor() as usize;
            let above = (below + 1).min(last);
            let between = place - place.floor();
            rounded(
                figures[below] + (figures[above] - figures[below]) * between,
                1,
            )
        };
        Some(Self {
            least: at(0.0),
            lower_quartile: at(0.25),
            median: at(0.5),
            upper_quartile: at(0.75),
            most: at(1.0),
        })
    }
}

impl ClassResults {
    /// The results of these trainees on a day, in days since 1970 (UTC).
    pub fn of(course: &MissionCourse, trainees: &[ClassTrainee], day: i64) -> Self {
        let results: Vec<TraineeResults> = trainees
            .iter()
            .map(|trainee| TraineeResults::of(course, trainee, day))
            .collect();
        Self {
            missions: mission_spreads(&results),
            objectives: objective_spreads(trainees),
            skills: skill_spreads(&results),
            trainees: results,
        }
    }
}

impl TraineeResults {
    fn of(course: &MissionCourse, trainee: &ClassTrainee, day: i64) -> Self {
        let progress = trainee.progress(course, day);
        let tries = trainee.flights.iter().filter(|it| it.counts()).count();
        let mut missions = progress.missions;
        missions.retain(|it| it.tries > 0);
        Self {
            user: trainee.user.clone(),
            profiles: trainee.profiles().into_iter().map(str::to_owned).collect(),
            tries,
            practice: trainee.flights.len() - tries,
            missions,
            skills: progress.skills,
        }
    }

    /// The trainee's result in a mission, if it was tried.
    pub fn mission(&self, id: &str) -> Option<&MissionProgress> {
        self.missions.iter().find(|it| it.id == id)
    }

    /// The trainee's best score in a mission, if it was tried; 0 if no flight earned any points.
    pub fn best(&self, id: &str) -> Option<u16> {
        Some(self.mission(id)?.best.unwrap_or_default())
    }

    /// The trainee's standing in a skill, if it was shown.
    pub fn skill(&self, skill: Skill) -> Option<&SkillProgress> {
        let mut known = self.skills.iter();
        known.find(|it| it.skill == skill && it.mastery != Mastery::Unknown)
    }
}

/// A mission's number, which begins its id; the whole id if it has none.
pub fn number_of_mission(id: &str) -> &str {
    let number = id.split('-').next().unwrap_or(id);
    if number.chars().any(|c| c.is_ascii_digit()) {
        number
    } else {
        id
    }
}

fn mission_spreads(trainees: &[TraineeResults]) -> Vec<MissionSpread> {
    let mut by_mission: BTreeMap<&str, Vec<&MissionProgress>> = BTreeMap::new();
    for mission in trainees.iter().flat_map(|it| &it.missions) {
        by_mission.entry(&mission.id).or_default().push(mission);
    }
    let spreads = by_mission.into_iter().filter_map(|(id, results)| {
        let best = results
            .iter()
            .map(|it| f64::from(it.best.unwrap_or_default()));
        Some(MissionSpread {
            mission: id.to_owned(),
            title: results.first()?.title.clone(),
            trainees: results.len(),
            passed: results.iter().filter(|it| it.is_passed()).count(),
            tries: results.iter().map(|it| it.tries).sum(),
            scores: Spread::of(best.collect()).unwrap_or_default(),
        })
    });
    spreads.collect()
}

fn objective_spreads(trainees: &[ClassTrainee]) -> Vec<ObjectiveSpread> {
    let mut found: BTreeMap<(&str, &str), Vec<&FlownObjective>> = BTreeMap::new();
    let mut order: Vec<(&str, &str)> = Vec::new();
    for flight in trainees.iter().flat_map(ClassTrainee::best_flights) {
        for objective in &flight.objectives {
            let key = (flight.flight.mission.as_str(), objective.result.id.as_str());
            let known = found.entry(key).or_default();
            if known.is_empty() {
                order.push(key);
            }
            known.push(objective);
        }
    }
    let spread = |key: (&str, &str)| {
        let seen = found.get(&key)?;
        let newest = seen.last()?;
        let shares = seen.iter().map(|it| it.share());
        Some(ObjectiveSpread {
            mission: key.0.to_owned(),
            objective: key.1.to_owned(),
            title: newest.result.title.clone(),
            skill: newest.skill,
            mandatory: newest.result.mandatory,
            trainees: seen.len(),
            met: seen.iter().filter(|it| it.result.met).count(),
            mean_percent: rounded(shares.sum::<f64>() / seen.len() as f64 * 100.0, 1),
        })
    };
    let mut spreads: Vec<ObjectiveSpread> = order.into_iter().filter_map(spread).collect();
    spreads.sort_by(|a, b| {
        let met = |it: &ObjectiveSpread| it.met as f64 / it.trainees as f64;
        let by_met = met(a).total_cmp(&met(b));
        by_met.then(a.mean_percent.total_cmp(&b.mean_percent))
    });
    spreads
}

fn skill_spreads(trainees: &[TraineeResults]) -> Vec<SkillSpread> {
    let spread = |&skill: &Skill| {
        let shown: Vec<&SkillProgress> = trainees.iter().filter_map(|it| it.skill(skill)).collect();
        let is_mastered = |it: &&&SkillProgress| it.mastery == Mastery::Mastered;
        let percent = shown.iter().map(|it| f64::from(it.percent));
        Some(SkillSpread {
            skill,
            title: skill.title(),
            trainees: shown.len(),
            mastered: shown.iter().filter(is_mastered).count(),
            percent: Spread::of(percent.collect())?,
        })
    };
    let mut spreads: Vec<SkillSpread> = Skill::ALL.iter().filter_map(spread).collect();
    spreads.sort_by(|a, b| a.percent.median.total_cmp(&b.percent.median));
    spreads
}

#[cfg(test)]
mod tests;
