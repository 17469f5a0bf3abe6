//! Carries out what was asked of vehicles: by their autopilots, by the mission, or by several of them together.

use super::Console;
use crate::app::event::VehicleEvent;
use crate::commands::{Act, Deed, Order};
use crate::fleet::Unreachable;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::session::VehicleCommand;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

impl Console {
    /// Carries out an order whose entry is open already.
    pub(super) fn order(&mut self, entry: EntryId, order: &Order) {
        match &order.act {
            Act::Command(command) => {
                let alone = self.assign(entry, order);
                let command = VehicleCommand::new(entry, order.verb, command.clone());
                self.command(alone, &command);
            }
            Act::Manoeuvre(_) => drop(self.assign(entry, order)),
            Act::Deed(deed) => self.deed(entry, &order.targets, deed),
        }
    }

    /// Tells those who do something together; returns the vehicles that carry the order out alone.
    fn assign(&mut self, entry: EntryId, order: &Order) -> Vec<VehicleId> {
        let (now, shown) = (self.clock.now(), &self.app.state().session);
        let Some(running) = &mut self.running else {
            return order.targets.clone();
        };
        let assignment = running.settle(entry, order, &shown.vehicles, now);
        self.post_rows(assignment.rows);
        assignment.alone
    }

    /// Gives a command to each vehicle. One that cannot be given ends its row and holds up no other.
    fn command(&mut self, vehicles: Vec<VehicleId>, command: &VehicleCommand) {
        for vehicle in vehicles {
            let given = match &self.running {
                Some(running) => running.order(vehicle, command.clone()),
                None => Err(Unreachable),
            };
            if let Err(error) = given {
                let now = self.clock.now();
                let row = command.unsent(
                    vehicle,
                    RowState::Refused,
                    text!("outcome-not-sent", reason = Text::from(error)),
                    now,
                );
                self.post(VehicleEvent::Row(row));
            }
        }
    }

    /// Has the mission do something with each target.
    fn deed(&mut self, entry: EntryId, targets: &[VehicleId], deed: &Deed) {
        let now = self.clock.now();
        let rows = match &mut self.running {
            Some(running) => running.act(entry, deed, targets, now),
            None => Vec::new(),
        };
        let refused = rows.iter().find(|row| row.state == RowState::Refused);
        let refused = refused.and_then(|row| row.explanation.clone());
        self.post_rows(rows);
        // No vehicle says why, and not every room shows the commands.
        let given = self.app.state().session.ledger.entry(entry);
        if let (Some(reason), Some(given)) = (refused, given) {
            let notice = Notice {
                at: now,
                vehicle: None,
                severity: Severity::Warning,
                kind: None,
                text: Text::joined(": ", vec![given.line.as_str().into(), reason]),
            };
            self.post(notice);
        }
    }

    fn post_rows(&mut self, rows: Vec<RowUpdate>) {
        for row in rows {
            self.post(VehicleEvent::Row(row));
        }
    }
}
