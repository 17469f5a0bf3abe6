//! Curves: values over time in a few cells.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::config::Symbols;

/// The dots of a braille cell by column and row, from the top left.
const DOTS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
/// The braille cell without dots.
const BLANK: u32 = 0x2800;
/// Bars of one to eight eighths of a cell.
const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// A curve. The values are spread over the whole width; `None` is a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve<'a> {
    /// Values from the left, one per step: [`steps`] returns the number of steps.
    pub values: &'a [Option<f64>],
    /// The value at the bottom.
    pub low: f64,
    /// The value at the top.
    pub high: f64,
    pub style: Style,
}

/// The number of values that fit side by side.
pub fn steps(width: u16, symbols: Symbols) -> usize {
    match symbols {
        Symbols::Braille => usize::from(width) * 2,
        Symbols::Block | Symbols::Ascii => usize::from(width),
    }
}

/// Draws a curve into an area.
pub fn draw(curve: &Curve<'_>, symbols: Symbols, area: Rect, buffer: &mut Buffer) {
    match symbols {
        Symbols::Braille => draw_dots(curve, area, buffer),
        Symbols::Block => draw_bars(curve, area, buffer, bar),
        Symbols::Ascii => draw_bars(curve, area, buffer, |eighths| match eighths {
            0..=2 => '.',
            3..=5 => ':',
            _ => '#',
        }),
    }
}

impl Curve<'_> {
    /// The height of a value, in steps from 0 to `most`.
    fn level(&self, value: f64, most: u16) -> u16 {
        let span = self.high - self.low;
        // A constant curve is drawn in the middle.
        let share = if span > 0.0 {
            (value - self.low) / span
        } else {
            0.5
        };
        (share.clamp(0.0, 1.0) * f64::from(most)).round() as u16
    }
}

/// The thickness of a line, to distinguish two lines without colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineWeight {
    Light,
    Heavy,
}

/// Draws a curve as a line that does not hide other lines.
pub fn draw_line(
    curve: &Curve<'_>,
    weight: LineWeight,
    symbols: Symbols,
    area: Rect,
    buffer: &mut Buffer,
) {
    let sign = match (symbols, weight) {
        (Symbols::Braille, _) => return draw_strokes(curve, weight, area, buffer),
        (Symbols::Block | Symbols::Ascii, LineWeight::Light) => '─',
        (Symbols::Block | Symbols::Ascii, LineWeight::Heavy) => '━',
    };
    let values = curve.values.iter().enumerate().take(area.width.into());
    for (at, value) in values.filter_map(|(at, value)| Some((at, (*value)?))) {
        let row = area.height.saturating_sub(1) - curve.level(value, area.height.saturating_sub(1));
        if let Some(cell) = buffer.cell_mut((area.x + at as u16, area.y + row)) {
            cell.set_char(sign).set_style(curve.style);
        }
    }
}

/// Draws the curve as dots. Vertical strokes join neighbours, so a steep curve has no gaps.
fn draw_dots(curve: &Curve<'_>, area: Rect, buffer: &mut Buffer) {
    draw_strokes(curve, LineWeight::Light, area, buffer);
}

fn draw_strokes(curve: &Curve<'_>, weight: LineWeight, area: Rect, buffer: &mut Buffer) {
    if area.is_empty() {
        return;
    }
    let rows = area.height * 4;
    let mut before: Option<u16> = None;
    let mut cells = vec![0u32; usize::from(area.width) * usize::from(area.height)];
    for (at, value) in curve.values.iter().enumerate() {
        let Some(value) = value else {
            before = None;
            continue;
        };
        let level = curve.level(*value, rows.saturating_sub(1));
        let from = before.map_or(level, |before| match before {
            lower if lower < level => lower + 1,
            higher if higher > level => higher - 1,
            same => same,
        });
        let (low, high) = (from.min(level), from.max(level));
        let high = match weight {
            LineWeight::Light => high,
            LineWeight::Heavy => (high + 1).min(rows.saturating_sub(1)),
        };
        for level in low..=high {
            let row = usize::from(rows - 1 - level);
            let cell = row / 4 * usize::from(area.width) + at / 2;
            if let Some(cell) = cells.get_mut(cell) {
                *cell |= DOTS[at % 2][row % 4];
            }
        }
        before = Some(level);
    }
    for (at, dots) in cells.into_iter().enumerate().filter(|(_, dots)| *dots > 0) {
        let x = area.x + (at % usize::from(area.width)) as u16;
        let y = area.y + (at / usize::from(area.width)) as u16;
        let Some(cell) = buffer.cell_mut((x, y)) else {
            continue;
        };
        // The dots of another curve in the cell stay.
        let first = cell.symbol().chars().next().map_or(0, u32::from);
        let known = first.checked_sub(BLANK).filter(|dots| *dots < 0x100);
        if let Some(c) = char::from_u32(BLANK + (dots | known.unwrap_or(0))) {
            cell.set_char(c).set_style(curve.style);
        }
    }
}

fn bar(eighths: u16) -> char {
    BARS[usize::from(eighths.clamp(1, 8)) - 1]
}

/// Draws a bar per column; the smallest value stays visible.
fn draw_bars(curve: &Curve<'_>, area: Rect, buffer: &mut Buffer, bar: fn(u16) -> char) {
    for (at, value) in curve.values.iter().enumerate().take(area.width.into()) {
        let Some(value) = value else {
            continue;
        };
        let eighths = curve.level(*value, area.height * 8).max(1);
        for row in 0..area.height {
            let here = eighths.saturating_sub(row * 8).min(8);
            let place = (area.x + at as u16, area.bottom() - 1 - row);
            if here > 0
                && let Some(cell) = buffer.cell_mut(place)
            {
                cell.set_char(bar(here)).set_style(curve.style);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(values: &[f64], symbols: Symbols, width: u16, height: u16) -> Vec<String> {
        let area = Rect::new(0, 0, width, height);
        let mut buffer = Buffer::empty(area);
        let values: Vec<Option<f64>> = values.iter().map(|value| Some(*value)).collect();
        let curve = Curve {
            values: &values,
            low: 0.0,
            high: 7.0,
            style: Style::new(),
        };
        draw(&curve, symbols, area, &mut buffer);
        let row = |y| (0..width).map(move |x| (x, y));
        let symbol = |at| buffer.cell(at).expect("inside").symbol().to_owned();
        (0..height).map(|y| row(y).map(symbol).collect()).collect()
    }

    #[test]
    fn a_ramp_rises_from_the_bottom_left_to_the_top_right() {
        let ramp: Vec<f64> = (0..8).map(f64::from).collect();
        assert_eq!(drawn(&ramp, Symbols::Braille, 4, 2), ["  ⡠⠊", "⡠⠊  "]);
        assert_eq!(drawn(&ramp, Symbols::Block, 8, 1), ["▁▁▂▃▅▆▇█"]);
        assert_eq!(drawn(&ramp, Symbols::Ascii, 8, 1), ["...::###"]);
    }

    #[test]
    fn two_lines_in_a_cell_are_both_in_sight_and_differ_in_weight() {
        let area = Rect::new(0, 0, 2, 1);
        let mut buffer = Buffer::empty(area);
        for (value, weight) in [(0.0, LineWeight::Light), (2.0, LineWeight::Heavy)] {
            let curve = Curve {
                values: &[Some(value); 4],
                low: 0.0,
                high: 3.0,
                style: Style::new(),
            };
            draw_line(&curve, weight, Symbols::Braille, area, &mut buffer);
        }
        assert_eq!(buffer.cell((0, 0)).expect("inside").symbol(), "⣛");
    }

    #[test]
    fn values_beyond_the_edges_stay_inside_and_a_step_is_one_stroke() {
        assert_eq!(drawn(&[-99.0, 99.0], Symbols::Braille, 1, 1), ["⡸"]);
        assert_eq!(drawn(&[f64::NAN], Symbols::Block, 1, 1), ["▁"]);
        assert_eq!(drawn(&[1.0; 50], Symbols::Braille, 3, 1), ["⣀⣀⣀"]);
    }
}
