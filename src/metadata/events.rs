//! The texts of events (`all_events.json` of PX4, the format of libevents): by number, with places for arguments.
//!
//! An event's number is the component's in its highest byte, and the event's own in the others. Arguments are numbers in
//! the order of their description, without gaps, the lowest byte first; an enum stands for a number. A text has
//! arguments as `{1}` or `{2:.1m}`: place, decimals, unit; and tags: `<param>NAME</param>`, `<a href="..">..</a>`, and
//! `<profile name="dev">..</profile>` for some readers.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use self::message::EventMessage;
use crate::text;
use crate::text::Text;

mod message;

/// The version of the format that is read.
const VERSION: u64 = 2;

/// The texts of events, by number.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EventDocuments {
    by_id: BTreeMap<u32, EventDocument>,
}

/// A file of events, as far as it could be read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadEvents {
    pub documents: EventDocuments,
    /// What was left out.
    pub faults: Vec<Text>,
}

#[derive(Debug, Clone, PartialEq)]
struct EventDocument {
    message: String,
    arguments: Vec<EventArgument>,
}

/// The type of an argument, with the names of its values.
#[derive(Debug, Clone, PartialEq)]
struct EventArgument {
    kind: NumberType,
    names: Option<ValueNames>,
}

/// The names of an enum's values.
#[derive(Debug, Clone, Default, PartialEq)]
struct ValueNames {
    by_value: BTreeMap<u64, String>,
    /// What separates the names of several bits; `None` if the values are not bits.
    separator: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NumberType {
    Unsigned(usize),
    Signed(usize),
    Float,
}

/// The value of an argument.
#[derive(Debug, Clone, Copy, PartialEq)]
enum EventNumber {
    Unsigned(u64),
    Signed(i64),
    Float(f32),
}

#[derive(Deserialize)]
struct File {
    version: u64,
    #[serde(default)]
    components: BTreeMap<String, EventComponent>,
}

#[derive(Deserialize)]
struct EventComponent {
    #[serde(default)]
    namespace: String,
    #[serde(default)]
    enums: BTreeMap<String, Enum>,
    #[serde(default)]
    event_groups: BTreeMap<String, Group>,
}

#[derive(Deserialize)]
struct Enum {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    is_bitfield: bool,
    separator: Option<String>,
    #[serde(default)]
    entries: BTreeMap<String, ValueName>,
}

#[derive(Deserialize)]
struct ValueName {
    #[serde(default)]
    description: String,
}

#[derive(Deserialize)]
struct Group {
    // A fault in one event leaves the others.
    #[serde(default)]
    events: BTreeMap<String, Value>,
}

#[derive(Deserialize)]
struct DocumentedEvent {
    message: String,
    #[serde(default)]
    arguments: Vec<ArgumentEntry>,
}

#[derive(Deserialize)]
struct ArgumentEntry {
    #[serde(rename = "type")]
    kind: String,
}

impl EventDocuments {
    /// Reads a file of events.
    ///
    /// # Errors
    /// It is not JSON of the expected form, of another version, or documents no event.
    pub fn read(source: &str) -> Result<ReadEvents, Text> {
        let file: File = serde_json::from_str(source.trim_start_matches('\u{feff}'))
            .map_err(|error| text!("documentation-json", fault = error.to_string()))?;
        if file.version != VERSION {
            return Err(text!("events-version", version = file.version.to_string()));
        }
        let enums = Enums::of(&file.components);
        let mut read = ReadEvents::default();
        for (number, component) in &file.components {
            let Ok(number) = number.parse::<u8>() else {
                continue;
            };
            let groups = component.event_groups.values();
            for (own, event) in groups.flat_map(|group| &group.events) {
                match enums.document(own, event, component) {
                    Ok((own, document)) => {
                        let id = u32::from(number) << 24 | own;
                        read.documents.by_id.insert(id, document);
                    }
                    Err(fault) => read.faults.push(fault),
                }
            }
        }
        if read.documents.is_empty() {
            return Err(text!("events-nothing"));
        }
        Ok(read)
    }

    /// The text of an event with its arguments, on one line; `None` if it is not documented, or its arguments are cut off.
    pub fn text(&self, id: u32, arguments: &[u8]) -> Option<String> {
        let document = self.by_id.get(&id)?;
        let mut rest = arguments;
        let mut values = Vec::new();
        for argument in &document.arguments {
            let (bytes, after) = rest.split_at_checked(argument.kind.size())?;
            let number = argument.kind.number(bytes);
            values.push((number, argument.names.as_ref()));
            rest = after;
        }
        Some(EventMessage::new(&document.message, &values).written())
    }

    /// The number of documented events.
    pub fn len(&self) -> usize {
        self.by_id.len()
    }

    /// Whether no event is documented.
    pub fn is_empty(&self) -> bool {
        self.by_id.is_empty()
    }
}

/// The enums of all components, by namespace and name.
struct Enums(BTreeMap<String, (NumberType, ValueNames)>);

impl Enums {
    fn of(components: &BTreeMap<String, EventComponent>) -> Self {
        let all = components.values().flat_map(|component| {
            component.enums.iter().filter_map(|(name, listed)| {
                let kind = NumberType::named(&listed.kind)?;
                let named = format!("{}::{name}", component.namespace);
                Some((named, (kind, listed.names())))
            })
        });
        Self(all.collect())
    }

    /// The own number of an event, and its text.
    fn document(
        &self,
        own: &str,
        event: &Value,
        component: &EventComponent,
    ) -> Result<(u32, EventDocument), Text> {
        let fault = |fault: String| text!("events-fault", event = own, fault = fault);
        let id = own.parse::<u32>().ok().filter(|id| *id < 1 << 24);
        let id = id.ok_or_else(|| text!("events-no-number", written = own))?;
        let event =
            DocumentedEvent::deserialize(event).map_err(|error| fault(error.to_string()))?;
        let mut arguments = Vec::new();
        for entry in &event.arguments {
            let argument = self.argument(&entry.kind, &component.namespace);
            arguments.push(argument.ok_or_else(|| fault(entry.kind.clone()))?);
        }
        let message = event.message;
        Ok((id, EventDocument { message, arguments }))
    }

    fn argument(&self, kind: &str, namespace: &str) -> Option<EventArgument> {
        if let Some(kind) = NumberType::named(kind) {
            return Some(EventArgument { kind, names: None });
        }
        let own = || self.0.get(&format!("{namespace}::{kind}"));
        let (kind, names) = self.0.get(kind).or_else(own)?;
        Some(EventArgument {
            kind: *kind,
            names: Some(names.clone()),
        })
    }
}

impl Enum {
    fn names(&self) -> ValueNames {
        let entries = self.entries.iter();
        let named = entries.filter_map(|(value, entry)| {
            let value = value.parse().ok()?;
            Some((value, entry.description.clone()))
        });
        let separator = || self.separator.clone().unwrap_or_else(|| "|".to_owned());
        ValueNames {
            by_value: named.collect(),
            separator: self.is_bitfield.then(separator),
        }
    }
}

impl ValueNames {
    /// The name of a value, or of its bits.
    fn name(&self, value: u64) -> String {
        let known = |value: u64| {
            let name = self.by_value.get(&value);
            name.map_or_else(|| value.to_string(), Clone::clone)
        };
        match &self.separator {
            None => known(value),
            Some(separator) => {
                let bits = (0..u64::BITS).map(|bit| 1 << bit);
                let set: Vec<String> = bits.filter(|bit| value & bit != 0).map(known).collect();
                set.join(separator)
            }
        }
    }
}

impl NumberType {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "uint8_t" => Self::Unsigned(1),
            "uint16_t" => Self::Unsigned(2),
            "uint32_t" => Self::Unsigned(4),
            "uint64_t" => Self::Unsigned(8),
            "int8_t" => Self::Signed(1),
            "int16_t" => Self::Signed(2),
            "int32_t" => Self::Signed(4),
            "int64_t" => Self::Signed(8),
            "float" => Self::Float,
            _ => return None,
        })
    }

    /// The number of bytes.
    fn size(self) -> usize {
        match self {
            Self::Unsigned(size) | Self::Signed(size) => size,
            Self::Float => 4,
        }
    }

    /// The number in that many bytes.
    fn number(self, bytes: &[u8]) -> EventNumber {
        let mut all = [0; 8];
        all[..bytes.len()].copy_from_slice(bytes);
        let number = u64::from_le_bytes(all);
        match self {
            Self::Unsigned(_) => EventNumber::Unsigned(number),
            Self::Signed(size) => {
                let unused = 64 - 8 * size as u32;
                EventNumber::Signed((number << unused).cast_signed() >> unused)
            }
            Self::Float => EventNumber::Float(f32::from_bits(number as u32)),
        }
    }
}

impl EventNumber {
    /// As a number of an enum.
    fn code(self) -> u64 {
        match self {
            Self::Unsigned(number) => number,
            Self::Signed(number) => number.cast_unsigned(),
            Self::Float(number) => number as u64,
        }
    }
}

#[cfg(test)]
mod tests;
