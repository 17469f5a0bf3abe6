//! The keyring as a text file.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use super::{KeyInUse, Keyring, SecretKey, SignedStream, VehicleKeys};
use crate::text;
use crate::text::Text;
use crate::wire::SystemId;

const HEAD: &str = "\
# Keys of MAVLink signing, written by sortie. Anyone with these keys can command the vehicles: keep the file to yourself.
# `key` is the key of a vehicle, `next` one that it may have received. The timestamps of sortie continue from `stamp`.
";
/// The length of a key in the file: two hexadecimal digits for each byte.
const DIGITS: usize = 64;

/// The line at which the text of a keyring is not valid. The content is left out, because it may be
/// a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KeyringFault {
    pub line: usize,
}

impl From<KeyringFault> for Text {
    fn from(fault: KeyringFault) -> Self {
        text!("signing-file-fault", line = fault.line)
    }
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct KeyringDocument {
    stamp: u64,
    vehicle: Vec<VehicleRow>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct VehicleRow {
    system: SystemId,
    link: String,
    key: Option<String>,
    next: Option<String>,
    /// The key in use; by default `key`, so that a key can be added by hand.
    #[serde(default)]
    uses: Uses,
    /// The last timestamps received, by component and link id: `1/0`.
    #[serde(default)]
    heard: BTreeMap<String, u64>,
}

#[derive(Clone, Copy, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Uses {
    Nothing,
    #[default]
    Key,
    Next,
}

impl std::fmt::Debug for VehicleRow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("VehicleRow").field(&self.system).finish()
    }
}

impl Keyring {
    /// Reads a keyring; an empty text gives an empty keyring.
    ///
    /// # Errors
    /// The line of the first fault.
    pub fn read(text: &str) -> Result<Self, KeyringFault> {
        let document: KeyringDocument = toml::from_str(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            fault_at(text, at)
        })?;
        let mut ring = Self {
            clock: document.stamp,
            reserved: document.stamp,
            ..Self::default()
        };
        for row in document.vehicle {
            let Some(keys) = row.keys() else {
                let link = text.find(&format!("{:?}", row.link));
                return Err(fault_at(text, link.unwrap_or_default()));
            };
            let vehicles = ring.links.entry(row.link).or_default();
            vehicles.insert(row.system, keys);
        }
        Ok(ring)
    }

    /// The text of the file at this machine's time `wall`, with the last stamp that may be used
    /// once it is written: pass it to [`Self::written`].
    pub fn write(&mut self, wall: u64) -> (String, u64) {
        self.has_changed = false;
        self.is_asked = false;
        let reserved = self.reserve(wall);
        let rows = self.links.iter().flat_map(|(link, vehicles)| {
            vehicles
                .iter()
                .map(|(&system, keys)| VehicleRow::of(link, system, keys))
        });
        let document = KeyringDocument {
            stamp: reserved,
            vehicle: rows.collect(),
        };
        let mut text = HEAD.to_owned();
        // Numbers, texts and tables always have a TOML form.
        text.push_str(&toml::to_string(&document).unwrap_or_default());
        (text, reserved)
    }

    /// Notes that the text from [`Self::write`] is in its file.
    pub fn written(&mut self, reserved: u64) {
        self.reserved = self.reserved.max(reserved);
    }

    /// Notes that the text from [`Self::write`] could not be written: the write is retried with the
    /// next change of a key, or once the timestamps are used up.
    pub fn unwritten(&mut self) {
        self.is_asked = true;
    }
}

impl VehicleRow {
    fn of(link: &str, system: SystemId, keys: &VehicleKeys) -> Self {
        let heard = keys.heard.iter().map(|(stream, &stamp)| {
            let name = format!("{}/{}", stream.component, stream.link);
            (name, stamp)
        });
        Self {
            system,
            link: link.to_owned(),
            key: keys.current.as_ref().map(digits),
            next: keys.next.as_ref().map(digits),
            uses: match keys.uses {
                KeyInUse::Nothing => Uses::Nothing,
                KeyInUse::Current => Uses::Key,
                KeyInUse::Next => Uses::Next,
            },
            heard: heard.collect(),
        }
    }

    /// The keys of a vehicle; `None` if a key or a stream is malformed.
    fn keys(&self) -> Option<VehicleKeys> {
        let heard = self.heard.iter().map(|(name, &stamp)| {
            let (component, link) = name.split_once('/')?;
            let stream = SignedStream {
                component: component.parse().ok()?,
                link: link.parse().ok()?,
            };
            Some((stream, stamp))
        });
        Some(VehicleKeys {
            current: self.key.as_deref().map_or(Some(None), optional)?,
            next: self.next.as_deref().map_or(Some(None), optional)?,
            uses: match self.uses {
                Uses::Nothing => KeyInUse::Nothing,
                Uses::Key => KeyInUse::Current,
                Uses::Next => KeyInUse::Next,
            },
            heard: heard.collect::<Option<_>>()?,
        })
    }
}

#[expect(
    clippy::option_option,
    reason = "no key and a faulty key are different"
)]
fn optional(text: &str) -> Option<Option<SecretKey>> {
    read_key(text).map(Some)
}

fn digits(SecretKey(bytes): &SecretKey) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string never fails.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn read_key(text: &str) -> Option<SecretKey> {
    if text.len() != DIGITS || !text.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let mut bytes = [0; 32];
    for (byte, pair) in bytes.iter_mut().zip(text.as_bytes().chunks(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok()?;
    }
    Some(SecretKey(bytes))
}

fn fault_at(text: &str, at: usize) -> KeyringFault {
    let before = text.get(..at).unwrap_or_default();
    KeyringFault {
        line: before.lines().count().max(1),
    }
}
