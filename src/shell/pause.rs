//! Pauses and resumes a session.

use super::{Console, RunningSession};
use crate::app::event::{Event, SessionEvent};
use crate::notice::Notice;
use crate::text;
use crate::vehicle::Severity;

impl Console {
    /// Stops the simulator and the clock by which every deadline, every link's silence and the mission count.
    pub(super) fn pause(&mut self) {
        let Some(running) = &self.running else {
            return;
        };
        running.hold(true);
        self.clock.stop();
        self.post(SessionEvent::Paused(true));
    }

    /// Resumes; does nothing unless the session is paused.
    pub(super) fn go_on(&mut self) {
        let Some(lasted) = self.clock.go_on() else {
            return;
        };
        let now = self.clock.now();
        self.post(SessionEvent::Paused(false));
        let Some(running) = &mut self.running else {
            return;
        };
        running.hold(false);
        if let Some(notice) = running.note_pause(lasted, now) {
            self.post(notice);
        }
    }

    /// Has something happen in the mission, and says what or why not.
    pub(super) fn inject(&mut self, name: &str) {
        let Some(outcome) = self.running.as_mut().and_then(|it| it.inject(name)) else {
            return;
        };
        let event = match outcome {
            Ok(text) => Event::Notice(Notice {
                at: self.clock.now(),
                vehicle: None,
                severity: Severity::Notice,
                kind: None,
                text: text!("inject-done", what = text),
            }),
            Err(text) => Event::Failed(text),
        };
        self.post(event);
    }

    /// Ends the mission; its report comes with the next tick.
    pub(super) fn abandon(&mut self) {
        self.go_on();
        self.running.iter_mut().for_each(RunningSession::abandon);
    }
}
