//! Orders of a session: to its vehicles, to its mission, and for joint manoeuvres.

use std::time::Duration;

use super::RunningSession;
use super::mission_run::MissionRun;
use crate::app::event::{Event, VehicleEvent};
use crate::app::state::FlightView;
use crate::commands::Order;
use crate::ledger::{EntryId, RowState};
use crate::notice::Notice;
use crate::operator::{Dispatch, OperatorScene};
use crate::session::VehicleCommand;
use crate::shell::orders::not_sent;
use crate::swarm::ConductorScene;
use crate::vehicle::{Severity, VehicleId};

impl RunningSession {
    /// Carries out an order that already has a ledger entry; returns its immediate events.
    pub fn carry_out(
        &mut self,
        entry: EntryId,
        order: &Order,
        shown: &FlightView,
        now: Duration,
    ) -> Vec<Event> {
        let scene = OperatorScene {
            now: self.vehicle_time.at(now),
            vehicles: shown.vehicles(),
            pilots: shown.pilots(),
            flight: self.mission_run.as_mut().map(MissionRun::flight_mut),
        };
        let mut work = self.operator.carry_out(entry, order, scene);
        if order.by.is_some() {
            // Another person learns it from the rows of the ledger.
            work.retain(|it| !matches!(it, Dispatch::Refused(_)));
        }
        self.dispatch(work, now)
    }

    /// Advances joint manoeuvres; returns their events.
    pub fn conduct(&mut self, now: Duration, shown: &FlightView) -> Vec<Event> {
        let work = self.operator.conduct(ConductorScene {
            now: self.vehicle_time.at(now),
            vehicles: shown.vehicles(),
            pilots: shown.pilots(),
        });
        let mut events = self.dispatch(work, now);
        let paths = self.operator.paths();
        if paths != self.paths {
            self.paths.clone_from(&paths);
            events.push(VehicleEvent::Paths(paths).into());
        }
        events
    }

    /// Carries out the operator's dispatches, with times converted to the program's clock; returns
    /// the resulting events.
    fn dispatch(&mut self, work: Vec<Dispatch>, now: Duration) -> Vec<Event> {
        let events = work.into_iter().filter_map(|work| match work.at(now) {
            Dispatch::Row(row) => Some(VehicleEvent::Row(row).into()),
            Dispatch::Command(vehicle, command) => self.command(vehicle, &command, now),
            Dispatch::Steer(vehicle, steering) => {
                let is_delivered = self.fleet.steer(vehicle, steering).is_ok();
                self.operator.note_delivery(vehicle, steering, is_delivered);
                None
            }
            Dispatch::Notice(notice) => Some(Event::Notice(notice)),
            Dispatch::Rehearse(rehearsal) => {
                self.rehearsals
                    .begin(rehearsal, &self.parameters, &self.airframes);
                None
            }
            // Not every room shows the ledger.
            Dispatch::Refused(text) => {
                Some(Event::Notice(Notice::general(now, Severity::Warning, text)))
            }
        });
        events.collect()
    }

    /// Sends a command to one vehicle. A failure ends only that vehicle's row.
    fn command(
        &mut self,
        vehicle: VehicleId,
        command: &VehicleCommand,
        now: Duration,
    ) -> Option<Event> {
        let error = self.fleet.order(vehicle, command.clone()).err()?;
        let row = command.unsent(vehicle, RowState::Refused, not_sent(error), now);
        self.operator.note_row(&row);
        Some(VehicleEvent::Row(row).into())
    }
}
