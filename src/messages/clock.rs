//! The autopilot's clock, which begins at its boot: a step back is a reboot.

use std::time::Duration;

use crate::wire::{CLOCK_STEP_BACK_MS, is_clock_step_back};

/// No autopilot boots twice within this time.
const SETTLE: Duration = Duration::from_secs(10);

/// The meaning of a new reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Onward,
    /// The autopilot has booted since the reading before.
    Rebooted,
    /// Readings of two different clocks alternate: two vehicles share one system id. Reported once.
    TwoClocks,
}

/// Evaluates readings of the clock.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BootClock {
    /// The reading before the last step back, and when that step was seen.
    stepped_back: Option<(u32, Duration)>,
    two_clocks_said: bool,
}

impl BootClock {
    /// Compares a reading with the one before it.
    pub(super) fn note(&mut self, before: Option<u32>, boot_ms: u32, now: Duration) -> Step {
        let Some(before) = before else {
            return Step::Onward;
        };
        let settling = self
            .stepped_back
            .is_some_and(|(_, at)| now.saturating_sub(at) < SETTLE);
        if is_clock_step_back(before, boot_ms) {
            self.stepped_back = Some((before, now));
            return if settling {
                Step::Onward
            } else {
                Step::Rebooted
            };
        }
        let returned = self.stepped_back.is_some_and(|(old, _)| {
            boot_ms.abs_diff(old) < CLOCK_STEP_BACK_MS
                && boot_ms - before.min(boot_ms) > CLOCK_STEP_BACK_MS
        });
        if settling && returned && !self.two_clocks_said {
            self.two_clocks_said = true;
            return Step::TwoClocks;
        }
        Step::Onward
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(readings: &[(u32, u64)]) -> Vec<Step> {
        let mut clock = BootClock::default();
        let mut before = None;
        readings
            .iter()
            .map(|&(boot_ms, now_s)| {
                let step = clock.note(before, boot_ms, Duration::from_secs(now_s));
                before = Some(boot_ms);
                step
            })
            .collect()
    }

    #[test]
    fn only_a_real_step_back_is_a_reboot() {
        for (before, after, expected) in [
            (60_000, 54_000, Step::Rebooted),
            (60_000, 56_000, Step::Onward),
            (4_000, 1_200, Step::Rebooted),
            (4_000, 3_500, Step::Onward),
            (u32::MAX - 100, 150, Step::Onward),
            (100_000, 400, Step::Rebooted),
        ] {
            assert_eq!(
                steps(&[(before, 1), (after, 2)])[1],
                expected,
                "{before} to {after}"
            );
        }
    }

    #[test]
    fn each_of_two_reboots_is_seen() {
        let seen = steps(&[(90_000, 1), (500, 2), (60_500, 62), (700, 63)]);
        assert_eq!(
            seen,
            [Step::Onward, Step::Rebooted, Step::Onward, Step::Rebooted]
        );
    }

    #[test]
    fn two_vehicles_with_one_system_id_are_named_once_and_are_not_a_storm_of_reboots() {
        let readings: Vec<(u32, u64)> = (0..40)
            .map(|i| {
                (
                    if i % 2 == 0 { 90_000 } else { 20_000 } + i * 500,
                    u64::from(i / 2),
                )
            })
            .collect();
        let seen = steps(&readings);
        assert_eq!(
            seen.iter().filter(|step| **step == Step::TwoClocks).count(),
            1
        );
        assert_eq!(
            seen.iter().filter(|step| **step == Step::Rebooted).count(),
            1
        );
    }
}
