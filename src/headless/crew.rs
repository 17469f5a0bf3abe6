//! Those who fly a mission: a session per vehicle, the pilot, and the mission that watches them.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::commands::{Command, Manoeuvre};
use crate::geo::{LatLon, Outline};
use crate::language::{self, Action, Context, Pilot, PilotEvent, Script, Seen, Statement, Verb};
use crate::ledger::{EntryId, Given, Ledger, Risk, RowUpdate};
use crate::mission::{Flight, Mission, Report as MissionReport};
use crate::notice::Notice;
use crate::session::{Order, Report, Session};
use crate::swarm::{Call, Conductor, Ordered};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
    SystemId, ground_station_heartbeat,
};

/// One vehicle's connection.
struct Seat {
    decoder: Decoder,
    encoder: Encoder,
    session: Session,
}

/// A flight in progress. Whoever owns it carries the bytes and says what time it is.
pub(super) struct Crew {
    seats: Vec<Seat>,
    vehicles: BTreeMap<VehicleId, Vehicle>,
    ledger: Ledger,
    pilot: Pilot,
    flight: Flight,
    conductor: Conductor,
    places: BTreeMap<String, LatLon>,
    areas: BTreeMap<String, Outline>,
    notices: Vec<Notice>,
    /// When the mission began; sessions may have begun before.
    begun: Duration,
}

impl Crew {
    /// So many vehicles, with system ids from 1, at time 0.
    pub fn new(mission: Arc<Mission>, seed: u64, script: Script, vehicles: usize) -> Self {
        let seat = |system| Seat {
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
            session: Session::new(system, AUTOPILOT_COMPONENT, Duration::ZERO),
        };
        Self {
            seats: (1..=SystemId::MAX).take(vehicles).map(seat).collect(),
            vehicles: BTreeMap::new(),
            ledger: Ledger::new(),
            pilot: Pilot::new(script),
            conductor: Conductor::new(mission.swarm_rules()),
            places: mission.places(),
            areas: mission.named_areas(),
            flight: Flight::new(mission, seed),
            notices: Vec::new(),
            begun: Duration::ZERO,
        }
    }

    /// The mission begins now; before that, nothing flies.
    pub fn begin(&mut self, now: Duration) {
        self.begun = now;
    }

    pub fn is_over(&self) -> bool {
        self.flight.outcome().is_some()
    }

    /// The flight, for what concerns its try and its record.
    pub fn flight_mut(&mut self) -> &mut Flight {
        &mut self.flight
    }

    /// The report, and the end of the record.
    pub fn close(&mut self) -> MissionReport {
        self.flight.close(&self.ledger)
    }

    pub fn report(&self) -> MissionReport {
        self.flight.report(&self.ledger)
    }

    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// A vehicle as its session knows it.
    pub fn vehicle(&self, index: usize) -> &Vehicle {
        self.seats[index].session.vehicle()
    }

    /// Takes in a vehicle's bytes; [`Self::hear`] makes messages of them.
    pub fn push(&mut self, index: usize, bytes: &[u8]) {
        self.seats[index].decoder.push(bytes);
    }

    /// Takes in a vehicle's next message, if it is there.
    pub fn hear(&mut self, index: usize, now: Duration) -> bool {
        let seat = &mut self.seats[index];
        let Some(frame) = seat.decoder.next_frame() else {
            return false;
        };
        seat.session.receive(&frame, now);
        true
    }

    /// Lets time pass for a vehicle's session.
    pub fn poll(&mut self, index: usize, now: Duration) {
        self.seats[index].session.poll(now);
    }

    /// Tells a vehicle that a ground station is there.
    pub fn say_heartbeat(&mut self, index: usize, bytes: &mut Vec<u8>) {
        let seat = &mut self.seats[index];
        if !seat.session.is_cut() {
            seat.encoder.encode(&ground_station_heartbeat(), bytes);
        }
    }

    /// What there is to say to a vehicle.
    pub fn say(&mut self, index: usize, bytes: &mut Vec<u8>) {
        let seat = &mut self.seats[index];
        for message in seat.session.take_outgoing() {
            seat.encoder.encode(&message, bytes);
        }
    }

    /// Takes down what became of a vehicle's commands, and what is to be heard of it.
    pub fn note(&mut self, index: usize) {
        for report in self.seats[index].session.take_reports() {
            match report {
                Report::Row(update) => self.ledger.apply(&update),
                Report::Notice(notice) => self.notices.push(Notice {
                    at: notice.at.saturating_sub(self.begun),
                    ..notice
                }),
            }
        }
    }

    /// A vehicle is no more.
    pub fn lose(&mut self, index: usize) {
        self.look();
        let id = self.vehicle(index).id;
        let said = self.flight.lose(id, &self.vehicles);
        self.notices.extend(said);
    }

    /// One tick of pilot and mission.
    pub fn fly(&mut self, now: Duration) {
        self.look();
        let elapsed = now.saturating_sub(self.begun);
        let seen = Seen {
            vehicles: &self.vehicles,
            ledger: &self.ledger,
            findings: &self.flight.findings(),
        };
        for event in self.pilot.step(now, seen) {
            match event {
                PilotEvent::Do(statement) => self.carry_out(&statement, now),
                PilotEvent::WaitTimedOut { line, text } => self.notices.push(Notice {
                    at: elapsed,
                    vehicle: None,
                    severity: Severity::Warning,
                    text: text!("grammar-wait-timed-out", line = line, wait = text),
                }),
                PilotEvent::Finished => {}
            }
        }
        self.conduct(now);
        let said = self.flight.step(elapsed, &self.vehicles, &self.ledger);
        self.notices.extend(said);
        for demand in self.flight.take_demands() {
            let mut seats = self.seats.iter_mut().map(|seat| &mut seat.session);
            if let Some(session) = seats.find(|session| session.vehicle().id == demand.vehicle) {
                session.carry_out(demand.want);
            }
        }
    }

    /// Leads those who do something together.
    fn conduct(&mut self, now: Duration) {
        let turn = self.conductor.step(now, &self.vehicles);
        for row in &turn.rows {
            self.ledger.apply(row);
        }
        for (id, steering) in &turn.steering {
            let mut seats = self.seats.iter_mut().map(|seat| &mut seat.session);
            if let Some(session) = seats.find(|session| session.vehicle().id == *id) {
                // What cannot be flown to is not said again: it shows in what the vehicle does not do.
                let _ = session.steer(steering, now);
            }
        }
        let begun = self.begun;
        self.notices
            .extend(turn.notices.into_iter().map(|notice| Notice {
                at: notice.at.saturating_sub(begun),
                ..notice
            }));
    }

    /// Takes snapshots of the vehicles.
    fn look(&mut self) {
        for seat in &self.seats {
            let vehicle = seat.session.vehicle();
            self.vehicles.insert(vehicle.id, vehicle.clone());
        }
    }

    /// Carries out a line as it is meant now: places may have come up or moved since the script was read.
    fn carry_out(&mut self, statement: &Statement, now: Duration) {
        let all: Vec<VehicleId> = self.vehicles.keys().copied().collect();
        let mut places = self.flight.places();
        places.extend(self.places.clone());
        let context = Context {
            places: Some(&places),
            areas: Some(&self.areas),
            vehicles: &all,
            ..Context::default()
        };
        let understood = language::parse(&statement.line, &context)
            .map_err(|fault| fault.message)
            .and_then(|meant| Ok((meant.targets.resolve(&all, &context)?, meant.action)));
        let (targets, action) = match understood {
            Ok(understood) => understood,
            Err(text) => {
                self.notices.push(Notice {
                    at: now.saturating_sub(self.begun),
                    vehicle: None,
                    severity: Severity::Error,
                    text: Text::joined(": ", vec![format!("`{}`", statement.line).into(), text]),
                });
                return;
            }
        };
        let line = &statement.line;
        match action {
            Action::Command { verb, command } => {
                let entry = self.open(line, (verb.name, command.risk()), &targets, now);
                self.order(entry, (verb, &command), &targets, now);
            }
            Action::Deed { verb, deed } => {
                let entry = self.open(line, (verb.name, Risk::None), &targets, now);
                for row in self.flight.act(entry, &deed, &targets) {
                    self.ledger.apply(&RowUpdate { at: now, ..row });
                }
            }
            Action::Manoeuvre { manoeuvre, .. } => {
                let given = (manoeuvre.name(), Risk::None);
                let entry = self.open(line, given, &targets, now);
                self.begin_manoeuvre(entry, &manoeuvre, &targets, now);
            }
            Action::Wait(_) => {}
        }
    }

    fn order(
        &mut self,
        entry: EntryId,
        (verb, command): (&'static Verb, &Command),
        targets: &[VehicleId],
        now: Duration,
    ) {
        let ordered = Ordered {
            entry,
            verb: verb.name,
            command,
            targets,
        };
        let (targets, rows) = self.conductor.order(ordered, &self.vehicles, now);
        for row in &rows {
            self.ledger.apply(row);
        }
        for seat in &mut self.seats {
            if targets.contains(&seat.session.vehicle().id) {
                let order = Order::new(entry, verb, command.clone());
                seat.session.order(order, now);
            }
        }
    }

    fn begin_manoeuvre(
        &mut self,
        entry: EntryId,
        manoeuvre: &Manoeuvre,
        targets: &[VehicleId],
        now: Duration,
    ) {
        let call = Call {
            entry,
            manoeuvre,
            targets,
        };
        let rows = self.conductor.begin(call, &self.vehicles, now);
        for row in &rows {
            self.ledger.apply(row);
        }
    }

    fn open(
        &mut self,
        line: &str,
        (verb, risk): (&str, Risk),
        targets: &[VehicleId],
        now: Duration,
    ) -> EntryId {
        self.ledger.open(now, Given { line, verb, risk }, targets)
    }
}
