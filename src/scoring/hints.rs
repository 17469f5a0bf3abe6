//! The cost of requested hints.

use serde::{Deserialize, Serialize};

/// The cost of a hint of each level, as a share of the score.
const PRICES: [f64; 3] = [0.02, 0.05, 0.10];
/// The minimum factor, whatever the number of hints.
const FLOOR: f64 = 0.70;

/// The hints that a trainee has requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct HintsUsed {
    /// The number of hints of level 1, 2 and 3.
    pub levels: [u32; 3],
    /// The highest level of hints that cost nothing: on the first attempt, hints that do not give
    /// away the command.
    pub free_level: u8,
}

impl HintsUsed {
    /// `max(0.70, 1 - 0.02 L1 - 0.05 L2 - 0.10 L3)`, without the free levels.
    pub fn factor(&self) -> f64 {
        let free = usize::from(self.free_level);
        let levels = self.levels.iter().zip(PRICES).skip(free);
        let taken: f64 = levels.map(|(&count, price)| f64::from(count) * price).sum();
        (1.0 - taken).max(FLOOR)
    }

    /// Whether a hint that gives the commands was requested, in a mission where it costs points.
    pub fn gave_commands(&self) -> bool {
        let level = self.levels.len();
        self.levels[level - 1] > 0 && usize::from(self.free_level) < level
    }

    /// The number of hints.
    pub fn count(&self) -> u32 {
        self.levels.iter().sum()
    }

    /// The cost of the next hint of a level, 1 to 3, as a share of the score.
    pub fn price(&self, level: u8) -> f64 {
        let mut more = *self;
        if let Some(count) = more.levels.get_mut(usize::from(level).saturating_sub(1)) {
            *count += 1;
        }
        self.factor() - more.factor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_cost_by_their_level_down_to_a_floor_unless_their_level_is_free() {
        for (levels, free_level, expected) in [
            ([0, 0, 0], 0, 1.0),
            ([1, 0, 0], 0, 0.98),
            ([1, 1, 1], 0, 0.83),
            ([1, 1, 1], 2, 0.90),
            ([0, 0, 9], 0, 0.70),
            ([0, 0, 9], 3, 1.0),
        ] {
            let factor = HintsUsed { levels, free_level }.factor();
            assert!((factor - expected).abs() < 1e-9, "{levels:?}: {factor}");
        }
        assert!((HintsUsed::default().price(2) - 0.05).abs() < 1e-9);
    }

    #[test]
    fn only_a_hint_that_costs_points_counts_as_given_commands() {
        for (levels, free_level, expected) in [
            ([9, 9, 0], 0, false),
            ([0, 0, 1], 0, true),
            ([0, 0, 1], 2, true),
            ([0, 0, 1], 3, false),
        ] {
            let hints = HintsUsed { levels, free_level };
            assert_eq!(hints.gave_commands(), expected, "{levels:?} {free_level}");
        }
    }
}
