//! Manoeuvres flown in the embedded simulator.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::*;
use crate::geo::Outline;
use crate::geo::maths;
use crate::language::{self, Context};
use crate::ledger::{Ledger, RowState};
use crate::session::{Report, Session, VehicleCommand};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
};

mod flown;
mod outcome;
mod plans;

const HOME: LatLon = LatLon::new(50.45, 30.52);

struct Seat {
    port: PortId,
    decoder: Decoder,
    encoder: Encoder,
    session: Session,
}

/// Vehicles in the embedded simulator, with a ledger and a conductor.
struct Stage {
    world: World,
    seats: Vec<Seat>,
    conductor: Conductor,
    vehicles: Vehicles,
    pilots: PilotsInCommand,
    ledger: Ledger,
    notices: Vec<String>,
    areas: BTreeMap<String, Outline>,
    /// The minimum distance between two flying vehicles.
    nearest_m: f64,
}

impl Stage {
    /// A number of vehicles in a row to the east, `spacing_m` apart.
    fn new(count: usize, spacing_m: f64) -> Self {
        let start = |place: usize| Start {
            at: HOME.moved(0.0, spacing_m * place as f64),
            altitude_amsl_m: 180.0,
            heading_deg: 0.0,
        };
        let mut world = World::new(&WorldConfig {
            starts: (0..count).map(start).collect(),
            ..WorldConfig::row(count, start(0))
        });
        let seat = |index: usize| Seat {
            port: world.connect(index),
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
            session: Session::new(index as u8 + 1, AUTOPILOT_COMPONENT, Duration::ZERO),
        };
        let lane = [(20.0, 0.0), (140.0, 0.0), (140.0, 60.0), (20.0, 60.0)];
        let lane = lane.map(|(north_m, east_m)| HOME.moved(north_m, east_m));
        Self {
            seats: (0..count).map(seat).collect(),
            world,
            conductor: Conductor::default(),
            vehicles: Vehicles::new(),
            pilots: PilotsInCommand::default(),
            ledger: Ledger::new(),
            notices: Vec::new(),
            areas: BTreeMap::from([("lane".to_owned(), Outline::Polygon(lane.to_vec()))]),
            nearest_m: f64::INFINITY,
        }
    }

    /// A number of vehicles in a row, in the air at 20 m.
    fn flying(count: usize, spacing_m: f64) -> Self {
        let mut stage = Self::new(count, spacing_m);
        stage.run(25.0);
        for line in ["all guided", "all arm"] {
            stage.say(line);
            stage.run(4.0);
        }
        stage.say("all takeoff 20");
        stage.run(20.0);
        stage.nearest_m = f64::INFINITY;
        stage
    }

    fn now(&self) -> Duration {
        self.world.now()
    }

    fn run(&mut self, seconds: f64) {
        self.watch(seconds, |_| false);
    }

    /// Runs until a condition is true; returns `false` if it did not become true in time.
    fn watch(&mut self, seconds: f64, mut until: impl FnMut(&Self) -> bool) -> bool {
        let end = self.now() + Duration::from_secs_f64(seconds);
        while self.now() < end {
            self.world.step();
            let now = self.now();
            self.exchange(now);
            if now.as_millis().is_multiple_of(100) {
                self.conduct(now);
                self.measure();
                if until(self) {
                    return true;
                }
            }
        }
        false
    }

    fn exchange(&mut self, now: Duration) {
        let mut bytes = Vec::new();
        for seat in &mut self.seats {
            bytes.clear();
            self.world.take_output(seat.port, &mut bytes);
            seat.decoder.push(&bytes);
            while let Some(frame) = seat.decoder.next_frame() {
                seat.session.receive(&frame, now);
            }
            seat.session.poll(now);
            bytes.clear();
            if now.as_millis().is_multiple_of(1000) {
                seat.encoder
                    .encode(&crate::wire::ground_station_heartbeat(), &mut bytes);
            }
            for message in seat.session.take_outgoing() {
                seat.encoder.encode(&message, &mut bytes);
            }
            self.world.receive(seat.port, &bytes);
            for report in seat.session.take_reports() {
                if let Report::Row(row) = report {
                    self.ledger.apply(&row);
                }
            }
            let vehicle = seat.session.vehicle();
            let snapshot = Arc::new(vehicle.clone());
            self.vehicles.insert(vehicle.id, snapshot);
        }
    }

    fn conduct(&mut self, now: Duration) {
        let scene = ConductorScene {
            now,
            vehicles: &self.vehicles,
            pilots: &self.pilots,
        };
        let turn = self.conductor.step(scene);
        for row in &turn.rows {
            self.ledger.apply(row);
        }
        for (id, steering) in turn.steering {
            let seat = &mut self.seats[usize::from(id) - 1];
            seat.session
                .steer(&steering, now)
                .expect("a place to fly to");
        }
        let said = turn.notices.into_iter();
        self.notices.extend(
            said.map(|notice| format!("{}: {}", notice.vehicle.unwrap_or_default(), notice.text)),
        );
    }

    /// The true position, in metres north, east and up from home.
    fn place(&self, id: VehicleId) -> [f64; 3] {
        let truth = self.world.truth(usize::from(id) - 1);
        let (north, east) = HOME.offset_to(truth.at);
        [north, east, truth.altitude_amsl_m - 180.0]
    }

    fn distance(&self, a: VehicleId, b: VehicleId) -> f64 {
        let (a, b) = (self.place(a), self.place(b));
        (0..3)
            .map(|axis| maths::powi(a[axis] - b[axis], 2))
            .sum::<f64>()
            .sqrt()
    }

    fn measure(&mut self) {
        let flying = |id: &VehicleId| self.place(*id)[2] > 3.0;
        let ids: Vec<VehicleId> = self.vehicles.keys().copied().filter(flying).collect();
        for (index, &a) in ids.iter().enumerate() {
            for &b in &ids[..index] {
                self.nearest_m = self.nearest_m.min(self.distance(a, b));
            }
        }
    }

    /// Enters a line as the console would.
    fn say(&mut self, line: &str) {
        let ids: Vec<VehicleId> = (1..=self.seats.len() as VehicleId).collect();
        let context = Context {
            areas: Some(&self.areas),
            vehicles: &ids,
            ..Context::default()
        };
        let statement = language::parse(line, &context).expect(line);
        let now = self.now();
        let order = statement.into_order(&ids, &context).expect(line);
        let entry = self.ledger.open(now, order.given(), &order.targets);
        let scene = ConductorScene {
            now,
            vehicles: &self.vehicles,
            pilots: &self.pilots,
        };
        let assignment = self.conductor.take(entry, &order, scene);
        for row in &assignment.rows {
            self.ledger.apply(row);
        }
        if let Act::Command(command) = &order.act {
            for id in assignment.alone {
                let command = VehicleCommand::new(entry, order.verb, command.clone());
                self.seats[usize::from(id) - 1].session.order(command, now);
            }
        }
    }

    fn rows(&self, verb: &str) -> Vec<(VehicleId, RowState, String)> {
        let entry = self
            .ledger
            .entries()
            .rev()
            .find(|entry| entry.verb.name == verb);
        let rows = entry.into_iter().flat_map(|entry| &entry.rows);
        rows.map(|row| {
            let why = row.explanation.as_ref().map(ToString::to_string);
            (row.vehicle, row.state, why.unwrap_or_default())
        })
        .collect()
    }

    fn is_done(&self, verb: &str) -> bool {
        let rows = self.rows(verb);
        !rows.is_empty() && rows.iter().all(|(_, state, _)| *state == RowState::Done)
    }
}
