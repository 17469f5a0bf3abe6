//! Recording of a running simulator's inputs, until a recorder fetches them.

use std::fmt;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::record::{InputLog, InputsHead};
use crate::sim::World;

/// The maximum number of bytes that wait for the recorder; if there are more, recording stops.
const MOST_WAITING: usize = 32 * 1024 * 1024;

/// The waiting lines. All clones share them.
#[derive(Clone, Default)]
pub struct InputSink(Arc<SharedInputs>);

#[derive(Default)]
struct SharedInputs {
    waiting: Mutex<WaitingInputs>,
    /// Signals that no simulator adds lines any more.
    ended: Condvar,
}

#[derive(Default)]
struct WaitingInputs {
    /// Whether a simulator is adding lines.
    is_fed: bool,
    lines: String,
    is_closed: bool,
}

impl fmt::Debug for InputSink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("InputSink").finish_non_exhaustive()
    }
}

impl InputSink {
    /// The lines since the last call.
    pub fn take(&self) -> String {
        std::mem::take(&mut self.waiting().lines)
    }

    /// Waits until the simulator has added its last line, but no longer than `most`.
    pub fn wait_for_end(&self, most: Duration) {
        let is_fed = |waiting: &mut WaitingInputs| waiting.is_fed;
        let waited = self
            .0
            .ended
            .wait_timeout_while(self.waiting(), most, is_fed);
        drop(waited);
    }

    pub fn close(&self) {
        let mut waiting = self.waiting();
        waiting.is_closed = true;
        waiting.lines = String::new();
    }

    fn put(&self, lines: &str) {
        let mut waiting = self.waiting();
        waiting.is_closed |= waiting.lines.len() + lines.len() > MOST_WAITING;
        if !waiting.is_closed {
            waiting.lines.push_str(lines);
        }
    }

    fn waiting(&self) -> MutexGuard<'_, WaitingInputs> {
        let waiting = self.0.waiting.lock();
        waiting.unwrap_or_else(PoisonError::into_inner)
    }

    fn feed(&self, is_fed: bool) {
        self.waiting().is_fed = is_fed;
        self.0.ended.notify_all();
    }
}

/// Records the inputs of a simulator's world.
#[derive(Debug)]
pub(super) struct WorldRecord {
    log: InputLog,
    sink: InputSink,
}

impl WorldRecord {
    pub(super) fn begin(head: &InputsHead, sink: InputSink, world: &mut World) -> Self {
        let log = InputLog::begin(head, world, &[]);
        sink.feed(true);
        Self { log, sink }
    }

    /// Records the inputs of a step; must be called after each one.
    pub(super) fn follow(&mut self, world: &mut World) {
        self.log.follow(world);
    }

    /// Notes a new pace.
    pub(super) fn note_pace(&mut self, world: &World, speedup: f64) {
        self.log.note_pace(world, speedup);
    }

    /// Passes the lines on, before the vehicles' output is sent.
    pub(super) fn publish(&mut self) {
        self.sink.put(&self.log.take());
    }

    pub(super) fn end(&mut self, world: &mut World) {
        self.log.end(world);
        self.publish();
    }
}

impl Drop for WorldRecord {
    fn drop(&mut self) {
        self.sink.feed(false);
    }
}
