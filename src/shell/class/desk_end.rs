//! The connections of a desk.

use std::collections::BTreeMap;
use std::time::Duration;

use super::desk_files::{DeskAnswer, DeskTask};
use super::worker::Worker;
use super::{ClassArrival, ClassSight, OpenLine, or_never};
use crate::app::State;
use crate::app::effect::ClassEffect;
use crate::app::event::ClassEvent;
use crate::carrier::{DeskArrival, DeskPort};
use crate::class::protocol::DeskMessage;
use crate::class::{
    ConnectionId, Desk, DeskHeard, DeskLine, Picture, SubmissionEnd, SubmissionRefusal,
};
use crate::shell::Console;

/// The time after which the desk tries again to write what it could not write.
const WRITE_AGAIN: Duration = Duration::from_secs(60);
/// The least time between two pictures of what the desk shows.
const DRAW_EVERY: Duration = Duration::from_millis(100);

/// The connections of a desk.
pub(in crate::shell) struct DeskEnd {
    port: DeskPort,
    open: BTreeMap<ConnectionId, DeskConnection>,
    /// Keeps the records that are handed in; `None` without a data folder.
    files: Option<Worker<DeskTask, DeskAnswer>>,
    shown: ShownPicture,
    /// When the desk next tries to write what it could not write, by the wall clock.
    writes_again: Duration,
}

/// What the desk shows to the class. It is drawn once for all seats.
#[derive(Default)]
struct ShownPicture {
    drawn_at: Option<Duration>,
    picture: Option<Picture>,
}

impl ShownPicture {
    /// The picture, not older than a tenth of a second. One that may not be shown leaves the one before.
    fn at(&mut self, now: Duration, draw: &dyn Fn() -> Option<Picture>) -> Option<Picture> {
        if self.drawn_at.is_none_or(|at| now >= at + DRAW_EVERY) {
            self.drawn_at = Some(now);
            self.picture = draw().or(self.picture.take());
        }
        self.picture.clone()
    }
}

/// A connection to a seat.
struct DeskConnection {
    /// The user at the other end.
    user: String,
    open: OpenLine<DeskLine>,
}

impl DeskEnd {
    /// The connections of an open desk. `files` keeps the records that are handed in; `None` without a data folder.
    pub(super) fn new(port: DeskPort, mut files: Option<Worker<DeskTask, DeskAnswer>>) -> Self {
        if let Some(files) = &mut files {
            files.give(DeskTask::Look);
        }
        Self {
            port,
            open: BTreeMap::new(),
            files,
            shown: ShownPicture::default(),
            writes_again: WRITE_AGAIN,
        }
    }

    /// Waits for the next arrival.
    pub async fn next(&mut self) -> ClassArrival {
        let files = self.files.as_mut().map(Worker::next);
        tokio::select! {
            arrival = or_never(Some(self.port.next())) => ClassArrival::AtDesk(arrival),
            answers = or_never(files) => ClassArrival::OfDeskFiles(answers),
        }
    }

    /// Ends all connections.
    pub async fn close(self) {
        self.port.close().await;
    }

    /// Says what the seats do not know yet.
    pub(super) fn tell(&mut self, desk: &Desk, state: &State, sight: &ClassSight<'_>) {
        if let Some(files) = &mut self.files
            && state.wall() >= self.writes_again
        {
            self.writes_again = state.wall() + WRITE_AGAIN;
            files.give(DeskTask::WriteAgain);
        }
        let Self { open, shown, .. } = self;
        if !desk.is_showing() {
            *shown = ShownPicture::default();
        }
        let now = state.wall();
        for (&connection, DeskConnection { open, .. }) in open {
            while open.outbox.has_room() {
                let said = open.line.next(desk, connection, now).or_else(|| {
                    let picture = || shown.at(now, sight.shown);
                    open.line.next_shown(desk, connection, picture, now)
                });
                match said {
                    Some(message) => open.outbox.send(&message),
                    None => break,
                }
            }
        }
    }

    /// Does what the state asks for.
    pub fn carry_out(&mut self, effect: ClassEffect) {
        match effect {
            ClassEffect::Deny { connection, denial } => {
                if let Some(denied) = self.open.remove(&connection) {
                    denied.open.outbox.send(&DeskMessage::Denied(denial));
                }
            }
            ClassEffect::Receive {
                connection,
                user,
                heard,
            } => match &mut self.files {
                // Seats repeat what is not answered.
                Some(files) => files.offer(DeskTask::Take {
                    connection,
                    user,
                    heard,
                }),
                None => self.refuse(connection, &heard),
            },
            ClassEffect::FindFlights {
                user,
                record,
                beside,
            } => self.give(DeskTask::FindFlights {
                user,
                record,
                beside,
            }),
            ClassEffect::ReadGraded(asked) => self.give(DeskTask::ReadGraded(asked)),
            ClassEffect::KeepGrades {
                user,
                record,
                sheet,
            } => self.give(DeskTask::KeepGrades {
                user,
                record,
                sheet,
            }),
            ClassEffect::KeepNotes { begun, notes } => self.give(DeskTask::Keep { begun, notes }),
            _ => {}
        }
    }

    /// Whether records or grades are being written or read.
    pub fn is_busy(&self) -> bool {
        self.files.as_ref().is_some_and(Worker::is_busy)
    }

    fn give(&mut self, task: DeskTask) {
        if let Some(files) = &mut self.files {
            files.give(task);
        }
    }

    /// Refuses a record: there is no folder to keep it.
    fn refuse(&self, connection: ConnectionId, heard: &DeskHeard) {
        let DeskHeard::Submission(submission) = heard else {
            return;
        };
        let record = submission.record.clone();
        let end = SubmissionEnd::Refused(SubmissionRefusal::Unwritable);
        self.say(connection, &DeskMessage::Settled { record, end });
    }

    /// Tells a seat something. If it is lost, the seat offers its record again.
    fn say(&self, connection: ConnectionId, message: &DeskMessage) {
        if let Some(known) = self.open.get(&connection) {
            known.open.outbox.send(message);
        }
    }
}

impl Console {
    /// Takes in what has arrived from seats.
    pub(super) async fn attend_desk(&mut self, end: &mut DeskEnd, arrival: DeskArrival) {
        match arrival {
            DeskArrival::Opened {
                connection,
                peer,
                outbox,
            } => {
                let opened = DeskConnection {
                    user: peer.user,
                    open: OpenLine::new(outbox),
                };
                end.open.insert(connection, opened);
            }
            DeskArrival::Line {
                from,
                line: Ok(message),
            } => {
                // One that was denied may have sent more.
                let Some(known) = end.open.get(&from) else {
                    return;
                };
                let event = ClassEvent::Heard {
                    connection: from,
                    user: known.user.clone(),
                    message,
                };
                self.feed(event).await;
            }
            // The carrier ends the connection.
            DeskArrival::Line {
                line: Err(fault), ..
            } => {
                tracing::warn!("a line of a seat: {fault}");
            }
            DeskArrival::Closed(connection) => {
                end.open.remove(&connection);
                if let Some(files) = &mut end.files {
                    files.give(DeskTask::Leave(connection));
                }
                self.feed(ClassEvent::Left(connection)).await;
            }
        }
    }

    /// Takes in what the thread has kept.
    pub(super) async fn take_desk_answers(&mut self, end: &mut DeskEnd, answers: Vec<DeskAnswer>) {
        for answer in answers {
            match answer {
                DeskAnswer::Event(event) => self.feed(*event).await,
                DeskAnswer::Say(connection, message) => end.say(connection, &message),
            }
        }
    }
}
