//! What a desk has said on one connection.

use std::collections::BTreeMap;
use std::time::Duration;

use super::protocol::{DeskMessage, VERSION};
use super::watch::{Picture, PictureSender};
use super::watching::WatchedParts;
use super::{ConnectionId, Desk, Order, OrderState, SeatRecord};

/// How long the desk waits for entries or the outcome of an order before it asks again.
const ASK_AGAIN: Duration = Duration::from_secs(2);

/// How often a desk says something at least.
const SAY_EVERY: Duration = Duration::from_secs(2);
/// How long the desk waits for a whole picture before it asks for one again.
const WATCH_AGAIN: Duration = Duration::from_millis(500);
/// How long the desk waits before it tells a seat again that nothing is shown any more.
const HIDE_AGAIN: Duration = Duration::from_secs(1);

/// A desk's half of one connection. A new connection needs a new one.
#[derive(Debug, Clone, Default)]
pub struct DeskLine {
    has_greeted: bool,
    /// When the last line was said.
    said_at: Duration,
    asked: Option<Asked>,
    /// What the seat was asked for while it is watched, and when.
    watched: Option<AskedParts>,
    /// What the seat has seen of what the desk shows to the class.
    shown: Option<PictureSender>,
    /// When the seat was last told that nothing is shown any more.
    hidden_at: Option<Duration>,
    /// When each order without an outcome was sent, by its number.
    ordered: BTreeMap<u32, Duration>,
}

#[derive(Debug, Clone, Copy)]
struct AskedParts {
    at: Duration,
    parts: WatchedParts,
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
                name: seat.name.as_str().into(),
                instructor: desk.instructor().clone(),
            });
        }
        if self.has_to_ask(seat, now) {
            return Some(DeskMessage::Ask {
                from: seat.journal.next_number(),
            });
        }
        if let Some(WatchedParts { screen, insight }) = self.has_to_watch(desk, connection, now) {
            return Some(DeskMessage::Watch {
                on: screen,
                insight,
            });
        }
        let order = self.next_order(seat, now).map(DeskMessage::Order);
        order.or_else(|| (now >= self.said_at + SAY_EVERY).then_some(DeskMessage::Here))
    }

    /// What the seat has to begin, to begin again or to end sending of its screen and what is behind it.
    fn has_to_watch(
        &mut self,
        desk: &Desk,
        connection: ConnectionId,
        now: Duration,
    ) -> Option<WatchedParts> {
        let index = desk.index_of(connection)?;
        let parts = desk.watching().parts_of(index);
        let is_due = match self.watched {
            None => parts.is_any(),
            Some(asked) if asked.parts != parts => true,
            Some(asked) => {
                let is_lost = parts.screen && desk.seats()[index].screen.is_lost();
                is_lost && now.saturating_sub(asked.at) >= WATCH_AGAIN
            }
        };
        if !is_due {
            return None;
        }
        self.watched = parts.is_any().then_some(AskedParts { at: now, parts });
        Some(parts)
    }

    /// The next line about what the desk shows to the class, after everything else. The picture is taken only when one
    /// is due.
    pub fn next_shown(
        &mut self,
        desk: &Desk,
        connection: ConnectionId,
        picture: impl FnOnce() -> Option<Picture>,
        now: Duration,
    ) -> Option<DeskMessage> {
        let looks_on = desk.seat_of(connection).is_some_and(SeatRecord::looks_on);
        if !looks_on {
            self.shown = None;
            return None;
        }
        if desk.is_showing() {
            let sender = self.shown.get_or_insert_default();
            return sender.next(picture, now).map(DeskMessage::Show);
        }
        self.shown = None;
        // The seat says with its next report whether it has looked away.
        let is_due = self.hidden_at.is_none_or(|at| now >= at + HIDE_AGAIN);
        is_due.then(|| {
            self.hidden_at = Some(now);
            DeskMessage::Hide
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
