//! The ledger pane: a line per command with its outcome, newest last.

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr as _;

use crate::app::State;
use crate::app::action::Action;
use crate::app::state::FlightView;
use crate::ledger::{ForeignCommand, LedgerEntry, LedgerItem, LedgerRow, RowState};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, clock, put, row_role, wrap};
use crate::vehicle_id::ranges;

mod remarks;

use remarks::{explanations, outcome};

#[cfg(test)]
mod tests;

const INDENT: usize = 2;

/// Draws the newest entries that fit.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("commands-pane"), buffer);
    let rows = usize::from(inner.height);
    let width = usize::from(inner.width);
    let mut blocks: Vec<Vec<Line<'_>>> = Vec::new();
    let mut used = 0;
    for item in state.session().ledger().newest_first() {
        if used >= rows {
            break;
        }
        let (session, left) = (state.session(), rows - used);
        let block = match item {
            LedgerItem::Own(entry) => lines_within(entry, session, width, left, panel.look),
            LedgerItem::Foreign(command) => {
                let mut lines = foreign_lines(command, session, width, panel.look);
                cut(&mut lines, left, width);
                lines
            }
        };
        used += block.len();
        blocks.push(block);
    }
    if blocks.is_empty() {
        let text = panel.text(&none(state));
        put(
            buffer,
            inner,
            0,
            &Line::styled(text, panel.style(Role::Muted)),
        );
    }
    for (row, line) in blocks.iter().rev().flatten().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

/// The lines of a command within a width and a number of rows.
pub fn lines_within<'a>(
    entry: &LedgerEntry,
    session: &FlightView,
    width: usize,
    rows: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let mut lines = entry_lines(entry, session, width, look);
    if rows == 1 && lines.len() > 1 {
        lines = vec![short_line(entry, session, width, look)];
    }
    cut(&mut lines, rows, width);
    lines
}

/// The text shown while there are no commands.
pub fn none(state: &State) -> Text {
    if state.shows_past() {
        text!("commands-none-replayed")
    } else {
        text!("commands-none", key = state.key(Action::CommandLine))
    }
}

/// A command on a single row: its line is cut, its states are not, and a mark shows that there is more to read.
fn short_line<'a>(
    entry: &LedgerEntry,
    session: &FlightView,
    width: usize,
    look: &Look,
) -> Line<'a> {
    let time = format!("{} ", clock(session.time(entry.at)));
    let states = format!("{}…", summary(entry, look, false));
    let room = width.saturating_sub(time.width() + states.width() + 2);
    Line::from(vec![
        Span::styled(time, look.style(Role::Muted)),
        Span::raw(format!("{}  ", clip(&look.text(&entry.said()), room))),
        Span::styled(states, look.style(entry_role(entry))),
    ])
}

/// Drops the lines that do not fit; the last visible one is marked.
fn cut(lines: &mut Vec<Line<'_>>, rows: usize, width: usize) {
    if lines.len() <= rows {
        return;
    }
    lines.truncate(rows);
    let Some(line) = lines.last_mut() else { return };
    let before: usize = line.spans.iter().rev().skip(1).map(Span::width).sum();
    if let Some(last) = line.spans.last_mut() {
        // The text is made one column too long, so `clip` marks the cut.
        let room = (width.saturating_sub(before)).min(last.width() + 1);
        last.content = clip(&format!("{}  ", last.content), room).into();
    }
}

/// A command, its outcome, and the reasons.
pub fn entry_lines<'a>(
    entry: &LedgerEntry,
    session: &FlightView,
    width: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let style = look.style(entry_role(entry));
    let mut lines = head_lines(entry, session, width, look);
    // If all rows have ended with a remark, it replaces their states.
    let told = outcome(entry, look).is_some();
    let left = explanations(entry);
    for remark in left.into_iter().filter(|_| !told) {
        let explained = text!(
            "state-explained",
            count = remark.vehicles.len(),
            vehicles = ranges(remark.vehicles),
            text = remark.text
        );
        let wrapped = wrap(&look.text(&explained), width.saturating_sub(INDENT));
        lines.extend(wrapped.iter().map(|line| indented(line, style)));
    }
    lines
}

/// The command and its outcome: on one line if they fit, otherwise one below the other.
fn head_lines<'a>(
    entry: &LedgerEntry,
    session: &FlightView,
    width: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let style = look.style(entry_role(entry));
    let time = Span::styled(
        format!("{} ", clock(session.time(entry.at))),
        look.style(Role::Muted),
    );
    let room = width.saturating_sub(time.width());
    let said = look.text(&entry.said());
    let free = room.saturating_sub(Span::raw(&said).width() + 2);
    let outcome = outcome(entry, look);
    let is_told = outcome.is_some();
    let short = outcome
        .clone()
        .unwrap_or_else(|| summary(entry, look, false));
    let long = outcome.unwrap_or_else(|| summary(entry, look, true));
    let mut fitting = [long, short.clone()].into_iter();
    if let Some(text) = fitting.find(|text| text.chars().count() <= free) {
        let mut line = Line::from(vec![time, Span::raw(format!("{said}  "))]);
        if is_told {
            line.push_span(Span::styled(text, style));
        } else {
            // The count of all vehicles before their states.
            let states = summary(entry, look, false);
            let count = text.strip_suffix(&states).unwrap_or_default().to_owned();
            line.push_span(Span::styled(count, look.style(Role::Muted)));
            line.extend(summary_spans(entry, look, free));
        }
        return vec![line];
    }
    let mut lines = vec![Line::from(vec![time, Span::raw(clip(&said, room))])];
    let wrapped = wrap(&short, width.saturating_sub(INDENT));
    lines.extend(wrapped.iter().map(|line| indented(line, style)));
    lines
}

/// The lines of a command of another station: the command, which names the station, and its
/// outcome.
fn foreign_lines<'a>(
    command: &ForeignCommand,
    session: &FlightView,
    width: usize,
    look: &Look,
) -> Vec<Line<'a>> {
    let foreign = look.style(Role::Accent);
    let style = look.style(row_role(command.state));
    let time = format!("{} ", clock(session.time(command.at)));
    let time = Span::styled(time, look.style(Role::Muted));
    let said = look.text(&command.line());
    let outcome = look.text(&command.outcome());
    let room = width.saturating_sub(time.width());
    if said.width() + 2 + outcome.width() <= room {
        let line = Span::styled(format!("{said}  "), foreign);
        return vec![Line::from(vec![time, line, Span::styled(outcome, style)])];
    }
    let head = Line::from(vec![time, Span::styled(clip(&said, room), foreign)]);
    let wrapped = wrap(&outcome, width.saturating_sub(INDENT));
    let told = wrapped.iter().map(|line| indented(line, style));
    std::iter::once(head).chain(told).collect()
}

fn indented<'a>(text: &str, style: Style) -> Line<'a> {
    Line::styled(format!("{:INDENT$}{text}", ""), style)
}

/// A state, with the number of vehicles in it if there are several.
struct StateCount {
    text: Text,
    role: Role,
}

/// The states of a command's vehicles.
fn states(entry: &LedgerEntry) -> Vec<StateCount> {
    if let [row] = entry.rows.as_slice() {
        return vec![StateCount {
            text: entry.state_of(row),
            role: entry_role(entry),
        }];
    }
    // The progress of each vehicle in percent would be too much here.
    let mut counts: BTreeMap<(u8, bool), (Text, Role, usize)> = BTreeMap::new();
    for row in &entry.rows {
        let name = if row.state.is_final() {
            entry.state_of(row)
        } else {
            row.state.name()
        };
        // One word stands for all that another command or source has superseded.
        let state = match row.state {
            RowState::Overtaken => RowState::Superseded,
            state => state,
        };
        let at = (order(state), row.is_over());
        let role = if row.is_over() {
            Role::Muted
        } else {
            row_role(row.state)
        };
        let (_, _, count) = counts.entry(at).or_insert((name, role, 0));
        *count += 1;
    }
    let counted = counts.into_values().map(|(state, role, count)| StateCount {
        text: text!("state-count", count = count, state = state),
        role,
    });
    counted.collect()
}

/// The number of vehicles in each state, each in its own role, within a width.
pub fn summary_spans(entry: &LedgerEntry, look: &Look, room: usize) -> Vec<Span<'static>> {
    let mut spans = Vec::new();
    let mut left = room;
    let mut push = |text: &str, role| {
        let text = clip(text, left);
        left -= text.width();
        spans.push(Span::styled(text, look.style(role)));
    };
    for (at, state) in states(entry).iter().enumerate() {
        if at > 0 {
            push(", ", Role::Muted);
        }
        push(&look.text(&state.text), state.role);
    }
    spans
}

/// The number of vehicles in each state, as text.
pub fn summary(entry: &LedgerEntry, look: &Look, with_count: bool) -> String {
    let parts: Vec<Text> = states(entry).into_iter().map(|it| it.text).collect();
    if let [only] = parts.as_slice()
        && entry.rows.len() == 1
    {
        return look.text(only);
    }
    let states = Text::joined(", ", parts);
    look.text(&if with_count {
        text!(
            "state-of-all",
            vehicles = text!("count-vehicles", count = entry.rows.len()),
            states = states
        )
    } else {
        states
    })
}

/// The position of a state in the summary: failures come last, next to their explanation.
fn order(state: RowState) -> u8 {
    match state {
        RowState::Done => 0,
        RowState::Accepted => 1,
        RowState::InProgress(_) => 2,
        RowState::Sent | RowState::SentOnly => 3,
        RowState::Queued => 4,
        RowState::Superseded => 5,
        RowState::Overtaken => 6,
        RowState::NoEffect => 7,
        RowState::Barred => 8,
        RowState::Refused => 9,
        RowState::TimedOut => 10,
    }
}

/// The theme role of a command: that of its worst outcome.
pub fn entry_role(entry: &LedgerEntry) -> Role {
    if !entry.rows.is_empty() && entry.rows.iter().all(LedgerRow::is_over) {
        return Role::Muted;
    }
    let worst = entry
        .rows
        .iter()
        .map(|row| row.state)
        .max_by_key(|&state| match state {
            RowState::Done | RowState::SentOnly => 0,
            RowState::Superseded => 1,
            other if other.is_failure() => 3 + order(other),
            RowState::Queued
            | RowState::Sent
            | RowState::InProgress(_)
            | RowState::Accepted
            | RowState::NoEffect
            | RowState::Refused
            | RowState::TimedOut
            | RowState::Overtaken
            | RowState::Barred => 2,
        });
    worst.map_or(Role::Muted, row_role)
}
