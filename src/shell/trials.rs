//! Drafts flown in simulation, in a background thread.

use std::thread::JoinHandle;

use super::Console;
use super::last_rehearsal::recorded;
use crate::app::event::Event;
use crate::draft::{Trial, Tried};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The trial under way.
pub(super) type TrialWork = JoinHandle<(Tried, Option<Notice>)>;

impl Console {
    /// Starts to fly drafts; [`take_trial`](Self::take_trial) shows the outcome.
    pub(super) fn begin_trial(&mut self, trial: Trial) {
        if self.trial.as_ref().is_some_and(|it| !it.is_finished()) {
            self.post(Event::Failed(text!("draft-trial-busy")));
            return;
        }
        let thread = std::thread::Builder::new().name("trial".to_owned());
        let records = self.options.preferences.records.clone();
        // A search for changes flies many times.
        let records = records.filter(|_| !trial.is_apart);
        let fly = move || {
            let numbers = (1..=VehicleId::MAX).take(trial.drafts.len());
            let numbers: Vec<VehicleId> = numbers.collect();
            recorded(records.as_ref(), &numbers, |listener| {
                trial.fly_heard(listener)
            })
        };
        match thread.spawn(fly) {
            Ok(work) => self.trial = Some(work),
            Err(error) => self.post(Event::Failed(Text::verbatim(error.to_string()))),
        }
    }

    /// Shows the outcome of a trial that is over.
    pub(super) fn take_trial(&mut self) {
        let Some(work) = self.trial.take_if(|it| it.is_finished()) else {
            return;
        };
        match work.join() {
            Ok((tried, notice)) => {
                self.post(Event::Tried(tried));
                if let Some(notice) = notice {
                    let at = self.clock.now();
                    self.post(Event::Notice(Notice { at, ..notice }));
                }
            }
            Err(_) => self.post(Event::Failed(text!("draft-trial-broken"))),
        }
    }
}
