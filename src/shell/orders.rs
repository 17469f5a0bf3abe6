//! Carries out orders to vehicles.

use std::time::Duration;

use super::Console;
use crate::app::event::{Event, VehicleEvent};
use crate::commands::Order;
use crate::fleet::Unreachable;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::record::{EntryLine, Happening};
use crate::text;
use crate::text::Text;

impl Console {
    /// Carries out an order that already has an entry, and queues the resulting events.
    pub(super) fn order(&mut self, entry: EntryId, order: &Order) {
        let now = self.clock.now();
        self.note_order(entry, order, now);
        let shown = self.app.state().session();
        let events: Vec<Event> = match &mut self.running {
            Some(running) => running.carry_out(entry, order, shown, now),
            None => order
                .targets
                .iter()
                .map(|&vehicle| {
                    let row = RowUpdate {
                        entry,
                        vehicle,
                        state: RowState::Refused,
                        tries: 0,
                        at: now,
                        explanation: Some(not_sent(Unreachable)),
                    };
                    VehicleEvent::Row(row).into()
                })
                .collect(),
        };
        for event in events {
            self.post(event);
        }
    }

    fn note_order(&self, entry: EntryId, order: &Order, now: Duration) {
        if let Some(running) = &self.running {
            running.note_down(now, Happening::Entry(EntryLine::of(entry, order)));
        }
    }
}

/// The explanation for a row whose order could not be sent.
pub(super) fn not_sent(error: Unreachable) -> Text {
    text!("outcome-not-sent", reason = Text::from(error))
}
