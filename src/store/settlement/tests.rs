use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, UNIX_EPOCH};

use super::*;
use crate::campaign::{CareerEntry, CareerStanding, Evidence, ExamKey, exam_seed};
use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::record::Occasion;
use crate::scoring::{FlightBackend, FlownBy};
use crate::store::RunFile;
use crate::store::runs::INPUTS;
use crate::workshop::part;

const BEGUN: &str = "2026-11-20T14:03:22Z";

fn profiles(data: &Path) -> Profiles {
    Profiles::open(data).expect("a folder of our own").0
}

/// Records a flight without commands, with or without its end; returns the mission and the report.
fn recorded(
    runs: &Runs,
    profile: Option<&str>,
    is_finished: bool,
) -> (String, Arc<Mission>, Report) {
    let source = include_str!("../../../missions/drills/d00-arm-and-hover.toml");
    let mission = Arc::new(Mission::parse(source).expect("no faults"));
    let script = Script::parse("all guided\nall arm\n", &Context::default());
    let script = script.expect("two commands");
    let mut exercise = Exercise::new(Arc::clone(&mission), 1, script, Vec::new());
    let mut file = runs.begin(&mission.id, BEGUN).expect("writable");
    exercise.record_inputs();
    exercise.flight_mut().start_record(&Occasion {
        flown_by: FlownBy::Hand,
        when: BEGUN.to_owned(),
        backend: FlightBackend::Embedded,
        profile: profile.map(str::to_owned),
        stake: Stake::Graded,
    });
    while exercise.now() < Duration::from_secs(12) {
        exercise.step();
    }
    exercise.flight_mut().abandon();
    let mut record = exercise.flight_mut().take_record();
    let report = exercise.close();
    if is_finished {
        record += &exercise.flight_mut().take_record();
    }
    file.append(&record).expect("writable");
    exercise.close_inputs();
    let inputs = RecordFiles::beside(file.path()).stem + INPUTS;
    fs::write(runs.folder().join(inputs), exercise.take_inputs()).expect("writable");
    (file.id().to_owned(), mission, report)
}

#[test]
fn a_finished_record_that_nobody_stored_is_made_up_for_once() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    let anna = profiles.create("Anna", BEGUN).expect("new");
    let (id, mission, report) = recorded(&runs, Some("anna"), true);
    recorded(&runs, Some("Borys"), true);
    recorded(&runs, None, true);
    let recovered = recover(&mut profiles, &runs).expect("writable");
    assert_eq!(recovered.len(), 1, "{recovered:?}");
    assert_eq!(
        (recovered[0].profile.as_str(), recovered[0].score),
        ("Anna", report.score)
    );
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
    let stored = profiles.runs(&anna).expect("readable");
    assert_eq!(stored.len(), 1);
    let landing = Landing {
        id,
        is_recorded: true,
        when: UNIX_EPOCH,
        stake: Stake::Graded,
    };
    let run = RunEntry::of(&mission, &report, landing);
    // The same as if stored when it ended, except for the day. Texts are compared in English.
    let json = |evidence: &[Evidence]| serde_json::to_string(evidence).expect("plain");
    let flight = &stored[0].flight;
    assert_eq!(json(&flight.evidence), json(&run.flight.evidence));
    let expected = CareerFlight {
        day: flight.day,
        evidence: flight.evidence.clone(),
        ..run.flight.clone()
    };
    assert_eq!(*flight, expected);
    assert!(
        !profiles.store(&anna, &run).expect("known"),
        "it counts once"
    );
}

#[test]
fn a_profile_that_is_younger_than_a_record_does_not_get_it() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    profiles
        .create("Anna", "2026-11-20T14:03:23Z")
        .expect("new");
    recorded(&runs, Some("Anna"), true);
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
}

#[test]
fn a_record_that_was_cut_or_changed_harms_nobody() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    profiles.create("Anna", BEGUN).expect("new");
    let (id, ..) = recorded(&runs, Some("Anna"), true);
    let path = runs.folder().join(format!("{id}{ENDING}"));
    let whole = fs::read_to_string(&path).expect("just written");
    let middle = whole.len() / 2;
    for broken in [
        &whole[..middle],
        "",
        "{}\n",
        &whole.replacen("\"t\":", "\"x\":", 3),
    ] {
        fs::write(&path, broken).expect("writable");
        assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
    }
    fs::write(&path, &whole).expect("writable");
    assert_eq!(recover(&mut profiles, &runs).expect("writable").len(), 1);
}

#[test]
fn a_record_that_was_changed_or_lacks_its_inputs_is_practice() {
    type Forge = fn(&Path, &str);
    let forgeries: [Forge; 4] = [
        |run, text| {
            let other = text.replacen("\"profile\":\"Anna\"", "\"profile\":\"Borys\"", 1);
            fs::write(run, other).expect("writable");
        },
        |run, text| {
            let (before, after) = text.split_once(",\"checksum\":\"").expect("a checksum");
            let (_, after) = after.split_once('"').expect("its end");
            fs::write(run, format!("{before}{after}")).expect("writable");
        },
        |run, _| fs::remove_file(RecordFiles::beside(run).inputs.expect("inputs")).expect("there"),
        |run, text| {
            let other = text.replacen("\"embedded\"", "\"ardupilot\"", 1);
            fs::write(run, other).expect("writable");
        },
    ];
    for (index, forge) in forgeries.into_iter().enumerate() {
        let data = tempfile::tempdir().expect("a folder");
        let runs = Runs::within(data.path());
        let mut profiles = profiles(data.path());
        profiles.create("Anna", BEGUN).expect("new");
        profiles.create("Borys", BEGUN).expect("new");
        let (id, ..) = recorded(&runs, Some("Anna"), true);
        let path = runs.folder().join(format!("{id}{ENDING}"));
        forge(&path, &fs::read_to_string(&path).expect("just written"));
        let recovered = recover(&mut profiles, &runs).expect("writable");
        let reduced: Vec<_> = recovered.iter().map(|one| &one.reduced[..]).collect();
        let expected: &[PracticeReason] = &[PracticeReason::UnconfirmedRecord];
        assert_eq!(reduced, [expected], "forgery {index}");
    }
}

#[test]
fn own_drones_wear_and_lent_ones_do_not() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let mission = || Mission::parse(source).expect("no faults");
    let script = Script::parse("", &Context::default()).expect("nothing to do");
    let mut report = Exercise::new(Arc::new(mission()), 1, script, Vec::new()).report();
    report.usage = vec![crate::scoring::UseReport {
        vehicle: 1,
        airborne_s: 600.0,
        productive_s: 600.0,
        idle_s: 0.0,
        crashed: true,
    }];
    let starter = crate::campaign::STARTER_PARTS.iter();
    let starter = starter.fold(Design::new("Starter"), |it, id| {
        it.with(part(id).expect("known"))
    });
    let entry = |mission: &Mission| {
        let landing = Landing {
            id: "a".to_owned(),
            is_recorded: false,
            when: UNIX_EPOCH,
            stake: Stake::Graded,
        };
        RunEntry::of(mission, &report, landing)
    };
    let lent = entry(&mission());
    assert_eq!((lent.flight.wear, lent.airframes.len()), (0, 0));
    let own = mission().with_fleet(vec![starter]).expect("it flies");
    let own = entry(&own);
    assert!(own.flight.wear > 100, "{}", own.flight.wear);
    assert_eq!((own.airframes.len(), own.recording), (1, None));
    let standing = CareerStanding::of(&[CareerEntry::Flight(own.flight)]);
    assert!(standing.credits() < 500);
}

/// Starts the record of an exam of drill d00 with this seed and a few seconds of flight.
fn exam(runs: &Runs, seed: u64) -> RunFile {
    exam_of(runs, seed, Duration::from_secs(12))
}

fn exam_of(runs: &Runs, seed: u64, length: Duration) -> RunFile {
    let source = include_str!("../../../missions/drills/d00-arm-and-hover.toml");
    let mission = Arc::new(
        Mission::parse(source)
            .expect("no faults")
            .flown_for(Stake::Exam),
    );
    let script = Script::parse("all guided\nall arm\n", &Context::default()).expect("two commands");
    let mut exercise = Exercise::new(Arc::clone(&mission), seed, script, Vec::new());
    let mut file = runs.begin(&mission.id, BEGUN).expect("writable");
    exercise.flight_mut().start_record(&Occasion {
        flown_by: FlownBy::Hand,
        when: BEGUN.to_owned(),
        backend: FlightBackend::Embedded,
        profile: Some("Anna".to_owned()),
        stake: Stake::Exam,
    });
    while exercise.now() < length {
        exercise.step();
    }
    let record = exercise.flight_mut().take_record();
    file.append(&record).expect("writable");
    file
}

fn the_exam_seed() -> u64 {
    let source = include_str!("../../../missions/drills/d00-arm-and-hover.toml");
    let mission = Mission::parse(source).expect("no faults");
    exam_seed(ExamKey::of("Anna", BEGUN), &mission.id, mission.rev, 0)
}

#[test]
fn an_exam_of_which_only_the_brief_was_read_is_none() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    profiles.create("Anna", BEGUN).expect("new");
    drop(exam_of(&runs, the_exam_seed(), Duration::ZERO));
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
}

#[test]
fn an_exam_that_was_left_counts_as_ended_there_once_nobody_flies_it() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    let anna = profiles.create("Anna", BEGUN).expect("new");
    let flown = exam(&runs, the_exam_seed());
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
    drop(flown);
    let recovered = recover(&mut profiles, &runs).expect("writable");
    assert_eq!(recovered.len(), 1);
    assert_eq!(recovered[0].left, Some(LeftFlight::Exam));
    assert!(recovered[0].reduced.is_empty());
    let stored = profiles.runs(&anna).expect("readable");
    assert_eq!(
        (stored[0].flight.stake, stored[0].flight.passed),
        (Stake::Exam, false)
    );
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
}

#[test]
fn a_graded_flight_that_was_killed_counts_as_left_once_and_is_told() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    let anna = profiles.create("Anna", BEGUN).expect("new");
    recorded(&runs, Some("Anna"), false);
    recorded(&runs, Some("Borys"), false);
    recorded(&runs, None, false);
    let recovered = recover(&mut profiles, &runs).expect("writable");
    assert_eq!(recovered.len(), 1, "{recovered:?}");
    assert_eq!(recovered[0].left, Some(LeftFlight::Attempt));
    let said = recovered[0].text().to_string();
    assert!(said.contains("counts as given up"), "{said}");
    let stored = profiles.runs(&anna).expect("readable");
    let flight = &stored[0].flight;
    assert_eq!(
        (flight.stake, flight.score, flight.passed),
        (Stake::Graded, 0, false)
    );
    assert_eq!(recover(&mut profiles, &runs).expect("writable"), []);
}

/// The program may be killed while a line is being written.
#[test]
fn a_graded_flight_whose_last_line_is_torn_counts_as_left() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    profiles.create("Anna", BEGUN).expect("new");
    let (id, ..) = recorded(&runs, Some("Anna"), false);
    let path = runs.folder().join(format!("{id}{ENDING}"));
    let whole = fs::read(&path).expect("just written");
    fs::write(&path, &whole[..whole.len() - 3]).expect("writable");
    let recovered = recover(&mut profiles, &runs).expect("writable");
    assert_eq!(recovered.len(), 1, "{recovered:?}");
    assert_eq!(recovered[0].left, Some(LeftFlight::Attempt));
}

#[test]
fn a_record_counts_for_no_more_than_the_career_allows() {
    let data = tempfile::tempdir().expect("a folder");
    let runs = Runs::within(data.path());
    let mut profiles = profiles(data.path());
    let anna = profiles.create("Anna", BEGUN).expect("new");
    // An exam with a seed that no exam has; a mission with a changed text.
    drop(exam(&runs, 1));
    let (id, ..) = recorded(&runs, Some("Anna"), true);
    let path = runs.folder().join(format!("{id}{ENDING}"));
    let whole = fs::read_to_string(&path).expect("just written");
    let rewritten = whole.replacen("ceiling = 30", "ceiling = 31", 1);
    assert_ne!(whole, rewritten);
    fs::write(&path, rewritten).expect("writable");
    let mut recovered = recover(&mut profiles, &runs).expect("writable");
    recovered.sort_by_key(|one| one.left.is_none());
    let reduced: Vec<&[PracticeReason]> = recovered.iter().map(|one| &one.reduced[..]).collect();
    let expected: [&[PracticeReason]; 2] = [
        &[PracticeReason::ChosenSeed],
        &[
            PracticeReason::AlteredMission,
            PracticeReason::UnconfirmedRecord,
        ],
    ];
    assert_eq!(reduced, expected);
    let stored = profiles.runs(&anna).expect("readable");
    assert!(stored.iter().all(|run| run.flight.stake == Stake::Practice));
}
