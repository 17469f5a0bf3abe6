//! Begins and ends sessions.

use std::time::Duration;

use super::Console;
use super::session::{Backend, Plan, Running};
use crate::app::event::Event;
use crate::app::update;
use crate::link::{Address, AddressError};
use crate::text::Text;

/// How long the end of the program waits for the processes of its vehicles to end.
const LAST_PROCESS_PATIENCE: Duration = Duration::from_secs(2);

/// A seed for the first try where none is given.
const FIRST_SEED: u64 = 1;

/// One of the tries at a mission.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt {
    /// What varies it.
    pub seed: u64,
}

impl Default for Attempt {
    fn default() -> Self {
        Self { seed: FIRST_SEED }
    }
}

impl Console {
    /// Starts something else than what runs.
    pub(super) async fn start_afresh(&mut self, plan: Plan) -> Result<(), Text> {
        let seed = self.options.seed.unwrap_or(FIRST_SEED);
        self.attempt = Attempt { seed };
        self.start(plan).await
    }

    /// Starts what runs once more: with another seed, unless the user has chosen one or wants the same. What was said
    /// before a launch that did not come holds for the next one.
    pub(super) async fn start_again(&mut self, plan: Plan, alike: bool) {
        if !alike && self.options.seed.is_none() {
            self.attempt.seed = self.attempt.seed.wrapping_add(1);
        }
        let pledge = self.running.as_ref().and_then(Running::open_pledge);
        let outcome = self.start(plan).await;
        if let (Some(running), Some(pledge)) = (&mut self.running, pledge) {
            running.renew(pledge);
        }
        self.tell_failure(outcome);
    }

    /// Ends the session. What takes a while to end is waited for by who has to.
    pub(super) fn end_session(&mut self) {
        self.go_on();
        if let Some(running) = self.running.take() {
            self.ending = running.ending();
        }
    }

    /// Ends everything, and waits for it a little: what then still runs ends with this program.
    pub(super) async fn close(&mut self) {
        self.end_session();
        let ending = std::mem::take(&mut self.ending);
        ending.over(LAST_PROCESS_PATIENCE).await;
    }

    async fn start(&mut self, plan: Plan) -> Result<(), Text> {
        // The old session ends first: the new one may need its ports.
        self.end_session();
        let backend = Backend {
            clock: self.clock.clone(),
            vehicles: self.options.vehicles,
            seed: self.attempt.seed,
            speedup: self.options.speedup,
            simulation: self.options.backend.clone(),
            runs: self.options.preferences.runs.clone(),
        };
        let before = std::mem::take(&mut self.ending);
        let (running, started) = Running::start(plan, &backend, before).await?;
        self.running = Some(running);
        // Nothing that `Started` causes is an effect.
        update(&mut self.state, Event::Started(Box::new(started)));
        Ok(())
    }
}

/// Addresses as they were written.
pub(super) fn parse(addresses: &[String]) -> Result<Vec<Address>, Text> {
    let parsed = addresses.iter().map(|address| address.parse());
    let parsed: Result<_, AddressError> = parsed.collect();
    parsed.map_err(|error| Text::from(&error))
}
