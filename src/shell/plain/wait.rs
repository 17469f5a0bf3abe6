//! Waits that delay the next line, as in a script.

use crate::app::State;
use crate::diagnostic::Diagnostic;
use crate::language::{Findings, Pilot, PilotEvent, Script, Seen};

/// The wait that delays the next line, if there is one.
#[derive(Debug, Default)]
pub(super) struct PlainWait {
    pilot: Option<Pilot>,
}

impl PlainWait {
    /// Whether the next line can run.
    pub fn is_over(&self) -> bool {
        self.pilot.is_none()
    }

    /// Starts a line as a script; the lines after it wait until the script ends.
    ///
    /// # Errors
    /// The faults of the line.
    pub fn begin(&mut self, line: &str, state: &State) -> Result<(), Vec<Diagnostic>> {
        let script = state.with_context(|context| Script::parse(line, context))?;
        self.pilot = Some(Pilot::new(script));
        Ok(())
    }

    /// Advances the wait; returns the text of each wait that has timed out.
    pub fn look(&mut self, state: &State) -> Vec<String> {
        let Some(pilot) = &mut self.pilot else {
            return Vec::new();
        };
        let session = state.session();
        let findings = session.mission().map(|progress| &progress.findings);
        let none = Findings::default();
        let seen = Seen {
            vehicles: session.vehicles(),
            ledger: session.ledger(),
            findings: findings.unwrap_or(&none),
        };
        // Waits take flight time, as in a script: a speed-up shortens them as well.
        let events = pilot.step(session.time(state.now()), seen);
        if !events.is_empty() {
            self.pilot = None;
        }
        let timed_out = events.into_iter().filter_map(|event| match event {
            PilotEvent::WaitTimedOut { text, .. } => Some(text),
            PilotEvent::Do(_) | PilotEvent::Finished => None,
        });
        timed_out.collect()
    }
}
