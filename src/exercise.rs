//! A mission flown by a pilot script.
//!
//! Sessions, pilot, mission and scoring are the same for both kinds of vehicles: the embedded simulator in lock step
//! without a clock ([`LockStep`], whose outcome depends only on the mission, the seed and the script), and vehicles
//! with their own clocks behind byte streams ([`LiveStreams`]). The [`FlightDriver`], which the console uses as well,
//! decides when a mission begins and how its time passes.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::geo::{LatLon, Outline};
use crate::language::{Pilot, PilotEvent, Script, Seen};
use crate::ledger::{Ledger, RowUpdate};
use crate::mission::{Flight, Report as MissionReport, is_due};
use crate::notice::Notice;
use crate::operator::Operator;
use crate::record::{FlightLog, Happening, NoticeLine, RowLine};
use crate::session::{Report, Session};
use crate::swarm::Path;
use crate::text;
use crate::vehicle::{Severity, VehicleId, Vehicles};
use crate::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
    Outgoing, SystemId, ground_station_heartbeat,
};

mod driver;
mod lock_step;
mod orders;
mod paced_clock;
mod playthrough;
mod scripted;
mod streams;
#[cfg(test)]
mod tests;

pub use driver::{FlightDriver, FlightPace};
pub use lock_step::LockStep;
pub use paced_clock::PacedClock;
pub use playthrough::{Playthrough, PlaythroughFlight};
pub use scripted::{fly_compared, read_script};
pub use streams::LiveStreams;

/// The interval at which sessions check their deadlines.
const SESSION_POLL: Duration = Duration::from_millis(50);
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);

/// A session per vehicle, the pilot, and the mission; `L` is the connection to the vehicles, which
/// also provides the time.
#[derive(Debug)]
pub struct Exercise<L = LockStep> {
    link: L,
    seats: Vec<ExerciseSeat>,
    vehicles: Vehicles,
    ledger: Ledger,
    pilot: Pilot,
    driver: FlightDriver,
    operator: Operator,
    places: BTreeMap<String, LatLon>,
    areas: BTreeMap<String, Outline>,
    notices: Vec<Notice>,
    /// The last recorded paths of joint manoeuvres.
    paths: Vec<Path>,
    /// How long the sessions had run when the mission began.
    prelude: Duration,
    log: Option<FlightLog>,
}

/// The ground station's end of one vehicle's link.
#[derive(Debug)]
struct ExerciseSeat {
    decoder: Decoder,
    encoder: Encoder,
    session: Session,
    outgoing: Vec<u8>,
}

impl ExerciseSeat {
    fn new(system: SystemId) -> Self {
        Self {
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
            session: Session::new(system, AUTOPILOT_COMPONENT, Duration::ZERO),
            outgoing: Vec::new(),
        }
    }

    /// Handles the next message of the received bytes; false if none is complete.
    fn hear(&mut self, now: Duration, log: Option<&mut FlightLog>) -> bool {
        let Some(frame) = self.decoder.next_frame() else {
            return false;
        };
        if let Some(log) = log {
            log.note_frame(now, self.decoder.bytes_of(&frame));
        }
        self.session.receive(&frame, now);
        true
    }

    /// Polls the session and sends a heartbeat, each when it is due.
    fn poll(&mut self, now: Duration, log: Option<&mut FlightLog>) {
        if is_due(now, SESSION_POLL) {
            self.session.poll(now);
        }
        if is_due(now, HEARTBEAT_EVERY) {
            self.send_heartbeat(now, log);
        }
    }

    fn send_heartbeat(&mut self, now: Duration, log: Option<&mut FlightLog>) {
        if !self.session.is_cut() {
            self.push(&ground_station_heartbeat(), now, log);
        }
    }

    /// Encodes the session's messages.
    fn send(&mut self, now: Duration, mut log: Option<&mut FlightLog>) {
        for message in self.session.take_outgoing() {
            self.push(&message, now, log.as_deref_mut());
        }
    }

    fn push(&mut self, message: &Outgoing, now: Duration, log: Option<&mut FlightLog>) {
        let begin = self.outgoing.len();
        self.encoder.encode(message, &mut self.outgoing);
        if let Some(log) = log {
            log.note_frame(now, &self.outgoing[begin..]);
        }
    }
}

impl<L> Exercise<L> {
    /// An exercise with `vehicles` vehicles, with system ids from 1, at time 0.
    fn on(link: L, driver: FlightDriver, script: Script, vehicles: usize) -> Self {
        let mission = driver.flight().mission();
        Self {
            link,
            seats: (1..=SystemId::MAX)
                .take(vehicles)
                .map(ExerciseSeat::new)
                .collect(),
            vehicles: BTreeMap::new(),
            ledger: Ledger::new(),
            pilot: Pilot::new(script),
            operator: Operator::new(mission.swarm_rules()),
            places: mission.places(),
            areas: mission.named_areas(),
            driver,
            notices: Vec::new(),
            paths: Vec::new(),
            prelude: Duration::ZERO,
            log: None,
        }
    }

    /// The time since the mission began.
    pub fn now(&self) -> Duration {
        self.driver.time()
    }

    /// Whether the mission has ended.
    pub fn is_over(&self) -> bool {
        self.driver.is_over()
    }

    /// The vehicles as they were heard at the last tick.
    pub fn vehicles(&self) -> &Vehicles {
        &self.vehicles
    }

    /// The commands so far, with their outcomes.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The flight, read only.
    pub fn flight(&self) -> &Flight {
        self.driver.flight()
    }

    /// Mutable access to the flight, to set its attempt and its record.
    pub fn flight_mut(&mut self) -> &mut Flight {
        self.driver.flight_mut()
    }

    /// The final result with all explanations; ends the record.
    pub fn close(&mut self) -> MissionReport {
        self.driver.flight_mut().close(&self.ledger)
    }

    /// The result so far with all explanations.
    pub fn report(&self) -> MissionReport {
        self.driver.flight().report(&self.ledger)
    }

    /// Records the flight from now on; `began_unix_us` is the time of day, in microseconds since 1970 (UTC).
    pub fn record(&mut self, began_unix_us: u64) {
        self.log = Some(FlightLog::new(began_unix_us));
    }

    /// Stops recording the flight.
    pub fn stop_recording(&mut self) {
        self.log = None;
    }

    /// The recorded data that has not been written yet; `None` if the flight is not recorded.
    pub fn log_mut(&mut self) -> Option<&mut FlightLog> {
        self.log.as_mut()
    }

    /// The places that commands can name.
    pub fn places(&self) -> &BTreeMap<String, LatLon> {
        &self.places
    }

    /// Removes and returns the notices so far, oldest first, with mission times.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// Handles the changes to a vehicle's commands, and its notices.
    fn take_reports(&mut self, index: usize, now: Duration) {
        for report in self.seats[index].session.take_reports() {
            match report {
                Report::Row(update) => {
                    self.operator.note_row(&update);
                    self.advance_row(&update, now);
                }
                Report::Notice(notice) => self.notices.push(since(self.prelude, notice)),
                // Only the console shows folders.
                Report::Folder(_) => {}
            }
        }
    }

    fn advance_row(&mut self, update: &RowUpdate, now: Duration) {
        self.ledger.apply(update);
        self.note_down(now, || Happening::Row(RowLine::of(update)));
    }

    /// Adds a notice that does not come from a vehicle, at a session time.
    fn tell(&mut self, notice: Notice, now: Duration) {
        self.note_down(now, || Happening::Notice(NoticeLine::of(&notice)));
        self.notices.push(notice);
    }

    fn note_down(&mut self, now: Duration, what: impl FnOnce() -> Happening) {
        if let Some(log) = &mut self.log {
            log.note(now, what());
        }
    }

    /// Steps pilot and mission by the ticks that are due at a session time.
    fn fly_until(&mut self, now: Duration) {
        let until = now.saturating_sub(self.prelude);
        while let Some(tick) = self.driver.tick(until) {
            self.fly(now, tick);
        }
    }

    /// Runs one tick of the mission, at a session time.
    fn fly(&mut self, now: Duration, tick: Duration) {
        self.take_snapshots();
        let seen = Seen {
            vehicles: &self.vehicles,
            ledger: &self.ledger,
            findings: &self.driver.flight().findings(),
        };
        for event in self.pilot.step(now, seen) {
            match event {
                PilotEvent::Do(statement) => self.carry_out(&statement, now),
                PilotEvent::WaitTimedOut { line, text } => {
                    let text = text!("grammar-wait-timed-out", line = line, wait = text);
                    self.tell(Notice::general(tick, Severity::Warning, text), now);
                }
                PilotEvent::Finished => {}
            }
        }
        self.conduct(now);
        let flight = self.driver.flight_mut();
        let said = flight.step(tick, &self.vehicles, &self.ledger);
        self.notices.extend(said);
        for demand in flight.take_demands() {
            let radio = Happening::of_demand(demand.vehicle, &demand.want);
            if let (Some(log), Some(radio)) = (&mut self.log, radio) {
                log.note(now, radio);
            }
            if let Some(session) = session(&mut self.seats, demand.vehicle) {
                session.carry_out(demand.want);
            }
        }
        let ms = tick.as_millis() as u64;
        self.note_down(now, || Happening::Mission { ms });
    }

    fn take_snapshots(&mut self) {
        for seat in &self.seats {
            let vehicle = seat.session.vehicle();
            let snapshot = Arc::new(vehicle.clone());
            self.vehicles.insert(vehicle.id, snapshot);
        }
    }
}

fn session(seats: &mut [ExerciseSeat], vehicle: VehicleId) -> Option<&mut Session> {
    let mut sessions = seats.iter_mut().map(|seat| &mut seat.session);
    sessions.find(|session| session.vehicle().id == vehicle)
}

/// Converts a notice of the sessions to mission time.
fn since(begun: Duration, notice: Notice) -> Notice {
    Notice {
        at: notice.at.saturating_sub(begun),
        ..notice
    }
}
