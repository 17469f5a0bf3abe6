//! The parser: from tokens to typed parts.

use std::ops::Range;

use super::ask::{self, Question};
use super::reader::{ExpressionNames, Reader, needed_not, quoted};
use super::token::{ExpressionToken, tokens};
use super::{ExpressionNode, ExpressionOperator, Type};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The greatest nesting depth of parentheses and signs.
const DEEPEST: usize = 32;

/// A part with its type and its position.
pub(super) struct Part {
    pub node: ExpressionNode,
    pub is: Type,
    pub span: Range<usize>,
}

type Read = Result<Part, Diagnostic>;

impl Part {
    /// The part after a prefix operator that begins at `start`; operand and result have the type
    /// `is`.
    fn under(
        self,
        sign: fn(Box<ExpressionNode>) -> ExpressionNode,
        is: Type,
        start: usize,
    ) -> Read {
        need(&self, is)?;
        Ok(Self {
            node: sign(Box::new(self.node)),
            span: start..self.span.end,
            is,
        })
    }
}

/// The tokens that may precede a value.
enum OperandPrefix {
    Bracket,
    Not,
    Minus,
}

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
    let mut parser = ConditionParser {
        reader: Reader::new(&tokens, source.len(), names),
        depth: 0,
    };
    let part = parser.level(0)?;
    parser.reader.finish()?;
    need(&part, Type::Bool)?;
    Ok(part.node)
}

fn a_value() -> Text {
    text!("expression-value")
}

fn need(part: &Part, wanted: Type) -> Result<(), Diagnostic> {
    if part.is == wanted {
        return Ok(());
    }
    Err(needed_not(wanted.text(), part.is.text(), part.span.clone()))
}

struct ConditionParser<'a> {
    reader: Reader<'a>,
    depth: usize,
}

impl ConditionParser<'_> {
    /// Reads a part whose operators bind at least as tightly as `level`.
    fn level(&mut self, level: usize) -> Read {
        let Some(&(operators, operand, result)) = LEVELS.get(level) else {
            return self.unary();
        };
        let mut left = self.level(level + 1)?;
        while let Some(operator) = self.reader.one_of(operators) {
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

    fn unary(&mut self) -> Read {
        let (token, span) = self.reader.peek(a_value)?;
        let (prefix, span) = match token {
            ExpressionToken::Sign("(") => (OperandPrefix::Bracket, span.clone()),
            ExpressionToken::Sign("-") => (OperandPrefix::Minus, span.clone()),
            ExpressionToken::Name(name) if name == "not" => (OperandPrefix::Not, span.clone()),
            ExpressionToken::Sign(_)
            | ExpressionToken::Name(_)
            | ExpressionToken::Number(_)
            | ExpressionToken::Text(_) => return self.primary(),
        };
        self.depth += 1;
        if self.depth > DEEPEST {
            let message = text!("expression-deep", most = DEEPEST);
            return Err(Diagnostic::new(span, message));
        }
        self.reader.next(a_value)?;
        let part = match prefix {
            OperandPrefix::Bracket => {
                let part = self.level(0)?;
                self.reader.sign(")")?;
                part
            }
            // `not` binds more loosely than a comparison: `not t > 3`.
            OperandPrefix::Not => {
                let operand = self.level(COMPARISONS)?;
                operand.under(ExpressionNode::Not, Type::Bool, span.start)?
            }
            OperandPrefix::Minus => {
                let operand = self.unary()?;
                operand.under(ExpressionNode::Negative, Type::Number, span.start)?
            }
        };
        self.depth -= 1;
        Ok(part)
    }

    fn primary(&mut self) -> Read {
        let (token, span) = self.reader.next(a_value)?;
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
                return Err(needed_not(a_value(), quoted(sign), span));
            }
        };
        Ok(Part { node, is, span })
    }

    fn question(&mut self, name: &str, span: Range<usize>) -> Read {
        let (question, is): (Question, Type) = ask::read(&mut self.reader, name, &span)?;
        Ok(Part {
            node: ExpressionNode::Ask(question),
            is,
            span: span.start..self.reader.last_end(),
        })
    }
}
