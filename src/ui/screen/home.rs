//! The home screen: what there is to do, and what it is about.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{HomeItem, State};
use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{below, clip, put, titled, wrap};

/// Columns of the list.
const LIST_WIDTH: u16 = 34;

/// Draws the list with its cursor, and a text about the line under it.
pub fn draw(state: &State, cursor: usize, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let list = Rect {
        x: area.x + 1,
        width: LIST_WIDTH,
        ..below(area, 1)
    };
    let about = Rect {
        x: list.right() + 2,
        width: area.width.saturating_sub(LIST_WIDTH + 4).min(88),
        ..below(area, 1)
    };
    draw_list(state, cursor, theme, list, buffer);
    draw_about(state, cursor, theme, about, buffer);
}

fn draw_list(state: &State, cursor: usize, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let mut lines = Vec::new();
    let mut cursor_line = 0;
    for (at, item) in state.home_items().into_iter().enumerate() {
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
        if at == cursor {
            cursor_line = lines.len();
        }
        lines.push((Some(at), name(state, item)));
    }
    let inner = titled("sortie", theme, area, buffer);
    let rows = usize::from(inner.height);
    let first = cursor_line
        .saturating_sub(rows / 2)
        .min(lines.len().saturating_sub(rows));
    for (row, (at, text)) in lines.into_iter().skip(first).take(rows).enumerate() {
        let Some(at) = at else {
            put(
                buffer,
                inner,
                row as u16,
                &Line::styled(text, theme.style(Role::Muted)),
            );
            continue;
        };
        let mark = if at == cursor { "> " } else { "  " };
        let text = clip(&text, usize::from(inner.width).saturating_sub(3));
        put(
            buffer,
            inner,
            row as u16,
            &Line::raw(format!("{mark}{text}")),
        );
        if at == cursor {
            let line = Rect {
                y: inner.y + row as u16,
                height: 1,
                ..inner
            };
            buffer.set_style(line, theme.style(Role::Cursor));
        }
    }
}

fn draw_about(state: &State, cursor: usize, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let Some(item) = state.home_items().get(cursor).copied() else {
        return;
    };
    let inner = titled(&name(state, item), theme, area, buffer);
    let text = about(state, item);
    let mut row = 0;
    for line in wrap(&text, usize::from(inner.width)) {
        put(buffer, inner, row, &Line::raw(line));
        row += 1;
    }
    let enter = Line::from(vec![
        Span::styled("Enter", theme.style(Role::Key)),
        Span::styled(deed(item), theme.style(Role::Muted)),
    ]);
    put(buffer, inner, row + 1, &enter);
}

fn name(state: &State, item: HomeItem) -> String {
    match item {
        HomeItem::Mission(at) => state.missions[at].title.clone(),
        HomeItem::Free => "Free flight".to_owned(),
        HomeItem::Connect => "Connect to vehicles".to_owned(),
        HomeItem::Quit => "Quit".to_owned(),
    }
}

fn about(state: &State, item: HomeItem) -> String {
    match item {
        HomeItem::Mission(at) => state.missions[at].brief.clone(),
        HomeItem::Free => "Four simulated drones and no task: learn the commands, try things, break \
                           nothing.\n\nA first flight, each line after `:`\n\n  all guided\n  all arm\n  \
                           all takeoff 20\n  all goto n 50 e 0 up 20\n  all rtl"
            .to_owned(),
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
