//! Two flights that the desk replays beside each other.

use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::{ClassEvent, Event, ReplayEvent, SessionEvent};
use sortie::app::state::{Activity, Ghost, ReplayPosition, ReplayView};
use sortie::class::Deed;
use sortie::class_results::{BesideFlight, FoundFlights};
use sortie::language::GhostSource;
use sortie::mission::{Progress, Stake};
use sortie::text::Language;

use crate::comparisons;
use crate::console::class::{deeds, desk};
use crate::fixtures;
use crate::harness::Console;

const RECORD: &str = "2026-11-20T14-03-22Z_00-first-flight";

fn mission() -> Activity {
    Activity::Mission {
        id: "00-first-flight".to_owned(),
        title: "First flight".into(),
        stake: Stake::Graded,
    }
}

fn tick(console: &mut Console) {
    let now = console.state().wall() + Duration::from_secs(1);
    console.hear(Event::Tick { now, wall: now });
}

/// A desk that replays a flight of anna beside one of bohdan, a minute after their starts.
fn replaying(language: Language) -> Console {
    let mut console = desk(language);
    console.give("class replay anna with bohdan");
    let asked = Effect::Class(ClassEffect::FindFlights {
        user: "anna".to_owned(),
        record: None,
        beside: Some("bohdan".to_owned()),
    });
    assert!(console.effects.contains(&asked), "{:?}", console.effects);
    console.hear(ClassEvent::FlightsFound(Ok(FoundFlights {
        trainee: "anna (Anna K.) 2026-11-20 14:03".to_owned(),
        record: RECORD.to_owned(),
        frames: format!("/class/{RECORD}.tlog"),
        beside: Some(BesideFlight {
            trainee: "bohdan 2026-11-20 14:05".to_owned(),
            run: "/class/other.run.jsonl".to_owned(),
        }),
    })));
    let opens = |it: &Effect| matches!(it, Effect::Session(SessionEffect::Replay { .. }));
    assert!(console.effects.iter().any(opens));
    let length = Duration::from_secs(180);
    let began = 1_763_647_402_000_000;
    console.replay(ReplayView::new(RECORD.to_owned(), began, length), mission());
    tick(&mut console);
    let source = GhostSource::File("/class/other.run.jsonl".to_owned());
    let fetches = Effect::Session(SessionEffect::Ghost(source));
    assert_eq!(console.effects.last(), Some(&fetches));
    let screen = console.screen(80, 24);
    assert!(screen.contains("00:"), "{screen}");
    let ghost = Ghost::new(
        Arc::new(comparisons::reference()),
        Some(Arc::new(comparisons::short())),
    );
    console.hear(SessionEvent::Ghost(Box::new(ghost)));
    let progress = Progress {
        elapsed: Duration::from_secs(40),
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.hear(ReplayEvent::At(ReplayPosition {
        at: Duration::from_secs(40),
        indexed: length,
        ..ReplayPosition::default()
    }));
    console
}

#[test]
fn two_flights_are_beside_each_other_at_the_same_mission_time() {
    for language in Language::ALL {
        let console = replaying(language);
        for (width, height) in [(80, 24), (120, 40), (200, 50)] {
            let name = format!("replay_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn a_replay_is_shown_to_marked_seats_or_all_and_not_without_one() {
    let mut console = desk(Language::English);
    console.give("class show");
    let screen = console.screen(120, 40);
    assert!(screen.contains("nothing is being replayed"), "{screen}");
    console.press("esc");
    assert!(deeds(&console).is_empty());

    let mut console = replaying(Language::English);
    console.give("class show");
    assert_eq!(deeds(&console).len(), 3);
    assert!(
        deeds(&console)
            .iter()
            .all(|(_, deed)| *deed == Deed::LookOn)
    );
    let is_showing = |console: &Console| {
        let desk = console.state().class_role().desk();
        desk.expect("it is a desk").is_showing()
    };
    assert!(is_showing(&console));
    console.give("class show stop");
    assert!(!is_showing(&console));
    console.give("class show @bohdan");
    assert_eq!(deeds(&console).len(), 4);
    // The end of the replay ends it, too.
    console.hear(SessionEvent::Ended);
    tick(&mut console);
    assert!(!is_showing(&console));
}
