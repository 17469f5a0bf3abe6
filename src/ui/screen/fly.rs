//! The flight screen: the swarm on top; telemetry, mission, ledger and notices below.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::state::State;
use crate::ui::theme::Theme;
use crate::ui::widget::{below, columns, ledger, mission, notices, swarm, telemetry, upper};

/// From this width on, telemetry and mission have a column each.
const THREE_COLUMNS: u16 = 160;
/// Columns of the telemetry pane, and of the mission below it.
const SIDE_WIDTH: u16 = 40;
/// Columns of the mission where it stands alone.
const MISSION_WIDTH: u16 = 56;
/// Rows of the telemetry pane above a mission: what it needs, and what it can fill.
const TELEMETRY_LEAST: u16 = 5;
const TELEMETRY_MOST: u16 = 16;

/// Draws the panes.
pub fn draw(state: &State, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    // Never more than half of the screen.
    let wanted = swarm::height(&state.session, area.width);
    let rows = wanted.min(usize::from(area.height / 2)) as u16;
    swarm::draw(state, theme, upper(area, rows), buffer);
    let rest = below(area, rows);
    let side = columns(rest, 0, SIDE_WIDTH);
    let mut log = columns(rest, SIDE_WIDTH + 1, rest.width);
    if let Some(progress) = &state.session.mission {
        let middle = columns(log, 0, MISSION_WIDTH);
        if area.width >= THREE_COLUMNS {
            log = columns(log, MISSION_WIDTH + 1, log.width);
            telemetry::draw(state, theme, side, buffer);
            mission::draw(state, theme, middle, buffer);
        } else {
            let left = side
                .height
                .saturating_sub(mission::height(progress, side.width));
            let rows = left.clamp(TELEMETRY_LEAST, TELEMETRY_MOST);
            telemetry::draw(state, theme, upper(side, rows), buffer);
            mission::draw(state, theme, below(side, rows), buffer);
        }
    } else {
        telemetry::draw(state, theme, side, buffer);
    }
    let rows = log.height / 2;
    ledger::draw(state, theme, upper(log, rows), buffer);
    notices::draw(state, theme, below(log, rows), buffer);
}
