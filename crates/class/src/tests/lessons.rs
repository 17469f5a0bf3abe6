//! Lessons at a desk, with seats that carry orders out at once.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use super::{STEP, desk, joined, seconds};
use crate::protocol::SeatMessage;
use crate::*;

mod branches;
mod going_back;
mod properties;

/// A class: the desk, and what its seats do.
struct Class {
    desk: Desk,
    seats: Vec<Pupil>,
    now: Duration,
    desks: u64,
}

/// A seat that carries out every order, except those that it refuses.
#[derive(Default)]
struct Pupil {
    journal: Journal,
    seen: BTreeSet<OrderId>,
    /// The conditions that hold.
    holds: BTreeSet<String>,
    /// The step that waits for its condition.
    waits: Option<Order>,
    refuses_to_fly: bool,
}

impl Pupil {
    fn obey(&mut self, order: Order) {
        if !self.seen.insert(order.id) {
            return;
        }
        let end = |journal: &mut Journal, order: Order, outcome| {
            let Order { id, deed } = order;
            journal.note(
                None,
                Happening::Order {
                    id,
                    deed,
                    outcome,
                    why: None,
                },
            );
        };
        match &order.deed {
            Deed::Step(step) => {
                if let Some(before) = self.waits.take() {
                    end(&mut self.journal, before, Outcome::Disarmed);
                }
                if step.when.is_none() {
                    return end(&mut self.journal, order, Outcome::Done);
                }
                end(&mut self.journal, order.clone(), Outcome::Armed);
                self.waits = Some(order);
            }
            Deed::Fly { .. } | Deed::Start if self.refuses_to_fly => {
                end(&mut self.journal, order, Outcome::Refused(Refusal::Flying));
            }
            _ => end(&mut self.journal, order, Outcome::Done),
        }
    }

    fn look(&mut self) {
        let condition = self.waits.as_ref().and_then(|order| match &order.deed {
            Deed::Step(step) => step.when.clone(),
            _ => None,
        });
        if condition.is_some_and(|it| self.holds.contains(it.as_str()))
            && let Some(Order { id, deed }) = self.waits.take()
        {
            let outcome = Outcome::Done;
            self.journal.note(
                None,
                Happening::Order {
                    id,
                    deed,
                    outcome,
                    why: None,
                },
            );
        }
    }

    /// The marks and flights that the desk has ordered, in their order.
    fn done(&self) -> Vec<String> {
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
    fn new(users: &[&str]) -> Self {
        let mut class = Self {
            desk: desk(),
            seats: users.iter().map(|_| Pupil::default()).collect(),
            now: Duration::ZERO,
            desks: 9,
        };
        class.join(users.len());
        class
    }

    fn join(&mut self, count: usize) {
        for seat in 0..count {
            joined(&mut self.desk, seat as u64 + 1, &format!("user{seat}"), 10);
        }
    }

    /// The desk is killed and opened again.
    fn reopen(&mut self) {
        self.desks += 1;
        self.desk = Desk::new(self.desks, "9-A".into());
        self.join(self.seats.len());
    }

    fn say(&mut self, seat: usize, message: SeatMessage) {
        let at = ConnectionId(seat as u64 + 1);
        let user = format!("user{seat}");
        let heard = self.desk.hear(at, &user, message, self.now);
        assert_eq!(heard, Ok(DeskHeard::Known));
    }

    /// A tenth of a second in which everything arrives.
    fn step(&mut self) {
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

    fn run(&mut self, seconds: u32) {
        for _ in 0..seconds * 10 {
            self.step();
        }
    }

    fn lesson(&self, seat: usize) -> &LessonPosition {
        let lesson = self.desk.seats()[seat].lesson.as_ref();
        lesson.expect("it is in a lesson")
    }

    fn at(&self, seat: usize) -> &str {
        let step = self.lesson(seat).step().expect("there is one");
        step.id.as_str()
    }

    fn direct(
        &mut self,
        seat: usize,
        direction: LessonDirection,
    ) -> Result<Vec<usize>, LessonFault> {
        self.desk.direct(seat, direction, self.now)
    }
}

fn step(id: &str, start: StepStart, then: StepTarget) -> LessonStep {
    LessonStep {
        id: id.into(),
        mission: None,
        start,
        together: false,
        limit: None,
        deeds: vec![Deed::Mark { text: id.into() }],
        then,
    }
}

fn when(condition: &str) -> StepStart {
    StepStart::When(condition.into())
}

fn plan(steps: Vec<LessonStep>) -> Arc<LessonPlan> {
    Arc::new(LessonPlan {
        name: "first".into(),
        steps,
    })
}

/// A step that starts at once, one with a condition and a limit, a manual one, and one for those who are late.
fn lesson() -> Arc<LessonPlan> {
    let mut up = step("up", when("airborne > 0"), StepTarget::Step(2));
    up.limit = Some(StepLimit {
        within: seconds(60),
        otherwise: StepTarget::Step(3),
    });
    plan(vec![
        step("brief", StepStart::AtOnce, StepTarget::Step(1)),
        up,
        step("praise", StepStart::Instructor, StepTarget::End),
        step("help", StepStart::AtOnce, StepTarget::Step(1)),
    ])
}

#[test]
fn each_seat_goes_through_the_steps_on_its_own() {
    let mut class = Class::new(&["a", "b"]);
    class.desk.teach(&lesson(), &[0, 1], class.now);
    class.run(2);
    let waits = LessonWait::Condition(&"airborne > 0".into());
    assert_eq!((class.at(0), class.lesson(0).wait()), ("up", waits));
    class.seats[0].holds.insert("airborne > 0".to_owned());
    class.run(2);
    assert_eq!((class.at(0), class.at(1)), ("praise", "up"));
    assert_eq!(class.lesson(0).wait(), LessonWait::Instructor(None));
    class.run(60);
    assert_eq!(class.seats[1].done(), ["brief", "help"]);
    assert_eq!(class.at(0), "praise");
    assert_eq!(class.direct(0, LessonDirection::Next), Ok(vec![0]));
    class.run(2);
    assert!(class.lesson(0).has_ended());
    assert_eq!(class.seats[0].done(), ["brief", "up", "praise"]);
    let end = class.seats[0].journal.entries().last().expect("one");
    let is_end =
        matches!(&end.what, Happening::Order { deed: Deed::Step(step), .. } if step.step.is_none());
    assert!(is_end, "{end:?}");
}

#[test]
fn a_step_of_all_seats_waits_for_all_that_are_there() {
    let mut start = step("start", when("ready"), StepTarget::End);
    start.together = true;
    let plan = plan(vec![start]);
    let mut class = Class::new(&["a", "b", "c"]);
    class.desk.teach(&plan, &[0, 1], class.now);
    class.seats[0].holds.insert("ready".to_owned());
    class.run(3);
    assert_eq!(class.lesson(0).wait(), LessonWait::Others);
    assert!(class.seats[0].done().is_empty());
    class.seats[1].holds.insert("ready".to_owned());
    class.run(2);
    for seat in [0, 1] {
        assert_eq!(class.seats[seat].done(), ["start"]);
    }
    assert_eq!(class.seats[2].journal.last(), 0, "it is in no lesson");

    // One that has left is not waited for, and the instructor's key starts the step at all.
    class.desk.teach(&plan, &[0, 1], class.now);
    class.desk.leave(ConnectionId(2), class.now);
    let pupil = class.seats.remove(1);
    class.seats.truncate(1);
    class.run(2);
    assert_eq!(class.seats[0].done(), ["start", "start"]);
    assert_eq!(pupil.done(), ["start"]);
}

#[test]
fn a_seat_that_waits_for_the_others_is_not_late() {
    let mut start = step("start", when("ready"), StepTarget::End);
    start.together = true;
    start.limit = Some(StepLimit {
        within: seconds(10),
        otherwise: StepTarget::Step(1),
    });
    let late = step("late", StepStart::AtOnce, StepTarget::End);
    let mut class = Class::new(&["a", "b"]);
    class
        .desk
        .teach(&plan(vec![start, late]), &[0, 1], class.now);
    class.seats[0].holds.insert("ready".to_owned());
    class.run(15);
    assert_eq!(class.seats[0].done(), ["start"]);
    assert_eq!(class.seats[1].done(), ["late"]);
}

#[test]
fn the_instructors_key_starts_a_step_of_all_seats_at_all_of_them() {
    let mut start = step("start", StepStart::Instructor, StepTarget::End);
    start.together = true;
    let mut class = Class::new(&["a", "b"]);
    class.desk.teach(&plan(vec![start]), &[0, 1], class.now);
    class.run(1);
    assert_eq!(class.direct(1, LessonDirection::Next), Ok(vec![0, 1]));
    class.run(1);
    assert_eq!(class.seats[0].done(), ["start"]);
    assert_eq!(class.seats[1].done(), ["start"]);
}

#[test]
fn the_instructor_skips_goes_back_and_stops() {
    let mut class = Class::new(&["a"]);
    assert_eq!(
        class.direct(0, LessonDirection::Next),
        Err(LessonFault::NoLesson)
    );
    class.desk.teach(&lesson(), &[0], class.now);
    assert_eq!(
        class.direct(0, LessonDirection::Back),
        Err(LessonFault::First)
    );
    class.run(1);
    assert_eq!(class.direct(0, LessonDirection::Skip), Ok(vec![0]));
    class.run(1);
    assert_eq!((class.at(0), class.seats[0].done().len()), ("praise", 1));
    assert_eq!(class.direct(0, LessonDirection::Back), Ok(vec![0]));
    assert_eq!(class.direct(0, LessonDirection::Back), Ok(vec![0]));
    class.run(2);
    assert_eq!(class.at(0), "brief", "it waits although it starts at once");
    let back = LessonWait::Instructor(Some(HoldReason::Back));
    assert_eq!(class.lesson(0).wait(), back);
    assert_eq!(class.direct(0, LessonDirection::Next), Ok(vec![0]));
    class.run(1);
    assert_eq!(class.seats[0].done(), ["brief", "brief"]);
    assert_eq!(class.direct(0, LessonDirection::Stop), Ok(vec![0]));
    class.run(1);
    assert_eq!(class.desk.seats()[0].lesson, None);
    class.seats[0].holds.insert("airborne > 0".to_owned());
    class.run(5);
    assert_eq!(class.seats[0].done().len(), 2);
    class.reopen();
    class.run(2);
    assert!(class.desk.unknown_lessons().is_empty());
}

#[test]
fn a_start_that_is_refused_holds_the_lesson() {
    let mut start = step("start", StepStart::AtOnce, StepTarget::End);
    start.deeds = vec![Deed::Start];
    let mut class = Class::new(&["a"]);
    class.seats[0].refuses_to_fly = true;
    class.desk.teach(&plan(vec![start]), &[0], class.now);
    class.run(2);
    let held = LessonWait::Instructor(Some(HoldReason::NotFlown));
    assert_eq!(class.lesson(0).wait(), held);
}

#[test]
fn a_mission_that_is_not_begun_holds_the_lesson() {
    let mut fly = step("fly", StepStart::AtOnce, StepTarget::End);
    let mission = "00".into();
    let exam = false;
    fly.deeds = vec![Deed::Fly {
        mission,
        exam,
        hold: false,
    }];
    let mut class = Class::new(&["a"]);
    class.seats[0].refuses_to_fly = true;
    class.desk.teach(&plan(vec![fly]), &[0], class.now);
    class.run(2);
    let held = LessonWait::Instructor(Some(HoldReason::NotFlown));
    assert_eq!(class.lesson(0).wait(), held);
    class.seats[0].refuses_to_fly = false;
    assert_eq!(class.direct(0, LessonDirection::Next), Ok(vec![0]));
    class.run(2);
    assert_eq!(class.seats[0].done(), ["fly 00"]);
    assert!(class.lesson(0).has_ended());
}

#[test]
fn a_lesson_that_runs_in_circles_stops_for_the_instructor() {
    let again = step("again", when("true"), StepTarget::Step(0));
    let mut class = Class::new(&["a"]);
    class.seats[0].holds.insert("true".to_owned());
    class.desk.teach(&plan(vec![again]), &[0], class.now);
    class.run(60);
    let circles = LessonWait::Instructor(Some(HoldReason::Circles));
    assert_eq!(class.lesson(0).wait(), circles);
    assert!(class.seats[0].done().len() < 25);
}

#[test]
fn a_desk_that_is_opened_again_goes_on_where_each_seat_was() {
    let plan = lesson();
    let mut class = Class::new(&["a", "b"]);
    class.desk.teach(&plan, &[0, 1], class.now);
    class.seats[0].holds.insert("airborne > 0".to_owned());
    class.run(2);
    class.reopen();
    class.run(1);
    assert_eq!(class.desk.unknown_lessons(), [plan.name.clone()].into());
    class.desk.resume(&plan, class.now);
    assert!(class.desk.unknown_lessons().is_empty());
    assert_eq!((class.at(0), class.at(1)), ("praise", "up"));
    class.run(2);
    assert_eq!(class.seats[0].done(), ["brief", "up"]);
    // A condition that has come to hold while there was no desk.
    class.seats[1].holds.insert("airborne > 0".to_owned());
    class.seats[1].look();
    class.reopen();
    class.run(1);
    class.desk.resume(&plan, class.now);
    class.run(2);
    assert_eq!(class.at(1), "praise");
    assert_eq!(
        class.seats[1].done(),
        ["brief", "up"],
        "nothing comes twice"
    );
    assert_eq!(class.direct(0, LessonDirection::Back), Ok(vec![0]));
    assert_eq!(class.at(0), "up");
}

#[test]
fn orders_that_a_killed_desk_had_given_are_not_repeated() {
    let mut two = step("two", StepStart::AtOnce, StepTarget::End);
    two.deeds.push(Deed::Mark {
        text: "second".into(),
    });
    let plan = plan(vec![two]);
    let mut class = Class::new(&["a"]);
    let note = LessonPosition::new(Arc::clone(&plan), class.now).note();
    for (number, deed) in (1..).zip([note, plan.steps[0].deeds[0].clone()]) {
        let id = OrderId { desk: 9, number };
        class.seats[0].obey(Order { id, deed });
    }
    class.reopen();
    class.run(1);
    class.desk.resume(&plan, class.now);
    class.run(2);
    assert_eq!(class.seats[0].done(), ["two", "second"]);
    assert!(class.lesson(0).has_ended());
}

#[test]
fn a_new_console_of_the_trainee_learns_the_step_again() {
    let mut class = Class::new(&["a"]);
    class.desk.teach(&lesson(), &[0], class.now);
    class.run(2);
    class.seats[0] = Pupil::default();
    class.desk.leave(ConnectionId(1), class.now);
    joined(&mut class.desk, 1, "user0", 11);
    class.run(2);
    class.seats[0].holds.insert("airborne > 0".to_owned());
    class.run(2);
    assert_eq!(class.at(0), "praise");
}
