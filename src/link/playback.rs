//! Links that play a recording.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::time::{Instant, sleep_until};

use super::peer::{Ending, PeerStream};
use super::task::Link;
use super::{Peer, Playback, TlogReader, TlogRecord};
use crate::wire::Frame;

const PEER: Peer = Peer(0);
/// How many records are read ahead at a time.
const CHUNK_LEN: usize = 256;
const CHUNKS_AHEAD: usize = 4;
/// No pause in a recording is kept for longer, in its own time: logs that were joined have gaps of days.
const LONGEST_GAP: Duration = Duration::from_secs(10);

type Chunk = Result<Vec<TlogRecord>, String>;

/// Plays a recording to its end, and returns why it ended early, if it did. Both directions of the recorded
/// traffic are delivered.
pub(super) async fn play(link: &mut Link, path: &Path) -> Option<String> {
    let (read, mut chunks) = mpsc::channel(CHUNKS_AHEAD);
    let path = PathBuf::from(path);
    tokio::task::spawn_blocking(move || read_ahead(&path, &read));
    let mut player = Player {
        stream: PeerStream::new(&link.config),
        pace: Pace::new(link.config.playback),
    };
    let mut is_up = false;
    while let Some(chunk) = link.meanwhile(chunks.recv()).await? {
        let records = match chunk {
            Ok(records) => records,
            Err(reason) => return Some(reason),
        };
        if !is_up {
            link.up(None);
            link.meter.set_peers(1);
            is_up = true;
        }
        player.play(link, &records).await?;
    }
    None
}

struct Player {
    stream: PeerStream,
    pace: Pace,
}

impl Player {
    /// Plays a chunk; frames that are due together are delivered together. `None` if nobody wants more.
    async fn play(&mut self, link: &mut Link, records: &[TlogRecord]) -> Option<()> {
        let mut frames = Vec::new();
        for record in records {
            let due = self.pace.due(record.unix_us);
            if due > Instant::now() {
                deliver(link, std::mem::take(&mut frames)).await?;
                link.meanwhile(sleep_until(due)).await?;
            }
            let found = self
                .stream
                .receive(&record.bytes, Ending::Closed, &mut link.meter);
            frames.extend(found);
        }
        deliver(link, frames).await
    }
}

/// Hands frames on and waits until they are taken, even those that were handed on last.
async fn deliver(link: &mut Link, frames: Vec<Frame>) -> Option<()> {
    link.deliver(PEER, frames);
    link.delivered().await
}

/// Turns the times of a recording into those of its playing.
struct Pace {
    playback: Playback,
    due: Instant,
    last_us: Option<u64>,
}

impl Pace {
    fn new(playback: Playback) -> Self {
        Self {
            playback,
            due: Instant::now(),
            last_us: None,
        }
    }

    /// When a record is to be played. A step back in time takes none.
    fn due(&mut self, unix_us: u64) -> Instant {
        let last_us = self.last_us.replace(unix_us);
        if let Playback::Speed(speed) = self.playback {
            let gap = Duration::from_micros(unix_us.saturating_sub(last_us.unwrap_or(unix_us)));
            let seconds = gap.min(LONGEST_GAP).as_secs_f64() / speed;
            // A speed of zero, below or beyond all bounds plays without pauses rather than never.
            self.due += Duration::try_from_secs_f64(seconds).unwrap_or_default();
        }
        self.due
    }
}

/// Reads a file in chunks until its end or until nobody listens.
fn read_ahead(path: &Path, chunks: &mpsc::Sender<Chunk>) {
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) => {
            let reason = format!("cannot open {}: {error}", path.display());
            let _ = chunks.blocking_send(Err(reason));
            return;
        }
    };
    let mut reader = TlogReader::new(BufReader::new(file));
    loop {
        let mut failure = None;
        let records: Vec<_> = reader
            .by_ref()
            .map_while(|record| record.map_err(|error| failure = Some(error)).ok())
            .take(CHUNK_LEN)
            .collect();
        let at_end = records.len() < CHUNK_LEN;
        if chunks.blocking_send(Ok(records)).is_err() {
            return;
        }
        if let Some(error) = failure {
            let _ = chunks.blocking_send(Err(error.to_string()));
        }
        if at_end {
            return;
        }
    }
}
