//! The map: the swarm and the ground below it, from above.
//!
//! # How the parts fit
//! - `canvas` turns dots into braille, half blocks or ASCII; `squares` turns ground into cells.
//! - From the bottom up: `swept` (searched ground), `heat` (readings), `fire`; then the lines and words of `ground`
//!   (areas, homes), `ways` (trails and targets), `traffic` and `finds` (contacts and reports), which `labels`
//!   places; then `markers` (vehicles, on a `board` of free cells) and `legend` (the scale).
//! - Other maps: `plain` (places that are given), `drafts` (the plans room), `sketch` (a mission before the flight), `truth` (the debrief).

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use board::NumberSpots;

use crate::app::State;
use crate::app::room::map::{Aim, Sketch, SketchKind, sketches};
use crate::geo::{GridSize, LatLon, Viewport};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, centred, put, row_of, wrap};

mod board;
mod canvas;
mod drafts;
mod finds;
mod fire;
mod ground;
mod heat;
mod labels;
mod legend;
mod markers;
mod plain;
mod sketch;
mod squares;
mod swept;
mod traffic;
mod truth;
mod ways;

pub use canvas::{Canvas, Stroke};
pub use drafts::draw as draw_drafts;
pub use ground::next_place;
pub use labels::stamp;
pub use legend::{draw as draw_legend, length};
pub use plain::{MapSign, PlainMap};
pub use sketch::draw as draw_site;
pub use truth::draw as draw_truth;

/// Draws the map as a pane with a title.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = below(panel.area, 1);
    let Some(view) = state
        .rooms()
        .map()
        .view(GridSize::new(inner.width, inner.height))
    else {
        panel.titled(&panel.say("map-title"), buffer);
        return draw_nowhere(panel.at(inner), buffer);
    };
    let outside = draw_view(state, panel.look, &view, inner, buffer);
    panel.titled(&title(state, panel.look, &view, outside), buffer);
}

fn title(state: &State, look: &Look, view: &Viewport, outside: usize) -> String {
    let aim = state.rooms().map().aim();
    let mut title = vec![look.say("map-title")];
    match (aim, state.session().cursor()) {
        (Aim::All, _) => title.push(look.say(in_view(&sketches(state), view))),
        (Aim::Vehicle(..), Some(id)) => {
            title.push(look.text(&text!("map-follows", vehicle = id)));
        }
        _ => {}
    }
    if outside > 0 {
        title.push(look.text(&text!("map-outside", count = outside)));
    }
    title.join("  ")
}

/// What the view of everything contains: fences and the radio's shadows do not widen it.
fn in_view(sketches: &[Sketch], view: &Viewport) -> &'static str {
    let is_whole = |sketch: &&Sketch| {
        let mut points = sketch.points.iter();
        points.all(|&point| view.cell(point).is_some())
    };
    let (shown, cut): (Vec<&Sketch>, Vec<&Sketch>) = sketches.iter().partition(is_whole);
    let is_task = |sketch: &&Sketch| sketch.kind == SketchKind::Task;
    if cut.is_empty() {
        "map-all"
    } else if shown.iter().any(is_task) && !cut.iter().any(is_task) {
        "map-task-in-view"
    } else {
        "map-vehicles-in-view"
    }
}

/// Draws the content of a view, with its scale; returns the number of vehicles out of sight.
fn draw_view(
    state: &State,
    look: &Look,
    view: &Viewport,
    area: Rect,
    buffer: &mut Buffer,
) -> usize {
    let panel = Panel::new(look, area);
    swept::draw(state, view, panel, buffer);
    let field = state.rooms().map().field();
    if let Some((_, field)) = field {
        heat::draw(field, view, panel, buffer);
    }
    fire::draw(state, view, panel, buffer);
    let labels = ground::draw(state, look, view, area, buffer);
    let vehicles = markers::draw(state, view, panel, NumberSpots::Around, buffer);
    labels::draw(labels, &vehicles.cells, panel, buffer);
    legend::draw_scale(look, view, area, buffer);
    let mut last = area.height.saturating_sub(1);
    if let Some((_, field)) = field {
        heat::draw_scale(field, panel.at(row_of(area, last)), buffer);
        last = last.saturating_sub(1);
    }
    if fire::is_any(state) {
        fire::draw_scale(state, view, panel.at(row_of(area, last)), buffer);
    }
    vehicles.outside
}

/// Draws the map's cursor over ground and lines. Letters, numbers, and signs of vehicles stay and are highlighted, unless
/// the sign is highlighted already.
pub fn draw_cursor(
    state: &State,
    view: &Viewport,
    cursor: LatLon,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let Some((column, row)) = view.cell(cursor) else {
        return;
    };
    let listed = state.session().under_cursor().and_then(|it| it.global);
    let is_listed = listed.and_then(|it| view.cell(it.at_point)) == Some((column, row));
    let is_vehicle = ground::vehicle_cells(state, view).contains(&(column, row));
    if let Some(cell) = buffer.cell_mut((panel.area.x + column, panel.area.y + row)) {
        let is_written = cell.symbol().starts_with(char::is_alphanumeric);
        if is_listed || !(is_vehicle || is_written) {
            cell.set_char('┼');
        }
        cell.set_style(panel.style(Role::Cursor));
    }
}

/// Shows that nothing has a position yet.
fn draw_nowhere(panel: Panel<'_>, buffer: &mut Buffer) {
    let lines = wrap(&panel.say("map-nowhere"), usize::from(panel.area.width));
    let middle = centred(panel.area.width, lines.len() as u16, panel.area);
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, panel.style(Role::Muted)).centered();
        put(buffer, middle, row as u16, &line);
    }
}
