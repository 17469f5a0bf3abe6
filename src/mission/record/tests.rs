use super::*;
use crate::commands::{Goal, GoalComponent};
use crate::geo::LatLon;
use crate::language;
use crate::mission::fake::Pilot;
use crate::mission::fake::{do_nothing, fly_the_cells};
use crate::record::{Head as JournalHead, Subject};
use crate::scoring::{FlightBackend, FlownBy};
use crate::vehicle::{Unheard, Vehicle};

mod verbs;

fn occasion(stake: Stake) -> Occasion {
    Occasion {
        flown_by: FlownBy::Hand,
        when: "2026-11-20T14:03:22Z".to_owned(),
        backend: FlightBackend::Embedded,
        profile: None,
        stake,
    }
}

fn recorded() -> Pilot {
    let mut pilot = Pilot::new(7);
    pilot.flight.set_attempt(3);
    pilot.flight.start_record(&occasion(Stake::Practice));
    pilot
}

#[test]
fn nothing_is_added_to_a_record_after_a_line_that_cannot_be_read() {
    let (_, text) = eventful();
    let mut lines = text.split_inclusive('\n');
    let head = lines.next().expect("the head");
    let first = lines.next().expect("a line");
    let grown = |parts: &[&str]| {
        let mut flight = Stored::read(head)
            .and_then(|it| it.reenact())
            .expect("a head");
        for part in parts {
            flight.grow(part);
        }
        flight.lines.len()
    };
    assert_eq!(grown(&[first, first]), 2);
    assert_eq!(grown(&[first, "damage\n", first]), 1);
    assert_eq!(grown(&[&format!("damage\n{first}"), first]), 0);
}

/// Flies a few cells, with a refusal, a deed and an alert; gives up at the end.
fn eventful() -> (Report, String) {
    let mut pilot = recorded();
    pilot.command("1 arm", RowState::Refused);
    drop(
        pilot
            .flight
            .act(EntryId(0), &Deed::Predict { points: 640 }, &[1]),
    );
    pilot.take_off(20.0);
    pilot.hear("Battery 1 is low 10.70V used 341 mAh");
    pilot.survey();
    pilot.flight.abandon();
    pilot.command("1 rtl", RowState::TimedOut);
    let report = pilot.flight.close(&pilot.ledger);
    (report, pilot.flight.take_record())
}

#[test]
fn a_record_scores_again_as_it_was_scored() {
    let (report, text) = eventful();
    let stored = Stored::read(&text).expect("a good record");
    assert_eq!(stored.damage, None);
    let again = stored.rescore(WithoutEnd::Over).expect("a good mission");
    // The test vehicle's position is finer than in messages; the rest is identical.
    assert_eq!(again.report.score, report.score);
    assert_eq!(again.report.ledger, report.ledger);
    assert_eq!(again.report.prediction, report.prediction);
    assert_eq!(again.report.objectives, report.objectives);
    assert_eq!(again.report.attempt, 3);
    assert_eq!(again.before.map(|end| end.score), Some(report.score));
}

#[test]
fn what_is_said_in_the_debrief_is_not_recorded() {
    let mut pilot = recorded();
    pilot.take_off(20.0);
    pilot.flight.abandon();
    drop(pilot.flight.close(&pilot.ledger));
    drop(pilot.flight.act(EntryId(0), &Deed::Hint, &[1]));
    let stored = Stored::read(&pilot.flight.take_record()).expect("a good record");
    assert_eq!(stored.damage, None);
}

#[test]
fn a_record_that_was_changed_afterwards_has_another_checksum() {
    let (_, text) = eventful();
    let is_altered = |text: &str| Stored::read(text).expect("a good record").is_altered();
    assert!(!is_altered(&text));
    for (from, to) in [
        ("\"program\":\"", "\"program\":\"9."),
        ("\"program\":", "\"profile\":\"Another\",\"program\":"),
        ("14:03:22Z", "15:03:22Z"),
        ("10.70V", "12.70V"),
    ] {
        let edited = text.replacen(from, to, 1);
        assert_ne!(edited, text);
        assert!(is_altered(&edited), "{from}");
    }
    // Without its end, a record has no checksum.
    let (cut, _) = text.split_once("{\"end\"").expect("an end");
    assert!(!is_altered(cut));
}

#[test]
fn a_journal_with_another_program_or_profile_is_named() {
    let (_, text) = eventful();
    let stored = Stored::read(&text).expect("a good record");
    let journal = || JournalHead::new(Subject::Mission(stored.head.mission.clone()), 0);
    assert_eq!(stored.misstatement(None, None), None);
    assert_eq!(stored.misstatement(Some(&journal()), None), None);
    let other = JournalHead {
        program: "9.9.9".to_owned(),
        ..journal()
    };
    let said = stored
        .misstatement(Some(&other), None)
        .expect("another program");
    assert!(said.to_string().contains("9.9.9"), "{said}");
    let other = JournalHead {
        profile: Some("Another".to_owned()),
        ..journal()
    };
    let said = stored
        .misstatement(Some(&other), None)
        .expect("another profile");
    assert!(said.to_string().contains("profile"), "{said}");
}

#[test]
fn a_record_that_was_cut_off_anywhere_is_scored_up_to_there() {
    let (_, text) = eventful();
    let head = text.find('\n').expect("a first line") + 1;
    for at in (head..text.len() - 1).step_by(text.len() / 23) {
        let stored = Stored::read(&text[..at]).expect("the head is whole");
        assert!(stored.damage.is_some(), "{at}");
        let again = stored.rescore(WithoutEnd::Over).expect("a good mission");
        assert!(again.before.is_none(), "{at}");
        assert!(!again.report.passed);
    }
}

#[test]
fn a_damaged_line_is_named_and_ends_the_record() {
    let (_, text) = eventful();
    let mut lines: Vec<&str> = text.lines().collect();
    lines[5] = "{\"tick\":{\"t\":";
    let stored = Stored::read(&lines.join("\n")).expect("the head is whole");
    let damage = stored.damage.expect("a line is damaged").to_string();
    assert!(damage.contains("line 6"), "{damage}");
}

#[test]
fn a_record_without_an_end_lasts_as_long_as_its_flight() {
    let mut pilot = recorded();
    pilot.take_off(20.0);
    pilot.land();
    // Nothing changes any more.
    pilot.wait(45.0);
    let record = pilot.flight.take_record();
    let (flown, recorded) = (pilot.report(), rescored(&record));
    let missing_s = flown.sim_time_s - recorded.sim_time_s;
    assert!((0.0..1.0).contains(&missing_s), "{missing_s}");
}

#[test]
fn a_flight_whose_record_has_no_end_is_scored_as_over_or_as_left() {
    let mut pilot = recorded();
    pilot.take_off(20.0);
    pilot.survey();
    pilot.land();
    let stored = Stored::read(&pilot.flight.take_record()).expect("a good record");
    let score = |without_end| {
        let again = stored.rescore(without_end).expect("a good mission");
        again.report.score
    };
    assert!(score(WithoutEnd::Over) > 0);
    assert_eq!(score(WithoutEnd::Left), 0);
}

#[test]
fn what_is_no_record_is_refused_with_the_reason() {
    for (text, reason) in [
        ("", "not a recorded run"),
        ("schema = 1\n", "not a recorded run"),
        ("{\"sortie_run\":99}\n", "version 99"),
        ("{\"sortie_run\":1}\n", "first line"),
    ] {
        let error = Stored::read(text).expect_err("no record").to_string();
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn a_record_is_small() {
    let (_, text) = eventful();
    let minutes = 1.0 + fly_the_cells(7).now.as_secs_f64() / 60.0;
    let per_minute = text.len() as f64 / minutes;
    assert!(per_minute < 80_000.0, "{per_minute} bytes a minute");
    assert!(do_nothing().report().score < 300);
}

/// A flight of the mission with a relay, in which an inject is triggered, a vehicle is out of radio
/// range for a while, and the trainee pauses.
fn troubled() -> (Report, String) {
    let source = include_str!("../../../missions/12-relay-chain.toml");
    let mut pilot = Pilot::flying(Mission::parse(source).expect("it is good"), 7);
    pilot.flight.start_record(&occasion(Stake::Practice));
    pilot.take_off(20.0);
    let injected = pilot.flight.inject("motor_fail");
    injected.expect("an instructor may");
    let armed = pilot.flight.arm("gust", "t > 2");
    armed.expect("an instructor may");
    pilot.wait(3.0);
    let paused = pilot.flight.note_pause(Duration::from_secs(90));
    paused.expect("it is said");
    pilot.vehicle().link.lost = true;
    pilot.vehicle().unheard = Some(Unheard {
        at: LatLon::from_e7(490_400_000, 334_100_000),
        altitude_m: 31.5,
        boot_ms: 0,
    });
    pilot.wait(3.0);
    pilot.vehicle().link.lost = false;
    pilot.vehicle().unheard = None;
    pilot.wait(3.0);
    pilot.flight.abandon();
    let report = pilot.flight.close(&pilot.ledger);
    (report, pilot.flight.take_record())
}

fn rescored(text: &str) -> Report {
    let again = Stored::read(text).and_then(|stored| stored.rescore(WithoutEnd::Over));
    again.expect("a good record").report
}

#[test]
fn pauses_and_what_an_instructor_has_happen_are_flown_again() {
    let (report, text) = troubled();
    let again = rescored(&text);
    assert_eq!(again.events, report.events);
    assert_eq!(again.alerts, report.alerts);
    assert_eq!(again.score, report.score);
    for kind in ["{\"pause\"", "{\"inject\""] {
        let without: String = text
            .split_inclusive('\n')
            .filter(|line| !line.starts_with(kind))
            .collect();
        assert!(without.len() < text.len(), "{kind} is not in the record");
        assert_ne!(rescored(&without).events, report.events, "{kind}");
    }
}

#[test]
fn where_a_vehicle_is_while_nobody_hears_it_is_in_the_record() {
    let (_, text) = troubled();
    let lines = text.lines().skip(1).map(serde_json::from_str);
    let ticks = lines.filter_map(|line| match line.expect("a good line") {
        RecordLine::Tick { change, .. } => change.v.into_iter().next(),
        _ => None,
    });
    let mut vehicle: Option<Vehicle> = None;
    let mut heard = Vec::new();
    for observed in ticks {
        let vehicle = vehicle.get_or_insert_with(|| observed.vehicle());
        observed.apply(vehicle, Duration::ZERO);
        let place = vehicle
            .unheard
            .map(|it| (it.at.to_e7(), (it.altitude_m * 10.0).round() as i64));
        if heard.last() != Some(&place) {
            heard.push(place);
        }
    }
    let away = ((490_400_000, 334_100_000), 315);
    assert_eq!(heard, [None, Some(away), None]);
}

#[test]
fn a_time_years_ahead_ends_with_the_flight() {
    let (_, text) = eventful();
    let lines: Vec<&str> = text.lines().take(3).collect();
    let leap = format!(
        "{}\n{{\"tick\":{{\"t\":{}}}}}\n",
        lines.join("\n"),
        u64::MAX
    );
    let report = rescored(&leap);
    assert!((report.sim_time_s - report.time_limit_s).abs() < 0.2);
}

#[test]
fn what_goes_back_in_time_or_comes_after_the_end_is_damage() {
    let (report, text) = eventful();
    let lines: Vec<&str> = text.lines().collect();
    let mut swapped = lines.clone();
    swapped.swap(2, 3);
    let after = [&lines[..], &lines[4..5]].concat();
    for (lines, damaged, is_whole) in [(&swapped, 4, false), (&after, lines.len() + 1, true)] {
        let stored = Stored::read(&lines.join("\n")).expect("the head is whole");
        let damage = stored.damage.as_ref().expect("it is damaged").to_string();
        assert!(damage.contains(&format!("line {damaged} ")), "{damage}");
        assert_eq!(stored.end().is_some(), is_whole);
        let again = stored
            .rescore(WithoutEnd::Over)
            .expect("a good mission")
            .report;
        assert_eq!(again == report, is_whole);
    }
}

/// A recorded flight in which the trainee answers the question about the workload with these levels, by command.
fn asked(answers: &[u8], stake: Stake) -> (Report, String) {
    let mut pilot = Pilot::new(7);
    pilot.flight.set_stake(stake);
    pilot.flight.start_record(&occasion(stake));
    pilot.take_off(20.0);
    for level in answers {
        pilot.command(&format!("1 workload {level}"), RowState::Done);
        let deed = Deed::Workload { level: *level };
        drop(pilot.flight.act(EntryId(0), &deed, &[1]));
        pilot.tick();
    }
    for _ in answers.len()..3 {
        pilot.tick();
    }
    pilot.survey();
    pilot.land();
    let report = pilot.flight.close(&pilot.ledger);
    (report, pilot.flight.take_record())
}

#[test]
fn what_is_said_of_the_workload_is_recorded_and_changes_nothing_else() {
    let (silent, _) = asked(&[], Stake::Practice);
    let (told, text) = asked(&[2, 5, 3], Stake::Practice);
    let levels: Vec<u8> = told.workload.answers.iter().map(|it| it.level).collect();
    assert_eq!(levels, [2, 5, 3]);
    let mut without_answers = told.clone();
    without_answers.workload.answers.clear();
    assert_eq!(without_answers, silent);
    let stored = Stored::read(&text).expect("a good record");
    let again = stored.rescore(WithoutEnd::Over).expect("a good mission");
    assert_eq!(again.report.workload.answers, told.workload.answers);
    assert_eq!(again.before.map(|end| end.score), Some(again.report.score));
    let (exam, _) = asked(&[2], Stake::Exam);
    assert_eq!(exam.workload.answers, []);
}

#[test]
fn what_was_said_before_a_launch_that_did_not_come_holds_for_the_next_try_and_is_on_its_record() {
    let mut first = recorded();
    for deed in [
        Deed::Predict { points: 640 },
        Deed::Goal(Goal::Faultless(GoalComponent::Safety)),
    ] {
        first.flight.act(EntryId(0), &deed, &[1]);
    }
    let said = first.flight.open_pledge().expect("nothing has flown");
    let mut second = recorded();
    second.flight.renew(said);
    assert_eq!(second.flight.pledge(), said);
    second.take_off(20.0);
    assert_eq!(second.flight.open_pledge(), None);
    second.flight.abandon();
    second.flight.close(&second.ledger);
    let stored = Stored::read(&second.flight.take_record()).expect("a good record");
    let report = stored
        .rescore(WithoutEnd::Over)
        .expect("a good mission")
        .report;
    let predicted = report.prediction.map(|prediction| prediction.predicted);
    assert_eq!(
        (predicted, report.goal.map(|goal| goal.text)),
        (
            Some(640),
            Some(Goal::Faultless(GoalComponent::Safety).title())
        )
    );
}

/// A flight of the first mission with the starter design.
fn built(stake: Stake) -> Pilot {
    let source = include_str!("../../../missions/01-air-sample.toml");
    let design = include_str!("../../../designs/starter.toml");
    let design = Design::from_toml(design).expect("a good design");
    let mission = Mission::parse(source)
        .expect("it is good")
        .with_fleet(vec![design])
        .expect("it may fly");
    let mut pilot = Pilot::flying(mission.flown_for(stake), 7);
    pilot.flight.start_record(&Occasion {
        profile: Some("ada".to_owned()),
        ..occasion(stake)
    });
    pilot
}

#[test]
fn a_record_says_who_flew_what_for_what_and_is_flown_again_so() {
    for stake in [Stake::Graded, Stake::Exam, Stake::Daily, Stake::Practice] {
        let mut pilot = built(stake);
        pilot.take_off(20.0);
        drop(pilot.flight.act(EntryId(0), &Deed::Hint, &[1]));
        pilot.survey();
        pilot.flight.abandon();
        let report = pilot.flight.close(&pilot.ledger);
        let stored = Stored::read(&pilot.flight.take_record()).expect("a good record");
        assert_eq!(stored.head.profile.as_deref(), Some("ada"));
        assert_eq!(stored.head.stake, stake);
        let mission = stored.head.flown().expect("a good mission");
        assert_eq!(mission.fleet()[0].name, "Starter 450");
        assert_eq!(mission.rules.pausable, stake != Stake::Exam);
        assert_eq!(mission.listing().hints.is_empty(), stake == Stake::Exam);
        let again = stored
            .rescore(WithoutEnd::Over)
            .expect("a good mission")
            .report;
        assert_eq!(again.score, report.score);
        assert_eq!(again.hints, report.hints);
        let hints: u32 = report.hints.len() as u32;
        assert_eq!(hints, u32::from(stake != Stake::Exam), "{stake:?}");
    }
}

#[test]
fn a_record_that_is_older_than_careers_was_practice_with_the_missions_own_drones() {
    let (_, text) = eventful();
    assert!(!text.contains("\"stake\"") && !text.contains("\"designs\""));
    let head = Stored::read(&text).expect("a good record").head;
    assert_eq!((head.stake, head.profile), (Stake::Practice, None));
    assert!(head.designs.is_empty());
}

#[test]
fn a_stall_before_the_time_of_the_mission_is_no_pause() {
    let stalled = |in_flight: bool| {
        let mut pilot = recorded();
        let long = Duration::from_secs(9);
        drop(pilot.flight.note_pause(long));
        pilot.wait(3.0);
        if in_flight {
            drop(pilot.flight.note_pause(long));
        }
        pilot.wait(3.0);
        pilot.flight.abandon();
        drop(pilot.flight.close(&pilot.ledger));
        let text = pilot.flight.take_record();
        assert!(text.contains("{\"pause\""), "{text}");
        Stored::read(&text).expect("a good record").has_pauses()
    };
    assert!(!stalled(false));
    assert!(stalled(true));
}
