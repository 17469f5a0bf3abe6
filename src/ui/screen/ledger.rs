//! All commands and their outcome for each vehicle.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::ledger::{ForeignCommand, LedgerEntry, LedgerItem, LedgerRow};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::ledger::{none, summary, summary_spans};
use crate::ui::widget::{
    aligned, below, clip, clock, put, row_of, row_role, width as width_of, wrap,
};
use crate::vehicle_id::{parse_ranges, ranges};

/// The minimum width for showing the rows of a command beside the list.
const BESIDE: u16 = 150;
/// The widths of the fixed parts of a line (time, vehicles, answer, attempts), in columns.
const TIME_WIDTH: usize = 7;
const COUNT_WIDTH: usize = 5;
const ANSWER_WIDTH: usize = 8;
const TRIES_WIDTH: usize = 5;
/// The minimum width of an outcome beside its command, in columns.
const OUTCOME_LEAST: usize = 24;
/// The width of a vehicle's state, in columns.
const STATE_WIDTH: usize = 16;

/// Draws the list, and the rows of the command under the cursor.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().ledger();
    let chosen = room.under_cursor();
    let item = chosen.and_then(|key| state.session().ledger().item(key));
    let Some(LedgerItem::Own(entry)) = item else {
        draw_list(state, panel, buffer);
        return;
    };
    if room.is_opened() {
        draw_rows(state, entry, panel, buffer);
    } else if panel.area.width >= BESIDE {
        let half = panel.area.width * 3 / 5;
        draw_list(state, panel.columns(0, half), buffer);
        draw_rows(
            state,
            entry,
            panel.columns(half + 1, panel.area.width),
            buffer,
        );
    } else {
        // The rows get at most a third of the screen; a key shows the rest.
        let wanted = 2 + lines(entry, panel.look, usize::from(panel.area.width)).len() as u16;
        let rows = wanted.clamp(4, (panel.area.height / 3).max(4));
        let list = panel.area.height.saturating_sub(rows);
        draw_list(state, panel.upper(list), buffer);
        draw_rows(state, entry, panel.below(list), buffer);
    }
}

fn draw_list(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().ledger();
    let is_opened = room.is_opened();
    let inner = panel.focused(&title(state, panel.look), !is_opened, buffer);
    // The last column is for the marks of a list that continues.
    let width = usize::from(inner.width).saturating_sub(1);
    let columns = ledger_columns(state, width, panel.look);
    put(buffer, inner, 0, &headings(panel.look, columns));
    let list = below(inner, 1);
    if room.shown().is_empty() {
        let nothing = if state.session().ledger().newest_first().next().is_none() {
            panel.text(&none(state))
        } else {
            panel.text(&text!("commands-none-fit", key = state.key(Action::Escape)))
        };
        let line = Line::styled(format!("  {nothing}"), panel.style(Role::Muted));
        put(buffer, list, 0, &line);
        return;
    }
    let rows = usize::from(list.height);
    let place = room.place();
    // The cursor stays in the centre while the list scrolls.
    let first = place
        .saturating_sub(rows / 2)
        .min(room.shown().len().saturating_sub(rows));
    let seen = room.shown().iter().enumerate().skip(first).take(rows);
    for (row, (at, &key)) in seen.enumerate() {
        let is_chosen = at == place;
        let line = match state.session().ledger().item(key) {
            Some(LedgerItem::Own(entry)) => {
                entry_line(entry, state, is_chosen, columns, panel.look)
            }
            Some(LedgerItem::Foreign(command)) => {
                foreign_line(command, state, is_chosen, columns, panel.look)
            }
            None => continue,
        };
        put(buffer, list, row as u16, &line);
        if at == place {
            panel.at(row_of(list, row as u16)).mark_cursor(buffer);
        }
    }
    panel
        .at(list)
        .mark_list(first, room.shown().len(), !is_opened, buffer);
}

fn title(state: &State, look: &Look) -> String {
    let room = state.rooms().ledger();
    let ledger = state.session().ledger();
    let all = ledger.entries().len() + ledger.foreign().len();
    let shown = room.shown().len();
    let mut parts = vec![text!("commands-pane")];
    let vehicles = parse_ranges(room.filter_text());
    if shown > 0 && vehicles.is_err() {
        parts.push(text!("fly-place", at = room.place() + 1, count = shown));
    }
    if let Ok(vehicles) = vehicles {
        parts.push(text!(
            "commands-only-vehicles",
            count = vehicles.len(),
            vehicles = clip(&ranges(vehicles), 24),
            shown = shown,
            all = all
        ));
    } else if !room.filter_text().is_empty() {
        let filter = clip(room.filter_text(), 24);
        parts.push(text!(
            "fly-filtered",
            shown = shown,
            all = all,
            filter = filter
        ));
    }
    parts.extend(room.outcome().title());
    if room.cursor().is_none() && shown > 0 {
        parts.push(text!("commands-follows"));
    }
    look.text(&Text::joined("  ", parts))
}

/// The widths of a command and of its outcome, in columns.
#[derive(Clone, Copy)]
struct LedgerColumns {
    line: usize,
    outcome: usize,
}

impl LedgerColumns {
    /// The widths if the longest outcome has `longest` columns.
    fn new(width: usize, longest: usize) -> Self {
        let fixed = 2 + TIME_WIDTH + COUNT_WIDTH + ANSWER_WIDTH + TRIES_WIDTH + 2;
        let free = width.saturating_sub(fixed);
        // Up to three fifths for outcomes, so that enough of the commands is left.
        let wanted = (longest + 1).min(free * 3 / 5);
        let outcome = (free / 2).max(OUTCOME_LEAST).max(wanted).min(free);
        Self {
            line: free - outcome,
            outcome,
        }
    }
}

/// The widths for the commands in the list.
fn ledger_columns(state: &State, width: usize, look: &Look) -> LedgerColumns {
    let keys = state.rooms().ledger().shown().iter();
    let outcomes = keys.filter_map(|&key| match state.session().ledger().item(key)? {
        LedgerItem::Own(entry) => Some(width_of(&summary(entry, look, false))),
        LedgerItem::Foreign(_) => None,
    });
    LedgerColumns::new(width, outcomes.max().unwrap_or(0))
}

fn headings(look: &Look, columns: LedgerColumns) -> Line<'static> {
    let LedgerColumns { line, outcome } = columns;
    let text = format!(
        "  {}{} {}{} {}{}",
        aligned(&look.say("commands-time"), TIME_WIDTH, false),
        aligned(&look.say("commands-line"), line, false),
        aligned(&look.say("commands-to"), COUNT_WIDTH, true),
        aligned(&look.say("commands-answer"), ANSWER_WIDTH, true),
        aligned(
            &format!(" {}", look.say("commands-outcome")),
            outcome,
            false
        ),
        aligned(&look.say("commands-tries"), TRIES_WIDTH, true),
    );
    Line::styled(text, look.style(Role::Muted))
}

fn entry_line(
    entry: &LedgerEntry,
    state: &State,
    under_cursor: bool,
    columns: LedgerColumns,
    look: &Look,
) -> Line<'static> {
    let LedgerColumns {
        line: line_width,
        outcome,
    } = columns;
    let muted = look.style(Role::Muted);
    let mark = if under_cursor { "> " } else { "  " };
    let time = clock(state.session().time(entry.at));
    let slowest = entry.rows.iter().filter_map(|row| row.answered_after).max();
    let answer = slowest.map_or("-".to_owned(), |time| seconds(time.as_secs_f64()));
    let tries = entry.rows.iter().map(|row| row.tries).max().unwrap_or(0);
    let count = entry.rows.len().to_string();
    let said = summary_spans(entry, look, outcome.saturating_sub(1));
    // Blanks without the outcome's style: reversed, they would make the whole column a block.
    let used: usize = said.iter().map(Span::width).sum();
    let blanks = " ".repeat(outcome.saturating_sub(1 + used));
    let mut line = Line::from(vec![
        Span::raw(mark),
        Span::styled(aligned(&time, TIME_WIDTH, false), muted),
        Span::styled(
            aligned(&look.text(&entry.said()), line_width, false),
            look.style(author_role(entry)),
        ),
        Span::styled(format!(" {}", aligned(&count, COUNT_WIDTH, true)), muted),
        Span::styled(aligned(&answer, ANSWER_WIDTH, true), muted),
        Span::raw("  "),
    ]);
    line.extend(said);
    let tries = aligned(&tries.to_string(), TRIES_WIDTH, true);
    line.extend([Span::raw(blanks), Span::styled(tries, muted)]);
    line
}

/// The role of a command's line: the colour of what is not the operator's own is another one.
fn author_role(entry: &LedgerEntry) -> Role {
    match entry.by {
        Some(_) => Role::Accent,
        None => Role::Text,
    }
}

/// A command of another station: its line begins with the station, and is drawn in the colour of
/// entries that are not the operator's.
fn foreign_line(
    command: &ForeignCommand,
    state: &State,
    under_cursor: bool,
    columns: LedgerColumns,
    look: &Look,
) -> Line<'static> {
    let LedgerColumns { line, outcome } = columns;
    let muted = look.style(Role::Muted);
    let mark = if under_cursor { "> " } else { "  " };
    let time = clock(state.session().time(command.at));
    let told = look.text(&command.outcome());
    // It has one vehicle, which its line names, and no measured answer.
    let wide = line + 1 + COUNT_WIDTH + ANSWER_WIDTH;
    Line::from(vec![
        Span::raw(mark),
        Span::styled(aligned(&time, TIME_WIDTH, false), muted),
        Span::styled(
            aligned(&look.text(&command.line()), wide, false),
            look.style(Role::Accent),
        ),
        Span::raw("  "),
        Span::styled(
            clip(&told, outcome + TRIES_WIDTH - 1),
            look.style(row_role(command.state)),
        ),
    ])
}

/// Seconds with a suitable number of decimals.
fn seconds(time_s: f64) -> String {
    if time_s < 10.0 {
        format!("{time_s:.2} s")
    } else {
        format!("{time_s:.0} s")
    }
}

/// Draws the outcome of one command for each vehicle, failures first.
fn draw_rows(state: &State, entry: &LedgerEntry, panel: Panel<'_>, buffer: &mut Buffer) {
    let time = clock(state.session().time(entry.at));
    let title = format!("{time} {}", panel.text(&entry.said()));
    let is_opened = state.rooms().ledger().is_opened();
    let inner = panel.focused(&title, is_opened, buffer);
    let lines = lines(entry, panel.look, usize::from(inner.width));
    let rows = usize::from(inner.height);
    let scroll = if is_opened {
        state.rooms().ledger().scroll()
    } else {
        0
    };
    let first = scroll.min(lines.len().saturating_sub(rows));
    let hidden = lines.len().saturating_sub(first + rows);
    panel.at(inner).mark_scroll(first, lines.len(), buffer);
    for (row, line) in lines.into_iter().skip(first).take(rows).enumerate() {
        put(buffer, inner, row as u16, &line);
    }
    if hidden > 0 && rows > 0 {
        let last = row_of(inner, rows as u16 - 1);
        let text = panel.text(&text!(
            "commands-more",
            count = hidden + 1,
            key = state.key(Action::Submit)
        ));
        let filled = aligned(&text, usize::from(last.width), false);
        put(
            buffer,
            last,
            0,
            &Line::styled(filled, panel.style(Role::Muted)),
        );
    }
}

fn lines(entry: &LedgerEntry, look: &Look, width: usize) -> Vec<Line<'static>> {
    let mut rows: Vec<&LedgerRow> = entry.rows.iter().collect();
    rows.sort_by_key(|row| {
        let state = row.state;
        (!state.is_failure(), state.is_final(), row.vehicle)
    });
    let lines = rows.into_iter();
    lines
        .flat_map(|row| row_lines(entry, row, look, width))
        .collect()
}

/// The lines about one vehicle: its state, its answer, its attempts, and the full reason.
fn row_lines(
    entry: &LedgerEntry,
    row: &LedgerRow,
    look: &Look,
    width: usize,
) -> Vec<Line<'static>> {
    let muted = look.style(Role::Muted);
    let answer = row
        .answered_after
        .map_or("-".to_owned(), |time| seconds(time.as_secs_f64()));
    let state = clip(&look.text(&entry.state_of(row)), STATE_WIDTH);
    let blanks = " ".repeat(STATE_WIDTH.saturating_sub(width_of(&state)));
    let tries = text!("commands-sent-times", count = row.tries);
    let head = Line::from(vec![
        Span::raw(format!("{:>5}  ", row.vehicle)),
        Span::styled(state, look.style(row_role(row.state))),
        Span::raw(blanks),
        Span::styled(aligned(&answer, ANSWER_WIDTH, true), muted),
        Span::styled(
            format!("  {}", aligned(&look.text(&tries), 10, false)),
            muted,
        ),
    ]);
    let explanation = row.remark().map(|text| look.text(&text));
    let reason = explanation.unwrap_or_default();
    let free = width.saturating_sub(head.width() + 1);
    if reason.is_empty() {
        return vec![head];
    }
    let said = |text: String| Span::styled(text, look.style(row_role(row.state)));
    if Span::raw(&reason).width() <= free {
        let mut line = head;
        line.push_span(said(format!(" {reason}")));
        return vec![line];
    }
    let indent = " ".repeat(7);
    let reasons = wrap(&reason, width.saturating_sub(indent.len()));
    let below_head = reasons
        .into_iter()
        .map(|text| Line::from(vec![Span::raw(indent.clone()), said(text)]));
    std::iter::once(head).chain(below_head).collect()
}
