//! All designs, the trainee's own first.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use super::{first_shown, show_cursor};
use crate::app::State;
use crate::app::room::workshop::{Stored, stored};
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, put, row_of};

/// The widths of a design's owner, mass, price and name, in columns.
const WHOSE: usize = 10;
const MASS: usize = 9;
const PRICE: usize = 10;
const NAME: usize = 28;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.focused(&panel.say("bench-designs"), true, buffer);
    let all = stored(state);
    if all.is_empty() {
        let line = Line::styled(panel.say("bench-no-designs"), panel.style(Role::Muted));
        put(buffer, inner, 0, &line);
        return;
    }
    let cursor = state.rooms().workshop().shelf().min(all.len() - 1);
    let first = first_shown(cursor, all.len(), inner.height);
    for (at, stored) in all.iter().enumerate().skip(first) {
        let place = row_of(below(inner, (at - first) as u16), 0);
        if place.height == 0 {
            break;
        }
        put(buffer, place, 0, &line(*stored, panel.look, inner.width));
        if at == cursor {
            show_cursor(panel.look, true, place, buffer);
        }
    }
    panel.at(inner).mark_list(first, all.len(), true, buffer);
}

fn line(Stored { design, is_own }: Stored<'_>, look: &Look, width: u16) -> Line<'static> {
    let whose = look.say(if is_own { "bench-own" } else { "bench-stock" });
    let name = look.text(&Text::verbatim(design.name.clone()));
    let pieces = design.pieces();
    let parts: Vec<String> = pieces.map(|(part, _)| look.text(&part.name())).collect();
    let head = format!(
        "  {}{}{}{}  ",
        aligned(&name, NAME, false),
        aligned(&whose, WHOSE, false),
        aligned(&format!("{:.2} kg", design.mass_kg()), MASS, true),
        aligned(&format!("{} cr", design.credits()), PRICE, true),
    );
    let room = usize::from(width).saturating_sub(crate::ui::widget::width(&head));
    Line::raw(head + &clip(&parts.join(", "), room))
}
