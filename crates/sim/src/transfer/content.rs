//! The vehicle's folders and files, including generated ones.

use super::packed::{self, PackRequest};
use super::tree::{Disk, FolderEntry, INVALID, NO_SUCH_FILE, READ_ONLY, clean};
use super::{logs, plan_file};
use crate::parameters::Parameters;
use crate::vehicle::Vehicle;

/// The system's files with their reported length.
const SYSTEM: [(&str, usize); 11] = [
    ("threads.txt", 100_000),
    ("tasks.txt", 100_000),
    ("dma.txt", 100_000),
    ("memory.txt", 100_000),
    ("uarts.txt", 100_000),
    ("timers.txt", 100_000),
    ("can_log.txt", 100_000),
    ("can0_stats.txt", 100_000),
    ("can1_stats.txt", 100_000),
    ("crash_dump.bin", 100_000),
    (STORAGE_FILE, STORAGE_BYTES),
];
const STORAGE_FILE: &str = "storage.bin";
const STORAGE_BYTES: usize = 16_384;

/// The place that a path leads to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FilePlace {
    System(String),
    Parameters(String),
    Plans(String),
    /// The firmware's files; a simulated board has none.
    Firmware(String),
    Logs(String),
    Disk(String),
}

impl FilePlace {
    pub(super) fn of(path: &str) -> Self {
        let path = clean(path);
        let (root, rest) = path.split_once('/').unwrap_or((&path, ""));
        match root {
            "@SYS" => Self::System(rest.to_owned()),
            "@PARAM" => Self::Parameters(rest.to_owned()),
            "@MISSION" => Self::Plans(rest.to_owned()),
            "@ROMFS" => Self::Firmware(rest.to_owned()),
            logs::FOLDER => Self::Logs(rest.to_owned()),
            _ => Self::Disk(path),
        }
    }
}

/// A file that is open for reading.
#[derive(Debug, Clone)]
pub(super) enum FileContent {
    Bytes(Vec<u8>),
    /// The parameters, packed at the first read, which sets the block size.
    Parameters {
        wanted: PackRequest,
        block: usize,
        packed: Vec<u8>,
    },
}

impl FileContent {
    /// Opens a file; also returns its reported length. An error is an error number of the operating system.
    pub(super) fn open(vehicle: &Vehicle, disk: &Disk, path: &str) -> Result<(Self, usize), u8> {
        let bytes = match FilePlace::of(path) {
            FilePlace::System(name) => return system(vehicle, &name),
            FilePlace::Parameters(name) if packed::is_name(&name) => {
                let wanted = PackRequest::read(&name).ok_or(INVALID)?;
                let content = Self::Parameters {
                    wanted,
                    block: 0,
                    packed: Vec::new(),
                };
                return Ok((content, packed::estimated_len(&vehicle.parameters)));
            }
            FilePlace::Plans(name) => {
                let kind = plan_file::kind_of(&name).ok_or(NO_SUCH_FILE)?;
                let content = Self::Bytes(plan_file::pack(vehicle, kind));
                return Ok((content, plan_file::ESTIMATED_LEN));
            }
            FilePlace::Parameters(_) | FilePlace::Firmware(_) => return Err(NO_SUCH_FILE),
            FilePlace::Logs(name) => logs::file(vehicle, &name).ok_or(NO_SUCH_FILE)?,
            FilePlace::Disk(path) => disk.read(&path)?.to_vec(),
        };
        let len = bytes.len();
        Ok((Self::Bytes(bytes), len))
    }

    /// Up to `len` bytes from an offset on; none beyond the end.
    pub(super) fn read(
        &mut self,
        parameters: &Parameters,
        offset: usize,
        len: usize,
    ) -> Result<&[u8], u8> {
        let bytes = match self {
            Self::Bytes(bytes) => bytes,
            Self::Parameters {
                wanted,
                block,
                packed,
            } => {
                if *block == 0 && len > 0 {
                    *packed = wanted.pack(parameters, len).ok_or(INVALID)?;
                    *block = len;
                }
                if *block != len {
                    return Err(INVALID);
                }
                packed
            }
        };
        let rest = bytes.get(offset..).unwrap_or_default();
        Ok(&rest[..rest.len().min(len)])
    }
}

/// The content of a folder.
pub(super) fn list(vehicle: &Vehicle, disk: &Disk, path: &str) -> Result<Vec<FolderEntry>, u8> {
    match FilePlace::of(path) {
        FilePlace::System(rest) if rest.is_empty() => Ok(SYSTEM
            .map(|(name, len)| FolderEntry::file(name, len))
            .to_vec()),
        FilePlace::Firmware(rest) if rest.is_empty() => Ok(Vec::new()),
        FilePlace::Logs(rest) if rest.is_empty() => Ok(dotted(logs::entries(vehicle))),
        FilePlace::Disk(path) => {
            let mut entries = dotted(disk.entries(&path).ok_or(NO_SUCH_FILE)?);
            if path.is_empty() {
                let logs = logs::entries(vehicle);
                entries.extend((!logs.is_empty()).then(|| FolderEntry::folder(logs::FOLDER)));
                entries.extend(["@ROMFS", "@SYS"].map(FolderEntry::folder));
            }
            Ok(entries)
        }
        FilePlace::System(_)
        | FilePlace::Parameters(_)
        | FilePlace::Plans(_)
        | FilePlace::Firmware(_)
        | FilePlace::Logs(_) => Err(NO_SUCH_FILE),
    }
}

/// The path on the disk, if it may be written to.
pub(super) fn writable(path: &str) -> Result<String, u8> {
    match FilePlace::of(path) {
        FilePlace::Disk(path) => Ok(path),
        FilePlace::System(_)
        | FilePlace::Parameters(_)
        | FilePlace::Plans(_)
        | FilePlace::Firmware(_)
        | FilePlace::Logs(_) => Err(READ_ONLY),
    }
}

fn dotted(entries: Vec<FolderEntry>) -> Vec<FolderEntry> {
    let mut all = vec![FolderEntry::folder("."), FolderEntry::folder("..")];
    all.extend(entries);
    all
}

/// Opens a system file; only some have content on a simulated board.
fn system(vehicle: &Vehicle, name: &str) -> Result<(FileContent, usize), u8> {
    let (_, said) = SYSTEM
        .iter()
        .find(|(known, _)| *known == name)
        .ok_or(NO_SUCH_FILE)?;
    let seconds = vehicle.uptime().as_secs();
    let bytes = match name {
        "tasks.txt" => format!(
            "TasksV2\nfast_loop                 TIM={:>10} ms\n",
            seconds * 1000
        ),
        "uarts.txt" => "UARTV1\nSERIAL0 TX=0 RX=0\nSERIAL1 TX=0 RX=0\nSERIAL2 TX=0 RX=0\n".into(),
        STORAGE_FILE => return Ok((FileContent::Bytes(vec![0; STORAGE_BYTES]), *said)),
        _ => return Err(NO_SUCH_FILE),
    };
    Ok((FileContent::Bytes(bytes.into_bytes()), *said))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_to_their_places() {
        assert_eq!(FilePlace::of("/@SYS/"), FilePlace::System(String::new()));
        let parameters = FilePlace::Parameters("param.pck?start=1".into());
        assert_eq!(FilePlace::of("@PARAM/param.pck?start=1"), parameters);
        assert_eq!(FilePlace::of("/a/b"), FilePlace::Disk("a/b".into()));
        assert_eq!(writable("@SYS/tasks.txt"), Err(READ_ONLY));
    }
}
