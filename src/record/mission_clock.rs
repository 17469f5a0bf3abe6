//! The mission's clock in a record, which differs from the record's clock: it starts when the
//! trainee leaves the brief, and a speed-up makes it run faster.

use std::time::Duration;

use super::{Happening, Journal};

/// The mission times of a record, each with its time in the record. Empty if no mission was flown.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MissionClock {
    /// The readings, in which both times increase.
    readings: Vec<Reading>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Reading {
    /// The time from the beginning of the record.
    at: Duration,
    elapsed: Duration,
}

impl MissionClock {
    /// The clock of the mission in a journal.
    pub fn of(journal: &Journal) -> Self {
        let mut clock = Self::default();
        for line in &journal.lines {
            if let Happening::Mission { ms } = line.what {
                clock.push(line.at(), Duration::from_millis(ms));
            }
        }
        clock
    }

    /// Adds a reading; a reading that is not later than the last one is left out.
    fn push(&mut self, at: Duration, elapsed: Duration) {
        let last = self.readings.last();
        if last.is_none_or(|it| it.at <= at && it.elapsed < elapsed) {
            self.readings.push(Reading { at, elapsed });
        }
    }

    /// Whether no mission was flown.
    pub fn is_empty(&self) -> bool {
        self.readings.is_empty()
    }

    /// The mission time at a time in the record: zero before the mission, and the mission's final
    /// time after its end. `None` if no mission was flown.
    pub fn mission_time(&self, at: Duration) -> Option<Duration> {
        self.readings.last()?;
        let passed = self.readings.partition_point(|it| it.at <= at);
        let last = passed.checked_sub(1).map(|last| self.readings[last]);
        Some(last.map_or(Duration::ZERO, |it| it.elapsed))
    }

    /// The time of an event in the record as shown in the debrief and the review: mission time, or
    /// the record's time if no mission was flown.
    pub fn flight_time(&self, at: Duration) -> Duration {
        self.mission_time(at).unwrap_or(at)
    }

    /// The time in the record at which a mission time was reached, or at which the mission ended if that was earlier;
    /// `None` if no mission was flown.
    pub fn record_time(&self, elapsed: Duration) -> Option<Duration> {
        let later = self.readings.partition_point(|it| it.elapsed < elapsed);
        let reached = self.readings.get(later).or(self.readings.last());
        reached.map(|it| it.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn s(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    #[test]
    fn each_clock_gives_the_time_of_the_other() {
        let mut clock = MissionClock::default();
        assert_eq!(clock.mission_time(s(3)), None);
        assert_eq!(clock.record_time(s(3)), None);
        // The brief took 20 s; after 30 s, the flight ran at four times real time.
        for (at, elapsed) in [(20, 1), (30, 11), (31, 15), (32, 19), (32, 19)] {
            clock.push(s(at), s(elapsed));
        }
        for (at, elapsed) in [(0, 0), (20, 1), (29, 1), (31, 15), (99, 19)] {
            assert_eq!(clock.mission_time(s(at)), Some(s(elapsed)), "at {at} s");
        }
        for (elapsed, at) in [(0, 20), (11, 30), (12, 31), (19, 32), (99, 32)] {
            assert_eq!(clock.record_time(s(elapsed)), Some(s(at)), "at {elapsed} s");
        }
    }
}
