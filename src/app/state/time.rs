//! Session time by the program's clock.

use std::time::Duration;

/// The time between two marks: within a second, a mission's pace hardly changes.
const MARK_EVERY: Duration = Duration::from_secs(1);

/// The relation between session time and the program's clock. Session time may run faster or
/// slower, and unevenly if the vehicles' clocks determine it.
#[derive(Debug, Clone, Default)]
pub struct SessionTime {
    /// Pairs of program time and session time. The first is the last one with a session time of
    /// zero; between two pairs, session time is interpolated linearly.
    marks: Vec<(Duration, Duration)>,
    /// The pace after the last mark, relative to the program's clock; zero if only marks advance session time.
    pace: f64,
}

impl SessionTime {
    pub fn note(&mut self, now: Duration, elapsed: Duration) {
        if elapsed.is_zero() {
            self.marks.clear();
        }
        if let [.., (_, before), newest] = self.marks.as_mut_slice()
            && newest.1 < *before + MARK_EVERY
        {
            *newest = (now, elapsed);
        } else {
            self.marks.push((now, elapsed));
        }
    }

    /// Runs at a constant pace from `now` on; starts at zero if session time has not begun.
    pub fn go(&mut self, now: Duration, pace: f64) {
        let elapsed = self.at(now).unwrap_or_default();
        self.marks.push((now, elapsed));
        self.pace = pace;
    }

    /// Session time at the program time `then`: zero before the start, `None` if it is unknown.
    pub fn at(&self, then: Duration) -> Option<Duration> {
        let next = self.marks.partition_point(|(now, _)| *now < then);
        let before = next.checked_sub(1).and_then(|last| self.marks.get(last));
        match (before, self.marks.get(next)) {
            (Some(&(from, begun)), Some(&(to, until))) => {
                let share = then
                    .saturating_sub(from)
                    .div_duration_f64(to.saturating_sub(from));
                Some(begun + until.saturating_sub(begun).mul_f64(share))
            }
            (Some(&(last, elapsed)), None) => {
                Some(elapsed + then.saturating_sub(last).mul_f64(self.pace))
            }
            (None, Some(&(first, elapsed))) => {
                Some(elapsed.saturating_sub(first.saturating_sub(then)))
            }
            (None, None) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[test]
    fn mission_time_is_known_for_every_time_of_the_program_however_the_pace_changes() {
        let mut time = SessionTime::default();
        assert_eq!(time.at(ms(500)), None);
        // Session time waits up to 8 s for the vehicles, then runs at ten times the pace, then stops.
        for tick in 50..=80 {
            time.note(ms(100 * tick), Duration::ZERO);
        }
        for tick in 1..=200 {
            time.note(ms(8_000 + 10 * tick), ms(100 * tick));
        }
        time.note(ms(15_000), ms(20_000));
        let known = [
            (0, 0),
            (7_000, 0),
            (8_000, 0),
            (8_005, 50),
            (8_010, 100),
            (9_000, 10_000),
            (9_999, 19_990),
            (10_000, 20_000),
            (12_000, 20_000),
            (99_000, 20_000),
        ];
        for (then, elapsed) in known {
            assert_eq!(time.at(ms(then)), Some(ms(elapsed)), "{then}");
        }
        assert!(time.marks.len() < 30, "{}", time.marks.len());
    }
    #[test]
    fn free_flight_goes_at_the_pace_that_is_in_force() {
        let mut time = SessionTime::default();
        time.go(ms(2_000), 20.0);
        time.go(ms(3_000), 1.0);
        time.go(ms(4_000), 4.0);
        let known = [
            (1_000, 0),
            (2_500, 10_000),
            (3_000, 20_000),
            (3_500, 20_500),
            (5_000, 25_000),
        ];
        for (then, elapsed) in known {
            assert_eq!(time.at(ms(then)), Some(ms(elapsed)), "{then}");
        }
    }
}
