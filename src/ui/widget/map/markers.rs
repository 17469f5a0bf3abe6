//! The vehicles on the map: a sign, its number if there is room, and a count such as `(×2)` if several share a cell.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;

use super::labels::{MapCell, part, stamp};
use crate::app::State;
use crate::config::Symbols;
use crate::geo::Viewport;
use crate::ui::look::{Badge, Look};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::severity_role;
use crate::vehicle::{Severity, Vehicle, VehicleId};

/// Headings as arrows, clockwise from north.
const ARROWS: [char; 8] = ['↑', '↗', '→', '↘', '↓', '↙', '←', '↖'];
/// The arrows for terminals with only four.
const FOUR_ARROWS: [char; 4] = ['↑', '→', '↓', '←'];
const ASCII_ARROWS: [char; 4] = ['^', '>', 'v', '<'];

/// The marks after the number of a selected vehicle, and of one with an alert.
const SELECTED: char = '*';
const ALERT: char = '!';

struct Marker {
    id: VehicleId,
    column: u16,
    row: u16,
    sign: char,
    /// The selection and alert marks after its number.
    marks: String,
    role: Role,
    /// The order in which numbers are placed, lowest first.
    rank: u8,
}

/// The vehicles that were drawn.
pub struct DrawnVehicles {
    /// The cells of their signs, numbers and marks, sorted.
    pub cells: Vec<MapCell>,
    /// The number of others with a position.
    pub outside: usize,
}

/// Draws the vehicles in view.
pub fn draw(
    state: &State,
    look: &Look,
    view: &Viewport,
    area: Rect,
    buffer: &mut Buffer,
) -> DrawnVehicles {
    let (mut markers, outside) = markers(state, look, view);
    let cursor = state.session().cursor();
    let under_cursor = markers.iter().position(|it| Some(it.id) == cursor);
    let chosen = under_cursor.map(|at| Chosen::new(markers.swap_remove(at), &mut markers));
    markers.sort_by_key(|it| (it.row, it.column, it.id));
    let mut board = Board::new(Panel::new(look, area), buffer);
    if let Some(chosen) = &chosen {
        board.put_chosen(chosen, look);
    }
    let mut singles: Vec<&Marker> = Vec::new();
    for row in markers.chunk_by(|a, b| a.row == b.row) {
        // The vehicle under the cursor splits its row into two parts.
        let parts = chosen.iter().find(|it| it.marker.row == row[0].row);
        let (from, to) = parts.map_or((0, 0), |it| (it.from, it.end()));
        let (left, right) = row.split_at(row.partition_point(|it| it.column < from));
        gather(left, 0..from, &mut singles, &mut board, look);
        gather(right, to..area.width, &mut singles, &mut board, look);
    }
    for it in &singles {
        let sign = it.sign.to_string();
        board.put(it.column, it.row, &sign, look.style(it.role));
    }
    singles.sort_by_key(|it| (it.rank, it.id));
    for marker in singles {
        board.name(marker, look);
    }
    DrawnVehicles {
        cells: board.cells(),
        outside,
    }
}

/// The vehicles in view, and the number of others.
fn markers(state: &State, look: &Look, view: &Viewport) -> (Vec<Marker>, usize) {
    let mut markers = Vec::new();
    let mut outside = 0;
    for vehicle in state.session().vehicles().values() {
        let Some(global) = vehicle.global else {
            continue;
        };
        match view.cell(global.at_point) {
            Some(cell) => markers.push(marker(vehicle, cell.into(), state, look)),
            None => outside += 1,
        }
    }
    (markers, outside)
}

/// The vehicle under the cursor: always shown with its number, and with the number of vehicles that it hides.
struct Chosen {
    marker: Marker,
    from: u16,
    text: String,
}

impl Chosen {
    /// The vehicle of this marker; removes from `others` the vehicles that it hides.
    fn new(marker: Marker, others: &mut Vec<Marker>) -> Self {
        // At the left edge, the sign itself must keep its column.
        let bracket = if marker.column == 0 { "" } else { "[" };
        let bare = format!("{bracket}{}{}{}", marker.sign, marker.id, marker.marks);
        let mut chosen = Self {
            from: marker.column.saturating_sub(1),
            text: format!("{bare}]"),
            marker,
        };
        let mut hidden = 0;
        loop {
            let before = hidden;
            let (row, columns) = (chosen.marker.row, chosen.from..chosen.end());
            others.retain(|it| {
                let is_hidden = it.row == row && columns.contains(&it.column);
                hidden += usize::from(is_hidden);
                !is_hidden
            });
            if hidden == before {
                return chosen;
            }
            // The longer text may hide more vehicles.
            chosen.text = format!("{bare}+{hidden}]");
        }
    }

    /// The column after the text.
    fn end(&self) -> u16 {
        self.from + self.text.chars().count() as u16
    }
}

fn marker(vehicle: &Vehicle, cell: Position, state: &State, look: &Look) -> Marker {
    let selected = state.session().selection().contains(&vehicle.id);
    let alarm = state
        .session()
        .alert(vehicle, state.now())
        .filter(|alert| alert.severity <= Severity::Warning);
    let lost = vehicle.link.lost;
    let mut marks = String::new();
    if selected {
        marks.push(SELECTED);
    }
    if alarm.is_some() {
        marks.push(ALERT);
    }
    let (role, rank) = match &alarm {
        _ if lost => (Role::Danger, 0),
        Some(alarm) => (severity_role(alarm.severity), 0),
        // The colour of a vehicle in flight is that of its plan and trail; a star marks it as selected.
        None if vehicle.armed() => (
            Badge::of_vehicle(vehicle.id).role,
            if selected { 1 } else { 2 },
        ),
        None if selected => (Role::Selected, 1),
        None => (Role::Muted, 2),
    };
    Marker {
        id: vehicle.id,
        column: cell.x,
        row: cell.y,
        sign: sign(vehicle, look.symbols),
        marks,
        role,
        rank,
    }
}

/// The sign of a vehicle whose link is lost.
pub const LOST: char = 'L';

/// An arrow for an armed vehicle, `@` if its heading is unknown; `o` for one that is not armed; `L` for one out of
/// contact.
fn sign(vehicle: &Vehicle, symbols: Symbols) -> char {
    if vehicle.link.lost {
        return LOST;
    }
    match vehicle.heading_deg() {
        Some(heading) if vehicle.armed() => arrow(heading, symbols),
        None if vehicle.armed() => '@',
        _ => 'o',
    }
}

/// The arrow that is nearest to a heading.
pub fn arrow(heading_deg: f32, symbols: Symbols) -> char {
    let arrows: &[char] = match symbols {
        Symbols::Braille => &ARROWS,
        Symbols::Block => &FOUR_ARROWS,
        Symbols::Ascii => &ASCII_ARROWS,
    };
    let count = arrows.len() as f32;
    let turn = (heading_deg.rem_euclid(360.0) / 360.0 * count).round() as usize;
    arrows[turn % arrows.len()]
}

/// Finds the cells of a row that contain several vehicles, and writes their number there. The number includes the
/// vehicles in the neighbouring cells that it is written over. The other vehicles are added to `singles`, to be drawn
/// individually.
fn gather<'a>(
    row: &'a [Marker],
    columns: Range<u16>,
    singles: &mut Vec<&'a Marker>,
    board: &mut Board<'_>,
    look: &Look,
) {
    let mut rest = row;
    let mut free_from = columns.start;
    while let Some(first) = rest.first() {
        let in_cell = rest.iter().take_while(|it| it.column == first.column);
        let mut count = in_cell.count();
        if count == 1 {
            singles.push(first);
            free_from = first.column + 1;
            rest = &rest[1..];
            continue;
        }
        let from = first.column;
        let ends = |count: usize| from + tally(count).chars().count() as u16;
        while rest
            .get(count)
            .is_some_and(|next| next.column < ends(count))
        {
            count += 1;
        }
        let (these, others) = rest.split_at(count);
        let from = from
            .min(columns.end.saturating_sub(ends(count) - from))
            .max(free_from);
        board.put_count(these, from, look);
        free_from = ends(count);
        rest = others;
    }
}

/// The number of vehicles in one place, which must not look like the number of a vehicle, nor as a part of what is
/// beside it.
pub fn tally(count: usize) -> String {
    format!("(×{count})")
}

/// The cells of the map that already have a sign or a number.
struct Board<'a> {
    panel: Panel<'a>,
    buffer: &'a mut Buffer,
    taken: Vec<bool>,
}

impl<'a> Board<'a> {
    fn new(panel: Panel<'a>, buffer: &'a mut Buffer) -> Self {
        let cells = usize::from(panel.area.width) * usize::from(panel.area.height);
        Self {
            panel,
            buffer,
            taken: vec![false; cells],
        }
    }

    fn put(&mut self, column: u16, row: u16, text: &str, style: Style) {
        let area = self.panel.area;
        let place = Rect {
            x: area.x + column,
            y: area.y + row,
            width: area.width.saturating_sub(column),
            height: 1,
        };
        let written = stamp(text, style, self.panel.at(place), self.buffer);
        let from = usize::from(row) * usize::from(area.width) + usize::from(column);
        self.taken[from..from + usize::from(written)].fill(true);
    }

    /// The cells that have a sign, a number or a mark, sorted.
    fn cells(&self) -> Vec<MapCell> {
        let width = usize::from(self.panel.area.width).max(1);
        let taken = self.taken.iter().enumerate().filter(|(_, taken)| **taken);
        let mut cells: Vec<MapCell> = taken
            .map(|(at, _)| ((at % width) as u16, (at / width) as u16))
            .collect();
        cells.sort_unstable();
        cells
    }

    /// Whether the cells are free, and within the row.
    fn is_free(&self, column: u16, row: u16, width: u16) -> bool {
        let from = usize::from(row) * usize::from(self.panel.area.width) + usize::from(column);
        let fits = column + width <= self.panel.area.width;
        fits && !self.taken[from..from + usize::from(width)].contains(&true)
    }

    /// Writes a vehicle's number beside its sign if there is room. If its marks do not fit, the number comes first, and
    /// an alert replaces the sign; without room for the number, only the marks are written.
    fn name(&mut self, marker: &Marker, look: &Look) {
        let number = marker.id.to_string();
        let whole = format!("{number}{}", marker.marks);
        if self.write_beside(marker, &whole, look) || marker.marks.is_empty() {
            return;
        }
        if self.write_beside(marker, &number, look) {
            let mark = if marker.marks.contains(ALERT) {
                ALERT
            } else {
                SELECTED
            };
            let style = look.style(marker.role);
            self.put(marker.column, marker.row, &mark.to_string(), style);
        } else {
            self.write_beside(marker, &marker.marks, look);
        }
    }

    /// Writes a text after a vehicle's sign, or before it if nothing there could take it for its own.
    fn write_beside(&mut self, marker: &Marker, text: &str, look: &Look) -> bool {
        let width = text.len() as u16;
        let right = marker.column + 1;
        let left = marker.column.checked_sub(width).filter(|&left| {
            let gap = u16::from(left > 0);
            self.is_free(left - gap, marker.row, width + gap)
        });
        let at = if self.is_free(right, marker.row, width) {
            right
        } else if let Some(left) = left {
            left
        } else {
            return false;
        };
        self.put(at, marker.row, text, look.style(marker.role));
        for beside in [at.checked_sub(1), Some(at + width)].into_iter().flatten() {
            self.part(beside, marker.row);
        }
        true
    }

    /// Blanks a letter or digit of the ground next to a number, because it could be read as part of the number.
    fn part(&mut self, column: u16, row: u16) {
        if self.is_free(column, row, 1) {
            part(self.panel, (column, row), self.buffer);
        }
    }

    fn put_chosen(&mut self, chosen: &Chosen, look: &Look) {
        let marker = &chosen.marker;
        let style = look.style(marker.role).patch(look.style(Role::Cursor));
        self.put(chosen.from, marker.row, &chosen.text, style);
        let beside = [chosen.from.checked_sub(1), Some(chosen.end())];
        for column in beside.into_iter().flatten() {
            self.part(column, marker.row);
        }
    }

    fn put_count(&mut self, those: &[Marker], from: u16, look: &Look) {
        let worst = those.iter().min_by_key(|it| it.rank);
        let role = worst.map_or(Role::Text, |it| it.role);
        let mark = |wanted: char| those.iter().any(|it| it.marks.contains(wanted));
        let mut text = tally(those.len());
        for wanted in [SELECTED, ALERT] {
            if mark(wanted) {
                text.push(wanted);
            }
        }
        let Some(row) = those.first().map(|it| it.row) else {
            return;
        };
        self.put(from, row, &text, look.style(role));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vehicles in a row: column, number and marks.
    fn drawn(vehicles: &[(u16, VehicleId, &str)]) -> String {
        let (look, area) = (Look::default(), Rect::new(0, 0, 10, 1));
        let mut buffer = Buffer::empty(area);
        let mut board = Board::new(Panel::new(&look, area), &mut buffer);
        let marker = |&(column, id, marks): &(u16, VehicleId, &str)| Marker {
            id,
            column,
            row: 0,
            sign: '^',
            marks: marks.to_owned(),
            role: Role::Text,
            rank: 0,
        };
        let markers: Vec<Marker> = vehicles.iter().map(marker).collect();
        for it in &markers {
            board.put(it.column, 0, "^", Style::new());
        }
        for it in &markers {
            board.name(it, &look);
        }
        (0..10).map(|x| buffer[(x, 0)].symbol()).collect()
    }

    #[test]
    fn a_vehicle_with_an_alert_keeps_its_number_beside_neighbours() {
        assert_eq!(drawn(&[(1, 2, "!"), (5, 3, "")]), " ^2! ^3   ");
        assert_eq!(drawn(&[(1, 2, "!"), (3, 3, "")]), " !2^3     ");
        assert_eq!(drawn(&[(1, 2, "*"), (3, 3, "!")]), " *2^3!    ");
    }

    #[test]
    fn no_number_stands_between_two_signs_unless_it_follows_its_own() {
        // The number of vehicle 3 would look like that of vehicle 2.
        assert_eq!(drawn(&[(1, 2, ""), (3, 3, ""), (4, 4, "")]), " ^2^^4    ");
        assert_eq!(drawn(&[(3, 3, ""), (4, 4, "")]), "  3^^4    ");
    }
}
