//! Vehicles to measure, the console's fleet on them, and what both have spent.

use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;
use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use super::cost::{self, Counted};
use super::instances::Instances;
use crate::commands::Command;
use crate::fleet::{Clock, Fleet, FleetEvent};
use crate::geo::LatLon;
use crate::language::Retry;
use crate::ledger::{EntryId, RowState};
use crate::link::{Endpoint, LinkStatus, Simulator, Started, Transport};
use crate::session::{Order, Report, Stream};
use crate::sim::{SYSTEMS, Start, World, WorldConfig};
use crate::vehicle::{Vehicle, VehicleId};

/// What is streamed while it is measured: `GLOBAL_POSITION_INT` and `ATTITUDE`.
pub(super) const STREAMS: &[Stream] = &[
    Stream {
        message: 33,
        rate_hz: 10.0,
    },
    Stream {
        message: 30,
        rate_hz: 10.0,
    },
];

/// A command is sent again so often until it is acknowledged.
const RETRY: Retry = Retry {
    tries: 3,
    every: Duration::from_millis(1500),
    deadline: Duration::from_secs(6),
};

/// Who simulates.
#[derive(Debug, Clone)]
pub(super) enum Simulators {
    /// This program.
    Embedded,
    /// Processes of this `arducopter`.
    ArduPilot(PathBuf),
}

enum Running {
    Embedded {
        counted: Counted,
        cancel: CancellationToken,
    },
    ArduPilot(Instances),
}

/// Up to 254 vehicles, of which each has a system id of its own, and the fleet on them.
struct Part {
    counted: Counted,
    fleet: Fleet,
    events: mpsc::Receiver<FleetEvent>,
    links: Vec<watch::Receiver<LinkStatus>>,
}

/// Vehicles in a row with the fleets on them. Dropping it ends everything.
pub(super) struct Swarm {
    size: usize,
    parts: Vec<Part>,
    vehicles: BTreeMap<(usize, VehicleId), watch::Receiver<Arc<Vehicle>>>,
    refusal: Option<String>,
    running: Running,
}

/// Processor time since the start.
pub(super) struct Spent {
    pub sim: Duration,
    /// The one thread that steps embedded vehicles.
    pub sim_thread: Option<Duration>,
    /// Each thread of the model update.
    pub model: Vec<Duration>,
    pub relay: Option<Duration>,
}

impl Swarm {
    /// Starts so many vehicles, and the console's fleets on them.
    ///
    /// # Errors
    /// Why one of them cannot be started.
    pub fn start(simulators: &Simulators, size: u16) -> anyhow::Result<Self> {
        let first = Start {
            at: LatLon::new(50.4501, 30.5234),
            altitude_amsl_m: 180.0,
            heading_deg: 0.0,
        };
        let row = WorldConfig::row(usize::from(size), first);
        let (running, pipes) = match simulators {
            Simulators::Embedded => {
                let counted = Counted::start("simulator", 1)?;
                let cancel = CancellationToken::new();
                let world = World::new(&row);
                let start = Simulator::start(world, 1.0, &[Endpoint::Pipes], cancel.clone());
                let Started { pipes, .. } = counted.runtime.block_on(start)?;
                (Running::Embedded { counted, cancel }, pipes)
            }
            Simulators::ArduPilot(program) => {
                let (instances, pipes) = Instances::start(program, &row.starts)?;
                (Running::ArduPilot(instances), pipes)
            }
        };
        let mut swarm = Self {
            size: usize::from(size),
            parts: Vec::new(),
            vehicles: BTreeMap::new(),
            refusal: None,
            running,
        };
        for _ in 0..swarm.size.div_ceil(SYSTEMS).max(1) {
            swarm.parts.push(Part::start()?);
        }
        for (index, pipe) in pipes.into_iter().enumerate() {
            let fleet = &swarm.parts[index / SYSTEMS].fleet;
            fleet.connect(Transport::Pipe(pipe))?;
        }
        Ok(swarm)
    }

    /// Takes in what the fleets report. Returns which vehicles have been heard for the first time.
    pub fn hear(&mut self) -> Vec<(usize, VehicleId)> {
        let mut appeared = Vec::new();
        for (number, part) in self.parts.iter_mut().enumerate() {
            while let Ok(event) = part.events.try_recv() {
                match event {
                    FleetEvent::Appeared(vehicle) => {
                        let id = (number, vehicle.borrow().id);
                        self.vehicles.insert(id, vehicle);
                        appeared.push(id);
                    }
                    FleetEvent::Linked(status, _) => part.links.push(status),
                    FleetEvent::Report(Report::Row(row))
                        if [RowState::Refused, RowState::TimedOut].contains(&row.state) =>
                    {
                        let why = row.explanation.map(|text| format!(": {text}"));
                        let why = why.unwrap_or_default();
                        self.refusal = Some(format!("vehicle {}: {}{why}", row.vehicle, row.state));
                    }
                    _ => {}
                }
            }
        }
        appeared
    }

    /// The last command that was not accepted.
    pub fn refusal(&self) -> Option<&str> {
        self.refusal.as_deref()
    }

    /// The vehicles that have been heard, in order.
    pub fn each(&self, mut look: impl FnMut(usize, &Vehicle)) {
        for (index, vehicle) in self.vehicles.values().enumerate() {
            look(index, &vehicle.borrow());
        }
    }

    /// How many vehicles can be armed, and how many there are to be.
    ///
    /// # Errors
    /// Why one never will.
    pub fn ready(&self) -> anyhow::Result<(usize, usize)> {
        let heard = self.vehicles.values();
        let ready = match &self.running {
            Running::Embedded { .. } => heard.filter(|v| v.borrow().ready_to_arm()).count(),
            Running::ArduPilot(instances) => instances.ready()?.min(heard.len()),
        };
        Ok((ready, self.size))
    }

    /// Gives one vehicle a command.
    pub fn order(&self, (part, vehicle): (usize, VehicleId), command: Command) {
        let order = Order {
            entry: EntryId(0),
            verb: "scale",
            retry: RETRY,
            command,
            renamed: None,
        };
        // A fleet that cannot take it shows in the vehicles, which do not move.
        let _ = self.parts[part].fleet.order(vehicle, order);
    }

    /// Gives all vehicles a command of their own.
    pub fn order_all(&self, command: impl Fn(&Vehicle) -> Command) {
        for (&id, vehicle) in &self.vehicles {
            let command = command(&vehicle.borrow());
            self.order(id, command);
        }
    }

    /// Messages that have reached the models, those of them that are missing, and those that the links had missed
    /// already.
    pub fn messages(&self) -> (u64, u64, u64) {
        let (mut received, mut missing) = (0, 0);
        self.each(|_, vehicle| {
            received += vehicle.link.received;
            missing += vehicle.link.missing;
        });
        let links = self.parts.iter().flat_map(|part| &part.links);
        let before = links.map(|status| status.borrow().lost_total).sum();
        (received, missing, before)
    }

    /// Processor time so far.
    ///
    /// # Errors
    /// The system does not tell, or a simulator has ended.
    pub fn spent(&self) -> io::Result<Spent> {
        let mut model = Vec::new();
        for part in &self.parts {
            model.extend(part.counted.spent()?);
        }
        Ok(match &self.running {
            Running::Embedded { counted, .. } => {
                let threads = counted.spent()?;
                Spent {
                    sim: threads.iter().sum(),
                    sim_thread: threads.into_iter().max(),
                    model,
                    relay: None,
                }
            }
            Running::ArduPilot(instances) => Spent {
                sim: instances.spent()?,
                sim_thread: None,
                model,
                relay: Some(instances.relay_spent()?),
            },
        })
    }

    /// Resident memory of all simulator processes.
    pub fn memory_bytes(&self) -> Option<u64> {
        match &self.running {
            Running::Embedded { .. } => None,
            Running::ArduPilot(instances) => instances
                .pids()
                .into_iter()
                .map(cost::memory_of_process)
                .sum(),
        }
    }

    /// Ends everything, and waits for the processes' end.
    pub fn end(self) {
        drop(self.parts);
        match self.running {
            Running::Embedded { counted, cancel } => {
                cancel.cancel();
                drop(counted);
            }
            Running::ArduPilot(instances) => instances.end(),
        }
    }
}

impl Part {
    fn start() -> anyhow::Result<Self> {
        let counted = Counted::start("model", 1)?;
        let (fleet, events) = in_runtime(counted.runtime.handle(), || {
            Fleet::start_wanting(STREAMS, Clock::start(), CancellationToken::new())
        });
        Ok(Self {
            counted,
            fleet,
            events,
            links: Vec::new(),
        })
    }
}

fn in_runtime<T>(runtime: &Handle, start: impl FnOnce() -> T) -> T {
    let _inside = runtime.enter();
    start()
}
