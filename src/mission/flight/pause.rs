//! Pauses, for the record.

use std::time::Duration;

use super::Flight;
use crate::notice::Notice;
use crate::scoring::EventKind;
use crate::text;
use crate::vehicle::Severity;

impl Flight {
    /// Takes down that everything stood still for so long, by the clock on the wall; mission time did as well.
    /// Returns what a human should hear, on mission time; nothing once the flight is over.
    pub fn note_pause(&mut self, lasted: Duration) -> Option<Notice> {
        if self.ended.is_some() {
            return None;
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.pause(lasted);
        }
        let mut notices = Vec::new();
        let text = text!("mission-paused", seconds = lasted.as_secs());
        self.say(EventKind::Pause, None, Severity::Notice, text, &mut notices);
        notices.pop()
    }
}
