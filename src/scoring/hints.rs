//! Hints that were asked for: what they take from the score.

use serde::{Deserialize, Serialize};

/// What a hint of each level takes.
const PRICES: [f64; 3] = [0.02, 0.05, 0.10];
/// However many hints there were, this much of the score is left.
const FLOOR: f64 = 0.70;

/// The hints that a trainee has asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct HintsUsed {
    /// How many of level 1, 2 and 3.
    pub levels: [u32; 3],
    /// The highest level that is free: on the first try, the hints that leave something to think about.
    pub free_level: u8,
}

impl HintsUsed {
    /// `max(0.70, 1 - 0.02 L1 - 0.05 L2 - 0.10 L3)`, without the levels that are free.
    pub fn factor(&self) -> f64 {
        let free = usize::from(self.free_level);
        let levels = self.levels.iter().zip(PRICES).skip(free);
        let taken: f64 = levels.map(|(&count, price)| f64::from(count) * price).sum();
        (1.0 - taken).max(FLOOR)
    }

    /// How many there were.
    pub fn count(&self) -> u32 {
        self.levels.iter().sum()
    }

    /// What the next hint of a level, 1 to 3, would take, as a share of the score.
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
}
