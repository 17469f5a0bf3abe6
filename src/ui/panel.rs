//! A part of the screen: dividing it, and writing lines and titles into it.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget as _};

use super::look::Look;
use super::theme::Role;
use crate::app::action::{Action, Step};
use crate::text::{Text, clip};

/// A part of the screen with the look to draw in.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    pub look: &'a Look,
    pub area: Rect,
}

impl<'a> Panel<'a> {
    pub fn new(look: &'a Look, area: Rect) -> Self {
        Self { look, area }
    }

    /// The same look on another area.
    pub fn at(self, area: Rect) -> Self {
        Self { area, ..self }
    }

    /// The same panel cut to its first rows.
    pub fn upper(self, rows: u16) -> Self {
        self.at(upper(self.area, rows))
    }

    /// The rest of the panel below its first rows.
    pub fn below(self, rows: u16) -> Self {
        self.at(below(self.area, rows))
    }

    /// Some columns of the panel, counted from its left edge.
    pub fn columns(self, from: u16, width: u16) -> Self {
        self.at(columns(self.area, from, width))
    }

    /// The panel's width in columns.
    pub fn width(self) -> usize {
        usize::from(self.area.width)
    }

    pub fn style(self, role: Role) -> Style {
        self.look.style(role)
    }

    /// A text in the current language, safe to show on one line.
    pub fn text(self, text: &Text) -> String {
        self.look.text(text)
    }

    /// A message without arguments; it may have several lines.
    pub fn say(self, id: &str) -> String {
        self.look.say(id)
    }

    /// Draws a rule with a title along the top of the panel, and returns the area below it.
    pub fn titled(self, title: &str, buffer: &mut Buffer) -> Rect {
        self.ruled(title, '─', self.style(Role::Border), buffer)
    }

    /// Draws a rule as [`titled`](Self::titled) does, for a pane that can have the focus; a heavy
    /// rule marks the focus.
    pub fn focused(self, title: &str, has_keys: bool, buffer: &mut Buffer) -> Rect {
        if has_keys {
            self.ruled(title, '━', self.style(Role::Key), buffer)
        } else {
            self.titled(title, buffer)
        }
    }

    fn ruled(self, title: &str, stroke: char, style: Style, buffer: &mut Buffer) -> Rect {
        let lead = format!("{stroke}{stroke} ");
        let Some(mut x) = put(buffer, self.area, 0, &Line::styled(lead, style)) else {
            return self.area;
        };
        let right = self.area.right();
        let title = clip(title, usize::from(self.area.width.saturating_sub(4)));
        x = buffer
            .set_stringn(
                x,
                self.area.y,
                title,
                usize::from(right - x),
                self.style(Role::Title),
            )
            .0;
        if x < right {
            let columns = usize::from(right - x).saturating_sub(1);
            let rest = stroke.to_string().repeat(columns);
            buffer.set_stringn(x + 1, self.area.y, rest, columns, style);
        }
        below(self.area, 1)
    }

    /// Marks that a list continues above or below the visible part, in the column beside it if there is one; otherwise
    /// at the end of the nearest row that is short enough, so that the mark covers no letter.
    pub fn mark_scroll(self, first: usize, count: usize, buffer: &mut Buffer) {
        if self.area.is_empty() {
            return;
        }
        let x = self.area.right().min(buffer.area.right().saturating_sub(1));
        let rows = self.area.y..self.area.bottom();
        let is_free = |y: &u16| buffer[(x, *y)].symbol() == " ";
        let (top, bottom) = (rows.start, rows.end - 1);
        let upper = rows.clone().find(is_free).unwrap_or(top);
        let lower = rows.rev().find(is_free).unwrap_or(bottom);
        let goes_on = first + usize::from(self.area.height) < count;
        let marks = [(first > 0, upper, "▲"), (goes_on, lower, "▼")];
        for (_, y, mark) in marks.into_iter().filter(|(is_shown, ..)| *is_shown) {
            buffer.set_stringn(x, y, mark, 1, self.style(Role::Key));
        }
    }

    /// Marks where a list with one row per line continues; if it has the focus, a click on a row moves the cursor
    /// there.
    pub fn mark_list(self, first: usize, count: usize, has_keys: bool, buffer: &mut Buffer) {
        self.mark_scroll(first, count, buffer);
        let shown = usize::from(self.area.height).min(count.saturating_sub(first));
        for row in (0..shown).filter(|_| has_keys) {
            let place = row_of(self.area, row as u16);
            let action = Action::Move(Step::Row(first + row));
            self.look.hits.add(place, action);
        }
    }

    /// Highlights the cursor. Cells with a background of their own, such as ARMED, keep it, so the
    /// cursor does not hide the state.
    pub fn mark_cursor(self, buffer: &mut Buffer) {
        let ground = self.style(Role::Text).bg.unwrap_or(Color::Reset);
        let cursor = self.style(Role::Cursor);
        for position in self.area.intersection(buffer.area).positions() {
            let cell = &mut buffer[position];
            if cell.modifier.contains(Modifier::REVERSED) {
                cell.modifier.remove(Modifier::REVERSED);
            } else if cell.bg == ground {
                cell.set_style(cursor);
            }
        }
    }

    /// Clears the panel's area.
    pub fn clear(self, buffer: &mut Buffer) {
        Clear.render(self.area, buffer);
        buffer.set_style(self.area, self.style(Role::Text));
    }

    /// Clears the panel, draws a frame with a title along its edge, and returns the area inside.
    pub fn boxed(self, title: &str, role: Role, buffer: &mut Buffer) -> Rect {
        self.clear(buffer);
        let block = Block::bordered()
            .border_style(self.style(role))
            .title(Span::styled(format!(" {title} "), self.style(Role::Title)));
        let inner = block.inner(self.area);
        block.render(self.area, buffer);
        Rect {
            x: inner.x + 1,
            width: inner.width.saturating_sub(2),
            ..inner
        }
    }
}

/// The rest of an area below its first rows.
pub fn below(area: Rect, rows: u16) -> Rect {
    let rows = rows.min(area.height);
    Rect {
        y: area.y + rows,
        height: area.height - rows,
        ..area
    }
}

/// One row of an area, empty if the area has no such row.
pub fn row_of(area: Rect, row: u16) -> Rect {
    let area = below(area, row);
    upper(area, 1)
}

/// The first rows of an area.
pub fn upper(area: Rect, rows: u16) -> Rect {
    Rect {
        height: rows.min(area.height),
        ..area
    }
}

/// Some columns of an area, from its left edge.
pub fn columns(area: Rect, from: u16, width: u16) -> Rect {
    let from = from.min(area.width);
    Rect {
        x: area.x + from,
        width: width.min(area.width - from),
        ..area
    }
}

/// Writes a line into a row of an area, clipped to it; returns the column after its end, or `None`
/// if the area has no such row.
pub fn put(buffer: &mut Buffer, area: Rect, row: u16, line: &Line<'_>) -> Option<u16> {
    if row >= area.height || area.width == 0 {
        return None;
    }
    let (mut x, y) = (area.x, area.y + row);
    let end = area.right().min(buffer.area.right());
    for span in line {
        let style = line.style.patch(span.style);
        let text: &str = &span.content;
        x = if is_plain(text) {
            put_plain(buffer, x..end, y, text, style)
        } else {
            let room = end.saturating_sub(x);
            buffer.set_stringn(x, y, text, usize::from(room), style).0
        };
    }
    Some(x)
}

/// Whether a text is printable ASCII: each byte takes one cell.
fn is_plain(text: &str) -> bool {
    text.bytes().all(|byte| matches!(byte, b' '..=b'~'))
}

/// Writes a plain text into columns of a row; returns the column after its end. Most of the screen
/// is plain, and to split it into graphemes would take a good part of the time of a frame.
fn put_plain(buffer: &mut Buffer, columns: Range<u16>, y: u16, text: &str, style: Style) -> u16 {
    let mut end = columns.start;
    for (x, byte) in columns.zip(text.bytes()) {
        buffer[(x, y)].set_char(char::from(byte)).set_style(style);
        end = x + 1;
    }
    end
}

/// As many lines of a wrapped text as fit, with a mark at the end if some are left out.
pub fn clip_rows(mut lines: Vec<String>, rows: usize, width: usize) -> Vec<String> {
    let is_cut = lines.len() > rows;
    lines.truncate(rows);
    if let Some(last) = lines.last_mut().filter(|_| is_cut) {
        *last = clip(&format!("{last} …"), width);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::ascii;
    use crate::ui::theme::Theme;

    /// Plain or not, a line is drawn as `Buffer::set_line` draws it.
    #[test]
    fn lines_are_written_as_the_library_writes_them() {
        let (red, bold) = (
            Style::new().fg(Color::Red),
            Style::new().add_modifier(Modifier::BOLD),
        );
        let line = Line::styled("", red).spans([
            Span::raw("plain "),
            Span::styled("два\u{301} слова ", bold),
            Span::raw("無人 ~"),
            Span::styled("a\tb", bold),
            Span::raw(" end"),
        ]);
        for width in 0..30 {
            let whole = Rect::new(0, 0, 26, 2);
            let area = Rect::new(2, 1, width, 1);
            let mut own = Buffer::filled(whole, ratatui::buffer::Cell::new("x"));
            let mut library = own.clone();
            let end = put(&mut own, area, 0, &line);
            let its_end = library.set_line(2, 1, &line, width).0;
            assert_eq!(own, library, "{width}");
            assert_eq!(end, (width > 0).then_some(its_end));
        }
    }

    #[test]
    fn the_marks_of_a_longer_list_cover_no_letter() {
        let (look, area) = (Look::default(), Rect::new(0, 0, 4, 4));
        let drawn = |lines: [&str; 4]| {
            let mut buffer = Buffer::empty(area);
            for (row, line) in (0..).zip(lines) {
                buffer.set_string(0, row, line, Style::default());
            }
            Panel::new(&look, area).mark_scroll(1, 9, &mut buffer);
            let row = |y| (0..4).map(|x| buffer[(x, y)].symbol()).collect::<String>();
            [0, 1, 2, 3].map(row)
        };
        let marked = ["ab ▲", "abcd", "abcd", "a  ▼"];
        assert_eq!(drawn(["ab", "abcd", "abcd", "a"]), marked);
        let marked = ["abcd", "ab ▲", "a  ▼", "abcd"];
        assert_eq!(drawn(["abcd", "ab", "a", "abcd"]), marked);
    }

    #[test]
    fn the_cursor_hides_no_state() {
        for name in Theme::names() {
            let look = Look {
                theme: Theme::named(name).expect("embedded"),
                ..Look::default()
            };
            let panel = Panel::new(&look, Rect::new(0, 0, 12, 1));
            let mut buffer = Buffer::empty(panel.area);
            buffer.set_style(panel.area, look.style(Role::Text));
            let spans = [("GUIDED ", Role::Text), ("ARMED", Role::Armed)];
            let line: Line<'_> = spans
                .map(|(text, role)| Span::styled(text, look.style(role)))
                .into_iter()
                .collect();
            put(&mut buffer, panel.area, 0, &line);
            let before = buffer.clone();
            panel.mark_cursor(&mut buffer);
            let armed = buffer[(8, 0)].style();
            assert_ne!(buffer[(0, 0)].style(), before[(0, 0)].style(), "{name}");
            assert_ne!(buffer[(0, 0)].style(), armed, "{name}");
            let is_turned = before[(8, 0)].modifier.contains(Modifier::REVERSED);
            assert!(is_turned || armed == before[(8, 0)].style(), "{name}");
        }
    }

    #[test]
    fn a_list_says_where_it_goes_on_beside_itself_or_in_its_last_column() {
        let look = Look::default();
        let marks = |columns: u16, first: usize, count: usize| -> Vec<String> {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 3));
            let list = Panel::new(&look, Rect::new(0, 0, columns, 3));
            list.mark_scroll(first, count, &mut buffer);
            let rows = buffer.content.chunks(4);
            rows.map(|row| row.iter().map(ratatui::buffer::Cell::symbol).collect())
                .collect()
        };
        assert_eq!(marks(3, 0, 3), ["    ", "    ", "    "]);
        assert_eq!(marks(3, 0, 4), ["    ", "    ", "   ▼"]);
        assert_eq!(marks(2, 1, 5), ["  ▲ ", "    ", "  ▼ "]);
        assert_eq!(marks(4, 2, 5), ["   ▲", "    ", "    "]);
    }

    #[test]
    fn the_pane_with_the_keys_has_a_heavy_rule_in_ascii_too() {
        let look = Look::default();
        let rule = |has_keys| {
            let panel = Panel::new(&look, Rect::new(0, 0, 10, 2));
            let mut buffer = Buffer::empty(panel.area);
            panel.focused("list", has_keys, &mut buffer);
            buffer.content[0].symbol().to_owned()
        };
        assert_ne!(rule(true), rule(false));
        assert_ne!(ascii::line(&rule(true)), ascii::line(&rule(false)));
    }
}
