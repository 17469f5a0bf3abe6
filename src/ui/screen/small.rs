//! The screen of a terminal that is too small.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::state::SMALLEST;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{centred, put, wrap};

/// Shows the required and the current size.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let text = panel.text(&text!(
        "small-needs",
        columns = SMALLEST.0,
        rows = SMALLEST.1,
        now_columns = panel.area.width,
        now_rows = panel.area.height,
    ));
    let keys = panel.text(&text!(
        "small-keys",
        key = state.keymap().key(Action::Quit, Place::Anywhere)
    ));
    let lines = wrap(&format!("{text}\n{keys}"), usize::from(panel.area.width));
    let middle = centred(panel.area.width, lines.len() as u16, panel.area);
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, panel.style(Role::Warning)).centered();
        put(buffer, middle, row as u16, &line);
    }
}
