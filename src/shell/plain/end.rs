//! The start, the time limits and the result of a flight.

use std::time::Duration;

use super::Plain;
use crate::app::State;
use crate::app::state::{FlightView, Instance};
use crate::ledger::Ledger;
use crate::shell::{ConsoleOptions, Opening};
use crate::text;

/// How long lines from a pipe wait for the vehicles to be heard.
const HEARD_PATIENCE: Duration = Duration::from_secs(30);
/// How long lines from a pipe wait for a crashed or missing process: longer than any delay before a restart. The same
/// limit applies to vehicles that are not ready to arm.
pub(super) const START_PATIENCE: Duration = Duration::from_secs(12);

/// A time limit on a condition.
#[derive(Debug)]
pub(super) struct Patience {
    lasts: Duration,
    since: Option<Duration>,
}

impl Patience {
    pub fn new(lasts: Duration) -> Self {
        Self { lasts, since: None }
    }

    /// Whether the condition has lasted for too long.
    pub fn is_over(&mut self, is_so: bool, now: Duration) -> bool {
        if !is_so {
            self.since = None;
            return false;
        }
        now.saturating_sub(*self.since.get_or_insert(now)) >= self.lasts
    }
}

/// The delay of the first line from a pipe while vehicles are not ready yet, up to a time limit.
#[derive(Debug)]
pub(super) struct Beginning {
    /// The number of vehicles that must be heard; 1 if their number is unknown.
    expected: usize,
    /// The time limit for vehicles that are heard but not ready to arm; `None` once lines are accepted.
    ready: Option<Patience>,
}

impl Beginning {
    /// The wait before the first line; a person's lines need none.
    pub fn of(options: &ConsoleOptions, is_person: bool) -> Self {
        Self {
            expected: expected(options),
            ready: (!is_person).then(|| Patience::new(START_PATIENCE)),
        }
    }

    /// Whether the delay is over: from then on, lines are accepted.
    pub fn is_over(&self) -> bool {
        self.ready.is_none()
    }

    pub fn look(&mut self, state: &State) {
        let Some(patience) = &mut self.ready else {
            return;
        };
        let (session, now) = (state.session(), state.now());
        let all_heard = session.vehicles().len() >= self.expected;
        let waited_for_all = now.saturating_sub(session.began_at()) >= HEARD_PATIENCE;
        let is_there = (all_heard || waited_for_all) && !session.is_starting();
        let waited = patience.is_over(is_there, now);
        if is_there && (waited || is_ready(session)) {
            self.ready = None;
        }
    }
}

fn expected(options: &ConsoleOptions) -> usize {
    match &options.opening {
        Opening::Mission(mission) => mission.seats.count,
        Opening::Free => usize::from(options.vehicles),
        Opening::Home | Opening::Connect(_) | Opening::Replay(_) => 1,
    }
}

/// Whether the vehicles' processes have failed to start.
pub(super) fn cannot_start(state: &State) -> bool {
    let hangar = state.session().hangar();
    hangar
        .filter(|hangar| !hangar.has_begun())
        .is_some_and(|hangar| {
            hangar.fault().is_some() || hangar.instances().iter().any(Instance::has_crashed)
        })
}

/// Whether every vehicle can be armed, or is armed already.
fn is_ready(session: &FlightView) -> bool {
    let mut vehicles = session.vehicles().values();
    vehicles.all(|vehicle| vehicle.ready_to_arm() || vehicle.armed())
}

/// Whether a command failed.
pub(super) fn has_failures(ledger: &Ledger) -> bool {
    let mut rows = ledger.entries().flat_map(|entry| &entry.rows);
    rows.any(|row| row.state.is_failure())
}

/// Whether a mission is about to end, with its verdict, without any further command.
pub(super) fn ends_itself(state: &State) -> bool {
    let mission = state.session().mission();
    mission.is_some_and(|mission| mission.ends_itself)
}

impl Plain {
    /// Ends the session at the end of the input: a mission gets its debrief.
    pub(super) async fn abandon(&mut self) {
        let state = self.console.app.state();
        let is_flown = state.session().mission().is_some() && state.replay().is_none();
        if is_flown {
            self.console.abandon();
            self.console.tick().await;
        } else {
            self.console.over = true;
        }
    }

    /// Ends the flight: with input from a pipe, no user can restart the vehicles.
    pub(super) fn give_up(&mut self) {
        self.tell_news();
        self.say(&text!("hangar-plain-given-up"));
        (self.console.over, self.failed) = (true, true);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patience_ends_after_its_time_and_begins_again_with_every_change() {
        let mut patience = Patience::new(Duration::from_secs(3));
        let steps = [
            (true, 1, false),
            (true, 3, false),
            (false, 4, false),
            (true, 5, false),
            (true, 7, false),
            (true, 8, true),
        ];
        for (is_so, at_s, expected) in steps {
            let is_over = patience.is_over(is_so, Duration::from_secs(at_s));
            assert_eq!(is_over, expected, "{at_s}");
        }
    }
}
