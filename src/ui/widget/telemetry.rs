//! The telemetry of the vehicle under the cursor, the most important lines first.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::swarm::since;
use crate::app::State;
use crate::app::state::{FlightView, Standing};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, put, severity_role, width, wrap};
use crate::vehicle::Vehicle;

mod ekf;
mod values;

pub use values::Detail;
use values::{Reading, fitting, readings};

/// The width of the labels, in columns.
const LABEL_WIDTH: usize = 9;
/// The width of a gauge, in columns.
const GAUGE: usize = 8;
/// The width to which a gauge shrinks if the value beside it would otherwise be cut.
const SHORT_GAUGE: usize = 6;
/// The maximum number of alerts shown here; the others follow when these end.
const MOST_ALERTS: usize = 3;

/// The preferred height of the pane, in rows.
pub fn height(state: &State, look: &Look, width: u16, detail: Detail) -> u16 {
    let Some(vehicle) = state.session().under_cursor() else {
        return 1;
    };
    let alerts = alert_lines(vehicle, state, look, usize::from(width)).len();
    let lines = readings(vehicle, state, detail);
    (1 + alerts + usize::from(vehicle.link.lost) + lines.len()) as u16
}

/// A line that marks the values as old, if the vehicle's link is lost.
pub fn last_known(vehicle: &Vehicle, state: &State, look: &Look) -> Option<Line<'static>> {
    let link = vehicle.link;
    let silent = state
        .now()
        .saturating_sub(link.last_heard.unwrap_or_default());
    let text = text!("vehicle-last-known", seconds = silent.as_secs());
    link.lost
        .then(|| Line::styled(look.text(&text), look.style(Role::Danger)))
}

/// Draws as many lines as fit; a vehicle's alerts come first, in full.
pub fn draw(state: &State, panel: Panel<'_>, detail: Detail, buffer: &mut Buffer) {
    let Some(vehicle) = state.session().under_cursor() else {
        panel.titled(&panel.say("telemetry-title"), buffer);
        return;
    };
    let name = FlightView::name(vehicle);
    let title = panel.text(&text!(
        "telemetry-vehicle",
        vehicle = vehicle.id,
        name = name
    ));
    let mut inner = panel.titled(&title, buffer);
    let alerts = alert_lines(vehicle, state, panel.look, usize::from(inner.width));
    for line in alerts
        .into_iter()
        .chain(last_known(vehicle, state, panel.look))
    {
        put(buffer, inner, 0, &line);
        inner = below(inner, 1);
    }
    let lines = readings(vehicle, state, detail);
    let shown = fitting(lines, usize::from(inner.height)).into_iter();
    for (row, reading) in shown.enumerate() {
        let line = reading_line(&reading, vehicle.link.lost, panel.at(inner));
        put(buffer, inner, row as u16, &line);
    }
}

/// A reading as a line of the panel; old values are muted.
fn reading_line(reading: &Reading, is_old: bool, panel: Panel<'_>) -> Line<'static> {
    let look = panel.look;
    let label = aligned(&look.say(reading.label), LABEL_WIDTH, false);
    let mut spans = vec![Span::styled(label, look.style(Role::Muted))];
    if let Some(gauge) = reading.gauge {
        spans.extend(gauge.spans(gauge_width(reading, panel), look));
        spans.push(Span::raw(" "));
    }
    for (at, (text, role)) in reading.parts.iter().enumerate() {
        if at > 0 {
            spans.push(Span::raw("  "));
        }
        let role = if is_old { Role::Muted } else { *role };
        spans.push(Span::styled(look.text(text), look.style(role)));
    }
    Line::from(spans)
}

/// The width of a reading's gauge, in columns: shorter if the value fits only so.
fn gauge_width(reading: &Reading, panel: Panel<'_>) -> usize {
    let values = reading.parts.iter();
    let values: usize = values.map(|(text, _)| width(&panel.text(text)) + 2).sum();
    // A gap before the value, none after it.
    let used = LABEL_WIDTH + values.saturating_sub(1);
    let fits = |gauge: &usize| used + gauge <= panel.width();
    [GAUGE, SHORT_GAUGE].into_iter().find(fits).unwrap_or(GAUGE)
}

/// The vehicle's alerts with their durations, the most serious first.
fn alert_lines(vehicle: &Vehicle, state: &State, look: &Look, width: usize) -> Vec<Line<'static>> {
    let session = state.session();
    let mut alerts: Vec<&Standing> = session.alerts().of(vehicle.id).collect();
    alerts.sort_by_key(|one| (session.alerts().is_calm(one), one.alert.severity));
    let told = alerts.into_iter().take(MOST_ALERTS);
    let lines = told.flat_map(|one| {
        let role = if session.alerts().is_calm(one) {
            Role::Muted
        } else {
            severity_role(one.alert.severity)
        };
        let text = since(one, session.time(one.since), look, usize::MAX);
        let lines = wrap(&text, width).into_iter();
        lines.map(move |line| Line::styled(line, look.style(role)))
    });
    lines.collect()
}
