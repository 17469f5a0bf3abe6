mod advice;
mod kinds;
mod properties;
mod reward;
mod skills;

use std::collections::{BTreeMap, BTreeSet};

use super::{
    Best, CareerEntry, CareerFlight, CareerProgress, CareerStanding, Evidence, EvidenceBasis,
    ExamKey, ExamResult, Knowledge, Lack, LockReason, Mastery, MissionCourse, MissionStage, Offer,
    PartState, PurchaseRefusal, STARTER_PARTS, Skill, Stake, daily_seed, exam_seed, licence_price,
};
use crate::mission::{Mission, Requires};
use crate::scoring::{FlownBy, Medal};
use crate::text::{Language, Locale, Text};
use crate::workshop::{Design, part, parts};

fn offer(id: &str, vehicles: u8, after: &[&str], parts: &[&str]) -> Offer {
    let owned = |list: &[&str]| list.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>();
    Offer {
        id: id.to_owned(),
        title: Text::verbatim(id.to_owned()),
        tier: 1,
        vehicles,
        drill_of: None,
        requires: Requires {
            missions: owned(after),
            ..Requires::default()
        },
        credits: 400,
        parts: owned(parts),
        kinds: Vec::new(),
        skills: vec![Skill::K3],
        objectives: BTreeMap::new(),
    }
}

fn course() -> MissionCourse {
    MissionCourse::new([
        offer("one", 1, &[], &["s_gas4"]),
        offer("two", 1, &["one"], &[]),
        offer("three", 3, &["two"], &["s_gpr"]),
        offer("four", 3, &["three"], &[]),
        offer("eight", 8, &["four"], &[]),
        Offer {
            drill_of: Some("three".to_owned()),
            ..offer("drill", 1, &[], &[])
        },
    ])
}

fn medal(score: u16) -> Option<Medal> {
    match score {
        850.. => Some(Medal::Gold),
        700.. => Some(Medal::Silver),
        550.. => Some(Medal::Bronze),
        _ => None,
    }
}

fn flight(course: &MissionCourse, mission: &str, score: u16, day: i64) -> CareerFlight {
    let offer = course.offer(mission).expect("known");
    CareerFlight {
        mission: mission.to_owned(),
        drill_of: offer.drill_of.clone(),
        tier: offer.tier,
        reward: offer.credits,
        vehicles: offer.vehicles,
        stake: Stake::Graded,
        flown_by: None,
        day,
        score,
        passed: score >= 550,
        medal: medal(score),
        evidence: vec![Evidence {
            skill: Skill::K3,
            outcome: f64::from(score) / 1000.0,
            basis: None,
            what: Text::default(),
        }],
        wear: 0,
        imported: false,
    }
}

fn standing(entries: &[CareerEntry]) -> CareerStanding {
    CareerStanding::of(entries)
}

#[test]
fn a_first_pass_pays_and_a_better_one_pays_the_difference() {
    let course = course();
    let fly = |score| CareerEntry::Flight(flight(&course, "one", score, 1));
    let credits = |scores: &[u16]| {
        let entries: Vec<CareerEntry> = scores.iter().map(|score| fly(*score)).collect();
        standing(&entries).credits() - 500
    };
    assert_eq!(credits(&[500]), 0);
    assert_eq!(credits(&[800]), 360);
    assert_eq!(
        credits(&[500, 800]),
        360,
        "what failed before takes nothing away"
    );
    assert_eq!(credits(&[800, 800, 700]), 360, "grinding pays nothing");
    assert_eq!(credits(&[800, 900]), 400);
}

#[test]
fn practice_earns_nothing_and_moves_no_skill() {
    let course = course();
    let flown = CareerFlight {
        stake: Stake::Practice,
        ..flight(&course, "one", 1000, 1)
    };
    let standing = standing(&[CareerEntry::Flight(flown)]);
    assert_eq!(standing.credits(), 500);
    assert_eq!(standing.experience().0, 0);
    assert!(!standing.has_passed("one"));
    assert_eq!(standing.skill(Skill::K3).opportunities(), 0);
}

#[test]
fn a_flight_that_fails_brings_no_experience() {
    let course = course();
    let fly = |score| CareerEntry::Flight(flight(&course, "one", score, 1));
    assert_eq!(standing(&[fly(540)]).experience().0, 0);
    let passed = standing(&[fly(600)]).experience();
    assert!(passed.0 > 0);
    assert_eq!(standing(&[fly(540), fly(600)]).experience(), passed);
}

#[test]
fn only_a_better_score_brings_experience_again() {
    let course = course();
    let experience = |flown: &[(Stake, u16)]| {
        let entries = flown.iter().map(|&(stake, score)| {
            CareerEntry::Flight(CareerFlight {
                stake,
                ..flight(&course, "one", score, 1)
            })
        });
        standing(&entries.collect::<Vec<_>>()).experience().0
    };
    for stake in [Stake::Graded, Stake::Exam] {
        let first = experience(&[(stake, 800)]);
        assert!(first > 0);
        for again in [700, 800] {
            assert_eq!(experience(&[(stake, 800), (Stake::Exam, again)]), first);
            assert_eq!(experience(&[(stake, 800), (Stake::Graded, again)]), first);
        }
        assert!(experience(&[(stake, 800), (Stake::Exam, 801)]) > first);
    }
}

#[test]
fn the_best_exam_of_a_mission_is_kept_whether_passed_or_not() {
    let course = course();
    let fly = |stake, score| {
        CareerEntry::Flight(CareerFlight {
            stake,
            ..flight(&course, "one", score, 1)
        })
    };
    let exam = |entries: &[CareerEntry]| standing(entries).best("one").and_then(|it| it.exam);
    let (graded, failed) = (fly(Stake::Graded, 900), fly(Stake::Exam, 300));
    let passed = fly(Stake::Exam, 600);
    assert_eq!(exam(std::slice::from_ref(&graded)), None);
    let result = |passed, score| Some(ExamResult { passed, score });
    assert_eq!(exam(&[graded, failed.clone()]), result(false, 300));
    assert_eq!(exam(&[failed.clone(), passed.clone()]), result(true, 600));
    assert_eq!(exam(&[passed, failed]), result(true, 600));
}

#[test]
fn the_seed_of_a_day_counts_once_a_day_in_each_mission() {
    let course = course();
    let daily = |mission, score, day| {
        CareerEntry::Flight(CareerFlight {
            stake: Stake::Daily,
            ..flight(&course, mission, score, day)
        })
    };
    let first = standing(&[daily("one", 600, 1)]);
    let again = standing(&[daily("one", 600, 1), daily("one", 900, 1)]);
    assert_eq!(again.credits(), first.credits());
    assert_eq!(again.experience(), first.experience());
    assert_eq!(again.best("one"), first.best("one"));
    assert!(first.has_passed("one") && first.credits() > 500);
    for other in [daily("one", 900, 2), daily("two", 900, 1)] {
        let both = standing(&[daily("one", 600, 1), other]);
        assert!(both.credits() > first.credits());
    }
}

#[test]
fn a_part_that_is_missing_twice_is_told_once() {
    let toml = include_str!("../../designs/starter.toml");
    let (load, other) = (part("s_med"), part("s_rgb"));
    let (load, other) = (load.expect("a part"), other.expect("a part"));
    let design = Design::from_toml(toml)
        .expect("it is good")
        .with(load)
        .with(other)
        .with(load);
    let on_board = design.pieces().filter(|(it, _)| it.id == load.id);
    assert_eq!(on_board.count(), 2, "with another one between them");
    let missing: Vec<&str> = standing(&[])
        .missing_parts(&design, &course())
        .iter()
        .map(|(part, _)| part.id)
        .collect();
    assert_eq!(missing, ["s_med", "s_rgb"]);
}

#[test]
fn a_repeated_seed_of_the_day_is_no_best() {
    let course = course();
    let daily = |score| {
        CareerEntry::Flight(CareerFlight {
            stake: Stake::Daily,
            ..flight(&course, "one", score, 1)
        })
    };
    let progress = CareerProgress::of(&course, &[daily(600), daily(900)], 1);
    let one = &progress.missions[0];
    assert_eq!((one.best, one.medal), (Some(600), Some(Medal::Bronze)));
    assert_eq!((one.tries, one.last), (2, Some(900)));
}

#[test]
fn what_a_script_flew_or_what_was_practised_is_no_try() {
    let course = course();
    let flown = |stake, flown_by, score| {
        CareerEntry::Flight(CareerFlight {
            stake,
            flown_by: Some(flown_by),
            ..flight(&course, "one", score, 1)
        })
    };
    let history = [
        flown(Stake::Practice, FlownBy::Script, 900),
        flown(Stake::Practice, FlownBy::Hand, 300),
        flown(Stake::Graded, FlownBy::Hand, 600),
    ];
    let progress = CareerProgress::of(&course, &history, 1);
    let one = &progress.missions[0];
    assert_eq!((one.tries, one.first, one.last), (1, Some(600), Some(600)));
    assert_eq!(progress.flights, 3);
}

#[test]
fn a_flight_without_points_is_no_best() {
    let course = course();
    let failed = CareerFlight {
        passed: false,
        medal: None,
        ..flight(&course, "one", 0, 1)
    };
    let standing = CareerStanding::of(&[CareerEntry::Flight(failed)]);
    let best = standing.best("one").expect("it counts as a try");
    assert_eq!((best.tries, best.score), (1, None));
}

#[test]
fn what_is_locked_says_what_to_do() {
    let course = course();
    let stage = |entries: &[CareerEntry], id: &str| {
        course.stage(course.offer(id).expect("known"), &standing(entries), 1)
    };
    assert_eq!(stage(&[], "one"), MissionStage::Open);
    let MissionStage::Locked(reasons) = stage(&[], "three") else {
        panic!("three drones without a licence");
    };
    let pass = LockReason::Pass(Text::verbatim("two"));
    assert_eq!(reasons, [pass, LockReason::Licence(3, 1)]);
    assert_eq!(reasons[0].text().to_string(), "pass two");
    assert!(
        matches!(stage(&[], "drill"), MissionStage::Locked(_)),
        "locked with its mission"
    );
    let passed = ["one", "two"].map(|id| CareerEntry::Flight(flight(&course, id, 600, 1)));
    assert_eq!(stage(&passed, "three"), MissionStage::Open);
    assert_eq!(stage(&passed, "drill"), MissionStage::Open);
    assert_eq!(
        stage(&passed, "one"),
        MissionStage::Passed(Some(Medal::Bronze))
    );
}

#[test]
fn the_licence_grows_with_what_was_shown() {
    let course = course();
    let licence = |flown: &[(&str, u16)]| {
        let entries: Vec<CareerEntry> = flown
            .iter()
            .map(|(id, score)| CareerEntry::Flight(flight(&course, id, *score, 1)))
            .collect();
        standing(&entries).licence()
    };
    assert_eq!(licence(&[]), 1);
    assert_eq!(licence(&[("one", 600)]), 2);
    assert_eq!(
        licence(&[("one", 600), ("one", 900)]),
        2,
        "two missions, not two passes"
    );
    assert_eq!(licence(&[("one", 600), ("two", 600)]), 4);
    assert_eq!(licence(&[("three", 700), ("four", 700)]), 8);
    assert_eq!(licence(&[("three", 600), ("four", 900)]), 4);
    assert_eq!(licence(&[("eight", 700)]), 16);
    assert_eq!(licence(&[("eight", 900)]), 32);
}

#[test]
fn parts_are_bought_once_unlocked_and_paid_for() {
    let course = course();
    let new = CareerStanding::default();
    let state =
        |standing: &CareerStanding, id| standing.part_state(part(id).expect("known"), &course);
    assert_eq!(state(&new, STARTER_PARTS[0]), PartState::Owned);
    assert_eq!(state(&new, "s_gas4"), PartState::Locked("one".to_owned()));
    assert_eq!(
        new.buy("s_gas4", &course),
        Err(PurchaseRefusal::Locked("one".to_owned()))
    );
    assert_eq!(new.buy("nothing", &course), Err(PurchaseRefusal::Unknown));
    assert_eq!(new.buy("fr_450q", &course), Err(PurchaseRefusal::Owned));
    assert_eq!(
        new.buy("r_mesh24", &course),
        Ok(super::Purchase {
            part: "r_mesh24".to_owned(),
            credits: 404
        })
    );
    assert_eq!(new.buy("s_magx", &course), Err(PurchaseRefusal::Unknown));
    let mut rich = new.clone();
    rich.enter(&CareerEntry::Flight(flight(&course, "one", 600, 1)));
    let purchase = rich.buy("s_gas4", &course).expect("on sale");
    assert_eq!(purchase.credits, licence_price(480));
    rich.enter(&CareerEntry::Purchase(purchase.clone()));
    assert_eq!(state(&rich, "s_gas4"), PartState::Owned);
    let credits = rich.credits();
    rich.enter(&CareerEntry::Purchase(purchase));
    assert_eq!(rich.credits(), credits, "the same entry twice is paid once");
    assert_eq!(
        rich.buy("r_mesh24", &course),
        Ok(super::Purchase {
            part: "r_mesh24".to_owned(),
            credits: 404
        })
    );
}

#[test]
fn starter_parts_exist_and_fly() {
    let design = STARTER_PARTS
        .iter()
        .fold(crate::workshop::Design::new("starter"), |design, id| {
            design.with(part(id).expect("known"))
        });
    let air = crate::workshop::Air::default();
    assert!(design.is_airworthy(air), "{:?}", design.findings(air));
}

#[test]
fn seeds_differ_by_day_and_exam() {
    let days: BTreeSet<u64> = (20_000..20_400).map(daily_seed).collect();
    assert!(days.len() >= 399);
    let exam = |mission, revision, taken| {
        exam_seed(
            ExamKey::of("Anna", "2026-11-20T08:00:00Z"),
            mission,
            revision,
            taken,
        )
    };
    assert_ne!(exam("one", 1, 0), exam("two", 1, 0));
    assert_ne!(exam("one", 1, 0), exam("one", 2, 0));
    assert_eq!(exam("one", 1, 0), exam("one", 1, 0));
    let tries: BTreeSet<u64> = (0..50).map(|taken| exam("one", 1, taken)).collect();
    assert_eq!(tries.len(), 50);
}

#[test]
fn the_best_of_a_mission_is_kept_apart_by_pass_and_medal() {
    let course = course();
    let entries =
        [700, 500, 900].map(|score| CareerEntry::Flight(flight(&course, "one", score, 1)));
    let best = *standing(&entries).best("one").expect("flown");
    assert_eq!(
        (best.tries, best.score, best.passed, best.medal),
        (3, Some(900), Some(900), Some(Medal::Gold))
    );
    assert_eq!(standing(&[]).best("one"), None::<&Best>);
}
