//! One session of the console: a fleet, the simulator or links behind it, and the mission, if any.
//!
//! # How the parts fit
//! - `start` builds a session, and decides whether it is recorded; `hangar` launches the processes of its vehicles
//!   without blocking the screen.
//! - In flight: `mission_run` steps the mission and its clock, `orders` hands orders to vehicles, mission and
//!   manoeuvres, `rehearsals` flies plans in the background.
//! - What only an instructor sees: `truth`.
//! - What is shown: `links`, `forwards`, and `inspection`, which examines the links for the doctor and the messages
//!   room.
//! - What is kept: `recorder` (frames and journal), `logbook` (the record of the mission).

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use super::ghost::ShownMission;
use crate::app::event::{Event, VehicleEvent};
use crate::app::room::messages::TrafficRequest;
use crate::exercise::PacedClock;
use crate::fleet::{Fleet, FleetEvent};
use crate::link::{SimulatorPace, WorldHandle};
use crate::notice::Notice;
use crate::operator::Operator;
use crate::parameters::ParameterSnapshot;
use crate::record::{Happening, NoticeLine};
use crate::session::{Report, Want};
use crate::sim::Airframe;
use crate::swarm::Path;
use crate::vehicle::{HeldChannels, RadioTest, Severity, Vehicle, VehicleId};

mod forwards;
mod hangar;
mod inspection;
mod links;
mod logbook;
mod mission_run;
mod orders;
mod recorder;
mod rehearsals;
mod situation;
mod start;
mod truth;

use forwards::SessionForwards;
use hangar::Processes;
pub(super) use hangar::SessionEnding;
use inspection::Inspection;
use links::SessionLinks;
pub(super) use mission_run::Finished;
use mission_run::MissionRun;
use recorder::FlightRecorder;
pub use recorder::RecordPoint;
use rehearsals::Rehearsals;
pub(super) use situation::SessionSituation;
pub(super) use start::{SessionBackend, SessionPlan};
use truth::SimulatedTruth;

/// The maximum number of fleet events per tick, so that a flood of notices cannot block the screen.
const EVENTS_PER_TICK: usize = 2000;

/// A running session. Dropping it ends its tasks.
pub(super) struct RunningSession {
    plan: SessionPlan,
    fleet: Fleet,
    events: mpsc::Receiver<FleetEvent>,
    vehicles: Vec<watch::Receiver<Arc<Vehicle>>>,
    parameters: Vec<(VehicleId, watch::Receiver<ParameterSnapshot>)>,
    links: SessionLinks,
    forwards: SessionForwards,
    inspection: Inspection,
    /// The number of reports that the fleet has dropped so far.
    dropped: u64,
    mission_run: Option<MissionRun>,
    /// The embedded simulator's speed, and whether it is paused.
    pace: watch::Sender<SimulatorPace>,
    operator: Operator,
    rehearsals: Rehearsals,
    /// The world of the embedded simulator, if the session has one.
    world: Option<WorldHandle>,
    /// The airframes of the simulated vehicles; empty for the standard one.
    airframes: Vec<Arc<Airframe>>,
    /// The paths of manoeuvres, as last shown.
    paths: Vec<Path>,
    vehicle_time: PacedClock,
    processes: Option<Processes>,
    recorder: Option<FlightRecorder>,
    /// Where simulated vehicles are in truth; `None` for processes and for vehicles of others.
    truth: Option<SimulatedTruth>,
    cancel: CancellationToken,
}

impl RunningSession {
    /// The session's plan, to start it again.
    pub fn plan(&self) -> SessionPlan {
        self.plan.clone()
    }

    /// The mission, if there is one.
    pub fn shown_mission(&self) -> Option<ShownMission> {
        let run = self.mission_run.as_ref()?;
        Some(ShownMission {
            mission: Arc::clone(run.flight().mission()),
            seed: run.flight().seed(),
            run: run.run_id().map(str::to_owned),
        })
    }

    /// Downloads all parameters of these vehicles. If the fleet cannot keep up, the remaining
    /// vehicles are left out.
    pub fn fetch_parameters(&self, vehicles: &[VehicleId]) {
        for &vehicle in vehicles {
            if self.fleet.fetch_parameters(vehicle).is_err() {
                return;
            }
        }
    }

    /// Forgets vehicles; a vehicle that is heard again counts as new.
    pub fn forget(&mut self, vehicles: &[VehicleId]) {
        for &vehicle in vehicles {
            // The hub may still route such a vehicle: it must appear when it is heard again.
            if self.fleet.forget(vehicle).is_ok() {
                self.vehicles.retain(|known| known.borrow().id != vehicle);
                self.parameters.retain(|(id, _)| *id != vehicle);
            }
        }
    }

    /// Begins or ends a test of the radio of vehicles.
    pub fn test_radio(&self, vehicles: &[VehicleId], test: Option<RadioTest>) {
        for &vehicle in vehicles {
            if self
                .fleet
                .carry_out(vehicle, Want::RadioTest(test))
                .is_err()
            {
                tracing::warn!("vehicle {vehicle}: the test of its radio was not set");
            }
        }
    }

    /// Holds the sticks of a vehicle for a second, or releases them.
    pub fn steer_by_hand(&self, vehicle: VehicleId, held: Option<HeldChannels>) {
        if self.fleet.steer_by_hand(vehicle, held).is_err() {
            tracing::warn!("vehicle {vehicle}: its sticks were not moved");
        }
    }

    /// Releases the channels of all vehicles; returns the vehicles whose channels were held. The state of
    /// each shows no held channels as soon as the first release is on its way.
    pub fn release_sticks(&self) -> Vec<watch::Receiver<Arc<Vehicle>>> {
        let held = self.vehicles.iter();
        let held = held.filter(|vehicle| vehicle.borrow().held.is_some());
        let held: Vec<_> = held.cloned().collect();
        for vehicle in &held {
            let id = vehicle.borrow().id;
            self.steer_by_hand(id, None);
        }
        held
    }

    /// Pauses or resumes the embedded simulator.
    pub fn hold(&self, held: bool) {
        self.pace.send_modify(|pace| pace.held = held);
    }

    /// The seconds of the vehicles' time per second of wall-clock time.
    pub fn speedup(&self) -> f64 {
        self.pace.borrow().speedup
    }

    /// Changes the speed-up of the embedded simulator; mission time follows it.
    pub fn set_speedup(&mut self, speedup: f64, now: Duration) {
        self.pace.send_modify(|pace| pace.speedup = speedup);
        self.vehicle_time.set_rate(speedup, now);
    }

    /// Notes that everything was paused until now.
    pub fn rest(&mut self, now: Duration) {
        self.inspection.rest(now);
    }

    /// The events since the last tick. Telemetry is merged: one event per vehicle that changed. `expected` are the
    /// vehicles of the swarm; empty if any vehicle is.
    pub fn collect(&mut self, expected: &BTreeSet<VehicleId>, now: Duration) -> Vec<Event> {
        let mut collected = self.hear_processes(now);
        for _ in 0..EVENTS_PER_TICK {
            match self.events.try_recv() {
                Ok(FleetEvent::Appeared(vehicle)) => self.vehicles.push(vehicle),
                Ok(FleetEvent::Parameters(id, list)) => self.parameters.push((id, list)),
                Ok(FleetEvent::Linked(link, tap)) => {
                    self.inspection.add(&link, tap);
                    self.links.add(link);
                }
                Ok(FleetEvent::Forwarding(feed)) => self.forwards.add(feed),
                Ok(FleetEvent::Report(Report::Row(row))) => {
                    self.operator.note_row(&row);
                    collected.push(VehicleEvent::Row(row).into());
                }
                Ok(FleetEvent::Report(Report::Notice(notice))) => {
                    collected.push(Event::Notice(notice));
                }
                Ok(FleetEvent::Report(Report::Folder(listed))) => {
                    collected.push(VehicleEvent::Folder(listed).into());
                }
                Ok(FleetEvent::Warning(notice)) => {
                    self.note_down(now, Happening::Notice(NoticeLine::of(&notice)));
                    collected.push(Event::Notice(notice));
                }
                Ok(FleetEvent::Foreign(command)) => {
                    collected.push(VehicleEvent::Foreign(command).into());
                }
                Ok(FleetEvent::Dropped(count)) => {
                    self.dropped += count;
                    collected.push(Event::NoticesDropped(self.dropped));
                }
                Err(_) => break,
            }
        }
        for vehicle in &mut self.vehicles {
            if vehicle.has_changed().unwrap_or(false) {
                let snapshot = Arc::clone(&vehicle.borrow_and_update());
                collected.push(VehicleEvent::Telemetry(snapshot).into());
            }
        }
        collected.extend(self.changed_parameters());
        collected.extend(self.rehearsals.take(now));
        let mut heard: Vec<Notice> = self.links.hear(now).collect();
        heard.extend(self.forwards.hear(now));
        for notice in heard {
            self.note_down(now, Happening::Notice(NoticeLine::of(&notice)));
            collected.push(Event::Notice(notice));
        }
        collected.extend(self.hear_recorder(now));
        collected.extend(self.links.changed(&self.vehicles));
        collected.extend(self.forwards.changed());
        collected.extend(self.inspection.examine(self.links.shown(), expected, now));
        collected
    }

    /// The path of the session's recorded frames; `None` if the session is not recorded.
    pub fn record(&self) -> Option<&std::path::Path> {
        self.recorder.as_ref()?.frames()
    }

    /// Writes the record more often, because others follow it.
    pub fn note_followed(&mut self) {
        if let Some(recorder) = &self.recorder {
            recorder.note_followed();
        }
        if let Some(mission_run) = &mut self.mission_run {
            mission_run.note_followed();
        }
    }

    /// How far the record has got; `None` if the session is not recorded.
    pub fn record_point(&self, now: Duration) -> Option<RecordPoint> {
        self.recorder.as_ref()?.sight(now)
    }

    /// Whether the session is recorded now; a mission's record ends soon after the mission.
    pub fn is_recording(&self) -> bool {
        self.recorder
            .as_ref()
            .is_some_and(FlightRecorder::is_recording)
    }

    /// Adds an occurrence to the session's journal.
    pub fn note_down(&self, now: Duration, what: Happening) {
        if let Some(recorder) = &self.recorder {
            recorder.note(now, what);
        }
    }

    /// Adds an event to the session's journal, unless a replay can derive it from telemetry or the
    /// mission.
    pub fn note_event(&self, now: Duration, event: &Event) {
        if let Event::Vehicle(event) = event
            && let Some(what) = recorder::happening(event)
        {
            self.note_down(now, what);
        }
    }

    /// A notice from the recorder, if any.
    fn hear_recorder(&mut self, now: Duration) -> Option<Event> {
        let recorder = self.recorder.as_mut()?;
        recorder.pass_inputs();
        let text = recorder.take_fault()?;
        Some(Event::Notice(Notice::general(now, Severity::Warning, text)))
    }

    fn changed_parameters(&mut self) -> impl Iterator<Item = Event> + '_ {
        self.parameters
            .iter_mut()
            .filter(|(_, parameters)| parameters.has_changed().unwrap_or(false))
            .map(|(vehicle, parameters)| {
                let snapshot = parameters.borrow_and_update().clone();
                let vehicle = *vehicle;
                VehicleEvent::Parameters { vehicle, snapshot }.into()
            })
    }

    /// A count of the links' messages, if requested and due.
    pub fn inspect(&mut self, request: Option<&TrafficRequest>, now: Duration) -> Option<Event> {
        self.inspection.look(self.links.all(), request?, now)
    }
}

impl Drop for RunningSession {
    fn drop(&mut self) {
        self.cancel.cancel();
        let has_begun = self.mission_run.as_ref().is_none_or(MissionRun::has_begun);
        if let Some(recorder) = &mut self.recorder {
            // In a mission that has not begun, only the brief was read.
            recorder.end(has_begun);
        }
    }
}
