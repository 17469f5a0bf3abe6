//! The sensors' readings, as shaded cells below everything but the searched ground.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{labels, squares};
use crate::app::room::map::SampleField;
use crate::config::Symbols;
use crate::geo::Viewport;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// Shades in ascending order.
const SHADES: [char; 4] = ['░', '▒', '▓', '█'];
/// The shades in ASCII: digits.
const DIGITS: [char; 9] = ['1', '2', '3', '4', '5', '6', '7', '8', '9'];
/// The maximum number of decimals needed to distinguish values.
const MOST_DECIMALS: usize = 4;

pub fn draw(field: &SampleField, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
    let shades = shades(panel.look.symbols);
    let top = field.top();
    let style = panel.look.fill(Role::Hazard);
    for (cell, mean) in means(field, view).into_iter().enumerate() {
        let Some(mean) = mean else {
            continue;
        };
        let level = (mean / top * shades.len() as f64).ceil().max(1.0) as usize;
        let shade = shades[level.min(shades.len()) - 1];
        let columns = usize::from(view.columns);
        let cell = ((cell % columns) as u16, (cell / columns) as u16);
        squares::fill(cell, shade, style, panel, buffer);
    }
}

/// Draws the shades, each with the largest value that it represents.
pub fn draw_scale(field: &SampleField, panel: Panel<'_>, buffer: &mut Buffer) {
    let shades = shades(panel.look.symbols);
    let top = field.top();
    let name = format!(" {}, {} ", panel.text(&field.name), field.unit);
    // With nine digits as shades, only some get a number; on a narrow map, even fewer.
    let least = if shades.len() > SHADES.len() { 4 } else { 1 };
    let steps = (least..=shades.len()).map(|step| {
        let mut spans = vec![Span::styled(name.clone(), panel.style(Role::Muted))];
        spans.extend(scale_spans(shades, step, top, panel));
        Line::from(spans)
    });
    let mut fitting = steps.filter(|line| line.width() <= panel.width());
    let whole = || Line::styled(name.clone(), panel.style(Role::Muted));
    let line = fitting.next().unwrap_or_else(whole);
    labels::stamp_right(&line, panel, buffer);
}

/// Every `step`-th shade from the densest one down, each with its value.
fn scale_spans(shades: &[char], step: usize, top: f64, panel: Panel<'_>) -> Vec<Span<'static>> {
    let mut shown: Vec<(char, f64)> = (1..=shades.len())
        .rev()
        .step_by(step)
        .map(|at| (shades[at - 1], top * at as f64 / shades.len() as f64))
        .collect();
    shown.reverse();
    let values: Vec<f64> = shown.iter().map(|(_, value)| *value).collect();
    let both = shown.iter().zip(figures(&values));
    both.flat_map(|((shade, _), figure)| {
        [
            Span::styled(shade.to_string(), panel.look.fill(Role::Hazard)),
            Span::styled(
                format!("{}{figure}  ", between(panel.look.symbols)),
                panel.style(Role::Muted),
            ),
        ]
    })
    .collect()
}

/// The shade for a share of the maximum; `None` for zero.
pub fn shade(share: f64, symbols: Symbols) -> Option<char> {
    let shades = shades(symbols);
    let level = (share.clamp(0.0, 1.0) * shades.len() as f64).ceil() as usize;
    shades.get(level.checked_sub(1)?).copied()
}

/// The separator between a shade and its value: a digit next to a value would read as part of it.
fn between(symbols: Symbols) -> char {
    match symbols {
        Symbols::Ascii => '=',
        Symbols::Braille | Symbols::Block => ' ',
    }
}

/// The shades with their shares of the maximum, in percent; a selection if there are many.
pub fn shares(symbols: Symbols) -> String {
    let shades = shades(symbols);
    let step = shades.len().div_ceil(SHADES.len());
    let shown = shades.iter().enumerate().skip(step - 1).step_by(step);
    let share = |(at, shade): (usize, &char)| {
        let percent = (at + 1) * 100 / shades.len();
        format!("{shade}{}{percent}", between(symbols))
    };
    shown.map(share).collect::<Vec<_>>().join(" ")
}

fn shades(symbols: Symbols) -> &'static [char] {
    match symbols {
        Symbols::Ascii => &DIGITS,
        Symbols::Braille | Symbols::Block => &SHADES,
    }
}

/// Ascending values, with the fewest decimals that distinguish them.
fn figures(values: &[f64]) -> Vec<String> {
    let least = match values.last() {
        Some(most) if *most >= 100.0 => 0,
        Some(most) if *most >= 1.0 => 1,
        _ => 2,
    };
    let with = |decimals: usize| -> Vec<String> {
        let text = |value: &f64| format!("{value:.decimals$}");
        values.iter().map(text).collect()
    };
    let differ = |texts: &[String]| texts.windows(2).all(|pair| pair[0] != pair[1]);
    let all = (least..MOST_DECIMALS).map(with);
    let mut fitting = all.filter(|texts| differ(texts));
    fitting.next().unwrap_or_else(|| with(MOST_DECIMALS))
}

/// The mean reading in each cell of the view, row by row: of the square at the cell's centre, or of the squares inside
/// the cell.
fn means(field: &SampleField, view: &Viewport) -> Vec<Option<f64>> {
    let (columns, rows) = (usize::from(view.columns), usize::from(view.rows));
    let mut sums = vec![(0.0, 0.0); columns * rows];
    for (middle, mean) in field.squares() {
        for (column, row) in squares::cells(view, middle, field.side_m()) {
            let cell = &mut sums[usize::from(row) * columns + usize::from(column)];
            *cell = (cell.0 + mean, cell.1 + 1.0);
        }
    }
    let mean = |(sum, count): (f64, f64)| (count > 0.0).then(|| sum / count);
    sums.into_iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::layout::Rect;

    use super::*;
    use crate::app::room::map::Samples;
    use crate::geo::{GridSize, LatLon, Zoom};
    use crate::ui::look::Look;

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    fn field(readings: &[(f64, f64, f64)]) -> Samples {
        let mut samples = Samples::default();
        for &(north_m, east_m, value) in readings {
            samples.add("gas", "ppm", HOME.moved(north_m, east_m), value);
        }
        samples
    }

    #[test]
    fn no_two_figures_of_a_scale_are_equal() {
        assert_eq!(
            figures(&[0.01, 0.02, 0.03, 0.04]),
            ["0.01", "0.02", "0.03", "0.04"]
        );
        assert_eq!(
            figures(&[0.005, 0.01, 0.015, 0.02]),
            ["0.005", "0.010", "0.015", "0.020"]
        );
        assert_eq!(
            figures(&[2.5, 5.0, 7.5, 10.0]),
            ["2.5", "5.0", "7.5", "10.0"]
        );
        assert_eq!(
            figures(&[50.0, 100.0, 150.0, 200.0]),
            ["50", "100", "150", "200"]
        );
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
            // A square of that size covers at most this many cells.
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
            draw(field, &view, Panel::new(&look, area), &mut buffer);
            let cells = buffer.content.iter();
            cells.map(ratatui::buffer::Cell::symbol).collect::<String>()
        };
        assert_eq!(shown(Symbols::Braille), " ░ ▒ █ ");
        assert_eq!(shown(Symbols::Ascii), " 1 5 9 ");
    }
}
