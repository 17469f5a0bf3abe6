//! Simulated `ArduCopters` and `ArduRovers` with `MAVLink`, stepped by the caller: for tests of ground stations and
//! of other programs.
//!
//! A [`World`] holds vehicles. Ground stations [`connect`](World::connect) to one of them, push
//! bytes in and take bytes out; nothing else goes in or out, so a program cannot tell the simulator
//! from a SITL behind a socket. There is no clock, no thread, no file and no socket: the world is a
//! function of its configuration, the bytes it received and the [steps](World::step) of 10 ms
//! between them. Behaviour and figures follow `ArduPilot` 4.6 SITLs: modes, arming checks,
//! failsafes, fences, plans, parameters, files, logs, signing, faults of sensors and motors, wind.
//!
//! ```
//! use sortie_sim::geo::LatLon;
//! use sortie_sim::wire::{Content, Decoder};
//! use sortie_sim::{Start, World, WorldConfig};
//!
//! let start = Start {
//!     at: LatLon::new(50.4501, 30.5234),
//!     altitude_amsl_m: 170.0,
//!     heading_deg: 90.0,
//! };
//! let mut world = World::new(&WorldConfig::row(1, start));
//! let port = world.connect(0);
//! let mut decoder = Decoder::new();
//! let mut heard = 0;
//! for _ in 0..500 {
//!     world.step();
//!     let mut bytes = Vec::new();
//!     world.take_output(port, &mut bytes);
//!     decoder.push(&bytes);
//!     while let Some(frame) = decoder.next_frame() {
//!         assert!(matches!(frame.content, Content::Message(_)));
//!         heard += 1;
//!     }
//! }
//! // A heartbeat per second, and home once the position is known.
//! assert!(heard >= 5);
//! assert!(!world.truth(0).armed);
//! ```
//!
//! `examples/takeoff.rs` arms the vehicle, takes off and reads its position, as a test of another
//! program would.
//!
//! # How the parts fit
//! The modules in order from the bottom up. A module uses only those before it, and no two modules
//! use each other.
//!
//! - `kind` (copter or rover). The physics: `kinematics`, `airframe`, `battery`, `wind`, `wheels` (of rovers),
//!   `body`; `upset` and `mixer` after the loss of a motor.
//! - Facts: `config` (the content of a world), `parameters`, `mode`, `cmd`, `frame` and `mask` (the
//!   numbers of MAVLink), `plan` (lists of items), `place` (points and places on the earth),
//!   `leader` (the vehicle to follow), `radio` (sticks), `texts`, `payload`.
//! - Parts that own their state, get the state of others as arguments, and return their requests
//!   (`reaction`): `estimator` (the estimated motion), `control` and `yaw` (the path and the
//!   heading), `helm` (the steering of rovers), `task` (the current task, with a cockpit lent to it), `trail`, `rally`, `fence`,
//!   `boot`, `arming`, `failsafe`, `crash`, `counters`, `workbench` (tests on the ground),
//!   `output_test` (that of a rover), `flight_log`. `tuning` holds their parameters in SI units.
//! - `vehicle` combines all that flies; `auto_plan` flies the mission of AUTO with it; `autopilot`
//!   decides, and steps all parts in order. Its `telemetry` builds the messages.
//! - Ground stations: `commands`, `guided` (setpoints) and `transfer` (lists, files, logs) carry
//!   out their requests; `inbound` reads them. `schedule`, `signing`, `link` and `port` connect
//!   them; `slot` is a vehicle with its connections, `truth` its true state. `collision` finds
//!   collisions. `input` describes the inputs of a world, from which a flight can be repeated;
//!   `fingerprint` hashes a vehicle's state, to compare two flights; `inventory` lists what a
//!   vehicle has.

#![warn(missing_docs)]

mod adsb;
mod airframe;
mod arming;
mod auto_plan;
mod autopilot;
mod battery;
mod body;
mod boot;
mod cmd;
mod collision;
mod commands;
mod config;
mod control;
mod counters;
mod crash;
mod estimator;
mod failsafe;
mod fence;
mod fingerprint;
mod flight_log;
mod frame;
mod guided;
mod helm;
mod inbound;
mod input;
mod inventory;
mod kind;
mod kinematics;
mod leader;
mod link;
mod mask;
mod mixer;
mod mode;
mod operator;
mod output_test;
mod parameters;
mod payload;
mod place;
mod plan;
mod port;
mod radio;
mod rally;
mod reaction;
mod schedule;
mod signing;
mod slot;
mod task;
mod texts;
mod trail;
mod transfer;
mod truth;
mod tuning;
mod upset;
mod vehicle;
mod wheels;
mod wind;
mod workbench;
mod yaw;

#[cfg(test)]
mod tests;

use std::time::Duration;

pub use mavlink;
pub use sortie_geo as geo;
pub use sortie_wire as wire;

pub use self::airframe::{Airframe, AirframeError, SEA_LEVEL_DENSITY};
use self::autopilot::Autopilot;
pub use self::battery::resting_voltage_v;
use self::collision::Collisions;
pub use self::collision::{Collision, Met, Obstacle, Placement, Shape};
pub use self::config::{BootPace, Serial, Start, WorldConfig};
pub use self::input::{Input, InputKind};
pub use self::inventory::Inventory;
pub use self::kind::{Chassis, VehicleKind};
pub use self::kinematics::GRAVITY_M_S2;
pub use self::parameters::{AliasSense, other_name};
use self::plan::{Item, ListKind};
use self::slot::VehicleSlot;
pub use self::truth::Truth;
pub use self::wheels::RunningGear;
use self::wind::Wind;

/// The fixed time step of [`World::step`].
pub const STEP: Duration = Duration::from_millis(10);
/// Vehicles have the system ids 1 to 254 (255 is the ground station's); further vehicles begin again at 1 and can
/// only be told apart by their ports.
pub const SYSTEMS: usize = 254;

/// A connection of a ground station to a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PortId {
    vehicle: usize,
    number: u64,
}

impl PortId {
    /// The id of a connection from its number and vehicle, for addressing it in another world that has the same inputs.
    pub fn numbered(vehicle: usize, number: u64) -> Self {
        Self { vehicle, number }
    }

    /// The vehicle, counted from 0.
    pub fn vehicle(self) -> usize {
        self.vehicle
    }

    /// The number of the connection: the world counts them from 0, over all vehicles.
    pub fn number(self) -> u64 {
        self.number
    }
}

/// Vehicles, and the ground stations connected to them.
#[derive(Debug, Clone)]
pub struct World {
    slots: Vec<VehicleSlot>,
    next_port: u64,
    connections: usize,
    steps: u64,
    collisions: Collisions,
    /// The inputs that have not been taken yet; `None` if inputs are not kept.
    inputs: Option<Vec<Input>>,
}

impl World {
    /// Switches the vehicles on. Beyond 254 vehicles the system ids begin again at 1.
    pub fn new(config: &WorldConfig) -> Self {
        let usual = Airframe::shared_standard();
        let mut slots: Vec<VehicleSlot> = Vec::with_capacity(config.starts.len());
        for (vehicle, start) in config.starts.iter().enumerate() {
            let system = (vehicle % SYSTEMS) as u8 + 1;
            let airframe = config.airframe(vehicle, &usual);
            let wind = Wind::new(config.seed, vehicle as u64);
            let fresh = Autopilot::new(config.kind(vehicle), system, *start, airframe, wind);
            let mut autopilot = match config.boot {
                BootPace::Over => fresh.switched_on_long_ago(),
                BootPace::Quick => fresh,
                BootPace::Realistic => fresh.booting_realistically(),
            };
            if let Some(before) = slots.last() {
                autopilot.vehicle.share_tuning(&before.autopilot.vehicle);
            }
            slots.push(VehicleSlot::new(autopilot));
        }
        Self {
            slots,
            next_port: 0,
            connections: 0,
            steps: 0,
            collisions: Collisions::new(config.starts.first().copied(), &config.obstacles),
            inputs: None,
        }
    }

    /// Starts to keep all inputs, for [`take_inputs`](Self::take_inputs).
    pub fn keep_inputs(&mut self) {
        self.inputs.get_or_insert_default();
    }

    /// Removes and returns the inputs since the last call, in order; empty without [`keep_inputs`](Self::keep_inputs).
    pub fn take_inputs(&mut self) -> Vec<Input> {
        self.inputs.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Repeats an input that was recorded in another world. Two worlds fly identically if they have
    /// the same configuration, get the same inputs after the same steps, and their outputs are
    /// taken after each step. Returns `false` if the vehicle does not exist, or if a new connection
    /// would get a different number here.
    pub fn enter(&mut self, input: &Input) -> bool {
        let port = PortId {
            vehicle: input.vehicle,
            number: input.connection,
        };
        if input.vehicle >= self.slots.len() {
            return false;
        }
        match &input.what {
            InputKind::Connected(serial) => return self.connect_to(input.vehicle, *serial) == port,
            InputKind::Disconnected => self.disconnect(port),
            InputKind::Bytes(bytes) => self.receive(port, bytes),
        }
        true
    }

    /// The number of steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// A hash of the whole state of a vehicle, counted from 0. Vehicles that differ in any state
    /// that determines how their flight continues have different hashes, except with a probability
    /// of 1 in 2^64.
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) returns their number).
    pub fn fingerprint(&self, vehicle: usize) -> u64 {
        self.slots[vehicle].fingerprint()
    }

    /// The value of a parameter of a vehicle, counted from 0; 0 if there is no such parameter.
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) returns their number).
    pub fn parameter(&self, vehicle: usize, name: &str) -> f64 {
        self.slots[vehicle].autopilot.vehicle.parameters.value(name)
    }

    /// The value of a parameter of a vehicle, counted from 0, if it has such a parameter.
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) returns their number).
    pub fn find_parameter(&self, vehicle: usize, name: &str) -> Option<f64> {
        let found = self.slots[vehicle].autopilot.vehicle.parameters.named(name);
        found.map(|parameter| f64::from(parameter.value))
    }

    fn keep(&mut self, port: PortId, what: impl FnOnce() -> InputKind) {
        if let Some(inputs) = &mut self.inputs {
            inputs.push(Input {
                step: self.steps,
                vehicle: port.vehicle,
                connection: port.number,
                what: what(),
            });
        }
    }

    /// Puts a list on board a vehicle, counted from 0, by the rules of an upload: the items of a plan are numbered
    /// from 1 there. Returns `false` if the vehicle refuses an item. This is not an [input](Self::take_inputs).
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) returns their number).
    pub fn load(&mut self, vehicle: usize, kind: ListKind, items: &[Item]) -> bool {
        let home = Item {
            command: sortie_plan::command::WAYPOINT,
            ..Item::default()
        };
        let list: Vec<Item> = match kind {
            ListKind::Plan => std::iter::once(home).chain(items.iter().copied()).collect(),
            ListKind::Fence | ListKind::Rally => items.to_vec(),
        };
        transfer::load(&mut self.slots[vehicle].autopilot, kind, &list)
    }

    /// The number of vehicles.
    pub fn vehicles(&self) -> usize {
        self.slots.len()
    }

    /// Simulated time since the world began.
    pub fn now(&self) -> Duration {
        STEP * u32::try_from(self.steps).unwrap_or(u32::MAX)
    }

    /// Makes serial 0 of a signing vehicle drop unsigned packets, as its other ports do.
    pub fn require_signatures(&mut self) {
        for slot in &mut self.slots {
            slot.require_signatures();
        }
    }

    /// Gives the vehicles other board ids, which depend on `place` alone: two worlds of the same seed then differ, and
    /// each has the same ids in every run. To be called before the first step.
    pub fn mark_boards(&mut self, place: u64) {
        for slot in &mut self.slots {
            let own = &mut slot.autopilot.vehicle.board_id;
            *own ^= place.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        }
    }

    /// Gives the vehicles operator control, which the real vehicle lacks: they announce the ground station in control,
    /// and refuse the commands of others.
    pub fn announce_control(&mut self) {
        for slot in &mut self.slots {
            slot.autopilot.operator = Some(Box::default());
        }
    }

    /// Attaches a ground station to serial 0 of a vehicle, counted from 0. A port to a vehicle that does not exist
    /// is closed from the start.
    pub fn connect(&mut self, vehicle: usize) -> PortId {
        self.connect_to(vehicle, Serial::Zero)
    }

    /// Attaches a ground station to a serial port of a vehicle, counted from 0. Ground stations on the same serial
    /// port get the same telemetry, at the rates that any of them has requested; rates last until the vehicle reboots,
    /// even without ground stations. Answers go only to the requesting ground station.
    pub fn connect_to(&mut self, vehicle: usize, serial: Serial) -> PortId {
        let number = self.next_port;
        self.next_port += 1;
        if let Some(slot) = self.slots.get_mut(vehicle) {
            slot.connect(number, serial);
            self.connections += 1;
        }
        let port = PortId { vehicle, number };
        self.keep(port, || InputKind::Connected(serial));
        port
    }

    /// Detaches a ground station. The vehicle flies on.
    pub fn disconnect(&mut self, port: PortId) {
        self.keep(port, || InputKind::Disconnected);
        let slot = self.slots.get_mut(port.vehicle);
        if slot.is_some_and(|slot| slot.disconnect(port.number)) {
            self.connections -= 1;
        }
    }

    /// A copy with its ground stations, which keeps no inputs. With the same inputs, it flies as this world does.
    #[must_use]
    pub fn copy(&self) -> Self {
        Self {
            inputs: None,
            ..self.clone()
        }
    }

    /// The number of attached ground stations.
    pub fn connections(&self) -> usize {
        self.connections
    }

    /// Whether the connection is open; a vehicle that reboots drops its connections.
    pub fn is_open(&self, port: PortId) -> bool {
        self.slots
            .get(port.vehicle)
            .is_some_and(|slot| slot.is_open(port.number))
    }

    /// Hands bytes to the vehicle, which handles them at once: the answers are ready for
    /// [`take_output`](Self::take_output).
    pub fn receive(&mut self, port: PortId, bytes: &[u8]) {
        self.keep(port, || InputKind::Bytes(bytes.to_vec()));
        if let Some(slot) = self.slots.get_mut(port.vehicle) {
            slot.receive(port.number, bytes);
        }
    }

    /// Advances every vehicle by [`STEP`] and sends the messages that are due.
    pub fn step(&mut self) {
        self.steps += 1;
        Part(&mut self.slots).step();
        self.collide();
    }

    /// [`World::step`] in parts that do not touch each other, so that `run` can step them at the same time. The
    /// outcome is the same for any number of parts and any order. The vehicles of a part that is not stepped do not
    /// move.
    pub fn step_in_parts(&mut self, parts: usize, run: impl FnOnce(Vec<Part<'_>>)) {
        self.steps += 1;
        let size = self.slots.len().div_ceil(parts.max(1)).max(1);
        run(self.slots.chunks_mut(size).map(Part).collect());
        self.collide();
    }

    /// The collisions so far, in order.
    pub fn collisions(&self) -> &[Collision] {
        self.collisions.events()
    }

    fn collide(&mut self) {
        let now = self.now();
        let autopilots = self.slots.iter().map(|slot| &slot.autopilot);
        for hit in self.collisions.find(now, autopilots) {
            if let Some(slot) = self.slots.get_mut(hit.vehicle) {
                slot.autopilot.vehicle.plant.body.take(hit);
            }
        }
    }

    /// Moves the bytes that wait for a ground station to the end of `into`. At most 256 KiB wait; beyond that whole
    /// frames are lost, telemetry first.
    pub fn take_output(&mut self, port: PortId, into: &mut Vec<u8>) {
        if let Some(slot) = self.slots.get_mut(port.vehicle) {
            slot.take_output(port.number, into);
        }
    }

    /// Simulated seconds per second, if a ground station has requested that from a vehicle (`SIM_SPEEDUP` other than
    /// 1). The world cannot set its own pace: the caller that steps it should do that.
    pub fn wanted_speedup(&self) -> Option<f64> {
        self.slots
            .iter()
            .map(|slot| slot.autopilot.vehicle.tuning.faults.speedup)
            .find(|speedup| *speedup > 0.0 && (*speedup - 1.0).abs() > f64::EPSILON)
    }

    /// The true state of a vehicle, counted from 0.
    ///
    /// # Panics
    /// If there is no such vehicle ([`vehicles`](Self::vehicles) returns their number).
    pub fn truth(&self, vehicle: usize) -> Truth {
        Truth::of(&self.slots[vehicle].autopilot)
    }
}

/// Some of the vehicles of a world: see [`World::step_in_parts`].
#[derive(Debug)]
pub struct Part<'a>(&'a mut [VehicleSlot]);

impl Part<'_> {
    /// Advances these vehicles by [`STEP`] and sends the messages that are due.
    pub fn step(self) {
        for slot in self.0 {
            slot.step();
        }
    }
}
