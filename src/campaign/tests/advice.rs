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
