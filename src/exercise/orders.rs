//! Carries out the pilot's lines, and enters the results in the ledger.

use std::time::Duration;

use super::{Exercise, session, since};
use crate::commands::Order;
use crate::diagnostic::Diagnostic;
use crate::language::{Context, Statement};
use crate::notice::Notice;
use crate::operator::{self, Dispatch, OperatorScene};
use crate::pilot_in_command::PilotsInCommand;
use crate::record::{EntryLine, Happening, PathLine};
use crate::swarm::ConductorScene;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

impl<L> Exercise<L> {
    pub(super) fn conduct(&mut self, now: Duration) {
        let work = self.operator.conduct(ConductorScene {
            now,
            vehicles: &self.vehicles,
            pilots: &PilotsInCommand::default(),
        });
        for work in work {
            self.dispatch(work, now);
        }
        // Paths are only needed for the record.
        let paths = self.log.as_ref().map(|_| self.operator.paths());
        if let Some(paths) = paths.filter(|paths| *paths != self.paths) {
            self.note_down(now, || Happening::Paths(PathLine::all(&paths)));
            self.paths = paths;
        }
    }

    /// Carries out a line of the script.
    pub(super) fn carry_out(&mut self, statement: &Statement, now: Duration) {
        let line = &statement.line;
        match self.read(line) {
            Ok(order) => self.order(&order, now),
            Err(fault) => {
                let at = now.saturating_sub(self.prelude);
                let text = Text::joined(": ", vec![format!("`{line}`").into(), fault.message]);
                self.tell(Notice::general(at, Severity::Error, text), now);
            }
        }
    }

    /// Parses a line with the current places, which may have changed since the script was read.
    fn read(&self, line: &str) -> Result<Order, Diagnostic> {
        let all: Vec<VehicleId> = self.vehicles.keys().copied().collect();
        let mut places = self.driver.flight().places();
        places.extend(self.places.clone());
        let context = Context {
            places: Some(&places),
            areas: Some(&self.areas),
            vehicles: &all,
            ..Context::default()
        };
        operator::read_order(line, &context, &all)
    }

    fn order(&mut self, order: &Order, now: Duration) {
        let entry = self.ledger.open(now, order.given(), &order.targets);
        self.note_down(now, || Happening::Entry(EntryLine::of(entry, order)));
        let scene = OperatorScene {
            now,
            vehicles: &self.vehicles,
            flight: Some(self.driver.flight_mut()),
            pilots: &PilotsInCommand::default(),
        };
        for work in self.operator.carry_out(entry, order, scene) {
            self.dispatch(work, now);
        }
    }

    fn dispatch(&mut self, work: Dispatch, now: Duration) {
        match work {
            Dispatch::Row(row) => self.advance_row(&row, now),
            Dispatch::Command(vehicle, command) => {
                if let Some(session) = session(&mut self.seats, vehicle) {
                    session.order(command, now);
                }
            }
            Dispatch::Steer(vehicle, steering) => {
                if let Some(session) = session(&mut self.seats, vehicle) {
                    // An impossible setpoint is not reported again: it shows in the vehicle's behaviour.
                    let _ = session.steer(&steering, now);
                }
            }
            Dispatch::Notice(notice) => self.tell(since(self.prelude, notice), now),
            Dispatch::Rehearse(mut rehearsal) => {
                for vehicle in rehearsal.vehicles() {
                    if let Some(session) = session(&mut self.seats, vehicle) {
                        rehearsal.set_parameters(vehicle, &session.parameters().list);
                    }
                }
                let rehearsed = rehearsal.fly(now);
                for row in &rehearsed.rows {
                    self.advance_row(row, now);
                }
                for notice in rehearsed.notices {
                    self.tell(since(self.prelude, notice), now);
                }
            }
            // The report's ledger contains the reason.
            Dispatch::Refused(_) => {}
        }
    }
}
