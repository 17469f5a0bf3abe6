//! The stakes of attempts.

use std::collections::BTreeSet;

use proptest::prelude::*;
use proptest::sample::select;

use super::*;
use crate::campaign::{CareerEntry, CareerFlight, Offer};

const FIRST_FLIGHT: &str = include_str!("../../../missions/00-first-flight.toml");
const FORMATION: &str = include_str!("../../../missions/02-formation.toml");

const STAKES: [Stake; 4] = [Stake::Graded, Stake::Practice, Stake::Exam, Stake::Daily];
const USUAL: AttemptMeans = AttemptMeans {
    mission_file: MissionFile::Course,
    flown_by: FlownBy::Hand,
    has_own_airframes: false,
    speedup: 1.0,
    has_crew: false,
};

fn mission(text: &str) -> Mission {
    Mission::parse(text).expect("no faults")
}

/// A new trainee, for whom only the first of these missions is open.
struct Newcomer {
    open: Mission,
    locked: Mission,
    course: MissionCourse,
    standing: CareerStanding,
}

fn anna() -> ExamKey {
    ExamKey::of("Anna", "2026-11-20T08:00:00Z")
}

impl Newcomer {
    fn new() -> Self {
        let (open, locked) = (mission(FIRST_FLIGHT), mission(FORMATION));
        Self {
            course: MissionCourse::new([&open, &locked].map(Offer::of)),
            open,
            locked,
            standing: CareerStanding::default(),
        }
    }

    fn trainee(&self) -> AttemptTrainee<'_> {
        AttemptTrainee {
            standing: &self.standing,
            course: &self.course,
            exams: anna(),
        }
    }

    fn terms(&self, wanted: Stake) -> AttemptTerms<'_> {
        AttemptTerms {
            drawn: None,
            mission: &self.open,
            wanted,
            seed: None,
            trainee: Some(self.trainee()),
            means: USUAL,
            day: 20_000,
            random: Some(77),
        }
    }
}

#[test]
fn a_try_counts_as_wanted_on_the_layout_of_its_stake() {
    let trainee = Newcomer::new();
    let open = &trainee.open;
    for (wanted, seed) in [
        (Stake::Graded, 77),
        (Stake::Practice, FIRST_SEED),
        (Stake::Exam, exam_seed(anna(), &open.id, open.rev, 0)),
        (Stake::Daily, daily_seed(20_000)),
    ] {
        let attempt = trainee.terms(wanted).decide();
        assert_eq!((attempt.stake, attempt.seed), (wanted, seed));
        assert!(!attempt.is_reduced());
    }
}

#[test]
fn an_exam_that_was_taken_is_never_given_again() {
    let mut trainee = Newcomer::new();
    let first = trainee.terms(Stake::Exam).decide();
    // After a restart the layout is known, so the attempt is practice.
    assert_eq!(first.repeated().stake, Stake::Practice);
    let left = CareerFlight {
        mission: trainee.open.id.clone(),
        drill_of: None,
        tier: 0,
        reward: 0,
        vehicles: 1,
        stake: Stake::Exam,
        flown_by: None,
        day: 20_000,
        score: 0,
        passed: false,
        medal: None,
        evidence: Vec::new(),
        wear: 0,
        imported: false,
    };
    trainee.standing.enter(&CareerEntry::Flight(left));
    let second = trainee.terms(Stake::Exam).decide();
    assert_eq!(second.stake, Stake::Exam);
    assert_ne!(second.seed, first.seed);
}

/// A colleague's exam layout may be practised, because no two trainees get the same one.
#[test]
fn no_two_trainees_get_the_same_exam() {
    let newcomer = Newcomer::new();
    let exam_of = |name: &str, since: &str| {
        let trainee = AttemptTrainee {
            exams: ExamKey::of(name, since),
            ..newcomer.trainee()
        };
        let terms = AttemptTerms {
            trainee: Some(trainee),
            ..newcomer.terms(Stake::Exam)
        };
        terms.decide().seed
    };
    let since = "2026-11-20T08:00:00Z";
    let colleagues = (0..500).map(|number| exam_of(&format!("trainee {number}"), since));
    let seeds: BTreeSet<u64> = colleagues.collect();
    assert_eq!(seeds.len(), 500);
    assert_eq!(exam_of("Anna", since), exam_of("anna", since));
    // A profile that was deleted and created again gets another exam.
    assert_ne!(
        exam_of("Anna", since),
        exam_of("Anna", "2026-11-20T08:00:01Z")
    );
}

#[test]
fn a_guest_gets_another_exam_each_time() {
    let newcomer = Newcomer::new();
    let seeds: BTreeSet<u64> = (0..50)
        .map(|random| {
            let terms = AttemptTerms {
                trainee: None,
                random: Some(random),
                ..newcomer.terms(Stake::Exam)
            };
            terms.decide().seed
        })
        .collect();
    assert_eq!(seeds.len(), 50);
}

proptest! {
    /// Covers the seeds drawn for graded, daily and practice flights.
    #[test]
    fn a_seed_that_was_practised_is_never_drawn_as_an_exam(
        random in any::<u64>(),
        day in 0_i64..40_000,
        name in "[a-z]{1,12}",
        taken in 0_u32..100,
    ) {
        let newcomer = Newcomer::new();
        let drawn = |wanted| {
            let terms = AttemptTerms { random: Some(random), day, ..newcomer.terms(wanted) };
            terms.decide().seed
        };
        let exam = exam_seed(ExamKey::of(&name, "2026-11-20T08:00:00Z"), &newcomer.open.id, 1, taken);
        for stake in [Stake::Graded, Stake::Daily, Stake::Practice] {
            prop_assert_ne!(drawn(stake), exam, "{:?}", stake);
        }
    }
}

#[test]
fn what_others_cannot_fly_is_practice_for_a_reason() {
    let trainee = Newcomer::new();
    let usual = trainee.terms(Stake::Graded);
    let flown_with = |means| AttemptTerms { means, ..usual };
    let frame = AttemptMeans {
        has_own_airframes: true,
        ..USUAL
    };
    let slow = AttemptMeans {
        speedup: 0.5,
        ..USUAL
    };
    let file = AttemptMeans {
        mission_file: MissionFile::Own,
        ..USUAL
    };
    let altered = AttemptMeans {
        mission_file: MissionFile::Altered,
        ..USUAL
    };
    let script = AttemptMeans {
        flown_by: FlownBy::Script,
        ..USUAL
    };
    let bundled = AttemptMeans {
        flown_by: FlownBy::BundledPilot,
        ..USUAL
    };
    let chosen = AttemptTerms {
        seed: Some(5),
        ..usual
    };
    for (terms, reason) in [
        (flown_with(frame), PracticeReason::OwnAirframes),
        (flown_with(slow), PracticeReason::SlowMotion),
        (flown_with(file), PracticeReason::OwnMission),
        (flown_with(altered), PracticeReason::AlteredMission),
        (flown_with(script), PracticeReason::Script),
        (flown_with(bundled), PracticeReason::Script),
        (chosen, PracticeReason::ChosenSeed),
    ] {
        assert_eq!(terms.decide().stake, Stake::Practice, "{reason:?}");
        assert_eq!(terms.practice_reasons(), [reason]);
    }
}

#[test]
fn a_locked_mission_and_one_of_nobodys_course_are_practice() {
    let trainee = Newcomer::new();
    let locked = AttemptTerms {
        mission: &trainee.locked,
        ..trainee.terms(Stake::Exam)
    };
    let reasons = locked.practice_reasons();
    assert!(matches!(reasons[..], [PracticeReason::Locked(_)]));
    let none = MissionCourse::default();
    let strange = AttemptTerms {
        trainee: Some(AttemptTrainee {
            standing: &trainee.standing,
            course: &none,
            exams: anna(),
        }),
        ..trainee.terms(Stake::Exam)
    };
    assert_eq!(strange.practice_reasons(), [PracticeReason::OwnMission]);
    assert!(locked.decide().is_reduced() && strange.decide().is_reduced());
}

#[test]
fn a_flight_with_the_seed_of_a_day_belongs_to_that_day() {
    let yesterday = daily_seed(19_999);
    for (stake, seed, expected) in [
        (Stake::Daily, daily_seed(20_000), (20_000, Stake::Daily)),
        (Stake::Daily, yesterday, (19_999, Stake::Daily)),
        (Stake::Daily, 5, (20_000, Stake::Practice)),
        (Stake::Exam, yesterday, (20_000, Stake::Exam)),
    ] {
        assert_eq!(day_and_stake(stake, seed, 20_000), expected);
    }
}

#[test]
fn without_a_trainee_tries_go_through_the_seeds_one_by_one() {
    let newcomer = Newcomer::new();
    let guest = AttemptTerms {
        trainee: None,
        ..newcomer.terms(Stake::Graded)
    };
    let first = guest.decide();
    let second = guest.decide_after(&first);
    assert_eq!((first.seed, second.seed), (1, 2));
    assert_eq!(second.stake, Stake::Graded);
}

proptest! {
    #[test]
    fn a_try_counts_as_wanted_or_for_practice(
        wanted in select(&STAKES[..]),
        seed in prop::option::of(any::<u64>()),
        random in prop::option::of(any::<u64>()),
        (is_known, is_locked) in any::<(bool, bool)>(),
        (is_of_course, is_by_hand, has_own_airframes) in any::<(bool, bool, bool)>(),
        speedup in 0.1_f64..4.0,
        day in 0_i64..40_000,
    ) {
        let newcomer = Newcomer::new();
        let usual = newcomer.terms(wanted);
        let terms = AttemptTerms {
            mission: if is_locked { &newcomer.locked } else { &newcomer.open },
            seed,
            trainee: usual.trainee.filter(|_| is_known),
            means: AttemptMeans {
                mission_file: if is_of_course { MissionFile::Course } else { MissionFile::Altered },
                flown_by: if is_by_hand { FlownBy::Hand } else { FlownBy::Script },
                has_own_airframes,
                speedup,
                has_crew: false,
            },
            day,
            random,
            ..usual
        };
        let first = terms.decide();
        let is_fair = !is_known
            || !is_locked && is_of_course && is_by_hand && !has_own_airframes && speedup >= 1.0;
        let is_free = wanted != Stake::Graded || seed.is_none();
        let expected = if is_fair && is_free { wanted } else { Stake::Practice };
        prop_assert_eq!((first.stake, first.wanted), (expected, wanted));
        // The stake does not change the layout.
        match wanted {
            Stake::Exam => prop_assert!(first.seed >= FRESH_SEEDS),
            Stake::Daily => prop_assert!(first.seed < FRESH_SEEDS),
            Stake::Graded | Stake::Practice => match seed {
                Some(chosen) => prop_assert_eq!(first.seed, chosen),
                None => prop_assert!(first.seed < FRESH_SEEDS),
            },
        }
        let next = terms.decide_after(&first);
        prop_assert_eq!((next.stake, next.wanted), (first.stake, first.wanted));
        let again = first.repeated();
        prop_assert_eq!(again.seed, first.seed);
        prop_assert_ne!(again.stake, Stake::Graded);
    }
}

#[test]
fn only_finished_tries_by_hand_that_count_take_free_hints() {
    let one = |score, is_practice| TryReport {
        attempt: 1,
        when: String::new(),
        score,
        medal: None,
        passed: false,
        seed: 1,
        revision: 1,
        is_practice,
    };
    let (practice, left) = (one(Some(900), true), one(None, false));
    assert_eq!(next_try([&practice, &left]), 1);
    assert_eq!(next_try([&practice, &one(Some(10), false)]), 2);
    for (stake, flown_by, expected) in [
        (Stake::Graded, None, false),
        (Stake::Exam, Some(FlownBy::Hand), false),
        (Stake::Graded, Some(FlownBy::Script), true),
        (Stake::Daily, Some(FlownBy::BundledPilot), true),
        (Stake::Practice, Some(FlownBy::Hand), true),
    ] {
        assert_eq!(is_practice(stake, flown_by), expected, "{stake:?}");
        let is_left = without_end(stake, flown_by) == WithoutEnd::Left;
        assert_eq!(is_left, !expected, "{stake:?}");
    }
}

fn claim(newcomer: &Newcomer, stake: Stake, seed: u64) -> FlightClaim<'_> {
    FlightClaim {
        mission: &newcomer.open,
        stake,
        seed,
        mission_file: None,
        flown_by: None,
        ended: 20_000,
        is_confirmed: true,
    }
}

#[test]
fn a_claim_holds_only_if_the_career_would_have_allowed_it() {
    let newcomer = Newcomer::new();
    let mission = &newcomer.open;
    let exam = exam_seed(anna(), &mission.id, mission.rev, 0);
    for (stake, seed, expected) in [
        (Stake::Graded, 5, Stake::Graded),
        (Stake::Practice, 5, Stake::Practice),
        (Stake::Exam, exam, Stake::Exam),
        (Stake::Exam, exam + 1, Stake::Practice),
        (Stake::Daily, daily_seed(20_000), Stake::Daily),
        (Stake::Daily, 5, Stake::Practice),
    ] {
        let settled = claim(&newcomer, stake, seed).settle(newcomer.trainee());
        assert_eq!(settled.stake, expected, "{stake:?} {seed}");
        let reduced: &[PracticeReason] = if expected == stake {
            &[]
        } else {
            &[PracticeReason::ChosenSeed]
        };
        assert_eq!(settled.reduced, reduced, "{stake:?} {seed}");
    }
    let yesterday = claim(&newcomer, Stake::Daily, daily_seed(19_999));
    assert_eq!(yesterday.settle(newcomer.trainee()).day, 19_999);
    let locked = FlightClaim {
        mission: &newcomer.locked,
        ..claim(&newcomer, Stake::Graded, 5)
    };
    let scripted = FlightClaim {
        flown_by: Some(FlownBy::Script),
        ..claim(&newcomer, Stake::Graded, 5)
    };
    for reduced in [locked, scripted] {
        let settled = reduced.settle(newcomer.trainee());
        assert_eq!(settled.stake, Stake::Practice);
        assert_eq!(settled.reduced.len(), 1);
    }
}

#[test]
fn exams_and_the_layout_of_the_day_are_flown_by_hand() {
    use AttemptRefusal::{DailyByScript, ExamByCrew, ExamByScript, ExamSpedUp};
    for (stake, flown_by, speedup, expected) in [
        (Stake::Exam, FlownBy::Hand, 1.0, None),
        (Stake::Exam, FlownBy::Hand, 2.0, Some(ExamSpedUp)),
        (Stake::Exam, FlownBy::Script, 1.0, Some(ExamByScript)),
        (Stake::Daily, FlownBy::Hand, 2.0, None),
        (
            Stake::Daily,
            FlownBy::BundledPilot,
            1.0,
            Some(DailyByScript),
        ),
        (Stake::Graded, FlownBy::Script, 2.0, None),
        (Stake::Practice, FlownBy::Script, 2.0, None),
    ] {
        let means = AttemptMeans {
            flown_by,
            speedup,
            ..USUAL
        };
        let refusal = AttemptRefusal::of(stake, &means);
        assert_eq!(refusal, expected, "{stake:?} {flown_by:?} {speedup}");
    }
    let crew = AttemptMeans {
        has_crew: true,
        ..USUAL
    };
    let refusal = |stake| AttemptRefusal::of(stake, &crew);
    assert_eq!(refusal(Stake::Exam), Some(ExamByCrew));
    assert_eq!(refusal(Stake::Graded), None);
}

#[test]
fn an_exam_of_a_desk_is_flown_by_guests_under_the_same_conditions() {
    let newcomer = Newcomer::new();
    let stake = |drawn, means| {
        let terms = AttemptTerms {
            drawn,
            trainee: None,
            means,
            ..newcomer.terms(Stake::Exam)
        };
        terms.decide().stake
    };
    let slow = AttemptMeans {
        speedup: 0.5,
        ..USUAL
    };
    let own = AttemptMeans {
        has_own_airframes: true,
        ..USUAL
    };
    assert_eq!(stake(Some(7), USUAL), Stake::Exam);
    assert_eq!(stake(Some(7), slow), Stake::Practice);
    assert_eq!(stake(Some(7), own), Stake::Practice);
    assert_eq!(stake(None, own), Stake::Exam, "nothing is stored");
}
