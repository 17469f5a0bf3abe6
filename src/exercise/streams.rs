//! A mission on vehicles with their own clocks.

use std::sync::Arc;
use std::time::Duration;

use super::{Exercise, FlightDriver, FlightPace, HEARTBEAT_EVERY, SESSION_POLL};
use crate::language::Script;
use crate::mission::{Clock, Flight, Mission};
use crate::vehicle::VehicleId;

/// Byte streams of vehicles that run by themselves: SITL processes.
///
/// Waits and limits of the pilot and the mission, and the deadlines of commands run on mission time, which follows the
/// vehicles' own clocks in their messages ([`Clock`]). A vehicle's answer and its clock arrive together, so a deadline
/// in its time is right at any speed, and a late simulator or console does not make a command fail. Messages that
/// arrive together are handled one by one, with the mission's ticks between them.
#[derive(Debug)]
pub struct LiveStreams {
    /// The program's time at the first call.
    opened: Option<Duration>,
    /// The time up to which sessions have been stepped, and, after the prelude, pilot and mission.
    stepped: Duration,
    lost: Vec<bool>,
}

impl Exercise<LiveStreams> {
    /// A mission that begins once all vehicles are heard and report their time, or 10 s after the first call; until
    /// then nothing flies. `speedup` is the requested speed-up of the vehicles.
    pub fn live(mission: Arc<Mission>, seed: u64, script: Script, speedup: f64) -> Self {
        let vehicles = mission.seats.count;
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

    /// Handles bytes of a vehicle; `now` is the program's time.
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

    /// Advances the program's time, so that silent vehicles do not stop the mission forever.
    pub fn pass(&mut self, now: Duration) {
        let session_now = self.advance(now, None);
        self.gather(session_now);
    }

    /// Records that a vehicle's process has ended and will not be started again. Returns false if
    /// that was already known.
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

    /// Advances everything to a time of the program, and returns the time of the sessions. The
    /// sessions begin with the program's time, because a vehicle may have to be queried before it
    /// reports its own.
    fn advance(&mut self, now: Duration, reading: Option<(VehicleId, Option<u32>)>) -> Duration {
        let opened = *self.link.opened.get_or_insert(now);
        let talked = now.saturating_sub(opened);
        let are_all_heard = self.driver.has_begun() || self.are_all_heard();
        if self.driver.begin_when_heard(now, are_all_heard) {
            // Steps of the sessions coincide with steps of the mission.
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

    /// Whether all vehicles are ready for the pilot: none may be commanded before its mode is known.
    fn are_all_heard(&self) -> bool {
        let mut vehicles = self.seats.iter().zip(&self.link.lost);
        vehicles.all(|(seat, is_lost)| {
            let vehicle = seat.session.vehicle();
            *is_lost || vehicle.heartbeat.is_some() && vehicle.boot_ms.is_some()
        })
    }

    /// Advances sessions, pilot and mission, in the same steps as in the embedded simulator.
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
