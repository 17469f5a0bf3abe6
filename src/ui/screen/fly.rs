//! The flight screen: the swarm on top; telemetry, mission, ledger and notices below.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::State;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::widget::telemetry::Detail;
use crate::ui::widget::{
    alerts, below, columns, footer, ledger, map, mission, notices, swarm, telemetry, upper, urgent,
};

/// The minimum width for separate columns of telemetry and mission, and for the detailed telemetry.
const THREE_COLUMNS: u16 = 160;
/// The width of the telemetry pane, and of the mission below it, in columns.
const SIDE_WIDTH: u16 = 40;
/// The width of the mission in a column of its own.
const MISSION_WIDTH: u16 = 56;
/// The number of rows that the table keeps beside a long hint.
const TABLE_LEAST: u16 = 3;
/// The minimum number of rows of the telemetry pane above a mission, unless a long hint needs them.
const TELEMETRY_LEAST: u16 = 5;
/// The minimum number of rows of a notices pane over the whole width.
const NOTICES_LEAST: u16 = 6;

/// The minimum size of a useful map.
const MAP_LEAST: (u16, u16) = (60, 9);
/// The maximum number of rows of the notices below a map.
const NOTICES_MOST: u16 = 10;
/// The number of rows that the ledger keeps below a map.
const LEDGER_LEAST: u16 = 6;

pub fn draw(state: &State, whole: Panel<'_>, buffer: &mut Buffer) {
    let hint_rows = hint_height(state, whole.look, whole.area.width);
    let panel = if hint_rows > 0 {
        // A long message must not cover the hint.
        let covered = footer::height(state, whole).saturating_sub(1);
        whole.upper(whole.area.height.saturating_sub(covered))
    } else {
        whole
    };
    let alert_rows = alerts::height(state);
    alerts::draw(state, panel.upper(alert_rows), buffer);
    let below_alerts = panel.below(alert_rows);
    let urgent_rows = urgent::height(state);
    urgent::draw(state, below_alerts.upper(urgent_rows), buffer);
    let body = below_alerts.below(urgent_rows);
    // The table gets at most half of the screen, and leaves the hint its rows.
    let wanted = swarm::height(state, body.look, body.area.width);
    let left = body.area.height.saturating_sub(hint_rows);
    let most = (body.area.height / 2).min(left.max(TABLE_LEAST));
    let rows = wanted.min(usize::from(most)) as u16;
    swarm::draw(state, body.upper(rows), buffer);
    draw_panes(state, body.below(rows), buffer);
}

/// The number of rows of the mission's hint with the pane's title; 0 without a hint.
fn hint_height(state: &State, look: &Look, width: u16) -> u16 {
    let columns = if width >= THREE_COLUMNS {
        MISSION_WIDTH
    } else {
        SIDE_WIDTH
    };
    let progress = state.session().mission();
    progress.map_or(0, |progress| mission::hint_height(progress, columns, look))
}

/// Draws the panes below the table; the notices get the rows that telemetry and mission leave free.
fn draw_panes(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let mut middle = side_height(state, panel.look, panel.area.width).max(panel.area.height / 2);
    if panel.area.width > SIDE_WIDTH + MAP_LEAST.0 {
        // The map needs the rows more than old notices do.
        middle = middle.max(panel.area.height.saturating_sub(NOTICES_MOST));
    }
    let bottom = panel.area.height.saturating_sub(middle);
    let panes = if bottom < NOTICES_LEAST {
        panel.area
    } else {
        notices::draw(state, panel.below(middle), buffer);
        upper(panel.area, middle)
    };
    let SidePanes {
        beside,
        below: free,
    } = draw_side(state, panel.at(panes), buffer);
    let notices_too = bottom < NOTICES_LEAST;
    if !notices_too && free.height >= LEDGER_LEAST && is_map_size(beside) {
        // The map gets all rows of its columns.
        ledger::draw(state, panel.at(free), buffer);
        map::draw(state, panel.at(beside), buffer);
        return;
    }
    let log = draw_map(state, panel.at(beside), notices_too, buffer);
    if notices_too {
        let rows = log.height / 2;
        ledger::draw(state, panel.at(upper(log, rows)), buffer);
        notices::draw(state, panel.at(below(log, rows)), buffer);
    } else {
        ledger::draw(state, panel.at(log), buffer);
    }
}

/// The areas that telemetry and mission leave free.
struct SidePanes {
    /// To the right of both.
    beside: Rect,
    /// Below both on a wide screen; otherwise empty.
    below: Rect,
}

fn is_map_size(area: Rect) -> bool {
    area.width >= MAP_LEAST.0 && area.height >= MAP_LEAST.1
}

/// Draws the map if there is room, and returns the area below it.
fn draw_map(state: &State, panel: Panel<'_>, notices_too: bool, buffer: &mut Buffer) -> Rect {
    let logs = if notices_too { 2 } else { 1 } * LEDGER_LEAST;
    let rows = panel.area.height.saturating_sub(logs);
    if !is_map_size(upper(panel.area, rows)) {
        return panel.area;
    }
    map::draw(state, panel.upper(rows), buffer);
    below(panel.area, rows)
}

fn detail(width: u16) -> Detail {
    if width >= THREE_COLUMNS {
        Detail::Engineer
    } else {
        Detail::Pilot
    }
}

/// The height of telemetry and mission, in rows.
fn side_height(state: &State, look: &Look, width: u16) -> u16 {
    let telemetry = telemetry::height(state, look, SIDE_WIDTH, detail(width)).max(TELEMETRY_LEAST);
    match state.session().mission() {
        Some(progress) if width >= THREE_COLUMNS => {
            telemetry.max(mission::height(progress, MISSION_WIDTH, look))
        }
        Some(progress) => telemetry + mission::height(progress, SIDE_WIDTH, look),
        None => telemetry,
    }
}

/// Draws the telemetry alone on a wide screen, and returns the remaining areas: the map beside it
/// and the ledger below it use the rows that a mission would take.
fn draw_telemetry(
    state: &State,
    panel: Panel<'_>,
    detail: Detail,
    buffer: &mut Buffer,
) -> SidePanes {
    let side = columns(panel.area, 0, MISSION_WIDTH);
    let used = telemetry::height(state, panel.look, MISSION_WIDTH, detail).min(side.height);
    telemetry::draw(state, panel.at(upper(side, used)), detail, buffer);
    SidePanes {
        beside: columns(panel.area, MISSION_WIDTH + 1, panel.area.width),
        below: below(side, used),
    }
}

/// Draws telemetry and mission, and returns the remaining areas.
fn draw_side(state: &State, panel: Panel<'_>, buffer: &mut Buffer) -> SidePanes {
    let side = columns(panel.area, 0, SIDE_WIDTH);
    let log = columns(panel.area, SIDE_WIDTH + 1, panel.area.width);
    let detail = detail(panel.area.width);
    let only_beside = |beside: Rect| SidePanes {
        beside,
        below: upper(beside, 0),
    };
    let Some(progress) = state.session().mission() else {
        if panel.area.width >= THREE_COLUMNS {
            return draw_telemetry(state, panel, detail, buffer);
        }
        telemetry::draw(state, panel.at(side), detail, buffer);
        return only_beside(log);
    };
    if panel.area.width >= THREE_COLUMNS {
        telemetry::draw(state, panel.at(side), detail, buffer);
        mission::draw(state, panel.at(columns(log, 0, MISSION_WIDTH)), buffer);
        let used = side_height(state, panel.look, panel.area.width).min(panel.area.height);
        let both = columns(panel.area, 0, SIDE_WIDTH + 1 + MISSION_WIDTH);
        return SidePanes {
            beside: columns(log, MISSION_WIDTH + 1, log.width),
            below: below(both, used),
        };
    }
    let left = side
        .height
        .saturating_sub(mission::height(progress, side.width, panel.look));
    let most = telemetry::height(state, panel.look, side.width, detail).max(TELEMETRY_LEAST);
    let hint = mission::hint_height(progress, side.width, panel.look);
    let beside_hint = side.height.saturating_sub(hint);
    let rows = left.clamp(TELEMETRY_LEAST, most).min(beside_hint);
    telemetry::draw(state, panel.at(upper(side, rows)), detail, buffer);
    mission::draw(state, panel.at(below(side, rows)), buffer);
    only_beside(log)
}
