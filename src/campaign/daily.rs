//! Seeds that are the same for all trainees.

/// The seed of a day (days since 1970, UTC): the same for all trainees, it changes daily.
pub fn daily_seed(day: i64) -> u64 {
    mixed(day as u64 ^ 0x7361_696c_7964_6179)
}

/// The seed of a mission's exam. It is the same for all trainees and does not change until the mission is revised. Each
/// exam that a trainee takes changes the seed, because its debrief shows the truth.
pub fn exam_seed(mission: &str, revision: u32, taken: u32) -> u64 {
    let first = mission
        .bytes()
        .fold(mixed(u64::from(revision)), |seed, byte| {
            mixed(seed ^ u64::from(byte))
        });
    (0..taken).fold(first, |seed, _| mixed(seed ^ u64::from(taken)))
}

/// Scatters neighbouring values (the finaliser of `SplitMix64`). The result is small enough to be typed.
fn mixed(value: u64) -> u64 {
    let mut mixed = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    for (shift, factor) in [(30, 0xbf58_476d_1ce4_e5b9), (27, 0x94d0_49bb_1331_11eb)] {
        mixed = (mixed ^ (mixed >> shift)).wrapping_mul(factor);
    }
    (mixed ^ (mixed >> 31)) % 1_000_000
}
