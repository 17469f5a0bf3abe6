//! Compares a record that was handed in with the heads that the desk has noted.

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::{CandidateTry, ContentHash};
use crate::RecordName;

/// The longest time between two heads that a witness may miss, in seconds: seats report every 10 s.
pub const GAP: u64 = 30;

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
        /// The longest time without one, in seconds.
        gap_s: u64,
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

impl Witness {
    /// Compares the content of a record that was handed in at a time with the heads of its try.
    pub fn of(flown: &CandidateTry, record: &RecordName, content: &[u8], handed_in: u64) -> Self {
        let Some(first) = flown.heads.first() else {
            return Self::Unseen;
        };
        if let Some(other) = flown.heads.iter().find(|it| it.head.record != *record) {
            let record = other.head.record.as_str().to_owned();
            return Self::OtherRecord { record };
        }
        let mut heads: Vec<_> = flown.heads.iter().collect();
        heads.sort_by_key(|it| it.head.bytes);
        let mut hash = Sha256::new();
        let mut done = 0;
        for it in heads {
            let end = usize::try_from(it.head.bytes).unwrap_or(usize::MAX);
            if let Some(more) = content.get(done..end) {
                hash.update(more);
                done = end;
            }
            if done != end
                || ContentHash::from(<[u8; 32]>::from(hash.clone().finalize())) != it.head.sha256
            {
                let (at, bytes) = (it.at, it.head.bytes);
                return Self::Rewritten { at, bytes };
            }
        }
        let mut times: Vec<u64> = vec![flown.opened.unwrap_or(first.at)];
        times.extend(flown.heads.iter().map(|it| it.at));
        if done < content.len() {
            times.push(handed_in);
        }
        let gap_s = longest_gap(&times);
        let heads = flown.heads.len();
        if gap_s > GAP {
            Self::Part { heads, gap_s }
        } else {
            Self::Whole { heads }
        }
    }

    /// Whether the record is one that the desk has seen being written, at least in part.
    pub fn fits(&self) -> bool {
        matches!(self, Self::Whole { .. } | Self::Part { .. })
    }
}

fn longest_gap(times: &[u64]) -> u64 {
    let gaps = times.windows(2).map(|pair| pair[1].saturating_sub(pair[0]));
    gaps.max().unwrap_or_default()
}
