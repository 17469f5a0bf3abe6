//! What vehicles of the session do together.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Running;
use crate::app::event::{Event, VehicleEvent};
use crate::commands::Order;
use crate::ledger::{EntryId, RowUpdate};
use crate::notice::Notice;
use crate::session::Steering;
use crate::swarm::{Assignment, Conductor, Path, Rules, Vehicles};
use crate::vehicle::VehicleId;

/// The conductor of a session, and what of it is shown.
#[derive(Debug, Default)]
pub(super) struct Swarm {
    conductor: Conductor,
    /// What was shown of it last.
    paths: Vec<Path>,
    /// How many seconds the vehicles live per second of ours.
    speedup: f64,
    /// What a fleet that could not keep up has not been told yet: a stop is said only once.
    untold: BTreeMap<VehicleId, Steering>,
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

    /// Tells vehicles where they are to be; who could not be told is told the next time, unless there is news for it.
    fn steer(
        &mut self,
        steering: Vec<(VehicleId, Steering)>,
        tell: impl Fn(VehicleId, Steering) -> bool,
    ) {
        self.untold.extend(steering);
        self.untold
            .retain(|&vehicle, steering| !tell(vehicle, *steering));
    }

    /// Vehicles get something else to do: where they were to be does not matter any more.
    fn forget(&mut self, vehicles: &[VehicleId]) {
        self.untold.retain(|vehicle, _| !vehicles.contains(vehicle));
    }
}

impl Running {
    /// Finds out which targets of an order carry it out alone: a movement may be one of a whole formation, and else
    /// takes its vehicles out of what they were doing.
    pub fn settle(
        &mut self,
        entry: EntryId,
        order: &Order,
        vehicles: &Vehicles,
        now: Duration,
    ) -> Assignment {
        self.swarm.forget(&order.targets);
        let time = self.swarm.time(now);
        let assignment = self.swarm.conductor.take(entry, order, vehicles, time);
        Assignment {
            rows: at(now, assignment.rows),
            ..assignment
        }
    }

    /// Leads those who do something together, and returns what came of it.
    pub fn conduct(&mut self, now: Duration, vehicles: &Vehicles) -> Vec<Event> {
        let time = self.swarm.time(now);
        let turn = self.swarm.conductor.step(time, vehicles);
        let fleet = &self.fleet;
        self.swarm.steer(turn.steering, |vehicle, steering| {
            fleet.steer(vehicle, steering).is_ok()
        });
        let rows = at(now, turn.rows).into_iter().map(VehicleEvent::Row);
        let mut events: Vec<Event> = rows.map(Event::from).collect();
        let notices = turn.notices.into_iter();
        events.extend(notices.map(|notice| Event::Notice(Notice { at: now, ..notice })));
        let paths = self.swarm.conductor.paths();
        if paths != self.swarm.paths {
            self.swarm.paths.clone_from(&paths);
            events.push(VehicleEvent::Paths(paths).into());
        }
        events
    }
}

/// The same on the program's clock.
fn at(now: Duration, rows: Vec<RowUpdate>) -> Vec<RowUpdate> {
    let rows = rows.into_iter();
    rows.map(|row| RowUpdate { at: now, ..row }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::Setpoint;
    use crate::geo::LatLon;
    use crate::language::verb;

    fn at_height(altitude_m: f64) -> Steering {
        Steering {
            verb: verb("formation").expect("it is in the table"),
            setpoint: Setpoint {
                at_point: LatLon::new(50.0, 30.0),
                altitude_m,
                velocity_m_s: None,
            },
        }
    }

    /// What is told if the fleet can be told of these vehicles only.
    fn told(swarm: &mut Swarm, news: &[(VehicleId, f64)], able: &[VehicleId]) -> Vec<(u16, f64)> {
        let said = std::cell::RefCell::default();
        let news = news.iter().map(|&(id, height)| (id, at_height(height)));
        swarm.steer(news.collect(), |vehicle, steering| {
            let is_able = able.contains(&vehicle);
            let mut said = said.borrow_mut();
            let said: &mut Vec<(u16, f64)> = &mut said;
            said.extend(is_able.then_some((vehicle, steering.setpoint.altitude_m)));
            is_able
        });
        said.into_inner()
    }

    #[test]
    fn a_stop_that_could_not_be_told_is_told_later_unless_it_has_become_void() {
        let mut swarm = Swarm::default();
        let stops = [(1, 10.0), (2, 20.0), (3, 30.0), (4, 40.0)];
        assert_eq!(told(&mut swarm, &stops, &[1]), [(1, 10.0)]);
        // Vehicle 2 has got other orders meanwhile, vehicle 3 is to be elsewhere.
        swarm.forget(&[2]);
        let all = [1, 2, 3, 4];
        assert_eq!(told(&mut swarm, &[(3, 31.0)], &all), [(3, 31.0), (4, 40.0)]);
        assert!(told(&mut swarm, &[], &all).is_empty());
    }
}
