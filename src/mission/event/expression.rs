//! Conditions in mission files: a small language without side effects.
//!
//! An [`Expression`] is read and checked once, with the names that the mission defines. After that, evaluating it
//! cannot fail; dividing by zero gives infinity.
//!
//! ```text
//! t > 60 and inside('lane') > 0 and not vehicle(2).airborne
//! ```
//! Numbers with `+ - * /` and comparisons, `'texts'`, `true` and `false`, `and`, `or`, `not`, parentheses, and the
//! functions of `ask`.

use std::time::Duration;

use super::scope::Scope;
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

mod argument;
mod ask;
mod field;
mod parse;
mod reader;
#[cfg(test)]
mod tests;
mod token;

#[cfg(test)]
pub(in crate::mission) use ask::FUNCTIONS;
#[cfg(test)]
pub(in crate::mission) use field::field_names;
pub(in crate::mission) use reader::ExpressionNames;
pub(in crate::mission) use token::LONGEST;

/// A condition: true or false at any time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Expression(ExpressionNode);

#[derive(Debug, Clone, PartialEq)]
enum ExpressionNode {
    Number(f64),
    Bool(bool),
    Text(String),
    Ask(ask::Question),
    Not(Box<ExpressionNode>),
    Negative(Box<ExpressionNode>),
    Both(ExpressionOperator, Box<ExpressionNode>, Box<ExpressionNode>),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ExpressionOperator {
    Or,
    And,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Equal,
    Unequal,
    Plus,
    Minus,
    Times,
    Over,
}

#[derive(Debug, Clone, PartialEq)]
enum PartValue {
    Number(f64),
    Bool(bool),
    Text(String),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Type {
    Number,
    Bool,
    Text,
}

impl Type {
    fn text(self) -> Text {
        match self {
            Self::Number => text!("expression-number"),
            Self::Bool => text!("expression-condition"),
            Self::Text => text!("expression-text"),
        }
    }
}

impl Expression {
    /// Reads a condition.
    ///
    /// # Errors
    /// The first fault, with its position in the text.
    pub(in crate::mission) fn parse(
        source: &str,
        names: &ExpressionNames<'_>,
    ) -> Result<Self, Diagnostic> {
        parse::condition(source, names).map(Self)
    }

    pub fn holds(&self, scope: &Scope<'_>) -> bool {
        self.0.value(scope) == PartValue::Bool(true)
    }
}

impl ExpressionNode {
    fn value(&self, scope: &Scope<'_>) -> PartValue {
        match self {
            Self::Number(number) => PartValue::Number(*number),
            Self::Bool(is) => PartValue::Bool(*is),
            Self::Text(text) => PartValue::Text(text.clone()),
            Self::Ask(question) => question.answer(scope),
            Self::Not(part) => PartValue::Bool(part.value(scope) != PartValue::Bool(true)),
            Self::Negative(part) => PartValue::Number(-part.number(scope)),
            Self::Both(operator, left, right) => operator.apply(left, right, scope),
        }
    }

    /// The part's value as a number; the parser has checked that it has one.
    fn number(&self, scope: &Scope<'_>) -> f64 {
        match self.value(scope) {
            PartValue::Number(number) => number,
            PartValue::Bool(_) | PartValue::Text(_) => f64::NAN,
        }
    }
}

impl ExpressionOperator {
    fn apply(self, left: &ExpressionNode, right: &ExpressionNode, scope: &Scope<'_>) -> PartValue {
        let is = |node: &ExpressionNode| node.value(scope) == PartValue::Bool(true);
        let numbers = || (left.number(scope), right.number(scope));
        let compare = |holds: fn(f64, f64) -> bool| {
            let (left, right) = numbers();
            PartValue::Bool(holds(left, right))
        };
        let reckon = |of: fn(f64, f64) -> f64| {
            let (left, right) = numbers();
            PartValue::Number(of(left, right))
        };
        match self {
            Self::Or => PartValue::Bool(is(left) || is(right)),
            Self::And => PartValue::Bool(is(left) && is(right)),
            Self::Less => compare(|a, b| a < b),
            Self::AtMost => compare(|a, b| a <= b),
            Self::Greater => compare(|a, b| a > b),
            Self::AtLeast => compare(|a, b| a >= b),
            Self::Equal => PartValue::Bool(left.value(scope) == right.value(scope)),
            Self::Unequal => PartValue::Bool(left.value(scope) != right.value(scope)),
            Self::Plus => reckon(|a, b| a + b),
            Self::Minus => reckon(|a, b| a - b),
            Self::Times => reckon(|a, b| a * b),
            Self::Over => reckon(|a, b| a / b),
        }
    }
}

/// The time between evaluations of conditions.
pub(in crate::mission) const EVERY: Duration = Duration::from_millis(500);
