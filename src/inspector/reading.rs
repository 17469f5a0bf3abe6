//! A frame's payload, field by field.

use std::fmt;

use super::definitions::{Definitions, FieldDefinition, FieldType};
use crate::geo::maths;
use crate::wire::Anatomy;

/// The content of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct MessageReading {
    /// The message's name, if its id is known.
    pub name: Option<&'static str>,
    /// Whether the checksum is right for this definition of the message. Otherwise there are no values: the sender
    /// uses another layout, or the frame is damaged.
    pub is_verified: bool,
    /// The fields in wire order.
    pub values: Vec<FieldReading>,
}

/// The value of one field.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldReading {
    pub name: &'static str,
    /// Its unit as MAVLink spells it; empty if it has none.
    pub unit: &'static str,
    /// Its elements; more than one for an array.
    pub elements: Vec<ElementReading>,
    /// The text of a field of characters.
    pub text: Option<String>,
    /// Names of the enum value or of the bits that are set; empty if it has none.
    pub names: Vec<String>,
    /// Whether it is the value for "unknown".
    pub is_unknown: bool,
    /// Whether it is an extension field, which is zero if the sender omits it.
    pub is_extension: bool,
}

/// A number as it was sent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ElementReading {
    Unsigned(u64),
    Signed(i64),
    Single(f32),
    Double(f64),
}

impl ElementReading {
    /// The number as a point of a graph.
    pub fn number(self) -> f64 {
        match self {
            Self::Unsigned(value) => value as f64,
            Self::Signed(value) => value as f64,
            Self::Single(value) => f64::from(value),
            Self::Double(value) => value,
        }
    }
}

impl fmt::Display for ElementReading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Unsigned(value) => write!(f, "{value}"),
            Self::Signed(value) => write!(f, "{value}"),
            Self::Single(value) => f.write_str(&figure(f64::from(value), 7)),
            Self::Double(value) => f.write_str(&figure(value, 12)),
        }
    }
}

/// A number with `digits` significant digits, without trailing zeros.
pub fn figure(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let magnitude = if value == 0.0 {
        0
    } else {
        maths::log10(value.abs()).floor() as i32
    };
    if !(-5..15).contains(&magnitude) {
        return format!("{value:.*e}", (digits - 1).clamp(0, 15) as usize);
    }
    let decimals = (digits - 1 - magnitude).clamp(0, 15) as usize;
    let text = format!("{value:.decimals$}");
    let short = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if short == "-0" { "0" } else { short }.to_owned()
}

impl FieldReading {
    /// The value without its unit: quoted text, or the elements separated by blanks.
    pub fn figures(&self) -> String {
        if let Some(text) = &self.text {
            return format!("\"{text}\"");
        }
        let figures: Vec<String> = self
            .elements
            .iter()
            .map(ElementReading::to_string)
            .collect();
        figures.join(" ")
    }

    /// The number to draw: the first element; `None` without one, or if it is not finite.
    pub fn number(&self) -> Option<f64> {
        let number = self.elements.first().map(|element| element.number());
        number.filter(|number| number.is_finite())
    }
}

/// The name of a message, or its number if it has no name.
pub fn name_of(id: u32) -> String {
    let known = Definitions::get().message(id);
    known.map_or_else(|| format!("#{id}"), |message| message.name.to_owned())
}

pub fn read(frame: &Anatomy<'_>) -> MessageReading {
    let definitions = Definitions::get();
    let Some(message) = definitions.message(frame.id) else {
        return MessageReading {
            name: None,
            is_verified: false,
            values: Vec::new(),
        };
    };
    let is_verified = frame.matches(message.seed);
    let mut at = 0;
    let mut values = Vec::new();
    for field in message.fields.iter().filter(|_| is_verified) {
        values.push(value(definitions, field, frame.payload, at));
        at += field.wire_len();
    }
    MessageReading {
        name: Some(message.name),
        is_verified,
        values,
    }
}

/// Reads one field. Bytes beyond the payload's end are zero: MAVLink 2 truncates trailing zeros.
fn value(
    definitions: &Definitions,
    field: &FieldDefinition,
    payload: &[u8],
    at: usize,
) -> FieldReading {
    let bytes = padded(payload, at, field.wire_len());
    let (elements, text) = if field.kind == FieldType::Char {
        (Vec::new(), Some(text(&bytes)))
    } else {
        let elements = bytes.chunks(field.kind.wire_len());
        (
            elements.map(|bytes| element(field.kind, bytes)).collect(),
            None,
        )
    };
    let first = elements.first().copied();
    let same = |unknown: f64, found: f64| {
        (found - unknown).abs() < f64::EPSILON || found.is_nan() && unknown.is_nan()
    };
    let is_unknown = field
        .unknown
        .zip(first)
        .is_some_and(|(unknown, found)| same(unknown, found.number()));
    FieldReading {
        name: field.name,
        unit: field.unit,
        names: names(definitions, field, first),
        elements,
        text,
        is_unknown,
        is_extension: field.extension,
    }
}

/// Bytes of a payload, zero beyond its end.
pub(super) fn padded(payload: &[u8], at: usize, len: usize) -> Vec<u8> {
    let bytes = (at..at + len).map(|at| payload.get(at).copied().unwrap_or(0));
    bytes.collect()
}

fn names(
    definitions: &Definitions,
    field: &FieldDefinition,
    value: Option<ElementReading>,
) -> Vec<String> {
    let number = match value {
        Some(ElementReading::Unsigned(number)) => number,
        // A mask keeps its bits in a signed field.
        Some(ElementReading::Signed(number)) => number as u64,
        // Fractional values, as in MISSION_ITEM, are not enums.
        _ => return Vec::new(),
    };
    match field.names.and_then(|name| definitions.names(name)) {
        Some(names) if names.is_mask => names.flags(number),
        Some(names) => names.name(number).map(str::to_owned).into_iter().collect(),
        None => Vec::new(),
    }
}

/// Characters up to the first zero, with unprintable ones replaced.
fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|&byte| byte == 0);
    let text = String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len())]);
    text.chars()
        .map(|c| if c.is_control() { '\u{FFFD}' } else { c })
        .collect()
}

pub(super) fn element(kind: FieldType, bytes: &[u8]) -> ElementReading {
    let mut wide = [0; 8];
    wide[..bytes.len()].copy_from_slice(bytes);
    let bits = u64::from_le_bytes(wide);
    match kind {
        FieldType::Char | FieldType::U8 | FieldType::U16 | FieldType::U32 | FieldType::U64 => {
            ElementReading::Unsigned(bits)
        }
        FieldType::I8 => ElementReading::Signed((bits as i8).into()),
        FieldType::I16 => ElementReading::Signed((bits as i16).into()),
        FieldType::I32 => ElementReading::Signed((bits as i32).into()),
        FieldType::I64 => ElementReading::Signed(bits as i64),
        FieldType::F32 => ElementReading::Single(f32::from_bits(bits as u32)),
        FieldType::F64 => ElementReading::Double(f64::from_bits(bits)),
    }
}

#[cfg(test)]
mod tests;
