//! A record while it is written: lines and frames wait in memory until a thread appends them to the files.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::{AppendFile, INPUTS, JOURNAL, StoreError};
use crate::record::{Happening, JournalLine};

/// How often what has happened is written.
const WRITE_EVERY: Duration = Duration::from_millis(250);

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
    pub(super) fn start(writer: RecordWriter, stem: String, frames: PathBuf) -> io::Result<Self> {
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

/// Writes the files of a record, in a thread of its own.
pub(super) struct RecordWriter {
    pub(super) frames: AppendFile,
    pub(super) journal: AppendFile,
    /// What entered simulated vehicles: made when there is something.
    pub(super) inputs: Option<AppendFile>,
    pub(super) source: Box<dyn FnMut() -> Vec<u8> + Send>,
    pub(super) most_bytes: u64,
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
