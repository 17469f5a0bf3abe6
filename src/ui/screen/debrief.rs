//! The debrief.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::debrief::{TEXT_WIDTH, is_section};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_truth;
use crate::ui::widget::{below, centred, columns, put};

/// Draws the text from the first line shown on; the last page stays full.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(debrief) = state.rooms().debrief() else {
        let line = Line::styled(panel.say("debrief-none"), panel.style(Role::Muted));
        put(buffer, below(panel.area, 1), 0, &line);
        return;
    };
    let beside = debrief.is_beside(panel.area.width);
    if beside {
        let truth = columns(panel.area, TEXT_WIDTH + 1, panel.area.width);
        draw_truth(&debrief.report().truth, panel.at(truth), buffer);
    } else if debrief.shows_map() {
        return draw_truth(&debrief.report().truth, panel, buffer);
    }
    let page = if beside {
        columns(panel.area, 0, TEXT_WIDTH)
    } else {
        panel.area
    };
    let (lines, scroll) = (
        debrief.lines(state.reward(), &panel.look.locale),
        debrief.scroll(),
    );
    let column = centred(TEXT_WIDTH, page.height, page);
    let rows = usize::from(column.height);
    let first = scroll.min(lines.len().saturating_sub(rows));
    for (row, line) in lines.iter().skip(first).take(rows).enumerate() {
        let role = if is_section(line) {
            Role::Title
        } else {
            Role::Text
        };
        put(
            buffer,
            column,
            row as u16,
            &Line::styled(line.as_str(), panel.style(role)),
        );
    }
    panel.at(column).mark_scroll(first, lines.len(), buffer);
}
