//! The autopilot's clock, which begins at its boot: a step back is a reboot.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

/// A step back by more than this is not a reordering of datagrams.
const STEP_BACK_MS: u32 = 5_000;
/// A clock below this has just started; it may then have stepped back by less.
const NEAR_ZERO_MS: u32 = 5_000;
/// The largest step back by reordering for a clock that has just started.
const REORDERING_MS: u32 = 1_000;
/// A small step forward over the end of the 32-bit counter (49.7 days) is not a step back.
const WRAP_MS: u32 = 3_600_000;
/// No autopilot boots twice within this time.
const SETTLE: Duration = Duration::from_secs(10);
const NS_PER_MS: i64 = 1_000_000;

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
        if is_step_back(before, boot_ms) {
            self.stepped_back = Some((before, now));
            return if settling {
                Step::Onward
            } else {
                Step::Rebooted
            };
        }
        let returned = self.stepped_back.is_some_and(|(old, _)| {
            boot_ms.abs_diff(old) < STEP_BACK_MS && boot_ms - before.min(boot_ms) > STEP_BACK_MS
        });
        if settling && returned && !self.two_clocks_said {
            self.two_clocks_said = true;
            return Step::TwoClocks;
        }
        Step::Onward
    }
}

fn is_step_back(before: u32, boot_ms: u32) -> bool {
    if boot_ms >= before || boot_ms.wrapping_sub(before) < WRAP_MS {
        return false;
    }
    let back = before - boot_ms;
    back > STEP_BACK_MS || (boot_ms < NEAR_ZERO_MS && back > REORDERING_MS)
}

/// Milliseconds since boot, if the message carries them; 0 means that the sender has left them out. A vehicle whose
/// streams stopped at a reboot still requests the time now and then, with its own clock. Nanoseconds too large for the
/// counter are those of another clock.
pub(super) fn boot_ms(message: &MavMessage) -> Option<u32> {
    use MavMessage as M;
    let boot_ms = match message {
        M::ATTITUDE(data) => Some(data.time_boot_ms),
        M::GLOBAL_POSITION_INT(data) => Some(data.time_boot_ms),
        M::LOCAL_POSITION_NED(data) => Some(data.time_boot_ms),
        M::POSITION_TARGET_GLOBAL_INT(data) => Some(data.time_boot_ms),
        M::POSITION_TARGET_LOCAL_NED(data) => Some(data.time_boot_ms),
        M::RC_CHANNELS(data) => Some(data.time_boot_ms),
        M::SYSTEM_TIME(data) => Some(data.time_boot_ms),
        M::TIMESYNC(data) if data.tc1 == 0 => u32::try_from(data.ts1 / NS_PER_MS).ok(),
        _ => None,
    };
    boot_ms.filter(|&boot_ms| boot_ms != 0)
}

#[cfg(test)]
mod tests {
    use mavlink::dialects::ardupilotmega::TIMESYNC_DATA;

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
    fn only_the_vehicles_own_question_for_the_time_tells_its_clock() {
        let time = |tc1, ts1| {
            boot_ms(&MavMessage::TIMESYNC(TIMESYNC_DATA {
                tc1,
                ts1,
                ..Default::default()
            }))
        };
        assert_eq!(time(0, 10_001_831_001), Some(10_001));
        assert_eq!(time(10_001_831_001, 55), None, "an answer");
        assert_eq!(time(0, 0), None, "not filled in");
        assert_eq!(time(0, 1_795_198_816_169_700_000), None, "time of day");
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
