//! The trainee at the console: profile, flights that count for the career, purchases and designs.

use std::collections::VecDeque;
use std::path::Path;
use std::time::SystemTime;

use super::Console;
use super::missions::{self, Tries};
use super::session::{Finished, SessionPlan};
use crate::app::effect::CareerEffect;
use crate::app::event::{CareerEvent, Event};
use crate::app::state::Career;
use crate::campaign::{CareerEntry, CareerStanding, MissionCourse, Reward};
use crate::scoring::TryReport;
use crate::store::{
    self, Landing, Profile, ProfileError, ProfileSettings, Profiles, RunEntry, day_of, utc,
};
use crate::text;
use crate::text::{Language, Text};
use crate::workshop::Design;

/// The profiles of the data folder, and the one that is in use.
#[derive(Debug)]
pub(super) struct Careers {
    profiles: Profiles,
    course: MissionCourse,
    current: Option<Profile>,
    /// Flights that are not stored yet, oldest first, and whose they are: the disk may be full for a while.
    waiting: VecDeque<(String, RunEntry)>,
    /// How often others had written at the last look.
    seen: Option<i64>,
}

impl Careers {
    /// Opens the profiles of a data folder, with none chosen. Returns warnings about repaired files and recovered flights.
    ///
    /// # Errors
    /// They cannot be had; the console works without them.
    pub fn open(data: &Path, course: MissionCourse) -> Result<(Self, Vec<Text>), ProfileError> {
        let (profiles, told) = store::open_profiles(data)?;
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

    /// Everybody, by name.
    pub fn names(&self) -> Result<Vec<String>, ProfileError> {
        let all = self.profiles.list()?;
        Ok(all.into_iter().map(|profile| profile.name).collect())
    }

    /// Goes on with the profile of this name.
    pub fn choose(&mut self, name: &str) -> Result<(), ProfileError> {
        self.current = Some(self.profiles.find(name)?);
        Ok(())
    }

    fn create(&mut self, name: &str) -> Result<(), ProfileError> {
        self.current = Some(self.profiles.create(name, &utc(SystemTime::now()))?);
        Ok(())
    }

    /// Remembers something that was chosen.
    fn set(&mut self, change: impl FnOnce(&mut ProfileSettings)) -> Result<(), ProfileError> {
        let Some(profile) = &mut self.current else {
            return Ok(());
        };
        let mut settings = profile.settings.clone();
        change(&mut settings);
        self.profiles.set_settings(profile, &settings)?;
        profile.settings = settings;
        Ok(())
    }

    fn buy(&mut self, part: &str) -> Result<(), ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(());
        };
        let when = utc(SystemTime::now());
        self.profiles.buy(profile, part, &self.course, &when)?;
        Ok(())
    }

    fn keep(&self, design: &Design) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| self.profiles.keep_design(profile, design))
    }

    fn rename(&self, from: &str, design: &Design) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| {
            self.profiles.rename_design(profile, from, design)
        })
    }

    fn drop(&self, name: &str) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| self.profiles.drop_design(profile, name))
    }

    /// Stores the flights that wait for it in the careers that they were flown for; tells what they have brought there.
    /// Those that cannot be stored now go on waiting.
    fn enter(&mut self) -> (Vec<Reward>, Result<(), ProfileError>) {
        let mut rewards = Vec::new();
        while let Some((whose, run)) = self.waiting.front() {
            match enter(&mut self.profiles, &self.course, whose, run) {
                Ok(reward) => rewards.extend(reward),
                // Who was deleted meanwhile has no career any more.
                Err(error @ ProfileError::Unknown { .. }) => {
                    self.waiting.pop_front();
                    return (rewards, Err(error));
                }
                Err(error) => return (rewards, Err(error)),
            }
            self.waiting.pop_front();
        }
        (rewards, Ok(()))
    }

    /// The trainee's tries at a revision of a mission, oldest first; `None` without a trainee.
    fn tries_at(&self, mission: &str, revision: u32) -> Option<Vec<TryReport>> {
        let tries = self
            .profiles
            .tries(self.current.as_ref()?, mission, revision);
        tries.ok()
    }

    /// All of them, by mission.
    fn tries(&self) -> Result<Option<Tries>, ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(None);
        };
        let mut tries = Tries::new();
        for run in self.profiles.runs(profile)? {
            let of_mission = tries.entry(run.flight.mission.clone()).or_default();
            let alike = of_mission.iter().filter(|one| one.revision == run.revision);
            let attempt = u32::try_from(alike.count() + 1).unwrap_or(u32::MAX);
            of_mission.push(run.as_try(attempt));
        }
        Ok(Some(tries))
    }

    /// Goes on without a trainee whose profile somebody has deleted; says so.
    fn forget_deleted(&mut self) -> Option<Text> {
        let found = self.profiles.find(&self.current.as_ref()?.name);
        let Err(error @ ProfileError::Unknown { .. }) = found else {
            return None;
        };
        self.current = None;
        Some(error.text())
    }

    /// Whether somebody else has written since the last call.
    fn has_changed_elsewhere(&mut self) -> bool {
        let now = self.profiles.changes_elsewhere().ok();
        std::mem::replace(&mut self.seen, now) != now
    }

    /// How far the trainee has come; `None` without one.
    pub fn career(&self) -> Result<Option<Career>, ProfileError> {
        let Some(profile) = &self.current else {
            return Ok(None);
        };
        let history = self.profiles.history(profile)?;
        Ok(Some(Career {
            designs: self.profiles.designs(profile)?,
            day: today(),
            aids: profile.settings.aids,
            language: profile.settings.lang.as_deref().and_then(Language::of),
            ..Career::new(&profile.name, history, self.course.clone())
        }))
    }
}

/// Days since 1970 in UTC.
pub(super) fn today() -> i64 {
    day_of(SystemTime::now())
}

/// Stores a flight in somebody's career. One that is stored already has brought nothing more.
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

impl Console {
    /// Opens the profiles and chooses the requested one, or the only one.
    pub(super) fn open_careers(&mut self, course: MissionCourse) {
        let preferences = &self.options.preferences;
        let Some(data) = &preferences.data else {
            return;
        };
        let wanted = preferences.profile.clone();
        let mut careers = match Careers::open(data, course) {
            Ok((careers, told)) => {
                self.warnings.extend(told);
                careers
            }
            Err(error) => return self.warnings.push(error.text()),
        };
        let names = careers.names().unwrap_or_default();
        let only = names.first().filter(|_| names.len() == 1);
        if let Some(name) = wanted.as_ref().or(only)
            && let Err(error) = careers.choose(name)
        {
            self.warnings.push(error.text());
        }
        self.careers = Some(careers);
        self.show_career();
    }

    /// Changes something about the trainee, and shows what has become of it.
    pub(super) fn change_career(&mut self, change: CareerEffect) {
        let Some(careers) = &mut self.careers else {
            return self.post(Event::Failed(text!("career-nowhere")));
        };
        let outcome = match change {
            CareerEffect::Choose(name) => careers.choose(&name),
            CareerEffect::Create(name) => careers.create(&name),
            CareerEffect::Leave => {
                careers.current = None;
                Ok(())
            }
            CareerEffect::SetAids(aids) => careers.set(|it| it.aids = aids),
            CareerEffect::SetLanguage(language) => {
                careers.set(|it| it.lang = Some(language.code().to_owned()))
            }
            CareerEffect::BuyPart(part) => careers.buy(&part),
            CareerEffect::KeepDesign(design) => careers.keep(&design),
            CareerEffect::RenameDesign { from, design } => careers.rename(&from, &design),
            CareerEffect::DropDesign(name) => careers.drop(&name),
        };
        self.tell_failure(outcome.map_err(|error| error.text()));
        self.show_career();
    }

    /// Whose flights are kept at the moment, by name.
    pub(super) fn trainee(&self) -> Option<&str> {
        self.careers.as_ref()?.name()
    }

    /// The trainee's tries at what is to be flown, oldest first.
    pub(super) fn tries_before(&self, plan: &SessionPlan) -> Vec<TryReport> {
        let SessionPlan::Mission(mission) = plan else {
            return Vec::new();
        };
        let (id, revision) = (mission.id.as_str(), mission.rev);
        let careers = self.careers.as_ref();
        if let Some(tries) = careers.and_then(|it| it.tries_at(id, revision)) {
            return tries;
        }
        let runs = self.options.preferences.runs.as_ref();
        runs.map_or_else(Vec::new, |runs| runs.tries_at(None, id, revision))
    }

    /// Stores what has just been flown for somebody's career, and shows what it has brought.
    pub(super) fn settle(&mut self, finished: &Finished) {
        let Some(whose) = finished.occasion.profile.as_deref() else {
            return;
        };
        let Some(careers) = &mut self.careers else {
            return;
        };
        let landing = Landing {
            id: finished.run_id.clone(),
            is_recorded: finished.is_recorded,
            when: SystemTime::now(),
            stake: finished.occasion.stake,
        };
        let run = RunEntry::of(&finished.mission, &finished.report, landing);
        careers.waiting.push_back((whose.to_owned(), run));
        self.store_flights();
    }

    /// Stores the flights that are waiting. A flight that cannot be stored is reported, and tried again with the next one.
    pub(super) fn store_flights(&mut self) {
        let waits = |careers: &&mut Careers| !careers.waiting.is_empty();
        let Some(careers) = self.careers.as_mut().filter(waits) else {
            return;
        };
        let (rewards, outcome) = careers.enter();
        if !rewards.is_empty()
            && let Err(error) = careers.profiles.back_up()
        {
            tracing::warn!(%error, "the profiles were not copied");
        }
        self.show_career();
        for reward in rewards {
            self.post(CareerEvent::Rewarded(Box::new(reward)));
        }
        let outcome = outcome.map_err(|error| text!("career-waits", fault = error.text()));
        self.tell_failure(outcome);
    }

    /// Shows what other consoles and commands have changed meanwhile.
    pub(super) fn look_for_changes(&mut self) {
        let has_changed = |careers: &mut Careers| careers.has_changed_elsewhere();
        if self.careers.as_mut().is_some_and(has_changed) {
            self.show_career();
        }
    }

    /// Hands the career to the state as it is now.
    pub(super) fn show_career(&mut self) {
        let Some(careers) = &mut self.careers else {
            return;
        };
        let is_lang_given = self.options.preferences.is_lang_given;
        let gone = careers.forget_deleted();
        let shown = careers.names().and_then(|names| {
            let mut career = careers.career()?.map(Box::new);
            if let Some(career) = career.as_mut().filter(|_| is_lang_given) {
                career.language = None;
            }
            Ok((names, career, careers.tries()?))
        });
        match shown {
            Ok((names, career, own)) => {
                let all = own.unwrap_or_else(|| self.tries_of_guests());
                let tries = missions::current(all, self.app.state().missions());
                self.post(CareerEvent::Profiles(names));
                self.post(CareerEvent::Career(career));
                self.post(CareerEvent::Tries(tries));
            }
            Err(error) => self.post(Event::Failed(error.text())),
        }
        if let Some(gone) = gone {
            self.post(Event::Failed(gone));
        }
    }

    /// The tries that belong to nobody's career.
    fn tries_of_guests(&self) -> Tries {
        let runs = self.options.preferences.runs.as_ref();
        runs.map_or_else(Tries::new, |runs| runs.all_tries(None))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rusqlite::Connection;

    use super::*;
    use crate::campaign::Aids;
    use crate::exercise::Exercise;
    use crate::language::{Context, Script};
    use crate::mission::{Mission, Stake};

    fn flown() -> RunEntry {
        let mission = include_str!("../../missions/00-first-flight.toml");
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
        careers.waiting.push_back(("Anna".to_owned(), flown()));
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
        let starter = include_str!("../../designs/starter.toml");
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
