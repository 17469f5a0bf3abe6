//! What is shown when the terminal is too small for anything else.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::state::SMALLEST;
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{centred, put, wrap};

/// Says which size is needed and what it is now.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let text = look.text(&text!(
        "small-needs",
        columns = SMALLEST.0,
        rows = SMALLEST.1,
        now_columns = area.width,
        now_rows = area.height,
    ));
    let keys = look.text(&text!(
        "small-keys",
        key = state.keymap.key(Action::Quit, Place::Anywhere)
    ));
    let lines = wrap(&format!("{text}\n{keys}"), usize::from(area.width));
    let middle = centred(area.width, lines.len() as u16, area);
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, look.style(Role::Warning)).centered();
        put(buffer, middle, row as u16, &line);
    }
}
