//! Parts of screens, and shared helpers: rules with titles, clipped and wrapped text, roles of states.
//!
//! # How the parts fit
//! - In every room: `header`, `footer` (the text being typed, a message or the keys), `alerts` (the most serious
//!   alert that is not acknowledged), `urgent` (alerts with a time limit, weak links, the workload question),
//!   `replay`.
//! - Panes of rooms: `swarm` (the table of vehicles), `telemetry`, `mission`, `ledger`, `notices`, `map`, `leg`,
//!   `traffic`.
//! - Over a room: `overlay` (help and questions), `palette` (the command line), `prompt`, `profiles`, `log`,
//!   `sticks`.
//! - How a value is drawn: `gauge`, `bars`, `curve`; how a long name is shortened: `names`.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::panel::Panel;
pub use super::panel::{below, clip_rows, columns, put, row_of, upper};
use super::theme::Role;
use crate::ledger::RowState;
use crate::scoring::Medal;
use crate::text;
pub use crate::text::{clip, reflow, wrap};
use crate::vehicle::Severity;

pub mod alerts;
pub mod bars;
pub mod curve;
pub mod footer;
pub mod gauge;
pub mod header;
pub mod ledger;
pub mod leg;
pub mod log;
pub mod map;
pub mod mission;
mod names;
pub mod notices;
pub mod overlay;
pub mod palette;
pub mod profiles;
pub mod prompt;
pub mod replay;
pub mod sticks;
pub mod swarm;
pub mod telemetry;
pub mod traffic;
pub mod urgent;

pub use crate::text::clock;
pub use names::told_apart;

/// A centred box of this size in an area, made smaller if it does not fit.
pub fn centred(width: u16, height: u16, area: Rect) -> Rect {
    let (width, height) = (width.min(area.width), height.min(area.height));
    Rect {
        x: area.x + (area.width - width) / 2,
        y: area.y + (area.height - height) / 2,
        width,
        height,
    }
}

/// The width of a text on the screen, in columns.
pub fn width(text: &str) -> usize {
    Span::raw(text).width()
}

/// Writes texts one below the other, wrapped. If they do not fit, the last row shows how many are not shown whole.
pub fn put_or_count(texts: &[(String, Style)], panel: Panel<'_>, buffer: &mut Buffer) {
    let [columns, rows] = [panel.area.width, panel.area.height].map(usize::from);
    let mut lines = Vec::new();
    let mut ends = Vec::new();
    for (text, style) in texts {
        let wrapped = wrap(text, columns).into_iter();
        lines.extend(wrapped.map(|line| Line::styled(line, *style)));
        ends.push(lines.len());
    }
    if lines.len() > rows && rows > 0 {
        let hidden = ends.iter().filter(|end| **end >= rows).count();
        let text = panel.text(&text!("common-more", count = hidden));
        let text = aligned(&text, columns, false);
        lines.truncate(rows - 1);
        lines.push(Line::styled(text, panel.style(Role::Muted)));
    }
    for (row, line) in (0..panel.area.height).zip(&lines) {
        put(buffer, panel.area, row, line);
    }
}

/// A text cut or padded to a width; aligned to the right if `right`.
pub fn aligned(text: &str, columns: usize, right: bool) -> String {
    let text = clip(text, columns);
    let blanks = " ".repeat(columns.saturating_sub(width(&text)));
    if right {
        blanks + &text
    } else {
        text + &blanks
    }
}

/// A clock time without a leading zero.
pub fn short_clock(time: Duration) -> String {
    let text = clock(time);
    text.strip_prefix('0').map_or(text.clone(), str::to_owned)
}

/// The theme role that draws a severity.
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

/// The theme role that draws an alert that is not acknowledged.
pub fn alert_role(severity: Severity) -> Role {
    match severity_role(severity) {
        Role::Danger => Role::Alert,
        milder => milder,
    }
}

/// A medal as stars: three for gold.
pub fn stars(medal: Option<Medal>) -> &'static str {
    match medal {
        Some(Medal::Gold) => "★★★",
        Some(Medal::Silver) => "★★",
        Some(Medal::Bronze) => "★",
        None => "",
    }
}

/// The theme role that draws a command's state.
pub fn row_role(state: RowState) -> Role {
    match state {
        RowState::Done => Role::Ok,
        RowState::SentOnly => Role::Text,
        RowState::Queued | RowState::Superseded => Role::Muted,
        RowState::Sent | RowState::InProgress(_) | RowState::Accepted => Role::Accent,
        RowState::NoEffect | RowState::Overtaken | RowState::Barred => Role::Warning,
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
}
