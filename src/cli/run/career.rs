//! A run that is flown for a career: its admission, how it counts, and its reward.

use serde::Serialize;

use crate::campaign::{
    AttemptTrainee, CareerEntry, CareerStanding, LockReason, MissionCourse, PartState,
    PracticeReason, Reward, next_try,
};
use crate::cli::settings::CliSettings;
use crate::cli::{Failure, trainee};
use crate::mission::{Mission, Report};
use crate::scoring::TryReport;
use crate::store::{self, Landing, Profile, Profiles, RunEntry, Runs};
use crate::text;
use crate::text::{Locale, Text};
use crate::workshop::Part;

/// The trainee for whom a mission is flown.
pub(super) struct RunTrainee<'a> {
    profiles: Profiles,
    profile: Profile,
    course: MissionCourse,
    standing: CareerStanding,
    runs: Runs,
    locale: &'a Locale,
}

/// The result of a flight for a career, as a document.
#[derive(Debug, Serialize)]
pub(super) struct CareerDocument {
    profile: String,
    /// Whether the profile contains the flight.
    stored: bool,
    #[serde(flatten)]
    reward: Reward,
}

/// The result of a flight for a career.
pub(super) struct CareerOutcome {
    pub reward: Reward,
    profile: String,
    pub is_stored: bool,
}

impl CareerOutcome {
    pub fn document(self) -> CareerDocument {
        CareerDocument {
            profile: self.profile,
            stored: self.is_stored,
            reward: self.reward,
        }
    }

    /// The result as a section of the debrief.
    pub fn text(&self, locale: &Locale) -> String {
        let rewards = self.reward.lines();
        let lines: Vec<String> = rewards
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

impl<'a> RunTrainee<'a> {
    /// The trainee named on the command line or in the environment. A profile from a file does not count here, so that
    /// scripts do not change a career by accident.
    ///
    /// # Errors
    /// The profile does not exist, or profiles cannot be opened.
    pub fn named(settings: &CliSettings, locale: &'a Locale) -> Result<Option<Self>, Failure> {
        if !settings.sources.is_named("profile") {
            return Ok(None);
        }
        let profiles = trainee::open(settings, locale)?;
        let profile = trainee::choose(&profiles, None, settings, locale)?;
        let history = profiles
            .history(&profile)
            .map_err(|error| trainee::refused(&error, locale))?;
        let nowhere = || trainee::invalid(&text!("career-nowhere"), locale);
        let runs = settings.data.runs().ok_or_else(nowhere)?;
        Ok(Some(Self {
            profiles,
            profile,
            course: store::course(),
            standing: CareerStanding::of(&history),
            runs,
            locale,
        }))
    }

    /// The profile's name for the record.
    pub fn name(&self) -> &str {
        &self.profile.name
    }

    /// The folder where the flight is recorded.
    pub fn runs(&self) -> &Runs {
        &self.runs
    }

    /// The trainee's data that decide how a flight counts.
    pub fn of_attempt(&self) -> AttemptTrainee<'_> {
        AttemptTrainee {
            standing: &self.standing,
            course: &self.course,
            exams: self.profile.exam_key(),
        }
    }

    /// Refuses a flight of a locked mission or with parts that the trainee does not own. Any other flight is allowed,
    /// at least as practice.
    ///
    /// # Errors
    /// Why the flight is refused.
    pub fn admit(&self, mission: &Mission, reasons: &[PracticeReason]) -> Result<(), Failure> {
        for reason in reasons {
            match reason {
                PracticeReason::Locked(reasons) => {
                    let reasons = reasons.iter().map(LockReason::text).collect();
                    let why = Text::joined("; ", reasons);
                    let title = self.title(&mission.id);
                    let text = text!("mission-locked", mission = title, why = why);
                    return Err(trainee::invalid(&text, self.locale));
                }
                PracticeReason::MissingParts { design, parts } => {
                    return Err(self.refuse_parts(design, parts));
                }
                PracticeReason::ChosenSeed
                | PracticeReason::Script
                | PracticeReason::OwnMission
                | PracticeReason::AlteredMission
                | PracticeReason::OwnAirframes
                | PracticeReason::SlowMotion
                | PracticeReason::Crew
                | PracticeReason::UnconfirmedRecord => {}
            }
        }
        Ok(())
    }

    /// Prints why a flight counts as practice only.
    pub fn tell_practice(&self, reasons: &[PracticeReason]) {
        let text = PracticeReason::sentence(reasons);
        tell!("sortie: {}", self.locale.text(&text));
    }

    fn title(&self, mission: &str) -> Text {
        let offer = self.course.offer(mission);
        offer.map_or_else(
            || Text::verbatim(mission.to_owned()),
            |offer| offer.title.clone(),
        )
    }

    fn refuse_parts(&self, design: &str, parts: &[(&'static Part, PartState)]) -> Failure {
        let profile = self.name();
        let mut lines = vec![text!("parts-missing", design = design, profile = profile)];
        lines.extend(parts.iter().map(|(part, state)| match state {
            PartState::Locked(mission) => {
                let title = self.title(mission);
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
        trainee::invalid(&Text::joined("\n  ", lines), self.locale)
    }

    /// The number of the next attempt at the mission, from 1.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn attempt(&self, mission: &Mission) -> Result<u32, Failure> {
        Ok(next_try(&self.tries(mission)?))
    }

    fn tries(&self, mission: &Mission) -> Result<Vec<TryReport>, Failure> {
        let tries = self.profiles.tries(&self.profile, &mission.id, mission.rev);
        tries.map_err(|error| trainee::refused(&error, self.locale))
    }

    /// Stores a finished flight and returns its reward. If the flight cannot be stored, prints the
    /// reason; the next start recovers the flight from a complete record.
    pub fn store(
        &mut self,
        mission: &Mission,
        report: &mut Report,
        landing: Landing,
    ) -> CareerOutcome {
        let run = RunEntry::of(mission, report, landing);
        let stored = self.profiles.store(&self.profile, &run);
        if let Err(error) = &stored {
            let text = text!("profile-not-stored", fault = error.text());
            tell!("sortie: {}", self.locale.text(&text));
        } else if let Err(error) = self.profiles.back_up() {
            tracing::warn!("the profiles are not copied: {error}");
        }
        report.tries = self.tries(mission).unwrap_or_default();
        let mut after = self.standing.clone();
        after.enter(&CareerEntry::Flight(run.flight.clone()));
        CareerOutcome {
            reward: Reward::between(&self.standing, &after, &self.course, &run.flight),
            profile: self.profile.name.clone(),
            is_stored: stored.is_ok(),
        }
    }
}
