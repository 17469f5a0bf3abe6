//! A mission flown by a pilot script, in lock step and without a clock.
//!
//! Simulator, sessions, pilot, mission and scoring advance together in steps of simulated time, over the
//! same MAVLink bytes as in the console. The outcome depends on the mission, the seed and the script alone.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::language::{Action, Context, Pilot, PilotEvent, Script, Statement};
use crate::ledger::{Given, Ledger};
use crate::mission::{Flight, Mission, Report as MissionReport, TICK};
use crate::notice::Notice;
use crate::session::{Order, Report, Session};
use crate::sim::{PortId, World};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
    ground_station_heartbeat,
};

/// How often sessions look at their deadlines.
const SESSION_POLL: Duration = Duration::from_millis(50);
/// How often a ground station says that it is there.
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);

/// One vehicle's connection to the simulator.
struct Seat {
    port: PortId,
    decoder: Decoder,
    encoder: Encoder,
    session: Session,
}

/// A flight in progress.
pub struct Exercise {
    world: World,
    seats: Vec<Seat>,
    vehicles: BTreeMap<VehicleId, Vehicle>,
    ledger: Ledger,
    pilot: Pilot,
    flight: Flight,
    places: BTreeMap<String, crate::geo::LatLon>,
    notices: Vec<Notice>,
    bytes: Vec<u8>,
}

impl Exercise {
    /// Puts the mission's vehicles on their pads.
    pub fn new(mission: Arc<Mission>, seed: u64, script: Script) -> Self {
        let world = World::new(&mission.world(seed));
        let mut exercise = Self {
            seats: Vec::with_capacity(world.vehicles()),
            world,
            vehicles: BTreeMap::new(),
            ledger: Ledger::new(),
            pilot: Pilot::new(script),
            places: mission.places(),
            flight: Flight::new(mission, seed),
            notices: Vec::new(),
            bytes: Vec::new(),
        };
        for index in 0..exercise.world.vehicles() {
            exercise.seats.push(Seat {
                port: exercise.world.connect(index),
                decoder: Decoder::new(),
                encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
                session: Session::new(index as u8 + 1, AUTOPILOT_COMPONENT, Duration::ZERO),
            });
        }
        exercise
    }

    /// The time since the mission began.
    pub fn now(&self) -> Duration {
        self.world.now()
    }

    /// Whether the mission has come to its end.
    pub fn is_over(&self) -> bool {
        self.flight.outcome().is_some()
    }

    /// The result so far, everything explained.
    pub fn report(&self) -> MissionReport {
        self.flight.report(&self.ledger)
    }

    /// What was said so far, oldest first; it is gone from the exercise then.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// Advances by one step of the simulator.
    pub fn step(&mut self) {
        self.world.step();
        let now = self.world.now();
        for index in 0..self.seats.len() {
            self.exchange(index, now);
        }
        if is_due(now, TICK) {
            self.fly(now);
        }
    }

    /// Carries bytes both ways between a vehicle and its session.
    fn exchange(&mut self, index: usize, now: Duration) {
        let seat = &mut self.seats[index];
        if !self.world.is_open(seat.port) {
            // The vehicle has rebooted; its connection is made again, as a real one would be.
            self.world.disconnect(seat.port);
            seat.port = self.world.connect(index);
        }
        self.bytes.clear();
        self.world.take_output(seat.port, &mut self.bytes);
        seat.decoder.push(&self.bytes);
        while let Some(frame) = seat.decoder.next_frame() {
            seat.session.receive(&frame, now);
        }
        if is_due(now, SESSION_POLL) {
            seat.session.poll(now);
        }
        self.bytes.clear();
        if is_due(now, HEARTBEAT_EVERY) {
            seat.encoder
                .encode(&ground_station_heartbeat(), &mut self.bytes);
        }
        for message in seat.session.take_outgoing() {
            seat.encoder.encode(&message, &mut self.bytes);
        }
        if !self.bytes.is_empty() {
            self.world.receive(seat.port, &self.bytes);
        }
        for report in seat.session.take_reports() {
            match report {
                Report::Row(update) => self.ledger.apply(&update),
                Report::Notice(notice) => self.notices.push(notice),
            }
        }
    }

    /// One tick of pilot and mission.
    fn fly(&mut self, now: Duration) {
        for seat in &self.seats {
            let vehicle = seat.session.vehicle();
            self.vehicles.insert(vehicle.id, vehicle.clone());
        }
        for event in self.pilot.step(now, &self.vehicles, &self.ledger) {
            match event {
                PilotEvent::Do(statement) => self.carry_out(&statement, now),
                PilotEvent::WaitTimedOut { line, text } => self.notices.push(Notice {
                    at: now,
                    vehicle: None,
                    severity: Severity::Warning,
                    text: text!("grammar-wait-timed-out", line = line, wait = text),
                }),
                PilotEvent::Finished => {}
            }
        }
        let said = self.flight.step(now, &self.vehicles, &self.ledger);
        self.notices.extend(said);
    }

    fn carry_out(&mut self, statement: &Statement, now: Duration) {
        let Action::Command { verb, command } = &statement.action else {
            return;
        };
        let all: Vec<VehicleId> = self.vehicles.keys().copied().collect();
        let context = Context {
            places: Some(&self.places),
            vehicles: &all,
            ..Context::default()
        };
        let targets = match statement.targets.resolve(&all, &context) {
            Ok(targets) => targets,
            Err(text) => {
                self.notices.push(Notice {
                    at: now,
                    vehicle: None,
                    severity: Severity::Error,
                    text: Text::joined(": ", vec![format!("`{}`", statement.line).into(), text]),
                });
                return;
            }
        };
        let given = Given {
            line: &statement.line,
            verb: verb.name,
            risk: command.risk(),
        };
        let entry = self.ledger.open(now, given, &targets);
        for seat in &mut self.seats {
            if targets.contains(&seat.session.vehicle().id) {
                let order = Order::new(entry, verb, command.clone());
                seat.session.order(order, now);
            }
        }
    }
}

fn is_due(now: Duration, every: Duration) -> bool {
    now.as_millis().is_multiple_of(every.as_millis())
}
