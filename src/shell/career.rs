//! The trainee at the console: profile, flights that count for the career, purchases and designs.

mod careers;

use std::time::SystemTime;

pub(super) use careers::Careers;
use careers::WaitingFlight;

use super::missions::{self, Tries};
use super::session::{Finished, SessionPlan};
use super::{Console, Opening};
use crate::app::effect::CareerEffect;
use crate::app::event::{CareerEvent, Event};
use crate::campaign::MissionCourse;
use crate::scoring::TryReport;
use crate::store::{self, Landing, RunEntry, day_of};
use crate::text;
use crate::text::Text;

/// The current day, as days since 1970 (UTC).
pub(super) fn today() -> i64 {
    day_of(SystemTime::now())
}

impl Console {
    /// Opens the profiles and chooses the requested one, or the only one.
    pub(super) fn open_careers(&mut self, course: MissionCourse, changes: bool) {
        let preferences = &self.options.preferences;
        let Some(data) = &preferences.data else {
            return;
        };
        // A replay creates no data folder; the first change of a career does.
        if matches!(self.options.opening, Opening::Replay(_)) && !data.exists() && !changes {
            return;
        }
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

    /// Changes the profile's data, and shows the result.
    pub(super) fn change_career(&mut self, change: CareerEffect) {
        if self.careers.is_none() {
            self.open_careers(store::course(), true);
        }
        let Some(careers) = &mut self.careers else {
            return self.post(Event::Failed(text!("career-nowhere")));
        };
        let outcome = match change {
            CareerEffect::Choose(name) => careers.choose(&name),
            CareerEffect::Create(name) => careers.create(&name),
            CareerEffect::Leave => {
                careers.leave();
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

    /// The name of the profile whose flights are stored now; `None` without a profile.
    pub(super) fn trainee(&self) -> Option<&str> {
        self.careers.as_ref()?.name()
    }

    /// The trainee's attempts at a planned mission, oldest first.
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

    /// Stores a finished flight in its career, and shows the rewards.
    pub(super) fn settle(&mut self, finished: Finished) {
        let Some(whose) = finished.occasion.profile else {
            return;
        };
        let Some(careers) = &mut self.careers else {
            return;
        };
        let landing = Landing {
            id: finished.run_id,
            is_recorded: finished.is_recorded,
            when: SystemTime::now(),
            stake: finished.occasion.stake,
        };
        let run = RunEntry::of(&finished.mission, &finished.report, landing);
        let cut = finished.cut;
        careers.put(WaitingFlight { whose, run, cut });
        self.store_flights();
    }

    /// Stores the flights that are waiting. A failure is reported, and the flights are tried again
    /// with the next one.
    pub(super) fn store_flights(&mut self) {
        let waits = |careers: &&mut Careers| careers.has_waiting();
        let Some(careers) = self.careers.as_mut().filter(waits) else {
            return;
        };
        let (rewards, outcome) = careers.enter();
        let at_risk = careers.at_risk();
        if !rewards.is_empty()
            && let Err(error) = careers.back_up()
        {
            tracing::warn!(%error, "the profiles were not copied");
        }
        self.post(CareerEvent::AtRisk(at_risk));
        self.show_career();
        for reward in rewards {
            self.post(CareerEvent::Rewarded(Box::new(reward)));
        }
        let outcome = outcome.map_err(|error| text!("career-waits", fault = error.text()));
        self.tell_failure(outcome);
    }

    /// Checks that all flights are stored when the program ends.
    ///
    /// # Errors
    /// Flights could not be stored; the text is in the reader's language.
    pub(super) fn require_stored(&self) -> anyhow::Result<()> {
        let Some(careers) = self.careers.as_ref().filter(|it| it.has_waiting()) else {
            return Ok(());
        };
        let (lost, deferred) = (careers.at_risk(), careers.deferred());
        let lost = (lost > 0).then(|| text!("career-lost", count = lost));
        let deferred = (deferred > 0).then(|| text!("career-deferred", count = deferred));
        let text = Text::joined("; ", lost.into_iter().chain(deferred).collect());
        Err(anyhow::anyhow!(self.sight.look.text(&text)))
    }

    /// Shows changes by other consoles and commands.
    pub(super) fn look_for_changes(&mut self) {
        let has_changed = |careers: &mut Careers| careers.has_changed_elsewhere();
        if self.careers.as_mut().is_some_and(has_changed) {
            self.show_career();
        }
    }

    /// Passes the current career to the state.
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
                let tries = missions::current(all, self.app.state().training().missions());
                self.post(CareerEvent::Profiles(names));
                self.post(CareerEvent::Career(career));
                self.post(CareerEvent::Tries(tries));
            }
            Err(error) => self.post(Event::Failed(error.text())),
        }
        if let Some(gone) = gone {
            self.post(Event::Failed(gone));
        }
        self.show_reviews();
    }

    fn tries_of_guests(&self) -> Tries {
        let runs = self.options.preferences.runs.as_ref();
        runs.map_or_else(Tries::new, |runs| runs.all_tries(None))
    }
}
