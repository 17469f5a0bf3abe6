//! The course of a mission: how far it has been stepped, and by whose clock.

use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use super::Running;
use super::logbook::Logbook;
use crate::app::event::{Event, SessionEvent};
use crate::app::state::{Session as Shown, Stage};
use crate::commands::Deed;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::mission::record::Occasion;
use crate::mission::{self, Clock, Demand, Flight, HEARD_WITHIN, Mission, Pledge};
use crate::notice::Notice;
use crate::scoring::{FlightBackend, Report, TryReport};
use crate::store::{self, Runs};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// A mission that is flown.
pub(super) struct Course {
    /// The try at it.
    pub flight: Flight,
    /// What records it.
    logbook: Option<Logbook>,
    pace: Pace,
    /// Simulated seconds per second.
    speedup: f64,
    /// What its vehicles are.
    backend: FlightBackend,
    /// Since when its vehicles are there to be heard.
    awaited: Option<Duration>,
    /// When it began.
    begun: Option<Duration>,
    stepped: Duration,
    /// What the mission demands of vehicles that have not been told yet, oldest first.
    wanted: VecDeque<Demand>,
    /// The vehicles whose processes have ended.
    lost: BTreeSet<VehicleId>,
    ended: bool,
    /// The result, until it is taken.
    finished: Option<Finished>,
}

/// A mission that has come to its end.
pub(in crate::console) struct Finished {
    /// What was flown.
    pub mission: Arc<Mission>,
    /// What came of it.
    pub report: Report,
    /// For whose career it was flown, and how it counts there.
    pub occasion: Occasion,
    /// What the run is called, which no other is.
    pub run_id: String,
    /// Whether its record is whole.
    pub is_recorded: bool,
}

/// By whose clock mission time passes.
enum Pace {
    /// By ours: the embedded simulator keeps up with it.
    Ours,
    /// By the vehicles': a slow machine slows the mission down with them.
    Vehicles(Clock),
}

impl Course {
    /// A mission with the embedded simulator.
    pub fn embedded(flight: Flight, speedup: f64) -> Self {
        Self::new(flight, Pace::Ours, (FlightBackend::Embedded, speedup))
    }

    /// A mission with vehicles that have to be started first.
    pub fn of_processes(flight: Flight, speedup: f64) -> Self {
        let pace = Pace::Vehicles(Clock::new(speedup));
        Self::new(flight, pace, (FlightBackend::ArduPilot, speedup))
    }

    fn new(flight: Flight, pace: Pace, (backend, speedup): (FlightBackend, f64)) -> Self {
        Self {
            flight,
            logbook: None,
            pace,
            speedup,
            backend,
            awaited: None,
            begun: None,
            stepped: Duration::ZERO,
            wanted: VecDeque::new(),
            lost: BTreeSet::new(),
            ended: false,
            finished: None,
        }
    }

    /// Begins its record, and tells it which try it is; `earlier` are those before it.
    pub fn record(&mut self, runs: &Runs, occasion: Occasion, earlier: Vec<TryReport>) {
        let occasion = Occasion {
            backend: self.backend,
            ..occasion
        };
        let logbook = Logbook::begin(runs, &mut self.flight, occasion, earlier);
        self.logbook = Some(logbook);
    }

    /// Steps the mission up to now and returns what came of it. It stands still until its vehicles are there.
    pub fn fly(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        if self.ended {
            return Vec::new();
        }
        let until = self.time(now, shown);
        let mut events = self.note_losses(now, shown);
        while self.stepped + mission::TICK <= until && self.flight.outcome().is_none() {
            self.stepped += mission::TICK;
            let said = self
                .flight
                .step(self.stepped, &shown.vehicles, &shown.ledger);
            events.extend(heard(said, now));
        }
        events.extend(self.keep_record(now));
        events.push(SessionEvent::Mission(Box::new(self.flight.progress())).into());
        if self.flight.outcome().is_some() {
            self.ended = true;
            let mut report = self.flight.close(&shown.ledger);
            report.drill = store::drill_of(&report.mission);
            report.backend = self.backend;
            events.extend(self.keep_record(now));
            if let Some(logbook) = &self.logbook {
                report.tries = logbook.tries(&report);
                self.finished = Some(Finished {
                    mission: Arc::clone(self.flight.mission()),
                    report: report.clone(),
                    occasion: logbook.occasion().clone(),
                    run_id: logbook.run_id().to_owned(),
                    is_recorded: logbook.is_whole(),
                });
            }
            events.push(SessionEvent::MissionEnded(Box::new(report)).into());
        }
        events
    }

    /// Writes what was recorded; that it cannot be is said once.
    fn keep_record(&mut self, now: Duration) -> Option<Event> {
        let text = self.logbook.as_mut()?.keep(&mut self.flight, now)?;
        Some(Event::Notice(Notice {
            at: now,
            vehicle: None,
            severity: Severity::Warning,
            text,
        }))
    }

    /// Vehicles whose processes have ended by themselves do not come back.
    fn note_losses(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        if self.begun.is_none() {
            return Vec::new();
        }
        let instances = shown.hangar.iter().flat_map(|hangar| &hangar.instances);
        let ended = instances.filter(|instance| instance.stage == Stage::Ended);
        let mut events = Vec::new();
        for instance in ended {
            if self.lost.insert(instance.vehicle) {
                let said = self.flight.lose(instance.vehicle, &shown.vehicles);
                events.extend(heard(said, now));
            }
        }
        events
    }

    /// When the mission began: once its vehicles are there and heard, because what each has on board goes by their
    /// order. One that stays silent does not hold it up for ever.
    fn beginning(&mut self, now: Duration, shown: &Shown) -> Option<Duration> {
        if self.begun.is_none() && !shown.is_starting() {
            let awaited = *self.awaited.get_or_insert(now);
            let are_all_heard = shown.vehicles.len() >= self.flight.mission().vehicles;
            let is_time = are_all_heard || now.saturating_sub(awaited) >= HEARD_WITHIN;
            self.begun = is_time.then_some(now);
        }
        self.begun
    }

    /// Mission time.
    fn time(&mut self, now: Duration, shown: &Shown) -> Duration {
        let Some(begun) = self.beginning(now, shown) else {
            return Duration::ZERO;
        };
        match &mut self.pace {
            Pace::Ours => now.saturating_sub(begun).mul_f64(self.speedup),
            // One that boots runs at another speed.
            Pace::Vehicles(clock) => {
                let flies = |id| {
                    let hangar = shown.hangar.as_ref();
                    let instance = hangar.and_then(|hangar| hangar.of(id));
                    instance.is_some_and(|instance| instance.stage == Stage::Ready)
                };
                let vehicles = shown.vehicles.iter().filter(|(id, _)| flies(**id));
                clock.step(now, vehicles.map(|(&id, vehicle)| (id, vehicle.clock_ms())))
            }
        }
    }
}

/// What the mission says is on its own clock; the console's notices are on the program's.
fn heard(said: Vec<Notice>, now: Duration) -> impl Iterator<Item = Event> {
    said.into_iter()
        .map(move |notice| Event::Notice(Notice { at: now, ..notice }))
}

/// Tells the demands on vehicles that are heard, oldest first, until one cannot be told: it and what follows stay.
fn tell_demands(
    wanted: &mut VecDeque<Demand>,
    is_heard: impl Fn(VehicleId) -> bool,
    mut tell: impl FnMut(Demand) -> bool,
) {
    let mut is_stuck = false;
    wanted.retain(|&demand| {
        if is_stuck || !is_heard(demand.vehicle) {
            return true;
        }
        is_stuck = !tell(demand);
        is_stuck
    });
}

impl Running {
    /// Steps the mission up to now and returns what came of it.
    pub fn fly(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        let Some(course) = &mut self.course else {
            return Vec::new();
        };
        let events = course.fly(now, shown);
        course.wanted.extend(course.flight.take_demands());
        // What a vehicle cannot be told before it is heard waits until it is.
        tell_demands(
            &mut course.wanted,
            |vehicle| shown.vehicles.contains_key(&vehicle),
            |demand| self.fleet.carry_out(demand.vehicle, demand.want).is_ok(),
        );
        events
    }

    /// The result of a mission that has just ended, once.
    pub fn take_finished(&mut self) -> Option<Finished> {
        self.course.as_mut()?.finished.take()
    }

    /// What the trainee has said before launch, as long as nothing has flown.
    pub fn open_pledge(&self) -> Option<Pledge> {
        self.course.as_ref()?.flight.open_pledge()
    }

    /// Takes over what the trainee has said before the try before this one, in which nothing has flown.
    pub fn renew(&mut self, pledge: Pledge) {
        if let Some(course) = &mut self.course {
            course.flight.renew(pledge);
        }
    }

    /// Has the mission do something with vehicles; returns how it went. Without a mission it is refused.
    pub fn act(
        &mut self,
        entry: EntryId,
        deed: &Deed,
        vehicles: &[VehicleId],
        now: Duration,
    ) -> Vec<RowUpdate> {
        if let Some(course) = &mut self.course {
            let rows = course.flight.act(entry, deed, vehicles);
            // The mission speaks on its own clock; the ledger is on the program's.
            return rows
                .into_iter()
                .map(|row| RowUpdate { at: now, ..row })
                .collect();
        }
        let refused = |&vehicle: &VehicleId| RowUpdate {
            entry,
            vehicle,
            state: RowState::Refused,
            tries: 0,
            at: now,
            explanation: Some(text!("deed-no-mission")),
        };
        vehicles.iter().map(refused).collect()
    }

    /// Has something happen in the mission; `None` without one.
    pub fn inject(&mut self, name: &str) -> Option<Result<Text, Text>> {
        Some(self.course.as_mut()?.flight.inject(name))
    }

    /// Takes down in the mission's record that all stood still for so long.
    pub fn note_pause(&mut self, lasted: Duration, now: Duration) -> Option<Notice> {
        self.inspection.rest(now);
        let notice = self.course.as_mut()?.flight.note_pause(lasted)?;
        Some(Notice { at: now, ..notice })
    }

    /// Ends the mission; its report comes with the next tick.
    pub fn abandon(&mut self) {
        if let Some(course) = &mut self.course {
            course.flight.abandon();
        }
    }
}

#[cfg(test)]
mod tests;
