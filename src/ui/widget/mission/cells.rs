//! The surveyed cells as a grid: the name of each, or its value.

use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::Line;

use crate::app::State;
use crate::mission::Cell;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, columns, put};
use crate::vehicle::Vehicle;

/// The width of a cell in the grid, in columns.
const CELL_WIDTH: u16 = 7;
/// The largest grid that is drawn, in cells per side.
const GRID_LIMIT: usize = 64;

/// Cells in rows (the northernmost first) and columns (the westernmost first).
pub(super) struct Grid<'a> {
    cells: Vec<(usize, usize, &'a Cell)>,
    columns: usize,
}

impl<'a> Grid<'a> {
    /// The grid of these cells; `None` without cells, or if there are too many to draw.
    pub fn of(cells: &'a [Cell]) -> Option<Self> {
        let first = cells.first()?;
        let side = first.side_m.max(0.1);
        let places: Vec<(f64, f64)> = cells
            .iter()
            .map(|cell| first.centre.offset_to(cell.centre))
            .collect();
        let north = places
            .iter()
            .fold(f64::MIN, |most, place| most.max(place.0));
        let west = places
            .iter()
            .fold(f64::MAX, |least, place| least.min(place.1));
        let cells: Vec<_> = cells
            .iter()
            .zip(&places)
            .map(|(cell, place)| {
                let row = ((north - place.0) / side).round() as usize;
                let column = ((place.1 - west) / side).round() as usize;
                (row, column, cell)
            })
            .collect();
        let most = cells
            .iter()
            .map(|&(row, column, _)| row.max(column))
            .max()?;
        let columns = cells.iter().map(|&(_, column, _)| column).max()? + 1;
        (most < GRID_LIMIT).then_some(Self { cells, columns })
    }

    pub fn rows(&self) -> usize {
        self.cells
            .iter()
            .map(|&(row, ..)| row + 1)
            .max()
            .unwrap_or(0)
    }

    /// Draws the cells. A cell shows its name until it is sampled, then its value.
    pub fn draw(&self, state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
        let fits = panel.area.width / self.columns.max(1) as u16;
        let width = fits.min(CELL_WIDTH);
        if width < 3 || panel.area.height == 0 {
            return;
        }
        let mut rows = panel.area.height;
        if self.rows() > usize::from(rows) {
            rows -= 1;
            let text = panel.say("mission-more-cells");
            put(
                buffer,
                panel.area,
                rows,
                &Line::styled(text, panel.style(Role::Muted)),
            );
        }
        for &(row, column, cell) in &self.cells {
            if row < usize::from(rows) {
                let here = columns(panel.area, column as u16 * width, width);
                let (text, style) = Self::cell(cell, state, panel.look);
                let text = clip(&text, usize::from(width) - 1);
                put(buffer, here, row as u16, &Line::styled(text, style));
            }
        }
    }

    fn cell(cell: &Cell, state: &State, look: &Look) -> (String, Style) {
        let over = |vehicle: &&Arc<Vehicle>| {
            vehicle.airborne()
                && vehicle.global.is_some_and(|global| {
                    let (north, east) = cell.centre.offset_to(global.at_point);
                    north.abs().max(east.abs()) < cell.side_m / 2.0
                })
        };
        let here = state.session().vehicles().values().find(over);
        let style = look.style(match (here, cell.sampled) {
            (Some(_), _) => Role::Cursor,
            (None, true) => Role::Ok,
            (None, false) => Role::Muted,
        });
        let text = match cell.value {
            Some(value) if cell.sampled && value.abs() < 99.95 => format!("{value:.1}"),
            Some(value) if cell.sampled => format!("{value:.0}"),
            None if cell.sampled => look.say("mission-cell-done"),
            _ => cell.name.clone(),
        };
        match here {
            Some(vehicle) => (format!("{}>{text}", vehicle.id), style),
            None => (text, style),
        }
    }
}
