//! A sketch of a mission's site before the flight: its areas, its power lines, its places and its pads.

use std::collections::BTreeSet;

use ratatui::buffer::Buffer;
use unicode_width::UnicodeWidthStr as _;

use super::canvas::Canvas;
use super::ground::{WIRE, outline, sign, stroke};
use super::legend::draw_scale;
use crate::app::room::map::{PYLON, SketchKind};
use crate::geo::{Extent, GridSize, LatLon, Viewport};
use crate::mission::{AreaKind, Listing, is_pad};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// The margin around everything, as a share of the extent, and in metres.
const EDGE: (f64, f64) = (0.05, 10.0);
/// The maximum number of places shown; if there are more, they are the cells of a survey, whose area is drawn anyway.
const MOST_PLACES: usize = 8;

struct SketchWord {
    cell: (u16, u16),
    text: String,
    role: Role,
}

/// Draws the sketch into the whole panel; returns `false` if there is nothing to draw.
pub fn draw(mission: &Listing, panel: Panel<'_>, buffer: &mut Buffer) -> bool {
    let area = panel.area;
    let Some(extent) = extent(mission).filter(|_| !area.is_empty()) else {
        return false;
    };
    let extent = extent.with_margin(EDGE.0, EDGE.1);
    let size = GridSize {
        columns: area.width,
        rows: area.height,
    };
    let view = Viewport::new(extent.centre(), extent.zoom(size), size);
    let mut canvas = Canvas::new(size, panel.look.symbols);
    for zone in &mission.areas {
        let corners = zone.outline.corners();
        outline(
            &corners,
            &view,
            &mut canvas,
            stroke(SketchKind::of_area(zone.kind)),
        );
    }
    for pair in mission.wires.iter().flat_map(|wire| wire.pylons.windows(2)) {
        canvas.line(view.dot(pair[0]), view.dot(pair[1]), WIRE);
    }
    canvas.draw(panel, buffer);
    draw_words(&words(mission, &view), panel, buffer);
    draw_scale(panel.look, &view, area, buffer);
    true
}

/// The extent of the sketch; the fence counts only if there is nothing else.
fn extent(mission: &Listing) -> Option<Extent> {
    let inside = mission
        .areas
        .iter()
        .filter(|zone| zone.kind != AreaKind::Geofence);
    let corners = inside.flat_map(|zone| zone.outline.corners());
    let pylons = mission.wires.iter().flat_map(|wire| &wire.pylons).copied();
    let places = mission.places.values().copied();
    let within = Extent::around(corners.chain(pylons).chain(places));
    let has_size = |it: &Extent| it.size_m().iter().any(|&side_m| side_m > 1.0);
    let all = mission.areas.iter().flat_map(|zone| zone.outline.corners());
    within.filter(has_size).or_else(|| Extent::around(all))
}

/// The labels: pads first, then places, then areas; if labels overlap, the first one stays.
fn words(mission: &Listing, view: &Viewport) -> Vec<SketchWord> {
    let word = |at: LatLon, text: String, role| {
        let cell = view.cell(at)?;
        Some(SketchWord { cell, text, role })
    };
    let (pads, places): (Vec<_>, Vec<_>) =
        mission.places.iter().partition(|(name, _)| is_pad(name));
    let pads = pads
        .into_iter()
        .filter_map(|(_, &at)| word(at, "H".to_owned(), Role::Title));
    let few = if places.len() > MOST_PLACES {
        0
    } else {
        places.len()
    };
    let places = places
        .into_iter()
        .take(few)
        .filter_map(|(name, &at)| word(at, format!("+{name}"), Role::Info));
    let pylons = mission.wires.iter().flat_map(|wire| &wire.pylons);
    let pylons = pylons.filter_map(|&at| word(at, PYLON.to_owned(), WIRE.role));
    let areas = mission.areas.iter().filter_map(|zone| {
        let kind = SketchKind::of_area(zone.kind);
        let corners = zone.outline.corners().into_iter();
        let cells = corners.filter_map(|corner| view.cell(corner));
        let (column, row) = cells.min_by_key(|&(column, row)| (row, column))?;
        Some(SketchWord {
            cell: (column + 1, row),
            text: format!("{}{}", sign(kind), zone.name),
            role: stroke(kind).role,
        })
    });
    pads.chain(places).chain(pylons).chain(areas).collect()
}

fn draw_words(words: &[SketchWord], panel: Panel<'_>, buffer: &mut Buffer) {
    let mut taken: BTreeSet<(u16, u16)> = BTreeSet::new();
    for word in words {
        let ((column, row), width) = (word.cell, word.text.width() as u16);
        let mut cells = (column..column + width).map(|at| (row, at));
        if column + width > panel.area.width || cells.any(|cell| taken.contains(&cell)) {
            continue;
        }
        taken.extend((column.saturating_sub(1)..=column + width).map(|at| (row, at)));
        let (x, y) = (panel.area.x + column, panel.area.y + row);
        let style = panel.style(Role::Text).patch(panel.style(word.role));
        buffer.set_string(x, y, &word.text, style);
    }
}
