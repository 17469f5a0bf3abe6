//! Power by speed, or hover or driving time by payload, as a curve.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::workshop::{Candidate, Curves, Pane, View, Workshop};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve, steps};
use crate::ui::widget::{aligned, below, columns, put, upper, wrap};
use crate::workshop::{DesignKind, GOOD_THRUST, LEAST_THRUST, Performance, Sheet};

/// The minimum width of the figures beside the curve, in columns.
const LABELS: u16 = 7;
/// The minimum number of rows of the curve.
const LEAST: u16 = 3;

/// The points of a curve: with the marked part of the list, or else of the design.
struct Chart<'a> {
    room: &'a Workshop,
    points: Vec<(f64, f64)>,
    is_marked: bool,
}

impl<'a> Chart<'a> {
    fn new(room: &'a Workshop) -> Self {
        let points = |curves: &Curves| match room.view() {
            View::Payload => {
                let minutes = curves.endurance.iter();
                minutes.map(|(kg, seconds)| (*kg, seconds / 60.0)).collect()
            }
            View::Figures | View::Polar | View::Mission => curves.polar.clone(),
        };
        let bench = room.bench();
        let marked = bench.marked_curves();
        let marked = marked.filter(|_| room.pane() == Pane::Parts).map(points);
        let marked = marked.filter(|it| it.len() > 1);
        Self {
            room,
            is_marked: marked.is_some(),
            points: marked.unwrap_or_else(|| points(bench.curves())),
        }
    }

    fn is_payload(&self) -> bool {
        self.room.view() == View::Payload
    }

    fn title(&self) -> &'static str {
        match (self.is_payload(), self.kind()) {
            (false, _) => "workshop-polar",
            (true, DesignKind::Drone) => "bench-payload",
            (true, DesignKind::Robot | DesignKind::Boat) => "bench-drive-payload",
        }
    }

    /// The kind of vehicle whose curve this is: with the marked part, or as built.
    fn kind(&self) -> DesignKind {
        let marked = self.marked_part().filter(|_| self.is_marked);
        let built = self.room.bench().sheet();
        marked.map_or(built, |candidate| &candidate.sheet).kind
    }

    /// The units of both axes.
    fn units(&self) -> [&'static str; 2] {
        if self.is_payload() {
            ["kg", "min"]
        } else {
            ["m/s", "W"]
        }
    }

    /// The ends of both axes, which begin at 0.
    fn ends(&self) -> [f64; 2] {
        let end =
            |of: fn((f64, f64)) -> f64| self.points.iter().copied().map(of).fold(0.0, f64::max);
        [end(|point| point.0), end(|point| point.1)]
    }

    /// A value on the vertical axis.
    fn label(&self, value: f64) -> String {
        format!("{value:.0} {}", self.units()[1])
    }

    /// The width of the figures beside the curve, in columns.
    fn labels(&self) -> u16 {
        let [_, high] = self.ends();
        LABELS.max(self.label(high).len() as u16 + 1)
    }

    fn is_drawn(&self) -> bool {
        self.points.len() > 1
    }

    /// The part under the cursor in the list of parts.
    fn marked_part(&self) -> Option<&'a Candidate> {
        let candidate = self.room.bench().candidate();
        candidate.filter(|_| self.room.pane() == Pane::Parts)
    }

    /// What the curve shows, and of which design: with the marked part, or as built.
    fn about(&self) -> Text {
        let built = self.room.bench().sheet();
        let Some(candidate) = self.marked_part() else {
            return self.figures(built);
        };
        let part = candidate.part.name();
        if let Some(reason) = &candidate.misfit {
            let about = self.figures(built);
            return text!(
                "bench-curve-misfit",
                about = about,
                marked = part,
                reason = reason
            );
        }
        if self.is_marked {
            let about = self.figures(&candidate.sheet);
            return text!("bench-curve-marked", marked = part, about = about);
        }
        text!("bench-curve-built", about = self.figures(built))
    }

    /// The figures that belong to a curve, or why there is none.
    fn figures(&self, sheet: &Sheet) -> Text {
        match (&sheet.performance, self.is_payload()) {
            (None, _) => match sheet.kind {
                DesignKind::Drone => text!("bench-no-curve"),
                DesignKind::Robot => text!("bench-no-robot-curve"),
                DesignKind::Boat => text!("bench-no-boat-curve"),
            },
            (Some(Performance::Flight(figures)), true) => text!(
                "bench-payload-about",
                spare = format!("{:.2}", figures.spare_kg),
                least = LEAST_THRUST.to_string(),
                good = GOOD_THRUST.to_string()
            ),
            (Some(Performance::Flight(figures)), false) => text!(
                "bench-polar-about",
                longest = format!("{:.1}", figures.endurance_speed_m_s),
                farthest = format!("{:.1}", figures.range_speed_m_s)
            ),
            (Some(Performance::Drive(figures)), true) if figures.spare_kg < 0.0 => text!(
                "bench-drive-overloaded",
                over = format!("{:.1}", -figures.spare_kg),
                cruise = format!("{:.1}", figures.cruise_speed_m_s)
            ),
            (Some(Performance::Drive(figures)), true) => text!(
                "bench-drive-payload-about",
                spare = format!("{:.1}", figures.spare_kg),
                cruise = format!("{:.1}", figures.cruise_speed_m_s)
            ),
            (Some(Performance::Drive(figures)), false) => text!(
                "bench-drive-polar-about",
                cruise = format!("{:.1}", figures.cruise_speed_m_s),
                top = format!("{:.1}", figures.top_speed_m_s)
            ),
        }
    }
}

/// Draws the chosen curve.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let chart = Chart::new(state.rooms().workshop());
    let inner = panel.titled(&panel.say(chart.title()), buffer);
    let words = wrap(
        &panel.text(&chart.about()),
        usize::from(inner.width.saturating_sub(1)),
    );
    let below_curve = words.len() as u16 + 1;
    let plot = upper(inner, inner.height.saturating_sub(below_curve));
    let mut rest = inner;
    if chart.is_drawn() && plot.height >= LEAST {
        draw_curve(&chart, panel.at(plot), buffer);
        rest = below(inner, plot.height);
        draw_axis(&chart, panel.at(rest), buffer);
    }
    let rest = below(rest, 1);
    for (row, line) in words.into_iter().enumerate() {
        let line = Line::styled(format!(" {line}"), panel.style(Role::Muted));
        put(buffer, rest, row as u16, &line);
    }
}

fn draw_curve(chart: &Chart<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let ([last, high], labels) = (chart.ends(), chart.labels());
    for (row, value) in [(0, high), (panel.area.height - 1, 0.0)] {
        let label = aligned(&chart.label(value), usize::from(labels) - 1, true);
        put(
            buffer,
            panel.area,
            row,
            &Line::styled(label, panel.style(Role::Muted)),
        );
    }
    let place = columns(panel.area, labels, panel.area.width.saturating_sub(labels));
    let symbols = panel.look.symbols;
    let values = spread(&chart.points, last, steps(place.width, symbols));
    let curve = Curve {
        values: &values,
        low: 0.0,
        high,
        style: panel.style(Role::Accent),
    };
    curve::draw(&curve, symbols, place, buffer);
}

fn draw_axis(chart: &Chart<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let ([last, _], [unit, _]) = (chart.ends(), chart.units());
    let labels = chart.labels();
    let end = format!("{last:.1} {unit}");
    let room = panel.area.width.saturating_sub(labels + 1);
    let end = aligned(&end, usize::from(room), true);
    let line = format!("{}0{end}", " ".repeat(usize::from(labels)));
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(line, panel.style(Role::Muted)),
    );
}

/// A curve's values at `count` equally spaced places from 0 to `last`, by linear interpolation; gaps beyond its ends.
fn spread(points: &[(f64, f64)], last: f64, count: usize) -> Vec<Option<f64>> {
    let Some(end) = points.last().map(|point| point.0) else {
        return vec![None; count];
    };
    let step = last / (count.max(2) - 1) as f64;
    let value = |at: usize| {
        let x = step * at as f64;
        // Half a step of tolerance, so that the curve reaches its end.
        if x > end + step / 2.0 {
            return None;
        }
        let next = points.partition_point(|point| point.0 < x);
        let (after, before) = (points.get(next), points.get(next.saturating_sub(1)));
        match (before, after.or(before)) {
            (Some(a), Some(b)) if b.0 > a.0 => {
                Some(a.1 + (b.1 - a.1) * ((x - a.0) / (b.0 - a.0)).clamp(0.0, 1.0))
            }
            (_, b) => b.map(|b| b.1),
        }
    };
    (0..count).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_spread_along_straight_lines() {
        let points = [(0.0, 10.0), (1.0, 20.0), (3.0, 0.0)];
        let spread = spread(&points, 3.0, 7);
        let wanted = [10.0, 15.0, 20.0, 15.0, 10.0, 5.0, 0.0];
        for (value, wanted) in spread.iter().zip(wanted) {
            assert!((value.expect("no gap") - wanted).abs() < 1e-9, "{value:?}");
        }
        let longer = super::spread(&points, 6.0, 7);
        assert_eq!(longer[4..], [None; 3], "nothing beyond its end");
    }
}
