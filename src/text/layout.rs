//! Wraps text to a width.

use std::borrow::Cow;

use unicode_width::{UnicodeWidthChar as _, UnicodeWidthStr as _};

/// The units that stay on the line of their figure.
const UNITS: [&str; 25] = [
    "%", "°", "A", "Ah", "B", "dB", "dBm", "deg", "g", "h", "Hz", "kg", "km", "kW", "m", "m/s",
    "mAh", "MiB", "min", "ms", "s", "V", "W", "Wh", "µSv",
];

/// A text broken into lines of at most `width` columns, between words where possible, but not between a figure and its
/// unit. Line breaks in the text stay.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let mut lines = Vec::new();
    for paragraph in text.trim_end().split('\n') {
        let indent = paragraph.len() - paragraph.trim_start().len();
        let mut line = " ".repeat(indent.min(width / 2));
        let mut empty = true;
        for word in unbreakable(paragraph) {
            let joined = line.width() + 1 + word.width();
            if !empty && joined > width {
                lines.push(std::mem::take(&mut line));
                empty = true;
            }
            if !empty {
                line.push(' ');
            }
            empty = false;
            line.push_str(&word);
            while let Some(at) = overflow(&line, width) {
                let rest = line.split_off(break_before(&line, at));
                lines.push(std::mem::replace(&mut line, rest));
            }
        }
        lines.push(line);
    }
    lines
}

/// The words of a paragraph; a figure and the unit after it are one.
fn unbreakable(paragraph: &str) -> impl Iterator<Item = Cow<'_, str>> {
    // A no-break space belongs to the word.
    let is_gap = |c: char| c.is_whitespace() && c != '\u{a0}';
    let words = paragraph.split(is_gap).filter(|word| !word.is_empty());
    let mut words = words.peekable();
    std::iter::from_fn(move || {
        let word = words.next()?;
        let is_figure = word.ends_with(|last: char| last.is_ascii_digit());
        let unit = words.next_if(|next| is_figure && is_unit(next));
        Some(unit.map_or(Cow::Borrowed(word), |unit| format!("{word} {unit}").into()))
    })
}

/// Whether a word is a unit, perhaps with a punctuation mark after it.
fn is_unit(word: &str) -> bool {
    let bare = word.trim_end_matches(['.', ',', ';', ':', ')', '!', '?']);
    UNITS.contains(&bare)
}

/// The byte index at which a line exceeds a width; `None` if it fits. At least one character counts
/// as fitting.
fn overflow(line: &str, width: usize) -> Option<usize> {
    let mut columns = 0;
    line.char_indices()
        .find(|(at, character)| {
            columns += character.width().unwrap_or(0);
            columns > width && *at > 0
        })
        .map(|(at, _)| at)
}

/// Where to break a word that is too long for a line, at the byte index `most` or before: after the last `|` of a list of
/// choices, if there is one.
fn break_before(line: &str, most: usize) -> usize {
    let start = line.len() - line.trim_start().len();
    let choice = line[..most].rfind('|').map(|at| at + 1);
    choice.filter(|at| *at > start + 1).unwrap_or(most)
}

/// A text cut to a width, with a mark if it was too long.
pub fn clip(text: &str, width: usize) -> String {
    if text.width() <= width {
        return text.to_owned();
    }
    let mut clipped = String::new();
    for c in text.chars() {
        clipped.push(c);
        if clipped.width() + 1 > width {
            clipped.pop();
            break;
        }
    }
    if width > 0 {
        clipped.push('…');
    }
    clipped
}

/// Joins the lines of a text that was broken for another width into paragraphs: only blank and
/// indented lines stay separate.
pub fn reflow(text: &str) -> String {
    let mut flowing = String::new();
    let mut open = false;
    for line in text.trim_end().lines() {
        let joins = open && !line.trim().is_empty() && !line.starts_with(' ');
        if !flowing.is_empty() {
            flowing.push(if joins { ' ' } else { '\n' });
        }
        flowing.push_str(line.trim_end());
        open = !line.trim().is_empty() && !line.starts_with(' ');
    }
    flowing
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_wrapped_between_words() {
        assert_eq!(
            wrap("one two  three\n\nfour", 8),
            ["one two", "three", "", "four"]
        );
        assert_eq!(wrap("abcdefghij kl", 4), ["abcd", "efgh", "ij", "kl"]);
        assert_eq!(wrap("one|two|three", 9), ["one|two|", "three"]);
        assert_eq!(wrap("|three", 3), ["|th", "ree"]);
    }

    #[test]
    fn a_figure_stays_with_its_unit() {
        assert_eq!(
            wrap("at least 25 %, and 6 s", 11),
            ["at least", "25 %, and", "6 s"]
        );
        assert_eq!(wrap("for 6 seconds", 5), ["for 6", "secon", "ds"]);
    }

    #[test]
    fn a_line_does_not_break_at_a_no_break_space() {
        assert_eq!(
            wrap("4\u{a0}good  5\u{a0}very\u{a0}good", 11),
            ["4\u{a0}good", "5\u{a0}very\u{a0}good"]
        );
    }

    #[test]
    fn wide_characters_take_two_columns_each() {
        assert_eq!(wrap("無人機の群れ", 5), ["無人", "機の", "群れ"]);
        assert_eq!(wrap("無人", 1), ["無", "人"]);
    }

    #[test]
    fn paragraphs_are_broken_anew_and_lists_are_not() {
        assert_eq!(
            reflow("one\ntwo\n\nthree:\n  a\n  b\nfour\n"),
            "one two\n\nthree:\n  a\n  b\nfour"
        );
    }
}
