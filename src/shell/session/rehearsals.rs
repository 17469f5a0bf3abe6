//! Rehearsals of plans, which run in the background.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio::task::spawn_blocking;

use crate::app::event::{Event, VehicleEvent};
use crate::operator::{PlanRehearsal, Rehearsed};
use crate::parameters::ParameterSnapshot;
use crate::rehearsal::Heard;
use crate::shell::last_rehearsal::recorded;
use crate::sim::Airframe;
use crate::store::Records;
use crate::vehicle::VehicleId;

/// Starts rehearsals, and collects their results.
#[derive(Debug)]
pub(super) struct Rehearsals {
    sender: mpsc::UnboundedSender<Rehearsed>,
    results: mpsc::UnboundedReceiver<Rehearsed>,
    /// Where the last rehearsal is recorded; `None` if flights are not recorded.
    records: Option<Records>,
}

impl Rehearsals {
    pub fn new(records: Option<Records>) -> Self {
        let (sender, results) = mpsc::unbounded_channel();
        Self {
            sender,
            results,
            records,
        }
    }

    /// Begins a rehearsal, with the parameters that have been read and the airframes of the simulated vehicles.
    pub fn begin(
        &self,
        mut rehearsal: PlanRehearsal,
        parameters: &[(VehicleId, watch::Receiver<ParameterSnapshot>)],
        airframes: &[Arc<Airframe>],
    ) {
        rehearsal.set_airframes(airframes);
        for (vehicle, list) in parameters {
            rehearsal.set_parameters(*vehicle, &list.borrow().list);
        }
        let sender = self.sender.clone();
        let records = self.records.clone();
        spawn_blocking(move || {
            let fly =
                |listener: &mut dyn FnMut(Heard<'_>)| rehearsal.fly_heard(Duration::ZERO, listener);
            let (mut rehearsed, notice) = recorded(records.as_ref(), &rehearsal.vehicles(), fly);
            rehearsed.notices.extend(notice);
            // The session may be over by then.
            let _ = sender.send(rehearsed);
        });
    }

    /// Takes no results of the rehearsals under way: the flight has gone back to before them.
    pub fn drop_late(&mut self) {
        (self.sender, self.results) = mpsc::unbounded_channel();
    }

    /// The rows and notices of the rehearsals that are over.
    pub fn take(&mut self, now: Duration) -> Vec<Event> {
        let mut events = Vec::new();
        while let Ok(rehearsed) = self.results.try_recv() {
            let rehearsed = rehearsed.at(now);
            let rows = rehearsed.rows.into_iter();
            events.extend(rows.map(|row| Event::from(VehicleEvent::Row(row))));
            events.extend(rehearsed.notices.into_iter().map(Event::Notice));
            events.push(VehicleEvent::Rehearsed(rehearsed.findings).into());
        }
        events
    }
}
