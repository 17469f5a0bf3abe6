//! Shared by the panes: labelled rows, bars, words for grades, and arrows.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::config::Symbols;
use crate::geo::wrap_360;
use crate::text::figure;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put};
use crate::vehicle::Grade;

/// The width of a label, including the space after it, in columns.
pub const LABEL: usize = 12;
/// The text for an unknown value.
pub const UNKNOWN: &str = "-";

/// A row with a label and a value.
pub fn labelled(look: &Look, label: &str, value: Vec<Span<'static>>) -> Line<'static> {
    let label = filled(label, LABEL - 1);
    let mut line = Line::from(Span::styled(format!("{label} "), look.style(Role::Muted)));
    line.extend(value);
    line
}

/// A text cut or padded to a width.
pub fn filled(text: &str, width: usize) -> String {
    let text = clip(text, width);
    let missing = width.saturating_sub(Span::raw(text.as_str()).width());
    text + &" ".repeat(missing)
}

/// Writes a line centred into the first row of an area.
pub fn centred(buffer: &mut Buffer, area: Rect, line: &Line<'_>) {
    let width = (line.width() as u16).min(area.width);
    let middle = Rect {
        x: area.x + (area.width - width) / 2,
        width,
        ..area
    };
    put(buffer, middle, 0, line);
}

/// A number with `decimals` decimals; [`UNKNOWN`] if it is not known.
pub fn number(value: Option<f32>, decimals: usize) -> String {
    value.map_or_else(|| UNKNOWN.to_owned(), |value| figure(value, decimals))
}

/// A bar that is full at 1.
pub fn bar(share: f32, width: usize, symbols: Symbols) -> String {
    let (full, empty) = match symbols {
        Symbols::Ascii => ('#', '.'),
        Symbols::Block | Symbols::Braille => ('█', '░'),
    };
    // NaN fills nothing: its cast is 0.
    let filled = ((share.clamp(0.0, 1.0) * width as f32).round() as usize).min(width);
    (0..width)
        .map(|at| if at < filled { full } else { empty })
        .collect()
}

/// The word for a grade; values of a silent vehicle are marked as old.
pub fn grade_word(look: &Look, grade: Grade, is_old: bool) -> Span<'static> {
    let (id, role) = match grade {
        _ if is_old => ("vehicle-grade-old", Role::Muted),
        Grade::Good => ("vehicle-grade-good", Role::Ok),
        Grade::Poor => ("vehicle-grade-poor", Role::Warning),
        Grade::Bad => ("vehicle-grade-bad", Role::Danger),
    };
    Span::styled(look.say(id), look.style(role))
}

/// An arrow in one of eight directions; up is straight ahead.
pub fn arrow(direction_deg: f64, symbols: Symbols) -> &'static str {
    const ARROWS: [&str; 8] = ["↑", "↗", "→", "↘", "↓", "↙", "←", "↖"];
    const LETTERS: [&str; 8] = ["^", "^>", ">", "v>", "v", "<v", "<", "<^"];
    let eighth = ((wrap_360(direction_deg) + 22.5) / 45.0) as usize % 8;
    if symbols == Symbols::Ascii {
        LETTERS[eighth]
    } else {
        ARROWS[eighth]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_none_are_not_shown() {
        for (value, expected) in [
            (Some(1.26), "1.3"),
            (Some(-0.01), "0.0"),
            (Some(-10.0), "-10.0"),
            (Some(f32::NAN), "-"),
            (Some(f32::INFINITY), "-"),
            (None, "-"),
        ] {
            assert_eq!(number(value, 1), expected);
        }
        assert_eq!(bar(f32::NAN, 4, Symbols::Ascii), "....");
        assert_eq!(bar(0.5, 4, Symbols::Ascii), "##..");
        assert_eq!(bar(7.0, 4, Symbols::Block), "████");
    }

    #[test]
    fn arrows_point_where_they_should() {
        for (direction, expected) in [
            (0.0, "↑"),
            (-10.0, "↑"),
            (44.0, "↗"),
            (270.0, "←"),
            (338.0, "↑"),
        ] {
            assert_eq!(arrow(direction, Symbols::Block), expected, "{direction}");
        }
    }
}
