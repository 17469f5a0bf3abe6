//! The time of day in a record, whose own times leave out the pauses.

use std::time::Duration;

use super::{Happening, Journal};

/// The pauses of a record, from which its times of day are computed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DayClock {
    pauses: Vec<DayPause>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct DayPause {
    /// The time in the record at which it began.
    at: Duration,
    /// How long this pause and all before it lasted.
    so_far: Duration,
}

impl DayClock {
    /// The pauses in a journal.
    pub fn of(journal: &Journal) -> Self {
        let mut clock = Self::default();
        for line in &journal.lines {
            if let Happening::Paused { ms } = line.what {
                clock.push(line.at(), Duration::from_millis(ms));
            }
        }
        clock
    }

    fn push(&mut self, at: Duration, lasted: Duration) {
        let before = self.pauses.last().map_or(Duration::ZERO, |it| it.so_far);
        let so_far = before.saturating_add(lasted);
        self.pauses.push(DayPause { at, so_far });
    }

    /// The time of day at a time in a record that began at `began_unix_us`; both times of day are
    /// in microseconds since 1970 (UTC).
    pub fn unix_us(&self, began_unix_us: u64, at: Duration) -> u64 {
        let passed = self.pauses.partition_point(|pause| pause.at < at);
        let last = passed.checked_sub(1).and_then(|last| self.pauses.get(last));
        let paused = last.map_or(Duration::ZERO, |pause| pause.so_far);
        let since = at.saturating_add(paused).as_micros();
        began_unix_us.saturating_add(u64::try_from(since).unwrap_or(u64::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_include_the_pauses_before_them() {
        let s = Duration::from_secs;
        let mut clock = DayClock::default();
        assert_eq!(clock.unix_us(1_000_000, s(3)), 4_000_000);
        clock.push(s(10), s(60));
        clock.push(s(20), s(5));
        for (at, expected) in [(9, 9), (10, 10), (11, 71), (20, 80), (21, 86)] {
            let found = clock.unix_us(0, s(at));
            assert_eq!(found, expected * 1_000_000, "at {at} s");
        }
        clock.push(s(30), Duration::MAX);
        assert_eq!(clock.unix_us(7, s(40)), u64::MAX);
    }
}
