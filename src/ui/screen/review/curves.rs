//! The heights and the batteries of two flights, drawn over each other.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::app::state::Ghost;
use crate::comparison::ComparedFlight;
use crate::text;
use crate::text::{clock, figure};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve, LineWeight};
use crate::ui::widget::{put, width};

/// A reading of a flight at a time of its mission.
type Reading = fn(&ComparedFlight, Duration) -> Option<f64>;

/// The curves: name, reading, and the scale.
const CURVES: [(&str, Reading, CurveScale); 2] = [
    ("compare-height", ComparedFlight::height_m, HEIGHTS),
    (
        "compare-battery",
        ComparedFlight::battery_percent,
        BATTERIES,
    ),
];

/// Heights are drawn from the ground up, or from the lowest value if that is below it.
const HEIGHTS: CurveScale = CurveScale {
    includes: Some(0.0),
    step: 10.0,
    limits: (f64::NEG_INFINITY, f64::INFINITY),
};
/// Charges are drawn over the part that was used, so small differences are visible.
const BATTERIES: CurveScale = CurveScale {
    includes: None,
    step: 10.0,
    limits: (0.0, 100.0),
};

#[derive(Debug, Clone, Copy)]
struct CurveScale {
    /// A value that the scale always includes.
    includes: Option<f64>,
    /// Both ends are multiples of this step, and at least one step apart.
    step: f64,
    limits: (f64, f64),
}

impl CurveScale {
    fn bounds(self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let ends = values.chain(self.includes).fold(None, |ends, value| {
            let (low, high) = ends.unwrap_or((value, value));
            Some((value.min(low), value.max(high)))
        });
        let (low, high): (f64, f64) = ends.unwrap_or_default();
        let from = (low / self.step).floor() * self.step;
        let to = (high / self.step).ceil() * self.step;
        let room = if to > from { to } else { from + self.step };
        let top = room.min(self.limits.1);
        (from.min(top - self.step).max(self.limits.0), top)
    }
}

/// The colours of both flights' curves and names.
const OWN: Role = Role::Accent;
const OTHER: Role = Role::Text;

/// The width of each line in the legend, in columns.
const SAMPLE: u16 = 3;

/// Draws the charts side by side, with the curve of this flight on top of the other flight's curve.
pub(super) fn draw(ghost: &Ghost, own: &ComparedFlight, panel: Panel<'_>, buffer: &mut Buffer) {
    draw_legend(ghost, own, panel, buffer);
    let panel = panel.below(1);
    let share = panel.area.width / CURVES.len() as u16;
    for (at, (name, reading, scale)) in (0..).zip(CURVES) {
        let here = panel.columns(at * share, share.saturating_sub(2));
        let plot = FlightCurves {
            ghost,
            own,
            reading,
            scale,
        };
        let title = here.say(name);
        let inner = here.at(here.titled(&title, buffer));
        plot.draw(inner, buffer);
    }
}

/// Draws the names of both flights, each after a piece of its line.
fn draw_legend(ghost: &Ghost, own: &ComparedFlight, panel: Panel<'_>, buffer: &mut Buffer) {
    let names = [&own.name, &ghost.other.name].map(|name| format!(" {}   ", panel.text(name)));
    let mut column = 1;
    for ((name, role), weight) in names
        .iter()
        .zip([OWN, OTHER])
        .zip([LineWeight::Heavy, LineWeight::Light])
    {
        let sample = panel.columns(column, SAMPLE).upper(1);
        let values = vec![Some(0.5); curve::steps(SAMPLE, panel.look.symbols)];
        let piece = Curve {
            values: &values,
            low: 0.0,
            high: 1.0,
            style: panel.style(role),
        };
        curve::draw_line(&piece, weight, panel.look.symbols, sample.area, buffer);
        let line = Line::styled(name.as_str(), panel.style(role));
        let rest = panel.columns(
            column + SAMPLE,
            panel.area.width.saturating_sub(column + SAMPLE),
        );
        put(buffer, rest.area, 0, &line);
        column += SAMPLE + width(name) as u16;
    }
}

struct FlightCurves<'a> {
    ghost: &'a Ghost,
    own: &'a ComparedFlight,
    reading: Reading,
    scale: CurveScale,
}

impl FlightCurves<'_> {
    fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        let symbols = panel.look.symbols;
        let plot = Rect {
            height: panel.area.height.saturating_sub(1),
            ..panel.area
        };
        let steps = curve::steps(plot.width, symbols);
        let length = self.own.length.max(self.ghost.other.length);
        let times: Vec<Duration> = (0..steps)
            .map(|step| length.mul_f64(step as f64 / steps.max(1) as f64))
            .collect();
        let own: Vec<Option<f64>> = times
            .iter()
            .map(|&time| (self.reading)(self.own, time))
            .collect();
        let other: Vec<Option<f64>> = times
            .iter()
            .map(|&time| (self.reading)(&self.ghost.other, self.ghost.time(time)?))
            .collect();
        let (low, high) = self
            .scale
            .bounds(own.iter().chain(&other).flatten().copied());
        // The lines differ in weight, so that they can be told apart without colours.
        for (values, role, weight) in [
            (&other, OTHER, LineWeight::Light),
            (&own, OWN, LineWeight::Heavy),
        ] {
            let curve = Curve {
                values,
                low,
                high,
                style: panel.style(role),
            };
            curve::draw_line(&curve, weight, symbols, plot, buffer);
        }
        let last = panel.area.height.saturating_sub(1);
        let scale = text!(
            "compare-scale",
            low = figure(low, 0),
            high = figure(high, 0),
            end = clock(length)
        );
        let line = Line::styled(panel.text(&scale), panel.style(Role::Muted));
        put(buffer, panel.area, last, &line);
    }
}

#[cfg(test)]
mod tests {
    use super::{BATTERIES, HEIGHTS};

    #[test]
    fn a_chart_is_scaled_to_its_values() {
        let bounds =
            |scale: super::CurveScale, values: &[f64]| scale.bounds(values.iter().copied());
        assert_eq!(bounds(HEIGHTS, &[0.0, 43.0]), (0.0, 50.0));
        assert_eq!(bounds(HEIGHTS, &[-12.0, 3.0]), (-20.0, 10.0));
        assert_eq!(bounds(HEIGHTS, &[]), (0.0, 10.0));
        assert_eq!(bounds(BATTERIES, &[98.0, 83.5]), (80.0, 100.0));
        assert_eq!(bounds(BATTERIES, &[100.0]), (90.0, 100.0));
        assert_eq!(bounds(BATTERIES, &[0.0]), (0.0, 10.0));
    }
}
