//! A map without controls, of places that are given: for the desk of a class.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::canvas::{Canvas, Stroke};
use super::ground::outline;
use super::labels::stamp;
use super::legend::draw_scale;
use crate::geo::{Extent, GridSize, LatLon, Viewport};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::width as width_of;

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
    pub ways: Vec<(Stroke, Vec<LatLon>)>,
    /// Short texts at places, the most important last.
    pub signs: Vec<MapSign>,
    /// Other places that must be in view.
    pub others: Vec<LatLon>,
}

/// A short text at a place.
#[derive(Debug)]
pub struct MapSign {
    pub at: LatLon,
    pub text: String,
    pub role: Role,
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
        for (stroke, way) in &self.ways {
            for pair in way.windows(2) {
                canvas.line(view.dot(pair[0]), view.dot(pair[1]), *stroke);
            }
        }
        canvas.draw(panel, buffer);
        if area.width >= SCALE_FROM {
            draw_scale(panel.look, &view, area, buffer);
        }
        for sign in &self.signs {
            self.draw_sign(sign, &view, panel, buffer);
        }
        true
    }

    fn draw_sign(&self, sign: &MapSign, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
        let area = panel.area;
        let Some((column, row)) = view.cell(sign.at) else {
            return;
        };
        let columns = (width_of(&sign.text) as u16).min(area.width);
        // At the right edge, it stands before its place.
        let column = column.min(area.width - columns);
        let cells = Rect::new(area.x + column, area.y + row, columns, 1);
        let style = panel.style(Role::Text).patch(panel.style(sign.role));
        stamp(&sign.text, style, panel.at(cells), buffer);
    }
}
