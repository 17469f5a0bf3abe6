//! The files of one record.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::undeletable;
use crate::mission::record::{End as RunEnd, Head as RunHead};
use crate::record::{Happening, Head, InstructorPart, Journal, JournalLine};
use crate::store::append::is_written;
use crate::store::names::unread;
use crate::store::signature::signature_of;
use crate::store::{StoreError, runs};
use crate::text;
use crate::text::Text;

/// The suffix of frames.
pub(super) const FRAMES: &str = ".tlog";
pub(super) const JOURNAL: &str = ".flight.jsonl";
/// The suffix of a review.
pub(super) const REVIEW: &str = ".review.json";
/// The suffix of a mission's run, which `runs` stores.
pub(super) const RUN: &str = ".run.jsonl";
/// The suffix of the inputs of simulated vehicles.
pub(super) const INPUTS: &str = runs::INPUTS;
/// The maximum length of a head, in bytes.
const HEAD_LEN: u64 = 256 * 1024;
/// The maximum size of a journal, in bytes; this program does not write larger ones.
const LARGEST_JOURNAL: u64 = 256 * 1024 * 1024;

/// The files of one record; `None` for each missing file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecordFiles {
    /// The files' common name, without suffix.
    pub stem: String,
    /// The frames of the record's links.
    pub frames: Option<PathBuf>,
    pub journal: Option<PathBuf>,
    /// The record of the mission's run.
    pub run: Option<PathBuf>,
    /// The path of the review, whether it exists or not.
    pub review: PathBuf,
    /// The inputs of the record's simulated vehicles.
    pub inputs: Option<PathBuf>,
    /// The size of frames and journal, in bytes.
    pub bytes: u64,
}

impl RecordFiles {
    /// The frames of the record's links.
    ///
    /// # Errors
    /// A text if they are missing.
    pub fn frames(&self) -> Result<&Path, Text> {
        let frames = self.frames.as_deref();
        frames.ok_or_else(|| text!("replay-no-frames", file = self.stem.as_str()))
    }

    /// The files of the record to which one file belongs. A file with another suffix counts as frames.
    pub fn beside(path: &Path) -> Self {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let stem = [JOURNAL, RUN, INPUTS, FRAMES]
            .iter()
            .find_map(|ending| name.strip_suffix(ending));
        let Some(stem) = stem else {
            return Self {
                stem: name.to_string(),
                frames: Some(path.to_owned()),
                review: path.with_file_name(format!("{name}{REVIEW}")),
                ..Self::default()
            };
        };
        let mut files = Self {
            stem: stem.to_owned(),
            review: path.with_file_name(format!("{stem}{REVIEW}")),
            ..Self::default()
        };
        for ending in [FRAMES, JOURNAL, RUN, INPUTS] {
            let path = path.with_file_name(format!("{stem}{ending}"));
            if path.is_file() {
                files.add(path, ending);
            }
        }
        files
    }

    pub(super) fn add(&mut self, path: PathBuf, ending: &str) {
        let len = fs::metadata(&path).map_or(0, |file| file.len());
        let place = match ending {
            FRAMES => &mut self.frames,
            JOURNAL => &mut self.journal,
            INPUTS => &mut self.inputs,
            _ => {
                self.run = Some(path);
                return;
            }
        };
        *place = Some(path);
        self.bytes += len;
    }

    /// The first line of the record's journal.
    ///
    /// # Errors
    /// The record has no journal, or the journal cannot be read.
    pub fn head(&self) -> io::Result<Head> {
        use std::io::{BufRead as _, BufReader, Read as _};

        let journal = self.journal.as_ref().ok_or(io::ErrorKind::NotFound)?;
        let mut first = Vec::new();
        let file = fs::File::open(journal)?;
        BufReader::new(file.take(HEAD_LEN)).read_until(b'\n', &mut first)?;
        Ok(serde_json::from_slice(&first)?)
    }

    /// The record's journal, if it has one.
    ///
    /// # Errors
    /// A text if the file cannot be read, or is not a journal.
    pub fn read_journal(&self) -> Result<Option<Journal>, Text> {
        use std::io::Read as _;

        let Some(path) = &self.journal else {
            return Ok(None);
        };
        let mut bytes = Vec::new();
        fs::File::open(path)
            .and_then(|file| file.take(LARGEST_JOURNAL).read_to_end(&mut bytes))
            .map_err(|error| unread(path, &error))?;
        Journal::read(&String::from_utf8_lossy(&bytes)).map(Some)
    }

    /// What the record's journal says about an instructor; nothing without a journal that can be read.
    pub fn instructor(&self) -> InstructorPart {
        let journal = self.read_journal().ok().flatten();
        journal.as_ref().map(InstructorPart::of).unwrap_or_default()
    }

    /// Whether a console is still writing the record.
    pub fn is_written(&self) -> bool {
        self.journal.as_deref().is_some_and(is_written)
    }

    /// The first line of the mission's run, and its last line if that ends the run; `None` without
    /// a run.
    pub fn run_outline(&self) -> Option<(RunHead, Option<RunEnd>)> {
        runs::outline(self.run.as_deref()?).ok()
    }

    /// Whether the console that wrote the record was killed: the journal has no end, and no console
    /// is writing it.
    pub fn is_cut_off(&self) -> bool {
        let last = self.journal.as_deref().map(runs::last_line);
        let is_end = |line: &[u8]| {
            let line = serde_json::from_slice::<JournalLine>(line);
            line.is_ok_and(|line| line.what == Happening::End)
        };
        matches!(&last, Some(Ok(line)) if !is_end(line)) && !self.is_written()
    }

    /// Removes frames, journal and joined logs; the record of a mission's run and its inputs stay,
    /// because careers count the run. Without a run, the inputs are removed too.
    ///
    /// # Errors
    /// One of the files cannot be removed.
    pub fn delete(&self) -> Result<(), StoreError> {
        // The journal is deleted last: without it, the others could not be found again. Without a
        // run, the inputs prove nothing.
        let inputs = self.inputs.as_ref().filter(|_| self.run.is_none());
        for path in [self.frames.as_ref(), inputs, self.journal.as_ref()]
            .into_iter()
            .flatten()
        {
            fs::remove_file(path).map_err(|error| undeletable(path, error))?;
            // Most files have no signature.
            drop(fs::remove_file(signature_of(path)));
        }
        self.delete_joined()
    }
}
