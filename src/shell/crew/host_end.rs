//! The connections of the host.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::{Duration, Instant};

use tokio::sync::watch;
use tokio::task::JoinHandle;

use super::tail::{RecordSight, send_record};
use crate::app::effect::CrewEffect;
use crate::app::event::{CrewEvent, Event};
use crate::carrier::{DeskArrival, DeskPort, Outbox};
use crate::class::ConnectionId;
use crate::crew::protocol::{HostMessage, MemberMessage};
use crate::replay::FRAME;
use crate::shell::Console;
use crate::shell::session::RecordPoint;

/// The maximum number of messages that wait for one member; one that does not read them is sent away.
const MOST_WAITING: usize = 256;
/// The maximum number of lines of one member in a second; one that says more is sent away.
const MOST_LINES: u32 = 50;
const SECOND: Duration = Duration::from_secs(1);
/// How long the members may take for the end of the record when the host closes.
const LAST_PIECES: Duration = Duration::from_secs(3);
/// How long what has happened may still be in memory while others follow the record.
const WRITTEN_AFTER: Duration = Duration::from_millis(250);

/// The connections of the host.
pub(in crate::shell) struct HostEnd {
    pub(super) port: DeskPort<MemberMessage>,
    open: BTreeMap<ConnectionId, MemberConnection>,
    sight: watch::Sender<RecordSight>,
    written: Written,
}

/// How far the record had got at each of the last moments, to tell up to which time its files are complete.
#[derive(Default)]
struct Written {
    /// The points that the record had reached, with the times, oldest first.
    seen: VecDeque<(Instant, RecordPoint)>,
}

impl Written {
    /// Takes in how far the record has got; returns how far it is complete.
    fn up_to(&mut self, point: RecordPoint, now: Instant) -> RecordPoint {
        self.seen.retain(|(_, it)| it.frames == point.frames);
        self.seen.push_back((now, point.clone()));
        let is_written = |at: &Instant| now.duration_since(*at) >= WRITTEN_AFTER;
        while self.seen.get(1).is_some_and(|(at, _)| is_written(at)) {
            self.seen.pop_front();
        }
        let oldest = self.seen.front().filter(|(at, _)| is_written(at));
        let at = oldest.map_or(Duration::ZERO, |(_, it)| it.at);
        // While time stands still, the frame that has begun is complete too.
        let stands = !at.is_zero() && at == point.at;
        RecordPoint {
            at: if stands { at + FRAME } else { at },
            ..point
        }
    }
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
            written: Written::default(),
        }
    }

    /// Ends all connections, after the members have got what is left of the record.
    pub(super) async fn close(mut self) {
        for connection in self.open.values_mut() {
            connection.send();
        }
        // A member that does not read keeps the console only for a while.
        drop(tokio::time::timeout(LAST_PIECES, self.send_rest()).await);
        self.open.clear();
        self.port.close().await;
    }

    async fn send_rest(&mut self) {
        // Without it, the tails end once they have sent everything.
        drop(std::mem::take(&mut self.sight));
        for connection in self.open.values_mut() {
            if let Some(tail) = &mut connection.tail {
                drop(tail.await);
            }
            connection.outbox.send(&HostMessage::Closing);
        }
        // What waits to be written is written before a connection closes.
        let mut closing: BTreeSet<_> = std::mem::take(&mut self.open).into_keys().collect();
        while !closing.is_empty()
            && let Some(arrival) = self.port.next().await
        {
            if let DeskArrival::Closed(connection) = arrival {
                closing.remove(&connection);
            }
        }
    }

    /// Shows the members how far the record has got, and the one of the flight before.
    pub(super) fn show(&mut self, point: Option<RecordPoint>, before: Option<RecordPoint>) {
        let now = Instant::now();
        let current = point.map(|point| self.written.up_to(point, now));
        self.sight.send_replace(RecordSight { current, before });
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
                CrewEffect::Note(_) | CrewEffect::Say(_) | CrewEffect::GiveUp(_) => {}
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
                // After a stop, lines may arrive before the next tick: how long they waited is counted up to now.
                let (now, wall) = (self.clock.now(), self.clock.wall());
                self.feed(Event::Tick { now, wall }).await;
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

    /// How far the record of this flight has got, if members may see it.
    pub(in crate::shell) fn record_point(&self) -> Option<RecordPoint> {
        let running = self.running.as_ref();
        // An exam is flown alone.
        let shown = running.filter(|_| !self.app.state().is_exam());
        shown?.record_point(self.clock.now())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_complete_a_moment_later_and_to_the_end_when_time_stands() {
        let began = Instant::now();
        let ms = Duration::from_millis;
        let mut written = Written::default();
        let mut up_to = |after: u64, name: &str, at: u64| {
            let frames = name.into();
            let point = RecordPoint { frames, at: ms(at) };
            written.up_to(point, began + ms(after)).at
        };
        assert_eq!(up_to(0, "a", 1000), Duration::ZERO);
        assert_eq!(up_to(100, "a", 1100), Duration::ZERO);
        assert_eq!(up_to(260, "a", 1260), ms(1000));
        assert_eq!(up_to(360, "a", 1360), ms(1100));
        // A pause.
        assert_eq!(up_to(500, "a", 1360), ms(1100));
        assert_eq!(up_to(620, "a", 1360), ms(1360) + FRAME);
        // The next record.
        assert_eq!(up_to(640, "b", 10), Duration::ZERO);
    }
}
