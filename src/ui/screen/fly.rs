//! The flight screen: the swarm on top; telemetry, mission, ledger and notices below.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::State;
use crate::ui::look::Look;
use crate::ui::widget::{
    alerts, below, columns, ledger, map, mission, notices, swarm, telemetry, upper, urgent,
};

/// From this width on, telemetry and mission have a column each.
const THREE_COLUMNS: u16 = 160;
/// Columns of the telemetry pane, and of the mission below it.
const SIDE_WIDTH: u16 = 40;
/// Columns of the mission where it stands alone.
const MISSION_WIDTH: u16 = 56;
/// Rows that the telemetry pane needs above a mission.
const TELEMETRY_LEAST: u16 = 5;
/// Rows from which on the notices have a pane over the whole width.
const NOTICES_LEAST: u16 = 6;

/// A map smaller than this shows nothing worth its room.
const MAP_LEAST: (u16, u16) = (60, 9);
/// Rows of the notices below a map.
const NOTICES_MOST: u16 = 10;
/// Rows that the ledger keeps below a map.
const LEDGER_LEAST: u16 = 6;

pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    alerts::draw(state, look, upper(area, alerts::height(state)), buffer);
    let area = below(area, alerts::height(state));
    urgent::draw(state, look, upper(area, urgent::height(state)), buffer);
    let area = below(area, urgent::height(state));
    // Never more than half of the screen.
    let wanted = swarm::height(state, look, area.width);
    let rows = wanted.min(usize::from(area.height / 2)) as u16;
    swarm::draw(state, look, upper(area, rows), buffer);
    draw_panes(state, look, below(area, rows), buffer);
}

/// Draws what is below the table: where telemetry and mission leave rows free, the notices take them.
fn draw_panes(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let mut middle = side_height(state, look, area.width).max(area.height / 2);
    if area.width > SIDE_WIDTH + MAP_LEAST.0 {
        // The rows are worth more to the map than to old notices.
        middle = middle.max(area.height.saturating_sub(NOTICES_MOST));
    }
    let bottom = area.height.saturating_sub(middle);
    let panes = if bottom < NOTICES_LEAST {
        area
    } else {
        notices::draw(state, look, below(area, middle), buffer);
        upper(area, middle)
    };
    let log = draw_side(state, look, panes, buffer);
    let notices_too = bottom < NOTICES_LEAST;
    let log = draw_map(state, look, (log, notices_too), buffer);
    if notices_too {
        let rows = log.height / 2;
        ledger::draw(state, look, upper(log, rows), buffer);
        notices::draw(state, look, below(log, rows), buffer);
    } else {
        ledger::draw(state, look, log, buffer);
    }
}

/// Draws the map where there is room for it, and returns what is left below it.
fn draw_map(
    state: &State,
    look: &Look,
    (area, notices_too): (Rect, bool),
    buffer: &mut Buffer,
) -> Rect {
    let logs = if notices_too { 2 } else { 1 } * LEDGER_LEAST;
    let rows = area.height.saturating_sub(logs);
    if area.width < MAP_LEAST.0 || rows < MAP_LEAST.1 {
        return area;
    }
    map::draw(state, look, upper(area, rows), buffer);
    below(area, rows)
}

/// Rows that telemetry and mission need.
fn side_height(state: &State, look: &Look, width: u16) -> u16 {
    let telemetry = telemetry::height(state, look, SIDE_WIDTH).max(TELEMETRY_LEAST);
    match &state.session.mission {
        Some(progress) if width >= THREE_COLUMNS => {
            telemetry.max(mission::height(progress, MISSION_WIDTH, look))
        }
        Some(progress) => telemetry + mission::height(progress, SIDE_WIDTH, look),
        None => telemetry,
    }
}

/// Draws telemetry and mission and returns what is left beside them.
fn draw_side(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) -> Rect {
    let side = columns(area, 0, SIDE_WIDTH);
    let log = columns(area, SIDE_WIDTH + 1, area.width);
    let Some(progress) = &state.session.mission else {
        telemetry::draw(state, look, side, buffer);
        return log;
    };
    if area.width >= THREE_COLUMNS {
        telemetry::draw(state, look, side, buffer);
        mission::draw(state, look, columns(log, 0, MISSION_WIDTH), buffer);
        return columns(log, MISSION_WIDTH + 1, log.width);
    }
    let left = side
        .height
        .saturating_sub(mission::height(progress, side.width, look));
    let most = telemetry::height(state, look, side.width).max(TELEMETRY_LEAST);
    let rows = left.clamp(TELEMETRY_LEAST, most);
    telemetry::draw(state, look, upper(side, rows), buffer);
    mission::draw(state, look, below(side, rows), buffer);
    log
}
