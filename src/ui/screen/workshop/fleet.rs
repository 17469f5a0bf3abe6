//! The seats of a mission's fleet with their designs.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{first_shown, mission, mission_title, show_cursor};
use crate::app::State;
use crate::app::room::workshop::{Seat, WIDE, seats};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, row_of, upper};
use crate::workshop::DesignKind;

/// The widths of a seat's number and of a drone's price, in columns.
const NUMBER: usize = 8;
const PRICE: usize = 10;
/// The width of the list beside the mission's needs, in columns.
const LIST: u16 = 70;

/// Draws the seats, and the mission's needs beside or below them.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let chosen = crate::app::room::workshop::mission(state);
    let all = chosen.map_or_else(Vec::new, |mission| seats(state, mission));
    let (list, needs) = if panel.area.width >= WIDE {
        let rest = panel.area.width - LIST - 1;
        (
            columns(panel.area, 0, LIST),
            columns(panel.area, LIST + 1, rest),
        )
    } else {
        let rows = (all.len() as u16 + 4).min(panel.area.height / 2 + 1);
        (upper(panel.area, rows), below(panel.area, rows))
    };
    let title = if chosen.is_some() {
        text!("bench-fleet", mission = mission_title(state, panel.look))
    } else {
        text!("bench-fleet-none")
    };
    let inner = panel.at(list).focused(&panel.text(&title), true, buffer);
    let name = state.rooms().workshop().bench().design().name.clone();
    let on_bench = panel.text(&text!("bench-fleet-about", name = name));
    let line = Line::styled(format!(" {on_bench}"), panel.style(Role::Muted));
    put(buffer, inner, 0, &line);
    let inner = below(inner, 2);
    let cursor = state
        .rooms()
        .workshop()
        .seat()
        .min(all.len().saturating_sub(1));
    let first = first_shown(cursor, all.len(), inner.height);
    let shown = all.iter().enumerate().skip(first);
    for (at, seat) in shown.take(usize::from(inner.height)) {
        let place = row_of(inner, (at - first) as u16);
        put(buffer, place, 0, &line_of(*seat, panel.look, inner.width));
        if at == cursor {
            show_cursor(panel.look, true, place, buffer);
        }
    }
    panel.at(inner).mark_list(first, all.len(), true, buffer);
    mission::draw(state, panel.at(columns(needs, 0, LIST)), buffer);
}

fn line_of(seat: Seat<'_>, look: &Look, width: u16) -> Line<'static> {
    let room = usize::from(width).saturating_sub(NUMBER + PRICE + 2);
    let number = aligned(&seat.number.to_string(), 4, true);
    let lent = || match seat.kind {
        DesignKind::Drone => look.say("bench-lent"),
        DesignKind::Robot | DesignKind::Boat => {
            look.text(&text!("bench-lent-kind", kind = seat.kind.name()))
        }
    };
    let (name, price, role) = match seat.design {
        Some(design) => (
            look.text(&Text::verbatim(design.name.clone())),
            format!("{} cr", design.credits()),
            Role::Text,
        ),
        None => (lent(), String::new(), Role::Muted),
    };
    Line::from(vec![
        Span::styled(format!(" {number}   "), look.style(Role::Muted)),
        Span::styled(aligned(&name, room, false), look.style(role)),
        Span::styled(aligned(&price, PRICE, true), look.style(role)),
    ])
}
