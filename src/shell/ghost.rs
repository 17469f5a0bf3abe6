//! Other flights of a mission, read or flown in a thread.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;

use super::Console;
use crate::app::event::{Event, SessionEvent};
use crate::app::state::Ghost;
use crate::comparison::{ComparedFlight, FlightBookmark};
use crate::exercise::{fly_compared, read_script};
use crate::language::GhostSource;
use crate::mission::Mission;
use crate::mission::record::Stored;
use crate::moment::Moment;
use crate::record::{Journal, JournalFit, MissionClock};
use crate::replay::{Replay, TlogSpan};
use crate::review::Review;
use crate::store::{self, RecordFiles, Records, read_run};
use crate::text;
use crate::text::Text;

/// The thread that fetches a ghost.
pub(super) type GhostWork = JoinHandle<Result<Ghost, Text>>;

/// The mission in flight or in replay.
#[derive(Debug)]
pub(super) struct ShownMission {
    pub mission: Arc<Mission>,
    pub seed: u64,
    /// The id of its run, if recorded.
    pub run: Option<String>,
}

/// The source of another flight.
enum GhostPlan {
    Record(PathBuf),
    Reference(Box<ShownMission>),
}

impl Console {
    /// Starts to fetch another flight of the mission; [`take_ghost`](Self::take_ghost) shows it.
    ///
    /// # Errors
    /// No such flight exists.
    pub(super) fn fetch_ghost(&mut self, source: GhostSource) -> Result<(), Text> {
        let shown = self
            .shown_mission()
            .ok_or_else(|| text!("ghost-no-mission"))?;
        let film = self.replaying.as_ref().map(Replay::film);
        let own = film.and_then(|it| it.run().cloned());
        let own_bookmarks =
            film.map_or_else(Vec::new, |film| bookmarks(film.journal(), film.review()));
        let id = shown.mission.id.clone();
        let plan = self.ghost_plan(source, shown)?;
        let work = move || {
            let other = plan.flight()?;
            if other.report.mission != id {
                let other = other.report.mission;
                return Err(text!("ghost-other-mission", other = other, mission = id));
            }
            let compared = own
                .map(|own| ComparedFlight::of_record(&own, text!("compare-own")))
                .transpose()?
                .map(|own| Arc::new(own.with_bookmarks(own_bookmarks)));
            Ok(Ghost::new(Arc::new(other), compared))
        };
        let thread = std::thread::Builder::new().name("ghost".to_owned());
        if self.ghost.as_ref().is_some_and(|it| !it.is_finished()) {
            return Err(text!("ghost-busy"));
        }
        let work = thread.spawn(work);
        self.ghost = Some(work.map_err(|error| Text::verbatim(error.to_string()))?);
        Ok(())
    }

    fn ghost_plan(&self, source: GhostSource, shown: ShownMission) -> Result<GhostPlan, Text> {
        Ok(match source {
            GhostSource::File(path) => {
                let records = self.options.preferences.records.as_ref();
                let run = Records::find(records, &path)?.run;
                GhostPlan::Record(run.ok_or_else(|| text!("ghost-no-run", file = path))?)
            }
            GhostSource::Best => GhostPlan::Record(self.best_run(&shown)?),
            GhostSource::Reference => GhostPlan::Reference(Box::new(shown)),
        })
    }

    /// Shows the other flight once it is ready, or the reason if it could not be fetched.
    pub(super) fn take_ghost(&mut self) {
        let Some(work) = self.ghost.take_if(|it| it.is_finished()) else {
            return;
        };
        let event = match work.join() {
            Ok(Ok(ghost)) => SessionEvent::Ghost(Box::new(ghost)).into(),
            Ok(Err(fault)) => Event::Failed(fault),
            Err(_) => Event::Failed(text!("ghost-broken")),
        };
        self.post(event);
    }

    fn shown_mission(&self) -> Option<ShownMission> {
        if let Some(running) = &self.running {
            return running.shown_mission();
        }
        let film = self.replaying.as_ref()?.film();
        let run = film.run()?;
        Some(ShownMission {
            mission: Arc::new(run.head.flown().ok()?),
            seed: run.head.seed,
            run: Some(film.name()),
        })
    }

    /// The record of the best other flight of the mission.
    fn best_run(&self, shown: &ShownMission) -> Result<PathBuf, Text> {
        let runs = self.options.preferences.runs.as_ref();
        let mission = &shown.mission;
        let best = runs.and_then(|runs| {
            runs.best(
                self.trainee(),
                &mission.id,
                mission.rev,
                shown.run.as_deref(),
            )
        });
        best.ok_or_else(|| text!("ghost-no-best"))
    }
}

fn bookmarks(journal: Option<&Journal>, review: &Review) -> Vec<FlightBookmark> {
    journal.map_or_else(Vec::new, |journal| {
        let recorded: Vec<Moment> = journal.bookmarks().collect();
        FlightBookmark::of_moments(&review.bookmarks(&recorded), &MissionClock::of(journal))
    })
}

/// The bookmarks of the record that a run belongs to; none if it has no readable journal of the same flight.
fn bookmarks_beside(path: &Path, run: &Stored) -> Vec<FlightBookmark> {
    let files = RecordFiles::beside(path);
    let first_unix_us = TlogSpan::of(&files).map(|it| it.first_unix_us);
    let fits = |journal: &Journal| {
        let fit = run.journal_fit(&journal.head, first_unix_us);
        fit == JournalFit::Fits
    };
    let journal = files.read_journal().ok().flatten().filter(fits);
    let review = files.read_review().ok().flatten().unwrap_or_default();
    bookmarks(journal.as_ref(), &review)
}

/// The date and time of a record, to the minute: `2026-11-20T14:03:22Z` becomes `2026-11-20 14:03`.
fn minute(when: &str) -> String {
    let time = when.rsplit_once(':').map_or(when, |(time, _)| time);
    time.replace('T', " ")
}

impl GhostPlan {
    fn flight(self) -> Result<ComparedFlight, Text> {
        match self {
            Self::Record(path) => {
                let text = read_run(&path).map_err(|error| store::unread(&path, &error))?;
                let stored = Stored::read(&text)?;
                let when = minute(&stored.head.when);
                let name = match stored.head.profile.clone() {
                    Some(name) => text!("ghost-name", name = name, when = when),
                    None => when.into(),
                };
                let flight = ComparedFlight::of_record(&stored, name)?;
                Ok(flight.with_bookmarks(bookmarks_beside(&path, &stored)))
            }
            Self::Reference(shown) => {
                let id = &shown.mission.id;
                let pilot = store::pilot(id).map_err(|_| text!("ghost-no-pilot", mission = id))?;
                let script = read_script(&pilot.text, &shown.mission)
                    .map_err(|_| text!("ghost-no-pilot", mission = id))?;
                let name = text!("compare-reference");
                let ShownMission { mission, seed, .. } = *shown;
                Ok(fly_compared(mission, seed, script, name))
            }
        }
    }
}
