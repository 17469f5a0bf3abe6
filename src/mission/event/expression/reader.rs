//! The tokens of an expression, read one after another.

use super::token::{ExpressionToken, Placed};
use crate::diagnostic::Diagnostic;
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;

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
    pub fn peek(&self, wanted: &str) -> Result<&'a Placed, Diagnostic> {
        self.tokens.get(self.at).ok_or_else(|| self.missing(wanted))
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
    pub fn next(&mut self, wanted: &str) -> Result<Placed, Diagnostic> {
        let found = self.tokens.get(self.at).cloned();
        self.at += 1;
        found.ok_or_else(|| self.missing(wanted))
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
            None => Err(self.missing(&format!("`{sign}`"))),
            Some((token, span)) => {
                let message = format!("`{sign}` is needed here, not {}", named(token));
                Err(Diagnostic::new(span.clone(), message))
            }
        }
    }

    fn missing(&self, wanted: &str) -> Diagnostic {
        let message = format!("{wanted} is missing at the end");
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
                let message = format!("{} was not expected here", named(token));
                Err(Diagnostic::new(span.clone(), message))
            }
        }
    }
}

fn named(token: &ExpressionToken) -> String {
    match token {
        ExpressionToken::Number(number) => format!("`{number}`"),
        ExpressionToken::Text(text) => format!("`'{text}'`"),
        ExpressionToken::Name(name) => format!("`{name}`"),
        ExpressionToken::Sign(sign) => format!("`{sign}`"),
    }
}
