//! Readings over the last seconds or minutes.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::row::{filled, number};
use super::{Subject, spark};
use crate::app::state::{Channel, History, Window};
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, columns, put, upper};

/// Columns of the label, of a number, and of the unit.
const LABEL: usize = 12;
const NUMBER: usize = 7;
const UNIT: usize = 4;

/// The curve of a channel.
struct Curve {
    channel: Channel,
    /// The id of its name.
    name: &'static str,
    unit: &'static str,
    decimals: usize,
    /// The least range of the curve's axis, so that noise stays flat.
    least_span: f32,
}

const CURVES: [Curve; Channel::ALL.len()] = [
    curve(Channel::Altitude, "vehicle-altitude", "m", 1, 2.0),
    curve(Channel::Speed, "vehicle-speed", "m/s", 1, 1.0),
    curve(Channel::Climb, "vehicle-climb", "m/s", 1, 1.0),
    curve(Channel::Voltage, "vehicle-voltage", "V", 2, 0.5),
    curve(Channel::Current, "vehicle-current", "A", 1, 2.0),
    curve(Channel::Remaining, "vehicle-remaining", "%", 0, 5.0),
    curve(Channel::Throttle, "vehicle-throttle", "%", 0, 10.0),
];

const fn curve(
    channel: Channel,
    name: &'static str,
    unit: &'static str,
    decimals: usize,
    least_span: f32,
) -> Curve {
    Curve {
        channel,
        name,
        unit,
        decimals,
        least_span,
    }
}

/// Draws every channel with its present value, its curve, and its extremes within the span.
pub(super) fn draw(subject: &Subject<'_>, area: Rect, buffer: &mut Buffer) {
    let (state, look) = (subject.state, subject.look);
    let window = state.rooms().vehicle().window();
    let title = text!("vehicle-curves", seconds = window.seconds());
    let inner = Panel::new(look, area).titled(&look.text(&title), buffer);
    let numbers = 2 * (NUMBER + 1);
    let heads = format!(
        "{:>NUMBER$} {:>NUMBER$}",
        look.say("vehicle-least"),
        look.say("vehicle-most")
    );
    let right = columns(area, area.width.saturating_sub(numbers as u16), area.width);
    put(
        buffer,
        right,
        0,
        &Line::styled(format!(" {heads}"), look.style(Role::Muted)),
    );
    let rows = (inner.height / CURVES.len() as u16).max(1);
    let history = state.session().histories().of(subject.vehicle.id);
    for (at, curve) in CURVES.iter().enumerate() {
        let strip = upper(below(inner, at as u16 * rows), rows);
        draw_curve(subject, curve, window, history, strip, buffer);
    }
}

fn draw_curve(
    subject: &Subject<'_>,
    curve: &Curve,
    window: Window,
    history: Option<&History>,
    area: Rect,
    buffer: &mut Buffer,
) {
    let look = subject.look;
    let now = number(curve.channel.reading(subject.vehicle), curve.decimals);
    let line = Line::from(vec![
        Span::styled(
            filled(&look.say(curve.name), LABEL),
            look.style(Role::Muted),
        ),
        Span::raw(format!("{now:>NUMBER$} ")),
        Span::styled(format!("{:UNIT$}", curve.unit), look.style(Role::Muted)),
    ]);
    put(buffer, area, 0, &line);
    let range = history.and_then(|history| history.range(curve.channel, window));
    let left = (LABEL + NUMBER + 1 + UNIT) as u16;
    let figures = 2 * (NUMBER as u16 + 1);
    let width = area.width.saturating_sub(left + figures);
    if let (Some(history), Some((low, high))) = (history, range) {
        let readings: Vec<_> = history.readings(curve.channel, window).collect();
        let shown = low..=high.max(low + curve.least_span);
        let plot = columns(area, left, width);
        let rows = spark::rows(
            &readings,
            window.samples(),
            &shown,
            plot.as_size(),
            look.symbols,
        );
        for (row, text) in rows.into_iter().enumerate() {
            let line = Line::styled(text, look.style(Role::Accent));
            put(buffer, plot, row as u16, &line);
        }
    }
    let [least, most] = [range.map(|(low, _)| low), range.map(|(_, high)| high)]
        .map(|value| number(value, curve.decimals));
    let line = Line::raw(format!(" {least:>NUMBER$} {most:>NUMBER$}"));
    put(buffer, columns(area, left + width, area.width), 0, &line);
}
