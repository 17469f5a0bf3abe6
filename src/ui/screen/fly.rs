//! The flight screen: the swarm on top; telemetry, mission, ledger and notices below.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::state::State;
use crate::ui::theme::Theme;
use crate::ui::widget::{below, ledger, mission, notices, swarm, telemetry};

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
    let vehicles = state.session.vehicles.len().min(usize::from(u16::MAX)) as u16;
    // A rule, the column titles and at least four rows; never more than half of the screen.
    let wanted = vehicles.max(4) + 2;
    let table = Rect {
        height: wanted.min(area.height / 2),
        ..area
    };
    swarm::draw(state, theme, table, buffer);
    let rest = below(area, table.height);
    let side = Rect {
        width: SIDE_WIDTH,
        ..rest
    };
    let mut log = after(rest, side);
    if state.session.mission.is_none() {
        telemetry::draw(state, theme, side, buffer);
    } else if area.width >= THREE_COLUMNS {
        let middle = Rect {
            width: MISSION_WIDTH,
            ..log
        };
        log = after(log, middle);
        telemetry::draw(state, theme, side, buffer);
        mission::draw(state, theme, middle, buffer);
    } else {
        let wanted = state
            .session
            .mission
            .as_ref()
            .map_or(0, |it| mission::height(it, side.width));
        let left = side.height.saturating_sub(wanted);
        let rows = left.clamp(TELEMETRY_LEAST, TELEMETRY_MOST);
        telemetry::draw(
            state,
            theme,
            Rect {
                height: rows,
                ..side
            },
            buffer,
        );
        mission::draw(state, theme, below(side, rows), buffer);
    }
    let rows = log.height / 2;
    ledger::draw(
        state,
        theme,
        Rect {
            height: rows,
            ..log
        },
        buffer,
    );
    notices::draw(state, theme, below(log, rows), buffer);
}

/// What is left of `area` to the right of `column`, one column of space between.
fn after(area: Rect, column: Rect) -> Rect {
    let x = (column.right() + 1).min(area.right());
    Rect {
        x,
        width: area.right() - x,
        ..area
    }
}
