//! From a line of the pilot to the vehicles, and back into the ledger.

use std::time::Duration;

use super::{Exercise, session, since};
use crate::commands::{Command, Manoeuvre};
use crate::language::{self, Action, Context, Statement, Verb};
use crate::ledger::{EntryId, Given, Risk, RowUpdate};
use crate::notice::Notice;
use crate::session::Order;
use crate::swarm::{Call, Ordered};
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

impl<L> Exercise<L> {
    /// Leads those who do something together.
    pub(super) fn conduct(&mut self, now: Duration) {
        let turn = self.conductor.step(now, &self.vehicles);
        for row in &turn.rows {
            self.ledger.apply(row);
        }
        for (id, steering) in &turn.steering {
            if let Some(session) = session(&mut self.seats, *id) {
                // What cannot be flown to is not said again: it shows in what the vehicle does not do.
                let _ = session.steer(steering, now);
            }
        }
        let notices = turn.notices.into_iter();
        let prelude = self.prelude;
        self.notices
            .extend(notices.map(|notice| since(prelude, notice)));
    }

    /// Carries out a line as it is meant now: places may have come up or moved since the script was read.
    pub(super) fn carry_out(&mut self, statement: &Statement, now: Duration) {
        let all: Vec<VehicleId> = self.vehicles.keys().copied().collect();
        let mut places = self.driver.flight_mut().places();
        places.extend(self.places.clone());
        let context = Context {
            places: Some(&places),
            areas: Some(&self.areas),
            vehicles: &all,
            ..Context::default()
        };
        let understood = language::parse(&statement.line, &context)
            .map_err(|fault| fault.message)
            .and_then(|meant| Ok((meant.targets.resolve(&all, &context)?, meant.action)));
        let (targets, action) = match understood {
            Ok(understood) => understood,
            Err(text) => {
                self.notices.push(Notice {
                    at: now.saturating_sub(self.prelude),
                    vehicle: None,
                    severity: Severity::Error,
                    kind: None,
                    text: Text::joined(": ", vec![format!("`{}`", statement.line).into(), text]),
                });
                return;
            }
        };
        let line = &statement.line;
        match action {
            Action::Command { verb, command } => {
                let entry = self.open(line, (verb.name, command.risk()), &targets, now);
                self.order(entry, (verb, &command), &targets, now);
            }
            Action::Deed { verb, deed } => {
                let entry = self.open(line, (verb.name, Risk::None), &targets, now);
                for row in self.driver.flight_mut().act(entry, &deed, &targets) {
                    self.ledger.apply(&RowUpdate { at: now, ..row });
                }
            }
            Action::Manoeuvre { manoeuvre, .. } => {
                let given = (manoeuvre.name(), Risk::None);
                let entry = self.open(line, given, &targets, now);
                self.begin_manoeuvre(entry, &manoeuvre, &targets, now);
            }
            Action::Wait(_) => {}
        }
    }

    fn order(
        &mut self,
        entry: EntryId,
        (verb, command): (&'static Verb, &Command),
        targets: &[VehicleId],
        now: Duration,
    ) {
        let ordered = Ordered {
            entry,
            verb: verb.name,
            command,
            targets,
        };
        let (targets, rows) = self.conductor.order(ordered, &self.vehicles, now);
        for row in &rows {
            self.ledger.apply(row);
        }
        for seat in &mut self.seats {
            if targets.contains(&seat.session.vehicle().id) {
                let order = Order::new(entry, verb, command.clone());
                seat.session.order(order, now);
            }
        }
    }

    fn begin_manoeuvre(
        &mut self,
        entry: EntryId,
        manoeuvre: &Manoeuvre,
        targets: &[VehicleId],
        now: Duration,
    ) {
        let call = Call {
            entry,
            manoeuvre,
            targets,
        };
        let rows = self.conductor.begin(call, &self.vehicles, now);
        for row in &rows {
            self.ledger.apply(row);
        }
    }

    fn open(
        &mut self,
        line: &str,
        (verb, risk): (&str, Risk),
        targets: &[VehicleId],
        now: Duration,
    ) -> EntryId {
        self.ledger.open(now, Given { line, verb, risk }, targets)
    }
}
