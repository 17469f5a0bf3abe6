//! The task of one vehicle: its session, driven by frames, orders and time.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::sync::{mpsc, oneshot, watch};
use tokio_util::sync::CancellationToken;

use super::keepers::desk_of;
use super::{FleetClock, FleetEvent};
use crate::forward::SentCommands;
use crate::link::{LinkHandle, LinkPeer, To};
use crate::notice::Notice;
use crate::parameters::{Fetching, ParameterSnapshot};
use crate::session::{Report, Session, Steering, VehicleCommand, Want};
use crate::text;
use crate::vehicle::{HeldChannels, Severity, Vehicle};
use crate::wire::{Frame, MavAddress, SystemId};

/// The maximum number of reports that a task keeps while the console does not read.
const BACKLOG: usize = 1000;
/// The interval of parameter snapshots while a list arrives.
const PARAMETERS_EVERY: Duration = Duration::from_millis(200);

/// A message from the hub to the task of a vehicle.
pub(super) enum ToVehicle {
    /// Frames of this vehicle.
    Frames(Vec<Frame>),
    Order(VehicleCommand),
    /// A setpoint for the vehicle in a manoeuvre.
    Steer(Steering),
    /// A request to download all its parameters.
    FetchParameters,
    /// The positions of its sticks; `None` releases them.
    Sticks(Option<HeldChannels>),
    /// Another vehicle with its system id is heard.
    Twin,
    /// Its autopilot has been restarted.
    Restarted,
    /// Send a copy of the conversation.
    Copy(oneshot::Sender<Session>),
    /// Continue an earlier conversation.
    Recall(Box<Session>, oneshot::Sender<()>),
    /// A vehicle with this system id has appeared on its link.
    NewVehicle(SystemId),
    /// Another ground station is heard on its link.
    StationHeard,
    /// A change to its simulator or its link.
    Want(Want),
    /// The vehicle is now reached over another link or peer.
    Route(LinkHandle, LinkPeer),
}

/// The state of a vehicle's task.
pub(super) struct VehicleTask {
    pub session: Session,
    pub clock: FleetClock,
    pub inbox: mpsc::Receiver<ToVehicle>,
    pub route: (LinkHandle, LinkPeer),
    /// The link's number of reconnections at the last check.
    pub reconnects: u32,
    pub state: watch::Sender<Arc<Vehicle>>,
    pub parameters: ParameterFeed,
    pub events: mpsc::Sender<FleetEvent>,
    pub backlog: VecDeque<Report>,
    /// Reports dropped since the last notice.
    pub dropped: u64,
    /// The commands sent to the vehicle.
    pub sent: SentCommands,
    /// The console's own address.
    pub own: MavAddress,
    /// Whether a station with the console's own address has been reported.
    pub is_twin_said: Arc<AtomicBool>,
}

/// Publishes parameters while they arrive: as a list a few times a second, not one by one.
pub(super) struct ParameterFeed {
    sender: watch::Sender<ParameterSnapshot>,
    published: (u64, Fetching, usize),
    at: Duration,
}

impl ParameterFeed {
    pub fn new(sender: watch::Sender<ParameterSnapshot>) -> Self {
        Self {
            sender,
            published: (0, Fetching::NotAsked, 0),
            at: Duration::ZERO,
        }
    }

    fn publish(&mut self, news: ParameterSnapshot, now: Duration) {
        let documented = news.documents.len();
        let state = (news.list.revision(), news.fetching, documented);
        // While a reader holds a snapshot, the next change copies the list.
        let is_due = !news.fetching.is_under_way() || now >= self.at + PARAMETERS_EVERY;
        if state != self.published && is_due {
            self.published = state;
            self.at = now;
            self.sender.send_replace(news);
        }
    }
}

impl VehicleTask {
    /// Runs the task until it is cancelled or the hub has ended.
    pub async fn run(mut self, cancel: CancellationToken) {
        loop {
            let patience = self.session.patience();
            tokio::select! {
                biased;
                () = cancel.cancelled() => return,
                message = self.inbox.recv() => match message {
                    Some(message) => self.take(message),
                    None => return,
                },
                () = tokio::time::sleep(patience) => {}
            }
            self.notice_reconnection();
            self.session.poll(self.clock.now());
            self.send();
            self.publish();
            self.report();
        }
    }

    fn notice_reconnection(&mut self) {
        let link = &self.route.0;
        let reconnects = link.status().borrow().reconnects;
        if reconnects != self.reconnects {
            self.reconnects = reconnects;
            self.session.heard_via(link.id().0, self.clock.now());
        }
    }

    fn take(&mut self, message: ToVehicle) {
        let now = self.clock.now();
        match message {
            ToVehicle::Frames(frames) => {
                for frame in &frames {
                    self.look_for_twin(frame, now);
                    self.session.receive(frame, now);
                }
            }
            ToVehicle::Order(order) => self.session.order(order, now),
            ToVehicle::Steer(steering) => self.steer(&steering, now),
            ToVehicle::FetchParameters => self.session.fetch_parameters(now),
            ToVehicle::Sticks(held) => self.session.steer_by_hand(held, now),
            ToVehicle::Twin => self.session.note_twin(now),
            ToVehicle::Restarted => self.session.restarted(now),
            ToVehicle::Copy(answer) => drop(answer.send(self.session.clone())),
            ToVehicle::Recall(session, answer) => {
                self.session = *session;
                self.backlog.clear();
                self.route.0.hush(self.session.is_cut());
                self.publish();
                // The asker may be gone.
                let _ = answer.send(());
            }
            ToVehicle::NewVehicle(system) => self.session.hear_new_vehicle(system, now),
            ToVehicle::StationHeard => self.session.station_heard(now),
            ToVehicle::Want(want) => {
                self.session.carry_out(want);
                // In missions, each vehicle has its own link.
                self.route.0.hush(self.session.is_cut());
            }
            ToVehicle::Route(link, peer) => {
                self.session.sign_with(desk_of(&link));
                self.session.heard_via(link.id().0, now);
                self.session.moved(now);
                self.reconnects = link.status().borrow().reconnects;
                self.route = (link, peer);
            }
        }
    }

    /// Reports once that another ground station has the console's address: answers to its commands
    /// cannot be distinguished from answers to this console's.
    fn look_for_twin(&mut self, frame: &Frame, now: Duration) {
        let vehicle = self.session.vehicle().id;
        let Some(command) = self.sent.stray(&frame.content, self.own, now) else {
            return;
        };
        if self.is_twin_said.swap(true, Ordering::Relaxed) {
            return;
        }
        let text = text!(
            "foreign-twin",
            system = self.own.system,
            component = self.own.component,
            vehicle = vehicle,
            command = command
        );
        let notice = Notice::about(vehicle, now, Severity::Warning, text);
        if self.events.try_send(FleetEvent::Warning(notice)).is_err() {
            self.is_twin_said.store(false, Ordering::Relaxed);
        }
    }

    /// Sends a setpoint to the vehicle. An impossible one is not reported separately: the manoeuvre
    /// detects that the vehicle does not move.
    fn steer(&mut self, steering: &Steering, now: Duration) {
        if let Err(reason) = self.session.steer(steering, now) {
            tracing::warn!(vehicle = self.session.vehicle().id, "not steered: {reason}");
        }
    }

    /// Sends the session's frames. A full link counts the frames that it drops; a command's own
    /// retries repeat them.
    fn send(&mut self) {
        let (link, peer) = &self.route;
        let now = self.clock.now();
        for message in self.session.take_outgoing() {
            self.sent.note(&message, now);
            link.send(To::Peer(*peer), message);
        }
    }

    fn publish(&mut self) {
        self.parameters
            .publish(self.session.parameters(), self.clock.now());
        let vehicle = self.session.vehicle();
        self.state.send_if_modified(|state| {
            let changed = **state != *vehicle;
            if changed {
                *state = Arc::new(vehicle.clone());
            }
            changed
        });
    }

    /// Delivers reports. Rows of the ledger take precedence over notices when the console is slow.
    fn report(&mut self) {
        let reports = self.session.take_reports();
        reports.iter().for_each(log);
        self.backlog.extend(reports);
        while let Some(report) = self.backlog.pop_front() {
            if let Err(error) = self.events.try_send(FleetEvent::Report(report)) {
                if let mpsc::error::TrySendError::Full(FleetEvent::Report(report)) = error {
                    self.backlog.push_front(report);
                }
                break;
            }
        }
        if self.backlog.len() > BACKLOG {
            let before = self.backlog.len();
            self.backlog
                .retain(|report| matches!(report, Report::Row(_)));
            // The newest rows are the final ones, so the oldest are dropped.
            let surplus = self.backlog.len().saturating_sub(BACKLOG);
            self.backlog.drain(..surplus);
            self.dropped += (before - self.backlog.len()) as u64;
        }
        let dropped = FleetEvent::Dropped(self.dropped);
        if self.dropped > 0 && self.events.try_send(dropped).is_ok() {
            self.dropped = 0;
        }
    }
}

fn log(report: &Report) {
    match report {
        Report::Row(row) => tracing::debug!(
            entry = row.entry.0,
            vehicle = row.vehicle,
            tries = row.tries,
            explanation = row.explanation.as_ref().map(ToString::to_string),
            "{}",
            row.state
        ),
        Report::Folder(listed) => tracing::debug!(
            vehicle = listed.vehicle,
            folder = listed.folder,
            entries = listed.entries.len(),
            "folder"
        ),
        Report::Notice(notice) => {
            tracing::info!(vehicle = notice.vehicle, severity = %notice.severity, "{}", notice.text);
        }
    }
}
