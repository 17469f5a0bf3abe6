//! Output to the terminal, written by a separate thread.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd as _;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::{Duration, Instant};

use super::escape_codes;

/// The state of the output to the terminal.
#[derive(Debug, Default)]
pub struct Traffic {
    state: Mutex<PendingWrite>,
    /// Signalled when everything has been written.
    written: Condvar,
    /// The number of bytes passed on for writing so far.
    bytes: AtomicU64,
}

#[derive(Debug, Default)]
struct PendingWrite {
    /// Pieces of frames that the thread has not written yet.
    waiting: usize,
    /// The writes completed since they were last taken.
    done: Vec<Written>,
}

/// A completed write to the terminal.
#[derive(Debug, Clone, Copy)]
pub struct Written {
    /// How long the operating system took.
    pub took: Duration,
    pub bytes: u64,
}

impl Traffic {
    fn state(&self) -> MutexGuard<'_, PendingWrite> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether the operating system has accepted everything.
    pub fn is_idle(&self) -> bool {
        self.state().waiting == 0
    }

    /// The number of bytes passed on for writing so far.
    pub fn bytes(&self) -> u64 {
        self.bytes.load(Ordering::Relaxed)
    }

    /// The writes completed since the last call.
    pub fn take_written(&self) -> Vec<Written> {
        std::mem::take(&mut self.state().done)
    }

    /// Waits until everything has been written, but no longer than `patience`; returns whether it
    /// has been.
    pub fn wait_until_written(&self, patience: Duration) -> bool {
        let waited = self
            .written
            .wait_timeout_while(self.state(), patience, |writing| writing.waiting > 0);
        waited.is_ok_and(|(writing, _)| writing.waiting == 0)
    }
}

/// Collects output and passes it to the writing thread in large pieces.
pub struct FrameWriter {
    frame: Vec<u8>,
    /// The writing thread; `None` if the frames are discarded.
    frames: Option<mpsc::Sender<Vec<u8>>>,
    traffic: Arc<Traffic>,
}

impl FrameWriter {
    /// A writer that only counts the bytes.
    pub fn nowhere(traffic: Arc<Traffic>) -> Self {
        Self {
            frame: Vec::new(),
            frames: None,
            traffic,
        }
    }

    /// A writer to standard output.
    ///
    /// # Errors
    /// Standard output is closed.
    pub fn to_terminal(traffic: Arc<Traffic>) -> io::Result<Self> {
        // Not `io::stdout()`: its lock would be held during a write to a terminal that does not read.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (frames, frames_out) = mpsc::channel::<Vec<u8>>();
        let shared = Arc::clone(&traffic);
        std::thread::spawn(move || {
            for frame in frames_out {
                let began = Instant::now();
                // A write error means that the terminal is gone; the signal or the end of input that follows ends the
                // console.
                drop(terminal.write_all(&frame));
                let mut writing = shared.state();
                writing.waiting -= 1;
                writing.done.push(Written {
                    took: began.elapsed(),
                    bytes: frame.len() as u64,
                });
                shared.written.notify_all();
            }
        });
        Ok(Self {
            frame: Vec::new(),
            frames: Some(frames),
            traffic,
        })
    }
}

impl Write for FrameWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.frame.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        let frame = escape_codes::with_basic_colours(&self.frame);
        self.frame.clear();
        self.traffic
            .bytes
            .fetch_add(frame.len() as u64, Ordering::Relaxed);
        match &self.frames {
            Some(frames) if !frame.is_empty() => {
                self.traffic.state().waiting += 1;
                frames
                    .send(frame)
                    .map_err(|_| io::Error::from(io::ErrorKind::BrokenPipe))
            }
            _ => Ok(()),
        }
    }
}
