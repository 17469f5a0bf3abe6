//! The heights and the batteries of two flights, one over the other.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::Ghost;
use crate::comparison::ComparedFlight;
use crate::text;
use crate::text::{clock, figure};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::put;

/// A reading of a flight at a time of its mission.
type Reading = fn(&ComparedFlight, Duration) -> Option<f64>;

/// The curves: name, reading, and the minimum value at the top of the scale.
const CURVES: [(&str, Reading, f64); 2] = [
    ("compare-height", ComparedFlight::height_m, 1.0),
    ("compare-battery", ComparedFlight::battery_percent, 100.0),
];

/// The colours of both flights' curves and names.
const OWN: Role = Role::Accent;
const OTHER: Role = Role::Muted;

/// Steps of a dash of the other flight's curve, with the gap after it.
const DASH: usize = 4;
/// The signs of both curves in the legend.
const LINES: [&str; 2] = ["--", "- -"];

/// Draws the curves beside each other, that of this flight over that of the other one.
pub(super) fn draw(ghost: &Ghost, own: &ComparedFlight, panel: Panel<'_>, buffer: &mut Buffer) {
    put(buffer, panel.area, 0, &legend(ghost, panel));
    let panel = panel.below(1);
    let width = panel.area.width / CURVES.len() as u16;
    for (at, (name, reading, least_top)) in (0..).zip(CURVES) {
        let here = panel.columns(at * width, width.saturating_sub(2));
        let plot = FlightCurves {
            ghost,
            own,
            reading,
            least_top,
        };
        let title = here.say(name);
        let inner = here.at(here.titled(&title, buffer));
        plot.draw(inner, buffer);
    }
}

/// The lines of both flights, and their names.
fn legend(ghost: &Ghost, panel: Panel<'_>) -> Line<'static> {
    let [own, other] = LINES;
    Line::from(vec![
        Span::styled(
            format!(" {own} {}   ", panel.say("compare-own")),
            panel.style(OWN),
        ),
        Span::styled(
            format!("{other} {}", panel.text(&ghost.other.name)),
            panel.style(OTHER),
        ),
    ])
}

struct FlightCurves<'a> {
    ghost: &'a Ghost,
    own: &'a ComparedFlight,
    reading: Reading,
    least_top: f64,
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
        let values = own.iter().chain(&other).flatten().copied();
        let high = values.fold(self.least_top, f64::max);
        // Dashed, so that the curves differ without colours.
        let dashed: Vec<Option<f64>> = (0..)
            .zip(&other)
            .map(|(step, value)| value.filter(|_| step % DASH < DASH / 2))
            .collect();
        for (values, role) in [(&dashed, OTHER), (&own, OWN)] {
            let curve = Curve {
                values,
                low: 0.0,
                high,
                style: panel.style(role),
            };
            curve::draw(&curve, symbols, plot, buffer);
        }
        let last = panel.area.height.saturating_sub(1);
        let scale = text!("compare-scale", high = figure(high, 0), end = clock(length));
        let line = Line::styled(panel.text(&scale), panel.style(Role::Muted));
        put(buffer, panel.area, last, &line);
    }
}
