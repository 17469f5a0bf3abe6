//! What a desk knows of one seat.

use std::collections::VecDeque;
use std::time::Duration;

use super::order::ANSWERED_WITHIN;
use super::watch::{Picture, PicturePart, PictureReceiver};
use super::{
    Attention, ConnectionId, Deed, Entry, Happening, Insight, JournalCopy, LessonPosition, Need,
    Order, OrderId, Outcome, SeatReport, Words,
};

/// The maximum number of orders to one seat that a desk remembers.
const REMEMBERED: usize = 200;

/// Whether a seat is connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// The seat is connected by this connection.
    Here(ConnectionId),
    /// The seat has not been connected since this time of the desk's clock.
    Gone(Duration),
}

/// How far an order is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrderState {
    /// The seat has not answered yet.
    Waiting,
    /// The seat has answered.
    Ended(Outcome),
    /// The seat did not answer in time. If it does so later, because the connection was broken, its answer counts.
    Unanswered,
}

/// An order that was given to a seat.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GivenOrder {
    /// The order as it was sent.
    pub order: Order,
    /// When it was given.
    pub at: Duration,
    /// How far it is.
    pub state: OrderState,
    /// What the seat has said about the outcome.
    pub why: Option<Words>,
    /// Whether a report of the seat came after its answer, which then shows what has become of the order.
    pub(super) is_reported: bool,
}

/// A seat as its desk knows it.
#[derive(Debug, Clone)]
pub struct SeatRecord {
    /// The name of the user of the machine, with a number if the user has several seats.
    pub name: String,
    pub(super) user: String,
    pub(super) sitting: u64,
    /// Whether it is connected.
    pub presence: Presence,
    /// The newest report of the seat; `None` before the first one.
    pub report: Option<SeatReport>,
    /// When its newest report came.
    pub heard_at: Duration,
    /// The part of the journal that the desk has.
    pub journal: JournalCopy,
    /// The number of the newest entry that the seat has.
    pub(super) announced: u64,
    /// Why it needs the instructor.
    pub attention: Attention,
    pub(super) screen: PictureReceiver,
    /// When something of its screen last came.
    pub(super) seen_at: Option<Duration>,
    /// What is behind the screen, while the desk watches it.
    pub(super) insight: Option<Insight>,
    orders: VecDeque<GivenOrder>,
    /// Where it is in a lesson; `None` without one.
    pub lesson: Option<LessonPosition>,
    /// When the position was found in the seat's journal; `None` if the desk has begun the lesson itself.
    pub(super) lesson_found_at: Option<Duration>,
    /// Whether the desk knows about the lesson that the seat's journal may have.
    pub(super) is_lesson_known: bool,
}

impl SeatRecord {
    /// The name of the user of the machine.
    pub fn user(&self) -> &str {
        &self.user
    }

    pub(super) fn new(name: String, user: &str, connection: ConnectionId, now: Duration) -> Self {
        Self {
            name,
            user: user.to_owned(),
            sitting: 0,
            presence: Presence::Here(connection),
            report: None,
            heard_at: now,
            journal: JournalCopy::default(),
            announced: 0,
            attention: Attention::new(now),
            screen: PictureReceiver::default(),
            seen_at: None,
            insight: None,
            orders: VecDeque::new(),
            lesson: None,
            lesson_found_at: None,
            is_lesson_known: false,
        }
    }

    /// The seat is connected by a run of the console. A new run begins a new journal.
    pub(super) fn sit(&mut self, sitting: u64, connection: ConnectionId, now: Duration) {
        if self.sitting != sitting {
            self.sitting = sitting;
            self.journal = JournalCopy::default();
            self.announced = 0;
            self.report = None;
            self.attention = Attention::new(now);
            if let Some(lesson) = &mut self.lesson {
                lesson.forget_note(now);
            }
        }
        self.presence = Presence::Here(connection);
        self.heard_at = now;
        self.forget_screen();
        self.insight = None;
    }

    pub(super) fn forget_screen(&mut self) {
        self.screen = PictureReceiver::default();
        self.seen_at = None;
    }

    /// Takes in a part of the seat's screen.
    pub(super) fn see(&mut self, part: &PicturePart, now: Duration) {
        self.screen.receive(part);
        self.seen_at = Some(now);
    }

    /// The screen of the seat, while the desk watches it and a picture has come.
    pub fn picture(&self) -> Option<&Picture> {
        self.screen.picture()
    }

    /// What is behind the screen, while the desk watches the seat and it flies.
    pub fn insight(&self) -> Option<&Insight> {
        self.insight.as_ref()
    }

    /// Whether the trainee sees what the desk shows to the class.
    pub fn looks_on(&self) -> bool {
        self.is_here() && self.report.as_ref().is_some_and(|it| it.looks_on)
    }

    /// For how long nothing of the watched screen has come; `None` before the first picture.
    pub fn unseen_for(&self, now: Duration) -> Option<Duration> {
        Some(now.saturating_sub(self.seen_at?))
    }

    /// Whether the seat is connected.
    pub fn is_here(&self) -> bool {
        matches!(self.presence, Presence::Here(_))
    }

    /// The orders to this seat, oldest first.
    pub fn orders(&self) -> impl DoubleEndedIterator<Item = &GivenOrder> {
        self.orders.iter()
    }

    /// What the desk has asked for lately and no report of the seat shows yet, oldest first: orders that wait, and those
    /// that were carried out after the newest report.
    pub fn unreported(&self) -> impl DoubleEndedIterator<Item = &Deed> {
        let orders = self.orders.iter().filter(|given| match given.state {
            OrderState::Waiting => true,
            OrderState::Ended(Outcome::Done) => !given.is_reported,
            OrderState::Ended(_) | OrderState::Unanswered => false,
        });
        orders.map(|given| &given.order.deed)
    }

    /// Takes in a report.
    pub(super) fn take_report(&mut self, report: SeatReport, now: Duration) {
        self.attention
            .observe(Need::of(report.flight.as_ref()), now);
        if report.flight.is_none() {
            self.insight = None;
        }
        self.report = Some(report);
        self.heard_at = now;
        for given in &mut self.orders {
            given.is_reported |= given.state != OrderState::Waiting;
        }
    }

    pub(super) fn give(&mut self, id: OrderId, deed: Deed, now: Duration) {
        self.orders.push_back(GivenOrder {
            order: Order { id, deed },
            at: now,
            state: OrderState::Waiting,
            why: None,
            is_reported: false,
        });
        if self.orders.len() > REMEMBERED {
            self.orders.pop_front();
        }
    }

    /// Notes the outcomes of orders in new entries.
    pub(super) fn hear(&mut self, entries: &[Entry]) {
        for entry in entries {
            let Happening::Order {
                id, outcome, why, ..
            } = &entry.what
            else {
                continue;
            };
            let (id, outcome) = (*id, *outcome);
            let given = self.orders.iter_mut().find(|it| it.order.id == id);
            if let Some(given) = given {
                given.state = OrderState::Ended(outcome);
                given.why.clone_from(why);
            }
            if let Some(lesson) = &mut self.lesson {
                lesson.hear(id, outcome);
            }
        }
    }

    /// Whether a lesson in its journal may go on at this desk: the journal is complete, and the desk has not begun
    /// another one.
    pub(super) fn may_resume(&self) -> bool {
        let is_complete = self.journal.last() >= self.announced && self.report.is_some();
        self.is_here() && is_complete && self.lesson.is_none() && !self.is_lesson_known
    }

    /// Gives up waiting for old orders; returns whether there was one.
    pub(super) fn expire(&mut self, now: Duration) -> bool {
        let mut any = false;
        for given in &mut self.orders {
            let is_late = now.saturating_sub(given.at) >= ANSWERED_WITHIN;
            if given.state == OrderState::Waiting && is_late {
                given.state = OrderState::Unanswered;
                any = true;
            }
        }
        any
    }
}
