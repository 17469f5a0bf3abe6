//! A mission in flight: its steps and its clock.

use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;

use super::RunningSession;
use super::logbook::Logbook;
use crate::app::event::{Event, SessionEvent};
use crate::app::state::{FlightView, Hangar, SitlStage};
use crate::campaign::is_practice;
use crate::class::RecordHead;
use crate::exercise::{FlightDriver, FlightPace};
use crate::mission::record::Occasion;
use crate::mission::{Clock, Demand, Flight, Mission, Pledge};
use crate::notice::Notice;
use crate::record::Happening;
use crate::scoring::{FlightBackend, Report, TryReport};
use crate::sim::STEP;
use crate::store::{self, RunFile, Runs};
use crate::vehicle::{Severity, VehicleId};

/// A mission in flight.
pub(super) struct MissionRun {
    driver: FlightDriver,
    logbook: Option<Logbook>,
    backend: FlightBackend,
    /// The embedded simulator's step counter, from which mission time is derived; `None` for
    /// processes.
    steps: Option<watch::Receiver<u64>>,
    /// The mission's demands on vehicles that have not been sent yet, oldest first.
    wanted: VecDeque<Demand>,
    /// The vehicles whose processes have ended.
    lost: BTreeSet<VehicleId>,
    ended: bool,
    /// The result, until it is taken.
    finished: Option<Finished>,
    /// Whether the name of its record was taken.
    is_record_taken: bool,
}

/// Everything from which a mission can continue.
pub(super) struct MissionSituation {
    driver: FlightDriver,
    wanted: VecDeque<Demand>,
    lost: BTreeSet<VehicleId>,
}

/// A mission that has ended.
pub(in crate::shell) struct Finished {
    /// The mission that was flown.
    pub mission: Arc<Mission>,
    pub report: Report,
    /// The career and the stake of the flight.
    pub occasion: Occasion,
    /// The unique id of the run.
    pub run_id: String,
    /// Whether the run's record is complete.
    pub is_recorded: bool,
    /// The record of a flight that ended by itself, if the record was cut off before that.
    pub cut: Option<RunFile>,
}

impl MissionRun {
    pub fn flight_mut(&mut self) -> &mut Flight {
        self.driver.flight_mut()
    }

    pub fn flight(&self) -> &Flight {
        self.driver.flight()
    }

    /// A mission with the embedded simulator. Mission time is counted in the simulator's steps, so
    /// the two stay together even if the program is stopped or the machine is slow.
    pub fn embedded(flight: Flight, steps: watch::Receiver<u64>) -> Self {
        let driver = FlightDriver::new(flight, FlightPace::Simulated);
        Self {
            steps: Some(steps),
            ..Self::new(driver, FlightBackend::Embedded)
        }
    }

    /// A mission with vehicles that must be started first.
    pub fn of_processes(flight: Flight, speedup: f64) -> Self {
        let pace = FlightPace::VehicleClocks(Clock::new(speedup));
        Self::new(FlightDriver::new(flight, pace), FlightBackend::ArduPilot)
    }

    fn new(driver: FlightDriver, backend: FlightBackend) -> Self {
        Self {
            driver,
            logbook: None,
            backend,
            steps: None,
            wanted: VecDeque::new(),
            lost: BTreeSet::new(),
            ended: false,
            finished: None,
            is_record_taken: false,
        }
    }

    /// Starts the record of the mission, and sets its attempt number; `earlier` holds the attempts
    /// before it.
    pub fn record(&mut self, runs: &Runs, occasion: Occasion, earlier: Vec<TryReport>) {
        let occasion = Occasion {
            backend: self.backend,
            ..occasion
        };
        let logbook = Logbook::begin(runs, self.driver.flight_mut(), occasion, earlier);
        self.logbook = Some(logbook);
    }

    /// Writes the record more often, because others follow it.
    pub fn note_followed(&mut self) {
        if let Some(logbook) = &mut self.logbook {
            logbook.note_followed();
        }
    }

    /// The situation of the mission.
    pub fn situation(&self) -> MissionSituation {
        MissionSituation {
            driver: self.driver.clone(),
            wanted: self.wanted.clone(),
            lost: self.lost.clone(),
        }
    }

    /// Ends the record because the flight continues from an earlier situation.
    pub fn leave_record(&mut self) {
        let flight = self.driver.flight_mut();
        // A record that is complete stays as it is.
        if !flight.is_over() {
            flight.record_recall();
        }
        if let Some(logbook) = self.logbook.take() {
            logbook.finish(flight);
        }
    }

    /// Continues from a situation, without a record; returns the notice, in mission time.
    pub fn recall(&mut self, situation: &MissionSituation) -> Option<Notice> {
        self.driver = situation.driver.clone();
        self.wanted.clone_from(&situation.wanted);
        self.lost.clone_from(&situation.lost);
        (self.ended, self.finished) = (false, None);
        self.driver.flight_mut().continue_from_situation()
    }

    /// The id of its run, if recorded.
    pub fn run_id(&self) -> Option<&str> {
        let logbook = self.logbook.as_ref().filter(|it| it.is_whole())?;
        Some(logbook.run_id())
    }

    /// The name of its record, if it is whole so far and the mission has begun; returned once.
    fn take_record(&mut self) -> Option<String> {
        let record = self.run_id().filter(|_| self.has_begun())?.to_owned();
        (!std::mem::replace(&mut self.is_record_taken, true)).then_some(record)
    }

    /// Whether the mission's clock has started.
    pub fn has_begun(&self) -> bool {
        self.driver.has_begun()
    }

    fn elapsed(&self) -> Duration {
        self.driver.flight().elapsed()
    }

    /// Steps the mission up to now and returns the events. The mission does not start until its
    /// vehicles are heard.
    pub fn fly(&mut self, now: Duration, shown: &FlightView) -> Vec<Event> {
        if self.ended {
            return Vec::new();
        }
        let steps = self.steps.as_ref().map(|steps| *steps.borrow());
        if let Some(steps) = steps {
            self.driver.flight_mut().note_simulated(steps);
        }
        let until = self.time(steps.map_or(now, simulated), shown);
        let mut events = self.note_losses(now, shown);
        while let Some(tick) = self.driver.tick(until) {
            let flight = self.driver.flight_mut();
            let said = flight.step(tick, shown.vehicles(), shown.ledger());
            events.extend(heard(said, now));
        }
        events.extend(self.keep_record(now));
        events.push(SessionEvent::Mission(Box::new(self.driver.flight().progress())).into());
        if self.driver.is_over() {
            self.ended = true;
            let mut report = self.driver.flight_mut().close(shown.ledger());
            events.extend(self.keep_record(now));
            store::complete(&mut report, self.driver.flight().mission());
            report.backend = self.backend;
            self.finish(&mut report);
            events.push(SessionEvent::MissionEnded(Box::new(report)).into());
        }
        events
    }

    /// Adds the attempts to the report, and keeps it with the stake of the flight until the result
    /// is taken.
    fn finish(&mut self, report: &mut Report) {
        let Some(logbook) = &mut self.logbook else {
            return;
        };
        report.tries = logbook.tries(report);
        self.finished = Some(Finished {
            mission: Arc::clone(self.driver.flight().mission()),
            report: report.clone(),
            occasion: logbook.occasion().clone(),
            run_id: logbook.run_id().to_owned(),
            is_recorded: logbook.is_whole(),
            cut: logbook.take_cut().filter(|_| !report.given_up),
        });
    }

    /// Writes the record; a failure is reported once.
    fn keep_record(&mut self, now: Duration) -> Option<Event> {
        let text = self.logbook.as_mut()?.keep(self.driver.flight_mut(), now)?;
        Some(Event::Notice(Notice::general(now, Severity::Warning, text)))
    }

    /// Marks vehicles as lost if their processes have ended by themselves.
    fn note_losses(&mut self, now: Duration, shown: &FlightView) -> Vec<Event> {
        if !self.driver.has_begun() {
            return Vec::new();
        }
        let instances = shown.hangar().map_or(&[][..], Hangar::instances).iter();
        let ended = instances.filter(|instance| instance.stage == SitlStage::Ended);
        let mut events = Vec::new();
        for instance in ended {
            if self.lost.insert(instance.vehicle) {
                let said = self
                    .driver
                    .flight_mut()
                    .lose(instance.vehicle, shown.vehicles());
                events.extend(heard(said, now));
            }
        }
        events
    }

    /// Mission time, which starts once the vehicles are heard. With the embedded simulator, `now`
    /// is simulator time.
    fn time(&mut self, now: Duration, shown: &FlightView) -> Duration {
        if !shown.is_starting() && !shown.is_reading() {
            let wanted = self.driver.flight().mission().seats.count;
            self.driver
                .begin_when_heard(now, shown.vehicles().len() >= wanted);
        }
        // A booting vehicle runs at a different speed.
        let flies = |id| {
            let hangar = shown.hangar();
            let instance = hangar.and_then(|hangar| hangar.of(id));
            instance.is_some_and(|instance| instance.stage == SitlStage::Ready)
        };
        let vehicles = shown.vehicles().iter().filter(|(id, _)| flies(**id));
        let clocks = vehicles.map(|(&id, vehicle)| (id, vehicle.clock_ms()));
        self.driver.advance(now, clocks)
    }
}

fn simulated(steps: u64) -> Duration {
    Duration::from_nanos((STEP.as_nanos() as u64).saturating_mul(steps))
}

/// The mission's notices, converted from mission time to the program's clock.
fn heard(said: Vec<Notice>, now: Duration) -> impl Iterator<Item = Event> {
    said.into_iter()
        .map(move |notice| Event::Notice(Notice { at: now, ..notice }))
}

/// Sends demands to vehicles that are heard, oldest first, until a demand fails; this demand and
/// all later ones stay queued.
fn tell_demands(
    wanted: &mut VecDeque<Demand>,
    is_heard: impl Fn(VehicleId) -> bool,
    mut tell: impl FnMut(&Demand) -> bool,
) {
    let mut is_stuck = false;
    wanted.retain(|demand| {
        if is_stuck || !is_heard(demand.vehicle) {
            return true;
        }
        is_stuck = !tell(demand);
        is_stuck
    });
}

impl RunningSession {
    /// Steps the mission up to now and returns the events.
    pub fn fly(&mut self, now: Duration, shown: &FlightView) -> Vec<Event> {
        let Some(mission_run) = &mut self.mission_run else {
            return Vec::new();
        };
        let before = mission_run.elapsed();
        let events = mission_run.fly(now, shown);
        let elapsed = mission_run.elapsed();
        mission_run
            .wanted
            .extend(mission_run.driver.flight_mut().take_demands());
        // Demands on a vehicle that is not heard yet wait.
        let recorder = self.recorder.as_ref();
        tell_demands(
            &mut mission_run.wanted,
            |vehicle| shown.vehicles().contains_key(&vehicle),
            |demand| {
                let want = demand.want.clone();
                let is_told = self.fleet.carry_out(demand.vehicle, want).is_ok();
                let what = Happening::of_demand(demand.vehicle, &demand.want);
                if let (true, Some(recorder), Some(what)) = (is_told, recorder, what) {
                    recorder.note(now, what);
                }
                is_told
            },
        );
        let has_ended = mission_run.ended;
        if elapsed > before {
            let ms = elapsed.as_millis() as u64;
            self.note_down(now, Happening::Mission { ms });
        }
        if let Some(recorder) = self.recorder.as_mut().filter(|_| has_ended) {
            recorder.end_after_mission(now);
        }
        events
    }

    /// The result of a mission that has just ended; returned once.
    pub fn take_finished(&mut self) -> Option<Finished> {
        self.mission_run.as_mut()?.finished.take()
    }

    /// The name of the record of a mission that is over, once all its files are written; returned once.
    pub fn take_complete_record(&mut self, now: Duration) -> Option<String> {
        let recorder = self.recorder.as_ref();
        let is_written = recorder.is_none_or(|recorder| recorder.is_written(now));
        let run = self.mission_run.as_mut();
        run.filter(|run| run.ended && is_written)?.take_record()
    }

    /// The name of the record of a mission that is left; returned once. Its files are complete when the session is
    /// gone.
    pub fn take_record(&mut self) -> Option<String> {
        self.mission_run.as_mut()?.take_record()
    }

    /// The trainee's prediction and goal; `None` once a vehicle has flown, or without a mission.
    pub fn open_pledge(&self) -> Option<Pledge> {
        self.mission_run.as_ref()?.driver.flight().open_pledge()
    }

    /// Sets the prediction and the goal, taken from a previous attempt in which nothing flew.
    pub fn renew(&mut self, pledge: Pledge) {
        if let Some(mission_run) = &mut self.mission_run {
            mission_run.driver.flight_mut().renew(pledge);
        }
    }

    /// How far the record of the mission has grown.
    pub fn record_head(&self) -> Option<RecordHead> {
        self.mission_run.as_ref()?.logbook.as_ref()?.head()
    }

    /// The flight of the mission, for what an instructor does in it; `None` without a mission.
    pub fn instructed(&mut self) -> Option<&mut Flight> {
        Some(self.mission_run.as_mut()?.driver.flight_mut())
    }

    /// Whether everything can be paused until the brief has been read: the simulator is the
    /// embedded one, and all vehicles are heard.
    pub fn can_wait_for_reader(&self, vehicles: usize) -> bool {
        let mission = self.mission_run.as_ref().map(|run| run.driver.flight());
        self.processes.is_none() && mission.is_some_and(|it| vehicles >= it.mission().seats.count)
    }

    /// Adds a pause of this length to the mission's record; returns the notice about it, if any.
    pub fn note_pause(&mut self, lasted: Duration, now: Duration) -> Option<Notice> {
        let notice = self
            .mission_run
            .as_mut()?
            .driver
            .flight_mut()
            .note_pause(lasted)?;
        Some(Notice { at: now, ..notice })
    }

    /// Whether leaving now abandons a flight that counts: its clock has started, and it is not over.
    pub fn counts_when_left(&self) -> bool {
        self.mission_run.as_ref().is_some_and(|run| {
            let occasion = run.logbook.as_ref().map(Logbook::occasion);
            let counts = occasion.is_some_and(|it| !is_practice(it.stake, Some(it.flown_by)));
            counts && run.driver.has_begun() && !run.ended
        })
    }

    /// Ends the record of a mission that is left early but not abandoned. If its clock has not
    /// started, the record is removed.
    pub fn close_record(&mut self) {
        let Some(run) = &mut self.mission_run else {
            return;
        };
        let Some(logbook) = run.logbook.take() else {
            return;
        };
        if run.driver.has_begun() {
            logbook.finish(run.driver.flight_mut());
        } else {
            run.driver.flight_mut().stop_record();
            logbook.discard();
        }
    }

    /// Ends the mission; its report comes with the next tick.
    pub fn abandon(&mut self) {
        if let Some(mission_run) = &mut self.mission_run {
            mission_run.driver.flight_mut().abandon();
        }
    }

    /// Ends the mission for the instructor; its report comes with the next tick.
    pub fn stop(&mut self) {
        if let Some(mission_run) = &mut self.mission_run {
            mission_run.driver.flight_mut().stop();
        }
    }
}

#[cfg(test)]
mod tests;
