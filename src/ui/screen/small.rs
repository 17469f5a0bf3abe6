//! What is shown when the terminal is too small for anything else.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::app::state::SMALLEST;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{centred, put, wrap};

/// Says which size is needed and what it is now.
pub fn draw(look: &Look, area: Rect, buffer: &mut Buffer) {
    let text = format!(
        "sortie needs {}x{}, this terminal is {}x{}",
        SMALLEST.0, SMALLEST.1, area.width, area.height
    );
    let keys = "Until it is larger only Ctrl-C works: it leaves the program.";
    let lines = wrap(&format!("{text}\n{keys}"), usize::from(area.width));
    let middle = centred(area.width, lines.len() as u16, area);
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, look.style(Role::Warning)).centered();
        put(buffer, middle, row as u16, &line);
    }
}
