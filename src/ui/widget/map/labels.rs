//! Labels on the map. They are on top of everything else, and opaque.

use std::collections::BTreeSet;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;
use unicode_width::UnicodeWidthStr as _;

use crate::geo::GridSize;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::put;

#[cfg(test)]
mod tests;

/// A column and a row of the map.
pub type MapCell = (u16, u16);

/// The maximum number of rows by which a label may move away from its place.
const FARTHEST_ROW: u16 = 4;

/// The part of a label that has to stay readable next to others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LabelKind {
    /// A word or a letter: shown whole or not at all.
    Word,
    /// A sign of one character, and a name after it unless there is no room.
    Signed,
    /// The sign and the name of a place: without room after the sign, the name is written elsewhere beside it.
    Place,
    /// The name of a place apart from its sign.
    Name,
    /// A number; next to another number, it would be read as part of that one.
    Number,
}

/// A text at a cell.
pub struct Label {
    pub cell: MapCell,
    pub kind: LabelKind,
    pub text: String,
    pub role: Role,
}

impl Label {
    fn width(&self) -> u16 {
        self.text.width() as u16
    }

    /// Shortens the label to its sign; returns `false` if it has none.
    fn shorten(&mut self) -> bool {
        let sign = match self.kind {
            LabelKind::Signed | LabelKind::Place => self.text.chars().next(),
            LabelKind::Word | LabelKind::Name | LabelKind::Number => None,
        };
        self.text = sign.map(String::from).unwrap_or_default();
        sign.is_some()
    }

    /// The name alone, at each spot beside the sign, best first.
    fn names_beside(&self) -> Vec<Self> {
        let (column, row) = self.cell;
        let name = self.text.trim_start_matches(|c: char| !c.is_alphanumeric());
        let width = name.width() as u16;
        let spots = [
            Some((column + 2, row)),
            column.checked_sub(width + 1).map(|left| (left, row)),
            Some((column, row + 1)),
            row.checked_sub(1).map(|above| (column, above)),
        ];
        let spots = spots.into_iter().flatten().filter(|_| width > 0);
        let named = spots.map(|cell| Self {
            cell,
            kind: LabelKind::Name,
            text: name.to_owned(),
            role: self.role,
        });
        named.collect()
    }
}

/// Draws the labels that can be read, on the map's panel; `vehicles` are the sorted cells of the signs and numbers of
/// vehicles, which have been drawn.
pub fn draw(labels: Vec<Label>, vehicles: &[MapCell], panel: Panel<'_>, buffer: &mut Buffer) {
    let area = panel.area;
    let labels = readable(labels, vehicles, GridSize::new(area.width, area.height));
    let is_of_vehicle = |cell: &MapCell| vehicles.binary_search(cell).is_ok();
    for label in labels.iter().filter(|it| !is_of_vehicle(&it.cell)) {
        let (column, row) = label.cell;
        let place = Rect {
            x: area.x + column,
            y: area.y + row,
            width: area.width.saturating_sub(column),
            height: 1,
        };
        stamp(
            &label.text,
            panel.style(label.role),
            panel.at(place),
            buffer,
        );
    }
    // Signs next to a word must not look like part of it.
    let written: BTreeSet<MapCell> = labels.iter().flat_map(cells).collect();
    for label in &labels {
        let ground = |cell: &MapCell| !written.contains(cell) && !is_of_vehicle(cell);
        for cell in beside(label).filter(ground) {
            part(panel, cell, buffer);
        }
    }
}

/// Moves labels that begin in the same place to free rows below and above it, as far as there are any.
pub fn spread(labels: Vec<Label>, rows: u16) -> Vec<Label> {
    let mut taken: BTreeSet<MapCell> = BTreeSet::new();
    let mut spread = Vec::new();
    for mut label in labels {
        let row = label.cell.1;
        let below = (0..=FARTHEST_ROW).map(|off| row.saturating_add(off));
        let above = (1..=FARTHEST_ROW).filter_map(|off| row.checked_sub(off));
        let mut near: Vec<u16> = below.chain(above).filter(|row| *row < rows).collect();
        near.sort_by_key(|other| other.abs_diff(row));
        let is_free = |row: &u16| {
            let (column, width) = (label.cell.0, label.width());
            let mut around = column.saturating_sub(1)..=column + width;
            around.all(|column| !taken.contains(&(column, *row)))
        };
        let free = near.into_iter().find(is_free);
        label.cell.1 = free.unwrap_or(row);
        taken.extend(cells(&label));
        spread.push(label);
    }
    spread
}

fn cells(label: &Label) -> impl Iterator<Item = MapCell> + use<> {
    let (column, row) = label.cell;
    (column..column + label.width()).map(move |column| (column, row))
}

/// The cells on both sides of a label.
fn beside(label: &Label) -> impl Iterator<Item = MapCell> + use<> {
    let (column, row) = label.cell;
    let columns = [column.checked_sub(1), Some(column + label.width())];
    columns
        .into_iter()
        .flatten()
        .map(move |column| (column, row))
}

/// Writes a text that begins in the first cell of a panel, replacing the characters and styles there. Returns the
/// number of cells written.
pub fn stamp(text: &str, style: Style, panel: Panel<'_>, buffer: &mut Buffer) -> u16 {
    let area = panel.area;
    let width = (text.width() as u16).min(area.width);
    let written = Rect {
        width,
        height: 1,
        ..area
    };
    blank(panel.at(written), buffer);
    let (end, _) = buffer.set_stringn(area.x, area.y, text, usize::from(width), style);
    end - area.x
}

/// Writes a line at the right end of the first row of a panel, replacing the content there.
pub fn stamp_right(line: &Line<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let width = (line.width() as u16).min(panel.area.width);
    let right = Rect {
        x: panel.area.right() - width,
        width,
        height: 1,
        ..panel.area
    };
    blank(panel.at(right), buffer);
    put(buffer, right, 0, line);
}

/// Clears the cells of a panel, including their styles.
pub fn blank(panel: Panel<'_>, buffer: &mut Buffer) {
    let area = panel.area.intersection(buffer.area);
    for place in area.positions() {
        if let Some(cell) = buffer.cell_mut(place) {
            cell.reset();
            cell.set_style(panel.style(Role::Text));
        }
    }
}

/// Blanks a cell of the map if its content could be read as part of the word next to it.
pub fn part(panel: Panel<'_>, at: MapCell, buffer: &mut Buffer) {
    let (column, row) = at;
    let area = panel.area;
    if column < area.width
        && row < area.height
        && let Some(cell) = buffer.cell_mut((area.x + column, area.y + row))
        && cell.symbol().starts_with(char::is_alphanumeric)
    {
        cell.set_char(' ');
    }
}

/// The labels without those that would overlap another one: later labels take precedence. If there
/// is no room for a name, only its sign stays. A name that would touch a vehicle or the mark of another place is left
/// out in the same way. The name of a place moves to the other sides of its sign first.
fn readable(labels: Vec<Label>, vehicles: &[MapCell], size: GridSize) -> Vec<Label> {
    let places = labels.iter().filter(|it| it.kind == LabelKind::Place);
    let mut board = LabelBoard {
        vehicles,
        marks: places.map(|it| it.cell).collect(),
        size,
        taken: BTreeSet::new(),
        words: BTreeSet::new(),
        figures: BTreeSet::new(),
        places: BTreeSet::new(),
        kept: Vec::new(),
    };
    for label in labels.into_iter().rev() {
        board.add(label);
    }
    board.kept
}

/// The labels that can be read, and the cells that they cover.
struct LabelBoard<'a> {
    vehicles: &'a [MapCell],
    /// The cells of the marks of all places.
    marks: BTreeSet<MapCell>,
    size: GridSize,
    taken: BTreeSet<MapCell>,
    words: BTreeSet<MapCell>,
    figures: BTreeSet<MapCell>,
    /// The cells of places with a name.
    places: BTreeSet<MapCell>,
    kept: Vec<Label>,
}

impl LabelBoard<'_> {
    fn add(&mut self, mut label: Label) {
        // Of several places in one cell, one has a name.
        let is_first = label.kind == LabelKind::Place && self.places.insert(label.cell);
        let moved = if is_first {
            label.names_beside()
        } else {
            Vec::new()
        };
        let must_fit = label.kind == LabelKind::Place && !self.is_inside(&label);
        if must_fit || !self.has_room(&label) {
            let place = label.cell;
            let is_free = !self.taken.contains(&place);
            let is_marked = is_free && label.shorten() && self.keep(label);
            // A name without a mark of its own, or with a target's, would belong to nothing.
            let is_marked = is_marked || !is_free && !self.words.contains(&place);
            let mut names = moved.into_iter().filter(|_| is_marked);
            if let Some(name) = names.find(|name| self.is_inside(name) && self.has_room(name)) {
                self.keep(name);
            }
            return;
        }
        self.keep(label);
    }

    fn is_inside(&self, label: &Label) -> bool {
        let (column, row) = label.cell;
        column + label.width() <= self.size.columns && row < self.size.rows
    }

    /// Whether the label overlaps no other one, and touches no vehicle unless it is a sign.
    fn has_room(&self, label: &Label) -> bool {
        let (column, row) = label.cell;
        let width = label.width();
        // Words need a space on both sides; signs may be adjacent.
        let margin = u16::from(width > 1);
        let around = column.saturating_sub(margin)..column + width + margin;
        let mut around = around.map(|at| (at, row));
        let is_crossed = |cell: &MapCell| {
            width > 1 && (self.is_of_vehicle(*cell) || self.is_mark_of_other(*cell, label))
        };
        !around.any(|cell| self.taken.contains(&cell) || is_crossed(&cell))
    }

    fn is_of_vehicle(&self, cell: MapCell) -> bool {
        self.vehicles.binary_search(&cell).is_ok()
    }

    /// Whether the cell has the mark of another place: a name never covers one.
    fn is_mark_of_other(&self, cell: MapCell, label: &Label) -> bool {
        let can_yield = match label.kind {
            LabelKind::Place | LabelKind::Name | LabelKind::Signed => true,
            LabelKind::Word | LabelKind::Number => false,
        };
        can_yield && cell != label.cell && self.marks.contains(&cell)
    }

    /// Adds a label, unless it would be misread; returns whether it did.
    fn keep(&mut self, label: Label) -> bool {
        if label.width() > 1 {
            self.words.extend(cells(&label));
        } else {
            let mut around = beside(&label);
            let is_misread = match label.kind {
                LabelKind::Word | LabelKind::Name => false,
                // A sign would read as part of the word.
                LabelKind::Signed | LabelKind::Place => around.any(|at| self.words.contains(&at)),
                // Beside a name or a vehicle, it would read as part of that.
                LabelKind::Number => around.any(|at| {
                    self.figures.contains(&at) || self.words.contains(&at) || self.is_of_vehicle(at)
                }),
            };
            if is_misread {
                return false;
            }
            if label.kind == LabelKind::Number {
                self.figures.extend(cells(&label));
            }
        }
        self.taken.extend(cells(&label));
        self.kept.push(label);
        true
    }
}
