//! The mission of a recording.

use std::time::Duration;

use crate::mission::record::{Reenactment, Stored};

/// The mission that is flown again.
#[derive(Debug)]
pub(super) struct MissionStage {
    run: Stored,
    pub flight: Reenactment,
    pub elapsed: Duration,
}

impl MissionStage {
    pub fn new(run: &Stored) -> Option<Self> {
        Some(Self {
            flight: run.reenact().ok()?,
            run: run.clone(),
            elapsed: Duration::ZERO,
        })
    }

    /// The mission of a run that is still being recorded: `lines` are those so far, with the head.
    pub fn growing(lines: &str) -> Option<Self> {
        let head = lines.split_inclusive('\n').next()?;
        let mut stage = Self::new(&Stored::read(head).ok()?)?;
        stage.flight.grow(&lines[head.len()..]);
        Some(stage)
    }

    /// Flies up to a mission time, beginning again at the start if that time is in the past.
    pub fn go_to(&mut self, elapsed: Duration) {
        if elapsed < self.elapsed
            && let Ok(anew) = self.run.reenact()
        {
            self.flight = anew;
        }
        self.elapsed = elapsed;
        drop(self.flight.advance(elapsed));
    }
}
