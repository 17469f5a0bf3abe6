//! The notice pane, newest last.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::state::{FlightView, NoticeLine};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, clip, clock, put, severity_role, wrap};
use crate::vehicle::Severity;
use crate::vehicle_id::ranges;

/// The width of a severity, in columns.
const SEVERITY_WIDTH: usize = 5;
/// The maximum width of the vehicles before a text, in columns.
const MOST_VEHICLES: usize = 12;
/// The maximum number of lines of a notice that is not an error.
const MOST_LINES: usize = 2;

/// How long the console's own notice stays visible among vehicles' texts.
const KEPT_IN_VIEW: Duration = Duration::from_secs(30);

/// Draws the newest notices that fit. Vehicles' texts leave half of the pane to the console's own notices while those
/// are new.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("fly-notices"), buffer);
    let rows = usize::from(inner.height);
    let width = usize::from(inner.width);
    let most = most_lines(state, width, rows, panel.look);
    let mut blocks: Vec<Vec<Line<'_>>> = Vec::new();
    let mut used = 0;
    let mut texts_left = rows_for_texts(state, rows);
    for notice in state.notices().lines().rev() {
        if notice.is_of_vehicle() && texts_left == 0 {
            continue;
        }
        let mut block = lines(notice, state.session(), width, most, panel.look);
        if used + block.len() > rows && used > 0 {
            break;
        }
        block.truncate(rows);
        used += block.len();
        if notice.is_of_vehicle() {
            texts_left = texts_left.saturating_sub(block.len());
        }
        blocks.push(block);
    }
    for (row, line) in blocks.iter().rev().flatten().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

/// The maximum number of lines of a notice: no limit while all notices fit in full.
fn most_lines(state: &State, width: usize, rows: usize, look: &Look) -> usize {
    let mut left = rows;
    for notice in state.notices().lines().rev() {
        let whole = lines(notice, state.session(), width, usize::MAX, look);
        match left.checked_sub(whole.len()) {
            Some(rest) => left = rest,
            None => return MOST_LINES,
        }
    }
    usize::MAX
}

fn rows_for_texts(state: &State, rows: usize) -> usize {
    let now = state.now();
    let is_new = |line: &&NoticeLine| now.saturating_sub(line.notice.at) <= KEPT_IN_VIEW;
    let mut newest = state.notices().lines().rev().take_while(is_new);
    if newest.any(|line| !line.is_of_vehicle()) {
        rows.div_ceil(2)
    } else {
        rows
    }
}

/// A notice with its time, severity and vehicles, wrapped; if it is not an error, in at most this many lines.
pub fn lines<'a>(
    line: &NoticeLine,
    session: &FlightView,
    width: usize,
    most: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let notice = &line.notice;
    let vehicles = match ranges(line.vehicles.iter().copied()) {
        none if none.is_empty() => none,
        some => {
            let vehicles = format!("{}: ", clip(&some, MOST_VEHICLES));
            aligned(
                &vehicles,
                vehicles.len().max(vehicles_width(session)),
                false,
            )
        }
    };
    let mut head = format!(
        "{} {} {vehicles}",
        clock(line.time(session)),
        aligned(&look.text(&word(notice.severity)), SEVERITY_WIDTH, false)
    );
    let indent = " ".repeat(Span::raw(&head).width());
    let mut lines = Vec::new();
    for text in texts(line, width.saturating_sub(indent.len()), most, look) {
        let head = std::mem::replace(&mut head, indent.clone());
        lines.push(Line::from(vec![
            Span::styled(head, look.style(Role::Muted)),
            Span::styled(text, look.style(severity_role(notice.severity))),
        ]));
    }
    lines
}

/// The width of all vehicles before a text, so that the texts of one and of all begin in the same column.
fn vehicles_width(session: &FlightView) -> usize {
    let all = ranges(session.vehicles().keys().copied());
    all.len().min(MOST_VEHICLES) + 2
}

/// The text in at most this many lines, with its count.
fn texts(line: &NoticeLine, width: usize, most: usize, look: &Look) -> Vec<String> {
    // A text that each of the listed vehicles has sent once needs no count.
    let once_each = line.count as usize <= line.vehicles.len().max(1);
    let count = if once_each {
        String::new()
    } else {
        format!(" (x{})", line.count)
    };
    let text = look.text(&line.notice.text);
    let mut lines = wrap(&format!("{text}{count}"), width);
    let whole = line.notice.severity <= Severity::Error;
    if lines.len() > most && !whole {
        // The count must stay visible when the text is cut.
        let rest = lines.drain(most - 1..).collect::<Vec<_>>().join(" ");
        let uncounted = rest.strip_suffix(&count).unwrap_or(&rest);
        let last = clip(uncounted, width.saturating_sub(count.len()));
        lines.push(format!("{last}{count}"));
    }
    lines
}

/// A severity in five letters or fewer.
fn word(severity: Severity) -> Text {
    match severity {
        Severity::Emergency => text!("severity-emergency"),
        Severity::Alert => text!("severity-alert"),
        Severity::Critical => text!("severity-critical"),
        Severity::Error => text!("severity-error"),
        Severity::Warning => text!("severity-warning"),
        Severity::Notice => text!("severity-notice"),
        Severity::Info => text!("severity-info"),
        Severity::Debug => text!("severity-debug"),
    }
}
