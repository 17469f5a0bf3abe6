//! Power by speed, or hover time by payload, as a curve.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::workshop::View;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve, steps};
use crate::ui::widget::{aligned, below, columns, put, upper, wrap};
use crate::workshop::{GOOD_THRUST, LEAST_THRUST};

/// The width of the figures beside the curve, in columns.
const LABELS: u16 = 7;
/// The minimum number of rows of the curve.
const LEAST: u16 = 3;

/// Draws the chosen curve.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().workshop();
    let is_payload = room.view() == View::Payload;
    let title = if is_payload {
        "bench-payload"
    } else {
        "workshop-polar"
    };
    let inner = panel.titled(&panel.say(title), buffer);
    let points: Vec<(f64, f64)> = if is_payload {
        let minutes = room.bench().endurance().iter();
        minutes.map(|(kg, seconds)| (*kg, seconds / 60.0)).collect()
    } else {
        room.bench().polar().to_vec()
    };
    let about = about(state, is_payload);
    let words = wrap(
        &panel.text(&about),
        usize::from(inner.width.saturating_sub(1)),
    );
    let below_curve = words.len() as u16 + 1;
    let units = if is_payload {
        ("kg", "min")
    } else {
        ("m/s", "W")
    };
    let plot = upper(inner, inner.height.saturating_sub(below_curve));
    let rest = if points.len() > 1 && plot.height >= LEAST {
        draw_curve(&points, units.1, panel.at(plot), buffer);
        below(inner, plot.height)
    } else {
        inner
    };
    if points.len() > 1 && plot.height >= LEAST {
        draw_axis(&points, units.0, panel.at(rest), buffer);
    }
    let rest = below(rest, 1);
    for (row, line) in words.into_iter().enumerate() {
        let line = Line::styled(format!(" {line}"), panel.style(Role::Muted));
        put(buffer, rest, row as u16, &line);
    }
}

fn about(state: &State, is_payload: bool) -> Text {
    let Some(figures) = &state.rooms().workshop().bench().sheet().figures else {
        return text!("bench-no-curve");
    };
    if is_payload {
        text!(
            "bench-payload-about",
            spare = format!("{:.2}", figures.spare_kg),
            least = LEAST_THRUST.to_string(),
            good = GOOD_THRUST.to_string()
        )
    } else {
        text!(
            "bench-polar-about",
            longest = format!("{:.1}", figures.endurance_speed_m_s),
            farthest = format!("{:.1}", figures.range_speed_m_s)
        )
    }
}

fn draw_curve(points: &[(f64, f64)], unit: &str, panel: Panel<'_>, buffer: &mut Buffer) {
    let high = points.iter().map(|point| point.1).fold(0.0, f64::max);
    for (row, value) in [(0, high), (panel.area.height - 1, 0.0)] {
        let label = aligned(&format!("{value:.0} {unit}"), usize::from(LABELS) - 1, true);
        put(
            buffer,
            panel.area,
            row,
            &Line::styled(label, panel.style(Role::Muted)),
        );
    }
    let place = columns(panel.area, LABELS, panel.area.width.saturating_sub(LABELS));
    let values: Vec<Option<f64>> = spread(points, steps(place.width, panel.look.symbols));
    let curve = Curve {
        values: &values,
        low: 0.0,
        high,
        style: panel.style(Role::Accent),
    };
    curve::draw(&curve, panel.look.symbols, place, buffer);
}

fn draw_axis(points: &[(f64, f64)], unit: &str, panel: Panel<'_>, buffer: &mut Buffer) {
    let last = points.last().map_or(0.0, |point| point.0);
    let end = format!("{last:.1} {unit}");
    let room = panel.area.width.saturating_sub(LABELS + 1);
    let end = aligned(&end, usize::from(room), true);
    let line = format!("{}0{end}", " ".repeat(usize::from(LABELS)));
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(line, panel.style(Role::Muted)),
    );
}

/// A curve's values at `count` equally spaced places, by linear interpolation.
fn spread(points: &[(f64, f64)], count: usize) -> Vec<Option<f64>> {
    let (first, last) = match (points.first(), points.last()) {
        (Some(first), Some(last)) => (first.0, last.0),
        _ => return Vec::new(),
    };
    let step = (last - first) / (count.max(2) - 1) as f64;
    (0..count)
        .map(|at| {
            let x = first + step * at as f64;
            let next = points.partition_point(|point| point.0 < x);
            let (after, before) = (points.get(next), points.get(next.saturating_sub(1)));
            match (before, after.or(before)) {
                (Some(a), Some(b)) if b.0 > a.0 => {
                    Some(a.1 + (b.1 - a.1) * ((x - a.0) / (b.0 - a.0)).clamp(0.0, 1.0))
                }
                (_, b) => b.map(|b| b.1),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_spread_along_straight_lines() {
        let points = [(0.0, 10.0), (1.0, 20.0), (3.0, 0.0)];
        let spread = spread(&points, 7);
        let wanted = [10.0, 15.0, 20.0, 15.0, 10.0, 5.0, 0.0];
        for (value, wanted) in spread.iter().zip(wanted) {
            assert!((value.expect("no gap") - wanted).abs() < 1e-9, "{value:?}");
        }
    }
}
