//! The terminal that the console is shown on, and the size of the smallest one that it can be shown on
//! ([`SMALLEST`]).

use crate::geo::GridSize;

/// The size of the smallest terminal that can show the console: columns and rows.
pub const SMALLEST: (u16, u16) = (80, 24);

/// Whether a terminal of this size, in columns and rows, is too small to show anything.
pub fn is_too_small(columns: u16, rows: u16) -> bool {
    columns < SMALLEST.0 || rows < SMALLEST.1
}

/// The terminal's size and speed, and its theme.
#[derive(Debug, Clone)]
pub struct Display {
    /// The size of the terminal: columns and rows.
    pub(in crate::app) size: (u16, u16),
    /// The throughput of the terminal's connection in bytes per second while it is too slow for the
    /// screen; otherwise `None`.
    pub(in crate::app) slow_line: Option<u32>,
    /// Whether rooms are drawn; the plain console has none.
    pub(in crate::app) has_rooms: bool,
    /// The names of the available themes.
    pub(in crate::app) themes: Vec<String>,
    /// The name of the theme in use.
    pub(in crate::app) theme: String,
}

impl Display {
    /// The size of the terminal: columns and rows.
    pub fn size(&self) -> (u16, u16) {
        self.size
    }

    /// The terminal as a grid of cells.
    pub fn grid(&self) -> GridSize {
        let (columns, rows) = self.size;
        GridSize::new(columns, rows)
    }

    /// Whether the terminal is too small to show anything, so keys would be pressed blindly.
    pub fn is_too_small(&self) -> bool {
        let (columns, rows) = self.size;
        is_too_small(columns, rows)
    }

    /// The throughput of the terminal's connection in bytes per second while it is too slow for the
    /// screen; otherwise `None`.
    pub fn slow_line(&self) -> Option<u32> {
        self.slow_line
    }
}
