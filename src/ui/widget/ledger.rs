//! The ledger pane: a line per command with what became of it, newest last.

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{State, ranges};
use crate::ledger::{Entry, Row, RowState};
use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{clip, clock, put, row_role, titled, wrap};

/// Columns before what became of a command.
const INDENT: usize = 2;

/// Draws the newest entries that fit.
pub fn draw(state: &State, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let inner = titled("ledger", theme, area, buffer);
    let rows = usize::from(inner.height);
    let width = usize::from(inner.width);
    let mut blocks: Vec<Vec<Line<'_>>> = Vec::new();
    let mut used = 0;
    for entry in state.session.ledger.entries().rev() {
        if used >= rows {
            break;
        }
        let mut block = entry_lines(entry, width, theme);
        block.truncate(rows - used);
        used += block.len();
        blocks.push(block);
    }
    if blocks.is_empty() {
        let text = "no command yet: press : and write one";
        put(
            buffer,
            inner,
            0,
            &Line::styled(text, theme.style(Role::Muted)),
        );
    }
    for (row, line) in blocks.iter().rev().flatten().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

fn entry_lines<'a>(entry: &'a Entry, width: usize, theme: &Theme) -> Vec<Line<'a>> {
    let time = format!("{} ", clock(entry.at));
    let long = summary(entry, true);
    let short = summary(entry, false);
    let used = time.len() + entry.line.chars().count() + 2;
    let role = entry_role(entry);
    let outcome = |text: String| Span::styled(text, theme.style(role));
    let mut lines = Vec::new();
    let head = |line: String| {
        vec![
            Span::styled(time.clone(), theme.style(Role::Muted)),
            Span::raw(line),
        ]
    };
    let fitting = [long, short.clone()]
        .into_iter()
        .find(|text| used + text.chars().count() <= width);
    match fitting {
        Some(text) => {
            let mut spans = head(format!("{}  ", entry.line));
            spans.push(outcome(text));
            lines.push(Line::from(spans));
        }
        None => {
            let room = width.saturating_sub(time.len());
            lines.push(Line::from(head(clip(&entry.line, room))));
            for part in wrap(&short, width.saturating_sub(INDENT)) {
                lines.push(Line::from(vec![
                    Span::raw(" ".repeat(INDENT)),
                    outcome(part),
                ]));
            }
        }
    }
    for (text, vehicles) in explanations(entry) {
        let plural = if vehicles.len() == 1 { "" } else { "s" };
        let text = format!("vehicle{plural} {}: {text}", ranges(vehicles));
        for line in wrap(&text, width.saturating_sub(INDENT)) {
            let line = format!("{:INDENT$}{line}", "");
            lines.push(Line::styled(line, theme.style(role)));
        }
    }
    lines
}

/// How many vehicles are in which state, in words.
fn summary(entry: &Entry, with_count: bool) -> String {
    if let [row] = entry.rows.as_slice() {
        let again = row.state == RowState::Sent && row.tries > 1;
        let tries = if again {
            format!(", try {}", row.tries)
        } else {
            String::new()
        };
        return format!("{}{tries}", row.state);
    }
    let mut counts: BTreeMap<(u8, String), usize> = BTreeMap::new();
    for row in &entry.rows {
        *counts
            .entry((order(row.state), name(row.state)))
            .or_default() += 1;
    }
    let parts: Vec<_> = counts
        .iter()
        .map(|((_, name), count)| format!("{count} {name}"))
        .collect();
    let parts = parts.join(", ");
    if with_count {
        format!("{} vehicles: {parts}", entry.rows.len())
    } else {
        parts
    }
}

/// The state's name; how many percent each vehicle has done would be too much here.
fn name(state: RowState) -> String {
    match state {
        RowState::InProgress(_) => "in progress".to_owned(),
        other => other.to_string(),
    }
}

/// What went wrong comes last, where the explanation follows.
fn order(state: RowState) -> u8 {
    match state {
        RowState::Done => 0,
        RowState::Accepted => 1,
        RowState::InProgress(_) => 2,
        RowState::Sent => 3,
        RowState::Queued => 4,
        RowState::Superseded => 5,
        RowState::NoEffect => 6,
        RowState::Refused => 7,
        RowState::TimedOut => 8,
    }
}

/// A command looks like the worst that became of it.
fn entry_role(entry: &Entry) -> Role {
    let worst = entry
        .rows
        .iter()
        .map(|row| row.state)
        .max_by_key(|&state| match state {
            RowState::Done => 0,
            RowState::Superseded => 1,
            other if other.is_failure() => 3 + order(other),
            _ => 2,
        });
    worst.map_or(Role::Muted, row_role)
}

/// The explanations of rows, equal ones together, in the order of their first vehicle.
fn explanations(entry: &Entry) -> Vec<(&str, Vec<u8>)> {
    let mut found: Vec<(&str, Vec<u8>)> = Vec::new();
    let explained = |row: &Row| row.state.is_failure() || !row.state.is_final();
    for row in entry.rows.iter().filter(|row| explained(row)) {
        let Some(text) = row.explanation.as_deref() else {
            continue;
        };
        match found.iter_mut().find(|(known, _)| *known == text) {
            Some((_, vehicles)) => vehicles.push(row.vehicle),
            None => found.push((text, vec![row.vehicle])),
        }
    }
    found
}
