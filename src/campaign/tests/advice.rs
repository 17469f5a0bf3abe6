use super::*;

#[test]
fn the_next_thing_to_train_is_one_that_may_be_flown() {
    let course = course();
    let (skill, offer) = course
        .next(&CareerStanding::default(), 1)
        .expect("something");
    assert_eq!((skill, offer.id.as_str()), (Skill::K3, "one"));
    let passed = CareerEntry::Flight(flight(&course, "one", 900, 1));
    let (_, offer) = course.next(&standing(&[passed]), 1).expect("something");
    assert_eq!(offer.id, "two", "a new mission before a known one");
}

#[test]
fn a_new_mission_is_advised_before_another_try_at_a_known_one() {
    let weak = |id: &str, skills: &[Skill]| Offer {
        skills: skills.to_vec(),
        ..offer(id, 1, &[], &[])
    };
    let course = MissionCourse::new([weak("links", &[Skill::K5]), weak("lines", &[Skill::K3])]);
    let poor = CareerFlight {
        evidence: vec![Evidence {
            skill: Skill::K5,
            outcome: 0.0,
            basis: None,
            what: Text::default(),
        }],
        ..flight(&course, "links", 600, 1)
    };
    let entries = [CareerEntry::Flight(poor)];
    let (skill, next) = course.next(&standing(&entries), 1).expect("something");
    assert_eq!((skill, next.id.as_str()), (Skill::K3, "lines"));
    let both = [
        entries[0].clone(),
        CareerEntry::Flight(flight(&course, "lines", 900, 1)),
    ];
    let (skill, next) = course.next(&standing(&both), 1).expect("something");
    assert_eq!(
        (skill, next.id.as_str()),
        (Skill::K5, "links"),
        "the least likely skill"
    );
}

#[test]
fn a_drill_is_advised_once_its_mission_was_tried_and_easy_missions_come_first() {
    let trains = |id: &str, skill, tier, drill_of: Option<&str>| Offer {
        skills: vec![skill],
        tier,
        drill_of: drill_of.map(str::to_owned),
        ..offer(id, 1, &[], &[])
    };
    let course = MissionCourse::new([
        trains("relay", Skill::K5, 2, None),
        trains("plume", Skill::K6, 1, None),
        trains("drill", Skill::K6, 0, Some("plume")),
    ]);
    let next = |entries: &[CareerEntry]| {
        let standing = standing(entries);
        let (_, offer) = course.next(&standing, 1).expect("something");
        offer.id.clone()
    };
    assert_eq!(next(&[]), "plume");
    let failed = CareerFlight {
        passed: false,
        evidence: Vec::new(),
        ..flight(&course, "plume", 100, 1)
    };
    assert_eq!(next(&[CareerEntry::Flight(failed)]), "drill");
}

#[test]
fn a_skill_is_trained_by_the_best_mission_that_is_open() {
    let trains = |id: &str, skill, tier, after: &[&str]| Offer {
        skills: vec![skill],
        tier,
        ..offer(id, 1, after, &[])
    };
    let course = MissionCourse::new([
        trains("relay", Skill::K5, 2, &[]),
        trains("link", Skill::K5, 1, &[]),
        trains("plume", Skill::K6, 0, &["relay"]),
    ]);
    let training = |skill| {
        let offer = course.training(skill, &CareerStanding::default(), 1);
        offer.map(|offer| offer.id.clone())
    };
    assert_eq!(training(Skill::K5).as_deref(), Some("link"));
    assert_eq!(training(Skill::K6), None, "it is locked");
    assert_eq!(training(Skill::K7), None, "none trains it");
}

#[test]
fn the_drill_of_a_mission_that_is_locked_again_is_not_advised() {
    let course = MissionCourse::new([
        offer("one", 1, &["never"], &[]),
        Offer {
            drill_of: Some("one".to_owned()),
            ..offer("drill", 1, &[], &[])
        },
    ]);
    let tries = ["one", "drill"].map(|id| CareerFlight {
        passed: id == "drill",
        ..flight(&course, id, 600, 1)
    });
    let standing = standing(&tries.map(CareerEntry::Flight));
    assert_eq!(course.next(&standing, 1), None);
}

#[test]
fn the_next_lesson_follows_from_the_last_one_flown() {
    let trains = |id: &str, skill, after: &[&str]| Offer {
        skills: vec![skill],
        ..offer(id, 1, after, &[])
    };
    let course = MissionCourse::new([
        trains("wing", Skill::K3, &[]),
        trains("plume", Skill::K6, &[]),
        trains("mast", Skill::K3, &["wing"]),
        trains("line", Skill::K7, &["plume"]),
        Offer {
            drill_of: Some("wing".to_owned()),
            ..trains("give way", Skill::K5, &[])
        },
    ]);
    let mut entries = Vec::new();
    let mut next = |flown: &str| {
        entries.push(CareerEntry::Flight(flight(&course, flown, 900, 1)));
        let (_, offer) = course.next(&standing(&entries), 1).expect("something");
        offer.id.clone()
    };
    assert_eq!(next("wing"), "give way", "a weak skill gets a drill");
    assert_eq!(next("plume"), "line", "the drill is of an earlier mission");
    assert_eq!(next("line"), "mast", "the only new mission");
    assert_eq!(next("mast"), "give way", "nothing else is new");
}
