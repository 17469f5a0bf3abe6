//! The home screen: what there is to do, and what it is about.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::room::home::{HomeItem, items};
use crate::app::state::State;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, columns, put, reflow, row_of, titled, wrap};

/// Columns of the list.
const LIST_WIDTH: u16 = 34;
/// Columns of the text at most: longer lines are hard to read.
const TEXT_WIDTH: u16 = 88;

/// What free flight is for, with lines that can be given as they stand.
const FREE_FLIGHT: &str =
    "Simulated drones and no task: learn the commands, try things, break nothing.

A first flight, each line after `:`

  all guided
  all arm
  all takeoff 20
  all goto by n 50
  all rtl";

/// Draws the list with its cursor, and a text about the line under it.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let cursor = state.rooms.home.cursor;
    let area = below(area, 1);
    draw_list(state, cursor, look, columns(area, 1, LIST_WIDTH), buffer);
    let width = area.width.saturating_sub(LIST_WIDTH + 4).min(TEXT_WIDTH);
    draw_about(
        state,
        cursor,
        look,
        columns(area, LIST_WIDTH + 3, width),
        buffer,
    );
}

fn draw_list(state: &State, cursor: usize, look: &Look, area: Rect, buffer: &mut Buffer) {
    let lines = list(state, look);
    let cursor_line = lines.iter().position(|(at, _)| *at == Some(cursor));
    let inner = titled("sortie", look, area, buffer);
    let rows = usize::from(inner.height);
    let middle = cursor_line.unwrap_or(0).saturating_sub(rows / 2);
    let first = middle.min(lines.len().saturating_sub(rows));
    for (row, (at, text)) in lines.into_iter().skip(first).take(rows).enumerate() {
        let row = row as u16;
        let under_cursor = at == Some(cursor);
        let line = if at.is_some() {
            let mark = if under_cursor { '>' } else { ' ' };
            let text = clip(&text, usize::from(inner.width).saturating_sub(3));
            Line::raw(format!("{mark} {text}"))
        } else {
            Line::styled(text, look.style(Role::Muted))
        };
        put(buffer, inner, row, &line);
        if under_cursor {
            buffer.set_style(row_of(inner, row), look.style(Role::Cursor));
        }
    }
}

/// The lines of the list: items with their number, headings and blanks without.
fn list(state: &State, look: &Look) -> Vec<(Option<usize>, String)> {
    let mut lines = Vec::new();
    for (at, item) in items(state).into_iter().enumerate() {
        let heading = match item {
            HomeItem::Mission(0) => Some("missions"),
            HomeItem::Free => Some("without a task"),
            _ => None,
        };
        if let Some(heading) = heading {
            if at > 0 {
                lines.push((None, String::new()));
            }
            lines.push((None, heading.to_owned()));
        }
        lines.push((Some(at), name(state, item, look)));
    }
    lines
}

fn draw_about(state: &State, cursor: usize, look: &Look, area: Rect, buffer: &mut Buffer) {
    let Some(item) = items(state).get(cursor).copied() else {
        return;
    };
    let inner = titled(&name(state, item, look), look, area, buffer);
    let text = about(state, item, look);
    let mut row = 0;
    for line in wrap(&reflow(&text), usize::from(inner.width)) {
        put(buffer, inner, row, &Line::raw(line));
        row += 1;
    }
    let enter = Line::from(vec![
        Span::styled("Enter", look.style(Role::Key)),
        Span::styled(deed(item), look.style(Role::Muted)),
    ]);
    put(buffer, inner, row + 1, &enter);
}

fn name(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.text(&state.missions[at].title),
        HomeItem::Free => "Free flight".to_owned(),
        HomeItem::Connect => "Connect to vehicles".to_owned(),
        HomeItem::Quit => "Quit".to_owned(),
    }
}

fn about(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.locale.text(&state.missions[at].brief),
        HomeItem::Free => FREE_FLIGHT.to_owned(),
        HomeItem::Connect => "Command real drones or a simulator elsewhere: anything that speaks \
                              MAVLink over TCP, UDP or a serial port."
            .to_owned(),
        HomeItem::Quit => "Leave the program.".to_owned(),
    }
}

fn deed(item: HomeItem) -> &'static str {
    match item {
        HomeItem::Mission(_) => " flies the mission",
        HomeItem::Free => " starts",
        HomeItem::Connect => " asks for the address",
        HomeItem::Quit => " leaves",
    }
}

#[cfg(test)]
mod tests {
    use super::FREE_FLIGHT;
    use crate::language::{Context, parse};

    #[test]
    fn the_first_flight_can_be_flown_as_it_is_written() {
        let lines: Vec<&str> = FREE_FLIGHT
            .lines()
            .filter(|line| line.starts_with("  "))
            .collect();
        assert_eq!(lines.len(), 5);
        for line in lines {
            assert!(parse(line.trim(), &Context::default()).is_ok(), "{line}");
        }
    }
}
