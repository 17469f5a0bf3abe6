//! The course of a mission: how far it has been stepped, and by whose clock.

use std::time::Duration;

use super::Running;
use super::logbook::Logbook;
use crate::app::event::Event;
use crate::app::state::{Session as Shown, Stage};
use crate::commands::Deed;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::mission::{self, Clock, Demand, Flight};
use crate::notice::Notice;
use crate::store;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// A mission that is flown.
pub(super) struct Course {
    /// The try at it.
    pub flight: Flight,
    /// What records it.
    pub logbook: Option<Logbook>,
    pace: Pace,
    stepped: Duration,
    /// What the mission demands of vehicles that have not been told yet.
    wanted: Vec<Demand>,
    ended: bool,
}

/// By whose clock mission time passes.
enum Pace {
    /// By ours, from this time on: the embedded simulator keeps up with it.
    Ours { since: Duration, speedup: f64 },
    /// By the vehicles': a slow machine slows the mission down with them.
    Vehicles(Clock),
}

impl Course {
    /// A mission with the embedded simulator, which begins now.
    pub fn embedded(flight: Flight, speedup: f64, since: Duration) -> Self {
        Self::new(flight, Pace::Ours { since, speedup })
    }

    /// A mission with vehicles that have to be started first.
    pub fn of_processes(flight: Flight, speedup: f64) -> Self {
        Self::new(flight, Pace::Vehicles(Clock::new(speedup)))
    }

    fn new(flight: Flight, pace: Pace) -> Self {
        Self {
            flight,
            logbook: None,
            pace,
            stepped: Duration::ZERO,
            wanted: Vec::new(),
            ended: false,
        }
    }

    /// Steps the mission up to now and returns what came of it. It stands still until its vehicles are there.
    pub fn fly(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        if self.ended {
            return Vec::new();
        }
        let until = self.time(now, shown);
        let mut events = Vec::new();
        while self.stepped + mission::TICK <= until && self.flight.outcome().is_none() {
            self.stepped += mission::TICK;
            let said = self
                .flight
                .step(self.stepped, &shown.vehicles, &shown.ledger);
            // The mission speaks on its own clock; the console's notices are on the program's.
            events.extend(
                said.into_iter()
                    .map(|notice| Event::Notice(Notice { at: now, ..notice })),
            );
        }
        events.extend(self.keep_record(now));
        events.push(Event::Mission(Box::new(self.flight.progress())));
        if self.flight.outcome().is_some() {
            self.ended = true;
            let mut report = self.flight.close(&shown.ledger);
            report.drill = store::drill_of(&report.mission);
            if let Pace::Vehicles(_) = self.pace {
                "ardupilot".clone_into(&mut report.backend);
            }
            events.extend(self.keep_record(now));
            if let Some(logbook) = &self.logbook {
                report.tries = logbook.tries(&report.mission, report.revision);
            }
            events.push(Event::MissionEnded(Box::new(report)));
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

    /// Mission time.
    fn time(&mut self, now: Duration, shown: &Shown) -> Duration {
        match &mut self.pace {
            Pace::Ours { since, speedup } => now.saturating_sub(*since).mul_f64(*speedup),
            Pace::Vehicles(_) if shown.is_starting() => Duration::ZERO,
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

impl Running {
    /// Steps the mission up to now and returns what came of it.
    pub fn fly(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        let Some(course) = &mut self.course else {
            return Vec::new();
        };
        let events = course.fly(now, shown);
        // What a vehicle cannot be told before it is heard waits until it is.
        let heard = |demand: &mut Demand| shown.vehicles.contains_key(&demand.vehicle);
        course.wanted.extend(course.flight.take_demands());
        for demand in course.wanted.extract_if(.., heard) {
            let _ = self.fleet.carry_out(demand.vehicle, demand.want);
        }
        events
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
