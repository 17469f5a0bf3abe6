//! What a journal tells of the instructor.

use super::*;
use crate::record::{Head, JournalLine, Subject};

fn order(deed: Deed) -> DeskRecord {
    DeskRecord {
        by: "petro".to_owned(),
        deed,
        outcome: Outcome::Done,
        why: None,
    }
}

fn told(part: &InstructorPart) -> Vec<String> {
    let acts = part.acts().iter();
    acts.map(|act| act.text().to_string()).collect()
}

#[test]
fn a_journal_says_who_flew_what_from_when_to_when() {
    let at = Duration::from_secs;
    let vehicles = |ids: &[VehicleId]| ids.to_vec();
    let mut lines = vec![(1, Happening::Mission { ms: 500 })];
    let desk = [
        (
            10,
            Deed::TakeOver {
                vehicles: vehicles(&[1, 2, 3]),
            },
        ),
        (
            15,
            Deed::TakeOver {
                vehicles: vehicles(&[2]),
            },
        ),
        (
            20,
            Deed::HandBack {
                vehicles: vehicles(&[2]),
            },
        ),
        (30, Deed::Freeze),
        (
            40,
            Deed::Recall {
                situation: "the turn".into(),
            },
        ),
        (
            41,
            Deed::TakeOver {
                vehicles: vehicles(&[4]),
            },
        ),
    ];
    for (second, deed) in desk {
        lines.push((
            second,
            Happening::Mission {
                ms: second * 1000 - 1000,
            },
        ));
        lines.push((second, Happening::Desk(order(deed))));
    }
    let journal = Journal {
        head: Head::new(Subject::Mission("00-first-flight".to_owned()), 0),
        lines: lines
            .into_iter()
            .map(|(second, what)| JournalLine::new(at(second), what))
            .collect(),
        damage: None,
        unknown: Vec::new(),
    };
    assert_eq!(
        told(&InstructorPart::of(&journal)),
        [
            "petro flew 2 from 00:09 to 00:19",
            "petro flew 1,3 from 00:09 to 00:39",
            "petro returned to the situation “the turn” at 00:39",
            "petro flew 4 from 00:40 to the end",
        ]
    );
}

#[test]
fn a_recall_leaves_behind_what_came_after_its_situation() {
    let at = Duration::from_secs;
    let mut part = InstructorPart::default();
    let take = |vehicles: &[VehicleId]| {
        order(Deed::TakeOver {
            vehicles: vehicles.to_vec(),
        })
    };
    let back = |vehicles: &[VehicleId]| {
        order(Deed::HandBack {
            vehicles: vehicles.to_vec(),
        })
    };
    part.add(at(10), &take(&[1, 2, 3]));
    part.add(at(20), &back(&[1]));
    part.add(at(40), &back(&[2]));
    part.add(at(41), &take(&[4]));
    part.go_back(at(30), "petro", "the turn");
    let expected = [
        "petro flew 1 from 00:10 to 00:20",
        "petro flew 2 from 00:10 to 00:30",
        "petro flew 3 from 00:10 to the end",
        "petro returned to the situation “the turn”: the flight continued from 00:30",
    ];
    assert_eq!(told(&part), expected);
    part.go_back(at(15), "petro", "1");
    let expected = [
        "petro flew 1 from 00:10 to 00:15",
        "petro flew 2 from 00:10 to 00:15",
        "petro flew 3 from 00:10 to the end",
        "petro returned to the situation “1”: the flight continued from 00:15",
    ];
    assert_eq!(told(&part), expected);
}

/// An inject stood in the timeline only, like an event of the mission.
#[test]
fn injects_are_told_with_the_instructor_and_the_vehicles_that_they_hit() {
    let mut part = InstructorPart::default();
    let inject = |name: &str, outcome, why: Option<&str>| DeskRecord {
        outcome,
        why: why.map(Into::into),
        ..order(Deed::Inject {
            name: name.into(),
            when: Some("t > 60".into()),
        })
    };
    let at = Duration::from_secs;
    part.add(at(5), &inject("motor_fail", Outcome::Armed, None));
    part.add(
        at(61),
        &inject("motor_fail", Outcome::Done, Some("vehicle 3")),
    );
    part.add(at(70), &inject("gust", Outcome::Done, None));
    let first = "petro triggered the inject motor_fail at 01:01: vehicle 3";
    let both = [first, "petro triggered the inject gust at 01:10"];
    assert_eq!(told(&part), both);
    part.go_back(at(65), "petro", "1");
    assert_eq!(told(&part)[..1], [first]);
    assert_eq!(part.acts().len(), 2, "the second one was left behind");
}

#[test]
fn orders_that_were_refused_are_not_told() {
    let mut part = InstructorPart::default();
    let refused = DeskRecord {
        outcome: Outcome::NoEffect,
        ..order(Deed::TakeOver { vehicles: vec![1] })
    };
    part.add(Duration::ZERO, &refused);
    assert!(part.is_empty());
    // Records of before name no vehicles if all were meant.
    part.add(
        Duration::ZERO,
        &order(Deed::TakeOver {
            vehicles: Vec::new(),
        }),
    );
    part.add(
        Duration::from_secs(65),
        &order(Deed::HandBack {
            vehicles: Vec::new(),
        }),
    );
    assert_eq!(told(&part), ["petro flew all vehicles from 00:00 to 01:05"]);
}
