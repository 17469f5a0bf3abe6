//! The text of an event: its arguments are inserted, its tags removed.

use super::{EventNumber, ValueNames};

/// The reader whose parts of a text are shown: a developer.
const READER: &str = "dev";
/// The most decimals of a number.
const MOST_DECIMALS: usize = 9;

/// A text with the values of its arguments.
pub(super) struct EventMessage<'a> {
    rest: &'a str,
    values: &'a [(EventNumber, Option<&'a ValueNames>)],
    written: String,
}

impl<'a> EventMessage<'a> {
    pub fn new(template: &'a str, values: &'a [(EventNumber, Option<&'a ValueNames>)]) -> Self {
        Self {
            rest: template,
            values,
            written: String::new(),
        }
    }

    /// The text on one line. What is not a place of an argument or a tag stays as it is.
    pub fn written(mut self) -> String {
        while let Some(letter) = self.rest.chars().next() {
            let after = &self.rest[letter.len_utf8()..];
            match letter {
                '\\' => {
                    let escaped = after.chars().next();
                    self.written.extend(escaped);
                    self.rest = &after[escaped.map_or(0, char::len_utf8)..];
                }
                '{' if self.argument(after) => {}
                '<' if self.tag(after) => {}
                _ => {
                    self.written.push(letter);
                    self.rest = after;
                }
            }
        }
        let is_gap = |letter: char| letter.is_whitespace() || letter.is_control();
        let words = self.written.split(is_gap).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join(" ")
    }

    /// Inserts the argument whose place begins after a brace; returns whether there is one.
    fn argument(&mut self, after: &'a str) -> bool {
        let Some((place, rest)) = after.split_once('}') else {
            return false;
        };
        let Some(value) = self.value(place) else {
            return false;
        };
        self.written.push_str(&value);
        self.rest = rest;
        true
    }

    /// The value at a place such as `1`, `2:.1`, `3m/s` or `2:.1m_v`.
    fn value(&self, place: &str) -> Option<String> {
        let (index, rest) = leading_number(place)?;
        let (number, names) = self.values.get(index.checked_sub(1)?)?;
        let (decimals, unit) = match rest.strip_prefix(':') {
            None => (None, rest),
            Some(rest) => match rest.strip_prefix('.') {
                None => (None, rest),
                Some(rest) => {
                    let (decimals, unit) = leading_number(rest)?;
                    (Some(decimals.min(MOST_DECIMALS)), unit)
                }
            },
        };
        let unit = match unit {
            "" => "",
            "m" | "m_v" => " m",
            "m/s" => " m/s",
            "m^2" => " m²",
            "C" => " °C",
            _ => return None,
        };
        let value = match (names, number, decimals) {
            (Some(names), number, _) => names.name(number.code()),
            (None, EventNumber::Unsigned(number), _) => number.to_string(),
            (None, EventNumber::Signed(number), _) => number.to_string(),
            (None, EventNumber::Float(number), Some(decimals)) => format!("{number:.decimals$}"),
            (None, EventNumber::Float(number), None) => number.to_string(),
        };
        Some(value + unit)
    }

    /// Takes in the tag that begins after an angle bracket; returns whether there is one. Texts with arguments in a
    /// link or a name stay text; a part for other readers is left out, as is any unknown tag.
    fn tag(&mut self, after: &'a str) -> bool {
        let Some((head, rest)) = after.split_once('>') else {
            return false;
        };
        let (name, attribute) = head.split_once(' ').unwrap_or((head, ""));
        if name.is_empty() || !name.bytes().all(|letter| letter.is_ascii_lowercase()) {
            return false;
        }
        let close = format!("</{name}>");
        let Some((content, rest)) = rest.split_once(close.as_str()) else {
            return false;
        };
        let shown = match name {
            "a" | "param" => true,
            "profile" => is_for_reader(attribute),
            _ => false,
        };
        if shown {
            let inner = EventMessage::new(content, self.values);
            let gap = |is_there: bool| if is_there { " " } else { "" };
            self.written
                .push_str(gap(content.starts_with(char::is_whitespace)));
            self.written.push_str(&inner.written());
            self.written
                .push_str(gap(content.ends_with(char::is_whitespace)));
        }
        self.rest = rest;
        true
    }
}

/// Whether a part with this attribute is shown: `name="dev"`, or `name="!normal"`.
fn is_for_reader(attribute: &str) -> bool {
    let name = attribute
        .strip_prefix("name=\"")
        .and_then(|name| name.strip_suffix('"'));
    match name.map(|name| name.strip_prefix('!').ok_or(name)) {
        Some(Ok(excluded)) => excluded != READER,
        Some(Err(reader)) => reader == READER,
        None => false,
    }
}

/// A whole number at the start, and what follows it.
fn leading_number(text: &str) -> Option<(usize, &str)> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, rest) = text.split_at(digits);
    Some((number.parse().ok()?, rest))
}
