//! A simple vehicle for tests: it flies in straight lines and reports like a copter.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{Flight, Mission, Report, TICK};
use crate::geo::LatLon;
use crate::language::{self, Context, Meaning};
use crate::ledger::{Given, Ledger, RowState, RowUpdate};
use crate::vehicle::{
    Battery, GlobalPosition, Heartbeat, LandedState, Mode, Severity, StatusText, SystemStatus,
    Vehicle, VehicleClass, Vehicles,
};

/// The ends of the lines through all nine cells, north and east; the turns are outside the cells.
pub(crate) const ROUTE: [(f64, f64); 6] = [
    (40.0, -35.0),
    (40.0, 35.0),
    (60.0, 35.0),
    (60.0, -35.0),
    (80.0, -35.0),
    (80.0, 35.0),
];

/// A line as typed in the console.
pub(crate) fn given(line: &str) -> Given<'_> {
    let statement = language::parse(line, &Context::default()).expect("a good line");
    let Meaning::Act(act) = statement.meaning else {
        panic!("{line} is no order");
    };
    Given {
        line,
        verb: statement.verb,
        risk: act.risk(),
        by: None,
    }
}

/// A flight with one vehicle.
pub(crate) struct Pilot {
    pub flight: Flight,
    pub ledger: Ledger,
    pub now: Duration,
    pub disarmed_at: Option<Duration>,
    vehicles: Vehicles,
    /// Metres north, east and up.
    position_m: [f64; 3],
    armed_s: f64,
}

impl Pilot {
    pub fn new(seed: u64) -> Self {
        let mission =
            Mission::parse(include_str!("../../missions/01-air-sample.toml")).expect("it is good");
        Self::flying(mission, seed)
    }

    /// A vehicle on the first pad of a mission.
    pub fn flying(mission: Mission, seed: u64) -> Self {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.landed = LandedState::OnGround;
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: 2,
            autopilot: 3,
            class: VehicleClass::Copter,
            mode: Mode {
                class: VehicleClass::Copter,
                number: 4,
            },
            armed: false,
            status: SystemStatus::Standby,
            at: Duration::ZERO,
        });
        let mut pilot = Self {
            flight: Flight::new(Arc::new(mission), seed),
            ledger: Ledger::new(),
            now: Duration::ZERO,
            disarmed_at: None,
            vehicles: BTreeMap::from([(1, Arc::new(vehicle))]),
            position_m: [0.0; 3],
            armed_s: 0.0,
        };
        pilot.report_state([0.0; 3]);
        pilot
    }

    pub fn report(&self) -> Report {
        self.flight.report(&self.ledger)
    }

    pub fn tick(&mut self) {
        self.flight.step(self.now, &self.vehicles, &self.ledger);
        self.now += TICK;
        if self.vehicles[&1].armed() {
            self.armed_s += TICK.as_secs_f64();
        }
    }

    pub fn wait(&mut self, seconds: f64) {
        for _ in 0..(seconds / TICK.as_secs_f64()) as u32 {
            self.tick();
        }
    }

    pub fn set_armed(&mut self, armed: bool) {
        let vehicle = self.vehicle();
        vehicle
            .heartbeat
            .as_mut()
            .expect("there from the start")
            .armed = armed;
    }

    pub fn set_mode(&mut self, name: &str) {
        let vehicle = self.vehicle();
        let heartbeat = vehicle.heartbeat.as_mut().expect("there from the start");
        heartbeat.mode = VehicleClass::Copter.mode(name).expect("a mode");
    }

    pub fn command(&mut self, line: &str, state: RowState) {
        let entry = self.ledger.open(self.now, given(line), &[1]);
        self.ledger.apply(&RowUpdate {
            entry,
            vehicle: 1,
            state,
            tries: 1,
            at: self.now,
            explanation: None,
        });
    }

    pub fn vehicle(&mut self) -> &mut Vehicle {
        Arc::make_mut(self.vehicles.get_mut(&1).expect("there from the start"))
    }

    pub fn hear(&mut self, text: &str) {
        let at = self.now;
        self.vehicle().texts.push(StatusText {
            severity: Severity::Warning,
            text: text.to_owned(),
            at,
        });
        self.tick();
    }

    pub fn take_off(&mut self, height_m: f64) {
        self.wait(2.0);
        self.command("1 arm", RowState::Done);
        self.set_armed(true);
        self.wait(1.0);
        self.set_landed(LandedState::InAir);
        self.fly_to([self.position_m[0], self.position_m[1], height_m], 2.5);
    }

    pub fn goto(&mut self, north_m: f64, east_m: f64, speed_m_s: f64) {
        self.fly_to([north_m, east_m, self.position_m[2]], speed_m_s);
    }

    /// Flies to a place and passes it without slowing down.
    pub fn cross(&mut self, north_m: f64, east_m: f64, speed_m_s: f64) {
        self.goto(north_m, east_m, speed_m_s);
        self.report_state([speed_m_s, 0.0, 0.0]);
        self.tick();
    }

    pub fn survey(&mut self) {
        self.goto(ROUTE[0].0, ROUTE[0].1, 10.0);
        for (north, east) in ROUTE {
            self.command(&format!("1 goto n {north} e {east}"), RowState::Done);
            self.goto(north, east, 3.5);
            self.wait(2.0);
        }
    }

    /// Flies above the middle cell and waits there, for a look from above.
    pub fn look_above(&mut self) {
        self.fly_to([60.0, 0.0, 36.0], 10.0);
        self.wait(7.0);
    }

    pub fn land(&mut self) {
        self.fly_to([self.position_m[0], self.position_m[1], 10.0], 1.5);
        self.fly_to([self.position_m[0], self.position_m[1], 0.0], 0.5);
        self.wait(2.0);
        self.set_landed(LandedState::OnGround);
        self.set_armed(false);
        self.disarmed_at = Some(self.now);
        for _ in 0..100 {
            if self.flight.is_over() {
                return;
            }
            self.tick();
        }
    }

    pub fn set_landed(&mut self, landed: LandedState) {
        self.vehicle().landed = landed;
    }

    fn fly_to(&mut self, to: [f64; 3], speed_m_s: f64) {
        loop {
            let step: [f64; 3] = std::array::from_fn(|axis| to[axis] - self.position_m[axis]);
            let distance = step.iter().map(|s| s * s).sum::<f64>().sqrt();
            let reach = speed_m_s * TICK.as_secs_f64();
            let share = if distance <= reach {
                1.0
            } else {
                reach / distance
            };
            for (position, step) in self.position_m.iter_mut().zip(step) {
                *position += share * step;
            }
            self.report_state(step.map(|s| s * share / TICK.as_secs_f64()));
            self.tick();
            if distance <= reach {
                self.report_state([0.0; 3]);
                return;
            }
        }
    }

    fn report_state(&mut self, velocity_m_s: [f64; 3]) {
        let start = self.flight.mission().starts()[0];
        let vehicle = Arc::make_mut(self.vehicles.get_mut(&1).expect("there from the start"));
        let [north, east, up] = self.position_m;
        vehicle.global = Some(GlobalPosition {
            at_point: at_point(start.at.moved(north, east)),
            altitude_amsl_m: millimetres(start.altitude_amsl_m + up),
            altitude_m: millimetres(up),
            north_m_s: centimetres(velocity_m_s[0]),
            east_m_s: centimetres(velocity_m_s[1]),
            down_m_s: centimetres(-velocity_m_s[2]),
            heading_deg: None,
            at: self.now,
        });
        // The default battery: 3300 mAh, 12.6 V, 468 mAh a minute in the air.
        let used_mah = self.armed_s / 60.0 * 468.0;
        vehicle.batteries = vec![Battery {
            id: 0,
            voltage_v: Some(12.6),
            current_a: None,
            consumed_mah: Some(used_mah.round() as f32),
            consumed_wh: None,
            remaining_percent: Some((100.0 - used_mah / 33.0).max(0.0) as u8),
            at: self.now,
        }];
    }
}

/// A place, rounded as in a message.
fn at_point(place: LatLon) -> LatLon {
    let (lat, lon) = place.to_e7();
    LatLon::from_e7(lat, lon)
}

fn millimetres(metres: f64) -> f64 {
    (metres * 1e3).round() * 1e-3
}

fn centimetres(metres: f64) -> f32 {
    (metres * 100.0).round() as f32 * 0.01
}

/// The whole mission as the reference pilot flies it.
pub(crate) fn fly_the_cells(seed: u64) -> Pilot {
    let mut pilot = Pilot::new(seed);
    pilot.take_off(20.0);
    pilot.survey();
    pilot.look_above();
    pilot.goto(0.0, 0.0, 10.0);
    pilot.wait(5.0);
    pilot.land();
    pilot
}

/// Arms, and waits until the mission is over.
pub(crate) fn do_nothing() -> Pilot {
    let mut pilot = Pilot::new(1);
    pilot.wait(2.0);
    pilot.command("1 arm", RowState::Done);
    pilot.set_armed(true);
    pilot.wait(10.0);
    pilot.set_armed(false);
    while !pilot.flight.is_over() {
        pilot.tick();
    }
    pilot
}
