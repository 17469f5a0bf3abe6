//! A mission on vehicles that keep time themselves.

use std::sync::Arc;
use std::time::Duration;

use super::{Crew, HEARTBEAT_EVERY, SESSION_POLL, is_due};
use crate::language::Script;
use crate::mission::{Clock, Mission, Report as MissionReport, TICK};
use crate::notice::Notice;

/// A mission does not wait longer than this for vehicles to be heard.
const HEARD_WITHIN: Duration = Duration::from_secs(10);

/// A flight on vehicles behind byte streams: SITL processes.
///
/// All runs on mission time, which is how far the vehicles' own clocks have come as their messages tell it
/// ([`Clock`]): waits and limits of the pilot and the mission, and the deadlines of commands as well. A vehicle's
/// answer and its clock come along the same way, so a deadline in its time stays right at any speed, and neither a
/// simulator nor a console that is late makes a command fail. Many messages that come at once are taken one by one, with
/// the mission's ticks between them.
pub struct Live {
    crew: Crew,
    clock: Clock,
    /// When the first bytes came, and whether the mission has begun.
    opened: Option<Duration>,
    begun: bool,
    /// Up to where sessions, pilot and mission have come.
    stepped: Duration,
    /// What is to be sent to each vehicle.
    outgoing: Vec<Vec<u8>>,
    lost: Vec<bool>,
}

impl Live {
    /// A mission that begins once all vehicles are heard: until then its time stands still. `speedup` is what the vehicles were asked for.
    pub fn new(mission: Arc<Mission>, seed: u64, script: Script, speedup: f64) -> Self {
        let vehicles = mission.vehicles;
        let mut crew = Crew::new(mission, seed, script, vehicles);
        let mut outgoing = vec![Vec::new(); vehicles];
        for (index, bytes) in outgoing.iter_mut().enumerate() {
            crew.say_heartbeat(index, bytes);
        }
        Self {
            crew,
            clock: Clock::new(speedup),
            opened: None,
            begun: false,
            stepped: Duration::ZERO,
            outgoing,
            lost: vec![false; vehicles],
        }
    }

    /// The time since the mission began, by the vehicles' clocks.
    pub fn now(&self) -> Duration {
        self.clock.elapsed()
    }

    /// Mission seconds per second, as it went last.
    pub fn rate(&self) -> f64 {
        self.clock.rate()
    }

    /// Whether the mission has come to its end.
    pub fn is_over(&self) -> bool {
        self.crew.is_over()
    }

    /// The result so far, everything explained.
    pub fn report(&self) -> MissionReport {
        self.crew.report()
    }

    /// What was said so far, oldest first; it is gone then.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        self.crew.take_notices()
    }

    /// Takes in what a vehicle said, at a time of ours.
    pub fn hear(&mut self, index: usize, bytes: &[u8], now: Duration) {
        self.crew.push(index, bytes);
        while !self.is_over() && self.crew.hear(index, self.clock.elapsed()) {
            if self.has_begun(now) {
                let vehicle = self.crew.vehicle(index);
                let reading = (vehicle.id, vehicle.boot_ms);
                self.clock.step(now, [reading]);
                self.catch_up();
            }
        }
        self.gather();
    }

    /// Lets time of ours pass: vehicles that are silent do not stop the mission for ever.
    pub fn pass(&mut self, now: Duration) {
        if self.has_begun(now) {
            self.clock.step(now, []);
            self.catch_up();
        }
        self.gather();
    }

    /// A vehicle is no more: its process has ended and will not be started again.
    pub fn lose(&mut self, index: usize) {
        if !std::mem::replace(&mut self.lost[index], true) {
            self.crew.lose(index);
        }
    }

    /// What is to be sent to a vehicle; it is gone then.
    pub fn take_output(&mut self, index: usize) -> Vec<u8> {
        std::mem::take(&mut self.outgoing[index])
    }

    /// Whether all are heard, or have had the time to be: a pilot must not command one whose mode is not known yet.
    fn has_begun(&mut self, now: Duration) -> bool {
        let opened = *self.opened.get_or_insert(now);
        let is_heard = |index| {
            let vehicle = self.crew.vehicle(index);
            vehicle.heartbeat.is_some() && vehicle.boot_ms.is_some()
        };
        self.begun = self.begun
            || (0..self.lost.len()).all(is_heard)
            || now.saturating_sub(opened) >= HEARD_WITHIN;
        self.begun
    }

    /// Sessions, pilot and mission follow the clock, in the steps that they have in the embedded simulator.
    fn catch_up(&mut self) {
        while self.stepped + SESSION_POLL <= self.clock.elapsed() && !self.is_over() {
            self.stepped += SESSION_POLL;
            for (index, bytes) in self.outgoing.iter_mut().enumerate() {
                self.crew.poll(index, self.stepped);
                if is_due(self.stepped, HEARTBEAT_EVERY) {
                    self.crew.say_heartbeat(index, bytes);
                }
                self.crew.note(index);
            }
            if is_due(self.stepped, TICK) {
                self.crew.fly(self.stepped);
            }
        }
    }

    fn gather(&mut self) {
        for (index, bytes) in self.outgoing.iter_mut().enumerate() {
            self.crew.note(index);
            self.crew.say(index, bytes);
        }
    }
}
