//! Steps of all seats, and branches that lead past them.

use super::{Class, plan, seconds, step, when};
use crate::*;

#[test]
fn a_seat_that_cannot_come_to_a_step_of_all_seats_is_not_waited_for() {
    let mut fork = step("fork", when("ready"), StepTarget::Step(1));
    fork.limit = Some(StepLimit {
        within: seconds(5),
        otherwise: StepTarget::Step(2),
    });
    let mut both = step("both", StepStart::AtOnce, StepTarget::End);
    both.together = true;
    let alone = step("alone", StepStart::Instructor, StepTarget::End);
    let mut class = Class::new(&["a", "b"]);
    let plan = plan(vec![fork, both, alone]);
    class.desk.teach(&plan, &[0, 1], class.now);
    class.seats[0].holds.insert("ready".to_owned());
    class.run(3);
    assert_eq!(class.lesson(0).wait(), LessonWait::Others);
    class.run(5);
    assert_eq!(class.at(1), "alone");
    assert_eq!(class.seats[0].done(), ["fork", "both"]);
    assert!(class.lesson(0).has_ended());
}
