//! The connections of the host.

use std::collections::{BTreeMap, VecDeque};
use std::time::{Duration, Instant};

use tokio::sync::watch;
use tokio::task::JoinHandle;

use super::tail::{RecordSight, send_record};
use crate::app::effect::CrewEffect;
use crate::app::event::CrewEvent;
use crate::carrier::{DeskArrival, DeskPort, Outbox};
use crate::class::ConnectionId;
use crate::crew::protocol::{HostMessage, MemberMessage};
use crate::shell::Console;

/// The maximum number of messages that wait for one member; one that does not read them is sent away.
const MOST_WAITING: usize = 256;
/// The maximum number of lines of one member in a second; one that says more is sent away.
const MOST_LINES: u32 = 50;
const SECOND: Duration = Duration::from_secs(1);
/// How long the members may take for the end of the record when the host closes.
const LAST_PIECES: Duration = Duration::from_millis(300);

/// The connections of the host.
pub(in crate::shell) struct HostEnd {
    pub(super) port: DeskPort<MemberMessage>,
    open: BTreeMap<ConnectionId, MemberConnection>,
    sight: watch::Sender<RecordSight>,
}

/// A connection to a member.
struct MemberConnection {
    /// The user at the other end.
    user: String,
    outbox: Outbox,
    /// Messages that wait for room, oldest first.
    waiting: VecDeque<HostMessage>,
    /// Sends the record, once the member is let in.
    tail: Option<JoinHandle<()>>,
    /// When the second began in which lines are counted, and their number.
    since: Instant,
    lines: u32,
}

impl MemberConnection {
    fn new(user: String, outbox: Outbox) -> Self {
        Self {
            user,
            outbox,
            waiting: VecDeque::new(),
            tail: None,
            since: Instant::now(),
            lines: 0,
        }
    }

    /// Counts a line; returns whether it is one of too many.
    fn floods(&mut self) -> bool {
        if self.since.elapsed() >= SECOND {
            (self.since, self.lines) = (Instant::now(), 0);
        }
        self.lines += 1;
        self.lines > MOST_LINES
    }

    /// Sends what waits, as far as there is room.
    fn send(&mut self) {
        while self.outbox.has_room()
            && let Some(message) = self.waiting.pop_front()
        {
            self.outbox.send(&message);
        }
    }
}

impl Drop for MemberConnection {
    fn drop(&mut self) {
        if let Some(tail) = &self.tail {
            tail.abort();
        }
    }
}

impl HostEnd {
    pub(super) fn new(port: DeskPort<MemberMessage>) -> Self {
        Self {
            port,
            open: BTreeMap::new(),
            sight: watch::Sender::default(),
        }
    }

    /// Ends all connections.
    pub(super) async fn close(mut self) {
        if self.open.values().any(|it| it.tail.is_some()) {
            tokio::time::sleep(LAST_PIECES).await;
        }
        for connection in self.open.values_mut() {
            connection.send();
        }
        self.open.clear();
        self.port.close().await;
    }

    /// Shows the members how far the record has got.
    pub(super) fn show(&mut self, sight: RecordSight) {
        self.sight.send_replace(sight);
        for connection in self.open.values_mut() {
            connection.send();
        }
        self.open.retain(|_, it| it.waiting.len() < MOST_WAITING);
    }

    /// Does what the state asks for.
    pub(super) fn carry_out(&mut self, work: Vec<CrewEffect>) {
        for effect in work {
            match effect {
                CrewEffect::Admit {
                    connection,
                    welcome,
                    has,
                } => {
                    if let Some(known) = self.open.get_mut(&connection) {
                        known.waiting.push_back(welcome);
                        known.send();
                        let (outbox, sight) = (known.outbox.clone(), self.sight.subscribe());
                        known.tail = Some(tokio::spawn(send_record(outbox, sight, has)));
                    }
                }
                CrewEffect::Deny { connection, denial } => {
                    if let Some(known) = self.open.remove(&connection) {
                        known.outbox.send(&HostMessage::Denied(denial));
                    }
                }
                CrewEffect::Drop(connection) => drop(self.open.remove(&connection)),
                CrewEffect::Tell {
                    connection,
                    message,
                } => {
                    if let Some(known) = self.open.get_mut(&connection) {
                        known.waiting.push_back(message);
                    }
                }
                CrewEffect::TellAll(message) => {
                    let members = self.open.values_mut().filter(|it| it.tail.is_some());
                    members.for_each(|it| it.waiting.push_back(message.clone()));
                }
                CrewEffect::Note(_) | CrewEffect::Say(_) => {}
            }
        }
    }
}

impl Console {
    /// Takes in what has arrived from members.
    pub(super) async fn attend_member(
        &mut self,
        end: &mut HostEnd,
        arrival: DeskArrival<MemberMessage>,
    ) {
        match arrival {
            DeskArrival::Opened {
                connection,
                peer,
                outbox,
            } => {
                let opened = MemberConnection::new(peer.user, outbox);
                end.open.insert(connection, opened);
            }
            DeskArrival::Line {
                from,
                line: Ok(message),
            } => {
                // One that was sent away may have said more.
                let Some(known) = end.open.get_mut(&from) else {
                    return;
                };
                let user = known.user.clone();
                if known.floods() {
                    tracing::warn!("{user} says too much, and is sent away");
                    end.open.remove(&from);
                    self.feed(CrewEvent::Left(from)).await;
                    return;
                }
                let event = CrewEvent::Heard {
                    connection: from,
                    user,
                    message,
                };
                self.feed(event).await;
            }
            // The carrier ends the connection.
            DeskArrival::Line {
                line: Err(fault), ..
            } => tracing::warn!("a line of a member: {fault}"),
            DeskArrival::Closed(connection) => {
                end.open.remove(&connection);
                self.feed(CrewEvent::Left(connection)).await;
            }
        }
    }

    /// The record of this flight, as far as members may see it.
    pub(super) fn record_sight(&self) -> RecordSight {
        let running = self.running.as_ref();
        // An exam is flown alone.
        let shown = running.filter(|_| !self.app.state().is_exam());
        shown
            .and_then(|running| running.record_sight(self.clock.now()))
            .map_or_else(RecordSight::default, |(frames, complete_to)| {
                RecordSight::new(frames, complete_to)
            })
    }
}
