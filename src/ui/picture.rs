//! Screens as pictures that a class sends, and pictures as cells.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Modifier, Style};

use crate::class::{CellStyle, Picture, PictureCell};
use crate::ui::widget::width;

/// The sixteen colours that terminals name, in the order of their numbers.
const NAMED: [Color; 16] = [
    Color::Black,
    Color::Red,
    Color::Green,
    Color::Yellow,
    Color::Blue,
    Color::Magenta,
    Color::Cyan,
    Color::Gray,
    Color::DarkGray,
    Color::LightRed,
    Color::LightGreen,
    Color::LightYellow,
    Color::LightBlue,
    Color::LightMagenta,
    Color::LightCyan,
    Color::White,
];
/// Where the numbers of each kind of colour begin; 0 is the terminal's own.
const FIRST_NAMED: u32 = 0x100;
const FIRST_INDEXED: u32 = 0x200;
const FIRST_RGB: u32 = 0x0100_0000;

/// A drawn screen as a picture.
pub fn picture(screen: &Buffer) -> Picture {
    let Rect { width, height, .. } = screen.area;
    let mut picture = Picture::blank(width, height);
    let cells = screen.content.chunks(usize::from(width).max(1));
    for (row, cells) in (0..picture.rows()).zip(cells) {
        for (column, cell) in (0..picture.columns()).zip(cells) {
            let style = CellStyle {
                foreground: number_of(cell.fg),
                background: number_of(cell.bg),
                attributes: cell.modifier.bits(),
            };
            picture.set(column, row, PictureCell::new(cell.symbol(), style));
        }
    }
    picture
}

fn number_of(colour: Color) -> u32 {
    match colour {
        Color::Reset => 0,
        Color::Indexed(index) => FIRST_INDEXED + u32::from(index),
        Color::Rgb(red, green, blue) => FIRST_RGB + u32::from_be_bytes([0, red, green, blue]),
        named => {
            let place = NAMED.iter().position(|known| *known == named);
            place.map_or(0, |place| FIRST_NAMED + place as u32)
        }
    }
}

fn colour_of(number: u32) -> Color {
    if let Some(rgb) = number.checked_sub(FIRST_RGB) {
        let [_, red, green, blue] = rgb.to_be_bytes();
        return Color::Rgb(red, green, blue);
    }
    if let Some(index) = number.checked_sub(FIRST_INDEXED) {
        return u8::try_from(index).map_or(Color::Reset, Color::Indexed);
    }
    let named = number.checked_sub(FIRST_NAMED);
    let named = named.and_then(|place| NAMED.get(place as usize));
    named.copied().unwrap_or(Color::Reset)
}

/// Draws the part of a picture that begins at a column and a row.
pub fn draw_picture(picture: &Picture, first: Position, area: Rect, buffer: &mut Buffer) {
    for row in 0..area.height {
        for column in 0..area.width {
            let shown = picture.cell(first.x + column, first.y + row);
            let (Some(shown), Some(cell)) =
                (shown, buffer.cell_mut((area.x + column, area.y + row)))
            else {
                continue;
            };
            let room = area.width - column;
            paint(shown, room, cell);
        }
    }
}

fn paint(shown: &PictureCell, room: u16, cell: &mut Cell) {
    let symbol = shown.symbol();
    let columns = width(symbol);
    // A wide character at the edge would stand outside, and a text of more columns would move all that follows.
    let fits = (1..=2).contains(&columns) && columns <= usize::from(room);
    cell.reset();
    cell.set_symbol(if fits { symbol } else { " " });
    let style = Style::new()
        .fg(colour_of(shown.style.foreground))
        .bg(colour_of(shown.style.background))
        .add_modifier(Modifier::from_bits_truncate(shown.style.attributes));
    cell.set_style(style);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_screen_survives_as_a_picture() {
        let area = Rect::new(0, 0, 30, 8);
        let mut screen = Buffer::empty(area);
        let colours = NAMED.into_iter().chain([
            Color::Reset,
            Color::Indexed(0),
            Color::Indexed(255),
            Color::Rgb(0, 0, 0),
            Color::Rgb(255, 254, 253),
        ]);
        for (column, colour) in (0..).zip(colours) {
            let style = Style::new().fg(colour).bg(colour);
            screen.set_string(column, 0, "x", style.add_modifier(Modifier::BOLD));
        }
        screen.set_string(0, 1, "Київ 漢字 e\u{301}", Style::new());
        let mut again = Buffer::empty(area);
        draw_picture(&picture(&screen), Position::ORIGIN, area, &mut again);
        assert_eq!(again, screen);
    }

    #[test]
    fn a_part_of_a_picture_is_cut_at_its_edges() {
        let mut screen = Buffer::empty(Rect::new(0, 0, 10, 3));
        screen.set_string(0, 1, "abcd漢ef", Style::new());
        let picture = picture(&screen);
        let area = Rect::new(1, 1, 4, 1);
        let mut buffer = Buffer::with_lines(["......", "......", "......"]);
        draw_picture(&picture, Position::new(1, 1), area, &mut buffer);
        assert_eq!(buffer, Buffer::with_lines(["......", ".bcd .", "......"]));
    }

    #[test]
    fn a_text_that_is_too_wide_for_its_cell_is_left_out() {
        let mut picture = Picture::blank(3, 1);
        let style = CellStyle::default();
        picture.set(0, 0, PictureCell::new("wide", style));
        picture.set(1, 0, PictureCell::new("", style));
        picture.set(2, 0, PictureCell::new("y", style));
        let area = Rect::new(0, 0, 3, 1);
        let mut buffer = Buffer::empty(area);
        draw_picture(&picture, Position::ORIGIN, area, &mut buffer);
        assert_eq!(buffer, Buffer::with_lines(["  y"]));
    }
}
