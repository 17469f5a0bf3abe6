//! The state of a seat's side.

use std::collections::VecDeque;

use super::watch::{Picture, PicturePart, PictureReceiver};
use super::{HandIn, Happening, Journal, Order, OrderId, Outcome, Words};

/// How many orders a seat remembers, so that it does not carry one out twice.
const REMEMBERED: usize = 256;

/// Whether the trainee joins the class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Consent {
    /// The trainee has not been asked.
    Unasked,
    /// The trainee has agreed to join.
    Given,
    /// The trainee does not join; nothing is sent.
    Declined,
}

/// A console's place in a class.
#[derive(Debug, Clone)]
pub struct Seat {
    sitting: u64,
    consent: Consent,
    instructor: Option<String>,
    last_instructor: Option<String>,
    class: Option<Words>,
    /// The name that the desk has given to the seat; a new connection asks for it again.
    name: Option<Words>,
    is_screen_watched: bool,
    /// What the desk shows to the class; `None` while the trainee does not look on.
    shown: Option<PictureReceiver>,
    journal: Journal,
    seen: VecDeque<OrderId>,
    hand_in: HandIn,
}

impl Seat {
    /// A place that this run of the console may take. The number `sitting` belongs to this run only.
    pub fn new(sitting: u64, consent: Consent) -> Self {
        Self {
            sitting,
            consent,
            instructor: None,
            last_instructor: None,
            class: None,
            name: None,
            is_screen_watched: false,
            shown: None,
            journal: Journal::default(),
            seen: VecDeque::new(),
            hand_in: HandIn::default(),
        }
    }

    /// The number of this run of the console.
    pub fn sitting(&self) -> u64 {
        self.sitting
    }

    /// Whether the trainee joins.
    pub fn consent(&self) -> Consent {
        self.consent
    }

    /// Takes in the trainee's answer.
    pub fn decide(&mut self, joins: bool) {
        self.consent = if joins {
            Consent::Given
        } else {
            Consent::Declined
        };
    }

    /// A desk was found, which belongs to this user of the machine.
    pub fn find(&mut self, instructor: &str) {
        self.instructor = Some(instructor.to_owned());
        self.last_instructor.clone_from(&self.instructor);
    }

    /// The desk has taken the seat into its class. The desk knows its user better than the carrier, at whose other end may
    /// be a tunnel.
    pub fn enter(&mut self, class: Words, name: Words, instructor: &Words) {
        if !instructor.is_empty() {
            self.find(instructor.as_str());
        }
        self.class = Some(class);
        self.name = Some(name).filter(|name| !name.is_empty());
        self.hand_in.retry();
    }

    /// The connection to the desk has ended.
    pub fn lose(&mut self) {
        self.instructor = None;
        self.class = None;
        self.is_screen_watched = false;
        self.shown = None;
    }

    /// The name that the desk has given to the seat.
    pub fn name(&self) -> Option<&Words> {
        self.name.as_ref()
    }

    /// The trainee looks on at what the desk shows to the class, or no longer does.
    pub fn look_on(&mut self, on: bool) {
        if on {
            // A trainee who looks on already keeps the picture: the desk goes on with what has changed.
            self.shown.get_or_insert_default();
        } else {
            self.shown = None;
        }
    }

    /// Whether the trainee looks on.
    pub fn looks_on(&self) -> bool {
        self.shown.is_some()
    }

    /// Takes in a part of what the desk shows.
    pub fn see(&mut self, part: &PicturePart) {
        if let Some(shown) = &mut self.shown {
            shown.receive(part);
        }
    }

    /// What the desk shows, once a picture has come.
    pub fn shown(&self) -> Option<&Picture> {
        self.shown.as_ref()?.picture()
    }

    /// The desk begins or ends to watch the screen.
    pub fn let_watch(&mut self, on: bool) {
        self.is_screen_watched = on;
    }

    /// Whether the desk watches the screen.
    pub fn is_screen_watched(&self) -> bool {
        self.is_screen_watched
    }

    /// Whose desk there is; `None` while there is none.
    pub fn instructor(&self) -> Option<&str> {
        self.instructor.as_deref()
    }

    /// Whose desk there is, or was last.
    pub fn last_instructor(&self) -> Option<&str> {
        self.last_instructor.as_deref()
    }

    /// The class, while its desk watches this seat.
    pub fn class(&self) -> Option<&Words> {
        self.class.as_ref()
    }

    /// Whether an order has not been taken in before; from now on it has.
    pub fn is_new(&mut self, order: &Order) -> bool {
        if self.seen.contains(&order.id) {
            return false;
        }
        self.seen.push_back(order.id);
        if self.seen.len() > REMEMBERED {
            self.seen.pop_front();
        }
        true
    }

    /// Adds what happened to the journal, at a time of the mission.
    pub fn note(&mut self, clock_s: Option<f64>, what: Happening) {
        self.journal.note(clock_s, what);
    }

    /// Notes how an order ended, and why, if there is more to say.
    pub fn settle(
        &mut self,
        clock_s: Option<f64>,
        order: Order,
        outcome: Outcome,
        why: Option<Words>,
    ) {
        let Order { id, deed } = order;
        let ended = Happening::Order {
            id,
            deed,
            outcome,
            why,
        };
        self.note(clock_s, ended);
    }

    /// The records that the desk has not acknowledged.
    pub fn hand_in(&self) -> &HandIn {
        &self.hand_in
    }

    /// The records that the desk has not acknowledged, to add one or to take in an answer.
    pub fn hand_in_mut(&mut self) -> &mut HandIn {
        &mut self.hand_in
    }

    /// What happened at this seat.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }
}
