//! The last line: what is being typed, else what the console has to say, else what the keys do.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{Room, State};
use crate::ui::look::Look;
use crate::ui::screen::{links, messages, parameters};
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, severity_role};

const HOME: &[(&str, &str)] = &[
    ("j k", "move"),
    ("Enter", "take"),
    (":", "command"),
    ("?", "help"),
    ("q", "quit"),
];
const FLY: &[(&str, &str)] = &[
    (":", "command"),
    ("?", "help"),
    ("j k", "move"),
    ("Space", "select"),
    ("3-9 Enter", "list"),
    ("*", "all"),
    ("Esc", "none"),
    ("c n", "look back"),
    ("L", "links"),
];
const MAP: &[(&str, &str)] = &[
    (":", "command"),
    ("?", "help"),
    ("hjkl", "cursor"),
    ("+ -", "zoom"),
    ("z", "all"),
    ("f", "follow"),
    ("g", "goto"),
    ("u", "ruler"),
    ("Tab", "vehicle"),
    ("i", "signs"),
    ("w", "trails"),
];
const DEBRIEF: &[(&str, &str)] = &[
    ("j k", "scroll"),
    ("r", "fly again"),
    ("h", "home screen"),
    (":", "command"),
    ("?", "help"),
];

/// Draws the footer into the last row of the screen.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let row = below(area, area.height.saturating_sub(1));
    put(buffer, row, 0, &line(state, look, usize::from(area.width)));
}

fn line<'a>(state: &'a State, look: &Look, width: usize) -> Line<'a> {
    if !state.typed.is_empty() {
        return Line::from(vec![
            Span::styled(" vehicles ", look.style(Role::Muted)),
            Span::styled(state.typed.as_str(), look.style(Role::Selected)),
            Span::styled(
                "_  Enter selects   a t g m h l r commands them   Esc drops",
                look.style(Role::Muted),
            ),
        ]);
    }
    if state.is_deaf() {
        return Line::styled(" keys work in a moment", look.style(Role::Muted));
    }
    if let Some(message) = state.message() {
        let role = severity_role(message.severity);
        return Line::styled(format!(" {}", look.text(&message.text)), look.style(role));
    }
    let mut spans = vec![Span::raw(" ")];
    let mut used = 1;
    for (key, what) in hints(state) {
        // Those that are no message yet are said as they are.
        let what = look.say(what);
        used += Span::raw(*key).width() + Span::raw(&what).width() + 3;
        if used > width {
            break;
        }
        spans.push(Span::styled(*key, look.style(Role::Key)));
        spans.push(Span::styled(format!(" {what}  "), look.style(Role::Muted)));
    }
    Line::from(spans)
}

/// What the keys of a room do.
fn hints(state: &State) -> &'static [(&'static str, &'static str)] {
    match state.room {
        Room::Home => HOME,
        Room::Debrief => DEBRIEF,
        Room::Map => MAP,
        Room::Messages => messages::HINTS,
        Room::Links => links::HINTS,
        Room::Parameters if state.rooms.parameters.comparison.is_some() => {
            parameters::COMPARISON_HINTS
        }
        Room::Parameters => parameters::HINTS,
        _ => FLY,
    }
}
