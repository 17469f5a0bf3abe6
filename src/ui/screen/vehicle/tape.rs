//! The heading tape: a strip of the compass that moves past a mark.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::config::Symbols;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::put;

/// The degrees per column.
const STEP_DEG: i32 = 3;
/// The spacing of numbers and of strokes, in degrees.
const NUMBER_EVERY_DEG: i32 = 30;
const STROKE_EVERY_DEG: i32 = 15;
/// The points of the compass, with the letters of compass cards in every language.
const POINTS: [(i32, &str); 4] = [(0, "N"), (90, "E"), (180, "S"), (270, "W")];

/// Draws three rows: numbers, strokes, and the heading under its mark.
pub fn draw(heading_deg: f32, panel: Panel<'_>, buffer: &mut Buffer) {
    let width = usize::from(panel.area.width);
    let (numbers, strokes) = strip(heading_deg, width, panel.look.symbols);
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(numbers, panel.style(Role::Text)),
    );
    put(
        buffer,
        panel.area,
        1,
        &Line::styled(strokes, panel.style(Role::Muted)),
    );
    let mark = match panel.look.symbols {
        Symbols::Ascii => '^',
        Symbols::Block | Symbols::Braille => '▲',
    };
    let value = format!("{mark} {}°", shown_deg(heading_deg));
    let line = format!("{}{value}", " ".repeat(width / 2));
    put(
        buffer,
        panel.area,
        2,
        &Line::styled(line, panel.style(Role::Title)),
    );
}

/// A heading as three digits, 000 to 359.
pub fn shown_deg(heading_deg: f32) -> String {
    format!("{:03}", (heading_deg.round() as i32).rem_euclid(360))
}

/// The rows of numbers and strokes; the column in the middle is the heading.
fn strip(heading_deg: f32, width: usize, symbols: Symbols) -> (String, String) {
    let stroke = if symbols == Symbols::Ascii {
        '|'
    } else {
        '╵'
    };
    let heading = (heading_deg.round() as i32).rem_euclid(360);
    let middle = (width / 2) as i32;
    let mut numbers = vec![' '; width];
    let mut strokes = vec![' '; width];
    for (column, place) in strokes.iter_mut().enumerate() {
        let from_middle = column as i32 - middle;
        // The last multiple up to this column, so that each multiple is in exactly one column.
        let degrees = heading + from_middle * STEP_DEG;
        let lands = |every: i32| degrees.rem_euclid(every) < STEP_DEG;
        if lands(STROKE_EVERY_DEG) {
            *place = stroke;
        }
        if lands(NUMBER_EVERY_DEG) {
            let number = (degrees - degrees.rem_euclid(NUMBER_EVERY_DEG)).rem_euclid(360);
            write_at(&mut numbers, column, &label(number));
        }
    }
    (numbers.into_iter().collect(), strokes.into_iter().collect())
}

fn label(degrees: i32) -> String {
    let point = POINTS.iter().find(|(at, _)| *at == degrees);
    point.map_or_else(|| degrees.to_string(), |(_, name)| (*name).to_owned())
}

/// Writes a label centred at a column, unless it does not fit.
fn write_at(row: &mut [char], column: usize, label: &str) {
    let Some(start) = column.checked_sub(label.len() / 2) else {
        return;
    };
    if start + label.len() <= row.len() {
        for (place, c) in row[start..].iter_mut().zip(label.chars()) {
            *place = c;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heading_is_in_the_middle_and_the_strip_goes_round() {
        for (heading, expected) in [
            (0.0, "     330        N        30"),
            (90.0, "     60         E        120"),
            (359.6, "     330        N        30"),
        ] {
            let (numbers, strokes) = strip(heading, 33, Symbols::Ascii);
            assert_eq!(numbers.trim_end(), expected, "{heading}");
            assert_eq!(strokes.chars().nth(16), Some('|'));
        }
        assert_eq!(shown_deg(359.7), "000");
        assert_eq!(shown_deg(7.2), "007");
    }
}
