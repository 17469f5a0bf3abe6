//! Carries out what was asked of vehicles: by their autopilots, by the mission, or by several of them together.

use super::Console;
use crate::app::event::VehicleEvent;
use crate::commands::{Deed, Manoeuvre};
use crate::fleet::Unreachable;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::session::Order;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

impl Console {
    /// Gives an order to each target. One that cannot be given ends its row and holds up no other.
    pub(super) fn command(&mut self, targets: &[VehicleId], order: &Order) {
        let (now, shown) = (self.clock.now(), &self.app.state().session);
        let (targets, rows) = match &mut self.running {
            Some(running) => running.settle(targets, order, &shown.vehicles, now),
            None => (targets.to_vec(), Vec::new()),
        };
        self.post_rows(rows);
        for vehicle in targets {
            let given = match &self.running {
                Some(running) => running.order(vehicle, order.clone()),
                None => Err(Unreachable),
            };
            if let Err(error) = given {
                let now = self.clock.now();
                let row = order.unsent(
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
    pub(super) fn deed(&mut self, entry: EntryId, targets: &[VehicleId], deed: &Deed) {
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

    /// Has the targets do something together.
    pub(super) fn begin_manoeuvre(
        &mut self,
        entry: EntryId,
        manoeuvre: &Manoeuvre,
        targets: &[VehicleId],
    ) {
        let (now, shown) = (self.clock.now(), &self.app.state().session);
        let rows = match &mut self.running {
            Some(running) => {
                running.begin_manoeuvre((entry, manoeuvre), targets, &shown.vehicles, now)
            }
            None => Vec::new(),
        };
        self.post_rows(rows);
    }

    fn post_rows(&mut self, rows: Vec<RowUpdate>) {
        for row in rows {
            self.post(VehicleEvent::Row(row));
        }
    }
}
