//! Pauses, and the beginning and end of an attempt at a mission.

use std::time::Duration;

use sortie::app::effect::{Effect, Launch, SessionEffect};
use sortie::app::event::{SessionEvent, Started};
use sortie::app::room::debrief::Debrief;
use sortie::app::state::{Activity, Overlay, Room};
use sortie::campaign::Stake;
use sortie::scoring::EventReport;
use sortie::text::{Language, Locale};

use crate::console::hangar::starting;
use crate::fixtures;
use crate::harness::Console;

fn mission() -> Activity {
    Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    }
}

fn flying() -> Console {
    flying_in(Console::new())
}

fn flying_in(mut console: Console) -> Console {
    console.start(mission());
    console.vehicle(fixtures::airborne(1, 20.0, 20.1));
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("F");
    console
}

/// The text of the last line on the screen.
fn said(console: &Console) -> String {
    let message = console.state().message();
    message.map_or_else(String::new, |message| {
        Locale::new(Language::English).text(&message.text)
    })
}

#[test]
fn a_key_and_lines_pause_and_go_on_and_the_screen_says_so() {
    let mut console = flying();
    assert_eq!(
        console.press("p").effects,
        [Effect::Session(SessionEffect::Pause)]
    );
    console.hear(SessionEvent::Paused(true));
    for room in ["F", "M", "B"] {
        assert!(console.press(room).screen(80, 24).contains("PAUSED"));
    }
    assert_eq!(
        console.press("p").effects,
        [Effect::Session(SessionEffect::Continue)]
    );
    console.hear(SessionEvent::Paused(false));
    assert!(!console.press("F").screen(80, 24).contains("PAUSED"));
    assert_eq!(
        console.give("pause").effects,
        [Effect::Session(SessionEffect::Pause)]
    );
    console.hear(SessionEvent::Paused(true));
    assert!(console.give("pause").effects.is_empty());
    assert_eq!(
        console.give("continue").effects,
        [Effect::Session(SessionEffect::Continue)]
    );
    console.hear(SessionEvent::Paused(false));
    assert!(console.give("continue").effects.is_empty());
    assert!(said(&console).contains("not paused"));
}

#[test]
fn commands_are_refused_while_it_is_paused_and_the_line_stays() {
    let mut console = flying();
    console.hear(SessionEvent::Paused(true));
    for line in ["1 rtl", "1 mark", "1 predict 800"] {
        assert!(console.give(line).effects.is_empty(), "{line}");
        let Some(Overlay::Palette(palette)) = console.state().overlay() else {
            panic!("the line is gone: {line}");
        };
        let fault = palette.fault().expect("it says why");
        assert!(fault.message.to_string().contains("paused"), "{line}");
        console.press("esc");
    }
    assert_eq!(console.state().session().ledger().entries().len(), 0);
    console.hear(SessionEvent::Paused(false));
    assert_eq!(console.give("1 rtl").sent_to(), [1]);
}

#[test]
fn a_hint_can_be_requested_in_a_pause() {
    let mut console = flying();
    console.hear(SessionEvent::Paused(true));
    console.press("w");
    let screen = console.screen(80, 24);
    assert!(screen.contains("Enter confirms"), "{screen}");
    let effects = console.press("enter").effects.clone();
    let is_hint = |effect: &Effect| matches!(effect, Effect::Order { order, .. } if order.verb.name == "hint");
    assert!(effects.iter().any(is_hint), "{effects:?}");
    assert!(console.state().overlay().is_none());
}

#[test]
fn what_cannot_be_paused_says_why() {
    let mut processes = starting(mission(), 1);
    let mut real = Console::new();
    real.start(Activity::Connected {
        addresses: vec!["tcp:127.0.0.1:5760".to_owned()],
    });
    let mut forbidden = Console::new();
    let mut listing = fixtures::listing();
    listing.pausable = false;
    forbidden.hear(SessionEvent::Started(Box::new(Started {
        activity: mission(),
        mission: Some(Box::new(listing)),
        places: std::collections::BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    })));
    let mut over = flying();
    over.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    over.at(300);
    for (console, reason) in [
        (&mut processes, "ArduPilot"),
        (&mut real, "real drones"),
        (&mut forbidden, "rules of this mission"),
        (&mut over, "over"),
        (&mut Console::new(), "no mission"),
    ] {
        assert!(console.give("pause").effects.is_empty(), "{reason}");
        assert!(said(console).contains(reason), "{}", said(console));
    }
}

#[test]
fn a_chosen_mission_begins_with_its_brief_and_a_restarted_one_in_flight() {
    let mut console = Console::new();
    console.start(mission());
    assert_eq!(console.state().room(), Room::Mission);
    let screen = console.screen(80, 24);
    for words in ["before takeoff", "predict 800", "goal time 200s"] {
        assert!(screen.contains(words), "{words}: {screen}");
    }
    assert_eq!(console.press("enter").state().room(), Room::Fly);
    console.start_again(mission());
    assert_eq!(console.state().room(), Room::Fly);
    console.start(mission());
    assert_eq!(console.state().room(), Room::Mission, "chosen once more");
    let mut free = Console::new();
    free.start(Activity::Free);
    assert_eq!(free.state().room(), Room::Fly);
}

#[test]
fn keys_of_the_brief_ask_for_the_word_and_what_was_said_is_shown() {
    let mut console = Console::new();
    console.start(mission());
    console.vehicle(fixtures::parked(1));
    console.press("s").write("800").press("enter");
    assert!(
        matches!(console.effects.as_slice(), [Effect::Order { .. }]),
        "{:?}",
        console.effects
    );
    console.press("g").write("time 200s").press("enter");
    assert!(matches!(console.effects.as_slice(), [Effect::Order { .. }]));
    let mut progress = fixtures::progress();
    progress.score_so_far = None;
    progress.pledge.prediction = Some(800);
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let screen = console.screen(80, 24);
    assert!(screen.contains("800 predicted"), "{screen}");
    assert!(screen.contains("goal time 200s"), "{screen}");
    // In the air, only the earlier lines are left.
    let mut progress = fixtures::progress();
    progress.pledge.prediction = Some(800);
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let screen = console.screen(80, 24);
    assert!(screen.contains("stated before takeoff"), "{screen}");
    assert!(!screen.contains("goal time 200s"), "{screen}");
    assert!(
        console
            .press("F")
            .screen(80, 24)
            .contains("stated: 800 points")
    );
}

#[test]
fn keys_of_the_brief_end_and_repeat_the_mission_after_a_question() {
    for (key, effect) in [
        ("a", Effect::Session(SessionEffect::Abandon)),
        (
            "r",
            Effect::Session(SessionEffect::Restart { alike: false }),
        ),
    ] {
        let mut console = flying();
        console.press("B").press(key);
        assert!(matches!(
            console.state().overlay(),
            Some(Overlay::Confirm(_))
        ));
        assert_eq!(console.press("y").effects, [effect]);
    }
}

#[test]
fn the_debrief_leads_to_the_same_seed_another_one_and_the_next_mission() {
    let mut next = fixtures::listing();
    next.id = "m02".to_owned();
    let first = fixtures::listing().id;
    let mut console = flying_in(Console::set_up(|setup| setup.missions.push(next)));
    let mut report = fixtures::report();
    report.mission = first;
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(300);
    for (key, effect) in [
        (
            "r",
            Effect::Session(SessionEffect::Restart { alike: false }),
        ),
        ("s", Effect::Session(SessionEffect::Restart { alike: true })),
        (
            "n",
            Effect::Session(SessionEffect::StartMission(Launch::graded("m02"))),
        ),
    ] {
        assert_eq!(console.press(key).effects, [effect], "{key}");
    }
}

#[test]
fn tab_goes_through_the_sections_of_the_debrief_and_round() {
    let mut console = flying();
    let mut report = fixtures::report();
    let event = report.events[0].clone();
    // Events with different texts, because equal ones would share a row.
    report.events.extend((0..40).map(|number| EventReport {
        text: format!("event {number}").into(),
        ..event.clone()
    }));
    console.hear(SessionEvent::MissionEnded(Box::new(report)));
    console.at(300);
    let mut seen = Vec::new();
    for _ in 0..12 {
        console.press("tab");
        let screen = console.screen(80, 24);
        // Below the header and the summary with one component.
        seen.push(screen.lines().nth(6).unwrap_or_default().to_owned());
    }
    assert!(
        seen.iter().any(|line| line.contains("OBJECTIVES")),
        "{seen:?}"
    );
    let there = console
        .state()
        .rooms()
        .debrief()
        .shown()
        .map(Debrief::scroll);
    console.press("tab").press("shift-tab");
    let back = console
        .state()
        .rooms()
        .debrief()
        .shown()
        .map(Debrief::scroll);
    assert_eq!(there, back);
}

#[test]
fn before_launch_the_score_can_be_predicted_and_a_goal_set_while_the_brief_is_read_in_a_pause() {
    let mut console = flying();
    let progress = sortie::mission::Progress {
        can_pledge: true,
        score_so_far: None,
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.hear(SessionEvent::Paused(true));
    for line in ["1 predict 800", "1 goal time 200s"] {
        console.give(line);
        let given = matches!(console.effects.as_slice(), [Effect::Order { .. }]);
        assert!(given, "{line}: {:?}", console.effects);
    }
    assert!(console.give("1 arm").effects.is_empty());
    // The footer offers these keys until a vehicle flies.
    console.press("esc").press("B").at(60);
    assert!(console.screen(80, 24).contains("s predict  g goal"));
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    let screen = console.screen(80, 24);
    assert!(!screen.contains("s predict"), "{screen}");
    assert!(screen.contains("p pause"), "{screen}");
}

#[test]
fn times_in_a_mission_are_those_of_the_mission() {
    let mut console = Console::new();
    console.at(100).start(mission());
    let hear = |console: &mut Console, at_s: u64, elapsed_s: u64| {
        let progress = sortie::mission::Progress {
            elapsed: std::time::Duration::from_secs(elapsed_s),
            ..fixtures::progress()
        };
        console.at(at_s);
        console.hear(SessionEvent::Mission(Box::new(progress)));
    };
    hear(&mut console, 103, 0);
    hear(&mut console, 145, 420);
    let header = |console: &Console| console.screen(80, 24).lines().next().map(str::to_owned);
    assert!(header(&console).is_some_and(|line| line.contains("07:00")));
    let at = |s| {
        console
            .state()
            .session()
            .time(std::time::Duration::from_secs(s))
            .as_secs()
    };
    assert_eq!([100, 103, 124, 145].map(at), [0, 0, 210, 420]);
    // Without a mission, they are the keys of the session.
    console.start(Activity::Free);
    console.at(150);
    assert!(header(&console).is_some_and(|line| line.contains("00:05")));
}

#[test]
fn esc_leaves_a_brief_whose_clock_stands_still_and_enter_starts_the_mission() {
    let mut console = Console::new();
    console.start(mission());
    console.vehicle(fixtures::parked(1));
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("Enter start") && screen.contains("Esc back"),
        "{screen}"
    );
    let mut left = console.clone();
    left.press("esc");
    assert_eq!(left.effects, [Effect::Session(SessionEffect::Leave)]);
    assert_eq!(left.state().room(), Room::Home);
    console.press("enter");
    assert_eq!(console.state().room(), Room::Fly);
    assert!(!console.state().session().is_reading());
    // After the mission has begun, Esc leads back to the drones.
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("B").press("esc");
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn abandoning_before_the_clock_has_started_only_leaves() {
    let mut console = Console::new();
    console.start(mission());
    console.give("abandon");
    assert_eq!(console.effects, [Effect::Session(SessionEffect::Leave)]);
}

#[test]
fn a_hint_is_scrolled_to_when_it_is_asked_for() {
    let mut console = Console::new();
    console.start(mission());
    console.vehicle(fixtures::parked(1));
    for scrolled in ["home", "end"] {
        let mut console = console.clone();
        console.press(scrolled);
        let mut progress = fixtures::progress();
        progress.elapsed = Duration::ZERO;
        progress.score_so_far = None;
        console.hear(SessionEvent::Mission(Box::new(progress.clone())));
        progress.clues.given.push((1, "Think of the wind.".into()));
        console.hear(SessionEvent::Mission(Box::new(progress)));
        let screen = console.screen(80, 24);
        assert!(
            screen.contains("hint 1: Think of the wind."),
            "{scrolled}: {screen}"
        );
    }
}

#[test]
fn a_recording_that_is_played_names_the_command_that_can_pause() {
    let mut console = Console::new();
    console.start(Activity::Connected {
        addresses: vec!["file:flight.tlog".to_owned()],
    });
    console.give("pause");
    assert!(said(&console).contains("`sortie replay FILE`"));
}
