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

impl Console {
    /// Ends the session. What takes a while to end is waited for by who has to.
    pub(super) fn end_session(&mut self) {
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

    pub(super) async fn start(&mut self, plan: Plan) -> Result<(), Text> {
        // The old session ends first: the new one may need its ports.
        self.end_session();
        let backend = Backend {
            clock: self.clock,
            vehicles: self.options.vehicles,
            seed: self.options.seed,
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
