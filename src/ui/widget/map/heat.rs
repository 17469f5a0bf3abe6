//! What the sensors have shown, as shaded cells beneath everything else.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::room::map::SampleField;
use crate::config::Symbols;
use crate::geo::{DOTS_ACROSS, DOTS_DOWN, Dot, Viewport};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::put;

/// Shades from little to much.
const SHADES: [char; 4] = ['░', '▒', '▓', '█'];
/// The same in ASCII, where digits can be read best.
const DIGITS: [char; 9] = ['1', '2', '3', '4', '5', '6', '7', '8', '9'];

pub fn draw(field: &SampleField, look: &Look, view: &Viewport, area: Rect, buffer: &mut Buffer) {
    let shades = shades(look.symbols);
    let top = field.top();
    let style = look.style(Role::Hazard);
    for (cell, mean) in means(field, view).into_iter().enumerate() {
        let Some(mean) = mean else {
            continue;
        };
        let level = (mean / top * shades.len() as f64).ceil().max(1.0) as usize;
        let shade = shades[level.min(shades.len()) - 1];
        let (column, row) = (
            cell % usize::from(view.columns),
            cell / usize::from(view.columns),
        );
        let at = (area.x + column as u16, area.y + row as u16);
        if let Some(cell) = buffer.cell_mut(at) {
            cell.set_char(shade).set_style(style);
        }
    }
}

/// Explains the shades: each with the largest value that it stands for.
pub fn draw_scale(field: &SampleField, panel: Panel<'_>, buffer: &mut Buffer) {
    let shades = shades(panel.look.symbols);
    let top = field.top();
    let name = format!("{} ", panel.text(&field.name));
    let mut spans = vec![Span::styled(name, panel.style(Role::Muted))];
    for (at, shade) in shades.iter().enumerate() {
        // Nine digits need no nine numbers.
        if shades.len() > SHADES.len() && at % 4 != 0 {
            continue;
        }
        let value = top * (at + 1) as f64 / shades.len() as f64;
        spans.push(Span::styled(shade.to_string(), panel.style(Role::Hazard)));
        spans.push(Span::styled(
            format!(" {}  ", figure(value)),
            panel.style(Role::Muted),
        ));
    }
    spans.push(Span::styled(field.unit, panel.style(Role::Muted)));
    let line = Line::from(spans);
    let width = (line.width() as u16).min(panel.area.width);
    let right = Rect {
        x: panel.area.right() - width,
        width,
        ..panel.area
    };
    put(buffer, right, 0, &line);
}

/// The shade for a share of the most; none for nothing.
pub fn shade(share: f64, symbols: Symbols) -> Option<char> {
    let shades = shades(symbols);
    let level = (share.clamp(0.0, 1.0) * shades.len() as f64).ceil() as usize;
    shades.get(level.checked_sub(1)?).copied()
}

fn shades(symbols: Symbols) -> &'static [char] {
    match symbols {
        Symbols::Ascii => &DIGITS,
        Symbols::Braille | Symbols::Block => &SHADES,
    }
}

/// At most so long that the scale stays short.
fn figure(value: f64) -> String {
    let text = match value {
        value if value >= 100.0 => format!("{value:.0}"),
        value if value >= 1.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    };
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// The mean of what was shown in each cell of the view, row by row: of the square that the middle of the cell
/// lies in, or of the squares that lie in the cell.
fn means(field: &SampleField, view: &Viewport) -> Vec<Option<f64>> {
    let (columns, rows) = (i64::from(view.columns), i64::from(view.rows));
    let mut sums = vec![(0.0, 0.0); (columns * rows) as usize];
    let half = field.side_m() / view.metres_per_dot() / 2.0;
    for (middle, mean) in field.squares() {
        let Dot { x, y } = view.dot(middle);
        let across = covered(x, half, f64::from(DOTS_ACROSS), columns);
        let down = covered(y, half, f64::from(DOTS_DOWN), rows);
        for row in down {
            for column in across.clone() {
                let cell = &mut sums[(row * columns + column) as usize];
                *cell = (cell.0 + mean, cell.1 + 1.0);
            }
        }
    }
    let mean = |(sum, count): (f64, f64)| (count > 0.0).then(|| sum / count);
    sums.into_iter().map(mean).collect()
}

/// The cells of a row whose middles lie within `half` of a dot; at least the one that the dot is in.
fn covered(dot: f64, half: f64, dots: f64, count: i64) -> std::ops::Range<i64> {
    let from = ((dot - half) / dots - 0.5).ceil();
    let to = ((dot + half) / dots - 0.5).ceil();
    let (from, to) = if from < to {
        (from, to)
    } else {
        ((dot / dots).floor(), (dot / dots).floor() + 1.0)
    };
    let within = |at: f64| at.clamp(0.0, count as f64) as i64;
    within(from)..within(to)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::app::room::map::Samples;
    use crate::geo::{GridSize, LatLon, Zoom};

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    fn field(readings: &[(f64, f64, f64)]) -> Samples {
        let mut samples = Samples::default();
        for &(north_m, east_m, value) in readings {
            samples.add("gas", "ppm", HOME.moved(north_m, east_m), value);
        }
        samples
    }

    proptest! {
        #[test]
        fn whatever_was_measured_in_view_is_shaded_where_it_was(
            north in -60.0..60.0f64, east in -100.0..100.0f64, column_m in 0.5..200.0f64,
        ) {
            let samples = field(&[(north, east, 3.0)]);
            let (_, field) = samples.fields().next().expect("a field");
            let view = Viewport::new(HOME, Zoom::fitting(column_m), GridSize::new(60, 30));
            let means = means(field, &view);
            if let Some((column, row)) = view.cell(HOME.moved(north, east)) {
                let cell = means[usize::from(row) * 60 + usize::from(column)];
                prop_assert_eq!(cell, Some(3.0));
            }
            // As many cells as a square of that size covers, and no more.
            let across = field.side_m() / view.zoom.metres_per_column() + 1.0;
            let most = across * (across / 2.0 + 1.0);
            let shaded = means.iter().flatten().count();
            prop_assert!(shaded as f64 <= most, "{shaded} of {most}");
        }
    }

    #[test]
    fn more_is_darker_and_digits_do_it_in_ascii() {
        let samples = field(&[(0.0, -20.0, 1.0), (0.0, 0.0, 5.0), (0.0, 20.0, 10.0)]);
        let (_, field) = samples.fields().next().expect("a field");
        let view = Viewport::new(HOME, Zoom::fitting(10.0), GridSize::new(7, 1));
        let shown = |symbols| {
            let area = Rect::new(0, 0, 7, 1);
            let mut buffer = Buffer::empty(area);
            let look = Look {
                symbols,
                ..Look::default()
            };
            draw(field, &look, &view, area, &mut buffer);
            let cells = buffer.content.iter();
            cells.map(ratatui::buffer::Cell::symbol).collect::<String>()
        };
        assert_eq!(shown(Symbols::Braille), " ░ ▒ █ ");
        assert_eq!(shown(Symbols::Ascii), " 1 5 9 ");
    }
}
