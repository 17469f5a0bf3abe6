//! Sends the host's record to one member, at the member's own pace.

use std::path::PathBuf;
use std::time::Duration;

use tokio::sync::watch;

use crate::carrier::Outbox;
use crate::class::{PIECE, PieceBytes, RecordName};
use crate::crew::protocol::{HeldRecord, HostMessage};
use crate::store::RecordTail;

/// The number of messages for which the record leaves room: answers come first.
const LEFT_FREE: usize = 16;
/// The maximum number of pieces that are read at once.
const READ_AT_ONCE: usize = 8;
/// The longest time between two lines of the host.
const HERE_EVERY: Duration = Duration::from_secs(2);
/// The time between two readings of the record.
const READ_EVERY: Duration = Duration::from_millis(50);

/// How far the host's record has got.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct RecordSight {
    /// The path of its frames; `None` without a flight.
    frames: Option<PathBuf>,
    /// The time up to which its files are complete.
    complete_to: Duration,
}

impl RecordSight {
    pub fn new(frames: PathBuf, complete_to: Duration) -> Self {
        Self {
            frames: Some(frames),
            complete_to,
        }
    }

    fn name(&self) -> Option<RecordName> {
        let stem = self.frames.as_ref()?.file_stem()?.to_str()?;
        RecordName::try_from(stem.to_owned()).ok()
    }
}

/// Sends the record until the connection ends or the host closes. `has` is what the member has of it already.
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
    while !sending.outbox.is_closed() {
        let seen = sight.borrow_and_update().clone();
        sending.follow(&seen).await;
        tokio::time::sleep(READ_EVERY).await;
        let changed = tokio::time::timeout(HERE_EVERY, sight.changed()).await;
        match changed {
            Ok(Ok(())) => {}
            Ok(Err(_)) => return,
            Err(_) => sending.outbox.send(&HostMessage::Here),
        }
    }
}

struct Sending {
    outbox: Outbox,
    /// The record that is being sent.
    shown: Option<(PathBuf, RecordTail)>,
    has: Option<HeldRecord>,
    /// The time that was told last.
    told: Option<u64>,
}

impl Sending {
    /// Sends what the record has got since, as far as there is room, and then up to which time it is complete.
    async fn follow(&mut self, seen: &RecordSight) {
        let (Some(frames), Some(name)) = (&seen.frames, seen.name()) else {
            // The flight is over; the rest of its record is not.
            self.send_pieces().await;
            return;
        };
        if self.shown.as_ref().is_none_or(|(shown, _)| shown != frames) {
            if !self.outbox.offer(&HostMessage::Record(name.clone())) {
                return;
            }
            let has = self.has.take().filter(|it| it.record == name);
            let has = has.map_or_else(Vec::new, |it| it.bytes);
            let tail = RecordTail::new(frames, &has);
            (self.shown, self.told) = (Some((frames.clone(), tail)), None);
        }
        if self.send_pieces().await {
            self.tell_time(seen.complete_to);
        }
    }

    /// Sends pieces while there is room; returns whether everything so far was sent.
    async fn send_pieces(&mut self) -> bool {
        while self.outbox.room() > LEFT_FREE + READ_AT_ONCE {
            let Some((frames, mut tail)) = self.shown.take() else {
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
            self.shown = Some((frames, tail));
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

    fn tell_time(&mut self, complete_to: Duration) {
        let us = u64::try_from(complete_to.as_micros()).unwrap_or(u64::MAX);
        if self.told != Some(us) && self.outbox.offer(&HostMessage::Now { us }) {
            self.told = Some(us);
        }
    }
}
