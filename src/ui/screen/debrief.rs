//! The debrief: the result at a glance, the text, and the map of the truth.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::debrief::TEXT_WIDTH;
use crate::debrief::{DebriefTone, TimelineMark};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_truth;
use crate::ui::widget::{below, centred, columns, put, wrap};

mod summary;

/// The number of rows outside the room: header and footer.
const HEADER_AND_FOOTER: u16 = 2;

/// Draws the text from its first visible line; scrolling ends when the last line is at the bottom.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(debrief) = state.rooms().debrief().shown() else {
        return draw_nothing(panel, buffer);
    };
    let beside = debrief.is_beside(panel.area.width);
    if beside {
        // The scroll marks of the text stand in the gap, apart from the map's legend.
        let truth = columns(panel.area, TEXT_WIDTH + 2, panel.area.width);
        draw_truth(&debrief.report().truth, panel.at(truth), buffer);
    } else if debrief.shows_map() {
        return draw_truth(&debrief.report().truth, panel, buffer);
    }
    let page = if beside {
        columns(panel.area, 0, TEXT_WIDTH)
    } else {
        panel.area
    };
    let height = panel.area.height + HEADER_AND_FOOTER;
    let lines = debrief.lines_below(state.debrief_reward(), &panel.look.locale);
    let page = panel.at(centred(TEXT_WIDTH, page.height, page));
    let summary = debrief.summary(height);
    summary::draw(debrief, summary, page.upper(summary.rows), buffer);
    let column = page.below(summary.rows).area;
    let rows = usize::from(column.height);
    let first = debrief.scroll().min(lines.len().saturating_sub(rows));
    for (row, line) in lines.iter().skip(first).take(rows).enumerate() {
        let role = tone_role(line.tone, debrief.report().passed);
        let line = Line::styled(line.text.as_str(), panel.style(role));
        put(buffer, column, row as u16, &line);
    }
    panel.at(column).mark_scroll(first, lines.len(), buffer);
}

/// Draws the reason why there is no debrief.
fn draw_nothing(panel: Panel<'_>, buffer: &mut Buffer) {
    let place = below(panel.area, 1);
    let lines = wrap(&panel.say("debrief-none"), panel.width());
    for (row, line) in (0..).zip(lines) {
        put(
            buffer,
            place,
            row,
            &Line::styled(line, panel.style(Role::Muted)),
        );
    }
}

fn tone_role(tone: DebriefTone, passed: bool) -> Role {
    match tone {
        DebriefTone::Head if passed => Role::Ok,
        DebriefTone::Head | DebriefTone::Bad => Role::Danger,
        DebriefTone::Heading => Role::Title,
        DebriefTone::Plain => Role::Text,
        DebriefTone::Good => Role::Ok,
        DebriefTone::Gain => Role::Accent,
        DebriefTone::Event(mark) => event_role(mark),
    }
}

fn event_role(mark: TimelineMark) -> Role {
    match mark {
        TimelineMark::Command => Role::Muted,
        TimelineMark::Remark => Role::Text,
        TimelineMark::Objective => Role::Ok,
        TimelineMark::Alert => Role::Warning,
        TimelineMark::Rejected | TimelineMark::Rule => Role::Danger,
    }
}
