//! A vehicle of a recording, with its state for display.

use std::sync::Arc;
use std::time::Duration;

use super::LINK;
use crate::app::event::{Event, VehicleEvent};
use crate::parameters::Fetching;
use crate::session::{Report, Session};
use crate::vehicle::Vehicle;
use crate::wire::SystemId;

/// A vehicle in the replay.
#[derive(Debug, Clone)]
pub(super) struct Actor {
    pub session: Session,
    shown: Arc<Vehicle>,
    /// The last reported state of its parameters.
    parameters: (u64, Fetching),
}

impl Actor {
    pub fn new(system: SystemId, component: u8, now: Duration) -> Self {
        let mut session = Session::new(system, component, now).following_plans();
        session.heard_via(LINK, now);
        Self {
            session,
            shown: Arc::new(Vehicle::new(system, component)),
            parameters: (0, Fetching::NotAsked),
        }
    }

    /// The events since the last call.
    pub fn tell(&mut self) -> Vec<Event> {
        drop(self.session.take_outgoing());
        let reports = self.session.take_reports().into_iter();
        let mut events: Vec<Event> = reports
            .filter_map(|report| match report {
                Report::Notice(notice) => Some(notice.into()),
                // A replay gives no commands.
                Report::Row(_) | Report::Folder(_) => None,
            })
            .collect();
        if *self.shown != *self.session.vehicle() {
            self.shown = Arc::new(self.session.vehicle().clone());
            events.push(VehicleEvent::Telemetry(Arc::clone(&self.shown)).into());
        }
        let snapshot = self.session.parameters();
        let state = (snapshot.list.revision(), snapshot.fetching);
        if state != self.parameters {
            self.parameters = state;
            let vehicle = self.shown.id;
            events.push(VehicleEvent::Parameters { vehicle, snapshot }.into());
        }
        events
    }
}
