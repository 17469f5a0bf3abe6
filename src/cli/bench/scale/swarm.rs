//! Vehicles to measure, the console's fleets that control them, and the meters.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

use tokio::io::DuplexStream;
use tokio::sync::{mpsc, watch};
use tokio_util::sync::{CancellationToken, DropGuard};

use super::instances::{Instances, SitlBench};
use super::sample::ScaleMark;
use crate::cli::bench::cost::{Counted, Machine};
use crate::commands::{Command, QueryCommand};
use crate::fleet::{Fleet, FleetClock, FleetEvent};
use crate::geo::LatLon;
use crate::ledger::{EntryId, RowState};
use crate::link::{Endpoint, LinkStatus, Simulator, StartedSimulator, Transport};
use crate::session::{Report, Stream, VehicleCommand};
use crate::sim::{SYSTEMS, Start, World, WorldConfig};
use crate::vehicle::{Vehicle, VehicleId};
use crate::verb::{CountsAs, CrewDuty, Danger, Movement, Precedence, Retry, Verb};

/// The streamed messages: `GLOBAL_POSITION_INT` and `ATTITUDE`.
pub(super) const STREAMS: &[Stream] = &[stream(33, 10.0), stream(30, 10.0)];
/// `SYS_STATUS` and `EKF_STATUS_REPORT`: they show when a vehicle can be armed, and are not streamed afterwards.
const FOR_READINESS: [u32; 2] = [1, 193];
/// A verb for all commands, with enough retries to repeat each command until it is acknowledged.
const VERB: Verb = Verb {
    name: "scale",
    danger: Danger::None,
    retry: Retry::new(12, 1500, 20_000),
    precedence: Precedence::InTurn,
    movement: Movement::None,
    counts_as: CountsAs::Task,
    duty: CrewDuty::Flying,
    unsuited: &[],
};
/// The longest wait for a fleet to accept a command.
const TAKEN_WITHIN: Duration = Duration::from_secs(10);

const fn stream(message: u32, rate_hz: f64) -> Stream {
    Stream { message, rate_hz }
}

/// A row of vehicles and the fleets that control them. Dropping it ends both.
pub(super) struct ScaleSwarm<'a> {
    size: usize,
    parts: Vec<SwarmPart>,
    vehicles: BTreeMap<(usize, VehicleId), watch::Receiver<Arc<Vehicle>>>,
    refusal: Option<String>,
    running: RunningSimulation<'a>,
}

/// Up to 254 vehicles, each with its own system id, and the fleet that controls them.
struct SwarmPart {
    fleet: Fleet,
    events: mpsc::Receiver<FleetEvent>,
    links: Vec<watch::Receiver<LinkStatus>>,
    counted: Counted,
}

enum RunningSimulation<'a> {
    Embedded { counted: Counted, _end: DropGuard },
    ArduPilot(Instances<'a>, &'a SitlBench),
}

impl<'a> ScaleSwarm<'a> {
    /// Starts the vehicles (embedded ones if `bench` is `None`) and the console's fleets that
    /// control them.
    ///
    /// # Errors
    /// The reason why the vehicles or a fleet cannot be started.
    pub fn start(bench: Option<&'a SitlBench>, size: u16) -> anyhow::Result<Self> {
        let size = usize::from(size);
        let row = WorldConfig::row(
            size,
            Start {
                at: LatLon::new(50.4501, 30.5234),
                altitude_amsl_m: 180.0,
                heading_deg: 0.0,
            },
        );
        let (running, pipes) = match bench {
            None => embedded(&row)?,
            Some(bench) => {
                let (instances, pipes) = bench.launch(&row.starts)?;
                (RunningSimulation::ArduPilot(instances, bench), pipes)
            }
        };
        let parts: Vec<SwarmPart> = (0..size.div_ceil(SYSTEMS).max(1))
            .map(|_| SwarmPart::start())
            .collect::<anyhow::Result<_>>()?;
        for (index, pipe) in pipes.into_iter().enumerate() {
            parts[index / SYSTEMS]
                .fleet
                .connect(Transport::Pipe(pipe))?;
        }
        Ok(Self {
            size,
            parts,
            vehicles: BTreeMap::new(),
            refusal: None,
            running,
        })
    }

    /// Handles the fleets' reports.
    pub fn hear(&mut self) {
        for (number, part) in self.parts.iter_mut().enumerate() {
            while let Ok(event) = part.events.try_recv() {
                match event {
                    FleetEvent::Appeared(vehicle) => {
                        let id = vehicle.borrow().id;
                        self.vehicles.insert((number, id), vehicle);
                        for message in FOR_READINESS {
                            part.order(id, interval(stream(message, 1.0)));
                        }
                    }
                    FleetEvent::Linked(status, _) => part.links.push(status),
                    FleetEvent::Report(Report::Row(row))
                        if [RowState::Refused, RowState::TimedOut].contains(&row.state) =>
                    {
                        let why = row
                            .explanation
                            .map(|text| format!(": {text}"))
                            .unwrap_or_default();
                        self.refusal = Some(format!("vehicle {}: {}{why}", row.vehicle, row.state));
                    }
                    FleetEvent::Forwarding(_)
                    | FleetEvent::Parameters(..)
                    | FleetEvent::Report(_)
                    | FleetEvent::Warning(_)
                    | FleetEvent::Foreign(_)
                    | FleetEvent::Dropped(_) => {}
                }
            }
        }
    }

    /// The last command that was not accepted.
    pub fn refusal(&self) -> Option<&str> {
        self.refusal.as_deref()
    }

    /// A value for each vehicle heard by the fleets, in order.
    pub fn each<T>(&self, look: impl Fn(&Vehicle) -> T) -> Vec<T> {
        self.vehicles
            .values()
            .map(|vehicle| look(&vehicle.borrow()))
            .collect()
    }

    /// How many vehicles can be armed, and how many were started.
    ///
    /// # Errors
    /// The reason why a vehicle can never be armed.
    pub fn ready(&self) -> anyhow::Result<(usize, usize)> {
        let ready = match &self.running {
            RunningSimulation::Embedded { .. } => {
                let ready = self.each(Vehicle::ready_to_arm);
                ready.into_iter().filter(|is_ready| *is_ready).count()
            }
            RunningSimulation::ArduPilot(instances, _) => {
                instances.ready()?.min(self.vehicles.len())
            }
        };
        Ok((ready, self.size))
    }

    /// Sends each vehicle a command, which may depend on the vehicle.
    pub fn order(&mut self, command: impl Fn(&Vehicle) -> Command) {
        for (&(part, id), vehicle) in &self.vehicles {
            let command = command(&vehicle.borrow());
            if !self.parts[part].order(id, command) {
                self.refusal = Some("the console's queue is full".to_owned());
            }
        }
    }

    /// The state of all meters.
    ///
    /// # Errors
    /// The system does not report a figure, or a simulator has ended.
    pub fn mark(&self) -> anyhow::Result<ScaleMark> {
        let model: Result<_, _> = self.parts.iter().map(|part| part.counted.spent()).collect();
        let (sim, relay) = match &self.running {
            RunningSimulation::Embedded { counted, .. } => (vec![counted.spent()?], None),
            RunningSimulation::ArduPilot(instances, bench) => {
                (instances.spent()?, Some(bench.spent()?))
            }
        };
        let links = self.parts.iter().flat_map(|part| &part.links);
        Ok(ScaleMark {
            at: Instant::now(),
            sim,
            model: model?,
            relay,
            messages: self.each(|vehicle| vehicle.link.received).iter().sum(),
            missing: self.each(|vehicle| vehicle.link.missing).iter().sum(),
            missing_before: links.map(|status| status.borrow().lost()).sum(),
            clocks: self.each(|vehicle| {
                let at = [vehicle.attitude?.at, vehicle.global?.at];
                Some((vehicle.boot_ms?, at.into_iter().max()?))
            }),
            machine: Machine::now().unwrap_or_default(),
        })
    }
}

fn embedded(row: &WorldConfig) -> anyhow::Result<(RunningSimulation<'static>, Vec<DuplexStream>)> {
    let counted = Counted::start("simulator")?;
    let cancel = CancellationToken::new();
    let start = Simulator::start(World::new(row), 1.0, &[Endpoint::Pipes], cancel.clone());
    let StartedSimulator { pipes, .. } = counted.runtime.block_on(start)?;
    let running = RunningSimulation::Embedded {
        counted,
        _end: cancel.drop_guard(),
    };
    Ok((running, pipes))
}

/// The command that requests a stream.
pub(super) fn interval(Stream { message, rate_hz }: Stream) -> Command {
    Command::Query(QueryCommand::Interval { message, rate_hz })
}

impl SwarmPart {
    fn start() -> anyhow::Result<Self> {
        let counted = Counted::start("model")?;
        let inside = counted.runtime.enter();
        let (fleet, events) =
            Fleet::start_wanting(STREAMS, FleetClock::start(), CancellationToken::new());
        drop(inside);
        Ok(Self {
            fleet,
            events,
            links: Vec::new(),
            counted,
        })
    }

    /// Sends a command to a vehicle as soon as the fleet has room for it. Returns whether the fleet accepted it.
    fn order(&self, vehicle: VehicleId, command: Command) -> bool {
        let order = VehicleCommand::new(EntryId(0), &VERB, command);
        let until = Instant::now() + TAKEN_WITHIN;
        while self.fleet.order(vehicle, order.clone()).is_err() {
            if Instant::now() > until {
                return false;
            }
            sleep(Duration::from_millis(1));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::ArmingCommand;

    #[test]
    fn more_commands_than_the_fleet_keeps_are_not_lost() {
        let part = SwarmPart::start().expect("a thread");
        let (release, released) = std::sync::mpsc::channel::<()>();
        // The fleet's only thread is blocked until most commands have been given.
        part.counted.runtime.spawn(async move { released.recv() });
        let helper = std::thread::spawn(move || {
            sleep(Duration::from_millis(100));
            drop(release);
        });
        assert!(
            (0..3000)
                .all(|_| part.order(VehicleId::from(1_u8), Command::Arming(ArmingCommand::Arm)))
        );
        helper.join().expect("it only waits");
    }
}
