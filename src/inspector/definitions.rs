//! The definitions of the messages: names, types, units and enums, which the dialect crate does not keep at run time.
//! Read from an embedded table at the first use.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use strum::{Display, EnumString};

/// The table of definitions; its header names the source.
const TABLE: &str = include_str!("definitions.txt");

static DEFINITIONS: LazyLock<Definitions> = LazyLock::new(|| Definitions::read(TABLE));

/// All messages and enums of the table.
#[derive(Debug, Default)]
pub struct Definitions {
    messages: BTreeMap<u32, MessageDefinition>,
    enums: BTreeMap<&'static str, EnumDefinition>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct MessageDefinition {
    /// Its name, such as `HEARTBEAT`.
    pub name: &'static str,
    /// `CRC_EXTRA`: the initial value of its checksum, so a frame with another layout does not
    /// match.
    pub seed: u8,
    /// Its fields in wire order, extension fields last.
    pub fields: Vec<FieldDefinition>,
}

/// One field of a message.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldDefinition {
    pub name: &'static str,
    /// The type of one element.
    pub kind: FieldType,
    /// The number of elements of an array; 0 for a single value.
    pub count: u8,
    /// Its unit as MAVLink spells it (`cm/s`, `degE7`); empty if it has none.
    pub unit: &'static str,
    /// The enum that names its values, if there is one.
    pub names: Option<&'static str>,
    /// The value that means "unknown", if there is one.
    pub unknown: Option<f64>,
    /// Whether it is a MAVLink 2 extension, which senders may omit.
    pub extension: bool,
}

/// The type of a field's element, little-endian on the wire.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, Display)]
#[strum(serialize_all = "lowercase")]
pub enum FieldType {
    Char,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

/// The names of an enum's values, or of a mask's bits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EnumDefinition {
    /// Whether values are bits of a mask.
    pub is_mask: bool,
    entries: BTreeMap<u64, &'static str>,
}

impl FieldType {
    /// The size on the wire, in bytes.
    pub fn wire_len(self) -> usize {
        match self {
            Self::Char | Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// The smallest and the largest value of an integer type; `None` for floating-point types.
    pub fn range(self) -> Option<(i128, i128)> {
        Some(match self {
            Self::Char | Self::U8 => (0, u8::MAX.into()),
            Self::I8 => (i8::MIN.into(), i8::MAX.into()),
            Self::U16 => (0, u16::MAX.into()),
            Self::I16 => (i16::MIN.into(), i16::MAX.into()),
            Self::U32 => (0, u32::MAX.into()),
            Self::I32 => (i32::MIN.into(), i32::MAX.into()),
            Self::U64 => (0, u64::MAX.into()),
            Self::I64 => (i64::MIN.into(), i64::MAX.into()),
            Self::F32 | Self::F64 => return None,
        })
    }
}

impl FieldDefinition {
    /// The size of all elements on the wire, in bytes.
    pub fn wire_len(&self) -> usize {
        self.kind.wire_len() * usize::from(self.count.max(1))
    }
}

impl EnumDefinition {
    /// The name of a value, without the prefix that all names of its enum share; `None` for a value
    /// without a name.
    pub fn name(&self, value: u64) -> Option<&'static str> {
        self.entries.get(&value).copied()
    }

    /// All values with their names, by value.
    pub fn entries(&self) -> impl Iterator<Item = (u64, &'static str)> {
        self.entries.iter().map(|(&value, &name)| (value, name))
    }

    /// The names of the bits that are set, the lowest bit first; bits without a name as hexadecimal numbers.
    pub fn flags(&self, value: u64) -> Vec<String> {
        let bits = (0..64)
            .map(|bit| 1u64 << bit)
            .filter(|bit| value & bit != 0);
        let name = |bit| self.name(bit).map_or(format!("{bit:#x}"), str::to_owned);
        bits.map(name).collect()
    }
}

impl Definitions {
    /// The definitions embedded in the program; read at the first call.
    pub fn get() -> &'static Self {
        &DEFINITIONS
    }

    /// The message with this id; `None` if it is unknown.
    pub fn message(&self, id: u32) -> Option<&MessageDefinition> {
        self.messages.get(&id)
    }

    /// The message with this name; case does not matter. `None` if it is unknown.
    pub fn named(&self, name: &str) -> Option<(u32, &MessageDefinition)> {
        self.messages()
            .find(|(_, message)| message.name.eq_ignore_ascii_case(name))
    }

    /// All messages by their ids.
    pub fn messages(&self) -> impl Iterator<Item = (u32, &MessageDefinition)> {
        self.messages.iter().map(|(&id, message)| (id, message))
    }

    /// The enum with this name; `None` if it is unknown.
    pub fn names(&self, name: &str) -> Option<&EnumDefinition> {
        self.enums.get(name)
    }

    /// Reads a table. Invalid lines are skipped; a test ensures that there are none.
    fn read(table: &'static str) -> Self {
        let mut read = Self::default();
        for line in table.lines().filter(|line| !line.starts_with('#')) {
            read.line(line);
        }
        read
    }

    fn line(&mut self, line: &'static str) -> Option<()> {
        let mut words = line.split(' ');
        let (first, name) = (words.next()?, words.next()?);
        if let "enum" | "bits" = first {
            let mut entries = BTreeMap::new();
            while let (Some(value), Some(entry)) = (words.next(), words.next()) {
                entries.insert(value.parse().ok()?, entry);
            }
            let is_mask = first == "bits";
            self.enums.insert(name, EnumDefinition { is_mask, entries });
            return Some(());
        }
        let seed = words.next()?.parse().ok()?;
        let mut fields = Vec::new();
        let mut extension = false;
        for word in words {
            if word == "+" {
                extension = true;
            } else {
                fields.push(field(word, extension)?);
            }
        }
        let message = MessageDefinition { name, seed, fields };
        self.messages.insert(first.parse().ok()?, message);
        Some(())
    }
}

fn field(word: &'static str, extension: bool) -> Option<FieldDefinition> {
    let mut parts = word.split(':');
    let (name, kind) = (parts.next()?, parts.next()?);
    let (kind, count) = kind.split_once('*').unwrap_or((kind, "0"));
    Some(FieldDefinition {
        name,
        kind: kind.parse().ok()?,
        count: count.parse().ok()?,
        unit: parts.next().unwrap_or_default(),
        names: parts.next().filter(|name| !name.is_empty()),
        unknown: match parts.next() {
            Some(value) => Some(value.parse().ok()?),
            None => None,
        },
        extension,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mavlink::dialects::ardupilotmega::MavMessage;
    use mavlink::{MavlinkVersion, Message as _};

    #[test]
    fn every_line_of_the_table_is_understood() {
        let mut read = Definitions::default();
        for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
            assert!(read.line(line).is_some(), "{line}");
        }
        let fields = read
            .messages()
            .flat_map(|(_, message)| message.fields.clone());
        for field in fields {
            let known = field.names.is_none_or(|name| read.names(name).is_some());
            assert!(known, "{field:?}");
        }
    }

    /// The seed is computed from the names and types of all base fields in order: identical seeds mean identical
    /// layouts. Extensions are not part of it, but their length shows when the dialect writes them.
    #[test]
    fn the_table_lays_out_every_message_of_the_dialect_as_the_dialect_does() {
        let (mut known, mut measured) = (0, 0);
        for id in 0..70_000 {
            let Some(default) = MavMessage::default_message_from_id(id) else {
                continue;
            };
            known += 1;
            let message = Definitions::get().message(id).expect("in the table");
            assert_eq!(message.name, default.message_name());
            assert_eq!(message.seed, MavMessage::extra_crc(id), "{}", message.name);
            let len: usize = message.fields.iter().map(FieldDefinition::wire_len).sum();
            // Parsing fails if an enum has no such value. Without a zero at the end, the dialect
            // writes the full length.
            if let Ok(full) = MavMessage::parse(MavlinkVersion::V2, id, &[1; 255]) {
                assert_eq!(
                    full.ser(MavlinkVersion::V2, &mut [0; 255]),
                    len,
                    "{}",
                    message.name
                );
                measured += 1;
            }
        }
        assert!(measured > 200, "{measured} messages");
        assert!(known > 250, "{known} messages");
    }

    #[test]
    fn flags_without_a_name_are_not_hidden() {
        let mask = Definitions::get().names("EKF_STATUS_FLAGS").expect("it");
        assert!(mask.is_mask);
        assert_eq!(
            mask.flags(0x8000_0003),
            ["ATTITUDE", "VELOCITY_HORIZ", "0x80000000"]
        );
    }
}
