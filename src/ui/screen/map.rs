//! The map room: the canvas, its cursor, and a description of the place under it.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::room::map::LEGEND_WIDTH;
use crate::geo::{GridSize, LatLon, Viewport};
use crate::text::figure;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::{
    draw as draw_map, draw_cursor, draw_legend, length, next_place, stamp,
};
use crate::ui::widget::{
    below, clip_rows, columns, mission, put, row_of, upper, urgent, width as width_of, wrap,
};

const LESSON_ROWS: usize = 3;
/// The width of the north mark with a gap, in columns.
const NORTH_MARK: u16 = 4;
const SCALE_ROWS: u16 = 2;
/// The free columns after the text of the task.
const TASK_GAP: u16 = 3;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let map = state.rooms().map();
    let pane = upper(panel.area, panel.area.height.saturating_sub(1));
    let (pane, legend) = if map.shows_legend(state.display().grid()) {
        let width = panel.area.width.saturating_sub(LEGEND_WIDTH);
        (
            columns(pane, 0, width),
            columns(pane, width + 1, LEGEND_WIDTH),
        )
    } else {
        (pane, columns(pane, 0, 0))
    };
    draw_map(state, panel.at(pane), buffer);
    let canvas = below(pane, 1);
    let view = map.view(GridSize::new(canvas.width, canvas.height));
    if legend.width > 0 {
        draw_legend(state, view.as_ref(), panel.at(legend), buffer);
    }
    // Alerts are drawn over the north of the map, because a map that moved with every alert would be unreadable.
    urgent::draw(
        state,
        panel.at(upper(canvas, urgent::height(state))),
        buffer,
    );
    if let Some(view) = view {
        draw_task(state, &view, panel.at(canvas), buffer);
        let cursor = map.pointed(&view);
        draw_cursor(state, &view, cursor, panel.at(canvas), buffer);
        let whole = place_line(state, panel.look, cursor, true);
        let line = if whole.width() > usize::from(panel.area.width) {
            place_line(state, panel.look, cursor, false)
        } else {
            whole
        };
        put(
            buffer,
            row_of(panel.area, panel.area.height.saturating_sub(1)),
            0,
            &line,
        );
    }
}

/// Draws the step of a lesson, otherwise the next open objective, so a trainee need not leave the
/// map to read it. The text is placed where it does not cover its target.
fn draw_task(state: &State, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = panel.columns(0, panel.area.width.saturating_sub(NORTH_MARK));
    let step = state.session().mission().and_then(mission::lesson);
    let (text, most, role) = match (step, mission::next_objective(state)) {
        (Some(step), _) => (step, LESSON_ROWS, Role::Accent),
        (None, Some(objective)) => (objective, 1, Role::Text),
        (None, None) => return,
    };
    let lines = clip_rows(wrap(&panel.text(&text), room.width()), most, room.width());
    let (rows, top) = (lines.len() as u16, urgent::height(state));
    let next = next_place(state).and_then(|at| view.cell(at));
    let is_over_next = next.is_some_and(|(_, row)| row <= top + rows);
    let first = if is_over_next {
        panel.area.height.saturating_sub(rows + SCALE_ROWS)
    } else {
        top
    };
    for (row, line) in (first..).zip(&lines) {
        let here = room.at(row_of(room.area, row));
        // Lines and names of the map would look like a part of the text; beside it, they stay.
        let written = here.columns(0, width_of(line) as u16 + TASK_GAP);
        written.clear(buffer);
        stamp(line, panel.style(role), here, buffer);
    }
}

/// The cursor's position: coordinates, offset from home if that fits, and the distances from the vehicle and from the
/// ruler's start.
fn place_line(state: &State, look: &Look, cursor: LatLon, with_home: bool) -> Line<'static> {
    let muted = |id: &str| Span::styled(format!("{} ", look.say(id)), look.style(Role::Muted));
    let way = |from: LatLon| {
        let bearing = from.bearing_deg(cursor).round() % 360.0;
        format!("{} {bearing:03.0}°   ", length(from.distance_m(cursor)))
    };
    let mut spans = vec![Span::raw(format!(
        "{:.6} {:.6}   ",
        cursor.lat_deg, cursor.lon_deg
    ))];
    let vehicle = state.session().under_cursor();
    let homes = state.session().vehicles().values().find_map(|it| it.home);
    if let Some(home) = vehicle.and_then(|it| it.home).or(homes)
        && with_home
    {
        let (north_m, east_m) = home.at_point.offset_to(cursor);
        spans.push(muted("map-from-home"));
        spans.push(Span::raw(format!(
            "n {} e {} m   ",
            figure(north_m, 0),
            figure(east_m, 0)
        )));
    }
    if let Some((vehicle, global)) = vehicle.and_then(|it| Some((it, it.global?))) {
        spans.push(muted("map-from-vehicle"));
        spans.push(Span::raw(format!(
            "{} {}",
            vehicle.id,
            way(global.at_point)
        )));
    }
    if let Some(mark) = state.rooms().map().mark() {
        spans.push(muted("map-ruler"));
        spans.push(Span::styled(way(mark), look.style(Role::Key)));
    }
    Line::from(spans)
}
