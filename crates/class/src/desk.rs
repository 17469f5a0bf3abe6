//! The state of the desk.

use std::collections::BTreeSet;
use std::time::Duration;

use super::call::{CallEnd, Calls};
use super::protocol::{Denial, Hello, SeatMessage, VERSION};
use super::{
    Attention, Deed, Exam, Insight, OrderId, PicturePart, Piece, Presence, SeatRecord, Submission,
    TryHead, Watching, Words,
};

/// The number of empty seats of a user from which one of them is used, whatever name a console claims.
const EMPTY_SEATS: usize = 16;
/// The maximum number of seats.
pub const SEATS: usize = 512;

/// The least size of what the desk shows, and the rows that seats need for other things.
const SHOWN_LEAST: [u16; 2] = [80, 21];
const SHOWN_ROWS: u16 = 3;

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
    instructor: Words,
    /// Where it listens for other machines, if it does.
    address: Option<Words>,
    pub(super) seats: Vec<SeatRecord>,
    orders: u32,
    calls: Calls,
    watching: Watching,
    /// Whether the desk shows something to the class.
    is_showing: bool,
    /// The exams whose tries the desk sees, oldest first: the last one is held or was held last.
    pub(super) exams: Vec<Exam>,
}

impl Desk {
    /// A desk without seats. The number `id` belongs to this opening of the desk only.
    pub fn new(id: u64, class: Words, instructor: Words) -> Self {
        Self {
            id,
            class,
            instructor,
            address: None,
            seats: Vec::new(),
            orders: 0,
            calls: Calls::default(),
            watching: Watching::Nothing,
            is_showing: false,
            exams: Vec::new(),
        }
    }

    /// The same desk, which listens for other machines at an address.
    #[must_use]
    pub fn listening_at(self, address: Words) -> Self {
        let address = Some(address);
        Self { address, ..self }
    }

    /// Where it listens for other machines; `None` at a desk for this host.
    pub fn address(&self) -> Option<&Words> {
        self.address.as_ref()
    }

    /// The name of the class.
    pub fn class(&self) -> &Words {
        &self.class
    }

    /// The user who has opened the desk.
    pub fn instructor(&self) -> &Words {
        &self.instructor
    }

    /// The seats, in the order in which they joined. Seats are never removed, so an index stays valid.
    pub fn seats(&self) -> &[SeatRecord] {
        &self.seats
    }

    /// The number of users who have a seat that is connected, and of all users: one who has several consoles counts once.
    pub fn counted_seats(&self) -> [usize; 2] {
        let users = |seats: Vec<&SeatRecord>| {
            let users = seats.into_iter().map(|seat| seat.user.as_str());
            users.collect::<BTreeSet<_>>().len()
        };
        let here = self.seats.iter().filter(|seat| seat.is_here());
        [users(here.collect()), users(self.seats.iter().collect())]
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
                let seat = &mut self.seats[index];
                seat.announced = last;
                seat.take_report(*report, now);
            }
            SeatMessage::Entries(batch) => {
                let seat = &mut self.seats[index];
                let new = seat.journal.receive(batch);
                seat.hear(&new);
            }
            SeatMessage::Screen(part) => self.see(index, &part, now),
            SeatMessage::Insight(insight) => self.see_behind(index, *insight),
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

    /// Takes in a part of a screen, unless it was on its way when the desk stopped watching.
    fn see(&mut self, index: usize, part: &PicturePart, now: Duration) {
        if self.watching.screen() == Some(index) {
            self.seats[index].see(part, now);
        }
    }

    /// Takes in what is behind a screen, unless it was on its way when the desk stopped watching.
    fn see_behind(&mut self, index: usize, insight: Insight) {
        if self.watching.seats().contains(&index) {
            self.seats[index].insight = Some(insight.bounded());
        }
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
        let own = self
            .seats
            .iter()
            .enumerate()
            .filter(|(_, it)| it.user == user);
        // The connection before may still count as open: its console is the same, and has left it.
        let before = own.clone().find(|(_, it)| it.sitting == hello.sitting);
        // A desk that was opened again gives a console the name that it had: consoles come back in any order.
        let claimed = hello.name.as_ref().map(Words::as_str);
        let claimed = claimed.filter(|name| is_name_for(name, user));
        let mut empty = own.clone().filter(|(_, it)| !it.is_here());
        let free = before.or_else(|| {
            let is_wanted = |name: &str| claimed.is_none_or(|claimed| claimed == name);
            // One user's claims do not fill the class.
            let has_many = empty.clone().count() >= EMPTY_SEATS;
            empty.find(|(_, it)| has_many || is_wanted(&it.name))
        });
        let index = match free {
            Some((index, _)) => index,
            None if self.seats.len() >= SEATS => return Err(Denial::Full),
            None => {
                let name = self.name_for(user, claimed);
                self.seats
                    .push(SeatRecord::new(name, user, connection, now));
                self.seats.len() - 1
            }
        };
        self.seats[index].sit(hello.sitting, connection, now);
        Ok(())
    }

    /// A name that no seat has: the claimed one, otherwise that of the user, with a number if it is taken.
    fn name_for(&self, user: &str, claimed: Option<&str>) -> String {
        let is_free = |name: &String| self.seats.iter().all(|seat| seat.name != *name);
        let numbered = (2..).map(|number| format!("{user}-{number}"));
        let own = std::iter::once(user.to_owned()).chain(numbered);
        let mut names = claimed.map(str::to_owned).into_iter().chain(own);
        names.find(is_free).unwrap_or_default()
    }

    /// A connection has ended.
    pub fn leave(&mut self, connection: ConnectionId, now: Duration) {
        if let Some(index) = self.index_of(connection) {
            let seat = &mut self.seats[index];
            seat.presence = Presence::Gone(now);
            seat.attention = Attention::new(now);
        }
    }

    /// Watches these seats instead of others.
    pub fn watch(&mut self, watching: Watching) {
        let watching = watching.among(self.seats.len());
        if self.watching == watching {
            return;
        }
        for (index, seat) in self.seats.iter_mut().enumerate() {
            let (before, now) = (self.watching.parts_of(index), watching.parts_of(index));
            if before.screen != now.screen {
                seat.forget_screen();
            }
            if !now.insight {
                seat.insight = None;
            }
        }
        self.watching = watching;
    }

    /// The seats whose screen or state is sent to the desk.
    pub fn watching(&self) -> &Watching {
        &self.watching
    }

    /// Shows something to the seats whose trainees look on, or no longer does.
    pub fn show(&mut self, on: bool) {
        self.is_showing = on;
    }

    /// The columns and rows of what the desk shows: as large as fits the terminals of all seats that look on, which need
    /// three rows for other things.
    pub fn shown_size(&self) -> [u16; 2] {
        let here = self.seats.iter().filter(|seat| seat.looks_on());
        let sizes = here.filter_map(|seat| seat.report.as_ref()?.screen);
        let least = sizes.reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])]);
        let [columns, rows] = least.unwrap_or(SHOWN_LEAST);
        [
            columns.max(SHOWN_LEAST[0]),
            rows.saturating_sub(SHOWN_ROWS).max(SHOWN_LEAST[1]),
        ]
    }

    /// Whether the desk shows something to the class.
    pub fn is_showing(&self) -> bool {
        self.is_showing
    }

    /// Gives an order to seats.
    pub fn give(&mut self, seats: &[usize], deed: &Deed, now: Duration) {
        let orders: Vec<(usize, OrderId)> = seats
            .iter()
            .map(|&seat| (seat, self.order(seat, deed.clone(), now)))
            .collect();
        self.calls.begin(deed.clone(), orders.into_iter());
    }

    /// How orders have ended that no seat keeps waiting: each once, and again when a seat has said more.
    pub fn take_ended_calls(&mut self) -> Vec<CallEnd> {
        self.calls.take_ended(&self.seats)
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

/// Whether a seat of this user may have this name: no user can speak for another.
fn is_name_for(name: &str, user: &str) -> bool {
    let Some(rest) = name.strip_prefix(user) else {
        return false;
    };
    let number = rest.strip_prefix('-').and_then(|it| it.parse().ok());
    rest.is_empty() || number.is_some_and(|it: usize| (2..=SEATS).contains(&it))
}

/// The key by which names are sorted: `anna-2` before `anna-10`.
pub fn natural(name: &str) -> (&str, u64, &str) {
    let word = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (word, name[word.len()..].parse().unwrap_or_default(), name)
}
