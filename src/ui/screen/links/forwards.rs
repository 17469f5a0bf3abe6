//! The forwards: other ground stations that use the links.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::state::{Activity, ForwardSummary};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put};

/// The width of the figures after the name, in columns.
const FIGURES: usize = 58;
const FRAME_ROWS: u16 = 2;

/// Draws a line for each forward; returns the area below them.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let forwards = state.session().forwards();
    let most = (panel.area.height / 3).max(FRAME_ROWS + 2);
    let rows = (forwards.len() as u16 + FRAME_ROWS + 1).min(most);
    let whole = panel.upper(rows);
    let is_mission = matches!(state.session().activity(), Some(Activity::Mission { .. }));
    let title = if is_mission {
        panel.say("forwards-title-mission")
    } else {
        panel.say("forwards-title")
    };
    let inner = whole.titled(&title, buffer);
    let name_width = usize::from(inner.width).saturating_sub(FIGURES);
    let head = format!(
        "{:name_width$} {:>8} {:>9} {:>9} {:>7} {:>8}  {}",
        panel.say("links-address"),
        panel.say("forwards-stations"),
        panel.say("forwards-received"),
        panel.say("forwards-sent"),
        panel.say("forwards-dropped"),
        panel.say("forwards-left-out"),
        panel.say("links-state")
    );
    put(
        buffer,
        inner,
        0,
        &Line::styled(head, panel.style(Role::Muted)),
    );
    let room = usize::from(inner.height.saturating_sub(1));
    for (row, forward) in forwards.iter().take(room).enumerate() {
        let line = line(forward, name_width, panel.look);
        put(buffer, inner, row as u16 + 1, &line);
    }
    below(panel.area, rows)
}

fn line(forward: &ForwardSummary, name_width: usize, look: &Look) -> Line<'static> {
    let figures = format!(
        "{:name_width$} {:>8} {:>9} {:>9} {:>7} {:>8}  ",
        clip(&forward.name, name_width),
        forward.peers,
        forward.received_messages,
        forward.sent_messages,
        forward.dropped,
        forward.filtered + forward.held_back + forward.repeated,
    );
    let (state, role) = match (&forward.error, forward.up) {
        (_, true) => (look.say("links-up"), Role::Ok),
        (Some(error), false) => (look.text(error), Role::Danger),
        (None, false) => (look.say("links-down"), Role::Danger),
    };
    Line::from(vec![
        Span::raw(figures),
        Span::styled(state, look.style(role)),
    ])
}
