//! Seeds chosen by the program: one for each day, the same for all trainees, and those of exams,
//! each for one trainee.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// The exclusive upper bound of the seeds of practice, graded flights and days; small enough to be
/// typed.
pub(super) const FRESH_SEEDS: u64 = 1_000_000;
/// The seeds of exams. No other flight gets one of them unless the user types it.
const EXAM_SEEDS: Range<u64> = 100_000_000..1_000_000_000;

/// The key that makes a trainee's exams differ from those of all others.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ExamKey(u64);

impl ExamKey {
    /// The key of a profile with this name, created at this time.
    pub fn of(name: &str, since: &str) -> Self {
        let name = name.to_lowercase();
        Self(scattered_text(scattered_text(0, &name), since))
    }

    /// The key of a single flight without a profile.
    pub fn of_guest(random: u64) -> Self {
        Self(random)
    }
}

/// The seed of a day (days since 1970, UTC), the same for all trainees.
pub fn daily_seed(day: i64) -> u64 {
    scattered(day as u64 ^ 0x7361_696c_7964_6179) % FRESH_SEEDS
}

/// The seed of a trainee's exam. It differs from those of other trainees, so practising a
/// colleague's layout gives no advantage. It also changes with each exam taken, because the debrief
/// has revealed the truth of the last one.
pub fn exam_seed(key: ExamKey, mission: &str, revision: u32, taken: u32) -> u64 {
    let of_mission = scattered_text(key.0, mission);
    let of_exam = [revision, taken]
        .into_iter()
        .fold(of_mission, |seed, part| scattered(seed ^ u64::from(part)));
    EXAM_SEEDS.start + of_exam % (EXAM_SEEDS.end - EXAM_SEEDS.start)
}

fn scattered_text(start: u64, text: &str) -> u64 {
    let bytes = text.bytes();
    bytes.fold(scattered(start), |seed, byte| {
        scattered(seed ^ u64::from(byte))
    })
}

/// Scatters neighbouring values (the finaliser of `SplitMix64`).
fn scattered(value: u64) -> u64 {
    let mut mixed = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    for (shift, factor) in [(30, 0xbf58_476d_1ce4_e5b9), (27, 0x94d0_49bb_1331_11eb)] {
        mixed = (mixed ^ (mixed >> shift)).wrapping_mul(factor);
    }
    mixed ^ (mixed >> 31)
}
