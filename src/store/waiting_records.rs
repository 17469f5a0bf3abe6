//! The records of a seat that wait to be handed in to the desk of its class.
//!
//! A mark beside a record names the class, so that the next console hands in what this one could not.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::PathBuf;

use super::hashes::hash_of;
use super::records::ending_of;
use super::{Records, sharing};
use crate::class::{
    LARGEST_PART, PIECE, Piece, PieceBytes, PieceRequest, RecordName, RecordPart, Submission,
    SubmittedPart,
};

/// The suffix of a mark.
pub(super) const MARK: &str = ".class";
/// The maximum length of a mark, in bytes.
const MARK_LEN: u64 = 4096;

/// The records in a folder that wait for one class.
#[derive(Debug, Clone)]
pub struct WaitingRecords {
    folder: PathBuf,
    /// What tells the class from others.
    class: String,
}

impl WaitingRecords {
    /// The records that wait for the class with this id, which is one line.
    pub fn new(records: &Records, class: String) -> Self {
        Self {
            folder: records.folder().to_owned(),
            class,
        }
    }

    /// The names of the marked records, oldest first.
    pub fn marked(&self) -> Vec<RecordName> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut names: Vec<RecordName> = entries
            .filter_map(|entry| {
                let name = entry.file_name().into_string().ok()?;
                let record = RecordName::try_from(name.strip_suffix(MARK)?.to_owned()).ok()?;
                self.is_marked(&record).then_some(record)
            })
            .collect();
        names.sort();
        names
    }

    fn is_marked(&self, record: &RecordName) -> bool {
        let mut text = String::new();
        let read = File::open(self.path(record, MARK))
            .and_then(|file| file.take(MARK_LEN).read_to_string(&mut text));
        read.is_ok() && text.trim_end() == self.class
    }

    /// Marks a record.
    ///
    /// # Errors
    /// The mark cannot be written. This console can still hand the record in.
    pub fn mark(&self, record: &RecordName) -> io::Result<()> {
        let mut options = OpenOptions::new();
        let options = options.create(true).write(true).truncate(true);
        let mut file = sharing::open(options, &self.path(record, MARK))?;
        writeln!(file, "{}", self.class)
    }

    /// Removes the mark of a record that the desk has, or does not take.
    pub fn unmark(&self, record: &RecordName) {
        // A mark that stays makes the next console offer the record again, which does no harm.
        drop(fs::remove_file(self.path(record, MARK)));
    }

    /// What to hand in of a record: the files that are not too large.
    ///
    /// # Errors
    /// The record of the mission is missing or too large, or a file cannot be read.
    pub fn submission(&self, record: &RecordName) -> io::Result<Submission> {
        let mut parts = Vec::new();
        for part in RecordPart::ALL {
            let file = match File::open(self.path(record, ending_of(part))) {
                Ok(file) => file,
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => return Err(error),
            };
            let bytes = file.metadata()?.len();
            if bytes > LARGEST_PART {
                continue;
            }
            // A file that still grows is handed in up to here.
            let sha256 = hash_of(file.take(bytes))?;
            parts.push(SubmittedPart {
                part,
                bytes,
                sha256,
            });
        }
        let record = record.clone();
        let submission = Submission { record, parts };
        if submission.is_possible() {
            return Ok(submission);
        }
        Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "the record of the mission is missing, or larger than 64 MiB",
        ))
    }

    /// A piece of a record.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn piece(&self, request: &PieceRequest) -> io::Result<Piece> {
        let mut file = File::open(self.path(&request.record, ending_of(request.part)))?;
        file.seek(SeekFrom::Start(request.from))?;
        let mut bytes = Vec::new();
        file.take(PIECE as u64).read_to_end(&mut bytes)?;
        Ok(Piece {
            of: request.clone(),
            data: PieceBytes(bytes),
        })
    }

    fn path(&self, record: &RecordName, ending: &str) -> PathBuf {
        self.folder.join(format!("{}{ending}", record.as_str()))
    }
}
