//! The vehicles on the map: a sign, its number if there is room beside, above or below it, and a count such as `(×2)`
//! with their numbers if several share a cell.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Position;
use ratatui::style::Modifier;

use super::board::{Board, NumberSpots};
use super::labels::MapCell;
use crate::app::State;
use crate::config::Symbols;
use crate::geo::Viewport;
use crate::ui::look::{Badge, Look};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::severity_role;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::vehicle_id::ranges;

#[cfg(test)]
mod tests;

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
    /// How much it needs attention, the most first; also the order in which numbers are placed.
    rank: u8,
}

impl Marker {
    fn cells(&self) -> Range<u16> {
        self.column..self.column + 1
    }
}

/// The longest list of numbers beside a sign of several vehicles, in columns.
const LONGEST_LIST: usize = 12;
/// The ranks of vehicles without an alert.
const SELECTED_RANK: u8 = 10;
const USUAL_RANK: u8 = 11;

/// Vehicles that have one sign.
struct Group<'a> {
    row: u16,
    cells: Range<u16>,
    markers: Vec<&'a Marker>,
}

impl Group<'_> {
    /// The numbers of its vehicles; `None` if they are too long.
    fn list(&self) -> Option<String> {
        let mut ids: Vec<VehicleId> = self.markers.iter().map(|it| it.id).collect();
        ids.sort_unstable();
        let list = ranges(ids);
        (list.len() <= LONGEST_LIST).then_some(list)
    }
}

/// The role of the vehicle that needs attention most.
fn worst_role<'a>(markers: impl IntoIterator<Item = &'a Marker>) -> Role {
    let worst = markers.into_iter().min_by_key(|it| it.rank);
    worst.map_or(Role::Text, |it| it.role)
}

/// The marks that at least one of the vehicles has.
fn marks_of(markers: &[Marker]) -> String {
    let has = |mark: &char| markers.iter().any(|it| it.marks.contains(*mark));
    [SELECTED, ALERT].into_iter().filter(has).collect()
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
    view: &Viewport,
    panel: Panel<'_>,
    spots: NumberSpots,
    buffer: &mut Buffer,
) -> DrawnVehicles {
    let look = panel.look;
    let (mut markers, outside) = markers(state, look, view);
    let cursor = state.session().cursor();
    let under_cursor = markers.iter().position(|it| Some(it.id) == cursor);
    let chosen = under_cursor.map(|at| Chosen::new(markers.swap_remove(at), &mut markers));
    markers.sort_by_key(|it| (it.row, it.column, it.id));
    let mut board = Board::new(panel, spots, buffer);
    if let Some(chosen) = &chosen {
        put_chosen(chosen, &mut board, look);
    }
    let mut singles: Vec<&Marker> = Vec::new();
    let mut groups: Vec<Group<'_>> = Vec::new();
    for row in markers.chunk_by(|a, b| a.row == b.row) {
        // The vehicle under the cursor splits its row into two parts.
        let parts = chosen.iter().find(|it| it.marker.row == row[0].row);
        let (from, to) = parts.map_or((0, 0), |it| (it.from, it.end()));
        let (left, right) = row.split_at(row.partition_point(|it| it.column < from));
        for (part, columns) in [(left, 0..from), (right, to..panel.area.width)] {
            groups.extend(gather(part, columns, &mut singles, &mut board, look));
        }
    }
    for it in &singles {
        let sign = it.sign.to_string();
        board.put(it.column, it.row, &sign, look.style(it.role));
    }
    singles.sort_by_key(|it| (it.rank, it.id));
    for marker in singles {
        name(marker, &mut board, look);
    }
    groups.extend(chosen.as_ref().and_then(Chosen::group));
    for group in &groups {
        list(group, &mut board, look);
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

/// The vehicle under the cursor: always shown with its number, and with the number of vehicles that it hides and their
/// marks.
struct Chosen {
    marker: Marker,
    from: u16,
    /// The bracket, the sign, the number and the marks.
    own: String,
    /// The number of hidden vehicles and their marks; empty if there are none.
    others: String,
    hidden: Vec<Marker>,
}

impl Chosen {
    /// The vehicle of this marker; removes from `others` the vehicles that it hides.
    fn new(marker: Marker, others: &mut Vec<Marker>) -> Self {
        // At the left edge, the sign itself must keep its column.
        let bracket = if marker.column == 0 { "" } else { "[" };
        let mut chosen = Self {
            from: marker.column.saturating_sub(1),
            own: format!("{bracket}{}{}{}", marker.sign, marker.id, marker.marks),
            others: String::new(),
            marker,
            hidden: Vec::new(),
        };
        loop {
            let (row, columns) = (chosen.marker.row, chosen.from..chosen.end());
            let is_hidden = |it: &mut Marker| it.row == row && columns.contains(&it.column);
            let before = chosen.hidden.len();
            chosen.hidden.extend(others.extract_if(.., is_hidden));
            if chosen.hidden.len() == before {
                return chosen;
            }
            // The longer text may hide more vehicles.
            chosen.others = format!("+{}{}", chosen.hidden.len(), marks_of(&chosen.hidden));
        }
    }

    /// The column after the text.
    fn end(&self) -> u16 {
        let text = [self.own.as_str(), self.others.as_str(), "]"];
        self.from
            + text
                .map(|part| part.chars().count() as u16)
                .iter()
                .sum::<u16>()
    }

    /// The hidden vehicles, if there are any.
    fn group(&self) -> Option<Group<'_>> {
        (!self.hidden.is_empty()).then(|| Group {
            row: self.marker.row,
            cells: self.from..self.end(),
            markers: self.hidden.iter().collect(),
        })
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
        Some(alarm) => (severity_role(alarm.severity), alarm.severity as u8),
        // The colour of a vehicle in flight is that of its plan and trail; a star marks it as selected.
        None if vehicle.armed() => (
            Badge::of_vehicle(vehicle.id).role,
            if selected { SELECTED_RANK } else { USUAL_RANK },
        ),
        None if selected => (Role::Selected, SELECTED_RANK),
        None => (Role::Muted, USUAL_RANK),
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
/// vehicles in the neighbouring cells that it is written over. Returns these groups; the other vehicles are added to
/// `singles`, to be drawn individually.
fn gather<'a>(
    row: &'a [Marker],
    columns: Range<u16>,
    singles: &mut Vec<&'a Marker>,
    board: &mut Board<'_>,
    look: &Look,
) -> Vec<Group<'a>> {
    let mut groups = Vec::new();
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
        let cells = put_count(these, from, board, look);
        groups.push(Group {
            row: first.row,
            cells,
            markers: these.iter().collect(),
        });
        free_from = ends(count);
        rest = others;
    }
    groups
}

/// The number of vehicles in one place, which must not look like the number of a vehicle, nor as a part of what is
/// beside it.
pub fn tally(count: usize) -> String {
    format!("(×{count})")
}

/// Writes a vehicle's number at its sign if there is room: beside it, or above or below it if the next sign is close.
/// If its marks do not fit, the number comes first, and
/// an alert replaces the sign; without room for the number, only the marks are written.
fn name(marker: &Marker, board: &mut Board<'_>, look: &Look) {
    let (number, style) = (marker.id.to_string(), look.style(marker.role));
    let whole = format!("{number}{}", marker.marks);
    // In a dense swarm, signs and numbers without gaps would read as one word.
    if board.write_apart(marker.cells(), marker.row, &whole, style)
        || board.write_over(marker.cells(), marker.row, &whole, style)
        || board.write_beside(marker.cells(), marker.row, &whole, style)
    {
        return;
    }
    let has_marks = !marker.marks.is_empty();
    if has_marks && board.write_beside(marker.cells(), marker.row, &number, style) {
        let mark = if marker.marks.contains(ALERT) {
            ALERT
        } else {
            SELECTED
        };
        board.put(marker.column, marker.row, &mark.to_string(), style);
    } else if has_marks {
        board.write_beside(marker.cells(), marker.row, &marker.marks, style);
    }
}

/// Writes the numbers of several vehicles at their sign if there is room.
fn list(group: &Group<'_>, board: &mut Board<'_>, look: &Look) {
    let Some(list) = group.list() else { return };
    let style = look.style(worst_role(group.markers.iter().copied()));
    // Without colours, the sign is reversed already.
    let style = style.remove_modifier(Modifier::REVERSED);
    if !board.write_over(group.cells.clone(), group.row, &list, style) {
        board.write_beside(group.cells.clone(), group.row, &list, style);
    }
}

/// Writes the vehicle under the cursor.
fn put_chosen(chosen: &Chosen, board: &mut Board<'_>, look: &Look) {
    let row = chosen.marker.row;
    let style = |role| look.style(role).patch(look.style(Role::Cursor));
    let own = style(chosen.marker.role);
    let others = style(worst_role(&chosen.hidden));
    let mut column = chosen.from;
    for (text, style) in [
        (chosen.own.as_str(), own),
        (&chosen.others, others),
        ("]", own),
    ] {
        board.put(column, row, text, style);
        column += text.chars().count() as u16;
    }
    let beside = [chosen.from.checked_sub(1), Some(chosen.end())];
    for column in beside.into_iter().flatten() {
        board.part(column, row);
    }
}

/// Writes the number of vehicles in one place, with their marks; returns the columns written.
fn put_count(those: &[Marker], from: u16, board: &mut Board<'_>, look: &Look) -> Range<u16> {
    let text = tally(those.len()) + &marks_of(those);
    let Some(row) = those.first().map(|it| it.row) else {
        return from..from;
    };
    board.put(from, row, &text, look.style(worst_role(those)));
    from..from + text.chars().count() as u16
}
