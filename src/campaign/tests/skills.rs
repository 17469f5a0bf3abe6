//! Skills, and a flight's evidence on them.

use super::*;

#[test]
fn a_skill_is_mastered_over_missions_and_days_and_comes_due_again() {
    let mut known = Knowledge::default();
    assert_eq!(known.mastery(0), Mastery::Unknown);
    for _ in 0..6 {
        known.observe(1.0, 1, "one", 10);
    }
    assert_eq!(known.lacks(10), [Lack::Missions(1), Lack::Days(1)]);
    assert_eq!(
        known.mastery(10),
        Mastery::Learning,
        "one mission on one day"
    );
    known.observe(1.0, 1, "two", 11);
    assert_eq!(known.mastery(11), Mastery::Mastered);
    assert_eq!(known.lacks(11), []);
    let due = known.due_day().expect("mastered");
    assert_eq!(
        known.mastery(due - 1),
        Mastery::Mastered,
        "due on day {due}"
    );
    assert_eq!(known.mastery(due + 1), Mastery::Due);
    known.observe(1.0, 1, "two", due + 1);
    assert!(
        known.due_day().expect("mastered") - (due + 1) > due - 11,
        "a review lasts longer"
    );
}

#[test]
fn one_flight_moves_a_skill_a_quarter_at_most_however_often_it_shows_it() {
    let seen = |outcome| Evidence {
        skill: Skill::K3,
        outcome,
        basis: None,
        what: Text::default(),
    };
    let course = course();
    let flown = |outcomes: &[f64]| {
        CareerEntry::Flight(CareerFlight {
            evidence: outcomes.iter().copied().map(seen).collect(),
            ..flight(&course, "one", 900, 1)
        })
    };
    let chance = |flights: &[CareerEntry]| standing(flights).skill(Skill::K3).chance(1);
    let one = flown(&[1.0, 1.0, 1.0]);
    assert!((chance(std::slice::from_ref(&one)) - 0.45).abs() < 1e-9);
    assert_eq!(
        standing(std::slice::from_ref(&one))
            .skill(Skill::K3)
            .opportunities(),
        1
    );
    let twice = vec![one; 2];
    let high = chance(&twice);
    let fallen = chance(&[twice, vec![flown(&[0.0, 0.0])]].concat());
    let lost = high - fallen;
    assert!(lost > 0.1 && lost < 0.25 + 1e-9, "{high} {fallen}");
}

#[test]
fn what_a_kept_flight_has_shown_is_named_in_all_languages() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let mission = Mission::parse(source).expect("it is good");
    let course = MissionCourse::new([Offer::of(&mission)]);
    let seen = |basis| Evidence {
        skill: Skill::K1,
        outcome: 1.0,
        basis,
        what: "as it was called".into(),
    };
    let kept = CareerFlight {
        evidence: vec![
            seen(Some(EvidenceBasis::Objective("armed".to_owned()))),
            seen(Some(EvidenceBasis::Objective("gone".to_owned()))),
            seen(None),
        ],
        ..flight(&course, &mission.id, 700, 1)
    };
    let ukrainian = Locale::new(Language::Ukrainian);
    let named = course.translated(kept).evidence;
    let words = |at: usize| ukrainian.text(&named[at].what);
    assert_eq!(words(0), "активація за хвилину");
    assert_eq!(words(1), "as it was called");
    assert_eq!(words(2), "as it was called");
}
