//! Lessons at a desk, with seats that carry orders out at once.

use std::sync::Arc;

use super::{joined, seconds};
use crate::*;

mod branches;
mod going_back;
mod properties;
mod pupils;

use pupils::{Class, Pupil};

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
fn the_key_leads_on_from_a_mission_that_is_not_begun_again() {
    let mut fly = step("fly", StepStart::AtOnce, StepTarget::Step(1));
    fly.deeds.insert(0, Deed::Start);
    fly.deeds.push(Deed::Start);
    let last = step("last", StepStart::Instructor, StepTarget::End);
    let mut class = Class::new(&["a"]);
    class.seats[0].refuses_to_fly = true;
    class.desk.teach(&plan(vec![fly, last]), &[0], class.now);
    class.run(2);
    assert_eq!((class.at(0), class.seats[0].done().len()), ("fly", 0));
    assert_eq!(class.direct(0, LessonDirection::Next), Ok(vec![0]));
    class.run(2);
    assert_eq!(class.at(0), "last");
    assert_eq!(class.seats[0].done(), ["fly"], "the other orders are given");
}

#[test]
fn a_condition_of_a_flight_that_is_over_is_waited_for_no_longer() {
    let mut up = step("up", when("airborne > 0"), StepTarget::End);
    up.limit = Some(StepLimit {
        within: seconds(600),
        otherwise: StepTarget::Step(1),
    });
    let gates = step("gates", when("met('gates')"), StepTarget::Step(2));
    let landed = step("landed", StepStart::AtOnce, StepTarget::End);
    let mut class = Class::new(&["a"]);
    class
        .desk
        .teach(&plan(vec![up, gates, landed]), &[0], class.now);
    class.run(2);
    assert_eq!(class.at(0), "up");
    class.seats[0].is_over = true;
    class.run(2);
    assert!(class.lesson(0).has_ended());
    assert_eq!(class.seats[0].done(), ["landed"]);
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
