//! The room of the debrief: the truth on a map, earlier attempts, and its keys.

use sortie::app::effect::{Effect, Launch, SessionEffect};
use sortie::app::event::{SessionEvent, Started};
use sortie::app::state::{Activity, Room};
use sortie::campaign::Stake;
use sortie::commands::FindKind;
use sortie::config::Symbols;
use sortie::mission::Mission;
use sortie::scoring::{
    MarkReport, Medal, ObjectKind, ObjectReport, Report, SquareReport, TrackReport, TruthReport,
    TryReport,
};
use sortie::text::Language;

use super::map::{drawn, resized};
use crate::fixtures;
use crate::harness::Console;

const MINE: ObjectKind = ObjectKind::Find(FindKind::Mine);

pub(super) fn truth() -> TruthReport {
    let object = |at, kind: ObjectKind, found| ObjectReport {
        at,
        kind,
        present: true,
        found,
        sought: kind != ObjectKind::Decoy,
    };
    let square = |at, strength| SquareReport {
        at,
        side_m: 20.0,
        strength,
        is_fire: false,
    };
    TruthReport {
        squares: vec![square([10.0, 90.0], 1.0), square([30.0, 90.0], 0.4)],
        objects: vec![
            object([50.0, 40.0], MINE, true),
            object([70.0, 20.0], MINE, false),
            object([20.0, 20.0], ObjectKind::Decoy, false),
        ],
        marks: vec![MarkReport {
            at: [90.0, 60.0],
            kind: Some(FindKind::Mine),
            right: false,
        }],
        gaps: vec![square([90.0, 90.0], 0.0)],
        pads: vec![[0.0, 0.0]],
        tracks: vec![TrackReport {
            vehicle: 1,
            points: vec![[0.0, 0.0], [50.0, 40.0], [50.0, 95.0]],
        }],
        fences: vec![vec![
            [-10.0, -10.0],
            [100.0, -10.0],
            [100.0, 105.0],
            [-10.0, 105.0],
        ]],
        gates: vec![[30.0, 25.0]],
        wires: vec![vec![[0.0, 70.0], [45.0, 70.0], [95.0, 70.0]]],
    }
}

fn one_try(attempt: u32, score: Option<u16>, medal: Option<Medal>) -> TryReport {
    TryReport {
        attempt,
        when: format!("2026-11-2{attempt}T14:03:22Z"),
        score,
        medal,
        passed: medal.is_some(),
        seed: 1,
        revision: 1,
        is_practice: false,
    }
}

fn tries() -> Vec<TryReport> {
    vec![
        one_try(1, Some(905), Some(Medal::Gold)),
        one_try(2, None, None),
        one_try(2, Some(310), None),
        one_try(3, Some(655), Some(Medal::Bronze)),
        one_try(4, Some(655), Some(Medal::Bronze)),
        one_try(5, Some(820), Some(Medal::Silver)),
        one_try(6, Some(837), Some(Medal::Silver)),
    ]
}

/// A mission whose debrief has been open long enough to accept keys.
fn debriefed(size: (u16, u16)) -> Console {
    debriefed_in(Console::new(), size)
}

fn debriefed_in(mut console: Console, size: (u16, u16)) -> Console {
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    let report = Report {
        truth: truth(),
        tries: tries(),
        ..fixtures::report()
    };
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(5);
    resized(console, size)
}

fn shown(console: &Console, symbols: Symbols) -> String {
    drawn(
        console,
        symbols,
        Language::English,
        console.state().display().size(),
    )
}

#[test]
fn the_truth_is_beside_the_text_where_there_is_room_and_behind_a_key_elsewhere() {
    let console = debriefed((200, 50));
    insta::assert_snapshot!("debrief_truth_200x50", shown(&console, Symbols::Braille));
    let mut console = debriefed((80, 24));
    console.press("m");
    insta::assert_snapshot!("debrief_truth_80x24", shown(&console, Symbols::Braille));
    insta::assert_snapshot!("debrief_truth_ascii_80x24", shown(&console, Symbols::Ascii));
    let ukrainian = drawn(&console, Symbols::Braille, Language::Ukrainian, (80, 24));
    insta::assert_snapshot!("debrief_truth_uk_80x24", ukrainian);
    // From the map, Esc leads back to the text; only from there does it lead home.
    console.press("esc");
    assert!(shown(&console, Symbols::Braille).contains("837 / 1000"));
    assert!(console.effects.is_empty(), "{:?}", console.effects);
    console.press("m").press("m");
    assert!(shown(&console, Symbols::Braille).contains("837 / 1000"));
    assert_eq!(
        console.press("esc").effects,
        [Effect::Session(SessionEffect::Leave)]
    );
}

#[test]
fn nothing_is_offered_to_fly_again_where_nothing_was_flown() {
    let mut console = Console::new();
    console.press("D");
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("h home") && !screen.contains("r fly again"),
        "{screen}"
    );
}

#[test]
fn what_nobody_asked_for_is_not_missed() {
    let mut truth = truth();
    for object in &mut truth.objects {
        object.sought = false;
    }
    let mut console = debriefed((80, 24));
    let report = Report {
        truth,
        ..fixtures::report()
    };
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(10).press("m");
    let text = shown(&console, Symbols::Ascii);
    assert!(text.contains("present, not an objective: 1"), "{text}");
    assert!(!text.contains("missed"), "{text}");
}

#[test]
fn a_long_title_hides_the_seed_and_the_outcome_stays() {
    let mut console = debriefed((80, 24));
    assert!(shown(&console, Symbols::Ascii).contains("m01 r1   seed 1   embedded"));
    let title = "A title that is a good deal longer than what the line has room for";
    let report = Report {
        title: title.into(),
        ..fixtures::report()
    };
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    let text = shown(&console, Symbols::Ascii);
    assert!(text.contains(title) && text.contains("PASSED"), "{text}");
    assert!(!text.contains("seed"), "{text}");
}

#[test]
fn the_text_in_both_languages() {
    let console = debriefed((80, 50));
    for language in Language::ALL {
        let text = drawn(&console, Symbols::Braille, language, (80, 50));
        insta::assert_snapshot!(format!("debrief_{}_80x50", language.code()), text);
    }
}

#[test]
fn a_restarted_mission_begins_in_flight_and_another_one_with_its_brief() {
    let mut console = Console::new();
    let mission = |id: &str| Activity::Mission {
        id: id.to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    };
    console.start(mission("m01"));
    assert_eq!(console.state().room(), Room::Mission);
    for room in ["B", "F", "M"] {
        console.press(room).start_again(mission("m01"));
        assert_eq!(console.state().room(), Room::Fly, "from {room}");
    }
    console.start(mission("m02"));
    assert_eq!(console.state().room(), Room::Mission);
}

#[test]
fn a_mission_that_hid_nothing_says_so_instead_of_a_map() {
    let mut console = debriefed((80, 24));
    let report = fixtures::report();
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(10).press("m");
    let text = shown(&console, Symbols::Ascii);
    assert!(text.contains("nothing to reveal"), "{text}");
}

#[test]
fn its_keys_fly_again_alike_the_next_and_lead_home() {
    for (key, expected) in [
        (
            "r",
            Effect::Session(SessionEffect::Restart { alike: false }),
        ),
        ("s", Effect::Session(SessionEffect::Restart { alike: true })),
    ] {
        let mut console = debriefed((80, 24));
        console.press(key);
        assert_eq!(console.effects, [expected], "{key}");
    }
    let mut next = fixtures::listing();
    next.id = "m02".to_owned();
    let mut drill = fixtures::listing();
    drill.id = "d01".to_owned();
    drill.drill_of = Some("m01".to_owned());
    let console = Console::set_up(|setup| setup.missions.extend([drill, next]));
    let mut console = debriefed_in(console, (80, 24));
    console.press("n");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::StartMission(
            Launch::graded("m02")
        ))]
    );
    console.press("t");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::StartMission(
            Launch::graded("d01")
        ))]
    );
    let mut console = debriefed((80, 24));
    console.press("n");
    assert!(console.effects.is_empty());
    assert!(console.screen(80, 24).contains("this was the last mission"));
    console.press("h");
    assert_eq!(console.effects, [Effect::Session(SessionEffect::Leave)]);
}

#[test]
fn keys_that_were_meant_for_the_flight_do_nothing_for_a_second() {
    let mut console = debriefed((80, 24));
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.press("r").press("h");
    assert!(console.effects.is_empty(), "{:?}", console.effects);
    assert_eq!(console.state().room(), Room::Debrief);
}

#[test]
fn a_flight_from_the_debrief_begins_with_its_brief() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let mission = Mission::parse(mission).expect("no faults");
    let again = || {
        SessionEvent::Started(Box::new(Started {
            activity: Activity::Mission {
                id: mission.id.clone(),
                title: mission.title.clone(),
                stake: Stake::Practice,
            },
            places: mission.places(),
            areas: mission.areas(),
            mission: Some(Box::new(mission.listing())),
            processes: None,
            speedup: 1.0,
            is_again: true,
        }))
    };
    let mut console = debriefed((80, 24));
    console.hear(again());
    assert_eq!(console.state().room(), Room::Mission);
    assert!(console.screen(80, 24).contains("before takeoff"));
    console.press("enter");
    assert_eq!(console.state().room(), Room::Fly);
    console.hear(again());
    assert_eq!(console.state().room(), Room::Fly, "restarted in flight");
}

#[test]
fn earlier_tries_are_in_the_debrief_in_the_brief_and_on_the_home_screen() {
    let mut console = debriefed((80, 24));
    assert!(shown(&console, Symbols::Ascii).contains("837 / 1000"));
    console.press("h");
    let tries = console.state().training().tries("m01").to_vec();
    let mut console = Console::set_up(|setup| setup.tries = [("m01".to_owned(), tries)].into());
    let home = console.screen(80, 24);
    assert!(home.contains(" 905 ★★★"), "{home}");
    assert!(home.contains("Best so far: 905 points, gold."), "{home}");
    let brief = console.press("B").screen(80, 50);
    for line in [
        "your tries",
        "2026-11-21 14:03  905 points, gold, best so far",
        "2026-11-22 14:03  310 points, no medal",
        "2026-11-26 14:03  837 points, silver",
    ] {
        assert!(brief.contains(line), "{line}: {brief}");
    }
    // On a narrow screen, the objectives come before the earlier attempts.
    let at = |what: &str| {
        brief
            .find(what)
            .unwrap_or_else(|| panic!("{what}: {brief}"))
    };
    assert!(at("── objectives") < at("── your tries"), "{brief}");
    // The five newest attempts and the best one, without the unfinished one.
    assert!(!brief.contains("not finished"), "{brief}");
}
