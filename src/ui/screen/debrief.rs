//! The debrief.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::debrief::{TEXT_WIDTH, is_section};
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_truth;
use crate::ui::widget::{below, centred, columns, put};

/// Draws the text from the first line shown on; the last page stays full.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let Some(debrief) = &state.rooms.debrief else {
        let line = Line::styled(look.say("debrief-none"), look.style(Role::Muted));
        put(buffer, below(area, 1), 0, &line);
        return;
    };
    let beside = debrief.is_beside(area.width);
    if beside {
        let truth = columns(area, TEXT_WIDTH + 1, area.width);
        draw_truth(&debrief.report.truth, look, truth, buffer);
    } else if debrief.map {
        return draw_truth(&debrief.report.truth, look, area, buffer);
    }
    let area = if beside {
        columns(area, 0, TEXT_WIDTH)
    } else {
        area
    };
    let (lines, scroll) = (
        debrief.lines(state.reward.as_ref(), &look.locale),
        debrief.scroll,
    );
    let column = centred(TEXT_WIDTH, area.height, area);
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
            &Line::styled(line.as_str(), look.style(role)),
        );
    }
}
