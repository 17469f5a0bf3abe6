//! Parts of screens, and what they share: rules with titles, clipped and wrapped text, roles of states.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::theme::Role;
use crate::ledger::RowState;
use crate::scoring::Medal;
pub use crate::text::{reflow, wrap};
use crate::vehicle::Severity;

pub mod alerts;
pub mod bars;
pub mod curve;
pub mod footer;
pub mod header;
pub mod ledger;
pub mod log;
pub mod map;
pub mod mission;
pub mod notices;
pub mod overlay;
pub mod palette;
pub mod profiles;
pub mod prompt;
pub mod swarm;
pub mod telemetry;
pub mod urgent;

/// A box of a size in the middle of an area, made smaller where it does not fit.
pub fn centred(width: u16, height: u16, area: Rect) -> Rect {
    let (width, height) = (width.min(area.width), height.min(area.height));
    Rect {
        x: area.x + (area.width - width) / 2,
        y: area.y + (area.height - height) / 2,
        width,
        height,
    }
}

/// What is left of an area below its first rows.
pub fn below(area: Rect, rows: u16) -> Rect {
    let rows = rows.min(area.height);
    Rect {
        y: area.y + rows,
        height: area.height - rows,
        ..area
    }
}

/// One row of an area, empty if the area has no such row.
pub fn row_of(area: Rect, row: u16) -> Rect {
    let area = below(area, row);
    upper(area, 1)
}

/// The first rows of an area.
pub fn upper(area: Rect, rows: u16) -> Rect {
    Rect {
        height: rows.min(area.height),
        ..area
    }
}

/// Some columns of an area, counted from its left edge.
pub fn columns(area: Rect, from: u16, width: u16) -> Rect {
    let from = from.min(area.width);
    Rect {
        x: area.x + from,
        width: width.min(area.width - from),
        ..area
    }
}

/// Writes a line into a row of an area, clipped to it; returns where it ended, or `None` if the area has no such row.
pub fn put(buffer: &mut Buffer, area: Rect, row: u16, line: &Line<'_>) -> Option<u16> {
    if row >= area.height || area.width == 0 {
        return None;
    }
    Some(buffer.set_line(area.x, area.y + row, line, area.width).0)
}

/// A text cut to a width, with a mark where something is missing.
pub fn clip(text: &str, width: usize) -> String {
    if Span::raw(text).width() <= width {
        return text.to_owned();
    }
    let mut clipped = String::new();
    for c in text.chars() {
        clipped.push(c);
        if Span::raw(clipped.as_str()).width() + 1 > width {
            clipped.pop();
            break;
        }
    }
    if width > 0 {
        clipped.push('…');
    }
    clipped
}

/// Columns that a text takes on the screen.
pub fn width(text: &str) -> usize {
    Span::raw(text).width()
}

/// A text cut or filled up to a width.
pub fn aligned(text: &str, columns: usize, right: bool) -> String {
    let text = clip(text, columns);
    let blanks = " ".repeat(columns.saturating_sub(width(&text)));
    if right {
        blanks + &text
    } else {
        text + &blanks
    }
}

/// A time as minutes and seconds, with hours where there are any.
pub fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 {
        format!("{hours}:{minutes:02}:{seconds:02}")
    } else {
        format!("{minutes:02}:{seconds:02}")
    }
}

/// The same without a zero in front.
pub fn short_clock(time: Duration) -> String {
    let text = clock(time);
    text.strip_prefix('0').map_or(text.clone(), str::to_owned)
}

/// How a severity looks.
pub fn severity_role(severity: Severity) -> Role {
    match severity {
        Severity::Emergency | Severity::Alert | Severity::Critical | Severity::Error => {
            Role::Danger
        }
        Severity::Warning => Role::Warning,
        Severity::Notice => Role::Accent,
        Severity::Info => Role::Info,
        Severity::Debug => Role::Muted,
    }
}

/// A medal in stars: three are gold.
pub fn stars(medal: Option<Medal>) -> &'static str {
    match medal {
        Some(Medal::Gold) => "***",
        Some(Medal::Silver) => "**",
        Some(Medal::Bronze) => "*",
        None => "",
    }
}

/// How the state of a command looks.
pub fn row_role(state: RowState) -> Role {
    match state {
        RowState::Done => Role::Ok,
        RowState::Queued | RowState::Superseded => Role::Muted,
        RowState::Sent | RowState::InProgress(_) | RowState::Accepted => Role::Accent,
        RowState::NoEffect => Role::Warning,
        RowState::Refused | RowState::TimedOut => Role::Danger,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_cut_with_a_mark() {
        assert_eq!(clip("position", 8), "position");
        assert_eq!(clip("position", 5), "posi…");
        assert_eq!(clip("position", 0), "");
        assert_eq!(clip("日本語", 4), "日…");
    }

    #[test]
    fn clocks_grow_hours_when_needed() {
        assert_eq!(clock(Duration::from_secs(62)), "01:02");
        assert_eq!(clock(Duration::from_secs(3723)), "1:02:03");
    }
}
