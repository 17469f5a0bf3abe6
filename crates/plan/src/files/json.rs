//! JSON with the place of each value in the text, so that faults can be shown there.

use std::ops::Range;

use crate::fault::{Expected, Fault, FaultKind, Syntax};

/// The maximum nesting depth: deeper than any of the formats uses.
const DEEPEST: usize = 64;

/// A value and its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) span: Range<usize>,
    pub(super) value: Value,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Null,
    Flag(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Object(Vec<(String, Node)>),
}

pub(super) fn parse(text: &str) -> Result<Node, Fault> {
    let mut reader = Reader { text, at: 0 };
    let root = reader.value(0)?;
    reader.skip_gaps();
    match reader.peek() {
        None => Ok(root),
        Some(_) => Err(reader.fault(Syntax::Trailing)),
    }
}

impl Node {
    fn expected(&self, what: Expected) -> Fault {
        Fault::new(self.span.clone(), FaultKind::Expected(what))
    }

    /// The value of a key of an object; the last one, if the key appears twice.
    pub(super) fn get(&self, key: &str) -> Option<&Self> {
        match &self.value {
            Value::Object(fields) => {
                let found = fields.iter().rev().find(|(name, _)| name == key);
                found.map(|(_, node)| node)
            }
            Value::Null | Value::Flag(_) | Value::Number(_) | Value::Text(_) | Value::List(_) => {
                None
            }
        }
    }

    /// The value of a key that the format requires.
    pub(super) fn need(&self, key: &'static str) -> Result<&Self, Fault> {
        if !matches!(self.value, Value::Object(_)) {
            return Err(self.expected(Expected::Object));
        }
        // Marking the whole object would hide where it begins.
        let start = self.span.start..self.span.start + 1;
        self.get(key)
            .ok_or_else(|| Fault::new(start, FaultKind::Missing(key)))
    }

    pub(super) fn number(&self) -> Result<f64, Fault> {
        match self.value {
            Value::Number(number) => Ok(number),
            Value::Null | Value::Flag(_) | Value::Text(_) | Value::List(_) | Value::Object(_) => {
                Err(self.expected(Expected::Number))
            }
        }
    }

    /// A number, or NaN for `null`.
    pub(super) fn number_or_null(&self) -> Result<f64, Fault> {
        match self.value {
            Value::Number(number) => Ok(number),
            Value::Null => Ok(f64::NAN),
            Value::Flag(_) | Value::Text(_) | Value::List(_) | Value::Object(_) => {
                Err(self.expected(Expected::NumberOrNull))
            }
        }
    }

    pub(super) fn whole<T: TryFrom<i64>>(&self) -> Result<T, Fault> {
        let number = self.number()?;
        super::number::whole(number).ok_or_else(|| self.out_of_range(number))
    }

    /// A coordinate or parameter in units of 10 to the minus `decimals`.
    pub(super) fn fixed(&self, decimals: u32) -> Result<i32, Fault> {
        let number = self.number_or_null()?;
        super::number::fixed(number, decimals).ok_or_else(|| self.out_of_range(number))
    }

    fn out_of_range(&self, number: f64) -> Fault {
        Fault::new(self.span.clone(), FaultKind::OutOfRange(number.to_string()))
    }

    pub(super) fn flag(&self) -> Result<bool, Fault> {
        match self.value {
            Value::Flag(flag) => Ok(flag),
            Value::Null | Value::Number(_) | Value::Text(_) | Value::List(_) | Value::Object(_) => {
                Err(self.expected(Expected::Flag))
            }
        }
    }

    pub(super) fn text(&self) -> Result<&str, Fault> {
        match &self.value {
            Value::Text(text) => Ok(text),
            Value::Null | Value::Flag(_) | Value::Number(_) | Value::List(_) | Value::Object(_) => {
                Err(self.expected(Expected::Text))
            }
        }
    }

    pub(super) fn list(&self) -> Result<&[Self], Fault> {
        match &self.value {
            Value::List(list) => Ok(list),
            Value::Null | Value::Flag(_) | Value::Number(_) | Value::Text(_) | Value::Object(_) => {
                Err(self.expected(Expected::List))
            }
        }
    }

    /// A list of exactly `N` values.
    pub(super) fn array<const N: usize>(&self) -> Result<&[Self; N], Fault> {
        let list = self.list()?;
        list.try_into()
            .map_err(|_| self.expected(Expected::Length(N)))
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.text
            .get(self.at..)
            .and_then(|rest| rest.chars().next())
    }

    fn fault(&self, what: Syntax) -> Fault {
        let width = self.peek().map_or(0, char::len_utf8);
        Fault::new(self.at..self.at + width, FaultKind::Syntax(what))
    }

    fn unexpected(&self) -> Fault {
        self.fault(self.peek().map_or(Syntax::End, Syntax::Unexpected))
    }

    fn skip_gaps(&mut self) {
        while let Some(c) = self
            .peek()
            .filter(|c| matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{feff}'))
        {
            self.at += c.len_utf8();
        }
    }

    fn take(&mut self, wanted: char) -> Result<(), Fault> {
        self.skip_gaps();
        if self.peek() == Some(wanted) {
            self.at += wanted.len_utf8();
            Ok(())
        } else {
            Err(self.unexpected())
        }
    }

    fn value(&mut self, depth: usize) -> Result<Node, Fault> {
        self.skip_gaps();
        if depth > DEEPEST {
            return Err(self.fault(Syntax::TooDeep));
        }
        let start = self.at;
        let value = match self.peek() {
            Some('{') => Value::Object(self.object(depth)?),
            Some('[') => Value::List(self.elements(depth)?),
            Some('"') => Value::Text(self.string()?),
            Some('-' | '0'..='9') => Value::Number(self.number()?),
            Some(_) | None => self.word()?,
        };
        Ok(Node {
            span: start..self.at,
            value,
        })
    }

    fn object(&mut self, depth: usize) -> Result<Vec<(String, Node)>, Fault> {
        let mut fields = Vec::new();
        self.take('{')?;
        self.skip_gaps();
        if self.peek() == Some('}') {
            self.at += 1;
            return Ok(fields);
        }
        loop {
            self.skip_gaps();
            let key = self.string()?;
            self.take(':')?;
            fields.push((key, self.value(depth + 1)?));
            self.skip_gaps();
            if self.peek() != Some(',') {
                self.take('}')?;
                return Ok(fields);
            }
            self.at += 1;
        }
    }

    fn elements(&mut self, depth: usize) -> Result<Vec<Node>, Fault> {
        let mut elements = Vec::new();
        self.take('[')?;
        self.skip_gaps();
        if self.peek() == Some(']') {
            self.at += 1;
            return Ok(elements);
        }
        loop {
            elements.push(self.value(depth + 1)?);
            self.skip_gaps();
            if self.peek() != Some(',') {
                self.take(']')?;
                return Ok(elements);
            }
            self.at += 1;
        }
    }

    /// Finds the closing quote; the library decodes the escapes.
    fn string(&mut self) -> Result<String, Fault> {
        if self.peek() != Some('"') {
            return Err(self.unexpected());
        }
        let bytes = self.text.as_bytes();
        let mut end = self.at + 1;
        loop {
            match bytes.get(end) {
                None => return Err(self.fault(Syntax::Text)),
                Some(b'"') => break,
                Some(b'\\') => end += 2,
                Some(_) => end += 1,
            }
        }
        let quoted = self.text.get(self.at..=end);
        let text = quoted.and_then(|quoted| serde_json::from_str(quoted).ok());
        let text = text.ok_or_else(|| self.fault(Syntax::Text))?;
        self.at = end + 1;
        Ok(text)
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let is_part = |c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | 'E');
        let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let written = &rest[..length];
        let span = self.at..self.at + length;
        self.at += length;
        let number = written
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| Fault::new(span, FaultKind::NotANumber(written.to_owned())))
    }

    fn word(&mut self) -> Result<Value, Fault> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let words = [
            ("null", Value::Null),
            ("true", Value::Flag(true)),
            ("false", Value::Flag(false)),
        ];
        for (word, value) in words {
            if rest.starts_with(word) {
                self.at += word.len();
                return Ok(value);
            }
        }
        Err(self.unexpected())
    }
}
