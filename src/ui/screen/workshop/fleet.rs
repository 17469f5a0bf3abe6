//! The seats of a mission's fleet, and what is chosen for them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{first_shown, mission, mission_title, show_cursor};
use crate::app::State;
use crate::app::room::workshop::{Seat, WIDE, seats};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, row_of, titled, upper};

/// Columns of a seat's number and of a drone's price.
const NUMBER: usize = 8;
const PRICE: usize = 10;
/// Columns of the list beside the mission's needs.
const LIST: u16 = 70;

/// Draws the seats, and beside or below them what the mission needs.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let chosen = crate::app::room::workshop::mission(state);
    let all = chosen.map_or_else(Vec::new, |mission| seats(state, mission));
    let (list, needs) = if area.width >= WIDE {
        let rest = area.width - LIST - 1;
        (columns(area, 0, LIST), columns(area, LIST + 1, rest))
    } else {
        let rows = (all.len() as u16 + 4).min(area.height / 2 + 1);
        (upper(area, rows), below(area, rows))
    };
    let title = text!("bench-fleet", mission = mission_title(state, look));
    let inner = titled(&look.text(&title), look, list, buffer);
    let name = state.rooms.workshop.bench.design().name.clone();
    let on_bench = look.text(&text!("bench-fleet-about", name = name));
    let line = Line::styled(format!(" {on_bench}"), look.style(Role::Muted));
    put(buffer, inner, 0, &line);
    let inner = below(inner, 2);
    let cursor = state.rooms.workshop.seat.min(all.len().saturating_sub(1));
    let first = first_shown(cursor, all.len(), inner.height);
    let shown = all.iter().enumerate().skip(first);
    for (at, seat) in shown.take(usize::from(inner.height)) {
        let place = row_of(inner, (at - first) as u16);
        put(buffer, place, 0, &line_of(*seat, look, inner.width));
        if at == cursor {
            show_cursor(look, true, place, buffer);
        }
    }
    mission::draw(state, look, columns(needs, 0, LIST), buffer);
}

fn line_of(seat: Seat<'_>, look: &Look, width: u16) -> Line<'static> {
    let room = usize::from(width).saturating_sub(NUMBER + PRICE + 2);
    let number = aligned(&seat.number.to_string(), 4, true);
    let (name, price, role) = match seat.design {
        Some(design) => (
            look.text(&Text::verbatim(design.name.clone())),
            format!("{} cr", design.credits()),
            Role::Text,
        ),
        None => (look.say("bench-lent"), String::new(), Role::Muted),
    };
    Line::from(vec![
        Span::styled(format!(" {number}   "), look.style(Role::Muted)),
        Span::styled(aligned(&name, room, false), look.style(role)),
        Span::styled(aligned(&price, PRICE, true), look.style(role)),
    ])
}
