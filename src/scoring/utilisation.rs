//! Utilisation: how well the available vehicles were used.

use std::time::Duration;

use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The value of a vehicle that was never flown.
const NEVER_FLOWN: f64 = 0.3;
/// A vehicle with this share of the longest air time counts as fully flown.
const FULL_SHARE: f64 = 0.5;
/// The share of idle time at which a vehicle earns no points for being busy.
const MOST_IDLE: f64 = 0.3;

/// A vehicle without a task for longer than this counts as idle.
pub const IDLE_AFTER: Duration = Duration::from_secs(30);

/// The times of one vehicle in the air, with a task and without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VehicleUse {
    pub vehicle: VehicleId,
    /// Time in the air.
    pub airborne: Duration,
    /// The part of the air time with a task: travelling, in a manoeuvre, sampling.
    pub productive: Duration,
    /// The part of the air time without a task for more than [`IDLE_AFTER`] at a time.
    pub idle: Duration,
}

impl VehicleUse {
    /// `0.6 * productive share + 0.4 * (1 - min(1, idle share / 0.3))` of its time in the air.
    fn own_value(&self) -> f64 {
        let airborne_s = self.airborne.as_secs_f64();
        let share = |part: Duration| (part.as_secs_f64() / airborne_s).min(1.0);
        0.6 * share(self.productive) + 0.4 * (1.0 - (share(self.idle) / MOST_IDLE).min(1.0))
    }
}

/// The mean over all vehicles; 0 if none has flown. A vehicle that made only a short hop counts
/// almost like a vehicle that was never flown.
pub fn utilisation_value(uses: &[VehicleUse]) -> f64 {
    let longest = uses.iter().map(|one| one.airborne).max();
    let Some(longest) = longest.filter(|longest| !longest.is_zero()) else {
        return 0.0;
    };
    let of = |one: &VehicleUse| {
        if one.airborne.is_zero() {
            return NEVER_FLOWN;
        }
        let full_s = FULL_SHARE * longest.as_secs_f64();
        let share = (one.airborne.as_secs_f64() / full_s).min(1.0);
        share * one.own_value() + (1.0 - share) * NEVER_FLOWN
    };
    uses.iter().map(of).sum::<f64>() / uses.len() as f64
}

/// The value and its main cause: a vehicle never flown, otherwise the vehicle that idled longest.
pub(super) fn value_and_words(uses: &[VehicleUse]) -> (f64, Text) {
    let value = utilisation_value(uses);
    let unused: Vec<String> = uses
        .iter()
        .filter(|one| one.airborne.is_zero())
        .map(|one| one.vehicle.to_string())
        .collect();
    let words = match idlest(uses) {
        _ if unused.len() == uses.len() => text!("scoring-none-flown"),
        _ if !unused.is_empty() => text!("scoring-never-flown", vehicles = unused.join(", ")),
        Some(one) => text!(
            "scoring-idle",
            vehicle = one.vehicle,
            time = minutes(one.idle)
        ),
        None => text!("scoring-never-idle", count = uses.len()),
    };
    (value, words)
}

/// Advice on the use of the vehicles; `None` if all were used well.
pub(super) fn advice(uses: &[VehicleUse]) -> Option<Text> {
    let unused = uses.iter().find(|one| one.airborne.is_zero());
    let idle = || {
        idlest(uses).map(|one| {
            let (vehicle, time) = (one.vehicle, minutes(one.idle));
            text!("scoring-advice-idle", vehicle = vehicle, time = time)
        })
    };
    let slack = || (utilisation_value(uses) < 0.95).then(|| text!("scoring-advice-slack"));
    unused
        .map(|one| text!("scoring-advice-unused", vehicle = one.vehicle))
        .or_else(idle)
        .or_else(slack)
}

fn idlest(uses: &[VehicleUse]) -> Option<&VehicleUse> {
    let idle = uses.iter().filter(|one| !one.idle.is_zero());
    idle.max_by_key(|one| one.idle)
}

/// A time as `3:10`; tenths of seconds are truncated.
pub(super) fn minutes(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn used(vehicle: VehicleId, airborne_s: u64, productive_s: u64, idle_s: u64) -> VehicleUse {
        VehicleUse {
            vehicle,
            airborne: Duration::from_secs(airborne_s),
            productive: Duration::from_secs(productive_s),
            idle: Duration::from_secs(idle_s),
        }
    }

    #[test]
    fn utilisation_follows_its_formula() {
        for (uses, expected) in [
            (vec![], 0.0),
            (vec![used(1, 0, 0, 0), used(2, 0, 0, 0)], 0.0),
            (vec![used(1, 100, 100, 0), used(2, 100, 100, 0)], 1.0),
            (vec![used(1, 100, 100, 0), used(2, 0, 0, 0)], 0.65),
            (vec![used(1, 100, 50, 15)], 0.6 * 0.5 + 0.4 * 0.5),
            (vec![used(1, 100, 0, 100)], 0.0),
            // A hop of 5 s, which is a tenth of the time that counts as flown.
            (
                vec![used(1, 100, 100, 0), used(2, 5, 5, 0)],
                f64::midpoint(1.0, 0.1 + 0.9 * 0.3),
            ),
        ] {
            let value = utilisation_value(&uses);
            assert!((value - expected).abs() < 1e-9, "{uses:?}: {value}");
        }
    }

    #[test]
    fn the_words_name_who_was_left_on_the_pad_before_who_idled() {
        let (_, words) = value_and_words(&[used(1, 100, 10, 90), used(2, 0, 0, 0)]);
        assert!(words.contains("2"), "{words}");
        let (_, words) = value_and_words(&[used(1, 200, 10, 190), used(2, 100, 100, 0)]);
        assert!(words.contains("3:10"), "{words}");
    }
}
