//! A desk and a seat, and a connection between them that loses, repeats and reorders lines, and breaks.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use proptest::prelude::*;

use super::{Idle, STEP, desk};
use crate::protocol::{DeskMessage, SeatMessage, line, read};
use crate::reception::tests::MemoryShelf;
use crate::*;

/// What a connection does with a line.
#[derive(Debug, Clone, Copy)]
pub(super) enum Fate {
    Deliver,
    Lose,
    Repeat,
    /// Deliver it after the next line.
    Delay,
    /// Lose it, and end the connection.
    Break,
}

pub(super) fn fates() -> impl Strategy<Value = Vec<Fate>> {
    let fate = prop_oneof![
        6 => Just(Fate::Deliver),
        1 => Just(Fate::Lose),
        1 => Just(Fate::Repeat),
        1 => Just(Fate::Delay),
        1 => Just(Fate::Break),
    ];
    prop::collection::vec(fate, 0..200)
}

/// Notes in the journal of a seat how an order has ended.
pub(super) fn end_order(journal: &mut Journal, Order { id, deed }: Order, outcome: Outcome) {
    let why = None;
    journal.note(
        None,
        Happening::Order {
            id,
            deed,
            outcome,
            why,
        },
    );
}

/// A desk and a seat, and a connection between them with faults.
pub(super) struct Rig {
    pub desk: Desk,
    pub seat: Seat,
    seat_line: SeatLine,
    desk_line: DeskLine,
    connection: u64,
    pub now: Duration,
    /// How far the clock of the seat's machine is ahead of that of the desk's.
    pub seat_ahead: Duration,
    pub fates: VecDeque<Fate>,
    delayed: Vec<Vec<u8>>,
    /// How often each order was carried out.
    pub done: BTreeMap<OrderId, u32>,
    pub reception: Reception<MemoryShelf>,
    pub kept: u32,
    is_flying: bool,
}

impl Rig {
    pub fn new(fates: Vec<Fate>) -> Self {
        Self {
            desk: desk(),
            seat: Seat::new(77, Consent::Given),
            seat_line: SeatLine::default(),
            desk_line: DeskLine::default(),
            connection: 1,
            now: Duration::ZERO,
            seat_ahead: Duration::ZERO,
            fates: fates.into(),
            delayed: Vec::new(),
            done: BTreeMap::new(),
            reception: Reception::new(MemoryShelf::default()),
            kept: 0,
            is_flying: false,
        }
    }

    pub fn reconnect(&mut self) {
        self.desk.leave(ConnectionId(self.connection), self.now);
        self.connection += 1;
        self.seat.lose();
        self.seat_line = SeatLine::default();
        self.desk_line = DeskLine::default();
        self.delayed.clear();
    }

    /// The lines that arrive when this one is sent; `None` if the connection breaks.
    fn carry(&mut self, line: &str) -> Option<Vec<Vec<u8>>> {
        let line = line.trim_end().as_bytes().to_vec();
        let mut arriving = match self.fates.pop_front().unwrap_or(Fate::Deliver) {
            Fate::Deliver => vec![line],
            Fate::Lose => Vec::new(),
            Fate::Repeat => vec![line.clone(), line],
            Fate::Delay => {
                self.delayed.push(line);
                return Some(Vec::new());
            }
            Fate::Break => return None,
        };
        arriving.append(&mut self.delayed);
        Some(arriving)
    }

    pub fn step(&mut self) {
        self.now += STEP;
        let at_seat = self.now + self.seat_ahead;
        while let Some(message) = self.seat_line.next(&self.seat, &self.source(), at_seat) {
            let Some(lines) = self.carry(&line(&message)) else {
                return self.reconnect();
            };
            for line in lines {
                let at = ConnectionId(self.connection);
                let heard = read::<SeatMessage>(&line);
                // A delayed line of the other side.
                let Ok(heard) = heard else { continue };
                let receipt = match self.desk.hear(at, "anna", heard, self.now) {
                    Ok(DeskHeard::Known | DeskHeard::Witnessed(_)) => None,
                    Ok(DeskHeard::Submission(it)) => Some(self.reception.begin(at, "anna", &it)),
                    Ok(DeskHeard::Piece(it)) => self.reception.take(at, "anna", &it),
                    Err(_) => return self.reconnect(),
                };
                if let Some(receipt) = receipt
                    && !self.answer(&receipt)
                {
                    return self.reconnect();
                }
            }
        }
        let at = ConnectionId(self.connection);
        let shown = Picture::blank(4, 1);
        while let Some(message) = self.next_of_desk(at, &shown) {
            let Some(lines) = self.carry(&line(&message)) else {
                return self.reconnect();
            };
            for line in lines {
                if let Ok(heard) = read::<DeskMessage>(&line) {
                    self.obey(heard);
                }
            }
        }
        // A hello or a welcome that was lost: on a stream that is a break.
        if self.seat.class().is_none() && self.now.as_millis().is_multiple_of(2000) {
            self.reconnect();
        }
    }

    /// From now on, the seat has a flight.
    pub fn fly(&mut self) {
        self.is_flying = true;
    }

    fn source(&self) -> Idle {
        Idle {
            looks_on: self.seat.looks_on(),
            is_flying: self.is_flying,
        }
    }

    fn next_of_desk(&mut self, at: ConnectionId, shown: &Picture) -> Option<DeskMessage> {
        let said = self.desk_line.next(&self.desk, at, self.now);
        said.or_else(|| {
            let picture = || Some(shown.clone());
            self.desk_line.next_shown(&self.desk, at, picture, self.now)
        })
    }

    /// Sends what follows for a record; whether the connection holds.
    fn answer(&mut self, receipt: &Receipt) -> bool {
        self.kept += u32::from(matches!(receipt.news, Some(ReceiptNews::Kept(_))));
        let Some(lines) = self.carry(&line(&receipt.answer)) else {
            return false;
        };
        for line in lines {
            if let Ok(heard) = read::<DeskMessage>(&line) {
                self.obey(heard);
            }
        }
        true
    }

    fn obey(&mut self, message: DeskMessage) {
        self.seat_line.hear(&message);
        match message {
            DeskMessage::Welcome {
                class,
                name,
                instructor,
                ..
            } => self.seat.enter(class, name, &instructor),
            DeskMessage::Order(order) if self.seat.is_new(&order) => {
                *self.done.entry(order.id).or_default() += 1;
                if order.deed == Deed::LookOn {
                    self.seat.look_on(true);
                }
                self.seat.settle(None, order.clone(), Outcome::Done, None);
            }
            DeskMessage::Watch { on, insight } => self.seat.let_watch(on || insight),
            DeskMessage::Show(part) => self.seat.see(&part),
            DeskMessage::Hide => self.seat.look_on(false),
            DeskMessage::Settled { record, end } => {
                let now = self.now + self.seat_ahead;
                self.seat.hand_in_mut().settle(&record, end, now);
            }
            DeskMessage::Order(_)
            | DeskMessage::Fetch(_)
            | DeskMessage::Ask { .. }
            | DeskMessage::Witnessed { .. }
            | DeskMessage::Denied(_)
            | DeskMessage::Here => {}
        }
    }
}
