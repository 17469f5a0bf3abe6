//! The vehicle's own texts.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use crate::notice::sanitised;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clock, put, severity_role, wrap};
use crate::vehicle::Severity;

/// The width of the time before a text, in columns.
const TIME: usize = 6;

/// Draws the last texts, the newest at the bottom.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let (state, look) = (subject.state, subject.look);
    let inner = Panel::new(look, area).titled(&look.say("vehicle-texts"), buffer);
    let width = usize::from(inner.width).saturating_sub(TIME);
    let mut lines: Vec<Line<'static>> = Vec::new();
    for text in &subject.vehicle.texts {
        let time = clock(state.session().time(text.at));
        let style = look.style(severity_role(text.severity));
        let said = format!(
            "{} ({})",
            sanitised(&text.text),
            look.say(severity(text.severity))
        );
        for (row, part) in wrap(&said, width).into_iter().enumerate() {
            let time = if row == 0 { time.as_str() } else { "" };
            lines.push(Line::from(vec![
                Span::styled(format!("{time:TIME$}"), look.style(Role::Muted)),
                Span::styled(part, style),
            ]));
        }
    }
    let rows = usize::from(inner.height);
    let first = lines.len().saturating_sub(rows);
    for (row, line) in lines.iter().skip(first).enumerate() {
        put(buffer, inner, row as u16, line);
    }
    if lines.is_empty() {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", look.style(Role::Muted)),
        );
    }
}

/// The id of a severity's name.
fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Emergency => "vehicle-severity-emergency",
        Severity::Alert => "vehicle-severity-alert",
        Severity::Critical => "vehicle-severity-critical",
        Severity::Error => "vehicle-severity-error",
        Severity::Warning => "vehicle-severity-warning",
        Severity::Notice => "vehicle-severity-notice",
        Severity::Info => "vehicle-severity-info",
        Severity::Debug => "vehicle-severity-debug",
    }
}
