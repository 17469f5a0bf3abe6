//! `NAME=VALUE` pairs in a text, with their places.

use std::fmt::Write as _;
use std::ops::Range;

use crate::diagnostic::Diagnostic;
use crate::text;

/// A part of the text and its place in bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Part<'a> {
    pub text: &'a str,
    pub span: Range<usize>,
}

impl<'a> Part<'a> {
    fn of(text: &'a str, span: Range<usize>) -> Self {
        let text = &text[span.clone()];
        Self { text, span }
    }

    fn trimmed(&self) -> Self {
        let start = self.span.start + self.text.len() - self.text.trim_start().len();
        let text = self.text.trim();
        let span = start..start + text.len();
        Self { text, span }
    }
}

/// One field with its value as typed.
#[derive(Debug)]
pub(super) struct Assignment<'a> {
    pub name: Part<'a>,
    pub value: Part<'a>,
}

/// The fields of a text in order. After a fault, nothing more is read.
pub(super) fn assignments(text: &str) -> impl Iterator<Item = Result<Assignment<'_>, Diagnostic>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        at = after_blanks(text, at);
        if at == text.len() {
            return None;
        }
        let read = assignment(text, at);
        at = read.as_ref().map_or(text.len(), |read| read.value.span.end);
        Some(read)
    })
}

fn assignment(text: &str, at: usize) -> Result<Assignment<'_>, Diagnostic> {
    let is_end = |c: char| c == '=' || c.is_whitespace();
    let name = Part::of(text, at..at + length_to(&text[at..], is_end));
    let sign = after_blanks(text, name.span.end);
    let start = after_blanks(text, sign + usize::from(text[sign..].starts_with('=')));
    if name.text.is_empty() || start == sign || start == text.len() {
        let end = name.span.end.max(at + usize::from(name.text.is_empty()));
        let fault = text!("grammar-field-value", field = name.text);
        return Err(Diagnostic::new(at..end, fault).with_help(text!("grammar-field-value-help")));
    }
    let span = start..value_end(text, start)?;
    let value = Part::of(text, span);
    Ok(Assignment { name, value })
}

fn value_end(text: &str, start: usize) -> Result<usize, Diagnostic> {
    let rest = &text[start..];
    let closing = match rest.as_bytes().first() {
        Some(b'"') => closing_quote(rest),
        Some(b'[') => rest.find(']'),
        Some(_) | None => return Ok(start + length_to(rest, char::is_whitespace)),
    };
    let missing = || {
        let sign = if rest.starts_with('"') { "\"" } else { "]" };
        let fault = text!("grammar-field-open", sign = sign);
        Diagnostic::new(start..text.trim_end().len(), fault)
    };
    closing.map(|at| start + at + 1).ok_or_else(missing)
}

/// The position of the quote that ends a text beginning with a quote; `\"` does not end it.
fn closing_quote(text: &str) -> Option<usize> {
    let mut is_escaped = true;
    text.bytes().position(|byte| {
        let ends = byte == b'"' && !is_escaped;
        is_escaped = byte == b'\\' && !is_escaped;
        ends
    })
}

fn length_to(text: &str, is_end: impl Fn(char) -> bool) -> usize {
    text.find(is_end).unwrap_or(text.len())
}

fn after_blanks(text: &str, at: usize) -> usize {
    at + length_to(&text[at..], |c| !c.is_whitespace())
}

/// The elements of a list in brackets; `None` for any other value.
pub(super) fn elements<'a>(value: &Part<'a>) -> Option<Vec<Part<'a>>> {
    let inner = value.text.strip_prefix('[')?.strip_suffix(']')?;
    if inner.trim().is_empty() {
        return Some(Vec::new());
    }
    let mut at = value.span.start + 1;
    let parts = inner.split(',').map(|text| {
        let span = at..at + text.len();
        at = span.end + 1;
        Part { text, span }.trimmed()
    });
    Some(parts.collect())
}

/// The bytes of a text: a bare word, or in quotes with the escapes `\"`, `\\` and `\xNN`.
pub(super) fn text_bytes(value: &Part<'_>) -> Result<Vec<u8>, Diagnostic> {
    let Some(quoted) = value.text.strip_prefix('"') else {
        return Ok(value.text.as_bytes().to_vec());
    };
    let inner = quoted.strip_suffix('"').unwrap_or(quoted);
    let mut bytes = Vec::new();
    let mut rest = inner;
    while let Some(at) = rest.find('\\') {
        bytes.extend_from_slice(&rest.as_bytes()[..at]);
        let escape = &rest[at + 1..];
        let (byte, len) = escaped(escape).ok_or_else(|| {
            let start = value.span.end - 1 - rest.len() + at;
            Diagnostic::new(start..start + 1, text!("grammar-field-escape"))
        })?;
        bytes.push(byte);
        rest = &escape[len..];
    }
    bytes.extend_from_slice(rest.as_bytes());
    Ok(bytes)
}

/// The byte of an escape without its `\`, and the length of the escape.
fn escaped(escape: &str) -> Option<(u8, usize)> {
    match escape.as_bytes().first()? {
        &sign @ (b'"' | b'\\') => Some((sign, 1)),
        b'x' => Some((u8::from_str_radix(escape.get(1..3)?, 16).ok()?, 3)),
        _ => None,
    }
}

/// Bytes as a text in quotes, without the zeros at their end. `#` is escaped because it could begin a comment.
pub(super) fn quoted(bytes: &[u8]) -> String {
    let used = bytes
        .iter()
        .rposition(|&byte| byte != 0)
        .map_or(0, |last| last + 1);
    let mut text = String::from("\"");
    for &byte in &bytes[..used] {
        match byte {
            b'"' | b'\\' => text.extend(['\\', char::from(byte)]),
            b' '..=b'~' if byte != b'#' => text.push(char::from(byte)),
            // Writing to a string cannot fail.
            _ => write!(text, "\\x{byte:02x}").unwrap_or_default(),
        }
    }
    text.push('"');
    text
}
