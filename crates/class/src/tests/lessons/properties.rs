//! Lessons with any plan, and any acts of trainees and of the instructor.

use std::collections::BTreeSet;
use std::sync::Arc;

use proptest::prelude::*;

use super::{Class, plan, seconds, step, when};
use crate::*;

/// What may happen in a class.
#[derive(Debug, Clone)]
enum Act {
    Hold(usize, u8),
    Direct(usize, LessonDirection),
    Run(u32),
    Reopen,
}

fn acts(seat: std::ops::Range<usize>) -> impl Strategy<Value = Act> {
    let directions = prop_oneof![
        Just(LessonDirection::Next),
        Just(LessonDirection::Skip),
        Just(LessonDirection::Back),
    ];
    prop_oneof![
        3 => (seat.clone(), 0..4_u8).prop_map(|(seat, condition)| Act::Hold(seat, condition)),
        2 => (seat, directions).prop_map(|(seat, direction)| Act::Direct(seat, direction)),
        3 => (1..8_u32).prop_map(Act::Run),
    ]
}

prop_compose! {
    fn steps()(count in 1..6_usize)(
        parts in prop::collection::vec(
            (0..3_u8, 0..4_u8, 0..count + 1, prop::option::of((1..20_u64, 0..count + 1))),
            count,
        ),
        count in Just(count),
    ) -> Vec<LessonStep> {
        let target = |to: usize| if to == count { StepTarget::End } else { StepTarget::Step(to) };
        let made = parts.into_iter().enumerate().map(|(at, (kind, condition, then, limit))| {
            let start = match kind {
                0 => StepStart::AtOnce,
                1 => StepStart::Instructor,
                _ => when(&condition.to_string()),
            };
            LessonStep {
                limit: limit.map(|(within, otherwise)| StepLimit {
                    within: seconds(within),
                    otherwise: target(otherwise),
                }),
                ..step(&format!("s{at}"), start, target(then))
            }
        });
        made.collect()
    }
}

impl Class {
    fn act(&mut self, act: &Act, plan: &Arc<LessonPlan>) {
        match act {
            Act::Hold(seat, condition) => {
                self.seats[*seat].holds.insert(condition.to_string());
            }
            Act::Direct(seat, direction) => {
                // Not every direction is possible everywhere.
                let _ = self.direct(*seat, *direction);
            }
            Act::Run(seconds) => self.run(*seconds),
            Act::Reopen => {
                self.reopen();
                self.run(1);
                self.desk.resume(plan, self.now);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn what_happens_at_one_seat_does_not_change_the_lesson_of_another(
        steps in steps(),
        own in prop::collection::vec(acts(0..1), 0..12),
        others in prop::collection::vec(acts(1..2), 12),
    ) {
        let plan = plan(steps);
        let mut alone = Class::new(&["a", "b"]);
        alone.desk.teach(&plan, &[0], alone.now);
        let mut both = Class::new(&["a", "b"]);
        both.desk.teach(&plan, &[0, 1], both.now);
        for (own, other) in own.iter().zip(&others) {
            alone.act(own, &plan);
            // Time passes for all.
            if !matches!(other, Act::Run(_)) {
                both.act(other, &plan);
            }
            both.act(own, &plan);
        }
        prop_assert_eq!(alone.seats[0].done(), both.seats[0].done());
        prop_assert_eq!(alone.lesson(0).step_index(), both.lesson(0).step_index());
    }

    #[test]
    fn a_step_gives_its_orders_once_per_visit_also_over_kills_of_the_desk(
        steps in steps(),
        acts in prop::collection::vec(prop_oneof![4 => acts(0..1), 1 => Just(Act::Reopen)], 0..12),
    ) {
        let plan = plan(steps);
        let mut class = Class::new(&["a"]);
        class.desk.teach(&plan, &[0], class.now);
        class.run(1);
        for act in &acts {
            if matches!(act, Act::Reopen) {
                class.run(1);
            }
            let before = class.desk.seats()[0].lesson.clone();
            let step = before.as_ref().map(LessonPosition::step_index);
            class.act(act, &plan);
            let after = &class.desk.seats()[0].lesson;
            if let (Act::Reopen, Some(before), Some(step)) = (act, before, step) {
                // One that had ended is over; a seat is where it was, or further.
                prop_assert!(before.has_ended() || after.is_some());
                let is_kept = after.as_ref().is_none_or(|it| it.step_index() == step);
                // What has not reached the seat is not known to the next desk.
                let is_unknown = before.wait() == LessonWait::Seat;
                let moves = is_unknown || plan.steps[step].start != StepStart::Instructor
                    || plan.steps[step].limit.is_some();
                prop_assert!(is_kept || moves || before.held().is_some(), "{:?} {:?}", before, after);
            }
        }
        // Orders follow notes of their step, or the instructor's key.
        let keys = acts.iter().filter(|act| matches!(act, Act::Direct(_, LessonDirection::Next)));
        let keys = keys.count();
        let entries: Vec<_> = class.seats[0].journal.entries().cloned().collect();
        // A note has several outcomes. One after going back waits for the key.
        let notes = |id: &str| {
            let of_step = entries.iter().filter_map(|entry| match &entry.what {
                Happening::Order { id: order, deed: Deed::Step(step), .. } => {
                    let is_same = step.step.as_ref().is_some_and(|it| it.as_str() == id);
                    (is_same && !step.is_held).then_some(*order)
                }
                _ => None,
            });
            of_step.collect::<BTreeSet<OrderId>>().len()
        };
        for step in &plan.steps {
            let id = step.id.as_str();
            let given = class.seats[0].done().iter().filter(|it| *it == id).count();
            prop_assert!(given <= notes(id) + keys, "{id}: {given} orders, {} notes", notes(id));
        }
    }
}
