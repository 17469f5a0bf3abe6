//! The time since a sender's boot, which many messages contain.

use mavlink::dialects::ardupilotmega::MavMessage;

/// A step back by more than this, in milliseconds, is not a reordering of datagrams.
pub const CLOCK_STEP_BACK_MS: u32 = 5_000;
/// A clock below this has just started; it may then have stepped back by less.
const NEAR_ZERO_MS: u32 = 5_000;
/// The largest step back by reordering for a clock that has just started.
const REORDERING_MS: u32 = 1_000;
/// A small step forward over the end of the 32-bit counter (49.7 days) is not a step back.
const WRAP_MS: u32 = 3_600_000;
const NS_PER_MS: i64 = 1_000_000;

/// Whether a clock that counts from its boot has stepped back: its sender has booted again.
pub fn is_clock_step_back(before: u32, boot_ms: u32) -> bool {
    if boot_ms >= before || boot_ms.wrapping_sub(before) < WRAP_MS {
        return false;
    }
    let back = before - boot_ms;
    back > CLOCK_STEP_BACK_MS || (boot_ms < NEAR_ZERO_MS && back > REORDERING_MS)
}

/// Milliseconds since boot, if the message carries them; 0 means that the sender has left them out. A vehicle whose
/// streams stopped at a reboot still requests the time now and then, with its own clock. Nanoseconds too large for the
/// counter are those of another clock.
pub fn boot_ms(message: &MavMessage) -> Option<u32> {
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
}
