//! The output of an instance: the last lines in memory, more in files of its folder.
//!
//! It is read as fast as it arrives, because a process with unread output blocks. Its cost is bounded: in memory by the
//! number and length of lines, on the disk by the size and number of files.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use tokio::io::{AsyncRead, AsyncReadExt as _};
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::{Instant, timeout};
use utoipa::ToSchema;

use super::launcher::RunningProcess;

mod file;
mod lines;
#[cfg(all(test, target_os = "linux"))]
mod tests;

use file::LogFile;
use lines::Cutter;

/// The number of lines kept in memory.
const LINES_KEPT: usize = 200;
const READ_LEN: usize = 64 * 1024;
/// How long to wait for the last output of a process that is gone.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// A line of an instance's output.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = Line)]
pub struct OutputLine {
    /// Its number, from 1; the count continues when the instance is started again.
    pub number: u64,
    /// The line without control characters, at most 400 characters of it.
    pub text: String,
}

/// The output of one instance, across restarts. Clones share it.
#[derive(Debug, Clone)]
pub struct ProcessOutput(Arc<OutputInner>);

#[derive(Debug)]
struct OutputInner {
    kept: Mutex<VecDeque<OutputLine>>,
    /// The number of the last line.
    last: watch::Sender<u64>,
    file: Mutex<LogFile>,
}

/// Whether a line of ArduPilot's tells nothing. It stays in the file.
fn is_noise(line: &str) -> bool {
    line.trim() == "Skipping port (null)"
}

impl ProcessOutput {
    /// The output of a new instance, with its files in this folder.
    pub(super) fn new(folder: PathBuf) -> Self {
        Self(Arc::new(OutputInner {
            kept: Mutex::default(),
            last: watch::Sender::new(0),
            file: Mutex::new(LogFile::new(folder)),
        }))
    }

    /// Reads a process's output to its end. Must be called inside a tokio runtime.
    pub(super) fn follow(&self, process: &mut RunningProcess) -> Following {
        let (out, err) = process.take_output();
        let read = |pipe: Option<Box<dyn AsyncRead + Send + Unpin>>| {
            let output = self.clone();
            pipe.map(|pipe| tokio::spawn(output.read(pipe)))
        };
        let out = read(out.map(|pipe| Box::new(pipe) as _));
        let err = read(err.map(|pipe| Box::new(pipe) as _));
        Following(out.into_iter().chain(err).collect())
    }

    /// Adds a line of the hangar itself.
    pub(super) fn note(&self, text: &str) {
        let mut cutter = Cutter::default();
        let mut lines = cutter.push(text.as_bytes());
        lines.extend(cutter.finish());
        self.add(lines);
    }

    /// The last lines, at most `count`, oldest first.
    pub fn last(&self, count: usize) -> Vec<OutputLine> {
        let kept = locked(&self.0.kept);
        let from = kept.len().saturating_sub(count);
        kept.range(from..).cloned().collect()
    }

    /// The kept lines with this number or a higher one, oldest first; with 0, all of them.
    pub fn since(&self, number: u64) -> Vec<OutputLine> {
        let kept = locked(&self.0.kept);
        let from = kept.partition_point(|line| line.number < number);
        kept.range(from..).cloned().collect()
    }

    /// A receiver of the number of the last line; 0 before the first.
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.0.last.subscribe()
    }

    async fn read(self, mut pipe: Box<dyn AsyncRead + Send + Unpin>) {
        let mut bytes = vec![0; READ_LEN];
        let mut cutter = Cutter::default();
        // A broken pipe counts as ended.
        while let Ok(len @ 1..) = pipe.read(&mut bytes).await {
            self.add(cutter.push(&bytes[..len]));
        }
        self.add(cutter.finish().into_iter().collect());
    }

    fn add(&self, lines: Vec<String>) {
        if lines.is_empty() {
            return;
        }
        let note = locked(&self.0.file).write(&lines, Instant::now());
        let lines: Vec<String> = lines.into_iter().filter(|line| !is_noise(line)).collect();
        let mut kept = locked(&self.0.kept);
        let mut number = *self.0.last.borrow();
        // If there are very many lines, only the last ones are kept.
        let total = lines.len() + usize::from(note.is_some());
        number += total.saturating_sub(LINES_KEPT) as u64;
        for text in lines
            .into_iter()
            .chain(note)
            .skip(total.saturating_sub(LINES_KEPT))
        {
            number += 1;
            if kept.len() == LINES_KEPT {
                kept.pop_front();
            }
            kept.push_back(OutputLine { number, text });
        }
        // This is sent before the lock is released, because the next number follows from it.
        self.0.last.send_replace(number);
    }
}

/// Locks a mutex, even a poisoned one: a panic cannot interrupt a change.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The reading of one process's output. Dropping it ends the reading.
#[derive(Debug)]
#[must_use = "dropping it ends the reading"]
pub(super) struct Following(Vec<JoinHandle<()>>);

impl Following {
    /// Waits for the output that a process printed before it ended. If another process still holds its pipes, the wait
    /// is short.
    pub async fn finish(mut self) {
        let all = async {
            for reading in &mut self.0 {
                // The task ended, or was aborted.
                drop(reading.await);
            }
        };
        drop(timeout(LAST_WORDS, all).await);
    }
}

impl Drop for Following {
    fn drop(&mut self) {
        for reading in &self.0 {
            reading.abort();
        }
    }
}
