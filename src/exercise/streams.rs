//! A mission on vehicles that keep time themselves.

use std::sync::Arc;
use std::time::Duration;

use super::{Exercise, FlightDriver, FlightPace, HEARTBEAT_EVERY, SESSION_POLL};
use crate::language::Script;
use crate::mission::{Clock, Flight, Mission};
use crate::vehicle::VehicleId;

/// Byte streams of vehicles that run by themselves: SITL processes.
///
/// All runs on mission time, which is how far the vehicles' own clocks have come as their messages tell it
/// ([`Clock`]): waits and limits of the pilot and the mission, and the deadlines of commands as well. A vehicle's
/// answer and its clock come along the same way, so a deadline in its time stays right at any speed, and neither a
/// simulator nor a console that is late makes a command fail. Many messages that come at once are taken one by one, with
/// the mission's ticks between them.
#[derive(Debug)]
pub struct LiveStreams {
    /// When time of ours passed first.
    opened: Option<Duration>,
    /// Up to where sessions have come, and after the prelude pilot and mission.
    stepped: Duration,
    lost: Vec<bool>,
}

impl Exercise<LiveStreams> {
    /// A mission that begins once all vehicles are heard and tell their time, or 10 s after the first time passed;
    /// until then nothing flies. `speedup` is what the vehicles were asked for.
    pub fn live(mission: Arc<Mission>, seed: u64, script: Script, speedup: f64) -> Self {
        let vehicles = mission.vehicles;
        let link = LiveStreams {
            opened: None,
            stepped: Duration::ZERO,
            lost: vec![false; vehicles],
        };
        let pace = FlightPace::VehicleClocks(Clock::new(speedup));
        let driver = FlightDriver::new(Flight::new(mission, seed), pace);
        let mut exercise = Self::on(link, driver, script, vehicles);
        for seat in &mut exercise.seats {
            seat.send_heartbeat(Duration::ZERO, None);
        }
        exercise
    }

    /// Takes a vehicle's bytes, at our time.
    pub fn hear(&mut self, index: usize, bytes: &[u8], now: Duration) {
        self.seats[index].decoder.push(bytes);
        let mut session_now = self.advance(now, None);
        while !self.is_over() && self.seats[index].hear(session_now, self.log.as_mut()) {
            let vehicle = self.seats[index].session.vehicle();
            let reading = (vehicle.id, vehicle.clock_ms());
            session_now = self.advance(now, Some(reading));
        }
        self.gather(session_now);
    }

    /// Lets time of ours pass: vehicles that are silent do not stop the mission for ever.
    pub fn pass(&mut self, now: Duration) {
        let session_now = self.advance(now, None);
        self.gather(session_now);
    }

    /// Notes that a vehicle's process has ended and will not be started again. False if that was known.
    pub fn lose(&mut self, index: usize) -> bool {
        let is_new = !std::mem::replace(&mut self.link.lost[index], true);
        if is_new {
            self.take_snapshots();
            let id = self.seats[index].session.vehicle().id;
            let said = self.driver.flight_mut().lose(id, &self.vehicles);
            self.notices.extend(said);
        }
        is_new
    }

    /// Takes the bytes to send to a vehicle.
    pub fn take_output(&mut self, index: usize) -> Vec<u8> {
        std::mem::take(&mut self.seats[index].outgoing)
    }

    /// Moves everything to a time of ours; returns the time of the sessions. They begin with time of ours, because a
    /// vehicle may have to be asked before it tells its own.
    fn advance(&mut self, now: Duration, reading: Option<(VehicleId, Option<u32>)>) -> Duration {
        let opened = *self.link.opened.get_or_insert(now);
        let talked = now.saturating_sub(opened);
        let are_all_heard = self.driver.has_begun() || self.are_all_heard();
        if self.driver.begin_when_heard(now, are_all_heard) {
            // Steps of the sessions are steps of the mission.
            let whole = talked.as_millis().div_ceil(HEARTBEAT_EVERY.as_millis());
            self.prelude = HEARTBEAT_EVERY * whole as u32;
            self.link.stepped = self.prelude;
        }
        let time = self.driver.advance(now, reading);
        let session_now = if self.driver.has_begun() {
            self.prelude + time
        } else {
            talked
        };
        self.catch_up(session_now);
        session_now
    }

    /// A pilot must not command a vehicle whose mode is not known yet.
    fn are_all_heard(&self) -> bool {
        let mut vehicles = self.seats.iter().zip(&self.link.lost);
        vehicles.all(|(seat, is_lost)| {
            let vehicle = seat.session.vehicle();
            *is_lost || vehicle.heartbeat.is_some() && vehicle.boot_ms.is_some()
        })
    }

    /// Sessions, pilot and mission follow, in the steps that they have in the embedded simulator.
    fn catch_up(&mut self, session_now: Duration) {
        while self.link.stepped + SESSION_POLL <= session_now && !self.is_over() {
            self.link.stepped += SESSION_POLL;
            let stepped = self.link.stepped;
            for index in 0..self.seats.len() {
                self.seats[index].poll(stepped, self.log.as_mut());
                self.take_reports(index, stepped);
            }
            if self.driver.has_begun() {
                self.fly_until(stepped);
            }
        }
    }

    fn gather(&mut self, now: Duration) {
        for index in 0..self.seats.len() {
            self.take_reports(index, now);
            self.seats[index].send(now, self.log.as_mut());
        }
    }
}
