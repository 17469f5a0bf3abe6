//! Links that play a recording.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::time::{Instant, sleep_until};

use super::core::LinkCore;
use super::peer::{PeerStream, StreamEnding};
use super::tlog::{TlogDamage, TlogPiece, TlogSalvage};
use super::{LinkPeer, Playback};
use crate::text;
use crate::text::Text;
use crate::wire::Frame;

const PEER: LinkPeer = LinkPeer(0);
/// The number of records read ahead at a time.
const CHUNK_LEN: usize = 256;
const CHUNKS_AHEAD: usize = 4;
/// The longest pause that is kept, in recorded time, since joined logs have gaps of days.
const LONGEST_GAP: Duration = Duration::from_secs(10);

type PlaybackChunk = Result<Vec<TlogPiece>, Text>;

/// Plays a recording to its end, and returns its fault, if any. Both directions of the recorded traffic are delivered.
pub(super) async fn play(link: &mut LinkCore, path: &Path) -> Option<Text> {
    let (read, mut chunks) = mpsc::channel(CHUNKS_AHEAD);
    let path = PathBuf::from(path);
    tokio::task::spawn_blocking(move || read_ahead(&path, &read));
    let mut player = Player {
        stream: PeerStream::new(&link.config, PEER),
        pace: PlaybackPace::new(link.config.playback),
        damage: TlogDamage::default(),
        has_records: false,
    };
    let mut is_up = false;
    while let Some(chunk) = link.meanwhile(chunks.recv()).await? {
        let pieces = match chunk {
            Ok(pieces) => pieces,
            Err(reason) => return player.verdict(Some(reason)),
        };
        if !is_up {
            link.up(None);
            link.meter.set_peers(1);
            is_up = true;
        }
        player.play(link, &pieces).await?;
    }
    player.verdict(None)
}

struct Player {
    stream: PeerStream,
    pace: PlaybackPace,
    damage: TlogDamage,
    has_records: bool,
}

impl Player {
    /// Plays a chunk; frames due together are delivered together. `None` if the receiver is gone.
    async fn play(&mut self, link: &mut LinkCore, pieces: &[TlogPiece]) -> Option<()> {
        let mut frames = Vec::new();
        for piece in pieces {
            let record = match piece {
                TlogPiece::Record(record) => record,
                TlogPiece::Damage { offset, len } => {
                    self.pass_over(link, *offset, *len);
                    continue;
                }
            };
            self.has_records = true;
            let due = self.pace.due(record.unix_us);
            if due > Instant::now() {
                deliver(link, std::mem::take(&mut frames)).await?;
                link.meanwhile(sleep_until(due)).await?;
            }
            let found = self
                .stream
                .receive(&record.bytes, StreamEnding::Closed, &mut link.meter);
            frames.extend(found);
        }
        deliver(link, frames).await
    }

    /// Counts a damaged stretch and reports the first.
    fn pass_over(&mut self, link: &mut LinkCore, offset: u64, len: u64) {
        link.meter.passed_over(len);
        let is_first = self.damage.reason().is_none();
        self.damage.note(offset, len);
        if is_first {
            let reason = self.damage.reason();
            let said = reason.as_ref().map(tracing::field::display);
            tracing::warn!(reason = said);
            link.meter.complain(reason);
        }
    }

    /// The fault of the finished recording, if any.
    fn verdict(&self, end: Option<Text>) -> Option<Text> {
        let faults = self
            .damage
            .reason()
            .into_iter()
            .chain(end)
            .reduce(|all, fault| text!("transport-faults", first = all, second = fault))?;
        Some(if self.has_records {
            faults
        } else {
            text!("transport-no-tlog", faults = faults)
        })
    }
}

/// Delivers frames and waits until they are accepted, including the previous ones. `None` if the
/// link must close.
async fn deliver(link: &mut LinkCore, frames: Vec<Frame>) -> Option<()> {
    link.deliver(PEER, frames);
    link.delivered().await
}

/// Converts recorded times to playback times.
struct PlaybackPace {
    playback: Playback,
    due: Instant,
    last_us: Option<u64>,
}

impl PlaybackPace {
    fn new(playback: Playback) -> Self {
        Self {
            playback,
            due: Instant::now(),
            last_us: None,
        }
    }

    /// When to play a record. A step back in time counts as no gap.
    fn due(&mut self, unix_us: u64) -> Instant {
        let last_us = self.last_us.replace(unix_us);
        if let Playback::Speed(speed) = self.playback {
            let gap = Duration::from_micros(unix_us.saturating_sub(last_us.unwrap_or(unix_us)));
            let seconds = gap.min(LONGEST_GAP).as_secs_f64() / speed;
            // A speed of zero, or out of range, plays without pauses rather than never.
            self.due += Duration::try_from_secs_f64(seconds).unwrap_or_default();
        }
        self.due
    }
}

/// Reads a file in chunks until its end or until the receiver is gone.
fn read_ahead(path: &Path, chunks: &mpsc::Sender<PlaybackChunk>) {
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) => {
            let (path, error) = (path.display().to_string(), error.to_string());
            let reason = text!("transport-no-file", path = path, error = error);
            let _ = chunks.blocking_send(Err(reason));
            return;
        }
    };
    let mut salvage = TlogSalvage::new(file);
    loop {
        let mut failure = None;
        let pieces: Vec<_> = salvage
            .by_ref()
            .map_while(|piece| piece.map_err(|error| failure = Some(error)).ok())
            .take(CHUNK_LEN)
            .collect();
        let at_end = pieces.len() < CHUNK_LEN;
        if chunks.blocking_send(Ok(pieces)).is_err() {
            return;
        }
        if let Some(error) = failure {
            let _ = chunks.blocking_send(Err(Text::from(&error)));
        }
        if at_end {
            return;
        }
    }
}
