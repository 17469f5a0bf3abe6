//! What vehicles of the session do together.

use std::time::Duration;

use super::Running;
use crate::app::event::Event;
use crate::commands::Manoeuvre;
use crate::ledger::{EntryId, RowUpdate};
use crate::notice::Notice;
use crate::session::Order;
use crate::swarm::{Call, Conductor, Ordered, Path, Rules, Vehicles};
use crate::vehicle::VehicleId;

/// The conductor of a session, and what of it is shown.
#[derive(Debug, Default)]
pub(super) struct Swarm {
    conductor: Conductor,
    /// What was shown of it last.
    paths: Vec<Path>,
    /// How many seconds the vehicles live per second of ours.
    speedup: f64,
}

impl Swarm {
    pub fn new(rules: Rules, speedup: f64) -> Self {
        Self {
            conductor: Conductor::new(rules),
            speedup,
            ..Self::default()
        }
    }

    /// The vehicles' time, by which they move.
    fn time(&self, now: Duration) -> Duration {
        now.mul_f64(self.speedup)
    }
}

impl Running {
    /// Has vehicles do something together; returns how that begins.
    pub fn begin_manoeuvre(
        &mut self,
        (entry, manoeuvre): (EntryId, &Manoeuvre),
        targets: &[VehicleId],
        vehicles: &Vehicles,
        now: Duration,
    ) -> Vec<RowUpdate> {
        let call = Call {
            entry,
            manoeuvre,
            targets,
        };
        let time = self.swarm.time(now);
        at(now, self.swarm.conductor.begin(call, vehicles, time))
    }

    /// Finds out to which of its targets a command is to be sent: a movement may be one of a whole formation, and else
    /// takes its vehicles out of what they were doing.
    pub fn settle(
        &mut self,
        targets: &[VehicleId],
        order: &Order,
        vehicles: &Vehicles,
        now: Duration,
    ) -> (Vec<VehicleId>, Vec<RowUpdate>) {
        let ordered = Ordered {
            entry: order.entry,
            verb: order.verb,
            command: &order.command,
            targets,
        };
        let time = self.swarm.time(now);
        let (left, rows) = self.swarm.conductor.order(ordered, vehicles, time);
        (left, at(now, rows))
    }

    /// Leads those who do something together, and returns what came of it.
    pub fn conduct(&mut self, now: Duration, vehicles: &Vehicles) -> Vec<Event> {
        let time = self.swarm.time(now);
        let turn = self.swarm.conductor.step(time, vehicles);
        for (vehicle, steering) in turn.steering {
            // A fleet that cannot keep up hears the next one.
            let _ = self.fleet.steer(vehicle, steering);
        }
        let mut events: Vec<Event> = at(now, turn.rows).into_iter().map(Event::Row).collect();
        let notices = turn.notices.into_iter();
        events.extend(notices.map(|notice| Event::Notice(Notice { at: now, ..notice })));
        let paths = self.swarm.conductor.paths();
        if paths != self.swarm.paths {
            self.swarm.paths.clone_from(&paths);
            events.push(Event::Paths(paths));
        }
        events
    }
}

/// The same on the program's clock.
fn at(now: Duration, rows: Vec<RowUpdate>) -> Vec<RowUpdate> {
    let rows = rows.into_iter();
    rows.map(|row| RowUpdate { at: now, ..row }).collect()
}
