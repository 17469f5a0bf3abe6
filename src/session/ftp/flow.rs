//! The bytes of an open file: in bursts where much is missing, piece by piece where little was lost.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use super::packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence, MOST_DATA};
use super::{FtpFault, FtpNak, PATIENCE};
use crate::session::gaps::{FileBytes, GapMap};

/// Bytes in one packet.
const PIECE: u32 = MOST_DATA as u32;
/// Bytes in one burst: `ArduPilot` sends 500 packets.
const BURST: u32 = 500 * PIECE;
/// Pieces that are requested at one time: `ArduPilot` keeps five requests and drops the rest.
const AT_ONCE: usize = 4;
/// The cost of one piece when packets are lost. If a burst of all missing bytes would take less, a burst is requested.
const PIECE_COST: Duration = Duration::from_millis(60);
/// The assumed speed of a burst that has not been measured, in bytes per second: that of a radio
/// with 57600 baud.
const SLOW: f64 = 4000.0;
/// If nothing arrives for this long, a request was lost or a burst has ended.
const SILENCE: Duration = Duration::from_millis(600);
/// If this many bursts bring nothing, and none has brought anything before, the server does not support bursts.
const MOST_DRY_BURSTS: u8 = 4;
/// The largest distance of an answer's number from that of the newest request, in either direction.
const WINDOW: u32 = 4096;

#[derive(Debug, Clone)]
struct RequestedBurst {
    sequence: u32,
    at: u32,
    begun: Duration,
    /// The offset that the burst has reached.
    reached: u32,
}

/// Whether a server sends bursts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Bursts {
    /// This many bursts brought nothing.
    Untried(u8),
    Known,
    None,
}

/// The reading of an open file.
#[derive(Debug, Clone)]
pub(super) struct FileFlow {
    session: u8,
    /// The number of the request that opened the file.
    opened: u32,
    /// The number of the last request.
    newest: u32,
    gaps: GapMap,
    /// Whether the file must have the size that it was opened with.
    is_exact: bool,
    burst: Option<RequestedBurst>,
    bursts: Bursts,
    /// Requested pieces, by the number of the request: the range, and the time.
    pieces: BTreeMap<u32, (Range<u32>, Duration)>,
    heard_at: Duration,
    news_at: Duration,
    bytes_per_s: f64,
}

/// The meaning of an answer for a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Heard {
    Nothing,
    /// Bytes of which at least some were missing.
    Bytes(FileBytes),
    /// The server has lost the session.
    Lost(FtpNak),
    Fault(FtpFault),
}

impl FileFlow {
    /// Begins to read the missing parts of a file that a request has opened.
    pub fn new(opened: &FtpRequest, session: u8, gaps: GapMap, now: Duration) -> Self {
        Self {
            session,
            opened: opened.sequence,
            newest: opened.sequence,
            gaps,
            is_exact: true,
            burst: None,
            bursts: Bursts::Untried(0),
            pieces: BTreeMap::new(),
            heard_at: now,
            news_at: now,
            bytes_per_s: SLOW,
        }
    }

    /// Treats the size that the file was opened with as an estimate, as for files that are generated while they are
    /// read.
    pub fn estimated(mut self) -> Self {
        self.is_exact = false;
        self
    }

    pub fn gaps(&self) -> &GapMap {
        &self.gaps
    }

    pub fn receive(&mut self, answer: &FtpAnswer, sequence: &FtpSequence, now: Duration) -> Heard {
        let request = sequence.request_of(answer.sequence);
        // Late data is used too.
        let is_recent = request > self.opened && request.abs_diff(self.newest) < WINDOW;
        if answer.session != self.session || !is_recent {
            return Heard::Nothing;
        }
        if answer.is_of(FtpOpcode::Burst) {
            self.hear_burst(answer, request, now)
        } else if answer.is_of(FtpOpcode::Read) {
            self.hear_piece(answer, request, now)
        } else {
            Heard::Nothing
        }
    }

    fn hear_burst(&mut self, answer: &FtpAnswer, request: u32, now: Duration) -> Heard {
        let burst = self.burst.as_ref().filter(|it| request >= it.sequence);
        let of_this = burst.map(|burst| (burst.at, request == burst.sequence));
        match (&answer.result, of_this) {
            (Ok(data), _) => {
                let heard = self.take(answer.offset, data, now);
                if of_this.is_some() {
                    self.follow_burst(answer, data.len() as u32, now);
                }
                heard
            }
            (Err(_), None) => Heard::Nothing,
            (Err(FtpNak::EndOfFile), Some((at, is_first))) => {
                self.end_burst(now);
                if is_first {
                    return self.end_at(at);
                }
                Heard::Nothing
            }
            (Err(FtpNak::UnknownCommand | FtpNak::Fail | FtpNak::InvalidSize), Some(_)) => {
                self.end_burst(now);
                self.bursts = Bursts::None;
                Heard::Nothing
            }
            (Err(nak), Some(_)) => refused(*nak),
        }
    }

    fn hear_piece(&mut self, answer: &FtpAnswer, request: u32, now: Duration) -> Heard {
        let Some((piece, _)) = self.pieces.remove(&request) else {
            return Heard::Nothing;
        };
        match &answer.result {
            Ok(data) if answer.offset == piece.start && data.len() <= piece.len() => {
                self.take(answer.offset, data, now)
            }
            Ok(_) => Heard::Nothing,
            Err(FtpNak::EndOfFile) => self.end_at(piece.start),
            Err(nak) => refused(*nak),
        }
    }

    /// Stores bytes; those outside the file are ignored.
    fn take(&mut self, at: u32, data: &[u8], now: Duration) -> Heard {
        let end = at.checked_add(data.len() as u32);
        if end.is_none_or(|end| end > self.gaps.size()) {
            return Heard::Nothing;
        }
        let bytes = FileBytes {
            at,
            bytes: data.to_vec(),
        };
        self.heard_at = now;
        if self.gaps.fill(bytes.range()) == 0 {
            return Heard::Nothing;
        }
        self.news_at = now;
        Heard::Bytes(bytes)
    }

    /// Handles a refusal because the file has no byte at this offset: it ends there or earlier.
    fn end_at(&mut self, size: u32) -> Heard {
        if self.is_exact && size < self.gaps.size() {
            return Heard::Fault(FtpFault::OtherSize(size));
        }
        self.gaps.truncate(size);
        Heard::Nothing
    }

    /// Measures the burst, and detects its end.
    fn follow_burst(&mut self, answer: &FtpAnswer, len: u32, now: Duration) {
        let size = self.gaps.size();
        let Some(burst) = &mut self.burst else {
            return;
        };
        let end = answer.offset.saturating_add(len).min(size);
        burst.reached = burst.reached.max(end);
        if answer.is_burst_complete || end == size {
            self.end_burst(now);
        }
    }

    fn end_burst(&mut self, now: Duration) {
        let Some(burst) = self.burst.take() else {
            return;
        };
        let took = now.saturating_sub(burst.begun).as_secs_f64();
        let bytes = burst.reached - burst.at;
        if bytes > 0 {
            self.bursts = Bursts::Known;
            if took > 0.0 {
                self.bytes_per_s = (f64::from(bytes) / took).max(1.0);
            }
        } else if let Bursts::Untried(dry) = self.bursts {
            self.bursts = if dry + 1 < MOST_DRY_BURSTS {
                Bursts::Untried(dry + 1)
            } else {
                Bursts::None
            };
        }
    }

    /// The requests that are due.
    ///
    /// # Errors
    /// [`FtpFault::Silent`] if nothing new arrived for a long time.
    pub fn poll(
        &mut self,
        sequence: &mut FtpSequence,
        round_trip: Duration,
        now: Duration,
    ) -> Result<Vec<FtpRequest>, FtpFault> {
        if now >= self.news_at + PATIENCE.max(round_trip * 10) {
            return Err(FtpFault::Silent);
        }
        let wait = SILENCE.max(round_trip * 3 / 2);
        if now >= self.heard_at + wait && self.burst.is_some() {
            self.end_burst(now);
        }
        let gaps = &self.gaps;
        self.pieces
            .retain(|_, (piece, at)| now < *at + wait && gaps.lacks(piece));
        if self.burst.is_some() {
            return Ok(Vec::new());
        }
        let burst = self.worth_a_burst();
        Ok(match burst {
            Some(at) if self.pieces.is_empty() => vec![self.begin_burst(at, sequence, now)],
            Some(_) => Vec::new(),
            None => self.next_pieces(sequence, now),
        })
    }

    /// The offset at which to begin a burst: the first gap if much of what follows is missing,
    /// otherwise the longest gap. `None` if single pieces are faster or bursts are not supported.
    fn worth_a_burst(&self) -> Option<u32> {
        if self.bursts == Bursts::None {
            return None;
        }
        let gaps = self.gaps.missing();
        let longest = gaps.iter().max_by_key(|gap| gap.end - gap.start)?;
        let is_better = |start: u32| {
            let end = start.saturating_add(BURST).min(self.gaps.size());
            let within = gaps
                .iter()
                .map(|gap| gap.start.max(start)..gap.end.min(end));
            let pieces: u32 = within
                .filter(|gap| gap.start < gap.end)
                .map(|gap| (gap.end - gap.start).div_ceil(PIECE))
                .sum();
            let bytes = f64::from(end - start);
            let burst = Duration::from_secs_f64(bytes / self.bytes_per_s) + SILENCE / 2;
            let is_most = pieces * 2 > (end - start).div_ceil(PIECE);
            pieces as usize > AT_ONCE && (is_most || burst < PIECE_COST * pieces)
        };
        let starts = [gaps.first()?.start, longest.start];
        starts.into_iter().find(|start| is_better(*start))
    }

    fn begin_burst(&mut self, at: u32, sequence: &mut FtpSequence, now: Duration) -> FtpRequest {
        let request = self.request(FtpOpcode::Burst, sequence.next(), at, PIECE as u8);
        sequence.pass_over_burst();
        self.newest = request.sequence;
        self.burst = Some(RequestedBurst {
            sequence: request.sequence,
            at,
            begun: now,
            reached: at,
        });
        self.heard_at = now;
        request
    }

    /// The next pieces of the gaps that have not been requested yet. A repeated piece is a new request.
    fn next_pieces(&mut self, sequence: &mut FtpSequence, now: Duration) -> Vec<FtpRequest> {
        let free = AT_ONCE.saturating_sub(self.pieces.len());
        let is_asked = |piece: &Range<u32>| {
            let mut asked = self.pieces.values();
            asked.any(|(it, _)| it.start < piece.end && piece.start < it.end)
        };
        let pieces = self.gaps.missing().iter().flat_map(|gap| {
            let end = gap.end;
            let starts = gap.clone().step_by(PIECE as usize);
            starts.map(move |start| start..end.min(start.saturating_add(PIECE)))
        });
        let due: Vec<_> = pieces.filter(|it| !is_asked(it)).take(free).collect();
        let ask = |piece: Range<u32>| {
            let size = (piece.end - piece.start) as u8;
            let request = self.request(FtpOpcode::Read, sequence.next(), piece.start, size);
            (request, piece)
        };
        let asked: Vec<_> = due.into_iter().map(ask).collect();
        let mut requests = Vec::new();
        for (request, piece) in asked {
            self.newest = request.sequence;
            self.pieces.insert(request.sequence, (piece, now));
            requests.push(request);
        }
        requests
    }

    fn request(&self, opcode: FtpOpcode, sequence: u32, offset: u32, size: u8) -> FtpRequest {
        FtpRequest {
            sequence,
            session: self.session,
            opcode,
            offset,
            size,
            data: Vec::new(),
        }
    }
}

fn refused(nak: FtpNak) -> Heard {
    if nak.is_of_lost_session() {
        Heard::Lost(nak)
    } else {
        Heard::Fault(FtpFault::Refused(nak))
    }
}
