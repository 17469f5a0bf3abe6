//! The records that trainees of a class have handed in, at the instructor's desk.
//!
//! Each class has a folder in the instructor's data folder, with a folder for each trainee. A record is complete once
//! its submission lies beside it, which is written last; until then, its files may be parts.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use super::hashes::{sha256_of, sha256_of_nothing};
use super::records::ending_of;
use super::{RecordFiles, sharing};
use crate::class::{Held, RecordName, RecordPart, RecordShelf, ShelfFault, Submission};

mod grades;

pub use grades::KeptSheet;

/// The folder of all classes in a data folder.
const CLASSES: &str = "classes";
/// The suffix of a submission.
const SUBMISSION: &str = ".submission.json";
/// The suffix of a file that is not complete yet.
const PART: &str = ".part";

/// The records of a class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassRecords {
    data: PathBuf,
    folder: PathBuf,
}

/// A complete record of a trainee.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeptRecord {
    /// The trainee's user name.
    pub user: String,
    pub files: RecordFiles,
}

/// The class and the trainee whose record a file is, from the folders in which it is.
#[derive(Debug)]
pub(super) struct RecordOwner {
    class: OsString,
    user: OsString,
}

impl RecordOwner {
    /// The owner of a file; `None` if it is not in the folder of a class.
    pub fn of(path: &Path) -> Option<Self> {
        // A relative path does not name the folders above it.
        let path = path.canonicalize().ok()?;
        let user = path.parent()?;
        let class = user.parent()?;
        (class.parent()?.file_name()? == CLASSES).then_some(Self {
            class: class.file_name()?.to_owned(),
            user: user.file_name()?.to_owned(),
        })
    }

    pub fn is_class(&self, name: &str) -> bool {
        self.class == *safe(name)
    }

    pub fn is_user(&self, name: &str) -> bool {
        self.user == *safe(name)
    }
}

impl ClassRecords {
    /// The records of the class with this name, in a data folder.
    pub fn within(data: &Path, class: &str) -> Self {
        Self {
            data: data.to_owned(),
            folder: data.join(CLASSES).join(safe(class)),
        }
    }

    /// The names of the classes that have records in a data folder.
    pub fn classes(data: &Path) -> Vec<String> {
        folders_in(&data.join(CLASSES))
    }

    /// The instructor's data folder, in which the class has its own.
    pub fn data(&self) -> &Path {
        &self.data
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether anything was ever handed in.
    pub fn exist(&self) -> bool {
        self.folder.is_dir()
    }

    /// The complete records of all trainees: by trainee, the oldest first.
    pub fn all(&self) -> Vec<KeptRecord> {
        let trainees = folders_in(&self.folder).into_iter();
        trainees.flat_map(|user| self.of(&user)).collect()
    }

    fn of(&self, user: &str) -> Vec<KeptRecord> {
        let folder = self.folder.join(safe(user));
        let mut names: Vec<String> = names_in(&folder);
        names.retain(|name| name.ends_with(SUBMISSION));
        names.sort();
        let records = names.iter().filter_map(|name| {
            let record = name.strip_suffix(SUBMISSION)?.to_owned();
            self.kept_record(user, &RecordName::try_from(record).ok()?)
        });
        records.collect()
    }

    /// A complete record; `None` if its record of the mission is missing.
    pub fn kept_record(&self, user: &str, record: &RecordName) -> Option<KeptRecord> {
        let files = RecordFiles::beside(&self.path(user, record, ending_of(RecordPart::Run)));
        files.run.is_some().then(|| KeptRecord {
            user: user.to_owned(),
            files,
        })
    }

    /// When a record was complete, in seconds since 1970.
    pub fn handed_in(&self, kept: &KeptRecord) -> Option<u64> {
        let record = RecordName::try_from(kept.files.stem.clone()).ok()?;
        let submission = fs::metadata(self.path(&kept.user, &record, SUBMISSION)).ok()?;
        let since = submission
            .modified()
            .ok()?
            .duration_since(UNIX_EPOCH)
            .ok()?;
        Some(since.as_secs())
    }

    fn path(&self, user: &str, record: &RecordName, ending: &str) -> PathBuf {
        let name = format!("{}{ending}", record.as_str());
        self.folder.join(safe(user)).join(name)
    }

    fn part_path(&self, user: &str, record: &RecordName, part: RecordPart) -> PathBuf {
        let name = format!(".{}{}{PART}", record.as_str(), ending_of(part));
        self.folder.join(safe(user)).join(name)
    }
}

impl RecordShelf for ClassRecords {
    fn kept(&self, user: &str, record: &RecordName) -> Result<Option<Submission>, ShelfFault> {
        match fs::read(self.path(user, record, SUBMISSION)) {
            Ok(text) => Ok(serde_json::from_slice(&text).ok()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(fault(&error)),
        }
    }

    fn used(&self, user: &str) -> Result<u64, ShelfFault> {
        let entries = match fs::read_dir(self.folder.join(safe(user))) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(0),
            Err(error) => return Err(fault(&error)),
        };
        let sizes = entries.flatten().filter_map(|entry| entry.metadata().ok());
        Ok(sizes.map(|file| file.len()).sum())
    }

    fn held(&self, user: &str, record: &RecordName, part: RecordPart) -> Result<Held, ShelfFault> {
        if self.path(user, record, ending_of(part)).is_file() {
            return Ok(Held::Whole);
        }
        match fs::metadata(self.part_path(user, record, part)) {
            Ok(file) => Ok(Held::Bytes(file.len())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Held::Bytes(0)),
            Err(error) => Err(fault(&error)),
        }
    }

    fn append(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        bytes: &[u8],
    ) -> Result<(), ShelfFault> {
        let path = self.part_path(user, record, part);
        let folder = self.folder.join(safe(user));
        let written = sharing::folder_within(&self.data, &folder)
            .and_then(|()| sharing::open(OpenOptions::new().create(true).append(true), &path))
            .and_then(|file| append(file, bytes));
        written.map_err(|error| fault(&error))
    }

    fn check(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        sha256: &str,
    ) -> Result<bool, ShelfFault> {
        let whole = self.path(user, record, ending_of(part));
        let partial = self.part_path(user, record, part);
        let found = if whole.is_file() { &whole } else { &partial };
        let is_same = match sha256_of(found) {
            Ok(hash) => hash == sha256,
            // A file without content was never begun.
            Err(error) if error.kind() == io::ErrorKind::NotFound => sha256 == sha256_of_nothing(),
            Err(error) => return Err(fault(&error)),
        };
        let settled = match (is_same, found == &whole) {
            (true, true) => Ok(()),
            (true, false) if partial.is_file() => fs::rename(&partial, &whole),
            (true, false) => {
                sharing::open(OpenOptions::new().create(true).append(true), &whole).map(drop)
            }
            (false, _) => fs::remove_file(found),
        };
        settled.map_err(|error| fault(&error))?;
        Ok(is_same)
    }

    fn complete(&mut self, user: &str, submission: &Submission) -> Result<(), ShelfFault> {
        let path = self.path(user, &submission.record, SUBMISSION);
        let text = serde_json::to_string(submission).map_err(|error| fault(&error.into()))?;
        let beside = path.with_extension("new");
        let written = sharing::open(
            OpenOptions::new().create(true).write(true).truncate(true),
            &beside,
        )
        .and_then(|mut file| {
            file.write_all(text.as_bytes())?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&beside, &path));
        written.map_err(|error| fault(&error))
    }
}

/// Appends all the bytes or none.
fn append(mut file: File, bytes: &[u8]) -> io::Result<()> {
    let len = file.metadata()?.len();
    file.write_all(bytes).inspect_err(|_| {
        // On an unavailable disk, this may fail too; then the hash shows it.
        drop(file.set_len(len));
    })
}

fn fault(error: &io::Error) -> ShelfFault {
    ShelfFault(error.to_string())
}

/// A name that leads nowhere else when it becomes the name of a file.
fn safe(name: &str) -> String {
    let plain = |c: char| if c == '/' || c.is_control() { '_' } else { c };
    let name: String = name.chars().map(plain).collect();
    match name.strip_prefix('.') {
        Some(rest) => format!("_{rest}"),
        None if name.is_empty() => "_".to_owned(),
        None => name,
    }
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect()
}

fn folders_in(folder: &Path) -> Vec<String> {
    let mut names = names_in(folder);
    names.retain(|name| !name.starts_with('.') && folder.join(name).is_dir());
    names.sort();
    names
}

#[cfg(test)]
mod tests;
