//! Completion and hints for the fields of a message: `send HEARTBEAT type=QUADROTOR`.

use super::argument::Kind;
use super::head::Head;
use super::lexer::Word;
use crate::inspector::{Definitions, EnumDefinition, FieldDefinition, MessageDefinition};
use crate::text;
use crate::text::Text;

/// The words of a line that give fields of a message.
pub(super) struct FieldWords<'a> {
    message: &'static MessageDefinition,
    words: &'a [Word<'a>],
}

impl<'a> FieldWords<'a> {
    /// The fields in the words of a line; `None` if fields cannot follow these words.
    pub fn of(head: &Head, words: &'a [Word<'a>]) -> Option<Self> {
        let (message, words) = words.get(head.len..)?.split_first()?;
        let takes_fields = head.row.takes(Kind::Fields);
        let (_, message) = Definitions::get().named(message.text)?;
        takes_fields.then_some(Self { message, words })
    }

    /// The words that may follow: names of fields with their type, or after `=` the names of values. `written` is the
    /// beginning of the next word.
    pub fn candidates(&self, written: &str) -> Vec<(String, Text)> {
        if let [.., field, sign] = self.words
            && sign.is("=")
        {
            return self.values(field, written);
        }
        let given: Vec<&str> = self
            .words
            .windows(2)
            .filter(|pair| pair[1].is("="))
            .map(|pair| pair[0].text)
            .collect();
        let is_open = |field: &&FieldDefinition| !given.contains(&field.name);
        let open = self.message.fields.iter().filter(is_open);
        open.map(|field| (format!("{}=", field.name), described(field)))
            .collect()
    }

    /// The field whose value the last words begin, with its type, unit and range.
    pub fn hint(&self) -> Option<Text> {
        let begun = match self.words {
            [.., field, sign] if sign.is("=") => field,
            [.., field, sign, _] if sign.is("=") => field,
            _ => return None,
        };
        let field = self.field(begun)?;
        let parts = vec![field.name.into(), described(field)];
        Some(Text::joined(": ", parts))
    }

    fn field(&self, word: &Word) -> Option<&'static FieldDefinition> {
        let mut fields = self.message.fields.iter();
        fields.find(|field| word.is(field.name))
    }

    /// The names of a field's values; in a mask, they complete the part after the last `|` of the
    /// word.
    fn values(&self, field: &Word, written: &str) -> Vec<(String, Text)> {
        let Some(names) = self.field(field).and_then(names_of) else {
            return Vec::new();
        };
        let before = written.rfind('|').filter(|_| names.is_mask);
        let before = before.map_or("", |at| &written[..=at]);
        let meaning = |value: u64, name: &str| {
            if before.is_empty() {
                value.to_string()
            } else {
                // The list may cut the name off behind the names before it.
                format!("{name} {value}")
            }
        };
        let entries = names.entries();
        entries
            .map(|(value, name)| (format!("{before}{name}"), meaning(value, name).into()))
            .collect()
    }
}

fn names_of(field: &FieldDefinition) -> Option<&'static EnumDefinition> {
    field.names.and_then(|name| Definitions::get().names(name))
}

/// The type of a field with its unit, and its enum or its range.
fn described(field: &FieldDefinition) -> Text {
    let mut kind = field.kind.to_string();
    if field.count > 0 {
        kind = format!("{kind}[{}]", field.count);
    }
    let mut parts: Vec<Text> = vec![kind.into()];
    if !field.unit.is_empty() {
        parts.push(Text::verbatim(field.unit));
    }
    match (field.names, field.kind.range()) {
        (Some(names), _) => parts.push(Text::verbatim(names)),
        (None, Some((least, most))) if field.count == 0 => parts.push(text!(
            "grammar-range",
            least = least.to_string(),
            most = most.to_string()
        )),
        (None, Some(_) | None) => {}
    }
    Text::joined(", ", parts)
}
