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
    if state.replay().is_some() {
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
        Span::raw(format!("{}  ", clip(&entry.line, room))),
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
    let free = room.saturating_sub(Span::raw(&entry.line).width() + 2);
    let outcome = outcome(entry, look);
    let short = outcome
        .clone()
        .unwrap_or_else(|| summary(entry, look, false));
    let long = outcome.unwrap_or_else(|| summary(entry, look, true));
    let mut fitting = [long, short.clone()].into_iter();
    if let Some(text) = fitting.find(|text| text.chars().count() <= free) {
        let line = Span::raw(format!("{}  ", entry.line));
        return vec![Line::from(vec![time, line, Span::styled(text, style)])];
    }
    let mut lines = vec![Line::from(vec![time, Span::raw(clip(&entry.line, room))])];
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

/// The number of vehicles in each state, as text.
pub fn summary(entry: &LedgerEntry, look: &Look, with_count: bool) -> String {
    if let [row] = entry.rows.as_slice() {
        return look.text(&entry.state_of(row));
    }
    // The progress of each vehicle in percent would be too much here.
    let mut counts: BTreeMap<(u8, bool), (Text, usize)> = BTreeMap::new();
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
        let (_, count) = counts.entry(at).or_insert((name, 0));
        *count += 1;
    }
    let parts: Vec<Text> = counts
        .into_values()
        .map(|(state, count)| text!("state-count", count = count, state = state))
        .collect();
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
        RowState::Refused => 8,
        RowState::TimedOut => 9,
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
            | RowState::Overtaken => 2,
        });
    worst.map_or(Role::Muted, row_role)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::language::verb;
    use crate::ledger::{Given, Ledger, Risk, RowUpdate};
    use crate::vehicle_id::VehicleId;

    fn texts(lines: &[Line<'_>]) -> Vec<String> {
        lines.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn sentences_that_differ_stand_below_each_other_and_values_on_one_line() {
        let look = Look::default();
        let told = |remarks: [&str; 2]| {
            let mut ledger = Ledger::new();
            let given = Given {
                line: "all drop",
                verb: verb("drop").expect("a verb"),
                risk: Risk::None,
            };
            let id = ledger.open(Duration::ZERO, given, &[1, 2]);
            for (vehicle, remark) in (1..).zip(remarks) {
                ledger.apply(&RowUpdate {
                    entry: id,
                    vehicle,
                    state: RowState::Done,
                    tries: 1,
                    at: Duration::ZERO,
                    explanation: Some(Text::verbatim(remark)),
                });
            }
            let entry = ledger.entries().next().expect("it was opened");
            outcome(entry, &look)
        };
        assert_eq!(told(["= 500", "= 700"]).as_deref(), Some("1: 500   2: 700"));
        let sentences = [
            "a person 2 m away has it; 1 left",
            "no one within 8 m; 1 left",
        ];
        assert_eq!(told(sentences), None);
    }

    /// A ledger with one command, done for both its vehicles; for the first `ended` of them, its
    /// effect is over.
    fn done_and_ended(line: &str, ended: VehicleId) -> Ledger {
        let mut ledger = Ledger::new();
        let given = Given {
            line,
            verb: verb("arm").expect("a verb"),
            risk: Risk::None,
        };
        let entry = ledger.open(Duration::ZERO, given, &[1, 2]);
        let mut report = |vehicle, state, explanation| {
            ledger.apply(&RowUpdate {
                entry,
                vehicle,
                state,
                tries: 1,
                at: Duration::ZERO,
                explanation,
            });
        };
        for vehicle in [1, 2] {
            report(vehicle, RowState::Done, None);
        }
        for vehicle in 1..=ended {
            let by = Some(Text::verbatim("disarming"));
            report(vehicle, RowState::Overtaken, by);
        }
        ledger
    }

    #[test]
    fn an_effect_that_has_ended_is_no_longer_shown_as_one() {
        let look = Look::default();
        for (ended, said, role) in [
            (0, "2 effect seen", Role::Ok),
            (1, "1 effect seen, 1 effect ended", Role::Ok),
            (2, "2 effect ended", Role::Muted),
        ] {
            let ledger = done_and_ended("all arm", ended);
            let entry = ledger.entries().next().expect("it was opened");
            assert_eq!(summary(entry, &look, false), said);
            assert_eq!(entry_role(entry), role, "{said}");
        }
    }

    #[test]
    fn on_a_single_row_the_state_of_a_command_is_not_cut() {
        let look = Look::default();
        let ledger = done_and_ended("all goto n 120.5 e -35.25 up 30 heading 270", 1);
        let entry = ledger.entries().next().expect("it was opened");
        let view = FlightView::default();
        let line = short_line(entry, &view, 50, &look).to_string();
        assert_eq!(line, "00:00 all goto n …  1 effect seen, 1 effect ended…");
    }

    #[test]
    fn what_is_left_out_of_a_command_is_marked_in_the_last_line() {
        let all = || {
            vec![
                Line::raw("00:01 2 mark"),
                Line::raw("  refused, for it"),
                Line::raw("  is late"),
            ]
        };
        for (rows, width, last) in [
            (3, 20, "  is late"),
            (2, 20, "  refused, for it…"),
            (2, 17, "  refused, for i…"),
            (1, 20, "00:01 2 mark…"),
        ] {
            let mut lines = all();
            cut(&mut lines, rows, width);
            assert_eq!(lines.len(), rows);
            assert_eq!(texts(&lines).pop().as_deref(), Some(last), "{rows} {width}");
        }
    }
}
