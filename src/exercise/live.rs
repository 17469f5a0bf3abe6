//! A mission on vehicles that keep time themselves.

use std::sync::Arc;
use std::time::Duration;

use super::{Crew, HEARTBEAT_EVERY, SESSION_POLL};
use crate::language::Script;
use crate::mission::{Clock, Flight, HEARD_WITHIN, Mission, Report as MissionReport, TICK, is_due};
use crate::notice::Notice;
use crate::vehicle::VehicleId;

/// A flight on vehicles behind byte streams: SITL processes.
///
/// All runs on mission time, which is how far the vehicles' own clocks have come as their messages tell it
/// ([`Clock`]): waits and limits of the pilot and the mission, and the deadlines of commands as well. A vehicle's
/// answer and its clock come along the same way, so a deadline in its time stays right at any speed, and neither a
/// simulator nor a console that is late makes a command fail. Many messages that come at once are taken one by one, with
/// the mission's ticks between them.
pub struct Live {
    crew: Crew,
    /// Mission time.
    clock: Clock,
    /// When time of ours passed first.
    opened: Option<Duration>,
    /// For how long the sessions had talked when the mission began.
    prelude: Option<Duration>,
    /// Up to where sessions have come, and after the prelude pilot and mission.
    stepped: Duration,
    /// What is to be sent to each vehicle.
    outgoing: Vec<Vec<u8>>,
    lost: Vec<bool>,
}

impl Live {
    /// A mission that begins once all vehicles are heard and tell their time; until then nothing flies. `speedup` is
    /// what the vehicles were asked for.
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
            prelude: None,
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

    /// What was said so far, oldest first; it is gone then.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        self.crew.take_notices()
    }

    /// Takes in what a vehicle said, at a time of ours.
    pub fn hear(&mut self, index: usize, bytes: &[u8], now: Duration) {
        self.crew.push(index, bytes);
        let mut session_now = self.advance(now, None);
        while !self.is_over() && self.crew.hear(index, session_now) {
            let vehicle = self.crew.vehicle(index);
            let reading = (vehicle.id, vehicle.clock_ms());
            session_now = self.advance(now, Some(reading));
        }
        self.gather();
    }

    /// Lets time of ours pass: vehicles that are silent do not stop the mission for ever.
    pub fn pass(&mut self, now: Duration) {
        self.advance(now, None);
        self.gather();
    }

    /// A vehicle is no more: its process has ended and will not be started again. False if that was known.
    pub fn lose(&mut self, index: usize) -> bool {
        let is_new = !std::mem::replace(&mut self.lost[index], true);
        if is_new {
            self.crew.lose(index);
        }
        is_new
    }

    /// What is to be sent to a vehicle; it is gone then.
    pub fn take_output(&mut self, index: usize) -> Vec<u8> {
        std::mem::take(&mut self.outgoing[index])
    }

    /// Moves everything to a time of ours; returns what the sessions take it for. They begin with time of ours,
    /// because a vehicle may have to be asked before it tells its own.
    fn advance(&mut self, now: Duration, reading: Option<(VehicleId, Option<u32>)>) -> Duration {
        let opened = *self.opened.get_or_insert(now);
        let talked = now.saturating_sub(opened);
        if self.prelude.is_none() && (self.are_all_heard() || talked >= HEARD_WITHIN) {
            // Steps of the sessions are steps of the mission.
            let whole = talked.as_millis().div_ceil(HEARTBEAT_EVERY.as_millis());
            let prelude = HEARTBEAT_EVERY * whole as u32;
            self.prelude = Some(prelude);
            self.crew.begin(prelude);
            self.stepped = prelude;
        }
        let session_now = match self.prelude {
            Some(prelude) => prelude + self.clock.step(now, reading),
            None => talked,
        };
        self.catch_up(session_now);
        session_now
    }

    /// A pilot must not command a vehicle whose mode is not known yet.
    fn are_all_heard(&self) -> bool {
        (0..self.lost.len()).all(|index| {
            let vehicle = self.crew.vehicle(index);
            self.lost[index] || vehicle.heartbeat.is_some() && vehicle.boot_ms.is_some()
        })
    }

    /// Sessions, pilot and mission follow, in the steps that they have in the embedded simulator.
    fn catch_up(&mut self, session_now: Duration) {
        while self.stepped + SESSION_POLL <= session_now && !self.is_over() {
            self.stepped += SESSION_POLL;
            for (index, bytes) in self.outgoing.iter_mut().enumerate() {
                self.crew.poll(index, self.stepped);
                if is_due(self.stepped, HEARTBEAT_EVERY) {
                    self.crew.say_heartbeat(index, bytes);
                }
                self.crew.note(index);
            }
            if self.prelude.is_some() && is_due(self.stepped, TICK) {
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
