//! A canvas of dots, two by four in every cell, drawn in braille patterns, half blocks or ASCII.

use ratatui::buffer::Buffer;
use ratatui::style::Modifier;

use crate::config::Symbols;
use crate::geo::{DOTS_ACROSS, DOTS_DOWN, Dot, GridSize};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// The bits of a braille pattern, by row and column of the dot.
const BITS: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
/// The dots of the upper half of a cell.
const UPPER: u8 = 0x1b;
/// The first braille pattern, without any dot.
const BRAILLE: u32 = 0x2800;

/// Dots, and the role of every cell that contains any.
#[derive(Debug)]
pub struct Canvas {
    columns: u16,
    rows: u16,
    /// The number of consecutive dots of a line that the symbols show as one.
    dots_seen: u32,
    symbols: Symbols,
    cells: Vec<(u8, Role)>,
}

/// The pattern of a line: lines of different meaning can be distinguished without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stroke {
    pub role: Role,
    /// The dots that are drawn, as the lowest bits, the first dot lowest.
    pattern: u8,
    /// The number of dots after which the pattern repeats.
    of: u32,
}

impl Stroke {
    pub const fn solid(role: Role) -> Self {
        Self::of(role, 0b1, 1)
    }

    /// A line of dashes.
    pub const fn dashed(role: Role) -> Self {
        Self::of(role, 0b111, 6)
    }

    /// A line of long dashes with short gaps.
    pub const fn broken(role: Role) -> Self {
        Self::of(role, 0b11_1111, 8)
    }

    /// A line of dots close together.
    pub const fn dense(role: Role) -> Self {
        Self::of(role, 0b1, 2)
    }

    /// A line of dots.
    pub const fn dotted(role: Role) -> Self {
        Self::of(role, 0b1, 3)
    }

    /// A line of single dots far apart.
    pub const fn sparse(role: Role) -> Self {
        Self::of(role, 0b1, 5)
    }

    /// A line of dashes and dots in turn.
    pub const fn dash_dot(role: Role) -> Self {
        Self::of(role, 0b1_0111, 6)
    }

    const fn of(role: Role, pattern: u8, of: u32) -> Self {
        Self { role, pattern, of }
    }

    /// Whether the line has a dot at this place.
    const fn has_dot(self, at: u32) -> bool {
        self.pattern >> (at % self.of) & 1 == 1
    }

    /// The same pattern in another role.
    pub const fn with_role(self, role: Role) -> Self {
        Self { role, ..self }
    }

    /// A few cells of a line with this stroke, for the legend.
    pub fn sample(self, symbols: Symbols) -> String {
        let y = f64::from(DOTS_DOWN / 2);
        let mut canvas = Canvas::new(GridSize::new(5, 1), symbols);
        canvas.line(Dot { x: 0.5, y }, Dot { x: 9.5, y }, self);
        let shown = |&(mask, _): &(u8, Role)| glyph(mask, symbols);
        canvas.cells.iter().map(shown).collect()
    }
}

impl Canvas {
    pub fn new(size: GridSize, symbols: Symbols) -> Self {
        let count = usize::from(size.columns) * usize::from(size.rows);
        Self {
            columns: size.columns,
            rows: size.rows,
            dots_seen: if symbols == Symbols::Braille { 1 } else { 2 },
            symbols,
            cells: vec![(0, Role::Text); count],
        }
    }

    /// Draws a line between two dots, clipped to the canvas.
    pub fn line(&mut self, from: Dot, to: Dot, stroke: Stroke) {
        let Some([from, to]) = self.clipped(from, to) else {
            return;
        };
        let (across, down) = (to.x - from.x, to.y - from.y);
        let steps = across.abs().max(down.abs()).ceil().max(1.0);
        let mut at = 0;
        while f64::from(at) <= steps {
            if stroke.has_dot(at / self.dots_seen) {
                self.dot(from.towards(to, f64::from(at) / steps), stroke.role);
            }
            at += 1;
        }
    }

    /// Whether no dot has been drawn.
    pub fn is_blank(&self) -> bool {
        self.cells.iter().all(|(mask, _)| *mask == 0)
    }

    /// Draws one dot, if it is on the canvas.
    pub fn dot(&mut self, Dot { x, y }: Dot, role: Role) {
        if x < 0.0 || y < 0.0 {
            return;
        }
        let (x, y) = (x as u32, y as u32);
        let (column, row) = (x / u32::from(DOTS_ACROSS), y / u32::from(DOTS_DOWN));
        if column >= u32::from(self.columns) || row >= u32::from(self.rows) {
            return;
        }
        let bit = BITS[(y % u32::from(DOTS_DOWN)) as usize][(x % u32::from(DOTS_ACROSS)) as usize];
        let cell = &mut self.cells[(row * u32::from(self.columns) + column) as usize];
        *cell = (cell.0 | bit, role);
    }

    /// Puts the dots into a buffer; cells without dots stay as they are.
    pub fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        for (row, cells) in (panel.area.y..panel.area.bottom())
            .zip(self.cells.chunks(usize::from(self.columns.max(1))))
        {
            for (column, &(mask, role)) in (panel.area.x..panel.area.right()).zip(cells) {
                if mask != 0 {
                    let cell = &mut buffer[(column, row)];
                    cell.set_char(glyph(mask, self.symbols));
                    // Filled cells would not look like a line: without colours, some roles are
                    // reversed.
                    cell.set_style(panel.style(role).remove_modifier(Modifier::REVERSED));
                }
            }
        }
    }

    /// The part of a line that is on the canvas, if any (Liang-Barsky clipping).
    fn clipped(&self, from: Dot, to: Dot) -> Option<[Dot; 2]> {
        let right = f64::from(self.columns * DOTS_ACROSS) - 0.01;
        let bottom = f64::from(self.rows * DOTS_DOWN) - 0.01;
        let (across, down) = (to.x - from.x, to.y - from.y);
        let (mut first, mut last) = (0.0f64, 1.0f64);
        let sides = [
            (-across, from.x),
            (across, right - from.x),
            (-down, from.y),
            (down, bottom - from.y),
        ];
        for (towards, room) in sides {
            if towards == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if towards < 0.0 {
                first = first.max(room / towards);
            } else {
                last = last.min(room / towards);
            }
        }
        // Also false for NaN.
        let is_on_it = first <= last && across.is_finite() && down.is_finite();
        is_on_it.then(|| [first, last].map(|share| from.towards(to, share)))
    }
}

fn glyph(mask: u8, symbols: Symbols) -> char {
    let halves = (mask & UPPER != 0, mask & !UPPER != 0);
    match (symbols, halves) {
        (_, (false, false)) => ' ',
        (Symbols::Braille, _) => char::from_u32(BRAILLE + u32::from(mask)).unwrap_or(' '),
        (Symbols::Block, (true, true)) => '█',
        (Symbols::Block, (true, false)) => '▀',
        (Symbols::Block, (false, true)) => '▄',
        (Symbols::Ascii, (true, true)) => ':',
        (Symbols::Ascii, (true, false)) => '\'',
        (Symbols::Ascii, (false, true)) => '.',
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use ratatui::layout::Rect;

    use super::*;
    use crate::ui::look::Look;
    use crate::ui::theme::Theme;

    fn shown(symbols: Symbols, line: [Dot; 2]) -> String {
        let mut canvas = Canvas::new(GridSize::new(4, 2), symbols);
        canvas.line(line[0], line[1], Stroke::solid(Role::Text));
        let look = Look::default();
        let area = Rect::new(0, 0, canvas.columns, canvas.rows);
        let mut buffer = Buffer::empty(area);
        canvas.draw(Panel::new(&look, area), &mut buffer);
        let rows = buffer.content.chunks(usize::from(canvas.columns));
        let line =
            |row: &[ratatui::buffer::Cell]| row.iter().map(ratatui::buffer::Cell::symbol).collect();
        rows.map(line).collect::<Vec<String>>().join("\n")
    }

    #[test]
    fn a_diagonal_shows_in_every_kind_of_symbols() {
        let line = [Dot::new(0.0, 0.0), Dot::new(7.0, 7.0)];
        assert_eq!(shown(Symbols::Braille, line), "⠑⢄  \n  ⠑⢄");
        assert_eq!(shown(Symbols::Block, line), "▀▄  \n  ▀▄");
        assert_eq!(shown(Symbols::Ascii, line), "'.  \n  '.");
    }

    /// The theme without colours reverses the role of danger, so a line would appear as filled
    /// cells.
    #[test]
    fn lines_are_never_reversed() {
        let mut canvas = Canvas::new(GridSize::new(4, 2), Symbols::Ascii);
        let (from, to) = (Dot::new(0.0, 0.0), Dot::new(7.0, 7.0));
        canvas.line(from, to, Stroke::solid(Role::Danger));
        let look = Look {
            theme: Theme::named("monochrome").expect("a theme"),
            ..Look::default()
        };
        assert!(
            look.style(Role::Danger)
                .add_modifier
                .contains(Modifier::REVERSED)
        );
        let area = Rect::new(0, 0, canvas.columns, canvas.rows);
        let mut buffer = Buffer::empty(area);
        canvas.draw(Panel::new(&look, area), &mut buffer);
        let mut cells = buffer.content.iter();
        assert!(cells.all(|cell| !cell.modifier.contains(Modifier::REVERSED)));
    }

    #[test]
    fn strokes_differ_without_colour() {
        let strokes = [
            Stroke::solid(Role::Text),
            Stroke::dashed(Role::Text),
            Stroke::dotted(Role::Text),
            Stroke::dense(Role::Text),
            Stroke::dash_dot(Role::Text),
        ];
        let samples = |symbols| strokes.map(|stroke| stroke.sample(symbols));
        assert_eq!(
            samples(Symbols::Braille),
            ["⠤⠤⠤⠤⠤", "⠤⠄ ⠤⠄", "⠄⠠ ⠄⠠", "⠄⠄⠄⠄⠄", "⠤⠄⠄⠤⠄"]
        );
        assert_eq!(
            samples(Symbols::Block),
            ["▄▄▄▄▄", "▄▄▄  ", "▄  ▄ ", "▄ ▄ ▄", "▄▄▄ ▄"]
        );
        assert_eq!(
            samples(Symbols::Ascii),
            [".....", "...  ", ".  . ", ". . .", "... ."]
        );
    }

    /// The side of a fence once lost two of three dashes where a row has only two signs for its four dots.
    #[test]
    fn a_dashed_side_never_breaks_for_two_rows() {
        for symbols in [Symbols::Braille, Symbols::Block, Symbols::Ascii] {
            let mut canvas = Canvas::new(GridSize::new(1, 60), symbols);
            let (top, bottom) = (Dot::new(0.0, 0.0), Dot::new(0.0, 239.0));
            canvas.line(top, bottom, Stroke::dashed(Role::Fence));
            let is_drawn: Vec<bool> = canvas.cells.iter().map(|(mask, _)| *mask != 0).collect();
            assert!(is_drawn.windows(2).all(|rows| rows[0] || rows[1]));
            let drawn = is_drawn.iter().filter(|is_drawn| **is_drawn).count();
            assert!(drawn >= 40, "{drawn} of 60 rows, {symbols:?}");
        }
    }

    proptest! {
        #[test]
        fn lines_from_anywhere_to_anywhere_are_clipped(
            from in (-1e9..1e9f64, -1e9..1e9f64), to in (-1e9..1e9f64, -1e9..1e9f64),
        ) {
            let mut canvas = Canvas::new(GridSize::new(20, 10), Symbols::Braille);
            let [from, to] = [from, to].map(|(x, y)| Dot { x, y });
            canvas.line(from, to, Stroke::solid(Role::Text));
            canvas.line(from, Dot::new(f64::NAN, f64::INFINITY), Stroke::solid(Role::Text));
        }

        #[test]
        fn a_line_inside_reaches_both_its_ends(
            x in 0.0..39.98f64, y in 0.0..39.98f64, to_x in 0.0..39.98f64, to_y in 0.0..39.98f64,
        ) {
            let mut canvas = Canvas::new(GridSize::new(20, 10), Symbols::Braille);
            canvas.line(Dot { x, y }, Dot::new(to_x, to_y), Stroke::solid(Role::Text));
            for (x, y) in [(x, y), (to_x, to_y)] {
                let cell = canvas.cells[(y as usize / 4) * 20 + x as usize / 2];
                prop_assert!(cell.0 != 0);
            }
        }
    }
}
