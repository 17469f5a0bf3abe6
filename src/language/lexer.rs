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

/// The position at which the comment of a line begins, if it has one. A `#` inside a field's text (`text="no #1"`)
/// begins none.
pub fn comment_start(line: &str) -> Option<usize> {
    let mut from = 0;
    for (at, _) in line
        .match_indices('#')
        .filter(|(at, _)| begins_word(line, *at))
    {
        from = after_texts(&line[..at], from);
        let is_inside = line[from..at].contains("=\"") && closing_quote(&line[at..]).is_some();
        if !is_inside {
            return Some(at);
        }
    }
    None
}

fn begins_word(line: &str, at: usize) -> bool {
    let mut before = line[..at].chars();
    before.next_back().is_none_or(char::is_whitespace)
}

/// The end of the last whole text of a field after `from`.
fn after_texts(line: &str, mut from: usize) -> usize {
    while let Some(start) = line[from..].find("=\"").map(|at| from + at + 2) {
        let Some(end) = closing_quote(&line[start..]) else {
            return from;
        };
        from = start + end + 1;
    }
    from
}

/// The texts of fields (`text="..."`) without their quotes; the last one may be unfinished.
pub(super) fn field_texts(line: &str) -> Vec<Range<usize>> {
    let mut texts = Vec::new();
    let mut from = 0;
    while let Some(start) = line[from..].find("=\"").map(|at| from + at + 2) {
        let end = closing_quote(&line[start..]).map_or(line.len(), |at| start + at);
        texts.push(start..end);
        from = end;
    }
    texts
}

/// The position of the quote that ends a text; `\"` does not end it.
fn closing_quote(text: &str) -> Option<usize> {
    let mut is_escaped = false;
    text.bytes().position(|byte| {
        let ends = byte == b'"' && !is_escaped;
        is_escaped = byte == b'\\' && !is_escaped;
        ends
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
    fn the_texts_of_fields_are_found_without_their_quotes() {
        for (line, texts) in [
            (r#"send A a=1 b="x y" c="z \" z""#, vec!["x y", r#"z \" z"#]),
            (r#"send A b="open"#, vec!["open"]),
            (r#"send A b=""#, vec![""]),
            ("send A b=1", vec![]),
        ] {
            let found = field_texts(line).into_iter();
            let found: Vec<&str> = found.map(|text| &line[text]).collect();
            assert_eq!(found, texts, "{line}");
        }
    }

    #[test]
    fn a_hash_inside_a_word_is_no_comment() {
        assert_eq!(words("goto tree#2").len(), 2);
        assert_eq!(words("# goto").len(), 0);
    }

    #[test]
    fn a_hash_inside_the_text_of_a_field_is_no_comment() {
        for (line, comment) in [
            (
                r#"send STATUSTEXT text="no #1 # here" # why"#,
                Some("# why"),
            ),
            (r#"send STATUSTEXT text="a \" # b""#, None),
            (r#"send A text="a" # "b""#, Some(r#"# "b""#)),
            (r#"send A text="open # end"#, Some("# end")),
            (r#"bookmark 5" pipe # "x""#, Some(r#"# "x""#)),
        ] {
            let found = comment_start(line).map(|at| &line[at..]);
            assert_eq!(found, comment, "{line}");
        }
    }
}
