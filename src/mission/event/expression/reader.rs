//! The tokens of an expression, read one after another.

use std::ops::Range;

use super::token::{ExpressionToken, Placed};
use crate::diagnostic::Diagnostic;
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;
use crate::text;
use crate::text::Text;

/// The names that an expression may use.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::mission) struct ExpressionNames<'a> {
    pub zones: &'a [Zone],
    /// The ids of objectives, and in the next fields those of hazards, events and movers.
    pub objectives: &'a [String],
    pub hazards: &'a [String],
    pub events: &'a [String],
    pub movers: &'a [String],
    pub sensors: &'a [&'static Sensor],
    pub vehicles: usize,
    /// Whether any name will do: the mission is not known.
    pub are_open: bool,
}

/// The tokens not read yet.
pub(super) struct Reader<'a> {
    tokens: &'a [Placed],
    at: usize,
    /// The length of the source.
    end: usize,
    pub names: &'a ExpressionNames<'a>,
}

impl<'a> Reader<'a> {
    /// A reader of all tokens of a source of this length, in bytes.
    pub fn new(tokens: &'a [Placed], length: usize, names: &'a ExpressionNames<'a>) -> Self {
        Self {
            tokens,
            at: 0,
            end: length,
            names,
        }
    }

    /// The next token, without consuming it; a fault if there is none.
    pub fn peek(&self, wanted: fn() -> Text) -> Result<&'a Placed, Diagnostic> {
        self.tokens
            .get(self.at)
            .ok_or_else(|| self.missing(wanted()))
    }

    /// The operator that is next, if it is one of these; consumes it.
    pub fn one_of<T: Copy>(&mut self, among: &[(&str, T)]) -> Option<T> {
        let (token, _) = self.tokens.get(self.at)?;
        let written = match token {
            ExpressionToken::Sign(sign) => *sign,
            ExpressionToken::Name(name) => name.as_str(),
            ExpressionToken::Number(_) | ExpressionToken::Text(_) => return None,
        };
        let (_, operator) = among.iter().find(|(sign, _)| *sign == written)?;
        self.at += 1;
        Some(*operator)
    }

    /// Consumes the next token of any kind.
    pub fn next(&mut self, wanted: impl Fn() -> Text) -> Result<Placed, Diagnostic> {
        let found = self.tokens.get(self.at).cloned();
        self.at += 1;
        found.ok_or_else(|| self.missing(wanted()))
    }

    /// Whether this sign is next; if so, consumes it.
    pub fn takes(&mut self, sign: &str) -> bool {
        let is = matches!(self.tokens.get(self.at), Some((ExpressionToken::Sign(next), _)) if *next == sign);
        self.at += usize::from(is);
        is
    }

    /// Consumes this sign; a fault if it is not next.
    pub fn sign(&mut self, sign: &str) -> Result<(), Diagnostic> {
        if self.takes(sign) {
            return Ok(());
        }
        match self.tokens.get(self.at) {
            None => Err(self.missing(quoted(sign))),
            Some((token, span)) => Err(needed_not(quoted(sign), named(token), span.clone())),
        }
    }

    fn missing(&self, wanted: Text) -> Diagnostic {
        let message = text!("expression-missing", wanted = wanted);
        Diagnostic::new(self.end.saturating_sub(1)..self.end, message)
    }

    /// The end of the token that was read last.
    pub fn last_end(&self) -> usize {
        let last = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        last.map_or(0, |(_, span)| span.end)
    }

    /// Checks that no token is left.
    pub fn finish(&self) -> Result<(), Diagnostic> {
        match self.tokens.get(self.at) {
            None => Ok(()),
            Some((token, span)) => {
                let message = text!("expression-unexpected", found = named(token));
                Err(Diagnostic::new(span.clone(), message))
            }
        }
    }
}

/// The fault of a part that has to be another one.
pub(super) fn needed_not(wanted: Text, found: Text, span: Range<usize>) -> Diagnostic {
    let message = text!("expression-needed-not", wanted = wanted, found = found);
    Diagnostic::new(span, message)
}

/// A part of an expression in backticks.
pub(super) fn quoted(part: &str) -> Text {
    Text::verbatim(format!("`{part}`"))
}

fn named(token: &ExpressionToken) -> Text {
    match token {
        ExpressionToken::Number(number) => quoted(&number.to_string()),
        ExpressionToken::Text(text) => quoted(&format!("'{text}'")),
        ExpressionToken::Name(name) => quoted(name),
        ExpressionToken::Sign(sign) => quoted(sign),
    }
}
