//! The notice pane, newest last.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{NoticeLine, State, ranges};
use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{clip, clock, put, severity_role, titled, wrap};
use crate::vehicle::Severity;

/// Lines that one notice may take.
const MOST_LINES: usize = 2;

/// Draws the newest notices that fit.
pub fn draw(state: &State, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let inner = titled("notices", theme, area, buffer);
    let rows = usize::from(inner.height);
    let width = usize::from(inner.width);
    let mut blocks: Vec<Vec<Line<'_>>> = Vec::new();
    let mut used = 0;
    for notice in state.notices.lines().rev() {
        let block = lines(notice, width, theme);
        if used + block.len() > rows {
            break;
        }
        used += block.len();
        blocks.push(block);
    }
    for (row, line) in blocks.iter().rev().flatten().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

fn lines<'a>(line: &NoticeLine, width: usize, theme: &Theme) -> Vec<Line<'a>> {
    let notice = &line.notice;
    let style = theme.style(severity_role(notice.severity));
    let mut head = format!("{} {:5} ", clock(notice.at), word(notice.severity));
    if !line.vehicles.is_empty() {
        let vehicles = clip(&ranges(line.vehicles.iter().copied()), 12);
        head.push_str(&format!("{vehicles}: "));
    }
    let indent = head.chars().count();
    let count = if line.count > 1 {
        format!(" (x{})", line.count)
    } else {
        String::new()
    };
    let room = width.saturating_sub(indent);
    let mut texts = wrap(&format!("{}{count}", notice.text), room);
    if texts.len() > MOST_LINES {
        // What is cut off must not take the count with it.
        let last = texts.drain(MOST_LINES - 1..).collect::<Vec<_>>().join(" ");
        let last = last.strip_suffix(&count).unwrap_or(&last).to_owned();
        texts.push(format!(
            "{}{count}",
            clip(&last, room.saturating_sub(count.len()))
        ));
    }
    let mut lines = Vec::new();
    for (at, text) in texts.into_iter().enumerate() {
        let head = if at == 0 {
            head.clone()
        } else {
            " ".repeat(indent)
        };
        lines.push(Line::from(vec![
            Span::styled(head, theme.style(Role::Muted)),
            Span::styled(text, style),
        ]));
    }
    lines
}

/// A severity in five letters or fewer.
fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Emergency => "EMERG",
        Severity::Alert => "ALERT",
        Severity::Critical => "CRIT",
        Severity::Error => "ERROR",
        Severity::Warning => "WARN",
        Severity::Notice => "note",
        Severity::Info => "info",
        Severity::Debug => "debug",
    }
}
