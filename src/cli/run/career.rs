//! A run that is flown for somebody's career: whether it may be, how it counts, and what it brings.

use std::time::SystemTime;

use rand::TryRng as _;
use rand::rngs::SysRng;
use serde::Serialize;

use super::RunArguments;
use crate::campaign::{
    Course, Entry, PartState, Reason, Reward, Stage, Stake, Standing, daily_seed, exam_seed,
};
use crate::cli::settings::Settings;
use crate::cli::{Failure, trainee};
use crate::mission::{Mission, Report};
use crate::scoring::TryReport;
use crate::store::{self, Landing, Profile, Profiles, RunEntry, Runs, day_of};
use crate::text;
use crate::text::{Locale, Text};
use crate::workshop::Design;

/// Seeds of one's own are below this: small enough to be typed.
const SEEDS: u64 = 1_000_000;
/// The seed where nobody names one and nothing is kept.
const FIRST_SEED: u64 = 1;

/// How a run counts, and on which layout it is flown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Terms {
    pub stake: Stake,
    pub seed: u64,
}

impl Terms {
    /// What the options ask for. Without a profile nothing counts; with one, a layout that was chosen is for practice, and
    /// otherwise each try gets a fresh one.
    pub fn of(options: &RunArguments, mission: &Mission, is_kept: bool) -> Self {
        let (stake, seed) = if options.exam {
            (Stake::Exam, exam_seed(&mission.id, mission.rev))
        } else if options.daily {
            (Stake::Daily, daily_seed(day_of(SystemTime::now())))
        } else if let Some(seed) = options.seed {
            (Stake::Practice, seed)
        } else if is_kept && let Ok(fresh) = SysRng.try_next_u64() {
            (Stake::Graded, fresh % SEEDS)
        } else {
            (Stake::Practice, FIRST_SEED)
        };
        Self { stake, seed }
    }
}

/// The trainee for whom a mission is flown.
pub(super) struct Trainee<'a> {
    profiles: Profiles,
    profile: Profile,
    course: Course,
    history: Vec<Entry>,
    runs: Runs,
    locale: &'a Locale,
}

/// What a flight brought, as a document.
#[derive(Debug, Serialize)]
pub(super) struct CareerDocument {
    profile: String,
    /// Whether the profile has it.
    stored: bool,
    #[serde(flatten)]
    reward: Reward,
}

/// What became of a flight.
pub(super) struct Outcome {
    pub reward: Reward,
    profile: String,
    pub is_stored: bool,
}

impl Outcome {
    /// As a document.
    pub fn document(self) -> CareerDocument {
        CareerDocument {
            profile: self.profile,
            stored: self.is_stored,
            reward: self.reward,
        }
    }

    /// As a section of the debrief.
    pub fn text(&self, locale: &Locale) -> String {
        let lines = self.reward.lines();
        let lines: Vec<String> = lines
            .iter()
            .map(|line| format!("  {}", locale.text(line)))
            .collect();
        format!(
            "{}\n{}",
            locale.text(&text!("reward-heading")),
            lines.join("\n")
        )
    }
}

impl<'a> Trainee<'a> {
    /// Whoever was named on the command line or in the environment; a script means nobody's career by what lies in a file.
    ///
    /// # Errors
    /// There is no such profile, or profiles cannot be had.
    pub fn named(settings: &Settings, locale: &'a Locale) -> Result<Option<Self>, Failure> {
        if !settings.is_named("profile") {
            return Ok(None);
        }
        let profiles = trainee::open(settings, locale)?;
        let profile = trainee::choose(&profiles, None, settings, locale)?;
        let history = profiles.history(&profile);
        let history = history.map_err(|error| trainee::refused(&error, locale))?;
        let data = settings.data.clone().unwrap_or_default();
        Ok(Some(Self {
            profiles,
            profile,
            course: store::course(),
            history,
            runs: Runs::within(&data),
            locale,
        }))
    }

    /// Whose name is in the record.
    pub fn name(&self) -> &str {
        &self.profile.name
    }

    /// Where the flight is recorded.
    pub fn runs(&self) -> &Runs {
        &self.runs
    }

    /// Makes sure that the mission may be flown, and with drones that may be used. A mission that is none of the course
    /// counts as practice, and so does one flown with a frame that was not built.
    ///
    /// # Errors
    /// Why it may not.
    pub fn admit(
        &self,
        mission: &Mission,
        terms: Terms,
        is_reframed: bool,
    ) -> Result<Terms, Failure> {
        let standing = Standing::of(&self.history);
        let Some(offer) = self.course.offer(&mission.id) else {
            return Ok(self.practice(mission, terms));
        };
        let day = day_of(SystemTime::now());
        if let Stage::Locked(reasons) = self.course.stage(offer, &standing, day) {
            let reasons = reasons.iter().map(Reason::text).collect();
            let why = Text::joined("; ", reasons);
            let text = text!("mission-locked", mission = &offer.title, why = why);
            return Err(trainee::invalid(&text, self.locale));
        }
        for design in mission.fleet() {
            self.admit_design(design, &standing)?;
        }
        Ok(if store::is_of_course(mission) && !is_reframed {
            terms
        } else {
            self.practice(mission, terms)
        })
    }

    fn practice(&self, mission: &Mission, terms: Terms) -> Terms {
        if terms.stake != Stake::Practice {
            let text = text!("profile-own-mission", mission = mission.id.as_str());
            tell!("sortie: {}", self.locale.text(&text));
        }
        Terms {
            stake: Stake::Practice,
            ..terms
        }
    }

    /// Makes sure that all parts of a design may be used.
    fn admit_design(&self, design: &Design, standing: &Standing) -> Result<(), Failure> {
        let missing = standing.missing_parts(design, &self.course);
        if missing.is_empty() {
            return Ok(());
        }
        let (name, profile) = (design.name.as_str(), self.name());
        let mut lines = vec![text!("parts-missing", design = name, profile = profile)];
        lines.extend(missing.iter().map(|(part, state)| match state {
            PartState::Locked(mission) => {
                let title = self.course.offer(mission).map(|offer| offer.title.clone());
                let title = title.unwrap_or_else(|| Text::verbatim(mission.clone()));
                text!("part-locked", part = part.name(), mission = title)
            }
            PartState::ForSale(price) => {
                text!(
                    "part-for-sale",
                    part = part.name(),
                    price = *price,
                    id = part.id
                )
            }
            PartState::Owned => part.name(),
        }));
        let text = Text::joined("\n  ", lines);
        Err(trainee::invalid(&text, self.locale))
    }

    /// Which try at the mission comes next, from 1.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn attempt(&self, mission: &Mission) -> Result<u32, Failure> {
        let tries = self.tries(mission)?.len();
        Ok(u32::try_from(tries + 1).unwrap_or(u32::MAX))
    }

    fn tries(&self, mission: &Mission) -> Result<Vec<TryReport>, Failure> {
        let tries = self.profiles.tries(&self.profile, &mission.id, mission.rev);
        tries.map_err(|error| trainee::refused(&error, self.locale))
    }

    /// Stores a finished flight and tells what it brought. Where it cannot be stored, that is told, and what it would have
    /// brought; a whole record is made up for at the next start.
    pub fn store(&mut self, mission: &Mission, report: &mut Report, landing: Landing) -> Outcome {
        let run = RunEntry::of(mission, report, landing);
        let stored = self.profiles.store(&self.profile, &run);
        if let Err(error) = &stored {
            let text = text!("profile-not-stored", fault = error.text());
            tell!("sortie: {}", self.locale.text(&text));
        } else if let Err(error) = self.profiles.back_up() {
            tracing::warn!("the profiles are not copied: {error}");
        }
        report.tries = self.tries(mission).unwrap_or_default();
        let before = Standing::of(&self.history);
        let mut after = before.clone();
        after.enter(&Entry::Flight(run.flight.clone()));
        Outcome {
            reward: Reward::between(&before, &after, &self.course, &run.flight),
            profile: self.profile.name.clone(),
            is_stored: stored.is_ok(),
        }
    }
}
