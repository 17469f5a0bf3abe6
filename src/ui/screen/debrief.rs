//! The debrief.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::ui::theme::{Role, Theme};
use crate::ui::widget::{centred, put};

/// Columns that the text is made for.
const TEXT_WIDTH: u16 = 80;

/// Draws the text from the line `scroll` on; the last page stays full.
pub fn draw(lines: &[String], scroll: usize, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let column = centred(TEXT_WIDTH, area.height, area);
    let rows = usize::from(column.height);
    let first = scroll.min(lines.len().saturating_sub(rows));
    for (row, line) in lines.iter().skip(first).take(rows).enumerate() {
        // The debrief writes the names of its sections in capitals, after one blank.
        let section = line.starts_with(' ') && line.chars().skip(1).take(2).all(char::is_uppercase);
        let role = if section { Role::Title } else { Role::Text };
        put(
            buffer,
            column,
            row as u16,
            &Line::styled(line.as_str(), theme.style(role)),
        );
    }
}
