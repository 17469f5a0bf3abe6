//! The pilot's workload, in a replay.

use super::MissionPage;
use crate::app::room::page::Tone;
use crate::text;

impl MissionPage<'_> {
    /// The curves of a recorded flight, with a mark at the moment shown; never during the flight itself.
    pub(super) fn workload(&mut self) {
        let Some(strips) = self
            .state
            .workload_strips(self.text.locale, self.text.width)
        else {
            return;
        };
        self.text.title(&text!("workload-title"));
        for line in strips.lines() {
            self.text.add(Tone::Plain, line);
        }
        self.text.say(Tone::Muted, &text!("workload-how"));
    }
}
