//! Splits a line into words.

use std::ops::Range;

/// A word and its position, in bytes of the line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Word<'a> {
    pub text: &'a str,
    pub span: Range<usize>,
    /// The line from here to the end, without a comment.
    pub tail: &'a str,
}

impl Word<'_> {
    /// Whether the word equals another one, ignoring case.
    pub fn is(&self, other: &str) -> bool {
        self.text.eq_ignore_ascii_case(other)
    }

    /// Whether the word means targets: `all`, or a word that begins with a digit or `@`.
    pub fn is_targets(&self) -> bool {
        self.is("all")
            || self
                .text
                .starts_with(|c: char| c.is_ascii_digit() || c == '@')
    }
}

/// The words of a line: separated by spaces; comparison signs are separate words; a `#` at the beginning of a word
/// starts a comment.
pub fn words(line: &str) -> Vec<Word<'_>> {
    let code = &line[..comment_start(line).unwrap_or(line.len())];
    let mut words = Vec::new();
    let mut start = None;
    let mut last = None;
    for (at, c) in code.char_indices() {
        let kind = TokenKind::of(c);
        if last != Some(kind) {
            if let Some(start) = start.take() {
                words.push(start..at);
            }
            if kind != TokenKind::Blank {
                start = Some(at);
            }
        }
        last = Some(kind);
    }
    if let Some(start) = start {
        words.push(start..code.len());
    }
    words
        .into_iter()
        .map(|span| Word {
            text: &line[span.clone()],
            tail: code[span.start..].trim_end(),
            span,
        })
        .collect()
}

/// The position at which the comment of a line begins, if it has one.
pub fn comment_start(line: &str) -> Option<usize> {
    line.match_indices('#').map(|(at, _)| at).find(|&at| {
        line[..at]
            .chars()
            .next_back()
            .is_none_or(char::is_whitespace)
    })
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum TokenKind {
    Blank,
    Letter,
    Sign,
}

impl TokenKind {
    fn of(c: char) -> Self {
        match c {
            '<' | '>' | '=' => Self::Sign,
            c if c.is_whitespace() => Self::Blank,
            _ => Self::Letter,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_where_they_are() {
        let found = words("  wait altitude>=19 # high");
        let texts: Vec<&str> = found.iter().map(|word| word.text).collect();
        assert_eq!(texts, ["wait", "altitude", ">=", "19"]);
        assert_eq!(found[2].span, 15..17);
    }

    #[test]
    fn a_hash_inside_a_word_is_no_comment() {
        assert_eq!(words("goto tree#2").len(), 2);
        assert_eq!(words("# goto").len(), 0);
    }
}
