//! Movements of the cursor, the same in every room.

use strum::{EnumIter, IntoStaticStr};

/// A movement of the cursor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Step {
    Up,
    Down,
    /// One column to the left.
    Left,
    /// One column to the right.
    Right,
    PageUp,
    PageDown,
    /// To the first line.
    First,
    /// To the last line.
    Last,
    /// To a given line, counted from 0; sent by clicks, never by a key.
    #[strum(disabled)]
    Row(usize),
}

impl Step {
    /// The line after a step from `at` of `count` lines; never out of range.
    pub fn apply(self, at: usize, count: usize) -> usize {
        let last = count.saturating_sub(1);
        match self {
            Self::Up => at.saturating_sub(1),
            Self::Down => at.saturating_add(1).min(last),
            Self::Left | Self::Right => at.min(last),
            Self::PageUp => at.saturating_sub(10),
            Self::PageDown => at.saturating_add(10).min(last),
            Self::First => 0,
            Self::Last => last,
            Self::Row(row) => row.min(last),
        }
    }
}
