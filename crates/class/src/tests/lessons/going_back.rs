//! Steps to which the instructor has gone back, at a desk that is opened again.

use super::{Class, lesson};
use crate::*;

/// The desk is opened again, and goes on with the lesson.
fn reopen(class: &mut Class, plan: &std::sync::Arc<LessonPlan>) {
    class.run(1);
    class.reopen();
    class.run(1);
    class.desk.resume(plan, class.now);
    class.run(2);
}

#[test]
fn a_step_that_waits_after_back_waits_at_a_desk_that_is_opened_again() {
    let plan = lesson();
    let mut class = Class::new(&["a"]);
    class.desk.teach(&plan, &[0], class.now);
    class.run(2);
    assert!(class.direct(0, LessonDirection::Back).is_ok());
    reopen(&mut class, &plan);
    let back = LessonWait::Instructor(Some(HoldReason::Back));
    assert_eq!((class.at(0), class.lesson(0).wait()), ("brief", back));
    assert_eq!(class.seats[0].done(), ["brief"]);
    let first = class.direct(0, LessonDirection::Back).err();
    assert_eq!(first, Some(LessonFault::First), "back is no further visit");
    assert!(class.direct(0, LessonDirection::Next).is_ok());
    reopen(&mut class, &plan);
    assert_eq!(class.at(0), "up");
    assert_eq!(class.seats[0].done(), ["brief", "brief"]);
}

#[test]
fn the_way_back_from_the_end_is_known_to_a_desk_that_is_opened_again() {
    let plan = lesson();
    let mut class = Class::new(&["a"]);
    class.seats[0].holds.insert("airborne > 0".to_owned());
    class.desk.teach(&plan, &[0], class.now);
    class.run(2);
    assert!(class.direct(0, LessonDirection::Next).is_ok());
    class.run(2);
    assert!(class.lesson(0).has_ended());
    assert!(class.direct(0, LessonDirection::Back).is_ok());
    reopen(&mut class, &plan);
    for step in ["praise", "up", "brief"] {
        assert_eq!(class.at(0), step);
        let is_back = class.direct(0, LessonDirection::Back).is_ok();
        assert_eq!(is_back, step != "brief");
    }
}
