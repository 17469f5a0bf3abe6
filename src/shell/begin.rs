//! Begins and ends sessions.

use std::sync::Arc;
use std::time::Duration;

use rand::TryRng as _;
use rand::rngs::SysRng;

use super::Console;
use super::career::today;
use super::crew::CrewOptions;
use super::session::{RecordPoint, RunningSession, SessionBackend, SessionPlan};
use crate::app::effect::Launch;
use crate::app::event::{ClassEvent, Event, SessionEvent, Started};
use crate::campaign::{
    Attempt, AttemptMeans, AttemptRefusal, AttemptTerms, AttemptTrainee, PracticeReason, Stake,
};
use crate::class::Refusal;
use crate::link::{Address, AddressError};
use crate::mission::Mission;
use crate::mission::record::Occasion;
use crate::replay::FRAME;
use crate::store;
use crate::text;
use crate::text::Text;

/// How long the program waits for its vehicles' processes when it ends.
const LAST_PROCESS_PATIENCE: Duration = Duration::from_secs(2);
/// How long the vehicles of a session may take to begin to release channels.
const RELEASE_PATIENCE: Duration = Duration::from_secs(2);
/// The time in which the links of a session send that it releases channels, and repeat it.
const RELEASE_TIME: Duration = Duration::from_millis(250);

/// Where the seed of a mission may come from.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SeedSources {
    /// The seed that the user has chosen.
    pub chosen: Option<u64>,
    /// The seed that the desk of a class has drawn for a try of an exam.
    pub drawn: Option<u64>,
}

impl Console {
    /// Starts a mission that the trainee has chosen.
    pub(super) async fn start_mission(&mut self, launch: &Launch) -> Result<(), Text> {
        let stored = store::mission(&launch.mission).map_err(|error| Text::from(&error))?;
        let equipped = stored
            .with_fleet(launch.fleet.clone())
            .map_err(|reasons| Text::joined("; ", reasons))?;
        let mission = Arc::new(equipped.flown_for(launch.stake));
        let seeds = SeedSources {
            chosen: launch.seed,
            drawn: launch.drawn,
        };
        if seeds.drawn.is_none() {
            return self.launch(mission, launch.stake, seeds).await;
        }
        if !self.can_prove_flights() {
            self.post(ClassEvent::TryRefused(Refusal::NotRecorded));
            return Err(text!("class-exam-unrecorded"));
        }
        let begun = self.launch(mission, launch.stake, seeds).await;
        if begun.is_err() {
            // Without this, the trainee's next flight would count as the try.
            self.post(ClassEvent::TryRefused(Refusal::Practice));
        }
        begun
    }

    /// Whether records of flights are kept, with the inputs from which they can be flown again.
    fn can_prove_flights(&self) -> bool {
        let preferences = &self.options.preferences;
        let is_recorded = preferences.runs.is_some() && preferences.records.is_some();
        is_recorded && self.options.backend.ardupilot.is_none()
    }

    /// Starts a mission under the rules of its stake. Shows a notice if it can only be flown for practice; a try of an
    /// exam is not begun then, so that its seed does not become known.
    pub(super) async fn launch(
        &mut self,
        mission: Arc<Mission>,
        wanted: Stake,
        seeds: SeedSources,
    ) -> Result<(), Text> {
        let seeds = SeedSources {
            chosen: seeds.chosen.or(self.options.seed),
            ..seeds
        };
        let terms = self.terms(&mission, wanted, seeds);
        if let Some(refusal) = AttemptRefusal::of(wanted, &terms.means) {
            return Err(refusal.text());
        }
        let reasons = terms.practice_reasons();
        let misfits = mission.misfits();
        let attempt = terms.decide();
        if seeds.drawn.is_some() && attempt.stake != Stake::Exam {
            return Err(PracticeReason::sentence(&reasons));
        }
        self.attempt = attempt;
        let started = self.start(SessionPlan::Mission(mission)).await?;
        self.begun(started);
        self.tell_practice(&reasons);
        for misfit in misfits {
            self.post(Event::Answer(misfit));
        }
        Ok(())
    }

    /// The terms under which a mission would count if flown now.
    fn terms<'a>(
        &'a self,
        mission: &'a Mission,
        wanted: Stake,
        seeds: SeedSources,
    ) -> AttemptTerms<'a> {
        let career = self.app.state().training().career();
        AttemptTerms {
            mission,
            wanted,
            seed: seeds.chosen,
            drawn: seeds.drawn,
            trainee: career.map(|career| AttemptTrainee {
                standing: &career.standing,
                course: &career.course,
                exams: career.exams,
            }),
            means: AttemptMeans {
                mission_file: store::mission_file(mission),
                flown_by: self.options.flown_by(),
                has_own_airframes: !self.options.backend.airframes.is_empty(),
                speedup: self.options.speedup,
                has_crew: self.options.crew.as_ref().is_some_and(CrewOptions::is_host),
            },
            day: today(),
            random: SysRng.try_next_u64().ok(),
        }
    }

    fn tell_practice(&mut self, reasons: &[PracticeReason]) {
        let is_kept = self.trainee().is_some();
        if is_kept && self.attempt.is_reduced() {
            self.post(Event::Answer(PracticeReason::sentence(reasons)));
        }
    }

    /// Starts a session other than a mission.
    pub(super) async fn start_afresh(&mut self, plan: SessionPlan) -> Result<(), Text> {
        self.attempt = Attempt::practice(self.options.seed);
        let started = self.start(plan).await?;
        self.begun(started);
        Ok(())
    }

    /// Starts the current session again: with a new seed, unless the user has chosen one or asks for the same. A
    /// prediction and a goal from before takeoff are kept.
    pub(super) async fn start_again(&mut self, alike: bool) -> Result<(), Text> {
        let Some(plan) = self.running.as_ref().map(RunningSession::plan) else {
            return Ok(());
        };
        self.attempt = match &plan {
            _ if alike => self.attempt.repeated(),
            SessionPlan::Mission(mission) => {
                let seeds = SeedSources {
                    chosen: self.options.seed,
                    drawn: None,
                };
                let terms = self.terms(mission, self.attempt.wanted, seeds);
                terms.decide_after(&self.attempt)
            }
            SessionPlan::Free(_) | SessionPlan::Connect(_) => self.attempt,
        };
        let pledge = self.running.as_ref().and_then(RunningSession::open_pledge);
        let started = self.start(plan).await?;
        if let (Some(running), Some(pledge)) = (&mut self.running, pledge) {
            running.renew(pledge);
        }
        self.begun(Started {
            is_again: true,
            ..started
        });
        Ok(())
    }

    fn begun(&mut self, started: Started) {
        self.post(SessionEvent::Started(Box::new(started)));
    }

    /// Ends the session. Its processes may take a while: the next session, or the end of the program, waits for
    /// `ending`.
    pub(super) fn end_session(&mut self) {
        self.go_on();
        self.situations.clear();
        self.situation_work.clear();
        self.clock.stand_through_stops(false);
        self.replaying = None;
        // The ghost was meant for the flight that ends.
        self.ghost = None;
        let record = self.running.as_mut().and_then(RunningSession::take_record);
        self.end_flight();
        if let Some(end) = self.record_point() {
            // The frame that has begun is complete too.
            let at = end.at + FRAME;
            self.record_before = Some(RecordPoint { at, ..end });
        }
        if let Some(running) = self.running.take() {
            self.ending = running.ending();
            // Its files are complete only now.
            drop(running);
            if let Some(record) = record {
                self.note_record(record);
            }
            // Another console may have stored flights in the meantime.
            self.show_career();
        }
    }

    /// Abandons the flight if leaving it counts, because its clock has started. If the terminal
    /// disappears, the next start of the program counts the flight as left, with a notice.
    fn end_flight(&mut self) {
        let Some(running) = &mut self.running else {
            return;
        };
        if self.is_cut_off || !running.counts_when_left() {
            return running.close_record();
        }
        running.abandon();
        // The last events belong to a session that is no longer shown.
        drop(running.fly(self.clock.now(), self.app.state().session()));
        if let Some(finished) = running.take_finished() {
            self.settle(finished);
        }
    }

    /// Ends the session and stores the waiting flights, waiting only briefly: processes that still
    /// run then end with the program.
    pub(super) async fn close(&mut self) {
        self.release_sticks().await;
        self.end_session();
        self.store_flights();
        // The plain console still reports what could not be stored.
        self.take_in().await;
        let ending = std::mem::take(&mut self.ending);
        ending.over(LAST_PROCESS_PATIENCE).await;
    }

    /// Releases the channels that the session holds, and gives its links time to send that.
    pub(super) async fn release_sticks(&self) {
        let running = self.running.as_ref();
        let held = running.map_or_else(Vec::new, RunningSession::release_sticks);
        if held.is_empty() {
            return;
        }
        let begun = async {
            for mut vehicle in held {
                // An error means that the vehicle's task has ended and sends nothing more.
                drop(vehicle.wait_for(|vehicle| vehicle.held.is_none()).await);
            }
        };
        // On a busy machine the tasks of the vehicles may run late.
        drop(tokio::time::timeout(RELEASE_PATIENCE, begun).await);
        tokio::time::sleep(RELEASE_TIME).await;
    }

    /// Ends the session and starts another one, which has to be passed to [`Self::begun`].
    async fn start(&mut self, plan: SessionPlan) -> Result<Started, Text> {
        let is_something_open = self.running.is_some() || self.replaying.is_some();
        self.release_sticks().await;
        // The old session ends first: the new one may need its ports.
        self.end_session();
        self.store_flights();
        let backend = SessionBackend {
            clock: self.clock.clone(),
            vehicles: self.options.vehicles,
            seed: self.attempt.seed,
            speedup: self.options.speedup,
            simulation: self.options.backend.clone(),
            runs: self.options.preferences.runs.clone(),
            records: self.options.preferences.records.clone(),
            data: self.options.preferences.data.clone(),
            events: Arc::clone(&self.options.preferences.events),
            signer: self.options.preferences.signer.clone(),
            station: self.options.preferences.config.connect.station,
            occasion: Occasion {
                stake: self.attempt.stake,
                flown_by: self.options.flown_by(),
                profile: self.trainee().map(str::to_owned),
                ..Occasion::default()
            },
            host: self
                .app
                .state()
                .crew()
                .host()
                .map(|crew| crew.host().clone()),
            earlier: self.tries_before(&plan),
            forwards: self.options.forwards.clone(),
        };
        let before = std::mem::take(&mut self.ending);
        let begun = RunningSession::start(plan, &backend, before).await;
        if begun.is_err() && is_something_open {
            self.post(SessionEvent::Ended);
        }
        let (mut running, started) = begun?;
        if self.options.crew.as_ref().is_some_and(CrewOptions::is_host) {
            running.note_followed();
        }
        self.running = Some(running);
        Ok(started)
    }
}

pub(super) fn parse(addresses: &[String]) -> Result<Vec<Address>, Text> {
    addresses
        .iter()
        .map(|address| address.parse())
        .collect::<Result<_, AddressError>>()
        .map_err(|error| Text::from(&error))
}

#[cfg(test)]
mod tests;
