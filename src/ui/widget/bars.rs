//! A bar chart with named horizontal lines, to compare the values with.

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::Line;

use super::{aligned, columns, put, width};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// A cell filled by zero to eight eighths.
const EIGHTHS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// The widths of a bar, and of a bar with the gap after it, in columns; the label fits into the
/// second.
const BAR: usize = 4;
const STEP: usize = 6;

#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    pub value: f64,
    /// The bar's label: at most five letters.
    pub label: String,
    pub style: Style,
}

#[derive(Debug, Clone, Copy)]
pub struct Bars<'a> {
    /// The bars from the left; if not all fit, the last ones are shown.
    pub values: &'a [Bar],
    /// Lines across the chart: their value and their name.
    pub lines: &'a [(f64, String)],
    /// The value at the top.
    pub most: f64,
}

/// Draws the chart: names of lines at the left, labels in the last row.
pub fn draw(chart: &Bars<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let rows = panel.area.height.saturating_sub(1);
    if rows == 0 {
        return;
    }
    let longest = chart.lines.iter().map(|(_, name)| width(name)).max();
    let names = longest.map_or(0, |columns| columns + 1);
    let plot = columns(panel.area, names as u16, panel.area.width);
    for (value, name) in chart.lines {
        let row = chart.row(*value, rows);
        let muted = panel.style(Role::Muted);
        let name = Line::styled(aligned(name, names, false), muted);
        put(buffer, panel.area, row, &name);
        let rule = "┄".repeat(usize::from(plot.width));
        put(buffer, plot, row, &Line::styled(rule, muted));
    }
    let fits = usize::from(plot.width) / STEP;
    let hidden = chart.values.len().saturating_sub(fits);
    for (at, bar) in chart.values.iter().skip(hidden).enumerate() {
        let place = columns(plot, (at * STEP) as u16, STEP as u16);
        let eighths = chart.eighths(bar.value, rows);
        for row in 0..rows {
            let here = eighths.saturating_sub(usize::from(row) * 8).min(8);
            if here > 0 {
                let text = EIGHTHS[here].to_string().repeat(BAR);
                let line = Line::styled(text, bar.style);
                put(buffer, place, rows - 1 - row, &line);
            }
        }
        put(buffer, place, rows, &Line::raw(bar.label.clone()));
    }
}

impl Bars<'_> {
    /// The height of a value in eighths of a row; at least one, so every bar is visible.
    fn eighths(&self, value: f64, rows: u16) -> usize {
        let share = (value / self.most).clamp(0.0, 1.0);
        ((share * f64::from(rows) * 8.0).round() as usize).max(1)
    }

    /// The row of a value, from the top.
    fn row(&self, value: f64, rows: u16) -> u16 {
        let eighths = self.eighths(value, rows).saturating_sub(1);
        rows - 1 - (eighths / 8) as u16
    }
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;

    use super::*;
    use crate::ui::look::Look;

    fn drawn(values: &[f64], lines: &[(f64, String)], width: u16) -> Vec<String> {
        let bars: Vec<Bar> = values
            .iter()
            .map(|value| Bar {
                value: *value,
                label: format!("{value:.0}"),
                style: Style::new(),
            })
            .collect();
        let area = Rect::new(0, 0, width, 5);
        let mut buffer = Buffer::empty(area);
        let chart = Bars {
            values: &bars,
            lines,
            most: 1000.0,
        };
        draw(&chart, Panel::new(&Look::default(), area), &mut buffer);
        let rows = buffer.content.chunks(usize::from(width));
        let line = |row: &[ratatui::buffer::Cell]| -> String {
            let cells = row.iter().map(ratatui::buffer::Cell::symbol);
            cells.collect::<String>().trim_end().to_owned()
        };
        rows.map(line).collect()
    }

    #[test]
    fn bars_stand_on_their_points_and_lines_run_between_them() {
        let lines = [(700.0, "silver".to_owned())];
        assert_eq!(
            drawn(&[250.0, 1000.0], &lines, 21),
            [
                "             ████",
                "silver ┄┄┄┄┄┄████┄┄┄┄",
                "             ████",
                "       ████  ████",
                "       250   1000"
            ]
        );
    }

    #[test]
    fn the_newest_are_shown_where_not_all_fit_and_nothing_is_still_a_bar() {
        let rows = drawn(&[900.0, 100.0, 0.0], &[], 12);
        assert_eq!(rows[3], "▃▃▃▃  ▁▁▁▁");
        assert_eq!(rows[4], "100   0");
    }
}
