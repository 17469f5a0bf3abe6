//! The attitude indicator: the ground as seen from the vehicle.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use crate::config::Symbols;
use crate::geo::maths;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::vehicle::Attitude;

/// Degrees of pitch from the centre of the indicator to its upper edge: more than a copter normally
/// leans (30°).
const HALF_VIEW_DEG: f64 = 40.0;
/// The pitch ladder: the spacing of its rungs, and their half width as a share of the half height.
const RUNG_EVERY_DEG: f64 = 20.0;
const RUNG_HALF_WIDTH: f64 = 0.35;
/// Bits of the dots of a braille pattern, column by column from the top.
const BRAILLE_DOTS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

/// The content of a point of the indicator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HorizonCell {
    Sky,
    Ground,
    Horizon,
    Rung,
}

/// The view out of the vehicle. Distances are in rows of the terminal; a column is half as wide as a row is high.
struct HorizonView {
    /// Sine and cosine of the roll angle.
    roll: (f64, f64),
    pitch_deg: f64,
    degrees_per_row: f64,
    half_height: f64,
}

impl HorizonView {
    fn new(attitude: &Attitude, rows: u16) -> Self {
        let half_height = f64::from(rows) / 2.0;
        Self {
            roll: maths::sin_cos(f64::from(attitude.roll_deg).to_radians()),
            pitch_deg: f64::from(attitude.pitch_deg),
            degrees_per_row: HALF_VIEW_DEG / half_height.max(0.5),
            half_height,
        }
    }

    /// The content of the point `right` to the right of the centre and `up` above it; lines are
    /// `dot` thick.
    ///
    /// When the vehicle rolls to the right, it turns clockwise, so the view turns counterclockwise:
    /// up points to the left of the indicator, and the horizon rises to the right.
    fn at(&self, right: f64, up: f64, dot: f64) -> HorizonCell {
        let (sine, cosine) = self.roll;
        let elevation_deg = self.pitch_deg + self.degrees_per_row * (cosine * up - sine * right);
        let along = cosine * right + sine * up;
        let half_line_deg = self.degrees_per_row * dot * 0.5;
        if elevation_deg.abs() <= half_line_deg {
            return HorizonCell::Horizon;
        }
        let to_rung_deg = elevation_deg - (elevation_deg / RUNG_EVERY_DEG).round() * RUNG_EVERY_DEG;
        let is_short = along.abs() <= self.half_height * RUNG_HALF_WIDTH;
        if is_short && to_rung_deg.abs() <= half_line_deg && elevation_deg.abs() > 5.0 {
            HorizonCell::Rung
        } else if elevation_deg < 0.0 {
            HorizonCell::Ground
        } else {
            HorizonCell::Sky
        }
    }
}

/// Draws the horizon over the whole area, with the vehicle in the centre.
pub fn draw(attitude: &Attitude, panel: Panel<'_>, buffer: &mut Buffer) {
    let view = HorizonView::new(attitude, panel.area.height);
    for y in 0..panel.area.height {
        for x in 0..panel.area.width {
            let (symbol, role) = cell(&view, panel.look.symbols, Position { x, y }, panel.area);
            buffer[(panel.area.x + x, panel.area.y + y)]
                .set_char(symbol)
                .set_style(panel.style(role));
        }
    }
    draw_vehicle(panel, buffer);
}

/// Draws the fixed wings and nose of the vehicle.
fn draw_vehicle(panel: Panel<'_>, buffer: &mut Buffer) {
    let mark = match panel.look.symbols {
        Symbols::Ascii => "--< + >--",
        Symbols::Block | Symbols::Braille => "━━┥ + ┝━━",
    };
    let width = mark.chars().count() as u16;
    if panel.area.width < width || panel.area.height == 0 {
        return;
    }
    let (x, y) = (
        panel.area.x + (panel.area.width - width) / 2,
        panel.area.y + (panel.area.height - 1) / 2,
    );
    buffer.set_string(x, y, mark, panel.style(Role::Title));
}

fn cell(view: &HorizonView, symbols: Symbols, place: Position, area: Rect) -> (char, Role) {
    let (columns, rows) = match symbols {
        Symbols::Braille => (2, 4),
        Symbols::Block => (1, 2),
        Symbols::Ascii => (1, 1),
    };
    let dot = 1.0 / rows as f64;
    let mut seen = [[HorizonCell::Sky; 4]; 2];
    for (column, dots) in seen.iter_mut().enumerate().take(columns) {
        for (row, dot_seen) in dots.iter_mut().enumerate().take(rows) {
            let across = f64::from(place.x) + (column as f64 + 0.5) / columns as f64;
            let down = f64::from(place.y) + (row as f64 + 0.5) * dot;
            let right = (across - f64::from(area.width) / 2.0) / 2.0;
            *dot_seen = view.at(right, view.half_height - down, dot);
        }
    }
    let has = |wanted: HorizonCell| seen.iter().flatten().any(|dot| *dot == wanted);
    let role = if has(HorizonCell::Horizon) {
        Role::Accent
    } else if has(HorizonCell::Rung) {
        Role::Text
    } else {
        Role::Muted
    };
    let symbol = match symbols {
        Symbols::Braille => braille(seen),
        Symbols::Block => block(seen[0][0], seen[0][1]),
        Symbols::Ascii => ascii(seen[0][0]),
    };
    (symbol, role)
}

/// A cell in braille. Lines are drawn in full; the ground has every fourth dot, which distinguishes it from the sky
/// without colour.
fn braille(seen: [[HorizonCell; 4]; 2]) -> char {
    let mut bits = 0;
    for (column, dots) in seen.iter().enumerate() {
        for (row, dot) in dots.iter().enumerate() {
            let is_set = match dot {
                HorizonCell::Horizon | HorizonCell::Rung => true,
                HorizonCell::Ground => column == 0 && row % 2 == 1,
                HorizonCell::Sky => false,
            };
            if is_set {
                bits |= BRAILLE_DOTS[column][row];
            }
        }
    }
    match bits {
        0 => ' ',
        bits => char::from_u32(0x2800 + bits).unwrap_or(' '),
    }
}

fn block(upper: HorizonCell, lower: HorizonCell) -> char {
    let is_line = |seen| matches!(seen, HorizonCell::Horizon | HorizonCell::Rung);
    match (is_line(upper), is_line(lower)) {
        (true, true) => '█',
        (true, false) => '▀',
        (false, true) => '▄',
        (false, false) if lower == HorizonCell::Ground => '░',
        (false, false) => ' ',
    }
}

fn ascii(seen: HorizonCell) -> char {
    match seen {
        HorizonCell::Sky => ' ',
        HorizonCell::Ground => '.',
        HorizonCell::Horizon => '=',
        HorizonCell::Rung => '-',
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn view(roll_deg: f32, pitch_deg: f32) -> HorizonView {
        let attitude = Attitude {
            roll_deg,
            pitch_deg,
            yaw_deg: 0.0,
            at: Duration::ZERO,
        };
        HorizonView::new(&attitude, 10)
    }

    #[test]
    fn the_ground_is_where_it_belongs() {
        // Each row: roll, pitch, and a point to the right of and above the centre.
        for ((roll, pitch), (right, up), expected) in [
            ((0.0, 0.0), (0.0, -1.0), HorizonCell::Ground),
            ((0.0, 0.0), (3.0, 0.7), HorizonCell::Sky),
            ((0.0, 0.0), (3.0, 0.0), HorizonCell::Horizon),
            // Nose up: the horizon sinks.
            ((0.0, 12.0), (4.0, -1.5), HorizonCell::Horizon),
            ((0.0, -12.0), (4.0, 1.5), HorizonCell::Horizon),
            // Right wing down: the ground is on the right.
            ((30.0, 0.0), (4.0, 0.0), HorizonCell::Ground),
            ((30.0, 0.0), (-4.0, 0.0), HorizonCell::Sky),
            // Upside down: the ground is above.
            ((180.0, 0.0), (3.0, 1.0), HorizonCell::Ground),
            ((0.0, 0.0), (0.0, 2.5), HorizonCell::Rung),
        ] {
            let seen = view(roll, pitch).at(right, up, 0.25);
            assert_eq!(seen, expected, "{roll} {pitch} {right} {up}");
        }
    }
}
