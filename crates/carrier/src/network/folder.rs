//! A class on several machines, as files.

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{self, DirBuilder, OpenOptions};
use std::io::{self, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

use ct_codecs::{Base64, Decoder as _, Encoder as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::certificates::{self, Identity, SeatAuthority};
use crate::address::{with_port, with_port_of};
use crate::fault::NetworkFault;
use crate::join_line::{ENDING, JoinLine, is_address, is_name};
use crate::new_class::NewClass;
use crate::secret_file::read_secret;

/// The file of the desk in the folder of the class.
const DESK_FILE: &str = "desk.json";
/// The same, while it is being written.
const NEW_DESK_FILE: &str = "desk.json.new";
/// The folder of the join lines in it.
const SEATS_FOLDER: &str = "seats";
/// The version of the file.
const SCHEMA: u32 = 1;

/// A desk for several machines: what it knows of its class, and where it listens.
#[derive(Clone, PartialEq, Eq)]
pub struct NetworkDesk {
    /// Where it listens, as HOST:PORT.
    pub listen: String,
    /// Its keys and seats.
    pub(super) keys: DeskKeys,
}

/// The file of the desk.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DeskKeys {
    schema: u32,
    pub class: String,
    /// The addresses in the join lines.
    pub addresses: Vec<String>,
    /// The secret key (PKCS #8).
    pub key: Bytes,
    /// The certificate with which those of all seats are checked (DER).
    pub seats_certificate: Bytes,
    /// The public key of each seat. A seat without one is not let in any more.
    pub seats: BTreeMap<String, Bytes>,
}

/// Bytes that are Base64 in the file.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Bytes(pub Vec<u8>);

impl Serialize for Bytes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let text = Base64::encode_to_string(&self.0);
        serializer.serialize_str(&text.unwrap_or_default())
    }
}

impl<'de> Deserialize<'de> for Bytes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let bytes = Base64::decode_to_vec(text, None);
        bytes.map(Self).map_err(|_| de::Error::custom("not Base64"))
    }
}

/// Without the secret key.
impl fmt::Debug for NetworkDesk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NetworkDesk")
            .field("listen", &self.listen)
            .field("class", &self.keys.class)
            .field("seats", &self.keys.seats.len())
            .finish_non_exhaustive()
    }
}

/// Makes the keys of a class in a new folder: the file of the desk, and a file with a join line for each seat. Returns
/// the files of the seats.
///
/// # Errors
/// The name or an address cannot be used, the folder exists, or a file cannot be written.
pub(crate) fn make(class: &NewClass<'_>, folder: &Path) -> Result<Vec<PathBuf>, NetworkFault> {
    if !is_name(class.name) {
        return Err(NetworkFault::Name(class.name.to_owned()));
    }
    if let Some(wrong) = class.addresses.iter().find(|it| !is_address(it)) {
        return Err(NetworkFault::Address(wrong.clone()));
    }
    let (keys, lines) = DeskKeys::draw(class)?;
    if let Some(parent) = folder.parent() {
        // If it cannot be made, the folder in it cannot either.
        drop(DirBuilder::new().recursive(true).mode(0o700).create(parent));
    }
    make_folder(folder)?;
    let seats = folder.join(SEATS_FOLDER);
    make_folder(&seats)?;
    let mut files = Vec::new();
    for line in lines {
        let file = join_file(folder, &line.seat);
        write(&file, &(line.secret_text() + "\n"))?;
        files.push(file);
    }
    // Last, so that a class that has a desk is whole.
    keys.write(&folder.join(DESK_FILE))?;
    Ok(files)
}

fn join_file(folder: &Path, seat: &str) -> PathBuf {
    folder.join(SEATS_FOLDER).join(format!("{seat}{ENDING}"))
}

/// Takes a seat out of the class in a folder, and deletes the file that a trainee would get: a desk that is opened afterwards does not let it in.
///
/// # Errors
/// There is no such seat, or the file of the desk cannot be read or written.
pub(crate) fn remove_seat(folder: &Path, seat: &str) -> Result<(), NetworkFault> {
    let file = folder.join(DESK_FILE);
    let mut keys = DeskKeys::read(folder)?;
    if keys.seats.remove(seat).is_none() {
        return Err(NetworkFault::NoSeat {
            folder: folder.to_owned(),
            seat: seat.to_owned(),
        });
    }
    // Beside it first, so that a disk that is full does not cost the class its keys.
    let new = folder.join(NEW_DESK_FILE);
    // It may be there if the program was killed.
    drop(fs::remove_file(&new));
    keys.write(&new)?;
    fs::rename(&new, &file).map_err(|error| NetworkFault::File {
        file,
        error: error.into(),
    })?;
    // The trainee may have taken it.
    drop(fs::remove_file(join_file(folder, seat)));
    Ok(())
}

impl DeskKeys {
    /// Draws all keys of a class: those of its desk, and a join line for each seat.
    fn draw(class: &NewClass<'_>) -> Result<(Self, Vec<JoinLine>), NetworkFault> {
        let desk = certificates::desk(class.name)?;
        let authority = SeatAuthority::new(class.name)?;
        let width = class.seats.to_string().len().max(2);
        let mut keys = Self {
            schema: SCHEMA,
            class: class.name.to_owned(),
            addresses: class.addresses.to_owned(),
            key: Bytes(desk.key),
            seats_certificate: Bytes(authority.certificate.clone()),
            seats: BTreeMap::new(),
        };
        let mut lines = Vec::new();
        for number in 1..=class.seats {
            let name = format!("seat-{number:0width$}");
            let Identity {
                key,
                public_key,
                certificate,
            } = authority.seat(&name)?;
            keys.seats.insert(name.clone(), Bytes(public_key));
            lines.push(JoinLine {
                class: class.name.to_owned(),
                seat: name,
                addresses: class.addresses.to_owned(),
                key,
                certificate,
                desk_certificate: desk.certificate.clone(),
                desk_key: desk.public_key.clone(),
            });
        }
        Ok((keys, lines))
    }

    fn read(folder: &Path) -> Result<Self, NetworkFault> {
        let file = folder.join(DESK_FILE);
        let keys = read_secret(&file, |text| Self::parse(text, &file));
        keys.map_err(|fault| match fault {
            NetworkFault::File { error, .. } if error.0.kind() == io::ErrorKind::NotFound => {
                NetworkFault::NoClass(folder.to_owned())
            }
            other => other,
        })
    }

    fn write(&self, file: &Path) -> Result<(), NetworkFault> {
        let text = serde_json::to_string_pretty(self);
        let text = text.map_err(|fault| NetworkFault::Crypto(fault.to_string()))?;
        write(file, &(text + "\n"))
    }

    fn parse(text: &str, file: &Path) -> Result<Self, NetworkFault> {
        let damaged = |reason| NetworkFault::NoDesk {
            file: file.to_owned(),
            reason,
        };
        let keys: Self = serde_json::from_str(text).map_err(|fault| {
            // The text of a fault may quote the file, and so a key.
            damaged(format!("{}:{}", fault.line(), fault.column()))
        })?;
        if keys.schema != SCHEMA {
            return Err(damaged(format!("schema {}", keys.schema)));
        }
        let wrong = keys
            .seats
            .keys()
            .chain([&keys.class])
            .find(|it| !is_name(it));
        if let Some(wrong) = wrong {
            return Err(damaged(wrong.clone()));
        }
        Ok(keys)
    }
}

impl NetworkDesk {
    /// Reads the keys of a class from its folder. Without a port, the address gets that of the class.
    ///
    /// # Errors
    /// The address cannot be used, or the folder has no file of a desk that only its owner can read.
    pub fn read(folder: &Path, listen: &str) -> Result<Self, NetworkFault> {
        if !is_address(&with_port(listen)) {
            return Err(NetworkFault::Address(listen.to_owned()));
        }
        let keys = DeskKeys::read(folder)?;
        let listen = with_port_of(listen, &keys.addresses);
        Ok(Self { listen, keys })
    }

    /// The name of the class.
    pub fn class(&self) -> &str {
        &self.keys.class
    }
}

fn make_folder(folder: &Path) -> Result<(), NetworkFault> {
    let made = DirBuilder::new().mode(0o700).create(folder);
    made.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => NetworkFault::Exists(folder.to_owned()),
        _ => NetworkFault::File {
            file: folder.to_owned(),
            error: error.into(),
        },
    })
}

fn write(file: &Path, text: &str) -> Result<(), NetworkFault> {
    let mut options = OpenOptions::new();
    let made = options.write(true).create_new(true).mode(0o600).open(file);
    made.and_then(|mut made| {
        made.write_all(text.as_bytes())?;
        made.sync_all()
    })
    .map_err(|error| NetworkFault::File {
        file: file.to_owned(),
        error: error.into(),
    })
}
