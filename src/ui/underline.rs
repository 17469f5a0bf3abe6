//! Underlines only below words: a theme underlines whole roles, also the blanks with which texts are filled.

use ratatui::buffer::Buffer;
use ratatui::style::Modifier;

const UNDERLINED: Modifier = Modifier::UNDERLINED;

/// Removes the underline of blanks, except of one between two underlined words.
pub fn keep_below_words(buffer: &mut Buffer) {
    let width = usize::from(buffer.area.width).max(1);
    for row in buffer.content.chunks_mut(width) {
        for at in 0..row.len() {
            if !row[at].modifier.contains(UNDERLINED) || row[at].symbol() != " " {
                continue;
            }
            let is_word = |at: Option<usize>| {
                let cell = at.and_then(|at| row.get(at));
                cell.is_some_and(|it| it.modifier.contains(UNDERLINED) && it.symbol() != " ")
            };
            if !(is_word(at.checked_sub(1)) && is_word(Some(at + 1))) {
                row[at].modifier.remove(UNDERLINED);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use ratatui::style::Style;

    use super::*;

    #[test]
    fn blanks_around_words_are_not_underlined() {
        let mut buffer = Buffer::with_lines([""; 1]);
        buffer.resize(ratatui::layout::Rect::new(0, 0, 14, 1));
        let style = Style::new().add_modifier(UNDERLINED);
        buffer.set_string(0, 0, " a b   c      ", style);
        keep_below_words(&mut buffer);
        let mark = |cell: &ratatui::buffer::Cell| {
            if cell.modifier.contains(UNDERLINED) {
                '_'
            } else {
                ' '
            }
        };
        let marks: String = buffer.content.iter().map(mark).collect();
        assert_eq!(marks, " ___   _      ");
    }
}
