//! The state of the desk.

use std::time::Duration;

use super::protocol::{Denial, Hello, SeatMessage, VERSION};
use super::{
    Attention, Deed, Exam, Need, OrderId, Piece, Presence, SeatRecord, SeatReport, Submission,
    TryHead, Words,
};

/// The maximum number of seats.
pub const SEATS: usize = 512;

/// The number of a connection to a seat. No number is used twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConnectionId(pub u64);

/// What is to be done with a line of a seat.
#[derive(Debug, Clone, PartialEq)]
pub enum DeskHeard {
    /// Nothing: the desk knows it now.
    Known,
    /// Take in a record.
    Submission(Submission),
    /// Take in a piece of a record.
    Piece(Piece),
    /// Tell the seat that this head is noted, once it is.
    Witnessed(TryHead),
}

/// What an instructor's console knows of the class.
#[derive(Debug, Clone)]
pub struct Desk {
    id: u64,
    class: Words,
    pub(super) seats: Vec<SeatRecord>,
    orders: u32,
    /// The seat whose screen is watched.
    watched: Option<usize>,
    pub(super) exam: Option<Exam>,
}

impl Desk {
    /// A desk without seats. The number `id` belongs to this opening of the desk only.
    pub fn new(id: u64, class: Words) -> Self {
        Self {
            id,
            class,
            seats: Vec::new(),
            orders: 0,
            watched: None,
            exam: None,
        }
    }

    /// The name of the class.
    pub fn class(&self) -> &Words {
        &self.class
    }

    /// The seats, in the order in which they joined. Seats are never removed, so an index stays valid.
    pub fn seats(&self) -> &[SeatRecord] {
        &self.seats
    }

    /// The seat of a connection.
    pub fn seat_of(&self, connection: ConnectionId) -> Option<&SeatRecord> {
        self.index_of(connection).map(|index| &self.seats[index])
    }

    pub(super) fn index_of(&self, connection: ConnectionId) -> Option<usize> {
        let here = Presence::Here(connection);
        self.seats.iter().position(|seat| seat.presence == here)
    }

    /// The indices of the seats in the order of the board: connected ones first, then by need, then by name.
    pub fn board(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.seats.len()).collect();
        order.sort_by_key(|&index| {
            let seat = &self.seats[index];
            (!seat.is_here(), seat.attention.rank(), natural(&seat.name))
        });
        order
    }

    /// Takes in a line of a connection whose far end belongs to `user`.
    ///
    /// # Errors
    /// The seat cannot join; its connection is to be ended.
    pub fn hear(
        &mut self,
        connection: ConnectionId,
        user: &str,
        message: SeatMessage,
        now: Duration,
    ) -> Result<DeskHeard, Denial> {
        let Some(index) = self.index_of(connection) else {
            let SeatMessage::Hello(hello) = message else {
                return Err(Denial::NoHello);
            };
            self.admit(connection, user, &hello, now)?;
            return Ok(DeskHeard::Known);
        };
        match message {
            SeatMessage::Hello(_) => return Err(Denial::NoHello),
            SeatMessage::Report { last, report } => {
                self.seats[index].announced = last;
                self.report(index, *report, now);
            }
            SeatMessage::Entries(batch) => {
                let seat = &mut self.seats[index];
                let new = seat.journal.receive(batch);
                seat.hear(&new);
            }
            SeatMessage::Screen(part) if self.watched == Some(index) => {
                self.seats[index].see(&part, now);
            }
            // It was on its way when the desk stopped watching.
            SeatMessage::Screen(_) => {}
            SeatMessage::Submit(submission) => return Ok(DeskHeard::Submission(submission)),
            SeatMessage::Piece(piece) => return Ok(DeskHeard::Piece(piece)),
            SeatMessage::Head(head) => {
                if self.witness(index, &head, now) {
                    return Ok(DeskHeard::Witnessed(head));
                }
            }
        }
        Ok(DeskHeard::Known)
    }

    fn report(&mut self, index: usize, report: SeatReport, now: Duration) {
        let seat = &mut self.seats[index];
        seat.attention
            .observe(Need::of(report.flight.as_ref()), now);
        seat.report = Some(report);
        seat.heard_at = now;
    }

    /// Seats a run of a console: where it sat before, else on a seat of the same user that is free, else on a new one.
    fn admit(
        &mut self,
        connection: ConnectionId,
        user: &str,
        hello: &Hello,
        now: Duration,
    ) -> Result<(), Denial> {
        if hello.protocol != VERSION {
            return Err(Denial::Version { desk: VERSION });
        }
        let mut own = self
            .seats
            .iter()
            .enumerate()
            .filter(|(_, it)| it.user == user);
        // The connection before may still count as open: its console is the same, and has left it.
        let before = own.clone().find(|(_, it)| it.sitting == hello.sitting);
        let free = before.or_else(|| own.find(|(_, it)| !it.is_here()));
        let index = match free {
            Some((index, _)) => index,
            None if self.seats.len() >= SEATS => return Err(Denial::Full),
            None => {
                let name = self.name_for(user);
                self.seats
                    .push(SeatRecord::new(name, user, connection, now));
                self.seats.len() - 1
            }
        };
        self.seats[index].sit(hello.sitting, connection, now);
        Ok(())
    }

    fn name_for(&self, user: &str) -> String {
        let count = self.seats.iter().filter(|it| it.user == user).count();
        match count {
            0 => user.to_owned(),
            some => format!("{user}-{}", some + 1),
        }
    }

    /// A connection has ended.
    pub fn leave(&mut self, connection: ConnectionId, now: Duration) {
        if let Some(index) = self.index_of(connection) {
            let seat = &mut self.seats[index];
            seat.presence = Presence::Gone(now);
            seat.attention = Attention::new(now);
        }
    }

    /// Watches the screen of a seat, instead of another one; `None` watches none.
    pub fn watch(&mut self, seat: Option<usize>) {
        self.watched = seat.filter(|&it| it < self.seats.len());
        if let Some(seat) = seat.and_then(|it| self.seats.get_mut(it)) {
            seat.forget_screen();
        }
    }

    /// The seat whose screen is watched.
    pub fn watched(&self) -> Option<usize> {
        self.watched
    }

    /// Gives an order to a seat.
    pub fn give(&mut self, seat: usize, deed: Deed, now: Duration) {
        self.order(seat, deed, now);
    }

    /// Gives an order to a seat; returns its identity.
    pub(super) fn order(&mut self, seat: usize, deed: Deed, now: Duration) -> OrderId {
        self.orders += 1;
        let id = OrderId {
            desk: self.id,
            number: self.orders,
        };
        if let Some(seat) = self.seats.get_mut(seat) {
            seat.give(id, deed, now);
        }
        id
    }

    /// Gives up waiting for the answers to old orders; returns whether there was one.
    pub fn expire(&mut self, now: Duration) -> bool {
        let late = self.seats.iter_mut().map(|seat| seat.expire(now));
        late.fold(false, |any, one| any | one)
    }
}

/// The key by which names are sorted: `anna-2` before `anna-10`.
fn natural(name: &str) -> (&str, u64, &str) {
    let word = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (word, name[word.len()..].parse().unwrap_or_default(), name)
}
