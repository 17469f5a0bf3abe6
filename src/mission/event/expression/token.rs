//! The tokens of an expression.

use std::ops::Range;

use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The greatest length of an expression, in bytes.
pub(in crate::mission) const LONGEST: usize = 1000;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum ExpressionToken {
    Number(f64),
    Text(String),
    Name(String),
    /// An operator, a bracket, a comma or a dot.
    Sign(&'static str),
}

/// The signs; a longer one comes before its prefixes.
const SIGNS: [&str; 17] = [
    "<=", ">=", "==", "!=", "<", ">", "=", "+", "-", "*", "/", "(", ")", "[", "]", ",", ".",
];

/// A token with its position.
pub(super) type Placed = (ExpressionToken, Range<usize>);

/// Splits an expression into tokens.
pub(super) fn tokens(source: &str) -> Result<Vec<Placed>, Diagnostic> {
    if source.len() > LONGEST {
        let message = text!("fault-condition-long", most = LONGEST);
        return Err(Diagnostic::new(0..source.len(), message));
    }
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = source[at..].chars().next() {
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (token, length) = token(&source[at..], first)
            .map_err(|(length, message)| Diagnostic::new(at..at + length, message))?;
        tokens.push((token, at..at + length));
        at += length;
    }
    Ok(tokens)
}

/// The first token of the remaining text, and its length in bytes.
fn token(rest: &str, first: char) -> Result<(ExpressionToken, usize), (usize, Text)> {
    let length_of = |part: fn(char) -> bool| {
        let end = rest.find(|c| !part(c));
        end.unwrap_or(rest.len())
    };
    if first.is_ascii_digit() {
        let length = length_of(|c| c.is_ascii_alphanumeric() || c == '.');
        let written = &rest[..length];
        let number: Option<f64> = written.parse().ok();
        return match number.filter(|number| number.is_finite()) {
            Some(number) => Ok((ExpressionToken::Number(number), length)),
            None => Err((length, text!("expression-no-number", word = written))),
        };
    }
    if first.is_ascii_alphabetic() || first == '_' {
        let length = length_of(|c| c.is_ascii_alphanumeric() || c == '_');
        return Ok((ExpressionToken::Name(rest[..length].to_owned()), length));
    }
    if first == '\'' {
        return match rest[1..].find('\'') {
            Some(end) => Ok((ExpressionToken::Text(rest[1..=end].to_owned()), end + 2)),
            None => Err((rest.len(), text!("expression-open-text"))),
        };
    }
    match SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
        // A single `=` is accepted as well.
        Some(&"=") => Ok((ExpressionToken::Sign("=="), 1)),
        Some(sign) => Ok((ExpressionToken::Sign(sign), sign.len())),
        None => Err((
            first.len_utf8(),
            text!("expression-no-meaning", sign = first),
        )),
    }
}
