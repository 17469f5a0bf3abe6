//! Reads one log: as a stream where much is missing, in small pieces where little was lost.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{LOG_DATA_DATA, LOG_REQUEST_DATA_DATA, MavMessage};

use crate::session::gaps::{FileBytes, GapMap};
use crate::wire::{MavAddress, Outgoing};

/// Bytes in one `LOG_DATA`. `ArduPilot` answers a request of this size at once, even on slow links. It silently drops a
/// request that arrives while it is still answering another.
const PIECE: u32 = 90;
/// Pieces that are requested at one time.
const AT_ONCE: usize = 16;
/// The cost of one piece when many are requested at a time and some are lost. If a stream of all missing bytes would
/// take less, a stream is requested.
const PIECE_COST: Duration = Duration::from_millis(25);
/// The assumed speed of a stream that has not been measured, in bytes per second: that of a radio
/// with 57600 baud.
const SLOW: f64 = 4000.0;
/// If nothing arrives for this long, a request was lost or a stream has ended.
const SILENCE: Duration = Duration::from_millis(600);
/// Each fruitless request doubles the next wait, up to this factor.
const LONGEST_WAIT: u32 = 2;
/// If nothing new arrives for this long, the transfer has stalled.
const PATIENCE: Duration = Duration::from_secs(30);

/// The maximum number of gaps tracked; bytes that would split another gap are dropped and requested
/// later.
const MOST_GAPS: usize = 10_000;

#[derive(Debug, Clone)]
struct Stream {
    range: Range<u32>,
    begun: Duration,
    /// The offset that the stream has reached.
    reached: u32,
}

/// A log that is being read.
#[derive(Debug, Clone)]
pub(super) struct Transfer {
    number: u16,
    gaps: GapMap,
    /// Stored bytes that the vehicle's bytes must match.
    samples: Vec<FileBytes>,
    stream: Option<Stream>,
    /// Requested pieces, by their start: the end, and the time of the request.
    pieces: BTreeMap<u32, (u32, Duration)>,
    heard_at: Duration,
    news_at: Duration,
    fruitless: u8,
    bytes_per_s: f64,
}

/// The meaning of a message for a transfer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Received {
    Nothing,
    /// Bytes that were missing.
    Bytes(FileBytes),
    /// The stored bytes belong to another log: everything is missing.
    Other,
}

impl Transfer {
    /// Begins to read the missing bytes, and rereads the bytes in `samples` for comparison.
    pub fn new(number: u16, mut gaps: GapMap, samples: Vec<FileBytes>, now: Duration) -> Self {
        for sample in &samples {
            gaps.open(sample.range());
        }
        Self {
            number,
            gaps,
            samples,
            stream: None,
            pieces: BTreeMap::new(),
            heard_at: now,
            news_at: now,
            fruitless: 0,
            bytes_per_s: SLOW,
        }
    }

    pub fn gaps(&self) -> &GapMap {
        &self.gaps
    }

    /// Whether nothing new has arrived for [`PATIENCE`].
    pub fn is_stalled(&self, now: Duration) -> bool {
        now >= self.news_at + PATIENCE
    }

    /// Handles a message with data of a log.
    pub fn receive(&mut self, data: &LOG_DATA_DATA, now: Duration) -> Received {
        let count = u32::from(data.count).min(PIECE);
        let end = data.ofs.saturating_add(count).min(self.gaps.size());
        // A log that is shorter than listed ends with a short message. Short messages elsewhere only leave gaps.
        let is_short = count < PIECE && end < self.gaps.size() && !self.asked_until(end);
        if data.id != self.number || data.ofs > end || count == 0 || is_short {
            return Received::Nothing;
        }
        self.pieces.remove(&data.ofs);
        self.follow(data.ofs..end, count, now);
        self.heard_at = now;
        let bytes = FileBytes {
            at: data.ofs,
            bytes: data.data[..(end - data.ofs) as usize].to_vec(),
        };
        self.take(bytes, now)
    }

    /// Whether a request ended at this offset.
    fn asked_until(&self, end: u32) -> bool {
        let stream = self.stream.as_ref().map(|it| it.range.end);
        let mut pieces = self.pieces.values().map(|(end, _)| *end);
        stream == Some(end) || pieces.any(|it| it == end)
    }

    /// Stores bytes within the log, from any source.
    pub fn take(&mut self, bytes: FileBytes, now: Duration) -> Received {
        if self.differs(&bytes) {
            *self = Self {
                bytes_per_s: self.bytes_per_s,
                ..Self::new(self.number, GapMap::new(self.gaps.size()), Vec::new(), now)
            };
            return Received::Other;
        }
        // Bytes scattered over a large log would make the list of gaps larger than the log.
        if self.gaps.missing().len() >= MOST_GAPS && self.gaps.splits(&bytes.range()) {
            return Received::Nothing;
        }
        let news = self.gaps.fill(bytes.range());
        if news == 0 {
            return Received::Nothing;
        }
        self.fruitless = 0;
        self.news_at = now;
        Received::Bytes(bytes)
    }

    /// Counts silence from now on: until now, the bytes arrived by another route.
    pub fn resume(&mut self, now: Duration) {
        self.heard_at = now;
        self.news_at = now;
    }

    /// Measures the stream, and detects its end.
    fn follow(&mut self, range: Range<u32>, count: u32, now: Duration) {
        let Some(stream) = &mut self.stream else {
            return;
        };
        stream.reached = stream.reached.max(range.end);
        let is_over = range.end >= stream.range.end || count < PIECE;
        if is_over {
            let took = now.saturating_sub(stream.begun).as_secs_f64();
            let bytes = f64::from(stream.reached.saturating_sub(stream.range.start));
            if took > 0.0 {
                self.bytes_per_s = (bytes / took).max(1.0);
            }
            self.stream = None;
        }
    }

    /// Whether bytes differ from the bytes that were read before.
    fn differs(&self, bytes: &FileBytes) -> bool {
        self.samples.iter().any(|sample| {
            let (ours, theirs) = (sample.range(), bytes.range());
            let mut both = ours.start.max(theirs.start)..ours.end.min(theirs.end);
            both.any(|at| {
                let theirs = bytes.bytes[(at - theirs.start) as usize];
                sample.bytes[(at - ours.start) as usize] != theirs
            })
        })
    }

    /// The requests that are due; `round_trip` is the round-trip time of the link.
    pub fn poll(
        &mut self,
        vehicle: MavAddress,
        round_trip: Duration,
        now: Duration,
    ) -> Vec<Outgoing> {
        if self.gaps.is_complete() {
            return Vec::new();
        }
        let patience = (1 << (self.fruitless / 2).min(8)).min(LONGEST_WAIT);
        let wait = SILENCE.max(round_trip * 3 / 2) * patience;
        let is_quiet = now >= self.heard_at + wait;
        if is_quiet && (self.stream.is_some() || !self.pieces.is_empty()) {
            self.fruitless = self.fruitless.saturating_add(1);
            self.heard_at = now;
            self.stream = None;
            self.pieces.clear();
        }
        let gaps = &self.gaps;
        self.pieces
            .retain(|start, (end, at)| now < *at + wait && gaps.lacks(&(*start..*end)));
        if self.stream.is_some() {
            return Vec::new();
        }
        let asked = match self.worth_a_stream() {
            Some(range) if self.pieces.is_empty() => {
                self.stream = Some(Stream {
                    range: range.clone(),
                    begun: now,
                    reached: range.start,
                });
                vec![range]
            }
            Some(_) => Vec::new(),
            None => self.next_pieces(now),
        };
        // Silence counts from the first request after an idle time.
        if self.stream.is_some() || (!asked.is_empty() && self.pieces.len() == asked.len()) {
            self.heard_at = now;
        }
        let request = |range: Range<u32>| self.request(vehicle, &range);
        asked.into_iter().map(request).collect()
    }

    /// The range to request as a stream: from the first to the last gap if that is faster than single pieces, otherwise
    /// the longest gap if it is long enough.
    fn worth_a_stream(&self) -> Option<Range<u32>> {
        let gaps = self.gaps.missing();
        let (first, last) = (gaps.first()?, gaps.last()?);
        let all = first.start..last.end;
        let pieces: u32 = gaps
            .iter()
            .map(|gap| (gap.end - gap.start).div_ceil(PIECE))
            .sum();
        let is_better = |range: &Range<u32>, pieces: u32| {
            let bytes = f64::from(range.end - range.start);
            let stream = Duration::from_secs_f64(bytes / self.bytes_per_s) + SILENCE / 2;
            pieces as usize > AT_ONCE && stream < PIECE_COST * pieces
        };
        if is_better(&all, pieces) {
            return Some(all);
        }
        let longest = gaps.iter().max_by_key(|gap| gap.end - gap.start)?;
        let pieces = (longest.end - longest.start).div_ceil(PIECE);
        (pieces as usize > AT_ONCE * 4 || is_better(longest, pieces)).then(|| longest.clone())
    }

    /// Small pieces of the gaps that have not been requested yet.
    fn next_pieces(&mut self, now: Duration) -> Vec<Range<u32>> {
        let free = AT_ONCE.saturating_sub(self.pieces.len());
        let pieces = self.gaps.missing().iter().flat_map(|gap| {
            let end = gap.end;
            let starts = gap.clone().step_by(PIECE as usize);
            starts.map(move |start| start..end.min(start.saturating_add(PIECE)))
        });
        let due: Vec<Range<u32>> = pieces
            .filter(|piece| !self.pieces.contains_key(&piece.start))
            .take(free)
            .collect();
        for piece in &due {
            self.pieces.insert(piece.start, (piece.end, now));
        }
        due
    }

    fn request(&self, vehicle: MavAddress, range: &Range<u32>) -> Outgoing {
        MavMessage::LOG_REQUEST_DATA(LOG_REQUEST_DATA_DATA {
            ofs: range.start,
            count: range.end - range.start,
            id: self.number,
            target_system: vehicle.system,
            target_component: vehicle.component,
        })
        .into()
    }
}
