//! What enters a simulator that runs is taken down here, until a recorder fetches it.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::record::{InputLog, InputsHead};
use crate::sim::World;

/// What waits for the recorder at most, in bytes: beyond that nothing more is taken down.
const MOST_WAITING: usize = 32 * 1024 * 1024;

/// Where the lines wait. All clones are one.
#[derive(Clone, Default)]
pub struct InputSink(Arc<Mutex<WaitingInputs>>);

#[derive(Default)]
struct WaitingInputs {
    lines: String,
    /// The steps that the simulator has made.
    steps: u64,
    is_closed: bool,
}

impl fmt::Debug for InputSink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("InputSink").field(&self.steps()).finish()
    }
}

impl InputSink {
    /// The lines since the last call.
    pub fn take(&self) -> String {
        std::mem::take(&mut self.waiting().lines)
    }

    /// How many steps the simulator has made.
    pub fn steps(&self) -> u64 {
        self.waiting().steps
    }

    /// Takes nothing down any more.
    pub fn close(&self) {
        let mut waiting = self.waiting();
        waiting.is_closed = true;
        waiting.lines = String::new();
    }

    fn put(&self, lines: &str, steps: u64) {
        let mut waiting = self.waiting();
        waiting.steps = steps;
        waiting.is_closed |= waiting.lines.len() + lines.len() > MOST_WAITING;
        if !waiting.is_closed {
            waiting.lines.push_str(lines);
        }
    }

    fn waiting(&self) -> MutexGuard<'_, WaitingInputs> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Takes down what enters a world that a simulator runs.
#[derive(Debug)]
pub(super) struct WorldRecord {
    log: InputLog,
    sink: InputSink,
}

impl WorldRecord {
    pub(super) fn begin(head: &InputsHead, sink: InputSink, world: &mut World) -> Self {
        let log = InputLog::begin(head, world, &[]);
        Self { log, sink }
    }

    /// To be called after each step.
    pub(super) fn follow(&mut self, world: &mut World) {
        self.log.follow(world);
    }

    /// Time passes at another pace from now on.
    pub(super) fn note_pace(&mut self, world: &World, speedup: f64) {
        self.log.note_pace(world, speedup);
    }

    /// Hands over what was taken down, before the vehicles are heard.
    pub(super) fn publish(&mut self, world: &World) {
        self.sink.put(&self.log.take(), world.steps());
    }

    /// Ends the log.
    pub(super) fn end(&mut self, world: &mut World) {
        self.log.end(world);
        self.publish(world);
    }
}
