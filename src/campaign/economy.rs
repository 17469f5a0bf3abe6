//! The prices and rewards of a career: credits, licences, experience and levels.

use super::CareerFlight;
use crate::geo::maths;

/// The initial credits of a career.
pub(super) const START_CREDITS: u32 = 500;
/// The licence for a part costs this share of its price.
const LICENCE_SHARE: f64 = 0.4;
/// The share of the reward for the first pass itself; the rest depends on the score.
const FOR_PASSING: f64 = 0.5;
/// The experience for a perfect flight, per tier; tier 0 counts as half a tier.
const EXPERIENCE: f64 = 187.5;
/// The experience factor for the first flight of a day that refreshes a due skill.
const DUE_SKILL: f64 = 1.2;
/// Level n needs `LEVEL * n^1.5` experience.
const LEVEL: f64 = 250.0;

/// The parts that every trainee may use from the start: a small quad with a vapour detector.
pub const STARTER_PARTS: [&str; 10] = [
    "fr_450q",
    "m2212_920",
    "p10x4.5p",
    "b3s5000",
    "e30opto",
    "fc_h7",
    "gps_m8n",
    "pm_02",
    "r_sik915",
    "s_voc",
];

/// The price of a part's licence, in credits.
pub fn licence_price(credits: u32) -> u32 {
    (f64::from(credits) * LICENCE_SHARE).ceil() as u32
}

/// Credits for a flight that counts, given the best score of earlier passes, if any: the full reward for the first
/// pass, then only for improvements. A drill's reward is set in its file, like a mission's.
pub(super) fn pay(flight: &CareerFlight, best: Option<u16>) -> u32 {
    if !flight.passed {
        return 0;
    }
    let reward = f64::from(flight.reward);
    let share = match best {
        None => FOR_PASSING + (1.0 - FOR_PASSING) * thousandths(flight.score),
        Some(best) => thousandths(flight.score.saturating_sub(best)),
    };
    (reward * share).round() as u32
}

/// Experience for a flight that counts, given the best score of earlier passes, if any. Like
/// credits, it is earned only by an improvement: a pass with the same score as before earns none. A
/// failed flight earns neither; otherwise a few reports from above the pad would earn some.
pub(super) fn experience(flight: &CareerFlight, best: Option<u16>, refreshes: bool) -> u32 {
    let is_best = best.is_none_or(|best| flight.score > best);
    if !flight.passed || !is_best {
        return 0;
    }
    let tier = f64::from(flight.tier).max(0.5);
    let due = if refreshes { DUE_SKILL } else { 1.0 };
    (EXPERIENCE * tier * thousandths(flight.score) * due).round() as u32
}

/// The level for an amount of experience.
pub(super) fn level(experience: u64) -> u32 {
    maths::powf(experience as f64 / LEVEL, 2.0 / 3.0).floor() as u32
}

/// The experience needed for a level.
pub(super) fn level_experience(level: u32) -> u64 {
    (LEVEL * maths::powf(f64::from(level), 1.5)).ceil() as u64
}

fn thousandths(score: u16) -> f64 {
    f64::from(score.min(1000)) / 1000.0
}
