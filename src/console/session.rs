//! One session of the console: a fleet, the simulator or links behind it, and the mission, if any.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use crate::app::effect::HangarDeed;
use crate::app::event::{Event, Started};
use crate::app::room::messages::Wanted;
use crate::app::state::{Activity, Session as Shown};
use crate::commands::Deed;
use crate::fleet::{Clock, Fleet, FleetEvent, Unreachable};
use crate::geo::LatLon;
use crate::hangar::{Backend as Simulation, Source};
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::link::{Address, Endpoint, LinkStatus, Pace, Simulator, Transport};
use crate::mission::{Demand, Flight, Mission};
use crate::notice::Notice;
use crate::parameters::Snapshot;
use crate::session::{Order, Report};
use crate::sim::{Start, World, WorldConfig};
use crate::store::Runs;
use crate::swarm::Rules;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};

mod course;
mod hangar;
mod inspection;
mod links;
mod logbook;
mod swarm;

use course::Course;
pub(super) use hangar::Ending;
use hangar::{News, Processes};
use inspection::Inspection;
use links::{LinkNews, round_trip, summary};
use logbook::Logbook;
use swarm::Swarm;

/// Where free flight begins.
const FREE_FLIGHT_START: Start = Start {
    at: LatLon::new(50.4501, 30.5234),
    altitude_amsl_m: 180.0,
    heading_deg: 0.0,
};
/// Fleet events taken over per tick, so that a flood of notices cannot hold up the screen.
const EVENTS_PER_TICK: usize = 2000;

/// What a session is to be.
#[derive(Debug, Clone)]
pub(super) enum Plan {
    /// A mission.
    Mission(Arc<Mission>),
    /// Simulated vehicles without a task; by these processes, if any are named.
    Free(Option<Source>),
    /// Vehicles at these addresses.
    Connect(Vec<Address>),
}

/// What sessions are started with.
#[derive(Debug, Clone)]
pub(super) struct Backend {
    pub simulation: Simulation,
    pub clock: Clock,
    pub vehicles: u8,
    pub seed: u64,
    pub speedup: f64,
    /// Where missions are recorded.
    pub runs: Option<Runs>,
}

/// A running session. Dropping it ends its tasks.
pub(super) struct Running {
    plan: Plan,
    fleet: Fleet,
    events: mpsc::Receiver<FleetEvent>,
    vehicles: Vec<watch::Receiver<Arc<Vehicle>>>,
    parameters: Vec<(VehicleId, watch::Receiver<Snapshot>)>,
    links: Vec<watch::Receiver<LinkStatus>>,
    inspection: Inspection,
    links_said: Vec<LinkNews>,
    /// How many of the links had ended when they were shown last.
    links_ended: usize,
    /// Reports that the fleet dropped so far.
    dropped: u64,
    course: Option<Course>,
    /// What the mission demands of vehicles that have not been told yet.
    wanted: Vec<Demand>,
    /// While this is true, the embedded simulator stands still.
    held: watch::Sender<bool>,
    /// What they do together.
    swarm: Swarm,
    /// The processes of its vehicles, and how many there are to be.
    processes: Option<(Processes, usize)>,
    cancel: CancellationToken,
}

impl Plan {
    /// What holds for vehicles that do something together.
    fn swarm_rules(&self) -> Rules {
        match self {
            Self::Mission(mission) => mission.swarm_rules(),
            Self::Free(_) | Self::Connect(_) => Rules::default(),
        }
    }
}

impl Running {
    /// Starts a session, once the processes of the one before it are gone.
    ///
    /// # Errors
    /// The fleet has ended.
    pub async fn start(
        plan: Plan,
        backend: &Backend,
        before: Ending,
    ) -> Result<(Self, Started), Text> {
        let cancel = CancellationToken::new();
        let (fleet, events) = Fleet::start(backend.clock.clone(), cancel.clone());
        let mut running = Self {
            plan: plan.clone(),
            fleet,
            events,
            vehicles: Vec::new(),
            parameters: Vec::new(),
            links: Vec::new(),
            inspection: Inspection::default(),
            links_said: Vec::new(),
            links_ended: 0,
            dropped: 0,
            course: None,
            wanted: Vec::new(),
            held: watch::Sender::new(false),
            swarm: Swarm::new(plan.swarm_rules(), backend.speedup),
            processes: None,
            cancel,
        };
        let row = || WorldConfig {
            seed: backend.seed,
            ..WorldConfig::row(usize::from(backend.vehicles), FREE_FLIGHT_START)
        };
        let mut started = match plan {
            Plan::Mission(mission) => running.start_mission(mission, backend, before).await?,
            Plan::Free(_) => {
                running.simulate(row(), backend, before).await?;
                started(Activity::Free)
            }
            Plan::Connect(addresses) => {
                let names = addresses.iter().map(ToString::to_string).collect();
                for address in addresses {
                    running.fleet.connect(Transport::Address(address))?;
                }
                started(Activity::Connected { addresses: names })
            }
        };
        started.processes = running.processes.as_ref().map(|(_, count)| *count);
        Ok((running, started))
    }

    async fn start_mission(
        &mut self,
        mission: Arc<Mission>,
        backend: &Backend,
        before: Ending,
    ) -> Result<Started, Text> {
        let mut flight = Flight::new(Arc::clone(&mission), backend.seed);
        let config = mission.world(backend.seed);
        self.simulate(config, backend, before).await?;
        let name = self.processes.as_ref().map_or("embedded", |_| "ardupilot");
        let runs = backend.runs.clone();
        let logbook = runs.map(|runs| Logbook::begin(runs, &mut flight, name));
        let mut course = match self.processes {
            Some(_) => Course::of_processes(flight, backend.speedup),
            None => Course::embedded(flight, backend.speedup, backend.clock.now()),
        };
        course.logbook = logbook;
        self.course = Some(course);
        Ok(Started {
            mission: Some(Box::new(mission.listing())),
            places: mission.places(),
            areas: mission.areas(),
            ..started(Activity::Mission {
                id: mission.id.clone(),
                title: mission.title.clone(),
            })
        })
    }

    /// Starts the vehicles of a world: in the embedded simulator at once, as processes in a while.
    async fn simulate(
        &mut self,
        world: WorldConfig,
        backend: &Backend,
        before: Ending,
    ) -> Result<(), Text> {
        let simulation = &backend.simulation;
        let source = match &self.plan {
            Plan::Free(Some(source)) => Some(source),
            _ => simulation.ardupilot.as_ref(),
        };
        if let Some(source) = source {
            let launches = simulation.launches(&world.starts, backend.speedup);
            let count = launches.len();
            let cancel = self.cancel.clone();
            let processes = Processes::launch(source.clone(), launches, before, cancel);
            self.processes = Some((processes, count));
            return Ok(());
        }
        let world = World::new(&WorldConfig {
            airframes: simulation.airframes(),
            ..world
        });
        // One in-memory pipe per vehicle, no port that others could reach.
        let endpoints = [Endpoint::Pipes];
        let cancel = self.cancel.clone();
        let pace = Pace {
            speedup: backend.speedup,
            held: self.held.subscribe(),
        };
        let simulator = Simulator::start(world, pace, &endpoints, cancel).await?;
        for pipe in simulator.pipes {
            self.fleet.connect(Transport::Pipe(pipe))?;
        }
        Ok(())
    }

    /// What of the session takes a while to end, once this is dropped.
    pub fn ending(&self) -> Ending {
        let processes = self.processes.as_ref();
        processes.map_or_else(Ending::default, |(processes, _)| processes.ending())
    }

    /// Has the process of a vehicle ended or started again.
    pub fn process(&self, deed: HangarDeed, vehicle: VehicleId) {
        if let Some((processes, _)) = &self.processes {
            processes.order(deed, vehicle);
        }
    }

    /// Looks at what the process of a vehicle prints, if one is wanted.
    pub fn look_at_output(&mut self, wanted: Option<VehicleId>, now: Duration) {
        if let Some((processes, _)) = &mut self.processes {
            processes.look(wanted, now);
        }
    }

    /// What has become of the vehicles' processes.
    fn hear_processes(&mut self, now: Duration) -> Vec<Event> {
        let Some((processes, _)) = &mut self.processes else {
            return Vec::new();
        };
        let mut events = Vec::new();
        while let Some(news) = processes.hear() {
            let event = match news {
                News::Opened(_) => None,
                News::Launched(berths) => {
                    let mut pipes = berths.into_iter().map(|berth| Transport::Pipe(berth.pipe));
                    let refused = pipes.find_map(|pipe| self.fleet.connect(pipe).err());
                    refused.map(|reason| Event::Failed(reason.into()))
                }
                News::NotLaunched(text) => Some(Event::NotLaunched(text)),
                News::Failed(text) => Some(Event::Failed(text)),
                News::Printed(vehicle, from, lines) => processes.printed(vehicle, from, &lines),
            };
            events.extend(event);
        }
        if let Some(instances) = processes.changed(now) {
            for vehicle in processes.started_again(&instances) {
                // A fleet that cannot keep up sees it by the vehicle's clock.
                let _ = self.fleet.restarted(vehicle);
            }
            events.push(Event::Hangar(instances));
        }
        events
    }

    /// What the session was to be, for starting it again.
    pub fn plan(&self) -> Plan {
        self.plan.clone()
    }

    /// Gives a command to one vehicle.
    ///
    /// # Errors
    /// The fleet has ended or cannot keep up.
    pub fn order(&self, vehicle: VehicleId, order: Order) -> Result<(), Unreachable> {
        self.fleet.order(vehicle, order)
    }

    /// Has the mission do something with vehicles; returns how it went. Without a mission it is refused.
    pub fn act(
        &mut self,
        entry: EntryId,
        deed: &Deed,
        vehicles: &[VehicleId],
        now: Duration,
    ) -> Vec<RowUpdate> {
        if let Some(course) = &mut self.course {
            let rows = course.flight.act(entry, deed, vehicles);
            // The mission speaks on its own clock; the ledger is on the program's.
            return rows
                .into_iter()
                .map(|row| RowUpdate { at: now, ..row })
                .collect();
        }
        let refused = |&vehicle: &VehicleId| RowUpdate {
            entry,
            vehicle,
            state: RowState::Refused,
            tries: 0,
            at: now,
            explanation: Some(text!("deed-no-mission")),
        };
        vehicles.iter().map(refused).collect()
    }

    /// Asks vehicles for all their parameters. Those that cannot be asked now are asked again by who wants them.
    pub fn fetch_parameters(&self, vehicles: &[VehicleId]) {
        for &vehicle in vehicles {
            if self.fleet.fetch_parameters(vehicle).is_err() {
                return;
            }
        }
    }

    /// Has something happen in the mission; `None` without one.
    pub fn inject(&mut self, name: &str) -> Option<Result<Text, Text>> {
        Some(self.course.as_mut()?.flight.inject(name))
    }

    /// Lets the embedded simulator stand still, or go on.
    pub fn hold(&self, held: bool) {
        self.held.send_replace(held);
    }

    /// Takes down in the mission's record that all stood still for so long.
    pub fn note_pause(&mut self, lasted: Duration, now: Duration) -> Option<Notice> {
        self.inspection.rest(now);
        let notice = self.course.as_mut()?.flight.note_pause(lasted)?;
        Some(Notice { at: now, ..notice })
    }

    /// Ends the mission; its report comes with the next tick.
    pub fn abandon(&mut self) {
        if let Some(course) = &mut self.course {
            course.flight.abandon();
        }
    }

    /// What has happened since the last tick. Telemetry is merged: one event per vehicle that changed.
    pub fn collect(&mut self, now: Duration) -> Vec<Event> {
        let mut collected = self.hear_processes(now);
        for _ in 0..EVENTS_PER_TICK {
            match self.events.try_recv() {
                Ok(FleetEvent::Appeared(vehicle)) => self.vehicles.push(vehicle),
                Ok(FleetEvent::Parameters(id, list)) => self.parameters.push((id, list)),
                Ok(FleetEvent::Linked(link, tap)) => {
                    self.inspection.add(&link, tap);
                    self.links.push(link);
                }
                Ok(FleetEvent::Report(Report::Row(row))) => collected.push(Event::Row(row)),
                Ok(FleetEvent::Report(Report::Notice(notice))) => {
                    collected.push(Event::Notice(notice));
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
                let snapshot = Vehicle::clone(&vehicle.borrow_and_update());
                collected.push(Event::Vehicle(Box::new(snapshot)));
            }
        }
        collected.extend(self.changed_parameters());
        collected.extend(self.hear_links(now).map(Event::Notice));
        // A link that has ended has changed for the last time; its last state still has to be shown.
        let links_ended = self.links.iter().filter(|link| link.has_changed().is_err());
        let links_ended = links_ended.count();
        let has_changed = |link: &watch::Receiver<LinkStatus>| link.has_changed().unwrap_or(false);
        if links_ended != self.links_ended || self.links.iter().any(has_changed) {
            self.links_ended = links_ended;
            let links = self.links.iter_mut().map(|link| {
                let status = link.borrow_and_update();
                let round_trip = round_trip(&self.vehicles, status.id);
                summary(&status, round_trip)
            });
            collected.push(Event::Links(links.collect()));
        }
        collected.extend(self.inspection.examine(&self.links, now));
        collected
    }

    /// The lists that have changed.
    fn changed_parameters(&mut self) -> impl Iterator<Item = Event> + '_ {
        self.parameters
            .iter_mut()
            .filter(|(_, parameters)| parameters.has_changed().unwrap_or(false))
            .map(|(vehicle, parameters)| Event::Parameters {
                vehicle: *vehicle,
                snapshot: parameters.borrow_and_update().clone(),
            })
    }

    /// A look at the links' messages, if one is wanted and due.
    pub fn inspect(&mut self, wanted: Option<&Wanted>, now: Duration) -> Option<Event> {
        self.inspection.look(&self.links, wanted?, now)
    }

    /// What a human should hear of the links: that one is down and why, and that it is up again.
    fn hear_links(&mut self, now: Duration) -> impl Iterator<Item = Notice> {
        self.links_said.resize(self.links.len(), LinkNews::Silent);
        let notices: Vec<Notice> = self
            .links
            .iter()
            .zip(&mut self.links_said)
            .filter_map(|(link, said)| {
                let status = link.borrow();
                let news = LinkNews::of(&status);
                if news == LinkNews::Silent || news == *said {
                    return None;
                }
                let before = std::mem::replace(said, news.clone());
                let is_usual = before == LinkNews::Silent && news == LinkNews::Up;
                (!is_usual).then(|| news.notice(&status.name, now))
            })
            .collect();
        notices.into_iter()
    }

    /// Steps the mission up to now and returns what came of it.
    pub fn fly(&mut self, now: Duration, shown: &Shown) -> Vec<Event> {
        let Some(course) = &mut self.course else {
            return Vec::new();
        };
        let events = course.fly(now, shown);
        // What a vehicle cannot be told before it is heard waits until it is.
        let heard = |demand: &Demand| shown.vehicles.contains_key(&demand.vehicle);
        self.wanted.extend(course.flight.take_demands());
        for demand in self.wanted.extract_if(.., |demand| heard(demand)) {
            let _ = self.fleet.carry_out(demand.vehicle, demand.want);
        }
        events
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

fn started(activity: Activity) -> Started {
    Started {
        activity,
        mission: None,
        places: BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
    }
}
