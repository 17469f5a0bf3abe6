//! From a line of the pilot to the vehicles, and back into the ledger.

use std::time::Duration;

use super::{Exercise, session, since};
use crate::commands::{Act, Order};
use crate::language::{self, Context, Statement};
use crate::ledger::RowUpdate;
use crate::notice::Notice;
use crate::session::VehicleCommand;
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
            .and_then(|meant| meant.into_order(&all, &context));
        match understood {
            Ok(order) => self.order(&order, now),
            Err(text) => self.notices.push(Notice {
                at: now.saturating_sub(self.prelude),
                vehicle: None,
                severity: Severity::Error,
                kind: None,
                text: Text::joined(": ", vec![format!("`{}`", statement.line).into(), text]),
            }),
        }
    }

    fn order(&mut self, order: &Order, now: Duration) {
        let entry = self.ledger.open(now, order.given(), &order.targets);
        let assignment = self.conductor.take(entry, order, &self.vehicles, now);
        for row in &assignment.rows {
            self.ledger.apply(row);
        }
        match &order.act {
            Act::Command(command) => {
                for &id in &assignment.alone {
                    if let Some(session) = session(&mut self.seats, id) {
                        let command = VehicleCommand::new(entry, order.verb, command.clone());
                        session.order(command, now);
                    }
                }
            }
            Act::Deed(deed) => {
                for row in self.driver.flight_mut().act(entry, deed, &order.targets) {
                    self.ledger.apply(&RowUpdate { at: now, ..row });
                }
            }
            Act::Manoeuvre(_) => {}
        }
    }
}
