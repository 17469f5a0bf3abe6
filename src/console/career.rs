//! The trainee who sits at the console: who it is, what is flown for their career, and what they buy and design.

use std::path::Path;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::Console;
use crate::app::effect::Effect;
use crate::app::event::Event;
use crate::app::state::Career;
use crate::app::update;
use crate::campaign::{Aids, Course};
use crate::store::{Profile, ProfileError, Profiles, Rescue, utc};
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

const DAY: Duration = Duration::from_secs(24 * 60 * 60);

/// The profiles of the data folder, and the one that is in use.
#[derive(Debug)]
pub(super) struct Careers {
    profiles: Profiles,
    course: Course,
    current: Option<Profile>,
    aids: Aids,
}

impl Careers {
    /// Opens the profiles of a data folder, with nobody chosen. What was damaged is told.
    ///
    /// # Errors
    /// They cannot be had; the console works without them.
    pub fn open(data: &Path, course: Course) -> Result<(Self, Option<Rescue>), ProfileError> {
        let (profiles, rescue) = Profiles::open(data)?;
        let careers = Self {
            profiles,
            course,
            current: None,
            aids: Aids::default(),
        };
        Ok((careers, rescue))
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

    fn set_aids(&mut self, aids: Aids) -> Result<(), ProfileError> {
        self.aids = aids;
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

    fn drop(&self, name: &str) -> Result<(), ProfileError> {
        let profile = self.current.as_ref();
        profile.map_or(Ok(()), |profile| self.profiles.drop_design(profile, name))
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
            aids: self.aids,
            ..Career::new(&profile.name, history, self.course.clone())
        }))
    }
}

/// Days since 1970 in UTC.
pub(super) fn today() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let days = since.unwrap_or_default().as_secs() / DAY.as_secs();
    i64::try_from(days).unwrap_or(i64::MAX)
}

impl Console {
    /// Opens the profiles and goes on with the one that was asked for, or the only one there is.
    pub(super) fn open_careers(&mut self, course: Course) {
        let preferences = &self.options.preferences;
        let Some(data) = &preferences.data else {
            return;
        };
        let wanted = preferences.profile.clone();
        let mut careers = match Careers::open(data, course) {
            Ok((careers, rescue)) => {
                self.warnings.extend(rescue.map(|rescue| rescue.text()));
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

    /// Changes something about the trainee and shows what has become of it. Nothing that comes of it is an effect.
    pub(super) fn change_career(&mut self, effect: Effect) {
        let Some(careers) = &mut self.careers else {
            update(&mut self.state, Event::Failed(text!("career-nowhere")));
            return;
        };
        let outcome = match effect {
            Effect::ChooseProfile(name) => careers.choose(&name),
            Effect::CreateProfile(name) => careers.create(&name),
            Effect::LeaveProfile => {
                careers.current = None;
                Ok(())
            }
            Effect::SetAids(aids) => careers.set_aids(aids),
            Effect::BuyPart(part) => careers.buy(&part),
            Effect::KeepDesign(design) => careers.keep(&design),
            Effect::DropDesign(name) => careers.drop(&name),
            _ => return,
        };
        self.tell_failure(outcome.map_err(|error| error.text()));
        self.show_career();
    }

    /// Hands the career to the state as it is now.
    pub(super) fn show_career(&mut self) {
        let Some(careers) = &self.careers else {
            return;
        };
        let events = careers.names().and_then(|names| {
            let career = careers.career()?.map(Box::new);
            Ok([Event::Profiles(names), Event::Career(career)])
        });
        let events: Vec<Event> = events.map_or_else(
            |error: ProfileError| vec![Event::Failed(Text::from(error.text()))],
            Vec::from,
        );
        for event in events {
            update(&mut self.state, event);
        }
    }
}
