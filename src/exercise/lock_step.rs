//! A mission in the embedded simulator.

use std::sync::Arc;
use std::time::Duration;

use super::{Exercise, FlightDriver, FlightPace};
use crate::language::Script;
use crate::mission::{Flight, Mission};
use crate::record::{InputLog, InputsHead};
use crate::sim::{Airframe, PortId, World};

/// The embedded simulator, stepped together with the mission: a flight takes only its computing time.
#[derive(Debug)]
pub struct LockStep {
    world: World,
    ports: Vec<PortId>,
    bytes: Vec<u8>,
    head: InputsHead,
    inputs: Option<InputLog>,
}

impl Exercise {
    /// Puts the mission's vehicles on their pads. Airframes apply to the vehicles in order, the
    /// last one to all further vehicles. Without airframes they are the drones built for the
    /// mission, or the simulator's default.
    pub fn new(
        mission: Arc<Mission>,
        seed: u64,
        script: Script,
        airframes: Vec<Arc<Airframe>>,
    ) -> Self {
        let mut config = mission.world(seed);
        let head = InputsHead::of(&config, &airframes);
        if !airframes.is_empty() {
            config.airframes = airframes;
        }
        let mut world = World::new(&config);
        let vehicles = world.vehicles();
        let link = LockStep {
            ports: (0..vehicles).map(|index| world.connect(index)).collect(),
            world,
            bytes: Vec::new(),
            head,
            inputs: None,
        };
        let mut driver = FlightDriver::new(Flight::new(mission, seed), FlightPace::Simulated);
        driver.begin_when_heard(Duration::ZERO, true);
        Self::on(link, driver, script, vehicles)
    }

    /// Records the inputs of the simulated vehicles; must be called before the first step.
    pub fn record_inputs(&mut self) {
        let LockStep {
            world, ports, head, ..
        } = &mut self.link;
        self.link.inputs = Some(InputLog::begin(head, world, ports));
    }

    /// The complete lines of inputs since the last call.
    pub fn take_inputs(&mut self) -> String {
        let inputs = self.link.inputs.as_mut();
        inputs.map_or_else(String::new, InputLog::take)
    }

    /// Ends the record of the inputs.
    pub fn close_inputs(&mut self) {
        let LockStep { world, inputs, .. } = &mut self.link;
        if let Some(inputs) = inputs {
            inputs.end(world);
        }
    }

    /// Advances by one step of the simulator.
    pub fn step(&mut self) {
        self.link.step();
        let now = self.link.world.now();
        for index in 0..self.seats.len() {
            self.exchange(index, now);
        }
        let time = self.driver.advance(now, []);
        self.fly_until(time);
    }

    /// Exchanges bytes between a vehicle and its session.
    fn exchange(&mut self, index: usize, now: Duration) {
        let port = self.link.open_port(index);
        let LockStep { world, bytes, .. } = &mut self.link;
        let seat = &mut self.seats[index];
        bytes.clear();
        world.take_output(port, bytes);
        seat.decoder.push(bytes);
        while seat.hear(now, self.log.as_mut()) {}
        seat.poll(now, self.log.as_mut());
        seat.send(now, self.log.as_mut());
        if !seat.outgoing.is_empty() {
            world.receive(port, &seat.outgoing);
            seat.outgoing.clear();
        }
        self.take_reports(index, now);
    }
}

impl LockStep {
    fn step(&mut self) {
        self.world.step();
        if let Some(inputs) = &mut self.inputs {
            inputs.follow(&mut self.world);
        }
    }

    /// A vehicle's connection; after a reboot of the vehicle it is opened again.
    fn open_port(&mut self, index: usize) -> PortId {
        let port = &mut self.ports[index];
        if !self.world.is_open(*port) {
            self.world.disconnect(*port);
            *port = self.world.connect(index);
        }
        *port
    }
}
