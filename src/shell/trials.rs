//! Drafts flown in simulation, in a thread beside the console's own work.

use std::thread::JoinHandle;

use super::Console;
use crate::app::event::Event;
use crate::draft::{Trial, Tried};
use crate::text;
use crate::text::Text;

/// The trial under way.
pub(super) type TrialWork = JoinHandle<Tried>;

impl Console {
    /// Starts to fly drafts; [`take_trial`](Self::take_trial) shows the outcome.
    pub(super) fn begin_trial(&mut self, trial: Trial) {
        if self.trial.as_ref().is_some_and(|it| !it.is_finished()) {
            self.post(Event::Failed(text!("draft-trial-busy")));
            return;
        }
        let thread = std::thread::Builder::new().name("trial".to_owned());
        match thread.spawn(move || trial.fly()) {
            Ok(work) => self.trial = Some(work),
            Err(error) => self.post(Event::Failed(Text::verbatim(error.to_string()))),
        }
    }

    /// Shows the outcome of a trial that is over.
    pub(super) fn take_trial(&mut self) {
        let Some(work) = self.trial.take_if(|it| it.is_finished()) else {
            return;
        };
        self.post(match work.join() {
            Ok(tried) => Event::Tried(tried),
            Err(_) => Event::Failed(text!("draft-trial-broken")),
        });
    }
}
