//! Squares of ground as cells of a view.

use ratatui::buffer::Buffer;
use ratatui::style::Style;

use super::labels::MapCell;
use crate::geo::{DOTS_ACROSS, DOTS_DOWN, Dot, LatLon, Viewport};
use crate::ui::panel::Panel;

/// The cells whose centres are in a square of ground around a place; at least the cell that contains the place.
pub fn cells(
    view: &Viewport,
    middle: LatLon,
    side_m: f64,
) -> impl Iterator<Item = MapCell> + use<> {
    let half = side_m / view.metres_per_dot() / 2.0;
    let Dot { x, y } = view.dot(middle);
    let across = covered(x, half, f64::from(DOTS_ACROSS), view.columns);
    let down = covered(y, half, f64::from(DOTS_DOWN), view.rows);
    down.flat_map(move |row| across.clone().map(move |column| (column, row)))
}

/// The cells of a row whose centres are within `half` of a dot; at least the cell that contains the dot.
fn covered(dot: f64, half: f64, dots: f64, count: u16) -> std::ops::Range<u16> {
    let from = ((dot - half) / dots - 0.5).ceil();
    let to = ((dot + half) / dots - 0.5).ceil();
    let (from, to) = if from < to {
        (from, to)
    } else {
        ((dot / dots).floor(), (dot / dots).floor() + 1.0)
    };
    let within = |at: f64| at.clamp(0.0, f64::from(count)) as u16;
    within(from)..within(to)
}

/// The maximum share of a cell that a square of ground can cover.
pub fn share_of_cell(view: &Viewport, side_m: f64) -> f64 {
    let column_m = view.zoom.metres_per_column();
    let row_m = column_m * f64::from(DOTS_DOWN / DOTS_ACROSS);
    (side_m / column_m).min(1.0) * (side_m / row_m).min(1.0)
}

/// Draws a sign in a cell of the map.
pub fn fill(cell: MapCell, sign: char, style: Style, panel: Panel<'_>, buffer: &mut Buffer) {
    let (column, row) = cell;
    let at = (panel.area.x + column, panel.area.y + row);
    if let Some(cell) = buffer.cell_mut(at) {
        cell.set_char(sign).set_style(style);
    }
}
