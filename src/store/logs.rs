//! The folder of logs that were copied from vehicles.
//!
//! An incomplete log is stored as `NAME.bin.part`, with its missing parts in `NAME.bin.gaps`: the
//! size, and a line for each gap. The gaps are written after the bytes. If the program is killed,
//! it may therefore request some bytes again, but never counts missing bytes as read. A part is
//! found by vehicle and number; some of it is read again to check that it belongs to the same log.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{StoreError, give_new_name, sharing, user_path};
use crate::session::{FileBytes, GapMap, KeptLog, LogKeeper, VehicleLog};
use crate::text;
use crate::text::{Text, utc_of};

mod part;
#[cfg(test)]
mod tests;

use part::{LogPart, samples};

/// The maximum number of logs with the same name.
const MOST_ALIKE: usize = 100;

/// A folder into which logs of vehicles are downloaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogFolder {
    folder: PathBuf,
}

impl LogFolder {
    /// The logs in the program's data folder.
    pub fn within(data: &Path) -> Self {
        Self {
            folder: data.join("logs"),
        }
    }

    fn folder_of(&self, log: &VehicleLog) -> PathBuf {
        match &log.folder {
            Some(folder) => user_path(folder),
            None => self.folder.clone(),
        }
    }

    /// Creates the folder of a log; a folder that the user named gets the usual mode of a new one.
    fn make_folder(&self, log: &VehicleLog) -> Result<(), StoreError> {
        let folder = self.folder_of(log);
        let made = if log.folder.is_some() {
            fs::create_dir_all(&folder)
        } else {
            let above = self.folder.parent().unwrap_or(&self.folder);
            sharing::folder_within(above, &folder)
        };
        made.map_err(|error| unwritable(&folder, error))
    }

    fn part(&self, log: &VehicleLog) -> LogPart {
        let name = format!("v{}-log{}.bin", log.vehicle, log.log.number);
        LogPart::new(&self.folder_of(log), &name)
    }

    /// The possible paths of the complete file, in order of preference.
    fn paths(&self, log: &VehicleLog) -> impl Iterator<Item = PathBuf> + use<> {
        let mut name = format!("v{}-log{}", log.vehicle, log.log.number);
        let time = u64::from(log.log.time_utc_s);
        if time > 0 {
            let time = utc_of(time * 1_000_000).replace(' ', "T").replace(':', "-");
            name = format!("{name}-{time}Z");
        }
        let folder = self.folder_of(log);
        (1..=MOST_ALIKE).map(move |number| {
            folder.join(match number {
                1 => format!("{name}.bin"),
                number => format!("{name}-{number}.bin"),
            })
        })
    }
}

impl LogKeeper for LogFolder {
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text> {
        let part = self.part(log);
        let ready = self.make_folder(log).and_then(|()| part.check());
        ready.map_err(|error| Text::from(&error))?;
        let size = log.log.size;
        let is_whole = |path: &PathBuf| {
            fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() == u64::from(size))
        };
        let whole = self.paths(log).take_while(|it| it.exists()).find(is_whole);
        if let Some(path) = whole.filter(|_| size > 0) {
            let mut gaps = GapMap::new(size);
            gaps.fill(0..size);
            return Ok(KeptLog {
                samples: samples(&path, &gaps),
                gaps,
                file: Some(path.display().to_string()),
            });
        }
        let gaps = part.missing(size).unwrap_or_else(|| GapMap::new(size));
        Ok(KeptLog {
            samples: samples(part.path(), &gaps),
            gaps,
            file: None,
        })
    }

    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text> {
        let written = self.part(log).write(bytes, gaps);
        written.map_err(|error| Text::from(&error))
    }

    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text> {
        let sum = self.part(log).checksum(log.log.size);
        sum.map_err(|error| Text::from(&error))
    }

    fn finish(&self, log: &VehicleLog) -> Result<String, Text> {
        let part = self.part(log);
        let bytes = part.trim(log.log.size).map_err(|it| Text::from(&it))?;
        if bytes != u64::from(log.log.size) {
            part.forget_gaps();
            return Err(text!(
                "outcome-log-length",
                file = part.path().display().to_string(),
                bytes = bytes,
                expected = log.log.size
            ));
        }
        let mut last = None;
        for path in self.paths(log) {
            match give_new_name(part.path(), &path) {
                Ok(()) => {
                    part.remove();
                    return Ok(path.display().to_string());
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    last = Some(unwritable(&path, error));
                }
                Err(error) => return Err(Text::from(&unwritable(&path, error))),
            }
        }
        let taken = || unwritable(part.path(), io::ErrorKind::AlreadyExists.into());
        Err(Text::from(&last.unwrap_or_else(taken)))
    }
}

fn unreadable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unreadable { path, error }
}

fn unwritable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unwritable { path, error }
}
