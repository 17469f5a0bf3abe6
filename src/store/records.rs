//! Records of flights: the frames of their links and their journals, written as they happen.
//!
//! The files of a record lie beside each other and have one stem: that of the mission's run, where there is one. They
//! are written once a quarter of a second by a thread of their own, so that a disk that stalls holds nothing up, and a
//! program that is killed loses no more than that.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::append::{AppendFile, is_written};
use super::{StoreError, sharing};
use crate::record::{Happening, Head, JournalLine};

mod reviews;

/// How the files of a record end.
const FRAMES: &str = ".tlog";
const JOURNAL: &str = ".flight.jsonl";
/// How the review of a record ends.
const REVIEW: &str = ".review.json";
/// How the record of a mission's run ends, which `runs` keeps.
const RUN: &str = ".run.jsonl";
/// How the file of what entered simulated vehicles ends.
const INPUTS: &str = super::runs::INPUTS;
/// How often what has happened is written.
const WRITE_EVERY: Duration = Duration::from_millis(250);
/// A head is no longer than this.
const HEAD_LEN: u64 = 256 * 1024;

/// How much is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordLimits {
    /// Records that are kept; the oldest go first.
    pub count: usize,
    /// Bytes that they may take together. One record may take half of it.
    pub bytes: u64,
}

impl Default for RecordLimits {
    /// 200 records, and 4 GiB: seven hours with 32 vehicles.
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

/// The files of one record; `None` for each one that is missing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecordFiles {
    /// Their common name without endings.
    pub stem: String,
    /// The frames of its links.
    pub frames: Option<PathBuf>,
    /// What happened beside them.
    pub journal: Option<PathBuf>,
    /// The record of the mission's run.
    pub run: Option<PathBuf>,
    /// Where the review is, or would be.
    pub review: PathBuf,
    /// What entered its simulated vehicles.
    pub inputs: Option<PathBuf>,
    /// Bytes of frames and journal.
    pub bytes: u64,
}

impl RecordFiles {
    /// The files that lie beside one of them. A file with another ending is taken for frames.
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

    fn add(&mut self, path: PathBuf, ending: &str) {
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

    /// The first line of its journal.
    ///
    /// # Errors
    /// There is none, or it cannot be read.
    pub fn head(&self) -> io::Result<Head> {
        use std::io::{BufRead as _, BufReader, Read as _};

        let journal = self.journal.as_ref().ok_or(io::ErrorKind::NotFound)?;
        let mut first = Vec::new();
        let file = fs::File::open(journal)?;
        BufReader::new(file.take(HEAD_LEN)).read_until(b'\n', &mut first)?;
        Ok(serde_json::from_slice(&first)?)
    }

    /// Whether a console is still writing it.
    pub fn is_written(&self) -> bool {
        self.journal.as_deref().is_some_and(is_written)
    }

    /// Removes its review, where there is one.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn delete_review(&self) -> Result<(), StoreError> {
        match fs::remove_file(&self.review) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(unwritable(&self.review, error))
            }
            Ok(()) | Err(_) => Ok(()),
        }
    }

    /// Removes frames and journal; the record of a mission's run stays, because careers count it.
    ///
    /// # Errors
    /// One of them cannot be removed.
    pub fn delete(&self) -> Result<(), StoreError> {
        // The journal goes last: without it, the others could not be found again.
        // Without a run, nothing is left that the inputs could prove.
        let inputs = self.inputs.as_ref().filter(|_| self.run.is_none());
        for path in [self.frames.as_ref(), inputs, self.journal.as_ref()]
            .into_iter()
            .flatten()
        {
            fs::remove_file(path).map_err(|error| unwritable(path, error))?;
        }
        Ok(())
    }
}

fn unwritable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unwritable { path, error }
}

impl Records {
    /// The records in the program's folder for data.
    pub fn within(data: &Path, limits: RecordLimits) -> Self {
        Self {
            folder: data.join("runs"),
            limits,
        }
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    pub fn limits(&self) -> RecordLimits {
        self.limits
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

    /// The frames of the newest record that has any.
    pub fn newest(&self) -> Option<PathBuf> {
        self.list().into_iter().rev().find_map(|it| it.frames)
    }

    /// The same of the records of a profile, or of those without one.
    pub fn newest_of(&self, profile: Option<&str>) -> Option<PathBuf> {
        let is_theirs = |files: &RecordFiles| {
            let head = files.head();
            head.is_ok_and(|head| head.profile.as_deref() == profile)
        };
        let mut newest_first = self.list().into_iter().rev();
        newest_first.find_map(|it| it.frames.clone().filter(|_| is_theirs(&it)))
    }

    /// Begins a record; makes room for it. Its stem is that of a run, or made of the time of day `when` (as
    /// [`utc`](super::utc) writes it) and the subject. What it is to write is fetched from `source`.
    ///
    /// # Errors
    /// Its files cannot be created.
    pub fn begin(
        &self,
        head: &Head,
        stem: Option<&str>,
        when: &str,
        source: impl FnMut() -> Vec<u8> + Send + 'static,
    ) -> Result<Recording, StoreError> {
        let data = self.folder.parent().unwrap_or(&self.folder);
        sharing::folder_within(data, &self.folder)
            .map_err(|error| unwritable(&self.folder, error))?;
        self.make_room();
        let (mut journal, stem) = self.create_journal(head, stem, when)?;
        journal.append(head.to_line().as_bytes())?;
        let path = self.folder.join(format!("{stem}{FRAMES}"));
        let frames = AppendFile::create(path.clone())?
            .ok_or_else(|| unwritable(&path, io::ErrorKind::AlreadyExists.into()))?;
        let writer = RecordWriter {
            frames,
            journal,
            inputs: None,
            source: Box::new(source),
            most_bytes: self.limits.bytes / 2,
        };
        Recording::start(writer, stem, path).map_err(|error| unwritable(&self.folder, error))
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

    /// Removes the oldest records, as far as there are too many; those that are still written stay.
    fn make_room(&self) {
        let mut bytes = 0;
        for (newer, files) in self.list().into_iter().rev().enumerate() {
            bytes += files.bytes;
            // Room is made for one more, which may take half of all.
            let is_too_much =
                newer + 1 >= self.limits.count || bytes > self.limits.bytes - self.limits.bytes / 2;
            if newer > 0 && is_too_much && !files.is_written() {
                // What cannot be removed stays; the new record is worth more than the order.
                drop(files.delete());
            }
        }
    }
}

/// A record that is being written. Dropping it writes what is left.
#[derive(Debug)]
pub struct Recording {
    stem: String,
    frames: PathBuf,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Shared {
    state: Mutex<RecordingState>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct RecordingState {
    /// Lines of the journal that wait.
    lines: String,
    /// Lines of what entered simulated vehicles that wait.
    inputs: String,
    /// The time of the last one.
    last_at: Duration,
    is_over: bool,
    /// Bytes written so far.
    bytes: u64,
    /// Why nothing more is written.
    fault: Option<RecordingFault>,
    has_stopped: bool,
}

/// Why nothing more of a flight is recorded.
#[derive(Debug)]
pub enum RecordingFault {
    /// The disk is full or gone.
    Unwritable(StoreError),
    /// The record has grown as large as it may, in bytes.
    Full(u64),
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, RecordingState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Recording {
    fn start(writer: RecordWriter, stem: String, frames: PathBuf) -> io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let thread = std::thread::Builder::new()
            .name("record".to_owned())
            .spawn(move || writer.run(&theirs))?;
        Ok(Self {
            stem,
            frames,
            shared,
            thread: Some(thread),
        })
    }

    /// What its files are called without their endings.
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// Where its frames are written.
    pub fn frames(&self) -> &Path {
        &self.frames
    }

    /// Adds a line to the journal, whose times never go back.
    pub fn note(&self, line: JournalLine) {
        let mut state = self.shared.state();
        let line = line.not_before(state.last_at);
        if !state.has_stopped {
            state.lines.push_str(&line.to_line());
            state.last_at = line.at();
        }
    }

    /// Adds lines about what entered simulated vehicles.
    pub fn note_inputs(&self, lines: &str) {
        let mut state = self.shared.state();
        if !state.has_stopped {
            state.inputs.push_str(lines);
        }
    }

    /// Adds that the session was ended as usual, at the time of the last line.
    pub fn note_end(&self) {
        let mut state = self.shared.state();
        let line = JournalLine::new(state.last_at, Happening::End).to_line();
        if !state.has_stopped {
            state.lines.push_str(&line);
        }
    }

    /// Bytes that were written so far.
    pub fn bytes(&self) -> u64 {
        self.shared.state().bytes
    }

    /// Why nothing more is written, once.
    pub fn take_fault(&self) -> Option<RecordingFault> {
        self.shared.state().fault.take()
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        self.shared.state().is_over = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // A writer that panicked has nothing more to write.
            drop(thread.join());
        }
    }
}

struct RecordWriter {
    frames: AppendFile,
    journal: AppendFile,
    /// What entered simulated vehicles: made when there is something.
    inputs: Option<AppendFile>,
    source: Box<dyn FnMut() -> Vec<u8> + Send>,
    most_bytes: u64,
}

impl RecordWriter {
    /// Writes what has happened until the record is over or cannot be written.
    fn run(mut self, shared: &Shared) {
        loop {
            let (lines, inputs, is_over) = {
                let state = shared.state();
                let wait = |state: &mut RecordingState| !state.is_over;
                let waited = shared.changed.wait_timeout_while(state, WRITE_EVERY, wait);
                let (mut state, _) = waited.unwrap_or_else(PoisonError::into_inner);
                let lines = std::mem::take(&mut state.lines);
                (lines, std::mem::take(&mut state.inputs), state.is_over)
            };
            let outcome = self.write(&lines).and_then(|()| self.write_inputs(&inputs));
            let mut state = shared.state();
            state.bytes = self.len();
            if let Err(fault) = outcome {
                state.fault = Some(fault);
                state.has_stopped = true;
                return;
            }
            if is_over {
                return;
            }
        }
    }

    /// Bytes written so far.
    fn len(&self) -> u64 {
        let inputs = self.inputs.as_ref().map_or(0, AppendFile::len);
        self.frames.len() + self.journal.len() + inputs
    }

    fn write_inputs(&mut self, lines: &str) -> Result<(), RecordingFault> {
        if lines.is_empty() {
            return Ok(());
        }
        if self.inputs.is_none() {
            let name = self.journal.path().to_string_lossy().into_owned();
            let stem = name.strip_suffix(JOURNAL).unwrap_or(&name);
            let made = AppendFile::create(PathBuf::from(format!("{stem}{INPUTS}")));
            self.inputs = made.map_err(RecordingFault::Unwritable)?;
        }
        let Some(inputs) = &mut self.inputs else {
            return Ok(());
        };
        inputs
            .append(lines.as_bytes())
            .map_err(RecordingFault::Unwritable)
    }

    fn write(&mut self, lines: &str) -> Result<(), RecordingFault> {
        // Frames first: a journal may lack its last lines, but names no frame that is not there.
        let frames = (self.source)();
        let len = self.len() + frames.len() as u64;
        let is_full = len > self.most_bytes;
        let written = if is_full {
            Ok(())
        } else {
            self.frames.append(&frames)
        };
        written
            .and_then(|()| self.journal.append(lines.as_bytes()))
            .map_err(RecordingFault::Unwritable)?;
        if is_full {
            return Err(RecordingFault::Full(self.most_bytes));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
