//! Readings over the last seconds or minutes.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use super::row::{filled, number};
use super::spark::{self, Merge, Spark};
use crate::app::state::{Channel, ReplayView};
use crate::dataflash::{LogChannel, LogCurves};
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, columns, put, upper};

/// The widths of the label, of a number, and of the unit, in columns.
const LABEL: usize = 12;
const NUMBER: usize = 7;
const UNIT: usize = 4;

/// The display of a channel's curve.
#[derive(Clone, Copy)]
struct Axis {
    /// The id of its name.
    name: &'static str,
    unit: &'static str,
    decimals: usize,
    /// The minimum range of the curve's axis, so that noise looks flat.
    least_span: f32,
}

const fn axis(name: &'static str, unit: &'static str, decimals: usize, least_span: f32) -> Axis {
    Axis {
        name,
        unit,
        decimals,
        least_span,
    }
}

impl Axis {
    fn of(channel: Channel) -> Self {
        match channel {
            Channel::Altitude => axis("vehicle-altitude", "m", 1, 2.0),
            Channel::Speed => axis("vehicle-speed", "m/s", 1, 1.0),
            Channel::Climb => axis("vehicle-climb", "m/s", 1, 1.0),
            Channel::Voltage => axis("vehicle-voltage", "V", 2, 0.5),
            Channel::Current => axis("vehicle-current", "A", 1, 2.0),
            Channel::Remaining => axis("vehicle-remaining", "%", 0, 5.0),
            Channel::Throttle => axis("vehicle-throttle", "%", 0, 10.0),
        }
    }

    fn of_log(channel: LogChannel) -> Self {
        match channel {
            LogChannel::Vibration => axis("vehicle-log-vibration", "m/s²", 1, 5.0),
            LogChannel::Estimator => axis("vehicle-log-estimator", "", 2, 1.0),
            LogChannel::Voltage => axis("vehicle-log-voltage", "V", 2, 0.5),
            LogChannel::Current => axis("vehicle-log-current", "A", 1, 2.0),
        }
    }
}

/// One curve, with the reading shown beside it.
struct LabelledCurve {
    axis: Axis,
    now: Option<f32>,
    /// The readings up to now, oldest first, one per sample.
    readings: Vec<Option<f32>>,
    /// The number of samples that the whole span holds.
    samples: usize,
    merge: Merge,
}

impl LabelledCurve {
    /// The extremes of the curve, including the current value: the last sample may be older. `None` without a curve.
    fn range(&self) -> Option<(f32, f32)> {
        let is_finite = |value: &f32| value.is_finite();
        let sampled = self.readings.iter().copied().flatten().filter(is_finite);
        let now = self.now.filter(is_finite);
        let known = sampled.clone().chain(sampled.clone().next().and(now));
        known.fold(None, |range, value| match range {
            None => Some((value, value)),
            Some((low, high)) => Some((value.min(low), value.max(high))),
        })
    }
}

/// The height of all curves with this many rows each and the title, in rows.
pub(super) fn height(subject: &VehicleSubject<'_>, rows: u16) -> u16 {
    let of_log = log(subject).map_or(0, |(_, log)| log.channels().count());
    rows * (Channel::ALL.len() + of_log) as u16 + 1
}

/// In a replay, the log that was joined to the recording for this vehicle.
fn log<'a>(subject: &VehicleSubject<'a>) -> Option<(&'a ReplayView, &'a LogCurves)> {
    let replay = subject.state.replay()?;
    Some((replay, replay.log_curves.get(&subject.vehicle.id)?))
}

/// The curves of the telemetry, then those of the vehicle's log.
fn curves(subject: &VehicleSubject<'_>) -> Vec<LabelledCurve> {
    let state = subject.state;
    let window = state.rooms().vehicle().window();
    let history = state.session().histories().of(subject.vehicle.id);
    let heard = Channel::ALL.map(|channel| LabelledCurve {
        axis: Axis::of(channel),
        now: channel.reading(subject.vehicle),
        readings: history.map_or_else(Vec::new, |it| it.readings(channel, window).collect()),
        samples: window.samples(),
        merge: Merge::Mean,
    });
    let logged = log(subject).into_iter().flat_map(|(replay, log)| {
        log.channels().map(move |channel| {
            let readings = log.readings(channel, replay.position.at, window.seconds());
            LabelledCurve {
                axis: Axis::of_log(channel),
                now: readings.last().copied().flatten(),
                readings,
                samples: usize::from(window.seconds()),
                merge: if channel.is_low_worse() {
                    Merge::Least
                } else {
                    Merge::Most
                },
            }
        })
    });
    heard.into_iter().chain(logged).collect()
}

/// Draws every channel with its current value, its curve, and its extremes within the span.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
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
    let curves = curves(subject);
    let rows = (inner.height / curves.len() as u16).max(1);
    for (at, curve) in curves.iter().enumerate() {
        let strip = upper(below(inner, at as u16 * rows), rows);
        draw_curve(curve, Panel::new(look, strip), buffer);
    }
}

fn draw_curve(curve: &LabelledCurve, panel: Panel<'_>, buffer: &mut Buffer) {
    let (look, area, axis) = (panel.look, panel.area, curve.axis);
    let now = number(curve.now, axis.decimals);
    let line = Line::from(vec![
        Span::styled(filled(&look.say(axis.name), LABEL), look.style(Role::Muted)),
        Span::raw(format!("{now:>NUMBER$} ")),
        Span::styled(format!("{:UNIT$}", axis.unit), look.style(Role::Muted)),
    ]);
    put(buffer, area, 0, &line);
    let range = curve.range();
    let left = (LABEL + NUMBER + 1 + UNIT) as u16;
    let figures = 2 * (NUMBER as u16 + 1);
    let width = area.width.saturating_sub(left + figures);
    if let Some((low, high)) = range {
        let shown = low..=high.max(low + axis.least_span);
        let plot = columns(area, left, width);
        let spark = Spark {
            readings: &curve.readings,
            samples: curve.samples,
            range: shown,
            merge: curve.merge,
        };
        let rows = spark::rows(&spark, plot.as_size(), look.symbols);
        for (row, text) in rows.into_iter().enumerate() {
            let line = Line::styled(text, look.style(Role::Accent));
            put(buffer, plot, row as u16, &line);
        }
    }
    let [least, most] = [range.map(|(low, _)| low), range.map(|(_, high)| high)]
        .map(|value| number(value, axis.decimals));
    let line = Line::raw(format!(" {least:>NUMBER$} {most:>NUMBER$}"));
    put(buffer, columns(area, left + width, area.width), 0, &line);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_current_value_is_within_the_extremes() {
        let curve = |now, readings: &[f32]| LabelledCurve {
            axis: Axis::of(Channel::Voltage),
            now,
            readings: readings.iter().copied().map(Some).collect(),
            samples: 30,
            merge: Merge::Mean,
        };
        let range = curve(Some(12.02), &[12.6, 12.04]).range();
        assert_eq!(range, Some((12.02, 12.6)));
        assert_eq!(curve(None, &[12.6, 12.04]).range(), Some((12.04, 12.6)));
        let range = curve(Some(f32::NAN), &[12.6]).range();
        assert_eq!(range, Some((12.6, 12.6)));
        assert_eq!(curve(Some(12.02), &[]).range(), None);
    }
}
