//! Sends the host's record to one member, at the member's own pace.

use std::path::PathBuf;
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::{Instant, sleep, timeout_at};

use crate::carrier::Outbox;
use crate::class::{PIECE, PieceBytes, RecordName};
use crate::crew::protocol::{HeldRecord, HostMessage};
use crate::shell::session::RecordPoint;
use crate::store::RecordTail;

/// The number of messages for which the record leaves room: answers come first.
const LEFT_FREE: usize = 16;
/// The maximum number of pieces that are read at once.
const READ_AT_ONCE: usize = 8;
/// The longest time between two lines of the host.
const HERE_EVERY: Duration = Duration::from_secs(2);
/// The time between two readings of the record.
const READ_EVERY: Duration = Duration::from_millis(50);

/// The name of a record.
fn name_of(point: &RecordPoint) -> Option<RecordName> {
    let stem = point.frames.file_stem()?.to_str()?;
    RecordName::try_from(stem.to_owned()).ok()
}

/// What the members may see of the host's records.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct RecordSight {
    /// The record that is being written, up to the time up to which its files are complete; `None` without a flight.
    pub current: Option<RecordPoint>,
    /// The record of the flight before, with its end.
    pub before: Option<RecordPoint>,
}

/// Sends the records until the connection ends; once the host closes, what is left of them. `has` is what the member has
/// of the record already.
pub(super) async fn send_record(
    outbox: Outbox,
    mut sight: watch::Receiver<RecordSight>,
    has: Option<HeldRecord>,
) {
    let mut sending = Sending {
        outbox,
        shown: None,
        has,
        told: None,
    };
    let mut here_at = Instant::now() + HERE_EVERY;
    while !sending.outbox.is_closed() {
        let seen = sight.borrow_and_update().clone();
        let is_all = sending.follow(&seen).await;
        sleep(READ_EVERY).await;
        let changed = timeout_at(here_at, sight.changed()).await;
        if is_all && matches!(changed, Ok(Err(_))) {
            return;
        }
        // Also while the sight changes all the time, but not the record: after a flight, for example.
        if Instant::now() >= here_at && sending.outbox.offer(&HostMessage::Here) {
            here_at = Instant::now() + HERE_EVERY;
        }
    }
}

/// A record that is being sent.
struct ShownRecord {
    /// The path of its frames.
    frames: PathBuf,
    tail: RecordTail,
}

struct Sending {
    outbox: Outbox,
    /// The record that is being sent.
    shown: Option<ShownRecord>,
    has: Option<HeldRecord>,
    /// The time that was told last.
    told: Option<u64>,
}

impl Sending {
    /// Sends what the records have got since, as far as there is room, and up to which time they are complete; returns
    /// whether that was everything. A record that is not written any more is sent to its end before the next one begins.
    async fn follow(&mut self, seen: &RecordSight) -> bool {
        let current = seen.current.as_ref();
        let shown = self.shown.as_ref().map(|it| &it.frames);
        let is_over = shown.is_some_and(|shown| current.is_none_or(|it| it.frames != *shown));
        if is_over && !self.finish(seen.before.as_ref()).await {
            return false;
        }
        let Some((current, name)) = current.and_then(|it| Some((it, name_of(it)?))) else {
            return true;
        };
        if self.shown.is_none() {
            if !self.outbox.offer(&HostMessage::Record(name.clone())) {
                return false;
            }
            let has = self.has.take().filter(|it| it.record == name);
            let has = has.map_or_else(Vec::new, |it| it.bytes);
            let tail = RecordTail::new(&current.frames, &has);
            let frames = current.frames.clone();
            (self.shown, self.told) = (Some(ShownRecord { frames, tail }), None);
        }
        self.send_pieces().await && self.tell_time(current.at)
    }

    /// Sends the rest of the shown record, and that it has ended; returns whether all of it was sent.
    async fn finish(&mut self, ended: Option<&RecordPoint>) -> bool {
        if !self.send_pieces().await {
            return false;
        }
        let shown = self.shown.as_ref().map(|it| &it.frames);
        let end = ended.filter(|it| shown == Some(&it.frames)).map(|it| it.at);
        let is_told = end.is_none_or(|end| self.tell_time(end));
        if !is_told || !self.outbox.offer(&HostMessage::Ended) {
            return false;
        }
        self.shown = None;
        true
    }

    /// Sends pieces while there is room; returns whether everything so far was sent.
    async fn send_pieces(&mut self) -> bool {
        while self.outbox.room() > LEFT_FREE + READ_AT_ONCE {
            let Some(ShownRecord { frames, mut tail }) = self.shown.take() else {
                return false;
            };
            // A slow disk holds nobody.
            let read = tokio::task::spawn_blocking(move || {
                let pieces: Vec<_> = std::iter::from_fn(|| tail.next(PIECE))
                    .take(READ_AT_ONCE)
                    .collect();
                (tail, pieces)
            });
            let Ok((tail, pieces)) = read.await else {
                return false;
            };
            self.shown = Some(ShownRecord { frames, tail });
            let is_all = pieces.len() < READ_AT_ONCE;
            for (part, bytes) in pieces {
                let data = PieceBytes(bytes);
                self.outbox.send(&HostMessage::Piece { part, data });
            }
            if is_all {
                return true;
            }
        }
        false
    }

    /// Tells up to which time the record is complete; returns whether there was room.
    fn tell_time(&mut self, complete_to: Duration) -> bool {
        let us = u64::try_from(complete_to.as_micros()).unwrap_or(u64::MAX);
        if self.told != Some(us) && self.outbox.offer(&HostMessage::Now { us }) {
            self.told = Some(us);
        }
        self.told == Some(us)
    }
}
