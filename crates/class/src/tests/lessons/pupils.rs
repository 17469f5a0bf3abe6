//! A class whose seats carry orders out at once.

use std::collections::BTreeSet;
use std::time::Duration;

use super::super::rig::end_order;
use super::super::{STEP, desk, joined};
use crate::protocol::SeatMessage;
use crate::*;

/// A class: the desk, and what its seats do.
pub(super) struct Class {
    pub desk: Desk,
    pub seats: Vec<Pupil>,
    pub now: Duration,
    pub desks: u64,
}

/// A seat that carries out every order, except those that it refuses.
#[derive(Default)]
pub(super) struct Pupil {
    pub journal: Journal,
    pub seen: BTreeSet<OrderId>,
    /// The conditions that hold.
    pub holds: BTreeSet<String>,
    /// The step that waits for its condition.
    pub waits: Option<Order>,
    pub refuses_to_fly: bool,
    /// Whether its flight is over.
    pub is_over: bool,
}

impl Pupil {
    pub fn obey(&mut self, order: Order) {
        if !self.seen.insert(order.id) {
            return;
        }
        match &order.deed {
            Deed::Step(step) => {
                if let Some(before) = self.waits.take() {
                    end_order(&mut self.journal, before, Outcome::Disarmed);
                }
                if step.when.is_none() {
                    return end_order(&mut self.journal, order, Outcome::Done);
                }
                end_order(&mut self.journal, order.clone(), Outcome::Armed);
                self.waits = Some(order);
            }
            Deed::Fly { .. } | Deed::Start if self.refuses_to_fly => {
                end_order(&mut self.journal, order, Outcome::Refused(Refusal::Flying));
            }
            _ => end_order(&mut self.journal, order, Outcome::Done),
        }
    }

    pub fn look(&mut self) {
        let condition = self.waits.as_ref().and_then(|order| match &order.deed {
            Deed::Step(step) => step.when.clone(),
            _ => None,
        });
        let holds = condition.is_some_and(|it| self.holds.contains(it.as_str()));
        let outcome = if holds {
            Outcome::Done
        } else {
            Outcome::Refused(Refusal::NotFlying)
        };
        if (holds || self.is_over)
            && let Some(order) = self.waits.take()
        {
            end_order(&mut self.journal, order, outcome);
        }
    }

    /// The marks and flights that the desk has ordered, in their order.
    pub fn done(&self) -> Vec<String> {
        let done = self.journal.entries().filter_map(|it| match &it.what {
            Happening::Order { deed, outcome, .. } if *outcome == Outcome::Done => match deed {
                Deed::Mark { text } => Some(text.to_string()),
                Deed::Fly { mission, .. } => Some(format!("fly {mission}")),
                _ => None,
            },
            _ => None,
        });
        done.collect()
    }
}

impl Class {
    pub fn new(users: &[&str]) -> Self {
        let mut class = Self {
            desk: desk(),
            seats: users.iter().map(|_| Pupil::default()).collect(),
            now: Duration::ZERO,
            desks: 9,
        };
        class.join(users.len());
        class
    }

    pub fn join(&mut self, count: usize) {
        for seat in 0..count {
            joined(&mut self.desk, seat as u64 + 1, &format!("user{seat}"), 10);
        }
    }

    /// The desk is killed and opened again.
    pub fn reopen(&mut self) {
        self.desks += 1;
        self.desk = Desk::new(self.desks, "9-A".into(), "petro".into());
        self.join(self.seats.len());
    }

    pub fn say(&mut self, seat: usize, message: SeatMessage) {
        let at = ConnectionId(seat as u64 + 1);
        let user = format!("user{seat}");
        let heard = self.desk.hear(at, &user, message, self.now);
        assert_eq!(heard, Ok(DeskHeard::Known));
    }

    /// A tenth of a second in which everything arrives.
    pub fn step(&mut self) {
        self.now += STEP;
        for seat in 0..self.seats.len() {
            let report = Box::new(SeatReport::default());
            let last = self.seats[seat].journal.last();
            self.say(seat, SeatMessage::Report { last, report });
            while let Some(batch) = {
                let next = self.desk.seats()[seat].journal.next_number();
                self.seats[seat].journal.from(next)
            } {
                self.say(seat, SeatMessage::Entries(batch));
            }
        }
        self.desk.conduct(self.now);
        for seat in 0..self.seats.len() {
            let orders: Vec<Order> = self.desk.seats()[seat]
                .orders()
                .filter(|it| it.state == OrderState::Waiting)
                .map(|it| it.order.clone())
                .collect();
            let pupil = &mut self.seats[seat];
            for order in orders {
                pupil.obey(order);
            }
            pupil.look();
        }
    }

    pub fn run(&mut self, seconds: u32) {
        for _ in 0..seconds * 10 {
            self.step();
        }
    }

    pub fn lesson(&self, seat: usize) -> &LessonPosition {
        let lesson = self.desk.seats()[seat].lesson.as_ref();
        lesson.expect("it is in a lesson")
    }

    pub fn at(&self, seat: usize) -> &str {
        let step = self.lesson(seat).step().expect("there is one");
        step.id.as_str()
    }

    pub fn direct(
        &mut self,
        seat: usize,
        direction: LessonDirection,
    ) -> Result<Vec<usize>, LessonFault> {
        self.desk.direct(seat, direction, self.now)
    }
}
