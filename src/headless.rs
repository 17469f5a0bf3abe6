//! A mission flown by a pilot script.
//!
//! Sessions, pilot, mission and scoring are the same whatever flies: the embedded simulator in lock step and without
//! a clock ([`Exercise`], whose outcome depends on the mission, the seed and the script alone), or vehicles that keep
//! time themselves, behind byte streams ([`Live`]).

use std::sync::Arc;
use std::time::Duration;

use crate::language::Script;
use crate::mission::{Flight, Mission, Report as MissionReport, TICK, is_due};
use crate::notice::Notice;
use crate::sim::{Airframe, PortId, World};

mod crew;
mod live;
mod playthrough;
#[cfg(test)]
mod tests;

use crew::Crew;
pub use live::Live;
pub use playthrough::{Lap, Playthrough};

/// How often sessions look at their deadlines.
const SESSION_POLL: Duration = Duration::from_millis(50);
/// How often a ground station says that it is there.
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);

/// A flight in the embedded simulator, in steps of simulated time.
pub struct Exercise {
    world: World,
    ports: Vec<PortId>,
    crew: Crew,
    bytes: Vec<u8>,
}

impl Exercise {
    /// Puts the mission's vehicles on their pads: all of the first airframe or one each, the last one for all that
    /// follow; without any, the drones that were built for it, or the simulator's own.
    pub fn new(
        mission: Arc<Mission>,
        seed: u64,
        script: Script,
        airframes: Vec<Arc<Airframe>>,
    ) -> Self {
        let mut config = mission.world(seed);
        if !airframes.is_empty() {
            config.airframes = airframes;
        }
        let mut world = World::new(&config);
        let vehicles = world.vehicles();
        Self {
            ports: (0..vehicles).map(|index| world.connect(index)).collect(),
            crew: Crew::new(mission, seed, script, vehicles),
            world,
            bytes: Vec::new(),
        }
    }

    /// The time since the mission began.
    pub fn now(&self) -> Duration {
        self.world.now()
    }

    /// Whether the mission has come to its end.
    pub fn is_over(&self) -> bool {
        self.crew.is_over()
    }

    /// The flight, for what concerns its try and its record.
    pub fn flight_mut(&mut self) -> &mut Flight {
        self.crew.flight_mut()
    }

    /// The result, everything explained, and the end of the record.
    pub fn close(&mut self) -> MissionReport {
        self.crew.close()
    }

    /// The result so far, everything explained.
    pub fn report(&self) -> MissionReport {
        self.crew.report()
    }

    /// What was said so far, oldest first; it is gone from the exercise then.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        self.crew.take_notices()
    }

    /// Advances by one step of the simulator.
    pub fn step(&mut self) {
        self.world.step();
        let now = self.world.now();
        for index in 0..self.ports.len() {
            self.exchange(index, now);
        }
        if is_due(now, TICK) {
            self.crew.fly(now);
        }
    }

    /// Carries bytes both ways between a vehicle and its session.
    fn exchange(&mut self, index: usize, now: Duration) {
        let port = &mut self.ports[index];
        if !self.world.is_open(*port) {
            // The vehicle has rebooted; its connection is made again, as a real one would be.
            self.world.disconnect(*port);
            *port = self.world.connect(index);
        }
        self.bytes.clear();
        self.world.take_output(*port, &mut self.bytes);
        self.crew.push(index, &self.bytes);
        while self.crew.hear(index, now) {}
        if is_due(now, SESSION_POLL) {
            self.crew.poll(index, now);
        }
        self.bytes.clear();
        if is_due(now, HEARTBEAT_EVERY) {
            self.crew.say_heartbeat(index, &mut self.bytes);
        }
        self.crew.say(index, &mut self.bytes);
        if !self.bytes.is_empty() {
            self.world.receive(*port, &self.bytes);
        }
        self.crew.note(index);
    }
}
