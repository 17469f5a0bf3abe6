//! The fleet against the embedded simulator, over pipes and real sockets.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use futures_util::FutureExt as _;
use futures_util::future::{pending, select_all};
use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavAutopilot, MavMessage, MavType};
use sortie::commands::{Act, Command};
use sortie::fleet::{Fleet, FleetClock, FleetEvent, ForwardFeed, Keeping};
use sortie::geo::LatLon;
use sortie::language::{self, Context, Meaning};
use sortie::ledger::{EntryId, ForeignId, RowState, RowUpdate};
use sortie::link::{Endpoint, LinkState, LinkStatus, Simulator, Tap, Transport};
use sortie::parameters::ParameterSnapshot;
use sortie::session::{Report, VehicleCommand};
use sortie::sim::{Start, World, WorldConfig};
use sortie::vehicle::{Vehicle, VehicleId};
use sortie::wire::Encoder;
use tokio::net::UdpSocket;
use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

mod control;
pub(crate) mod files;
mod forwards;
mod logs;
mod parameters;
mod senders;
pub(crate) mod signing;
mod sticks;

const PATIENCE: Duration = Duration::from_secs(90);

fn world(vehicles: usize) -> World {
    let start = Start {
        at: LatLon::new(50.4501, 30.5234),
        altitude_amsl_m: 180.0,
        heading_deg: 0.0,
    };
    World::new(&WorldConfig::row(vehicles, start))
}

/// Waits for a change of a watched value; forever if its sender is gone.
async fn changed<T>(state: &mut watch::Receiver<T>) {
    if state.changed().await.is_err() {
        pending::<()>().await;
    }
}

/// A fleet, and all events that it has sent.
pub struct Console {
    fleet: Fleet,
    events: mpsc::Receiver<FleetEvent>,
    vehicles: BTreeMap<VehicleId, watch::Receiver<Arc<Vehicle>>>,
    parameters: BTreeMap<VehicleId, watch::Receiver<ParameterSnapshot>>,
    links: Vec<watch::Receiver<LinkStatus>>,
    taps: Vec<Tap>,
    forwards: Vec<ForwardFeed>,
    rows: Vec<RowUpdate>,
    notices: Vec<String>,
    /// The commands of other stations with their outcomes.
    foreign: BTreeMap<ForeignId, String>,
    entries: u32,
}

impl Console {
    pub fn start() -> Self {
        Self::start_kept(Keeping::default())
    }

    /// A console that stores data.
    pub fn start_kept(keeping: Keeping) -> Self {
        let (fleet, events) =
            Fleet::start_kept(keeping, FleetClock::start(), CancellationToken::new());
        Self {
            fleet,
            events,
            vehicles: BTreeMap::new(),
            parameters: BTreeMap::new(),
            links: Vec::new(),
            taps: Vec::new(),
            forwards: Vec::new(),
            rows: Vec::new(),
            notices: Vec::new(),
            foreign: BTreeMap::new(),
            entries: 0,
        }
    }

    pub fn connect(&self, address: &str) {
        let address = address.parse().expect("an address");
        self.fleet
            .connect(Transport::Address(address))
            .expect("the fleet runs");
    }

    /// Connects to a byte pipe within this program.
    pub fn connect_to(&self, pipe: tokio::io::DuplexStream) {
        let connected = self.fleet.connect(Transport::Pipe(pipe));
        connected.expect("the fleet runs");
    }

    /// Runs the fleet until a condition is true.
    pub async fn until(&mut self, what: &str, mut is_true: impl FnMut(&Self) -> bool) {
        let waiting = async {
            while !is_true(self) {
                let vehicles = self
                    .vehicles
                    .values_mut()
                    .map(|state| changed(state).boxed());
                let links = self.links.iter_mut().map(|state| changed(state).boxed());
                let parameters = self
                    .parameters
                    .values_mut()
                    .map(|state| changed(state).boxed());
                let changes = select_all(
                    vehicles
                        .chain(links)
                        .chain(parameters)
                        .chain([pending().boxed()]),
                );
                let event = tokio::select! {
                    Some(event) = self.events.recv() => event,
                    _ = changes => continue,
                };
                self.hear(event);
            }
        };
        let outcome = tokio::time::timeout(PATIENCE, waiting).await;
        assert!(
            outcome.is_ok(),
            "waited in vain until {what}: {:?} {:?}",
            self.rows,
            self.notices
        );
    }

    fn hear(&mut self, event: FleetEvent) {
        match event {
            FleetEvent::Appeared(vehicle) => {
                let id = vehicle.borrow().id;
                self.vehicles.insert(id, vehicle);
            }
            FleetEvent::Parameters(id, parameters) => drop(self.parameters.insert(id, parameters)),
            FleetEvent::Linked(link, tap) => {
                self.links.push(link);
                self.taps.push(tap);
            }
            FleetEvent::Forwarding(feed) => self.forwards.push(feed),
            FleetEvent::Dropped(count) => panic!("{count} reports were dropped"),
            FleetEvent::Report(Report::Row(row)) => self.rows.push(row),
            FleetEvent::Report(Report::Folder(_)) => {}
            FleetEvent::Foreign(command) => {
                let line = format!("{}: {}", command.line(), command.outcome());
                self.foreign.insert(command.id, line);
            }
            FleetEvent::Report(Report::Notice(notice)) | FleetEvent::Warning(notice) => {
                self.notices.push(notice.text.to_string());
            }
        }
    }

    pub fn vehicle(&self, id: VehicleId) -> Option<Arc<Vehicle>> {
        self.vehicles
            .get(&id)
            .map(|vehicle| Arc::clone(&vehicle.borrow()))
    }

    /// Gives a line of the command language to vehicles, and returns its entry in the ledger.
    pub fn give(&mut self, line: &str, targets: &[VehicleId]) -> EntryId {
        let context = Context {
            vehicles: targets,
            ..Context::default()
        };
        let statement = language::parse(line, &context).expect("a good line");
        let Meaning::Act(Act::Command(command)) = statement.meaning else {
            panic!("{line} is no command");
        };
        let entry = EntryId(self.entries);
        self.entries += 1;
        for &target in targets {
            let order = VehicleCommand::new(entry, statement.verb, Command::clone(&command));
            self.fleet.order(target, order).expect("the fleet runs");
        }
        entry
    }

    pub fn state(&self, entry: EntryId, vehicle: VehicleId) -> Option<RowState> {
        self.rows
            .iter()
            .rev()
            .find(|row| row.entry == entry && row.vehicle == vehicle)
            .map(|row| row.state)
    }

    pub async fn until_done(&mut self, entry: EntryId, vehicle: VehicleId) {
        let what = format!("{entry:?} is done by {vehicle}");
        self.until(&what, |console| {
            console
                .state(entry, vehicle)
                .is_some_and(RowState::is_final)
        })
        .await;
        assert_eq!(
            self.state(entry, vehicle),
            Some(RowState::Done),
            "{:?}",
            self.rows
        );
    }

    pub async fn until_ready(&mut self, ids: &[VehicleId]) {
        self.until("all are ready to arm", |console| {
            ids.iter().all(|&id| {
                console
                    .vehicle(id)
                    .is_some_and(|vehicle| vehicle.ready_to_arm())
            })
        })
        .await;
    }
}

async fn serve(world: World, speedup: f64) -> (Vec<String>, CancellationToken) {
    let cancel = CancellationToken::new();
    let endpoint = Endpoint::Tcp {
        host: "127.0.0.1".to_owned(),
        port: 0,
    };
    let started = Simulator::start(world, speedup, &[endpoint], cancel.clone())
        .await
        .expect("ports are free");
    let addresses = started
        .addresses
        .iter()
        .map(|address| format!("tcp:{address}"));
    (addresses.collect(), cancel)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn four_vehicles_fly_the_classic_flow_over_pipes() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(4), 10.0, &[Endpoint::Pipes], cancel.clone())
        .await
        .expect("pipes always open");
    let mut console = Console::start();
    for pipe in started.pipes {
        console
            .fleet
            .connect(Transport::Pipe(pipe))
            .expect("the fleet runs");
    }
    let all = [1, 2, 3, 4];
    console.until_ready(&all).await;
    let takeoff = {
        console.give("guided", &all);
        console.give("arm", &all);
        console.give("takeoff 20", &all)
    };
    for id in all {
        console.until_done(takeoff, id).await;
    }
    let goto = console.give("goto n 40 e 10 up 25", &all);
    for id in all {
        console.until_done(goto, id).await;
    }
    let land = console.give("rtl", &all);
    for id in all {
        console.until_done(land, id).await;
    }
    console
        .until("all are back on the ground", |console| {
            all.iter()
                .all(|&id| console.vehicle(id).is_some_and(|vehicle| !vehicle.armed()))
        })
        .await;
    for id in all {
        let vehicle = console.vehicle(id).expect("it appeared");
        assert!(vehicle.distance_home_m().is_some_and(|metres| metres < 1.5));
    }
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_refused_arm_is_explained_in_plain_words() {
    let (addresses, cancel) = serve(world(1), 5.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console.until_ready(&[1]).await;
    let land = console.give("land", &[1]);
    console.until_done(land, 1).await;
    let arm = console.give("arm", &[1]);
    console
        .until("the arm is refused", |console| {
            console.state(arm, 1) == Some(RowState::Refused)
        })
        .await;
    let text = console
        .rows
        .iter()
        .rev()
        .find_map(|row| row.explanation.clone());
    assert!(
        text.as_ref()
            .is_some_and(|text| text.to_string().contains("LAND mode not armable")),
        "{text:?}"
    );
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_vehicle_that_reboots_is_noticed_and_resumed() {
    let (addresses, cancel) = serve(world(1), 5.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console
        .until("it has been up for a while", |console| {
            console
                .vehicle(1)
                .and_then(|vehicle| vehicle.boot_ms)
                .is_some_and(|ms| ms > 10_000)
        })
        .await;
    console.give("reboot", &[1]);
    console
        .until("the reboot is noticed", |console| {
            console
                .vehicle(1)
                .is_some_and(|vehicle| vehicle.link.reboots == 1)
        })
        .await;
    console.until_ready(&[1]).await;
    assert_eq!(
        console.vehicles.len(),
        1,
        "the same vehicle, not a second one"
    );
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_address_where_nobody_listens_says_so_and_goes_on_trying() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("it is bound");
    drop(listener);
    let mut console = Console::start();
    console.connect(&format!("tcp:{address}"));
    console
        .until("the refusal is shown", |console| {
            console.links.first().is_some_and(|link| {
                let status = link.borrow();
                matches!(status.state, LinkState::Waiting { .. })
                    && status
                        .last_error
                        .as_ref()
                        .is_some_and(|error| error.to_string().contains("refused"))
            })
        })
        .await;
}
