//! The files of the vehicle under the cursor: the folder, and below it the newest commands about files.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, FilesAction};
use crate::app::room::files::outcome;
use crate::ledger::{LedgerEntry, LedgerRow};
use crate::session::FtpEntry;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, put, row_of, row_role, width};
use crate::vehicle::VehicleId;

/// The width of a size, in columns.
const SIZE: usize = 14;
/// The greatest width of a name, in columns; names end before the sizes.
const NAME: usize = 60;
/// The width of a state, in columns.
const STATE: usize = 17;
/// The share of the screen for the commands: one part of this many.
const SHARE: u16 = 3;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(vehicle) = state.session().cursor() else {
        let line = Line::styled(panel.say("files-no-vehicle"), panel.style(Role::Muted));
        put(buffer, below(panel.area, 1), 0, &line);
        return;
    };
    let rows = panel.area.height - panel.area.height / SHARE;
    draw_folder(state, vehicle, panel.upper(rows), buffer);
    draw_orders(state, panel.below(rows), buffer);
}

fn draw_folder(state: &State, vehicle: VehicleId, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().files();
    let title = text!("files-title", vehicle = vehicle, folder = room.folder());
    let inner = panel.focused(&panel.text(&title), true, buffer);
    let Some(entries) = room.entries(vehicle) else {
        let (text, role) = missing(state, vehicle);
        let line = Line::styled(format!("  {}", panel.text(&text)), panel.style(role));
        put(buffer, inner, 0, &line);
        return;
    };
    let name = NAME.min(panel.width().saturating_sub(SIZE + 4));
    let heading = format!(
        "  {}{}",
        aligned(&panel.say("files-column-name"), name, false),
        aligned(&panel.say("files-column-size"), SIZE, true)
    );
    put(
        buffer,
        inner,
        0,
        &Line::styled(heading, panel.style(Role::Title)),
    );
    let list = panel.at(below(inner, 1));
    if entries.is_empty() {
        let empty = format!("  {}", panel.say("files-empty"));
        put(
            buffer,
            list.area,
            0,
            &Line::styled(empty, panel.style(Role::Muted)),
        );
        return;
    }
    let at = room.cursor_row(vehicle);
    let visible = usize::from(list.area.height);
    let top = at
        .saturating_sub(visible / 2)
        .min(entries.len().saturating_sub(visible));
    for (row, (index, entry)) in entries
        .iter()
        .enumerate()
        .skip(top)
        .take(visible)
        .enumerate()
    {
        let place = row_of(list.area, row as u16);
        let line = entry_line(entry, index == at, name, panel);
        put(buffer, place, 0, &line);
        if index == at {
            panel.at(place).mark_cursor(buffer);
        }
    }
    list.mark_list(top, entries.len(), true, buffer);
}

fn entry_line(entry: &FtpEntry, is_chosen: bool, name: usize, panel: Panel<'_>) -> Line<'static> {
    let mark = if is_chosen { "> " } else { "  " };
    let (shown, size, role) = match entry.size {
        Some(size) => (entry.name.clone(), grouped(size), Role::Text),
        None => (format!("{}/", entry.name), String::new(), Role::Accent),
    };
    Line::from(vec![
        Span::raw(mark),
        Span::styled(aligned(&shown, name, false), panel.style(role)),
        Span::styled(aligned(&size, SIZE, true), panel.style(Role::Text)),
    ])
}

/// A number with its digits in groups of three.
fn grouped(number: u32) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(' ');
        }
        grouped.push(digit);
    }
    grouped
}

/// Why a folder has no entries on the screen.
fn missing(state: &State, vehicle: VehicleId) -> (Text, Role) {
    let listing = state.rooms().files().listing();
    let row = listing.and_then(|entry| outcome(state, entry, vehicle));
    match row {
        Some(row) if row.state.is_final() => {
            let reason = row.explanation.clone().unwrap_or_else(|| row.text());
            let again = state.key(Action::Files(FilesAction::ListAgain));
            let text = text!("files-not-listed", reason = reason, key = again);
            (text, Role::Warning)
        }
        None if state.replay().is_some() => (text!("files-in-replay"), Role::Muted),
        Some(_) | None => (text!("files-listing"), Role::Muted),
    }
}

/// The newest commands about files with their outcomes, newest first.
fn draw_orders(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("files-orders"), buffer);
    let ledger = state.session().ledger();
    let entries = state.rooms().files().orders();
    let entries = entries.filter_map(|id| ledger.entry(id));
    let rows = entries.flat_map(|entry| entry.rows.iter().map(move |row| (entry, row)));
    for (at, (entry, row)) in rows.take(usize::from(inner.height)).enumerate() {
        put(buffer, inner, at as u16, &order_line(entry, row, panel));
    }
}

fn order_line(entry: &LedgerEntry, row: &LedgerRow, panel: Panel<'_>) -> Line<'static> {
    let word = aligned(&panel.text(&row.text()), STATE, false);
    let free = panel.width().saturating_sub(STATE + 4);
    let line = clip(&entry.line, free);
    let left = free.saturating_sub(width(&line) + 2);
    let mut spans = vec![
        Span::styled(format!(" {word} "), panel.style(row_role(row.state))),
        Span::styled(line, panel.style(Role::Text)),
    ];
    if let Some(why) = row.explanation.as_ref() {
        let why = panel.text(why);
        spans.push(Span::styled(
            format!("  {}", clip(&why, left)),
            panel.style(Role::Muted),
        ));
    }
    Line::from(spans)
}
