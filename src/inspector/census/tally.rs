//! The counters and the rate of one kind of message.

use std::time::Duration;

use super::MessageStatistics;

/// The number of whole seconds over which rates are measured.
const WINDOW_S: u64 = 5;
/// The seconds of the window and the current one, rounded up to a power of two for a cheap division.
const SLOTS: usize = 8;

/// The counts of one kind of message.
#[derive(Debug, Clone, PartialEq)]
pub struct MessageTally {
    pub count: u64,
    /// Their total size on the wire, in bytes.
    pub bytes: u64,
    /// The time of the first message.
    pub first_at: Duration,
    /// The time of the last message.
    pub last_at: Duration,
    /// Whether the checksum of the last one was verified by the dialect.
    pub is_verified: bool,
    /// The bytes of the last message.
    pub last: Vec<u8>,
    /// The statistics since the last reset.
    pub statistics: MessageStatistics,
    /// Whether the checksum of the first one was verified.
    pub(super) was_admitted_verified: bool,
    slots: [TallySlot; SLOTS],
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct TallySlot {
    second: u64,
    count: u32,
    bytes: u32,
}

/// The rate of a kind of message.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    pub hz: f64,
    pub bytes_s: f64,
}

impl std::ops::AddAssign for Rate {
    fn add_assign(&mut self, more: Self) {
        self.hz += more.hz;
        self.bytes_s += more.bytes_s;
    }
}

impl MessageTally {
    pub(super) fn new(is_verified: bool, now: Duration) -> Self {
        Self {
            count: 0,
            bytes: 0,
            first_at: now,
            last_at: now,
            is_verified,
            was_admitted_verified: is_verified,
            last: Vec::new(),
            statistics: MessageStatistics::new(now),
            slots: [TallySlot::default(); SLOTS],
        }
    }

    pub(super) fn note(&mut self, frame: &[u8], is_verified: bool, now: Duration) {
        self.count += 1;
        self.bytes += frame.len() as u64;
        self.last_at = now;
        self.statistics.note(frame.len(), now);
        self.is_verified = is_verified;
        self.last.clear();
        self.last.extend_from_slice(frame);
        let second = now.as_secs();
        let slot = &mut self.slots[(second % SLOTS as u64) as usize];
        if slot.second != second {
            *slot = TallySlot {
                second,
                ..TallySlot::default()
            };
        }
        slot.count = slot.count.saturating_add(1);
        slot.bytes = slot.bytes.saturating_add(frame.len() as u32);
    }

    /// The rate over the last five whole seconds; over fewer while the kind of message is new.
    pub fn rate(&self, now: Duration) -> Rate {
        let running = now.as_secs();
        let window = running.saturating_sub(WINDOW_S)..running;
        let (mut count, mut bytes) = (0.0, 0.0);
        // The running second counts only while no whole second has passed.
        let is_young = self.first_at.as_secs() >= running;
        for slot in self.slots.iter().filter(|slot| slot.count > 0) {
            if window.contains(&slot.second) || is_young && slot.second == running {
                count += f64::from(slot.count);
                bytes += f64::from(slot.bytes);
            }
        }
        let whole = running.saturating_sub(self.first_at.as_secs());
        // The first second was not a whole one: it began with the first message.
        let seconds = match whole {
            0 => 1.0,
            1..=WINDOW_S => Duration::from_secs(running)
                .saturating_sub(self.first_at)
                .as_secs_f64()
                .max(1.0),
            _ => WINDOW_S as f64,
        };
        Rate {
            hz: count / seconds,
            bytes_s: bytes / seconds,
        }
    }
}
