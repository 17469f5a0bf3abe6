//! The height of the highest vehicle over a whole flight.

use std::time::Duration;

/// The initial length of an interval; it doubles when needed.
const FINEST: Duration = Duration::from_millis(500);
/// The maximum number of intervals. Beyond that, pairs are merged.
const PARTS: usize = 1024;

/// The greatest height in each interval of a flight, in metres above home; all intervals are equally long.
#[derive(Debug, Clone)]
pub struct Heights {
    part: Duration,
    highest_m: Vec<Option<f64>>,
}

impl Default for Heights {
    fn default() -> Self {
        Self {
            part: FINEST,
            highest_m: Vec::new(),
        }
    }
}

impl Heights {
    /// Records a height at a mission time; `None` if unknown.
    pub fn note(&mut self, elapsed: Duration, height_m: Option<f64>) {
        let mut at = self.place(elapsed);
        while at >= PARTS {
            self.thin_out();
            at = self.place(elapsed);
        }
        if at >= self.highest_m.len() {
            self.highest_m.resize(at + 1, None);
        }
        let known = &mut self.highest_m[at];
        *known = higher(*known, height_m);
    }

    /// One value per interval, from the start.
    pub fn all(&self) -> &[Option<f64>] {
        &self.highest_m
    }

    fn place(&self, elapsed: Duration) -> usize {
        (elapsed.as_millis() / self.part.as_millis()) as usize
    }

    fn thin_out(&mut self) {
        let pairs = self.highest_m.chunks(2);
        self.highest_m = pairs
            .map(|pair| pair.iter().copied().fold(None, higher))
            .collect();
        self.part *= 2;
    }
}

fn higher(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.max(b)),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_flight_is_kept_whole_with_its_peaks() {
        let mut heights = Heights::default();
        for second in 0..3600_u64 {
            let height_m = if second == 7 { 55.0 } else { 20.0 };
            heights.note(Duration::from_secs(second), Some(height_m));
        }
        let all = heights.all();
        assert!((PARTS / 2..=PARTS).contains(&all.len()), "{}", all.len());
        assert!(all.iter().all(Option::is_some));
        let peak = all.iter().position(|it| *it == Some(55.0));
        assert_eq!(peak, Some(7 * all.len() / 3600));
    }

    #[test]
    fn unknown_heights_leave_gaps_and_one_that_is_known_counts() {
        let mut heights = Heights::default();
        heights.note(Duration::ZERO, None);
        heights.note(Duration::ZERO, Some(1.5));
        heights.note(Duration::from_secs(1), Some(-1.0));
        assert_eq!(heights.all(), [Some(1.5), None, Some(-1.0)]);
    }
}
