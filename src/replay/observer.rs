//! A console without a screen, whose state becomes a key frame.

use super::begin;
use crate::app::event::{Event, ReplayEvent, Started};
use crate::app::state::{ReplayPosition, ReplayView};
use crate::app::{App, FlightSnapshot, Setup};
use crate::config::Config;

/// A console without a screen that watches a recording.
#[derive(Debug)]
pub(super) struct Observer(App);

impl Observer {
    /// An observer at the beginning of a recording; `begun` says who flies what, if that is not the console's own user.
    pub fn new(view: ReplayView, started: &Started, config: &Config, begun: Option<Event>) -> Self {
        let setup = Setup {
            config: config.clone(),
            ..Setup::default()
        };
        let mut observer = Self(App::new(setup));
        for event in begin(view, started.clone()).into_iter().chain(begun) {
            observer.see(event);
        }
        observer
    }

    /// Handles the events of one step.
    pub fn watch(&mut self, position: ReplayPosition, events: &[Event]) {
        self.see(ReplayEvent::At(position).into());
        for event in events {
            self.see(event.clone());
        }
    }

    /// A snapshot of the current state.
    pub fn snapshot(&self) -> FlightSnapshot {
        FlightSnapshot::of(self.0.state())
    }

    pub fn app(&self) -> &App {
        &self.0
    }

    /// Handles all events of a seek.
    #[cfg(test)]
    pub fn see_all(&mut self, events: Vec<Event>) {
        for event in events {
            self.see(event);
        }
    }

    fn see(&mut self, event: Event) {
        // The effects were carried out in the recorded flight.
        drop(self.0.update(event));
    }
}
