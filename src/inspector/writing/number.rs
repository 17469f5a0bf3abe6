//! One number of a field: digits, or the names of its enum.

use super::assignment::Part;
use crate::diagnostic::Diagnostic;
use crate::inspector::definitions::{Definitions, EnumDefinition, FieldDefinition, FieldType};
use crate::text;
use crate::text::Text;

/// Whole numbers up to this are exact in an `f64`.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// The bytes of one element.
pub(super) fn bytes(field: &FieldDefinition, word: &Part<'_>) -> Result<Vec<u8>, Diagnostic> {
    match field.kind {
        FieldType::F32 => float32(field, word).map(|value| value.to_le_bytes().to_vec()),
        FieldType::F64 => float64(field, word).map(|value| value.to_le_bytes().to_vec()),
        FieldType::Char
        | FieldType::U8
        | FieldType::I8
        | FieldType::U16
        | FieldType::I16
        | FieldType::U32
        | FieldType::I32
        | FieldType::U64
        | FieldType::I64 => {
            let value = whole(field, word)?;
            let range = field.kind.range();
            if range.is_none_or(|(least, greatest)| !(least..=greatest).contains(&value)) {
                return Err(out_of_range(field, word));
            }
            // Two's complement: the lower bytes are those of the narrower type.
            Ok(value.to_le_bytes()[..field.kind.wire_len()].to_vec())
        }
    }
}

fn out_of_range(field: &FieldDefinition, word: &Part<'_>) -> Diagnostic {
    let limits = limits(field.kind);
    let message = text!("grammar-out-of-range", word = word.text, limits = limits);
    let named = vec![field.name.into(), message];
    Diagnostic::new(word.span.clone(), Text::joined(": ", named))
}

/// The range of a type as text.
pub(super) fn limits(kind: FieldType) -> Text {
    match kind.range() {
        Some((least, greatest)) => text!(
            "grammar-range",
            least = least.to_string(),
            most = greatest.to_string()
        ),
        None => text!("grammar-a-number"),
    }
}

fn float32(field: &FieldDefinition, word: &Part<'_>) -> Result<f32, Diagnostic> {
    let Ok(value) = word.text.parse::<f32>() else {
        return named(field, word).map(|value| value as f32);
    };
    let was_finite = word.text.parse::<f64>().is_ok_and(f64::is_finite);
    // `inf` itself is a value; a number that is too large is a mistake.
    if value.is_infinite() && was_finite {
        return Err(out_of_range(field, word));
    }
    Ok(value)
}

fn float64(field: &FieldDefinition, word: &Part<'_>) -> Result<f64, Diagnostic> {
    match word.text.parse::<f64>() {
        Ok(value) => Ok(value),
        Err(_) => named(field, word).map(|value| value as f64),
    }
}

/// A whole number: one number, or numbers and names joined by `|`.
fn whole(field: &FieldDefinition, word: &Part<'_>) -> Result<i128, Diagnostic> {
    match number(word.text) {
        Some(Written::Whole(value)) => Ok(value),
        Some(Written::Fraction) => {
            let message = text!("grammar-not-whole", word = word.text);
            Err(Diagnostic::new(word.span.clone(), message))
        }
        None => named(field, word).map(i128::from),
    }
}

enum Written {
    Whole(i128),
    Fraction,
}

fn number(word: &str) -> Option<Written> {
    let (sign, digits) = match word.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, word),
    };
    let hexadecimal = digits.strip_prefix("0x").or(digits.strip_prefix("0X"));
    let whole = match hexadecimal {
        Some(digits) => i128::from(u64::from_str_radix(digits, 16).ok()?),
        None => {
            if let Ok(value) = digits.parse::<u128>() {
                i128::try_from(value).unwrap_or(i128::MAX)
            } else {
                let value = digits.parse::<f64>().ok()?;
                if value.fract() != 0.0 || value.abs() > EXACT {
                    return Some(Written::Fraction);
                }
                value as i128
            }
        }
    };
    Some(Written::Whole(sign * whole))
}

/// The value of names and numbers joined by `|`.
fn named(field: &FieldDefinition, word: &Part<'_>) -> Result<u64, Diagnostic> {
    let names = field.names.and_then(|name| Definitions::get().names(name));
    let mut at = word.span.start;
    let mut value = 0;
    for text in word.text.split('|') {
        let span = at..at + text.len();
        at = span.end + 1;
        value |= match number(text) {
            Some(Written::Whole(bits)) => u64::try_from(bits).ok(),
            Some(Written::Fraction) | None => value_named(field, names, text),
        }
        .ok_or_else(|| unknown(field, names, &Part { text, span }))?;
    }
    Ok(value)
}

/// The value of an enum's name, with or without the prefix that the names of the enum share.
fn value_named(field: &FieldDefinition, names: Option<&EnumDefinition>, word: &str) -> Option<u64> {
    let upper = word.to_ascii_uppercase();
    let starts_enum = |prefix: &str| {
        let rest = field.names.and_then(|name| name.strip_prefix(prefix));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let is_it = |entry: &str| match upper.strip_suffix(entry) {
        Some("") => true,
        Some(prefix) => prefix.strip_suffix('_').is_some_and(starts_enum),
        None => false,
    };
    let mut entries = names?.entries();
    entries
        .find(|(_, entry)| is_it(entry))
        .map(|(value, _)| value)
}

fn unknown(field: &FieldDefinition, names: Option<&EnumDefinition>, word: &Part<'_>) -> Diagnostic {
    let Some((names, name)) = names.zip(field.names) else {
        let message = text!("grammar-no-number", word = word.text);
        let said = vec![field.name.into(), message];
        return Diagnostic::new(word.span.clone(), Text::joined(": ", said));
    };
    let message = text!("grammar-no-enum-name", name = name, word = word.text);
    let fault = Diagnostic::new(word.span.clone(), message);
    let upper = word.text.to_ascii_uppercase();
    let short = upper
        .strip_prefix(name)
        .map_or(upper.as_str(), |rest| rest.trim_start_matches('_'));
    fault.with_nearest(short, names.entries().map(|(_, entry)| entry))
}
