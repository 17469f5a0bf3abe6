//! Payloads from fields by name (`type=QUADROTOR custom_mode=4`), and the fields of a frame as such a text.

use super::definitions::{Definitions, FieldDefinition, FieldType, MessageDefinition};
use super::reading::{ElementReading, element, padded};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::wire::{Anatomy, is_secret};

mod assignment;
mod number;

use assignment::{Assignment, Part, assignments, elements, text_bytes};

/// The fields that name the receiver of a message.
const TARGET_SYSTEM: &str = "target_system";
const TARGET_COMPONENT: &str = "target_component";

/// A payload built from the fields of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenPayload {
    /// All fields in wire order, extensions included.
    pub bytes: Vec<u8>,
    /// The length without extensions, which MAVLink 1 does not have.
    pub base_len: usize,
    /// The position of the receiver's system id, if the message has one and the text omits it.
    pub open_system: Option<usize>,
    /// The position of the receiver's component id, if the message has one and the text omits it.
    pub open_component: Option<usize>,
}

impl WrittenPayload {
    /// The payload for a receiver, with the receiver's ids in place of those that the text omits.
    /// Extensions that are zero are left out.
    pub fn addressed(&self, system: u8, component: u8) -> Vec<u8> {
        let mut bytes = self.bytes.clone();
        for (at, id) in [(self.open_system, system), (self.open_component, component)] {
            if let Some(byte) = at.and_then(|at| bytes.get_mut(at)) {
                *byte = id;
            }
        }
        if bytes[self.base_len..].iter().all(|&byte| byte == 0) {
            bytes.truncate(self.base_len);
        }
        bytes
    }
}

/// The payload of a message with the fields of a text, such as `type=2 name="A" q=[1,0,0,0]`. Fields that the text
/// omits are 0.
///
/// # Errors
/// The first fault, with its place in the text.
pub fn write(message: &MessageDefinition, text: &str) -> Result<WrittenPayload, Diagnostic> {
    let mut bytes = vec![0; message.fields.iter().map(FieldDefinition::wire_len).sum()];
    let mut given: Vec<&str> = Vec::new();
    for assignment in assignments(text) {
        let Assignment { name, value } = assignment?;
        let (field, at) = field_named(message, &name)?;
        if given.contains(&field.name) {
            let fault = text!("grammar-field-twice", field = field.name);
            return Err(Diagnostic::new(name.span, fault));
        }
        given.push(field.name);
        let written = encoded(field, &value)?;
        bytes[at..at + written.len()].copy_from_slice(&written);
    }
    let open = |name: &str| {
        let place = placed(message).find(|(field, _)| field.name == name);
        place.filter(|_| !given.contains(&name)).map(|(_, at)| at)
    };
    let base = message.fields.iter().filter(|field| !field.extension);
    Ok(WrittenPayload {
        base_len: base.map(FieldDefinition::wire_len).sum(),
        open_system: open(TARGET_SYSTEM),
        open_component: open(TARGET_COMPONENT),
        bytes,
    })
}

/// The name and the fields of a frame as [`write()`] reads them. Fields that are 0, and the receiver, are left out.
/// `None` for a frame that cannot be decoded, and for messages with secrets.
pub fn written(frame: &Anatomy<'_>) -> Option<String> {
    let definitions = Definitions::get();
    let message = definitions.message(frame.id)?;
    if is_secret(frame.id) || !frame.matches(message.seed) {
        return None;
    }
    let mut line = message.name.to_owned();
    for (field, at) in placed(message) {
        let bytes = padded(frame.payload, at, field.wire_len());
        let is_target = [TARGET_SYSTEM, TARGET_COMPONENT].contains(&field.name);
        if !is_target && bytes.iter().any(|&byte| byte != 0) {
            line.extend([" ", field.name, "=", &decoded(definitions, field, &bytes)]);
        }
    }
    Some(line)
}

/// The receiving system of a frame; `None` if the message has none, or is for all.
pub fn target_of(frame: &Anatomy<'_>) -> Option<u8> {
    let message = Definitions::get().message(frame.id)?;
    let (_, at) = placed(message).find(|(field, _)| field.name == TARGET_SYSTEM)?;
    frame.payload.get(at).copied().filter(|&system| system != 0)
}

/// The fields with their positions in the payload.
fn placed(message: &MessageDefinition) -> impl Iterator<Item = (&FieldDefinition, usize)> {
    message.fields.iter().scan(0, |next, field| {
        let at = *next;
        *next += field.wire_len();
        Some((field, at))
    })
}

fn field_named<'a>(
    message: &'a MessageDefinition,
    name: &Part<'_>,
) -> Result<(&'a FieldDefinition, usize), Diagnostic> {
    let found = placed(message).find(|(field, _)| field.name.eq_ignore_ascii_case(name.text));
    found.ok_or_else(|| {
        let names = message.fields.iter().map(|field| field.name);
        let fault = text!(
            "grammar-no-field",
            message = message.name,
            field = name.text
        );
        let nearest = Diagnostic::new(name.span.clone(), fault).with_nearest(name.text, names);
        if nearest.help.is_some() {
            return nearest;
        }
        let names: Vec<&str> = message.fields.iter().map(|field| field.name).collect();
        nearest.with_help(text!("grammar-fields", names = names.join(", ")))
    })
}

/// The bytes of a field's value; an array may have fewer elements than the field.
fn encoded(field: &FieldDefinition, value: &Part<'_>) -> Result<Vec<u8>, Diagnostic> {
    let is_quoted = value.text.starts_with('"');
    let is_text = field.kind == FieldType::Char || is_quoted && is_bytes(field);
    let most = usize::from(field.count.max(1));
    if is_text {
        let bytes = text_bytes(value)?;
        if bytes.len() > most {
            let message = text!("grammar-field-long", field = field.name, most = most);
            return Err(Diagnostic::new(value.span.clone(), message));
        }
        return Ok(bytes);
    }
    if is_quoted {
        let message = text!("grammar-field-number", field = field.name);
        return Err(Diagnostic::new(value.span.clone(), message));
    }
    match (elements(value), field.count) {
        (None, 0) => number::bytes(field, value),
        (Some(elements), 1..) => numbers(field, &elements),
        (None, 1..) => {
            let message = text!("grammar-field-list", field = field.name, most = most);
            let advice = text!("grammar-field-list-help", field = field.name);
            Err(Diagnostic::new(value.span.clone(), message).with_help(advice))
        }
        (Some(_), 0) => {
            let message = text!("grammar-field-single", field = field.name);
            Err(Diagnostic::new(value.span.clone(), message))
        }
    }
}

/// The bytes of the elements of a list.
fn numbers(field: &FieldDefinition, elements: &[Part<'_>]) -> Result<Vec<u8>, Diagnostic> {
    let most = usize::from(field.count);
    if let Some(excess) = elements.get(most) {
        let message = text!("grammar-field-elements", field = field.name, most = most);
        return Err(Diagnostic::new(excess.span.clone(), message));
    }
    let numbers: Result<Vec<Vec<u8>>, Diagnostic> = elements
        .iter()
        .map(|element| number::bytes(field, element))
        .collect();
    Ok(numbers?.concat())
}

/// Whether a field may be written as text although it holds numbers.
fn is_bytes(field: &FieldDefinition) -> bool {
    field.kind == FieldType::U8 && field.count > 0
}

/// A field's value in the form that [`encoded`] reads.
fn decoded(definitions: &Definitions, field: &FieldDefinition, bytes: &[u8]) -> String {
    if field.kind == FieldType::Char {
        return assignment::quoted(bytes);
    }
    let chunks = bytes.chunks(field.kind.wire_len());
    let words: Vec<String> = chunks
        .map(|bytes| number_text(definitions, field, element(field.kind, bytes)))
        .collect();
    if field.count == 0 {
        return words.concat();
    }
    let used = bytes
        .iter()
        .rposition(|&byte| byte != 0)
        .map_or(0, |last| last / field.kind.wire_len() + 1);
    format!("[{}]", words[..used].join(","))
}

fn number_text(
    definitions: &Definitions,
    field: &FieldDefinition,
    value: ElementReading,
) -> String {
    let names = field.names.and_then(|name| definitions.names(name));
    let number = match value {
        ElementReading::Unsigned(number) => number,
        ElementReading::Signed(number) => match u64::try_from(number) {
            Ok(number) => number,
            Err(_) => return number.to_string(),
        },
        ElementReading::Single(number) => {
            return float_text(f64::from(number), number.to_string(), format!("{number:e}"));
        }
        ElementReading::Double(number) => {
            return float_text(number, number.to_string(), format!("{number:e}"));
        }
    };
    match names {
        Some(names) if names.is_mask && number != 0 => names.flags(number).join("|"),
        Some(names) => names
            .name(number)
            .map_or_else(|| number.to_string(), str::to_owned),
        None => number.to_string(),
    }
}

/// The shorter of two spellings of a number, both exact.
fn float_text(number: f64, plain: String, with_exponent: String) -> String {
    if number.is_finite() && with_exponent.len() < plain.len() {
        with_exponent
    } else {
        plain
    }
}

#[cfg(test)]
mod tests;
