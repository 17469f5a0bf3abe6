//! The hub: it routes frames between links and vehicles.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

mod rivals;

use rivals::Rival;

use super::keepers::{BlockingFiles, BlockingKeeper, BlockingShelf, desk_of};
use super::sharing::Sharing;
use super::vehicle_task::{ParameterFeed, ToVehicle, VehicleTask};
use super::{FleetClock, FleetEvent, FleetRequest, Keeping};
use crate::doctor::is_of_a_station;
use crate::forward::{ForwardSpec, SentCommands};
use crate::inspector::Census;
use crate::ledger::RowState;
use crate::link::{
    self, Address, Inbound, LinkHandle, LinkId, LinkPeer, LinkServices, StationNews, Transport,
};
use crate::notice::Notice;
use crate::parameters::ParameterSnapshot;
use crate::session::{LOST_AFTER, Report, Session, Stream, VehicleCommand, Want, autopilot_of};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::wire::{ComponentId, Frame, SystemId};

/// The maximum number of batches of frames in the queue to the hub; beyond that, links read more slowly.
const INBOUND_KEPT: usize = 256;
/// The maximum number of batches of frames in the queue to one vehicle's task.
const BATCHES_KEPT: usize = 256;
/// The delay before a full queue is tried again.
const TRIED_AGAIN_AFTER: Duration = Duration::from_millis(50);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FrameSender {
    link: LinkId,
    peer: LinkPeer,
}

struct PeerRoute {
    sender: FrameSender,
    /// The autopilot's component; other components with its system id may use another route.
    component: ComponentId,
    heard_at: Duration,
    /// A second sender with the same system id.
    rival: Option<Rival>,
    inbox: mpsc::Sender<ToVehicle>,
    state: watch::Receiver<Arc<Vehicle>>,
    /// Waiting changes to the vehicle's simulator or its link, oldest first.
    wants: VecDeque<Want>,
}

impl PeerRoute {
    fn new(
        sender: FrameSender,
        component: ComponentId,
        heard_at: Duration,
        inbox: mpsc::Sender<ToVehicle>,
        state: watch::Receiver<Arc<Vehicle>>,
    ) -> Self {
        Self {
            sender,
            component,
            heard_at,
            rival: None,
            inbox,
            state,
            wants: VecDeque::new(),
        }
    }

    fn vehicle(&self) -> Arc<Vehicle> {
        Arc::clone(&self.state.borrow())
    }

    /// Delivers changes to the vehicle's simulator or its link while there is room. Each is sent
    /// only once, so none may be lost or reordered.
    fn hand_over_wants(&mut self) {
        while !self.wants.is_empty()
            && let Ok(room) = self.inbox.try_reserve()
            && let Some(want) = self.wants.pop_front()
        {
            room.send(ToVehicle::Want(want));
        }
    }
}

/// The channels and settings that the hub is started with.
pub(super) struct HubSurroundings {
    pub clock: FleetClock,
    /// Telemetry to request from vehicles.
    pub streams: &'static [Stream],
    pub keeping: Keeping,
    pub events: mpsc::Sender<FleetEvent>,
    pub cancel: CancellationToken,
}

struct Hub {
    clock: FleetClock,
    streams: &'static [Stream],
    keeping: Keeping,
    links: Vec<LinkHandle>,
    routes: BTreeMap<SystemId, PeerRoute>,
    sharing: Sharing,
    inbound: mpsc::Sender<Inbound>,
    events: mpsc::Sender<FleetEvent>,
    cancel: CancellationToken,
}

/// Runs the hub until it is cancelled or the console has dropped its end.
pub(super) async fn run(surroundings: HubSurroundings, mut requests: mpsc::Receiver<FleetRequest>) {
    let HubSurroundings {
        clock,
        streams,
        keeping,
        events,
        cancel,
    } = surroundings;
    let (inbound, mut inbound_out) = mpsc::channel(INBOUND_KEPT);
    let (sharing, mut overheard) = Sharing::new(keeping.address());
    let mut hub = Hub {
        clock,
        streams,
        keeping,
        links: Vec::new(),
        routes: BTreeMap::new(),
        sharing,
        inbound,
        events,
        cancel: cancel.clone(),
    };
    loop {
        tokio::select! {
            biased;
            () = cancel.cancelled() => return,
            request = requests.recv() => match request {
                Some(FleetRequest::Connect(transport)) => hub.connect(transport).await,
                Some(FleetRequest::Forward(spec, address)) => hub.forward(spec, address).await,
                Some(FleetRequest::Unforward(address)) => hub.sharing.close(&address),
                Some(FleetRequest::Order(vehicle, order)) => hub.order(vehicle, order).await,
                Some(FleetRequest::Steer(vehicle, steering)) => {
                    hub.pass_on(vehicle, ToVehicle::Steer(steering));
                }
                Some(FleetRequest::FetchParameters(vehicle)) => {
                    hub.pass_on(vehicle, ToVehicle::FetchParameters);
                }
                Some(FleetRequest::Sticks(vehicle, held)) => {
                    hub.pass_on(vehicle, ToVehicle::Sticks(held));
                }
                Some(FleetRequest::Restarted(vehicle)) => hub.pass_on(vehicle, ToVehicle::Restarted),
                Some(FleetRequest::Copy(vehicle, answer)) => hub.pass_on(vehicle, ToVehicle::Copy(answer)),
                Some(FleetRequest::Recall(vehicle, session, answer)) => {
                    hub.pass_on(vehicle, ToVehicle::Recall(session, answer));
                }
                Some(FleetRequest::Want(vehicle, want)) => hub.want(vehicle, want),
                Some(FleetRequest::Forget(vehicle)) => hub.forget(vehicle),
                None => return,
            },
            Some(batch) = inbound_out.recv() => hub.distribute(batch).await,
            Some(news) = overheard.news.recv() => hub.overhear(&news).await,
            // The relay has already passed these frames on.
            Some(_) = overheard.frames.recv() => {}
            () = tokio::time::sleep(TRIED_AGAIN_AFTER), if hub.has_wants() => {}
        }
        hub.routes.values_mut().for_each(PeerRoute::hand_over_wants);
    }
}

impl Hub {
    async fn connect(&mut self, transport: Transport) {
        let id = LinkId(self.links.len() as u16);
        let services = LinkServices {
            sink: self.keeping.sink.as_ref(),
            relay: &self.sharing.relay,
            signer: self.keeping.signer.as_ref(),
            system: self.keeping.address().system,
        };
        let (inbound, cancel) = (self.inbound.clone(), self.cancel.clone());
        let link = link::open_shared(id, transport, services, inbound, cancel);
        let news = FleetEvent::Linked(link.status(), link.tap());
        self.links.push(link);
        self.tell(news).await;
    }

    async fn forward(&mut self, spec: ForwardSpec, address: Address) {
        let feed = self.sharing.open(spec, address, &self.cancel);
        self.tell(FleetEvent::Forwarding(feed)).await;
    }

    /// Reports to the console that another ground station has sent vehicles a command.
    async fn overhear(&mut self, news: &StationNews) {
        let now = self.clock.now();
        let is_meant = |system: SystemId| news.system.is_none_or(|meant| meant == system);
        let routes = self.routes.iter().filter(|&(&system, _)| is_meant(system));
        let vehicles: Vec<_> = routes.map(|(_, route)| route.vehicle()).collect();
        for vehicle in vehicles {
            if let Some(row) = self.sharing.commanded(news, &vehicle, now) {
                self.tell(FleetEvent::Foreign(row)).await;
            }
        }
    }

    /// Reports a vehicle's answers to other stations.
    async fn attribute(&mut self, system: SystemId, frames: &[Frame], now: Duration) {
        let Some(vehicle) = self.routes.get(&system).map(PeerRoute::vehicle) else {
            return;
        };
        for frame in frames {
            if let Some(row) = self.sharing.heard(&frame.content, &vehicle, now) {
                self.tell(FleetEvent::Foreign(row)).await;
            }
        }
    }

    /// Passes an order on. An order that cannot be passed on is answered here, so no row waits
    /// forever.
    async fn order(&mut self, vehicle: VehicleId, order: VehicleCommand) {
        let system = SystemId::try_from(vehicle).ok();
        let reason = match system.and_then(|system| self.routes.get(&system)) {
            None => text!("outcome-not-heard"),
            Some(route) => match route.inbox.try_send(ToVehicle::Order(order.clone())) {
                Ok(()) => return,
                Err(_) => text!("outcome-task-busy"),
            },
        };
        let now = self.clock.now();
        let row = order.unsent(vehicle, RowState::Refused, reason, now);
        self.tell(FleetEvent::Report(Report::Row(row))).await;
    }

    /// Sends a message that a vehicle's task can miss: it is dropped if the task does not keep up, or if the vehicle
    /// was never heard.
    fn pass_on(&self, vehicle: VehicleId, news: ToVehicle) {
        let system = SystemId::try_from(vehicle).ok();
        if let Some(route) = system.and_then(|system| self.routes.get(&system)) {
            drop(route.inbox.try_send(news));
        }
    }

    /// Queues a change to a vehicle's simulator or its link, after earlier changes.
    fn want(&mut self, vehicle: VehicleId, want: Want) {
        let system = SystemId::try_from(vehicle).ok();
        if let Some(route) = system.and_then(|system| self.routes.get_mut(&system)) {
            route.wants.push_back(want);
        }
    }

    /// Drops the route of a vehicle, which ends its task.
    fn forget(&mut self, vehicle: VehicleId) {
        if let Ok(system) = SystemId::try_from(vehicle) {
            self.routes.remove(&system);
        }
    }

    /// Whether any change still waits for room.
    fn has_wants(&self) -> bool {
        self.routes.values().any(|route| !route.wants.is_empty())
    }

    /// Distributes frames to their vehicles; the frames of one vehicle stay together.
    async fn distribute(&mut self, batch: Inbound) {
        let mut by_system: BTreeMap<SystemId, Vec<Frame>> = BTreeMap::new();
        for frame in batch.frames {
            by_system.entry(frame.system).or_default().push(frame);
        }
        let sender = FrameSender {
            link: batch.link,
            peer: batch.peer,
        };
        for (system, frames) in by_system {
            self.deliver(system, sender, frames).await;
        }
        for row in self.sharing.due(self.clock.now()) {
            self.tell(FleetEvent::Foreign(row)).await;
        }
    }

    /// Tells the vehicles of a link what else is heard there. A vehicle that does not keep up misses it.
    fn tell_neighbours(&self, from: FrameSender, news: impl Fn() -> ToVehicle) {
        for route in self.routes.values() {
            if route.sender.link == from.link {
                drop(route.inbox.try_send(news()));
            }
        }
    }

    async fn deliver(&mut self, system: SystemId, from: FrameSender, frames: Vec<Frame>) {
        let now = self.clock.now();
        if system != self.keeping.address().system && frames.iter().any(is_of_a_station) {
            self.tell_neighbours(from, || ToVehicle::StationHeard);
        }
        if !self.routes.contains_key(&system) {
            let Some(component) = frames.iter().find_map(autopilot_of) else {
                return;
            };
            self.tell_neighbours(from, || ToVehicle::NewVehicle(system));
            self.appear(system, component, from, now).await;
        }
        let Some(route) = self.routes.get_mut(&system) else {
            return;
        };
        let is_autopilot = frames
            .iter()
            .any(|frame| frame.component == route.component && frame.is_verified());
        if is_autopilot {
            if route.sender != from && !self.reroute(system, from, &frames, now).await {
                return;
            }
            if let Some(route) = self.routes.get_mut(&system) {
                route.heard_at = now;
            }
            self.attribute(system, &frames, now).await;
        }
        self.hand_over(system, frames);
    }

    fn hand_over(&self, system: SystemId, frames: Vec<Frame>) {
        if let Some(route) = self.routes.get(&system)
            && route.inbox.try_send(ToVehicle::Frames(frames)).is_err()
        {
            tracing::warn!(
                system,
                "the vehicle's task does not keep up: telemetry was dropped"
            );
        }
    }

    /// Handles an autopilot that is heard on another route. If the current route has been silent
    /// for long enough, it is the same vehicle with a new connection or another port; otherwise it
    /// is a second vehicle with the same id, whose frames are not accepted. Returns whether the
    /// frames are accepted.
    async fn reroute(
        &mut self,
        system: SystemId,
        from: FrameSender,
        frames: &[Frame],
        now: Duration,
    ) -> bool {
        let (Some(route), Some(link)) = (
            self.routes.get_mut(&system),
            self.links.get(usize::from(from.link.0)),
        ) else {
            return false;
        };
        if now.saturating_sub(route.heard_at) < LOST_AFTER {
            self.meet_rival(system, from, frames, now).await;
            return false;
        }
        let news = ToVehicle::Route(link.clone(), from.peer);
        if route.inbox.try_send(news).is_err() {
            return false;
        }
        let before = std::mem::replace(&mut route.sender, from);
        let text = text!(
            "heard-by-another-link",
            link = self.name_of(from),
            before = self.name_of(before)
        );
        self.warn(system, text, now).await;
        true
    }

    async fn appear(&mut self, system: SystemId, component: u8, from: FrameSender, now: Duration) {
        let Some(link) = self.links.get(usize::from(from.link.0)) else {
            return;
        };
        let (inbox, inbox_out) = mpsc::channel(BATCHES_KEPT);
        let (state, state_out) = watch::channel(Arc::new(Vehicle::new(system, component)));
        let (parameters, parameters_out) = watch::channel(ParameterSnapshot::default());
        let mut session = Session::new(system, component, now)
            .as_station(self.keeping.address().system)
            .wanting(self.streams, now);
        if let Some(keeper) = &self.keeping.logs {
            session = session.keeping_logs(Arc::new(BlockingKeeper(Arc::clone(keeper))));
        }
        if let Some(desk) = &self.keeping.files {
            session = session.with_files(Arc::new(BlockingFiles(Arc::clone(desk))));
        }
        if let Some(events) = &self.keeping.events {
            session = session.knowing_events(Arc::clone(events));
        }
        if let Some(shelf) = &self.keeping.plans {
            session = session.with_plan_files(Arc::new(BlockingShelf(Arc::clone(shelf))));
        }
        session.sign_with(desk_of(link));
        session.heard_via(from.link.0, now);
        let task = VehicleTask {
            session,
            clock: self.clock.clone(),
            inbox: inbox_out,
            route: (link.clone(), from.peer),
            reconnects: link.status().borrow().reconnects,
            state,
            parameters: ParameterFeed::new(parameters),
            events: self.events.clone(),
            backlog: VecDeque::new(),
            dropped: 0,
            sent: SentCommands::default(),
            own: self.keeping.address(),
            is_twin_said: Arc::clone(&self.sharing.is_twin_said),
        };
        tokio::spawn(task.run(self.cancel.clone()));
        tracing::info!(system, link = from.link.0, "a vehicle is heard");
        let route = PeerRoute::new(from, component, now, inbox, state_out.clone());
        self.routes.insert(system, route);
        self.tell(FleetEvent::Appeared(state_out)).await;
        let id = VehicleId::from(system);
        self.tell(FleetEvent::Parameters(id, parameters_out)).await;
    }

    async fn warn(&self, system: SystemId, text: Text, now: Duration) {
        let notice = Notice::about(VehicleId::from(system), now, Severity::Error, text);
        self.tell(FleetEvent::Warning(notice)).await;
    }

    /// The name of the link, with the peer's network address if the link has several peers.
    fn name_of(&self, sender: FrameSender) -> Text {
        let Some(link) = self.links.get(usize::from(sender.link.0)) else {
            return Text::default();
        };
        let name = link.status().borrow().name.clone();
        let peer = |census: &mut Census, _| census.peer_name(sender.peer.0).map(str::to_owned);
        match link.tap().look(peer) {
            Some(peer) => text!("heard-from-peer", link = name, peer = peer),
            None => name,
        }
    }

    /// Sends an event to the console, and waits if necessary: events are rare, and frames wait in the links meanwhile.
    async fn tell(&self, event: FleetEvent) {
        // An error means that the console is gone; the cancellation will follow.
        drop(self.events.send(event).await);
    }
}

#[cfg(test)]
mod tests;
