//! Output for ASCII-only terminals: every other character is replaced by a similar one.

use ratatui::buffer::Buffer;

/// The mark of a cut text.
const CUT: &str = "…";

pub fn map(buffer: &mut Buffer) {
    let width = usize::from(buffer.area.width);
    for at in 0..buffer.content.len() {
        let cell = &mut buffer.content[at];
        if cell.symbol().is_ascii() {
            continue;
        }
        let is_cut = cell.symbol() == CUT;
        let mapped: String = cell.symbol().chars().map(nearest).take(1).collect();
        cell.set_symbol(&mapped);
        // One point would look like the end of a sentence.
        if is_cut && at % width > 0 {
            buffer.content[at - 1].set_symbol(".");
        }
    }
}

pub fn line(text: &str) -> String {
    text.replace(CUT, "..").chars().map(nearest).collect()
}

/// The most similar ASCII character; `?` for letters of other scripts.
fn nearest(c: char) -> char {
    match c {
        ' '..='~' => c,
        '─' | '╌' | '┄' | '╴' | '╶' | '–' | '—' | '−' | '‐' | '‑' | '▃' | '▄' | '░' => {
            '-'
        }
        '↕' | '│' | '┃' | '║' | '┆' | '┊' | '╎' | '▏' | '▕' | '▌' | '▐' => {
            '|'
        }
        '\u{250c}'..='\u{254b}' | '\u{2552}'..='\u{2570}' | '✚' | '✛' | '⊕' => '+',
        '╱' | '⁄' | '↗' | '↙' => '/',
        '╲' | '↖' | '↘' => '\\',
        '╳' | '×' | '✕' | '✗' | '✘' | '⨯' => 'x',
        '←' | '◀' | '◂' | '‹' | '«' | '⟵' | '≤' => '<',
        '→' | '▶' | '▸' | '›' | '»' | '⟶' | '≥' => '>',
        '↑' | '▲' | '△' | '▴' | '⇑' => '^',
        '↓' | '▼' | '▽' | '▾' | '⇓' => 'v',
        '…' | '·' | '•' | '∙' | '⋅' | '∘' => '.',
        '●' | '○' | '◉' | '◎' | '◯' | '⬤' | '□' | '▫' | '◻' => 'o',
        '✓' | '✔' | '★' | '☆' | '♦' => '*',
        '◆' => '&',
        '◇' => '%',
        '◈' => '@',
        '◐' => '$',
        '±' | '≈' | '∼' => '~',
        '²' => '2',
        '³' => '3',
        'µ' | 'μ' => 'u',
        '“' | '”' | '„' | '″' => '"',
        '‘' | '’' | 'ʼ' | '′' => '\'',
        '⚠' => '!',
        // A letter or a digit would read as part of the number before it, a quotation mark would read as minutes.
        '°' | 'º' | '\u{a0}' | '\u{2000}'..='\u{200a}' | '\u{2800}' => ' ',
        '▁' | '▂' | '⎽' => '_',
        '◧' | '━' | '═' | '▅' | '▆' | '▒' => '=',
        '▇' | '█' | '▀' | '▓' | '■' | '▪' | '◼' => '#',
        // Braille patterns, by the number of their dots.
        '\u{2801}'..='\u{28ff}' => match (u32::from(c) - 0x2800).count_ones() {
            1 | 2 => '.',
            3 | 4 => ':',
            _ => '#',
        },
        _ => '?',
    }
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;
    use ratatui::widgets::{Block, Widget as _};

    use super::*;

    #[test]
    fn frames_arrows_dots_and_blocks_keep_their_meaning() {
        let mapped = line("┌──┐│→↑… 5° ×2 ▁▄█ ⠁⣿ ● ✓ висота");
        assert_eq!(mapped, "+--+|>^.. 5  x2 _-# .# o * ??????");
        assert_eq!(line("±0.3 m ↕ 0.4 m"), "~0.3 m | 0.4 m");
    }

    #[test]
    fn a_cut_text_ends_in_two_points() {
        let mut buffer = Buffer::with_lines(["landed and… │", "…           "]);
        map(&mut buffer);
        assert_eq!(
            buffer,
            Buffer::with_lines(["landed an.. |", ".           "])
        );
    }

    #[test]
    fn no_cell_keeps_anything_else_and_wide_letters_take_no_more_room() {
        let area = Rect::new(0, 0, 12, 3);
        let mut buffer = Buffer::empty(area);
        Block::bordered().title("東京 é⣤").render(area, &mut buffer);
        map(&mut buffer);
        for cell in &buffer.content {
            assert!(
                cell.symbol().is_ascii() && cell.symbol().len() == 1,
                "{cell:?}"
            );
        }
        assert_eq!(buffer.content[11].symbol(), "+");
    }
}
