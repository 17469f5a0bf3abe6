//! The swarm table: a line per vehicle. Only visible lines are built.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::room::fly::sorted_by;
use crate::app::state::Room;
use crate::app::state::Selection;
use crate::config::TableSort;
use crate::text;
use crate::text::Text;
use crate::ui::look::{Badge, Look};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, columns, put, width, wrap};
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

mod cells;
mod layout;

pub use cells::since;
use cells::{Row, Words, cell};
use layout::Shown;

/// The number of columns before the first cell: the cursor's mark and the selection mark.
const MARKS: u16 = 2;

/// The preferred height of the table in rows: a rule, the titles, and a row for each vehicle, or
/// the lines shown while there are no vehicles. A filter does not change the height.
pub fn height(state: &State, look: &Look, width: u16) -> usize {
    let rows = match state.session().vehicles().len() {
        0 => waiting_lines(state, look, width).len(),
        count => count,
    };
    rows + 2
}

/// The lines shown before a vehicle is heard: the state of the links.
fn waiting_lines(state: &State, look: &Look, width: u16) -> Vec<(String, Role)> {
    let session = state.session();
    let what = if session.activity().is_some() {
        "fly-waiting"
    } else {
        "fly-no-flight"
    };
    let mut lines = vec![(format!("  {}", look.say(what)), Role::Muted)];
    for (at, link) in session.links().iter().enumerate() {
        let reason = link.error.clone().unwrap_or_else(|| session.link_state(at));
        let reason = look.text(&reason);
        let role = if link.error.is_some() {
            Role::Warning
        } else {
            Role::Muted
        };
        let text = format!("{}: {reason}", link.name);
        let wrapped = wrap(&text, usize::from(width).saturating_sub(2));
        lines.extend(wrapped.into_iter().map(|line| (format!("  {line}"), role)));
    }
    lines.extend(session.worst_finding().map(|finding| {
        let says = text!(
            "links-ailing",
            finding = finding.says(),
            key = state.key(Action::Show(Room::Links))
        );
        let text = format!("  {}", look.text(&says));
        (clip(&text, width.into()), Role::Warning)
    }));
    lines
}

fn draw_lines(lines: Vec<(String, Role)>, panel: Panel<'_>, buffer: &mut Buffer) {
    for (row, (text, role)) in lines.into_iter().enumerate() {
        let line = Line::styled(text, panel.style(role));
        put(buffer, panel.area, row as u16, &line);
    }
}

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let session = state.session();
    let fly = state.rooms().fly();
    let rows = usize::from(panel.area.height.saturating_sub(2));
    // The cursor stays in the centre while the list scrolls.
    let first = fly
        .row_of(session.cursor())
        .saturating_sub(rows / 2)
        .min(fly.rows().len().saturating_sub(rows));
    let head = columns(panel.area, 0, panel.area.width.saturating_sub(6));
    let inner = panel.focused(&title(state, first, rows, panel.at(head)), true, buffer);
    let words = Words::new(panel.look);
    let columns = layout::columns(state, &words, panel.look, inner.width.saturating_sub(MARKS));
    draw_titles(&columns, panel.at(inner), buffer);
    let list = below(inner, 1);
    if session.vehicles().is_empty() {
        let lines = waiting_lines(state, panel.look, panel.area.width);
        draw_lines(lines, panel.at(list), buffer);
    } else if fly.rows().is_empty() {
        let text = text!(
            "fly-none-fit",
            filter = fly.filter_text(),
            key = state.key(Action::Escape)
        );
        let line = (format!("  {}", panel.text(&text)), Role::Muted);
        draw_lines(vec![line], panel.at(list), buffer);
    }
    let seen = fly.rows().iter().skip(first).take(rows);
    for (at, &id) in seen.enumerate() {
        let line = Rect {
            y: list.y + at as u16,
            height: 1,
            ..list
        };
        if let Some(vehicle) = session.vehicles().get(&id) {
            let row = Row {
                vehicle,
                state,
                words: &words,
                selected: session.selection().contains(&id),
            };
            draw_vehicle(&row, &columns, panel.at(line), buffer);
        }
    }
    panel
        .at(list)
        .mark_list(first, fly.rows().len(), true, buffer);
}

/// The title of the table: the number of vehicles shown, their order, and the selection.
fn title(state: &State, first: usize, rows: usize, panel: Panel<'_>) -> String {
    let session = state.session();
    let fly = state.rooms().fly();
    let (shown, all) = (fly.rows().len(), session.vehicles().len());
    let mut parts = vec![panel.say("fly-swarm")];
    if shown > rows {
        let last = (first + rows).min(shown);
        let text = text!("fly-rows", first = first + 1, last = last, count = shown);
        parts.push(panel.text(&text));
    }
    if !fly.filter_text().is_empty() {
        let filter = clip(fly.filter_text(), 24);
        let text = text!("fly-filtered", shown = shown, all = all, filter = filter);
        parts.push(panel.text(&text));
    }
    let sort = sorted_by(state);
    if sort != TableSort::BY_ID {
        let mark = if sort.reversed { "-" } else { "" };
        let title = Text::joined("", vec![mark.into(), sort.column.title()]);
        parts.push(panel.text(&text!("fly-by", column = title)));
    }
    if !session.selection().is_empty() {
        let used: usize = parts.iter().map(|part| width(part) + 2).sum();
        parts.push(clip(
            &selected(state, panel.look),
            panel.width().saturating_sub(used).max(24),
        ));
    }
    parts.join("  ")
}

/// The selection as text: the number of vehicles, their groups, and their numbers.
fn selected(state: &State, look: &Look) -> String {
    let session = state.session();
    let selection = session.selection();
    let whole = |members: &[VehicleId]| {
        !members.is_empty() && members.iter().all(|id| selection.contains(id))
    };
    let named = session.groups().iter();
    let groups: Vec<String> = named
        .filter(|(_, members)| whole(members))
        .map(|(name, _)| format!(" @{name}"))
        .collect();
    let hidden = hidden(state, selection);
    let vehicles = format!("{}{}", ranges(selection.iter().copied()), groups.concat());
    look.text(&if hidden > 0 {
        text!(
            "fly-selected-hidden",
            count = selection.len(),
            hidden = hidden,
            vehicles = vehicles
        )
    } else {
        text!("fly-selected", count = selection.len(), vehicles = vehicles)
    })
}

/// The number of selected vehicles that the filter hides.
fn hidden(state: &State, selection: &Selection) -> usize {
    let fly = state.rooms().fly();
    if fly.filter_text().is_empty() {
        return 0;
    }
    let shown = fly.rows().iter();
    selection.len() - shown.filter(|id| selection.contains(id)).count()
}

fn draw_titles(columns: &[Shown], panel: Panel<'_>, buffer: &mut Buffer) {
    let titles: Vec<String> = columns
        .iter()
        .map(|it| aligned(&it.title, usize::from(it.width), it.right))
        .collect();
    let line = Line::styled(format!("   {}", titles.join(" ")), panel.style(Role::Muted));
    put(buffer, panel.area, 0, &line);
}

fn draw_vehicle(row: &Row<'_>, columns: &[Shown], panel: Panel<'_>, buffer: &mut Buffer) {
    let under_cursor = row.state.session().cursor() == Some(row.vehicle.id);
    let cursor_mark = if under_cursor { ">" } else { " " };
    let selection_mark = if row.selected { "*" } else { " " };
    let mut line = Line::from(vec![
        Span::raw(cursor_mark),
        Span::styled(selection_mark, panel.style(Role::Selected)),
    ]);
    let badge = Badge::of_vehicle(row.vehicle.id);
    let mut before = Span::styled(badge.sign.to_string(), panel.style(badge.role));
    for shown in columns {
        let room = usize::from(shown.width);
        let (text, role) = cell(shown.column, row, panel.look, room);
        line.push_span(before);
        let text = aligned(&text, room, shown.right);
        line.push_span(Span::styled(text, panel.style(role)));
        before = Span::raw(" ");
    }
    put(buffer, panel.area, 0, &line);
    if under_cursor {
        panel.mark_cursor(buffer);
    }
}
