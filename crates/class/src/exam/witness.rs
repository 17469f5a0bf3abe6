//! Compares a record that was handed in with the heads that the desk has noted.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::{CandidateTry, ContentHash, TimedHead};
use crate::RecordName;

/// The longest mission time between two heads that a witness may miss, in seconds: seats report every 10 s.
pub(super) const GAP: u64 = 30;
/// How much longer than the mission a flight may seem to take by the desk's clock, in seconds: heads come late over a
/// slow connection.
const SLACK: u64 = 10;

/// What a desk has seen of a record while it was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Witness {
    /// All heads are those of the record, and none was missing for long.
    Whole {
        /// The number of heads.
        heads: usize,
    },
    /// All heads are those of the record, but there were none for some time.
    Part {
        /// The number of heads.
        heads: usize,
        /// The longest mission time without one, in seconds.
        gap_s: u64,
    },
    /// All heads are those of the record, but the mission took less time than it should have by the desk's clock: the
    /// console was stopped, or its time was slow.
    Stopped {
        /// The number of heads.
        heads: usize,
        /// The time in which the mission stood still, in seconds.
        stopped_s: u64,
    },
    /// There are no heads.
    Unseen,
    /// The heads are those of another record.
    OtherRecord {
        /// The name of that record.
        record: String,
    },
    /// A head is not that of the record: what was there at that time was changed afterwards.
    Rewritten {
        /// The time of the head, in seconds since 1970.
        at: u64,
        /// Its number of bytes.
        bytes: u64,
    },
}

/// A record that was handed in.
#[derive(Debug, Clone, Copy)]
pub struct WrittenRecord<'a> {
    /// The name under which the seat has handed it in.
    pub name: &'a RecordName,
    /// The whole file, one JSON object per line.
    pub content: &'a [u8],
    /// The mission time of a line; `None` if it has none.
    pub time_of: fn(&[u8]) -> Option<Duration>,
}

/// A head that is that of the record.
#[derive(Debug, Clone, Copy)]
struct FittingHead {
    /// The time by the desk's clock, in seconds since 1970.
    at: u64,
    /// The mission time of the record at that place, in seconds.
    mission_s: u64,
    /// Whether nothing follows in the record.
    is_end: bool,
}

impl Witness {
    /// Compares a record that was handed in with the heads of its try.
    pub fn of(flown: &CandidateTry, record: &WrittenRecord<'_>) -> Self {
        let mut named = flown.heads.iter().map(|it| &it.head.record);
        if let Some(other) = named.find(|it| *it != record.name) {
            let record = other.as_str().to_owned();
            return Self::OtherRecord { record };
        }
        let (fitting, total_s) = match fitting_heads(&flown.heads, record) {
            Ok(found) => found,
            Err(wrong) => {
                return Self::Rewritten {
                    at: wrong.at,
                    bytes: wrong.head.bytes,
                };
            }
        };
        let heads = fitting.len();
        let (gap_s, stopped_s) = (longest_gap(&fitting, total_s), time_stopped(&fitting));
        if heads == 0 {
            Self::Unseen
        } else if stopped_s > SLACK {
            Self::Stopped { heads, stopped_s }
        } else if gap_s > GAP {
            Self::Part { heads, gap_s }
        } else {
            Self::Whole { heads }
        }
    }

    /// Whether the record is one that the desk has seen being written, at least in part.
    pub fn fits(&self) -> bool {
        matches!(
            self,
            Self::Whole { .. } | Self::Part { .. } | Self::Stopped { .. }
        )
    }
}

/// The heads that are those of the record, and its mission time in seconds. Consoles write whole lines, so a head that
/// ends within a line shows nothing and is left out.
///
/// # Errors
/// A head that is not that of the record.
fn fitting_heads<'a>(
    heads: &'a [TimedHead],
    record: &WrittenRecord<'_>,
) -> Result<(Vec<FittingHead>, u64), &'a TimedHead> {
    let mut heads: Vec<&TimedHead> = heads.iter().collect();
    heads.sort_by_key(|it| it.head.bytes);
    let mut left = heads.into_iter().peekable();
    let mut fitting = Vec::new();
    let mut hash = Sha256::new();
    let (mut done, mut mission_s) = (0, 0);
    for line in record.content.split_inclusive(|byte| *byte == b'\n') {
        let end = done + line.len();
        let mut hashed = done;
        let time = (record.time_of)(line).map_or(mission_s, |time| time.as_secs());
        while let Some(it) = left.next_if(|it| it.head.bytes <= end as u64) {
            let upto = usize::try_from(it.head.bytes).unwrap_or(end);
            hash.update(&record.content[hashed..upto]);
            hashed = upto;
            if ContentHash::from(<[u8; 32]>::from(hash.clone().finalize())) != it.head.sha256 {
                return Err(it);
            }
            if upto == end && line.ends_with(b"\n") {
                fitting.push(FittingHead {
                    at: it.at,
                    mission_s: time,
                    is_end: end == record.content.len(),
                });
            }
        }
        hash.update(&record.content[hashed..end]);
        (done, mission_s) = (end, time);
    }
    // What a head says of more than there is was removed.
    left.next().map_or(Ok((fitting, mission_s)), Err)
}

/// The longest mission time without a head, in seconds. A record does not grow before its mission begins, so that time
/// is none.
fn longest_gap(heads: &[FittingHead], total_s: u64) -> u64 {
    let mut times = vec![0];
    times.extend(heads.iter().map(|it| it.mission_s));
    times.push(total_s);
    let gaps = times.windows(2).map(|pair| pair[1].saturating_sub(pair[0]));
    gaps.max().unwrap_or_default()
}

/// How much more time has passed at the desk than in the mission while it was flown, in seconds. A head of the whole
/// record may come long after the end of the mission, and is left out.
fn time_stopped(heads: &[FittingHead]) -> u64 {
    let flown = heads.iter().filter(|it| it.mission_s > 0 && !it.is_end);
    let mut behind = flown.map(|it| it.at.saturating_sub(it.mission_s));
    let least = behind.clone().min().unwrap_or_default();
    let newest = behind.next_back().unwrap_or_default();
    newest.saturating_sub(least)
}
