//! Writing a record: lines and frames wait in memory until a thread appends them to the files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::{AppendFile, INPUTS, RecordFiles, StoreError};
use crate::record::{Happening, JournalLine};
use crate::text;
use crate::text::Text;

const WRITE_EVERY: Duration = Duration::from_millis(250);
/// The time between writes while others follow the record.
const WRITE_EVERY_FOR_OTHERS: Duration = Duration::from_millis(100);

/// A record being written. Dropping it writes the remaining data.
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
    /// Waiting lines of the journal.
    lines: String,
    /// Waiting lines of the inputs.
    inputs: String,
    last_at: Duration,
    is_over: bool,
    /// Whether others follow the record while it is written.
    is_followed: bool,
    /// The number of bytes written so far.
    bytes: u64,
    fault: Option<RecordingFault>,
    has_stopped: bool,
}

/// Why recording has stopped.
#[derive(Debug)]
pub enum RecordingFault {
    /// The disk is full or unavailable.
    Unwritable(StoreError),
    /// The record has reached its limit, in bytes.
    Full(u64),
}

impl From<&RecordingFault> for Text {
    fn from(fault: &RecordingFault) -> Self {
        match fault {
            RecordingFault::Unwritable(error) => {
                text!("record-broken-off", fault = Self::from(error))
            }
            RecordingFault::Full(bytes) => text!("record-full", mib = bytes / (1024 * 1024)),
        }
    }
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, RecordingState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes until the record is over or writing fails.
    fn write(&self, mut writer: RecordWriter, mut source: impl FnMut() -> Vec<u8>) {
        loop {
            let (lines, inputs, is_over) = {
                let wait = |state: &mut RecordingState| !state.is_over;
                let state = self.state();
                let pause = if state.is_followed {
                    WRITE_EVERY_FOR_OTHERS
                } else {
                    WRITE_EVERY
                };
                let waited = self.changed.wait_timeout_while(state, pause, wait);
                let (mut state, _) = waited.unwrap_or_else(PoisonError::into_inner);
                let lines = std::mem::take(&mut state.lines);
                (lines, std::mem::take(&mut state.inputs), state.is_over)
            };
            let outcome = writer.append(&RecordPiece {
                frames: &source(),
                lines: &lines,
                inputs: &inputs,
            });
            let mut state = self.state();
            state.bytes = writer.len();
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
}

impl Recording {
    /// Starts a thread that writes the frames from `source` and the lines added to the recording.
    pub(super) fn start(
        writer: RecordWriter,
        source: impl FnMut() -> Vec<u8> + Send + 'static,
    ) -> io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let (stem, frames) = (writer.stem.clone(), writer.frames.path().to_owned());
        let thread = std::thread::Builder::new()
            .name("record".to_owned())
            .spawn(move || theirs.write(writer, source))?;
        Ok(Self {
            stem,
            frames,
            shared,
            thread: Some(thread),
        })
    }

    /// The name of the record's files, without suffix.
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// The path of the record's frames.
    pub fn frames(&self) -> &Path {
        &self.frames
    }

    /// Writes more often from now on, because others follow the record.
    pub fn note_followed(&self) {
        self.shared.state().is_followed = true;
    }

    /// Adds a line to the journal; a time earlier than that of the last line is replaced by the
    /// time of the last line.
    pub fn note(&self, line: JournalLine) {
        let mut state = self.shared.state();
        let line = line.not_before(state.last_at);
        if !state.has_stopped {
            state.lines.push_str(&line.to_line());
            state.last_at = line.at();
        }
    }

    /// Adds lines about the inputs of simulated vehicles.
    pub fn note_inputs(&self, lines: &str) {
        let mut state = self.shared.state();
        if !state.has_stopped {
            state.inputs.push_str(lines);
        }
    }

    /// Notes the regular end of the session, at the time of the last line.
    pub fn note_end(&self) {
        let mut state = self.shared.state();
        let line = JournalLine::new(state.last_at, Happening::End).to_line();
        if !state.has_stopped {
            state.lines.push_str(&line);
        }
    }

    /// Ends the record. Removes its files if they are not to be kept, or contain no frame.
    pub fn finish(mut self, is_kept: bool) {
        self.stop();
        let is_empty = fs::metadata(&self.frames).is_ok_and(|file| file.len() == 0);
        if !is_kept || is_empty {
            // A file that cannot be removed stays as an empty record, which is replayed only on request.
            drop(RecordFiles::beside(&self.frames).delete());
        }
    }

    /// Writes the remaining data.
    fn stop(&mut self) {
        self.shared.state().is_over = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // A writer that panicked has nothing left to write.
            drop(thread.join());
        }
    }

    /// The number of bytes written so far.
    pub fn bytes(&self) -> u64 {
        self.shared.state().bytes
    }

    /// Why writing has stopped; returned once.
    pub fn take_fault(&self) -> Option<RecordingFault> {
        self.shared.state().fault.take()
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        self.stop();
    }
}

/// The files of a record being written.
#[derive(Debug)]
pub struct RecordWriter {
    pub(super) stem: String,
    pub(super) frames: AppendFile,
    pub(super) journal: AppendFile,
    /// The inputs of simulated vehicles; created when needed.
    pub(super) inputs: Option<AppendFile>,
    pub(super) most_bytes: u64,
}

/// The next piece of each file.
#[derive(Debug, Clone, Copy, Default)]
pub struct RecordPiece<'a> {
    /// Entries of a tlog.
    pub frames: &'a [u8],
    /// Lines of the journal.
    pub lines: &'a str,
    /// Lines about the inputs of simulated vehicles.
    pub inputs: &'a str,
}

impl RecordWriter {
    /// Appends to the files.
    ///
    /// # Errors
    /// The disk is full or unavailable, or the record has reached its limit; then frames are dropped.
    pub fn append(&mut self, piece: &RecordPiece<'_>) -> Result<(), RecordingFault> {
        // Frames are written first, so that a journal may lack its last lines, but never refers to missing frames.
        let is_full = self.len() + piece.frames.len() as u64 > self.most_bytes;
        let written = if is_full {
            Ok(())
        } else {
            self.frames.append(piece.frames)
        };
        written
            .and_then(|()| self.journal.append(piece.lines.as_bytes()))
            .and_then(|()| self.append_inputs(piece.inputs))
            .map_err(RecordingFault::Unwritable)?;
        if is_full {
            return Err(RecordingFault::Full(self.most_bytes));
        }
        Ok(())
    }

    fn len(&self) -> u64 {
        let inputs = self.inputs.as_ref().map_or(0, AppendFile::len);
        self.frames.len() + self.journal.len() + inputs
    }

    fn append_inputs(&mut self, lines: &str) -> Result<(), StoreError> {
        if lines.is_empty() {
            return Ok(());
        }
        if self.inputs.is_none() {
            let path = self
                .frames
                .path()
                .with_file_name(format!("{}{INPUTS}", self.stem));
            self.inputs = AppendFile::create(path)?;
        }
        match &mut self.inputs {
            Some(inputs) => inputs.append(lines.as_bytes()),
            None => Ok(()),
        }
    }
}
