//! The careers of the data folder: the trainee, flights that are to be stored, purchases and designs.

use std::collections::VecDeque;
use std::path::Path;
use std::time::SystemTime;

use super::today;
use crate::app::state::Career;
use crate::campaign::{CareerEntry, CareerStanding, MissionCourse, Reward, next_try};
use crate::scoring::TryReport;
use crate::shell::missions::Tries;
use crate::store::{
    self, Profile, ProfileError, ProfileSettings, Profiles, RunEntry, RunFile, utc,
};
use crate::text::{Language, Text};
use crate::workshop::Design;

/// The profiles of the data folder, and the one in use.
#[derive(Debug)]
pub(in crate::shell) struct Careers {
    profiles: Profiles,
    course: MissionCourse,
    current: Option<Profile>,
    /// Flights that are not stored yet, oldest first: the disk may be full for a while.
    waiting: VecDeque<WaitingFlight>,
    /// The change counter at the last check.
    seen: Option<i64>,
}

/// A finished flight that is to be stored in a career.
#[derive(Debug)]
pub(in crate::shell) struct WaitingFlight {
    /// The name of the profile.
    pub whose: String,
    pub run: RunEntry,
    /// The flight's record, if it was cut off before the flight had ended. While it is held, no other program takes
    /// the flight for one that was left.
    pub cut: Option<RunFile>,
}

impl Careers {
    /// Opens the profiles of a data folder, with none chosen. Returns warnings about repaired files, recovered
    /// flights, and profiles that can only be read.
    ///
    /// # Errors
    /// The profiles are not available; the console works without them.
    pub fn open(data: &Path, course: MissionCourse) -> Result<(Self, Vec<Text>), ProfileError> {
        let (profiles, mut told) = store::open_profiles(data)?;
        let read_only = profiles.require_writable().err();
        told.extend(read_only.map(|error| error.text()));
        let careers = Self {
            profiles,
            course,
            current: None,
            waiting: VecDeque::new(),
            seen: None,
        };
        Ok((careers, told))
    }

    /// The trainee's name, if there is one.
    pub fn name(&self) -> Option<&str> {
        self.current.as_ref().map(|profile| profile.name.as_str())
    }

    /// The names of all profiles, in order.
    pub fn names(&self) -> Result<Vec<String>, ProfileError> {
        let all = self.profiles.list()?;
        Ok(all.into_iter().map(|profile| profile.name).collect())
    }

    /// Switches to the profile with this name.
    pub fn choose(&mut self, name: &str) -> Result<(), ProfileError> {
        self.current = Some(self.profiles.find(name)?);
        Ok(())
    }

    pub fn create(&mut self, name: &str) -> Result<(), ProfileError> {
        self.current = Some(self.profiles.create(name, &utc(SystemTime::now()))?);
        Ok(())
    }

    /// Continues without a profile.
    pub fn leave(&mut self) {
        self.current = None;
    }

    pub fn set(&mut self, change: impl FnOnce(&mut ProfileSettings)) -> Result<(), ProfileError> {
        let Some(profile) = &mut self.current else {
            return Ok(());
        };
        let mut settings = profile.settings.clone();
        change(&mut settings);
        self.profiles.set_settings(profile, &settings)?;
        profile.settings = settings;
        Ok(())
    }

    pub fn buy(&mut self, part: &str) -> Result<(), ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(());
        };
        let when = utc(SystemTime::now());
        self.profiles.buy(profile, part, &self.course, &when)?;
        Ok(())
    }

    pub fn keep(&self, design: &Design) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| self.profiles.keep_design(profile, design))
    }

    pub fn rename(&self, from: &str, design: &Design) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| {
            self.profiles.rename_design(profile, from, design)
        })
    }

    pub fn drop(&self, name: &str) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| self.profiles.drop_design(profile, name))
    }

    /// Queues a flight for a career.
    pub fn put(&mut self, flight: WaitingFlight) {
        self.waiting.push_back(flight);
    }

    /// Whether any flights are waiting to be stored.
    pub fn has_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// The number of waiting flights without a complete record: they are lost if the program ends.
    pub fn at_risk(&self) -> usize {
        let waiting = self.waiting.iter();
        waiting.filter(|it| it.run.recording.is_none()).count()
    }

    /// The number of waiting flights with a complete record: the next start stores them.
    pub fn deferred(&self) -> usize {
        self.waiting.len() - self.at_risk()
    }

    /// Backs up the profiles.
    pub fn back_up(&self) -> Result<(), ProfileError> {
        self.profiles.back_up().map(drop)
    }

    /// Stores the waiting flights in their careers, and returns the rewards. A flight of a deleted
    /// profile is dropped; other flights that cannot be stored now keep waiting.
    ///
    /// The cut record of a flight that cannot be stored is removed: it would count as that of a flight that was left,
    /// and its space may be enough to store the flight.
    pub fn enter(&mut self) -> (Vec<Reward>, Result<(), ProfileError>) {
        let mut rewards = Vec::new();
        while let Some(WaitingFlight { whose, run, cut }) = self.waiting.front_mut() {
            match enter(&mut self.profiles, &self.course, whose, run) {
                Ok(reward) => rewards.extend(reward),
                // A profile deleted in the meantime no longer has a career.
                Err(error @ ProfileError::Unknown { .. }) => {
                    self.waiting.pop_front();
                    return (rewards, Err(error));
                }
                Err(error) => match cut.take() {
                    Some(cut) => {
                        cut.discard();
                        continue;
                    }
                    None => return (rewards, Err(error)),
                },
            }
            self.waiting.pop_front();
        }
        (rewards, Ok(()))
    }

    /// The trainee's attempts at a revision of a mission, oldest first; `None` without a trainee,
    /// or if they cannot be read.
    pub fn tries_at(&self, mission: &str, revision: u32) -> Option<Vec<TryReport>> {
        let tries = self
            .profiles
            .tries(self.current.as_ref()?, mission, revision);
        tries.ok()
    }

    /// All attempts of the trainee, by mission; `None` without a trainee.
    pub fn tries(&self) -> Result<Option<Tries>, ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(None);
        };
        let mut tries = Tries::new();
        for run in self.profiles.runs(profile)? {
            let of_mission = tries.entry(run.flight.mission.clone()).or_default();
            let alike = of_mission.iter().filter(|one| one.revision == run.revision);
            let attempt = next_try(alike);
            of_mission.push(run.as_try(attempt));
        }
        Ok(Some(tries))
    }

    /// Continues without the current profile if it was deleted elsewhere; returns a notice in that
    /// case.
    pub fn forget_deleted(&mut self) -> Option<Text> {
        let found = self.profiles.find(&self.current.as_ref()?.name);
        let Err(error @ ProfileError::Unknown { .. }) = found else {
            return None;
        };
        self.current = None;
        Some(error.text())
    }

    /// Whether another program has written since the last call.
    pub fn has_changed_elsewhere(&mut self) -> bool {
        let now = self.profiles.changes_elsewhere().ok();
        std::mem::replace(&mut self.seen, now) != now
    }

    /// The trainee's career; `None` without a trainee.
    pub fn career(&self) -> Result<Option<Career>, ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(None);
        };
        let history = self.profiles.history(profile)?;
        Ok(Some(Career {
            designs: self.profiles.designs(profile)?,
            day: today(),
            exams: profile.exam_key(),
            aids: profile.settings.aids,
            language: profile.settings.lang.as_deref().and_then(Language::of),
            ..Career::new(&profile.name, history, self.course.clone())
        }))
    }
}

/// Stores a flight in a career. A flight that is already stored earns nothing more.
fn enter(
    profiles: &mut Profiles,
    course: &MissionCourse,
    whose: &str,
    run: &RunEntry,
) -> Result<Option<Reward>, ProfileError> {
    let profile = profiles.find(whose)?;
    let before = CareerStanding::of(&profiles.history(&profile)?);
    if !profiles.store(&profile, run)? {
        return Ok(None);
    }
    let mut after = before.clone();
    after.enter(&CareerEntry::Flight(run.flight.clone()));
    Ok(Some(Reward::between(&before, &after, course, &run.flight)))
}

#[cfg(test)]
mod cut_tests;

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rusqlite::Connection;

    use super::*;
    use crate::campaign::Aids;
    use crate::exercise::Exercise;
    use crate::language::{Context, Script};
    use crate::mission::{Mission, Stake};
    use crate::store::Landing;

    fn flown() -> RunEntry {
        let mission = include_str!("../../../missions/00-first-flight.toml");
        let mission = Arc::new(Mission::parse(mission).expect("no faults"));
        let script = Script::parse("", &Context::default()).expect("nothing to do");
        let report = Exercise::new(Arc::clone(&mission), 1, script, Vec::new()).report();
        let landing = Landing {
            is_recorded: true,
            id: "a".to_owned(),
            when: SystemTime::UNIX_EPOCH,
            stake: Stake::Graded,
        };
        RunEntry::of(&mission, &report, landing)
    }

    #[test]
    fn a_flight_that_cannot_be_stored_waits_until_it_can() {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut careers, _) =
            Careers::open(folder.path(), MissionCourse::default()).expect("ours");
        careers.create("Anna").expect("a name");
        let other = Connection::open(careers.profiles.path()).expect("the same file");
        let rename = |from: &str, to: &str| {
            let line = format!("ALTER TABLE {from} RENAME TO {to}");
            other.execute_batch(&line).expect("a table");
        };
        rename("runs", "away");
        careers.put(WaitingFlight {
            whose: "Anna".to_owned(),
            run: flown(),
            cut: None,
        });
        let (rewards, outcome) = careers.enter();
        assert!(rewards.is_empty() && outcome.is_err());
        rename("away", "runs");
        let (rewards, outcome) = careers.enter();
        assert_eq!((rewards.len(), outcome.is_ok()), (1, true));
        assert!(careers.waiting.is_empty());
        let career = careers.career().expect("it can be read");
        assert_eq!(career.map(|career| career.history.len()), Some(1));
    }

    #[test]
    fn what_a_trainee_chooses_is_there_the_next_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let open = || {
            Careers::open(folder.path(), MissionCourse::default())
                .expect("ours")
                .0
        };
        let mut careers = open();
        careers.create("Anna").expect("a name");
        let starter = include_str!("../../../designs/starter.toml");
        let starter = Design::from_toml(starter).expect("it is good");
        careers.keep(&starter).expect("a design");
        let mine = starter.named("Mine").expect("a name");
        careers.rename(&starter.name, &mine).expect("it is there");
        let chosen = careers.set(|it| it.lang = Some("uk".to_owned()));
        chosen
            .and_then(|()| careers.set(|it| it.aids = Aids::None))
            .expect("settings");
        let mut careers = open();
        careers.choose("anna").expect("she is there");
        let career = careers.career().expect("it can be read").expect("hers");
        assert_eq!(career.language, Some(Language::Ukrainian));
        assert_eq!((career.aids, career.designs), (Aids::None, vec![mine]));
    }
}
