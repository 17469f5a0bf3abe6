//! The result at a glance: outcome, medal and score; a bar for each component; and the events of
//! the flight on a timeline, on tall screens with the height.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};

use super::event_role;
use crate::app::room::debrief::{Debrief, Summary};
use crate::debrief::{self, StripCell, strip};
use crate::scoring::Report;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::gauge::Gauge;
use crate::ui::widget::{aligned, clip, clock, put, stars, width};

const PERFECT: f64 = 1000.0;
/// The length of the score's bar, and of the bars of its components, in cells.
const SCORE_BAR: usize = 24;
const BAR: usize = 14;
/// The width of a component's name, in columns.
const NAME: usize = 12;
/// The width of the components, in columns; the flight gets the remaining columns.
const COMPONENTS: u16 = 40;
/// The number of columns before the curve of the height.
const AXIS: u16 = 6;
/// The share of its points from which a component counts as good, and the share below which it
/// counts as poor.
const GOOD: f64 = 0.8;
const POOR: f64 = 0.5;

/// Draws the summary into the whole panel.
pub(super) fn draw(debrief: &Debrief, summary: Summary, panel: Panel<'_>, buffer: &mut Buffer) {
    let report = debrief.report();
    put(buffer, panel.area, 0, &title(report, panel));
    put(buffer, panel.area, 1, &outcome(report, panel));
    let components = components(report, panel);
    if summary.is_tall {
        let below = panel.below(3);
        for (row, line) in components.iter().enumerate() {
            let place = below.columns(1, COMPONENTS - 2).area;
            put(buffer, place, row as u16, line);
        }
        let flight = below.columns(
            COMPONENTS,
            panel.area.width - COMPONENTS.min(panel.area.width),
        );
        draw_flight(debrief, flight, buffer);
    } else {
        let rows = components.len().div_ceil(2);
        for (at, line) in components.iter().enumerate() {
            let column = COMPONENTS * (at / rows) as u16;
            let place = panel.below(2).columns(1 + column, COMPONENTS - 2).area;
            put(buffer, place, (at % rows) as u16, line);
        }
        draw_times_and_strip(report, panel.below(2 + rows as u16), buffer);
    }
}

/// Draws the strip of events between its start and end times, in one row.
fn draw_times_and_strip(report: &Report, panel: Panel<'_>, buffer: &mut Buffer) {
    let muted = panel.style(Role::Muted);
    let (start, end) = (clock(Duration::ZERO), clock(end(report)));
    let room = panel.width().saturating_sub(start.len() + end.len() + 4);
    let cells = strip(report, room);
    let mut spans = vec![Span::styled(format!(" {start} "), muted)];
    spans.extend(strip_line(&cells, panel).spans);
    spans.push(Span::styled(format!(" {end}"), muted));
    put(buffer, panel.area, 0, &Line::from(spans));
}

/// The length of the flight.
fn end(report: &Report) -> Duration {
    Duration::from_secs_f64(report.sim_time_s.max(0.0))
}

/// The mission's title; at the right, if there is room, its file, revision and seed, and the simulator of the vehicles.
fn title(report: &Report, panel: Panel<'_>) -> Line<'static> {
    let title = format!(
        " {}",
        clip(&panel.text(&report.title), panel.width().saturating_sub(1))
    );
    let source = panel.text(&debrief::source(report));
    let room = panel.width().saturating_sub(width(&title) + 1);
    let mut spans = vec![Span::styled(title, panel.style(Role::Title))];
    if width(&source) + 2 <= room {
        let source = aligned(&source, room, true);
        spans.push(Span::styled(source, panel.style(Role::Muted)));
    }
    Line::from(spans)
}

/// The outcome, such as `PASSED  ★★★ GOLD  ████████·· 887 / 1000`.
fn outcome(report: &Report, panel: Panel<'_>) -> Line<'static> {
    let role = if report.passed {
        Role::Ok
    } else {
        Role::Danger
    };
    let word = format!(" {} ", panel.text(&report.outcome.title()).to_uppercase());
    let badge = panel
        .style(role)
        .add_modifier(Modifier::BOLD | Modifier::REVERSED);
    let stars = stars(report.medal);
    let medal = report.medal.map_or_else(
        || panel.say("debrief-no-medal"),
        |medal| panel.text(&medal.title()).to_uppercase(),
    );
    let gauge = Gauge {
        share: f64::from(report.score) / PERFECT,
        mark: None,
        role,
    };
    let score = format!(" {} / {PERFECT:.0}", report.score);
    let mut spans = vec![
        Span::raw(" "),
        Span::styled(word, badge),
        Span::styled(format!("  {stars} {medal}  "), panel.style(Role::Title)),
    ];
    spans.extend(gauge.spans(SCORE_BAR, panel.look));
    spans.push(Span::styled(score, panel.style(Role::Title)));
    Line::from(spans)
}

/// A bar for each component with its share of the points.
fn components(report: &Report, panel: Panel<'_>) -> Vec<Line<'static>> {
    let line = |name: String, value: f64, points: f64, most: f64| {
        let role = match value {
            value if value >= GOOD => Role::Ok,
            value if value >= POOR => Role::Warning,
            _ => Role::Danger,
        };
        let gauge = Gauge {
            share: value,
            mark: None,
            role,
        };
        let mut spans = vec![Span::raw(aligned(&name, NAME, false))];
        spans.extend(gauge.spans(BAR, panel.look));
        spans.push(Span::raw(format!(" {points:>4.0}/{most:.0}")));
        Line::from(spans)
    };
    let shown = report.components.iter().filter(|it| it.weight > 0.0);
    shown
        .map(|it| {
            let name = panel.text(&it.component.title());
            line(name, it.value, it.points, it.weight * PERFECT)
        })
        .collect()
}

/// Draws the height over time, and the events below it.
fn draw_flight(debrief: &Debrief, panel: Panel<'_>, buffer: &mut Buffer) {
    let report = debrief.report();
    let rows = panel.area.height.saturating_sub(3);
    let plot = panel.columns(AXIS, panel.area.width.saturating_sub(AXIS + 1));
    if rows == 0 || plot.area.width == 0 {
        return;
    }
    let heights = debrief.heights();
    let top_m = heights
        .iter()
        .flatten()
        .fold(0.0, |most: f64, it| most.max(*it));
    if top_m > 0.0 {
        let symbols = panel.look.symbols;
        let values = spread(heights, curve::steps(plot.area.width, symbols));
        let shown = Curve {
            values: &values,
            low: 0.0,
            high: top_m,
            style: panel.style(Role::Accent),
        };
        curve::draw(&shown, symbols, plot.upper(rows).area, buffer);
        let muted = panel.style(Role::Muted);
        let top = panel.text(&text!("debrief-height", metres = format!("{top_m:.0}")));
        put(
            buffer,
            panel.area,
            0,
            &Line::styled(aligned(&top, usize::from(AXIS) - 1, true), muted),
        );
    }
    let cells = strip(report, usize::from(plot.area.width));
    put(buffer, plot.area, rows, &strip_line(&cells, panel));
    put(buffer, plot.area, rows + 1, &times(report, plot));
}

fn strip_line(cells: &[Option<StripCell>], panel: Panel<'_>) -> Line<'static> {
    let spans = cells.iter().map(|cell| match cell {
        Some(cell) => Span::styled(
            cell.letter().to_string(),
            panel.style(event_role(cell.mark)),
        ),
        None => Span::styled("─", panel.style(Role::Border)),
    });
    spans.collect()
}

/// The times at both ends of the strip.
fn times(report: &Report, panel: Panel<'_>) -> Line<'static> {
    let start = clock(Duration::ZERO);
    let room = panel.width().saturating_sub(start.len());
    let line = format!("{start}{}", aligned(&clock(end(report)), room, true));
    Line::styled(line, panel.style(Role::Muted))
}

/// The values resampled to `steps`: the highest of each step.
fn spread(values: &[Option<f64>], steps: usize) -> Vec<Option<f64>> {
    let count = values.len();
    let highest = |step: usize| {
        let (from, to) = (step * count / steps, (step + 1) * count / steps);
        let part = values.get(from..to.max(from + 1).min(count))?;
        part.iter().flatten().copied().reduce(f64::max)
    };
    (0..steps).map(highest).collect()
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn many_values_share_a_step_and_few_are_stretched() {
        let values = [Some(1.0), Some(5.0), None, Some(2.0)];
        assert_eq!(spread(&values, 2), [Some(5.0), Some(2.0)]);
        assert_eq!(
            spread(&values[..2], 4),
            [Some(1.0), Some(1.0), Some(5.0), Some(5.0)]
        );
        assert_eq!(spread(&[], 2), [None, None]);
    }
}
