//! The parser: from tokens to typed parts.

use std::ops::Range;

use super::argument::ExpressionNames;
use super::ask::{self, Question};
use super::token::{ExpressionToken, Placed, tokens};
use super::{ExpressionNode, ExpressionOperator, Type};
use crate::diagnostic::Diagnostic;

/// The greatest nesting depth of parentheses and signs.
const DEEPEST: usize = 32;

/// A part with its type and its position.
pub(super) struct Part {
    pub node: ExpressionNode,
    pub is: Type,
    pub span: Range<usize>,
}

type Read = Result<Part, Diagnostic>;

/// Operators of equal precedence, the type of their operands, and that of the result.
type Level = (&'static [(&'static str, ExpressionOperator)], Type, Type);

/// Operators by precedence, the loosest first; each with the types of its operands and of its result.
const LEVELS: [Level; 5] = [
    (&[("or", ExpressionOperator::Or)], Type::Bool, Type::Bool),
    (&[("and", ExpressionOperator::And)], Type::Bool, Type::Bool),
    (
        &[
            ("<", ExpressionOperator::Less),
            ("<=", ExpressionOperator::AtMost),
            (">", ExpressionOperator::Greater),
            (">=", ExpressionOperator::AtLeast),
            ("==", ExpressionOperator::Equal),
            ("!=", ExpressionOperator::Unequal),
        ],
        Type::Number,
        Type::Bool,
    ),
    (
        &[
            ("+", ExpressionOperator::Plus),
            ("-", ExpressionOperator::Minus),
        ],
        Type::Number,
        Type::Number,
    ),
    (
        &[
            ("*", ExpressionOperator::Times),
            ("/", ExpressionOperator::Over),
        ],
        Type::Number,
        Type::Number,
    ),
];
/// The level of comparisons, which cannot be chained.
const COMPARISONS: usize = 2;

pub(super) fn condition(
    source: &str,
    names: &ExpressionNames<'_>,
) -> Result<ExpressionNode, Diagnostic> {
    let tokens = tokens(source)?;
    let mut reader = Reader {
        tokens: &tokens,
        at: 0,
        end: source.len(),
        depth: 0,
        names,
    };
    let part = reader.level(0)?;
    if let Some((token, span)) = reader.tokens.get(reader.at) {
        let message = format!("{} was not expected here", named(token));
        return Err(Diagnostic::new(span.clone(), message));
    }
    need(&part, Type::Bool)?;
    Ok(part.node)
}

/// A fault if a part does not have the type.
fn need(part: &Part, wanted: Type) -> Result<(), Diagnostic> {
    if part.is == wanted {
        return Ok(());
    }
    let message = format!("{} is needed here, not {}", wanted.name(), part.is.name());
    Err(Diagnostic::new(part.span.clone(), message))
}

fn named(token: &ExpressionToken) -> String {
    match token {
        ExpressionToken::Number(number) => format!("`{number}`"),
        ExpressionToken::Text(text) => format!("`'{text}'`"),
        ExpressionToken::Name(name) => format!("`{name}`"),
        ExpressionToken::Sign(sign) => format!("`{sign}`"),
    }
}

/// The tokens not read yet.
pub(super) struct Reader<'a> {
    tokens: &'a [Placed],
    at: usize,
    end: usize,
    depth: usize,
    pub names: &'a ExpressionNames<'a>,
}

impl Reader<'_> {
    /// Reads a part whose operators bind at least as tightly as `level`.
    fn level(&mut self, level: usize) -> Read {
        let Some(&(operators, operand, result)) = LEVELS.get(level) else {
            return self.unary();
        };
        let mut left = self.level(level + 1)?;
        while let Some(operator) = self.operator(operators) {
            let right = self.level(level + 1)?;
            // Texts and conditions can be compared for equality only.
            let same = matches!(
                operator,
                ExpressionOperator::Equal | ExpressionOperator::Unequal
            );
            let operand = if same { left.is } else { operand };
            need(&left, operand)?;
            need(&right, operand)?;
            left = Part {
                span: left.span.start..right.span.end,
                node: ExpressionNode::Both(operator, Box::new(left.node), Box::new(right.node)),
                is: result,
            };
            if level == COMPARISONS {
                break;
            }
        }
        Ok(left)
    }

    fn operator(&mut self, among: &[(&str, ExpressionOperator)]) -> Option<ExpressionOperator> {
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

    fn unary(&mut self) -> Read {
        let Some((token, span)) = self.tokens.get(self.at) else {
            return Err(self.missing("a value"));
        };
        let start = span.start;
        let not = *token == ExpressionToken::Name("not".into());
        let negative = *token == ExpressionToken::Sign("-");
        let bracket = *token == ExpressionToken::Sign("(");
        if !(not || negative || bracket) {
            return self.primary();
        }
        self.depth += 1;
        if self.depth > DEEPEST {
            let message =
                format!("brackets and signs are nested too deeply: at most {DEEPEST} levels");
            return Err(Diagnostic::new(span.clone(), message));
        }
        self.at += 1;
        let part = if bracket {
            let part = self.level(0)?;
            self.sign(")")?;
            part
        } else if not {
            // `not` binds more loosely than a comparison: `not t > 3`.
            let part = self.level(COMPARISONS)?;
            need(&part, Type::Bool)?;
            Part {
                node: ExpressionNode::Not(Box::new(part.node)),
                span: start..part.span.end,
                is: Type::Bool,
            }
        } else {
            let part = self.unary()?;
            need(&part, Type::Number)?;
            Part {
                node: ExpressionNode::Negative(Box::new(part.node)),
                span: start..part.span.end,
                is: Type::Number,
            }
        };
        self.depth -= 1;
        Ok(part)
    }

    fn primary(&mut self) -> Read {
        let (token, span) = self.next("a value")?;
        let (node, is) = match token {
            ExpressionToken::Number(number) => (ExpressionNode::Number(number), Type::Number),
            ExpressionToken::Text(text) => (ExpressionNode::Text(text), Type::Text),
            ExpressionToken::Name(name) if name == "true" => {
                (ExpressionNode::Bool(true), Type::Bool)
            }
            ExpressionToken::Name(name) if name == "false" => {
                (ExpressionNode::Bool(false), Type::Bool)
            }
            ExpressionToken::Name(name) => return self.question(&name, span),
            ExpressionToken::Sign(sign) => {
                let message = format!("a value is needed here, not `{sign}`");
                return Err(Diagnostic::new(span, message));
            }
        };
        Ok(Part { node, is, span })
    }

    fn question(&mut self, name: &str, span: Range<usize>) -> Read {
        let (question, is): (Question, Type) = ask::read(self, name, &span)?;
        let end = self.tokens[self.at - 1].1.end;
        Ok(Part {
            node: ExpressionNode::Ask(question),
            is,
            span: span.start..end,
        })
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
}
