//! Columns: text padded or cut to a width that is the same on all terminals.

use unicode_width::{UnicodeWidthChar as _, UnicodeWidthStr as _};

use crate::notice::sanitised;

/// A time in minutes and seconds; tenths are truncated.
pub(super) fn clock(seconds: f64) -> String {
    let whole = seconds.max(0.0) as u64;
    format!("{:02}:{:02}", whole / 60, whole % 60)
}

/// Text of exactly `width` columns: padded, or cut and marked with `~`.
pub fn fit(text: &str, width: usize) -> String {
    let text = sanitised(text);
    let used = text.width();
    if used <= width {
        return text + &" ".repeat(width - used);
    }
    let mut cut = pieces(&text, width - 1).swap_remove(0);
    cut.push('~');
    let used = cut.width();
    cut + &" ".repeat(width.saturating_sub(used))
}

/// Text of exactly `width` columns, padded at its left.
pub(super) fn right(text: &str, width: usize) -> String {
    let text = fit(text, width);
    let words = text.trim_end();
    " ".repeat(width.saturating_sub(words.width())) + words
}

/// A word in pieces of at most `room` columns; combining marks stay with their letter.
pub(super) fn pieces(word: &str, room: usize) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut used = 0;
    for c in word.chars() {
        let width = c.width().unwrap_or(0);
        if used > 0 && used + width > room {
            pieces.push(String::new());
            used = 0;
        }
        used += width;
        if let Some(piece) = pieces.last_mut() {
            piece.push(c);
        }
    }
    pieces
}
