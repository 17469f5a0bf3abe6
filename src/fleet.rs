//! All vehicles and links of a running console.
//!
//! One hub task owns the links and the route of each system id; one task per vehicle owns its
//! [`Session`]. Frames go from a link through the hub to the vehicle's task, state comes back
//! through a `watch` per vehicle, and events through one bounded channel. No vehicle waits for another: a full queue
//! drops telemetry, which comes again, and is counted.

use std::sync::Arc;

use tokio::sync::{mpsc, oneshot, watch};
use tokio_util::sync::CancellationToken;

use crate::forward::ForwardSpec;
use crate::ledger::ForeignCommand;
use crate::link::{Address, FrameSink, LinkStatus, Signer, Tap, Transport};
use crate::metadata::EventDocuments;
use crate::notice::Notice;
use crate::parameters::ParameterSnapshot;
use crate::session::{
    FileDesk, LogKeeper, PlanShelf, Report, Session, Steering, Stream, VehicleCommand,
    WANTED_STREAMS, Want,
};
use crate::text;
use crate::text::Text;
use crate::vehicle::{HeldChannels, Vehicle, VehicleId};
use crate::wire::{GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, MavAddress, SystemId};

mod clock;
mod hub;
mod keepers;
mod sharing;
mod vehicle_task;

pub use clock::FleetClock;
pub use sharing::ForwardFeed;

/// The maximum number of reports in the queue to the console; further notices are dropped.
const EVENTS_KEPT: usize = 4096;
/// The maximum number of requests in the queue to the hub.
const REQUESTS_KEPT: usize = 1024;

/// News from the fleet for the console.
#[derive(Debug)]
pub enum FleetEvent {
    /// A vehicle was heard for the first time; its state can be watched from now on.
    Appeared(watch::Receiver<Arc<Vehicle>>),
    /// The parameters of a vehicle that was heard for the first time can be watched from now on.
    Parameters(VehicleId, watch::Receiver<ParameterSnapshot>),
    /// A link was opened; its state and its frames can be watched from now on.
    Linked(watch::Receiver<LinkStatus>, Tap),
    /// A forward was opened; it can be watched until it ends.
    Forwarding(ForwardFeed),
    /// A command's progress, or a notice of a vehicle.
    Report(Report),
    /// A fault in the connections to vehicles.
    Warning(Notice),
    /// A command of another ground station, or its new state.
    Foreign(ForeignCommand),
    /// This many further reports were dropped because the console did not read them.
    Dropped(u64),
}

enum FleetRequest {
    Connect(Transport),
    Forward(ForwardSpec, Address),
    Unforward(String),
    Order(VehicleId, VehicleCommand),
    Steer(VehicleId, Steering),
    FetchParameters(VehicleId),
    Sticks(VehicleId, Option<HeldChannels>),
    Restarted(VehicleId),
    Copy(VehicleId, oneshot::Sender<Session>),
    Recall(VehicleId, Box<Session>, oneshot::Sender<()>),
    Want(VehicleId, Want),
    Forget(VehicleId),
}

/// The data that the fleet stores: frames, logs and keys; and the id under which it sends.
#[derive(Debug, Clone, Default)]
pub struct Keeping {
    /// The recorder of the frames of all links.
    pub sink: Option<FrameSink>,
    /// The storage for downloaded logs.
    pub logs: Option<Arc<dyn LogKeeper>>,
    /// The files that are copied to and from vehicles.
    pub files: Option<Arc<dyn FileDesk>>,
    /// The files of plans.
    pub plans: Option<Arc<dyn PlanShelf>>,
    /// The texts of events, from a file of the user.
    pub events: Option<Arc<EventDocuments>>,
    /// The keys of signed links.
    pub signer: Option<Signer>,
    /// The system id of this program; the usual one if there is none.
    pub station: Option<SystemId>,
}

impl Keeping {
    /// This program's address on every link.
    fn address(&self) -> MavAddress {
        MavAddress {
            system: self.station.unwrap_or(GROUND_STATION_SYSTEM),
            component: GROUND_STATION_COMPONENT,
        }
    }
}

/// The console's end of the fleet. Dropping it, or cancelling its token, ends every task.
#[derive(Debug)]
pub struct Fleet {
    requests: mpsc::Sender<FleetRequest>,
    cancel: CancellationToken,
}

impl Fleet {
    /// Starts an empty fleet. Must be called inside a tokio runtime.
    pub fn start(
        clock: FleetClock,
        cancel: CancellationToken,
    ) -> (Self, mpsc::Receiver<FleetEvent>) {
        Self::spawn(WANTED_STREAMS, Keeping::default(), clock, cancel)
    }

    /// Starts an empty fleet that stores frames or logs.
    pub fn start_kept(
        keeping: Keeping,
        clock: FleetClock,
        cancel: CancellationToken,
    ) -> (Self, mpsc::Receiver<FleetEvent>) {
        Self::spawn(WANTED_STREAMS, keeping, clock, cancel)
    }

    /// Starts an empty fleet that requests the given telemetry instead of the console's.
    pub fn start_wanting(
        streams: &'static [Stream],
        clock: FleetClock,
        cancel: CancellationToken,
    ) -> (Self, mpsc::Receiver<FleetEvent>) {
        Self::spawn(streams, Keeping::default(), clock, cancel)
    }

    fn spawn(
        streams: &'static [Stream],
        keeping: Keeping,
        clock: FleetClock,
        cancel: CancellationToken,
    ) -> (Self, mpsc::Receiver<FleetEvent>) {
        let (requests, requests_in) = mpsc::channel(REQUESTS_KEPT);
        let (events, events_out) = mpsc::channel(EVENTS_KEPT);
        let surroundings = hub::HubSurroundings {
            clock,
            streams,
            keeping,
            events,
            cancel: cancel.clone(),
        };
        tokio::spawn(hub::run(surroundings, requests_in));
        (Self { requests, cancel }, events_out)
    }

    /// Opens a link. Its state arrives as [`FleetEvent::Linked`].
    ///
    /// # Errors
    /// The hub has ended or cannot keep up.
    pub fn connect(&self, transport: Transport) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Connect(transport))
    }

    /// Shares the links with the ground stations at an address. The forward can be watched once
    /// [`FleetEvent::Forwarding`] has arrived.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up.
    pub fn forward(&self, spec: ForwardSpec, address: Address) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Forward(spec, address))
    }

    /// Ends the forwards at an address, spelled as it was when they were opened.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up.
    pub fn unforward(&self, address: &str) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Unforward(address.to_owned()))
    }

    /// Sends a command to one vehicle. Its progress arrives as [`FleetEvent::Report`].
    ///
    /// # Errors
    /// The hub has ended or cannot keep up; nothing was sent.
    pub fn order(&self, vehicle: VehicleId, order: VehicleCommand) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Order(vehicle, order))
    }

    /// Sends a setpoint to a vehicle in a manoeuvre.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up; nothing was sent.
    pub fn steer(&self, vehicle: VehicleId, steering: Steering) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Steer(vehicle, steering))
    }

    /// Downloads all parameters of a vehicle. They arrive at the receiver of [`FleetEvent::Parameters`].
    ///
    /// # Errors
    /// The hub has ended or cannot keep up; nothing was requested.
    pub fn fetch_parameters(&self, vehicle: VehicleId) -> Result<(), Unreachable> {
        self.ask(FleetRequest::FetchParameters(vehicle))
    }

    /// Holds the channels of a vehicle's transmitter for a second; `None` releases all channels.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up; nothing was sent.
    pub fn steer_by_hand(
        &self,
        vehicle: VehicleId,
        held: Option<HeldChannels>,
    ) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Sticks(vehicle, held))
    }

    /// A copy of the conversation with a vehicle; `None` if there is none, or if its task cannot keep up.
    pub async fn copy(&self, vehicle: VehicleId) -> Option<Session> {
        let (answer, copied) = oneshot::channel();
        self.ask(FleetRequest::Copy(vehicle, answer)).ok()?;
        copied.await.ok()
    }

    /// Continues an earlier conversation with a vehicle, which then must be as it was. Once this has returned, nothing of
    /// the later conversation is published any more.
    ///
    /// # Errors
    /// The hub or the vehicle's task has ended or cannot keep up; nothing was sent.
    pub async fn recall(&self, vehicle: VehicleId, session: Session) -> Result<(), Unreachable> {
        let (answer, recalled) = oneshot::channel();
        self.ask(FleetRequest::Recall(vehicle, Box::new(session), answer))?;
        recalled.await.map_err(|_| Unreachable)
    }

    /// Records that a vehicle's autopilot was restarted: its earlier state is void.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up.
    pub fn restarted(&self, vehicle: VehicleId) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Restarted(vehicle))
    }

    /// Changes a vehicle's simulator, or the simulated radio between the vehicle and the console.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up; nothing was done.
    pub fn carry_out(&self, vehicle: VehicleId, want: Want) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Want(vehicle, want))
    }

    /// Ends a vehicle's task. If it is heard again, it appears as a new vehicle.
    ///
    /// # Errors
    /// The hub has ended or cannot keep up.
    pub fn forget(&self, vehicle: VehicleId) -> Result<(), Unreachable> {
        self.ask(FleetRequest::Forget(vehicle))
    }

    fn ask(&self, request: FleetRequest) -> Result<(), Unreachable> {
        self.requests.try_send(request).map_err(|_| Unreachable)
    }
}

impl Drop for Fleet {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

/// The fleet's hub has ended or has too many requests waiting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{}", Text::from(*self))]
pub struct Unreachable;

impl From<Unreachable> for Text {
    fn from(_: Unreachable) -> Self {
        text!("transport-fleet-busy")
    }
}
