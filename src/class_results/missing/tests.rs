//! An exam with two tries, of which one was opened.

use std::time::Duration;

use super::*;
use crate::class::{
    ExamDeed, ExamLayout, ExamMission, ExamNote, ExamPlan, ExamSecret, TryEnd, TryName,
};

fn name(number: u32) -> TryName {
    TryName {
        exam: "final".into(),
        begun: 0,
        mission: "00-first-flight".into(),
        number,
        opening: 1,
    }
}

fn asked(number: u32) -> ExamDeed {
    ExamDeed::Asked {
        user: "anna".to_owned(),
        name: name(number),
        until: 600,
    }
}

fn exam(deeds: Vec<ExamDeed>) -> Exam {
    let plan = ExamPlan {
        name: "final".into(),
        title: "Final exam".into(),
        title_uk: None,
        layout: ExamLayout::Own,
        opens: None,
        closes: None,
        missions: vec![ExamMission {
            mission: "00-first-flight".into(),
            tries: 2,
            limit: Duration::from_secs(600),
        }],
    };
    let begun = ExamDeed::Begun {
        exam: "final".to_owned(),
        source: String::new(),
        secret: ExamSecret::from([1; 32]),
    };
    let deeds = std::iter::once(begun).chain(deeds);
    let notes: Vec<ExamNote> = deeds.map(|what| ExamNote { at: 1, what }).collect();
    Exam::of(plan.into(), &notes, 0).expect("it began")
}

#[test]
fn a_try_that_was_opened_and_has_no_record_is_named() {
    let opened = ExamDeed::Opened {
        user: "anna".to_owned(),
        name: name(1),
    };
    let exam = exam(vec![asked(1), opened.clone(), asked(2)]);
    let missing = TryWithoutRecord::of(&[exam], &[], 5);
    let found: Vec<(&str, u32, u32)> = missing
        .iter()
        .map(|it| (it.user.as_str(), it.number, it.tries))
        .collect();
    assert_eq!(found, [("anna", 1, 2)]);
    assert_eq!(missing[0].verdict, TryVerdict::Open);
}

#[test]
fn a_try_that_was_left_from_its_brief_is_not_open_also_after_the_end_of_the_exam() {
    let opened = ExamDeed::Opened {
        user: "anna".to_owned(),
        name: name(1),
    };
    let left = ExamDeed::Ended {
        user: "anna".to_owned(),
        name: name(1),
        how: TryEnd::Left,
    };
    let exam = exam(vec![asked(1), opened, ExamDeed::Stopped, left]);
    let missing = TryWithoutRecord::of(&[exam], &[], 5);
    assert_eq!(missing[0].verdict, TryVerdict::Left);
    assert!(!missing[0].is_open);
}
