//! Records of flights: the frames of their links and their journals, written during the flight.
//!
//! The files of a record are in one folder and share a stem: that of the mission's run, if there is
//! one. A thread writes them every quarter of a second, so a slow disk blocks nothing, and a killed
//! program loses at most the last quarter of a second.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::append::AppendFile;
use super::{StoreError, sharing, user_path};
use crate::class::RecordPart;
use crate::record::Head;
use crate::text;
use crate::text::Text;

mod files;
mod joined;
mod recording;
mod reviews;
mod signature;
mod viewers;

pub use files::RecordFiles;
use files::{FRAMES, INPUTS, JOURNAL, REVIEW, RUN};
pub use joined::read_log;
pub use recording::{RecordPiece, RecordWriter, Recording, RecordingFault};
pub use signature::RecordSignature;

/// The limits of the stored records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordLimits {
    /// The maximum number of records; the oldest are removed first.
    pub count: usize,
    /// The maximum size of all records, in bytes. One record may take half of it.
    pub bytes: u64,
}

impl Default for RecordLimits {
    /// At most 200 records and 4 GiB, which is enough for seven hours with 32 vehicles.
    fn default() -> Self {
        Self {
            count: 200,
            bytes: 4 * 1024 * 1024 * 1024,
        }
    }
}

/// A folder of recorded flights.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Records {
    folder: PathBuf,
    limits: RecordLimits,
}

fn numbered(oldest_first: Vec<RecordFiles>, number: usize) -> Result<RecordFiles, Text> {
    if oldest_first.is_empty() {
        return Err(text!("records-none"));
    }
    let at = oldest_first
        .len()
        .checked_sub(number)
        .filter(|_| number > 0);
    let found = at.and_then(|at| oldest_first.into_iter().nth(at));
    found.ok_or_else(|| text!("records-no-number", number = number))
}

/// The path of a file of a record in a folder, by the common name of its files.
pub(super) fn part_in(folder: &Path, stem: &str, part: RecordPart) -> PathBuf {
    folder.join(format!("{stem}{}", ending_of(part)))
}

/// The suffix of a file of a record.
pub(super) fn ending_of(part: RecordPart) -> &'static str {
    match part {
        RecordPart::Run => RUN,
        RecordPart::Inputs => INPUTS,
        RecordPart::Journal => JOURNAL,
        RecordPart::Frames => FRAMES,
    }
}

const REHEARSAL: &str = "rehearsal";

fn has_content(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|file| file.len() > 0)
}

fn undeletable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Undeletable { path, error }
}

fn unwritable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unwritable { path, error }
}

impl Records {
    /// The records in the program's data folder.
    pub fn within(data: &Path, limits: RecordLimits) -> Self {
        Self {
            folder: data.join(super::RUNS),
            limits,
        }
    }

    /// The records in a folder that the user named, which need not exist; nothing in it is removed.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: folder.into(),
            limits: RecordLimits {
                count: usize::MAX,
                bytes: u64::MAX,
            },
        }
    }

    /// The file with the telemetry of the console's last rehearsal, which is no record of a flight.
    pub fn rehearsal(&self) -> PathBuf {
        self.folder.join(format!("{REHEARSAL}{FRAMES}"))
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    pub fn limits(&self) -> RecordLimits {
        self.limits
    }

    /// Checks that the records can be listed. A missing folder counts as an empty one.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn check(&self) -> Result<(), StoreError> {
        match fs::read_dir(&self.folder) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(StoreError::Unreadable {
                path: self.folder.clone(),
                error,
            }),
            Ok(_) | Err(_) => Ok(()),
        }
    }

    /// All records, oldest first.
    pub fn list(&self) -> Vec<RecordFiles> {
        let mut found: BTreeMap<String, RecordFiles> = BTreeMap::new();
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for entry in entries {
            let name = entry.file_name().to_string_lossy().into_owned();
            let mut endings = [JOURNAL, RUN, INPUTS, FRAMES].into_iter();
            let known = |ending| Some((name.strip_suffix(ending)?, ending));
            let Some((stem, ending)) = endings.find_map(known) else {
                continue;
            };
            let files = found.entry(stem.to_owned()).or_default();
            stem.clone_into(&mut files.stem);
            files.review = self.folder.join(format!("{stem}{REVIEW}"));
            files.add(entry.path(), ending);
        }
        found
            .into_values()
            .filter(|it| it.journal.is_some())
            .collect()
    }

    /// The record that a user names: by its number (the newest is 1), its name, or one of its
    /// files. The tlog of another program counts as a record too, as does the last rehearsal by its
    /// name. Without a folder of records, only files are found.
    ///
    /// # Errors
    /// A text if there is no such record or file.
    pub fn find(records: Option<&Self>, named: &str) -> Result<RecordFiles, Text> {
        let all = records.map(Self::list).unwrap_or_default();
        if let Ok(number) = named.parse() {
            return numbered(all, number);
        }
        let path = user_path(named);
        if path.is_file() {
            return Ok(RecordFiles::beside(&path));
        }
        let rehearsed = records.map(Self::rehearsal);
        if let Some(path) = rehearsed.filter(|path| named == REHEARSAL && path.is_file()) {
            return Ok(RecordFiles::beside(&path));
        }
        let found = all.into_iter().find(|it| it.stem == named);
        found.ok_or_else(|| match path.symlink_metadata() {
            Ok(_) => text!("records-not-a-file", file = named),
            Err(_) => text!("records-unknown", name = named),
        })
    }

    /// The record with a number, the newest being 1.
    ///
    /// # Errors
    /// A text if there is no such record.
    pub fn numbered(&self, number: usize) -> Result<RecordFiles, Text> {
        numbered(self.list(), number)
    }

    /// The frames of the newest record that has frames, if there is one.
    pub fn newest(&self) -> Option<PathBuf> {
        let mut newest_first = self.list().into_iter().rev();
        newest_first.find_map(|it| it.frames.filter(|path| has_content(path)))
    }

    /// The frames of the newest record that has frames, among those of a profile, or of guests
    /// (`None`).
    pub fn newest_of(&self, profile: Option<&str>) -> Option<PathBuf> {
        let is_theirs = |files: &RecordFiles| {
            let head = files.head();
            head.is_ok_and(|head| head.profile.as_deref() == profile)
        };
        let mut newest_first = self.list().into_iter().rev();
        newest_first.find_map(|it| {
            let frames = it.frames.clone().filter(|path| has_content(path));
            frames.filter(|_| is_theirs(&it))
        })
    }

    /// Starts a record, with a thread that fetches frames from `source` and writes them.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn begin(
        &self,
        head: &Head,
        stem: Option<&str>,
        when: &str,
        source: impl FnMut() -> Vec<u8> + Send + 'static,
    ) -> Result<Recording, StoreError> {
        let writer = self.create(head, stem, when)?;
        Recording::start(writer, source).map_err(|error| unwritable(&self.folder, error))
    }

    /// Creates the files of a record, after making room. Its stem is that of a run, or consists of
    /// the date and time `when` (in the format of [`utc`](super::utc)) and the subject.
    ///
    /// # Errors
    /// The files cannot be created.
    pub fn create(
        &self,
        head: &Head,
        stem: Option<&str>,
        when: &str,
    ) -> Result<RecordWriter, StoreError> {
        let data = self.folder.parent().unwrap_or(&self.folder);
        sharing::folder_within(data, &self.folder)
            .map_err(|error| unwritable(&self.folder, error))?;
        self.make_room();
        let (mut journal, stem) = self.create_journal(head, stem, when)?;
        journal.append(head.to_line().as_bytes())?;
        let path = self.folder.join(format!("{stem}{FRAMES}"));
        let frames = AppendFile::create(path.clone())?
            .ok_or_else(|| unwritable(&path, io::ErrorKind::AlreadyExists.into()))?;
        Ok(RecordWriter {
            stem,
            frames,
            journal,
            inputs: None,
            most_bytes: self.limits.bytes / 2,
        })
    }

    fn create_journal(
        &self,
        head: &Head,
        stem: Option<&str>,
        when: &str,
    ) -> Result<(AppendFile, String), StoreError> {
        let process = std::process::id();
        let (when, slug) = (when.replace(':', "-"), head.subject.slug());
        let own = (0..100).map(|number| format!("{when}_{slug}_{process}-{number:02}"));
        for stem in stem.map(str::to_owned).into_iter().chain(own) {
            let path = self.folder.join(format!("{stem}{JOURNAL}"));
            if let Some(file) = AppendFile::create(path)? {
                return Ok((file, stem));
            }
        }
        Err(unwritable(
            &self.folder,
            io::ErrorKind::AlreadyExists.into(),
        ))
    }

    /// Removes the oldest records until a new one fits within the limits; records being written
    /// stay.
    fn make_room(&self) {
        let mut bytes = 0;
        for (newer, files) in self.list().into_iter().rev().enumerate() {
            bytes += files.bytes;
            // Leaves room for one more, which may take half of the total.
            let is_too_much =
                newer + 1 >= self.limits.count || bytes > self.limits.bytes - self.limits.bytes / 2;
            if newer > 0 && is_too_much && !files.is_written() {
                // A file that cannot be removed stays; the new record is more important.
                drop(files.delete());
            }
        }
    }
}

#[cfg(test)]
mod tests;
