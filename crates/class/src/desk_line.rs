//! What a desk has said on one connection.

use std::collections::BTreeMap;
use std::time::Duration;

use super::protocol::{DeskMessage, VERSION};
use super::{ConnectionId, Desk, Order, OrderState, SeatRecord};

/// How long the desk waits for entries or the outcome of an order before it asks again.
const ASK_AGAIN: Duration = Duration::from_secs(2);

/// How often a desk says something at least.
const SAY_EVERY: Duration = Duration::from_secs(2);
/// How long the desk waits for a whole picture before it asks for one again.
const WATCH_AGAIN: Duration = Duration::from_millis(500);

/// A desk's half of one connection. A new connection needs a new one.
#[derive(Debug, Clone, Default)]
pub struct DeskLine {
    has_greeted: bool,
    /// When the last line was said.
    said_at: Duration,
    asked: Option<Asked>,
    /// When the seat was asked for its screen, while the desk watches it.
    watched: Option<Duration>,
    /// When each order without an outcome was sent, by its number.
    ordered: BTreeMap<u32, Duration>,
}

#[derive(Debug, Clone, Copy)]
struct Asked {
    at: Duration,
    /// The number of the newest entry that the desk had then.
    had: u64,
}

impl DeskLine {
    /// The next line, if there is something to say now.
    pub fn next(
        &mut self,
        desk: &Desk,
        connection: ConnectionId,
        now: Duration,
    ) -> Option<DeskMessage> {
        let message = self.due(desk, connection, now);
        if message.is_some() {
            self.said_at = now;
        }
        message
    }

    fn due(&mut self, desk: &Desk, connection: ConnectionId, now: Duration) -> Option<DeskMessage> {
        let seat = desk.seat_of(connection)?;
        if !self.has_greeted {
            self.has_greeted = true;
            return Some(DeskMessage::Welcome {
                protocol: VERSION,
                class: desk.class().clone(),
            });
        }
        if self.has_to_ask(seat, now) {
            return Some(DeskMessage::Ask {
                from: seat.journal.next_number(),
            });
        }
        if let Some(on) = self.has_to_watch(desk, connection, now) {
            return Some(DeskMessage::Watch { on });
        }
        let order = self.next_order(seat, now).map(DeskMessage::Order);
        order.or_else(|| (now >= self.said_at + SAY_EVERY).then_some(DeskMessage::Here))
    }

    /// Whether the seat has to begin, to begin again or to end sending its screen.
    fn has_to_watch(
        &mut self,
        desk: &Desk,
        connection: ConnectionId,
        now: Duration,
    ) -> Option<bool> {
        let wanted = desk
            .watched()
            .filter(|&it| desk.index_of(connection) == Some(it));
        let Some(seat) = wanted.and_then(|index| desk.seats().get(index)) else {
            return self.watched.take().map(|_| false);
        };
        let is_due = match self.watched {
            None => true,
            Some(at) => seat.screen.is_lost() && now.saturating_sub(at) >= WATCH_AGAIN,
        };
        is_due.then(|| {
            self.watched = Some(now);
            true
        })
    }

    /// An order without an outcome that was not sent, or not lately.
    fn next_order(&mut self, seat: &SeatRecord, now: Duration) -> Option<Order> {
        let waiting = || {
            let orders = seat.orders().map(|it| (&it.order, it.state));
            let waiting = orders.filter(|(_, state)| *state == OrderState::Waiting);
            waiting.map(|(order, _)| order)
        };
        self.ordered
            .retain(|number, _| waiting().any(|order| order.id.number == *number));
        let is_due = |order: &&Order| {
            let sent = self.ordered.get(&order.id.number);
            sent.is_none_or(|at| now.saturating_sub(*at) >= ASK_AGAIN)
        };
        let order = waiting().find(is_due)?.clone();
        self.ordered.insert(order.id.number, now);
        Some(order)
    }

    /// Whether entries have to be asked for: at first, and when the seat has more of them and none has come for a
    /// while.
    fn has_to_ask(&mut self, seat: &SeatRecord, now: Duration) -> bool {
        let had = seat.journal.last();
        let is_due = match &self.asked {
            None => true,
            Some(_) if seat.announced <= had => false,
            Some(asked) if asked.had < had => {
                // Entries are coming.
                self.asked = Some(Asked { at: now, had });
                false
            }
            Some(asked) => now.saturating_sub(asked.at) >= ASK_AGAIN,
        };
        if is_due {
            self.asked = Some(Asked { at: now, had });
        }
        is_due
    }
}
