//! The cells of the map that signs and numbers of vehicles cover, and the free ones beside, above and below a sign.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::labels::{MapCell, part, stamp};
use crate::ui::panel::Panel;

/// The cells of the map that already have a sign or a number.
pub(super) struct Board<'a> {
    panel: Panel<'a>,
    buffer: &'a mut Buffer,
    taken: Vec<bool>,
    spots: NumberSpots,
}

/// Where the numbers of vehicles may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberSpots {
    /// Beside their signs only, on a map that has other numbers.
    Beside,
    /// Beside their signs; without room there, above or below them.
    Around,
}

impl<'a> Board<'a> {
    pub(super) fn new(panel: Panel<'a>, spots: NumberSpots, buffer: &'a mut Buffer) -> Self {
        let cells = usize::from(panel.area.width) * usize::from(panel.area.height);
        Self {
            panel,
            buffer,
            taken: vec![false; cells],
            spots,
        }
    }

    pub(super) fn put(&mut self, column: u16, row: u16, text: &str, style: Style) {
        let area = self.panel.area;
        let place = Rect {
            x: area.x + column,
            y: area.y + row,
            width: area.width.saturating_sub(column),
            height: 1,
        };
        let written = stamp(text, style, self.panel.at(place), self.buffer);
        let from = usize::from(row) * usize::from(area.width) + usize::from(column);
        self.taken[from..from + usize::from(written)].fill(true);
    }

    /// The cells that have a sign, a number or a mark, sorted.
    pub(super) fn cells(&self) -> Vec<MapCell> {
        let width = usize::from(self.panel.area.width).max(1);
        let taken = self.taken.iter().enumerate().filter(|(_, taken)| **taken);
        let mut cells: Vec<MapCell> = taken
            .map(|(at, _)| ((at % width) as u16, (at / width) as u16))
            .collect();
        cells.sort_unstable();
        cells
    }

    /// Whether the cells are free, and within the row.
    fn is_free(&self, column: u16, row: u16, width: u16) -> bool {
        let from = usize::from(row) * usize::from(self.panel.area.width) + usize::from(column);
        let fits = column + width <= self.panel.area.width;
        fits && !self.taken[from..from + usize::from(width)].contains(&true)
    }

    /// Writes a text after a sign if nothing follows it directly.
    pub(super) fn write_apart(
        &mut self,
        sign: Range<u16>,
        row: u16,
        text: &str,
        style: Style,
    ) -> bool {
        let (right, width) = (sign.end, text.len() as u16);
        let gap = u16::from(right + width < self.panel.area.width);
        let is_apart = self.is_free(right, row, width + gap);
        if is_apart {
            self.write(right, row, text, style);
        }
        is_apart
    }

    /// Writes a text after a sign, or before it if nothing there could take it for its own.
    pub(super) fn write_beside(
        &mut self,
        sign: Range<u16>,
        row: u16,
        text: &str,
        style: Style,
    ) -> bool {
        let width = text.len() as u16;
        let right = sign.end;
        let left = sign.start.checked_sub(width).filter(|&left| {
            let gap = u16::from(left > 0);
            self.is_free(left - gap, row, width + gap)
        });
        let at = if self.is_free(right, row, width) {
            right
        } else if let Some(left) = left {
            left
        } else {
            return false;
        };
        self.write(at, row, text, style);
        true
    }

    /// Writes a text above a sign, or below it, where no other sign could take it for its own.
    pub(super) fn write_over(
        &mut self,
        sign: Range<u16>,
        row: u16,
        text: &str,
        style: Style,
    ) -> bool {
        if self.spots == NumberSpots::Beside {
            return false;
        }
        let (column, width) = (sign.start, text.len() as u16);
        let (from, end) = (column.saturating_sub(1), column + width);
        let gap = u16::from(end < self.panel.area.width);
        let above = row.checked_sub(1).map(|at| (at, at.checked_sub(1)));
        let below = (row + 1, Some(row + 2));
        let is_free = |&(at, beyond): &(u16, Option<u16>)| {
            let rows = [Some(at), beyond].into_iter().flatten();
            let mut rows = rows.filter(|&row| row < self.panel.area.height);
            at < self.panel.area.height && rows.all(|row| self.is_free(from, row, end + gap - from))
        };
        let spots = above.into_iter().chain([below]);
        let Some((at, _)) = spots.into_iter().find(is_free) else {
            return false;
        };
        self.write(column, at, text, style);
        true
    }

    fn write(&mut self, at: u16, row: u16, text: &str, style: Style) {
        self.put(at, row, text, style);
        let end = at + text.len() as u16;
        for beside in [at.checked_sub(1), Some(end)].into_iter().flatten() {
            self.part(beside, row);
        }
    }

    /// Blanks a letter or digit of the ground next to a number, because it could be read as part of the number.
    pub(super) fn part(&mut self, column: u16, row: u16) {
        if self.is_free(column, row, 1) {
            part(self.panel, (column, row), self.buffer);
        }
    }
}
