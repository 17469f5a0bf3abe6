//! A map without controls, of places that are given: for the desk of a class.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::canvas::{Canvas, Stroke};
use super::ground::{WIRE, outline};
use super::labels::stamp;
use super::legend::draw_scale;
use crate::geo::{Extent, GridSize, LatLon, Viewport};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::width as width_of;
use crate::vehicle_id::{VehicleId, ranges};

/// The margin around everything, as a share of the extent, and in metres.
const EDGE: (f64, f64) = (0.06, 8.0);
const FENCE: Stroke = Stroke::dashed(Role::Fence);
/// The least width of a map that has a scale.
const SCALE_FROM: u16 = 24;

/// What a plain map shows; everything fits it.
#[derive(Debug, Default)]
pub struct PlainMap {
    /// Fences, by their corners.
    pub fences: Vec<Vec<LatLon>>,
    /// Power lines, by their pylons.
    pub wires: Vec<Vec<LatLon>>,
    pub ways: Vec<(Stroke, Vec<LatLon>)>,
    /// Short texts at places; the vehicles are drawn over the others.
    pub signs: Vec<MapSign>,
    /// Other places that must be in view.
    pub others: Vec<LatLon>,
}

/// A short text at a place.
#[derive(Debug)]
pub struct MapSign {
    at: LatLon,
    what: SignText,
    role: Role,
}

#[derive(Debug, Clone)]
enum SignText {
    Text(String),
    /// The number of a vehicle; those that would touch each other are written as one list.
    Vehicle(VehicleId),
}

/// A sign in its cell.
struct PlacedSign {
    column: u16,
    row: u16,
    text: String,
    role: Role,
}

impl MapSign {
    pub fn text(at: LatLon, text: &str, role: Role) -> Self {
        let what = SignText::Text(text.to_owned());
        Self { at, what, role }
    }

    pub fn vehicle(at: LatLon, id: VehicleId) -> Self {
        let what = SignText::Vehicle(id);
        let role = Role::Accent;
        Self { at, what, role }
    }
}

impl PlainMap {
    /// Draws the map into the whole panel; returns `false` if there is nothing to draw.
    pub fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) -> bool {
        let area = panel.area;
        let ways = self.ways.iter().flat_map(|(_, way)| way);
        let fences = self.fences.iter().flatten();
        let signs = self.signs.iter().map(|sign| &sign.at);
        let all = ways.chain(fences).chain(signs).chain(&self.others);
        let Some(extent) = Extent::around(all.copied()).filter(|_| !area.is_empty()) else {
            return false;
        };
        let extent = extent.with_margin(EDGE.0, EDGE.1);
        let size = GridSize::new(area.width, area.height);
        let view = Viewport::new(extent.centre(), extent.zoom(size), size);
        let mut canvas = Canvas::new(size, panel.look.symbols);
        for fence in &self.fences {
            outline(fence, &view, &mut canvas, FENCE);
        }
        for pair in self.wires.iter().flat_map(|pylons| pylons.windows(2)) {
            canvas.line(view.dot(pair[0]), view.dot(pair[1]), WIRE);
        }
        for (stroke, way) in &self.ways {
            for pair in way.windows(2) {
                canvas.line(view.dot(pair[0]), view.dot(pair[1]), *stroke);
            }
        }
        canvas.draw(panel, buffer);
        if area.width >= SCALE_FROM {
            draw_scale(panel.look, &view, area, buffer);
        }
        for sign in self.placed(&view) {
            sign.draw(panel, buffer);
        }
        true
    }

    /// The signs in their cells: first the texts, then the vehicles, with one list for those in touching cells of a row.
    fn placed(&self, view: &Viewport) -> Vec<PlacedSign> {
        let mut placed = Vec::new();
        let mut vehicles = Vec::new();
        for sign in &self.signs {
            let Some((column, row)) = view.cell(sign.at) else {
                continue;
            };
            match &sign.what {
                SignText::Text(text) => placed.push(PlacedSign {
                    column,
                    row,
                    text: text.clone(),
                    role: sign.role,
                }),
                SignText::Vehicle(id) => vehicles.push((row, column, *id)),
            }
        }
        vehicles.sort_unstable();
        let touches = |a: &(u16, u16, VehicleId), b: &(u16, u16, VehicleId)| {
            a.0 == b.0 && b.1 <= a.1 + a.2.to_string().len() as u16
        };
        for group in vehicles.chunk_by(touches) {
            let (row, column, _) = group[0];
            let mut ids: Vec<VehicleId> = group.iter().map(|it| it.2).collect();
            ids.sort_unstable();
            placed.push(PlacedSign {
                column,
                row,
                text: ranges(ids),
                role: Role::Accent,
            });
        }
        placed
    }
}

impl PlacedSign {
    fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        let area = panel.area;
        let columns = (width_of(&self.text) as u16).min(area.width);
        // At the right edge, it stands before its place.
        let column = self.column.min(area.width - columns);
        let cells = Rect::new(area.x + column, area.y + self.row, columns, 1);
        let style = panel.style(Role::Text).patch(panel.style(self.role));
        stamp(&self.text, style, panel.at(cells), buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vehicles_in_touching_cells_have_one_list() {
        let origin = LatLon::new(0.0, 0.0);
        let at = |north_m, east_m, id| MapSign::vehicle(origin.moved(north_m, east_m), id);
        let map = PlainMap {
            signs: vec![
                at(0.0, 0.0, 1),
                at(0.0, 4.0, 4),
                at(0.0, 1.0, 3),
                at(0.0, 90.0, 5),
                at(90.0, 0.0, 6),
            ],
            ..PlainMap::default()
        };
        let size = GridSize::new(30, 15);
        let extent = Extent::around(map.signs.iter().map(|sign| sign.at)).expect("places");
        let view = Viewport::new(extent.centre(), extent.zoom(size), size);
        let mut texts: Vec<String> = map.placed(&view).into_iter().map(|it| it.text).collect();
        texts.sort();
        assert_eq!(texts, ["1,3-4", "5", "6"]);
    }
}
