//! Starts sessions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::RunningSession;
use super::forwards::SessionForwards;
use super::hangar::{Processes, SessionEnding};
use super::inspection::Inspection;
use super::links::SessionLinks;
use super::mission_run::MissionRun;
use super::recorder::{FlightRecorder, RecordedUser};
use super::rehearsals::Rehearsals;
use super::truth::SimulatedTruth;
use crate::app::event::Started;
use crate::app::state::Activity;
use crate::exercise::PacedClock;
use crate::fleet::{Fleet, FleetClock, Keeping};
use crate::forward::ForwardSpec;
use crate::geo::LatLon;
use crate::hangar::{SitlSource, VehicleBackend as Simulation};
use crate::link::{Address, Endpoint, Signer, Simulator, SimulatorPace, Transport};
use crate::metadata::EventDocuments;
use crate::mission::record::Occasion;
use crate::mission::{Flight, Mission, Stake};
use crate::operator::Operator;
use crate::pilot_in_command::Person;
use crate::record::InputsHead;
use crate::scoring::TryReport;
use crate::session::{GuardedShelf, LogKeeper, PlanShelf};
use crate::shell::missions::listed;
use crate::sim::{Start, World, WorldConfig};
use crate::store;
use crate::store::{LogFolder, PlanFiles, Records, Runs, TransferredFiles};
use crate::swarm::Rules;
use crate::text;
use crate::text::Text;
use crate::wire::SystemId;

/// The usual position and heading of the first vehicle in free flight.
const FREE_FLIGHT_START: Start = Start {
    at: LatLon::new(50.4501, 30.5234),
    altitude_amsl_m: 180.0,
    heading_deg: 0.0,
};

/// The content of a session: a mission, free flight or running vehicles.
#[derive(Debug, Clone)]
pub(in crate::shell) enum SessionPlan {
    /// A mission from the catalogue or from a file.
    Mission(Arc<Mission>),
    /// Simulated vehicles without a task, in the given SITL if any.
    Free(Option<SitlSource>),
    /// Running vehicles at these addresses.
    Connect(Vec<Address>),
}

/// The settings and services that a session needs.
#[derive(Debug, Clone)]
pub(in crate::shell) struct SessionBackend {
    pub simulation: Simulation,
    pub clock: FleetClock,
    pub vehicles: u8,
    pub seed: u64,
    pub speedup: f64,
    /// The folder for records of missions.
    pub runs: Option<Runs>,
    /// The folder for records of flights.
    pub records: Option<Records>,
    /// The data folder, where downloaded logs are kept.
    pub data: Option<PathBuf>,
    /// The texts of events, from a file of the user.
    pub events: Arc<EventDocuments>,
    /// The keys of signed links.
    pub signer: Option<Signer>,
    /// The system id of this program; the usual one if there is none.
    pub station: Option<SystemId>,
    /// The stake and the career of a mission.
    pub occasion: Occasion,
    /// The user of this console, if members of a crew follow it.
    pub host: Option<Person>,
    /// The trainee's attempts before this one, oldest first.
    pub earlier: Vec<TryReport>,
    /// The forwards to other ground stations; in missions, they carry nothing back.
    pub forwards: Vec<ForwardSpec>,
}

impl SessionPlan {
    fn swarm_rules(&self) -> Rules {
        match self {
            Self::Mission(mission) => mission.swarm_rules(),
            Self::Free(_) | Self::Connect(_) => Rules::default(),
        }
    }
}

impl SessionPlan {
    /// Whether a session is recorded. A session that plays a recording is not.
    fn is_recorded(&self, backend: &SessionBackend) -> bool {
        let plays = |address: &Address| matches!(address, Address::File { .. });
        let is_playback = match self {
            Self::Connect(addresses) => addresses.iter().any(plays),
            Self::Mission(_) | Self::Free(_) => false,
        };
        backend.records.is_some() && !is_playback
    }
}

impl SessionPlan {
    /// What a session records, and its access to files and keys.
    fn keeping(&self, backend: &SessionBackend, recorder: Option<&FlightRecorder>) -> Keeping {
        let folder = backend.data.as_deref().map(LogFolder::within);
        Keeping {
            sink: recorder.map(FlightRecorder::sink),
            logs: folder.map(|folder| Arc::new(folder) as Arc<dyn LogKeeper>),
            files: Some(Arc::new(TransferredFiles::within(backend.data.as_deref()))),
            events: Some(Arc::clone(&backend.events)),
            plans: Some(self.shelf(backend.occasion.stake, backend.data.as_deref())),
            signer: backend.signer.clone(),
            station: backend.station,
        }
    }

    /// Access to plan files for the session's vehicles. In a flight that counts, a plan must not
    /// move home or switch the fence.
    fn shelf(&self, stake: Stake, data: Option<&Path>) -> Arc<dyn PlanShelf> {
        let files = PlanFiles::keeping_in(data);
        let counts = matches!(self, Self::Mission(_)) && stake != Stake::Practice;
        if counts {
            Arc::new(GuardedShelf(files))
        } else {
            Arc::new(files)
        }
    }
}

impl RunningSession {
    /// Starts a session, once the processes of the previous one are gone.
    ///
    /// # Errors
    /// The fleet has ended.
    pub async fn start(
        plan: SessionPlan,
        backend: &SessionBackend,
        before: SessionEnding,
    ) -> Result<(Self, Started), Text> {
        let mut running = Self::without_vehicles(&plan, backend);
        let mut started = running.begin(plan, backend, before).await?;
        started.speedup = backend.speedup;
        started.processes = running.processes.as_ref().map(|processes| processes.count);
        running.share(&backend.forwards)?;
        running.begin_record(backend, &started);
        Ok((running, started))
    }

    fn without_vehicles(plan: &SessionPlan, backend: &SessionBackend) -> Self {
        let cancel = CancellationToken::new();
        let recorder = plan
            .is_recorded(backend)
            .then(|| FlightRecorder::new(&backend.clock));
        let keeping = plan.keeping(backend, recorder.as_ref());
        let (fleet, events) = Fleet::start_kept(keeping, backend.clock.clone(), cancel.clone());
        Self {
            plan: plan.clone(),
            fleet,
            events,
            vehicles: Vec::new(),
            parameters: Vec::new(),
            links: SessionLinks::default(),
            forwards: SessionForwards::default(),
            inspection: Inspection::default(),
            dropped: 0,
            mission_run: None,
            rehearsals: Rehearsals::new(backend.records.clone()),
            world: None,
            airframes: Vec::new(),
            pace: watch::Sender::new(SimulatorPace {
                speedup: backend.speedup,
                held: false,
            }),
            operator: Operator::new(plan.swarm_rules()),
            paths: Vec::new(),
            vehicle_time: PacedClock::new(backend.speedup, Duration::ZERO),
            processes: None,
            recorder,
            truth: None,
            cancel,
        }
    }

    /// Starts or connects the vehicles.
    async fn begin(
        &mut self,
        plan: SessionPlan,
        backend: &SessionBackend,
        before: SessionEnding,
    ) -> Result<Started, Text> {
        match plan {
            SessionPlan::Mission(mission) => self.start_mission(mission, backend, before).await,
            SessionPlan::Free(_) => {
                let free = &backend.simulation.free;
                let start = free.start.unwrap_or(FREE_FLIGHT_START);
                let row = WorldConfig {
                    seed: backend.seed,
                    kinds: free.embedded().into_iter().collect(),
                    ..free.world(usize::from(backend.vehicles), start)
                };
                self.simulate(row, backend, before).await?;
                Ok(Started {
                    places: free_flight_places(start),
                    ..started(Activity::Free)
                })
            }
            SessionPlan::Connect(addresses) => {
                let names = addresses.iter().map(ToString::to_string).collect();
                for address in addresses {
                    self.fleet.connect(Transport::Address(address))?;
                }
                Ok(started(Activity::Connected { addresses: names }))
            }
        }
    }

    /// Opens forwards. In a mission they are read-only: another ground station must not help to fly
    /// it.
    fn share(&self, forwards: &[ForwardSpec]) -> Result<(), Text> {
        let is_mission = matches!(self.plan, SessionPlan::Mission(_));
        for spec in forwards {
            self.forward(ForwardSpec {
                read_only: spec.read_only || is_mission,
                ..spec.clone()
            })?;
        }
        Ok(())
    }

    fn begin_record(&mut self, backend: &SessionBackend, started: &Started) {
        let run_id = self.mission_run.as_ref().and_then(MissionRun::run_id);
        if let (Some(recorder), Some(records)) = (&mut self.recorder, &backend.records) {
            let whose = RecordedUser {
                profile: backend.occasion.profile.as_deref(),
                host: backend.host.as_ref(),
            };
            recorder.begin(records, started, whose, run_id);
        }
    }

    async fn start_mission(
        &mut self,
        mission: Arc<Mission>,
        backend: &SessionBackend,
        before: SessionEnding,
    ) -> Result<Started, Text> {
        let flight = Flight::new(Arc::clone(&mission), backend.seed);
        let config = mission.world(backend.seed);
        let mut mission_run = match self.simulate(config, backend, before).await? {
            Some(steps) => MissionRun::embedded(flight, steps),
            None => MissionRun::of_processes(flight, backend.speedup),
        };
        if let Some(runs) = &backend.runs {
            mission_run.record(runs, backend.occasion.clone(), backend.earlier.clone());
        }
        self.mission_run = Some(mission_run);
        let file = store::mission_file(&mission);
        Ok(Started {
            mission: Some(Box::new(listed(&mission, file))),
            places: mission.places(),
            areas: mission.areas(),
            ..started(Activity::Mission {
                id: mission.id.clone(),
                title: titled(&mission, &backend.occasion),
                stake: backend.occasion.stake,
            })
        })
    }

    /// Starts the vehicles of a world: in the embedded simulator at once, as processes with some delay. Returns a
    /// counter of the embedded simulator's steps; `None` for processes.
    async fn simulate(
        &mut self,
        world: WorldConfig,
        backend: &SessionBackend,
        before: SessionEnding,
    ) -> Result<Option<watch::Receiver<u64>>, Text> {
        let simulation = &backend.simulation;
        self.airframes = simulation.of(world.clone()).airframes;
        let source = match &self.plan {
            SessionPlan::Free(Some(source)) => Some(source),
            SessionPlan::Mission(_) | SessionPlan::Free(_) | SessionPlan::Connect(_) => {
                simulation.ardupilot.as_ref()
            }
        };
        if let Some(source) = source {
            let mut launches = simulation.launches(world, backend.speedup);
            if matches!(self.plan, SessionPlan::Free(_)) {
                let free = launches
                    .into_iter()
                    .map(|launch| simulation.free.of(launch));
                launches = free.collect();
            }
            let cancel = self.cancel.clone();
            let processes = Processes::launch(source.clone(), launches, before, cancel);
            self.processes = Some(processes);
            return Ok(None);
        }
        let record = self.recorder.as_ref().map(|recorder| {
            let head = InputsHead::of(&world, &simulation.airframes);
            (head, recorder.inputs())
        });
        let world = World::new(&simulation.of(world));
        // One in-memory pipe per vehicle, no port that others could reach.
        let endpoints = [Endpoint::Pipes];
        let cancel = self.cancel.clone();
        let pace = self.pace.subscribe();
        let simulator = Simulator::start_recorded(world, pace, &endpoints, record, cancel).await?;
        self.world = Some(simulator.world);
        self.truth = Some(SimulatedTruth::new(simulator.places));
        for pipe in simulator.pipes {
            self.fleet.connect(Transport::Pipe(pipe))?;
        }
        backend.clock.stand_through_stops(true);
        Ok(Some(simulator.steps))
    }
}

/// The title of a flight, with its stake if it is not the usual one.
fn titled(mission: &Mission, occasion: &Occasion) -> Text {
    let title = mission.title.clone();
    if occasion.profile.is_none() {
        return title;
    }
    match occasion.stake {
        Stake::Graded => title,
        Stake::Practice => text!("flight-practice", mission = title),
        Stake::Daily => text!("flight-daily", mission = title),
        Stake::Exam => text!("flight-exam", mission = title),
    }
}

/// The named places of free flight: "home" and "pad", both at its start.
fn free_flight_places(start: Start) -> BTreeMap<String, LatLon> {
    ["home", "pad"]
        .map(|name| (name.to_owned(), start.at))
        .into()
}

fn started(activity: Activity) -> Started {
    Started {
        activity,
        mission: None,
        places: BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMATION: &str = include_str!("../../../missions/02-formation.toml");
    const MOVES_HOME: &str = "QGC WPL 110\n\
        0\t1\t0\t16\t0\t0\t0\t0\t50.45\t30.52\t180\t1\n\
        1\t0\t3\t179\t1\t0\t0\t0\t0\t0\t0\t1\n";

    #[test]
    fn a_flight_that_counts_takes_no_plan_that_moves_home() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("home.waypoints");
        std::fs::write(&file, MOVES_HOME).expect("written");
        let file = file.to_string_lossy();
        let mission = Mission::parse(FORMATION).expect("it is good");
        let flown = SessionPlan::Mission(Arc::new(mission));
        for stake in [Stake::Graded, Stake::Daily, Stake::Exam] {
            let fault = flown
                .shelf(stake, None)
                .read(&file)
                .expect_err("it is refused");
            assert!(fault.to_string().contains("DO_SET_HOME"), "{fault}");
        }
        let practice = flown.shelf(Stake::Practice, None);
        practice.read(&file).expect("practice");
    }
}
