//! The speed-up of simulated time, and what ends it.

use sortie::app::effect::{Effect, PaceChange, SessionEffect};
use sortie::app::event::SessionEvent;
use sortie::commands::FindKind;
use sortie::ledger::RowState;
use sortie::mission::{ObjectiveState, Progress, ShownContact, Trust};
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

/// Three vehicles on their way, at 4x, in a mission.
fn in_a_hurry() -> Console {
    let mut console = Console::flying(3);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.give("all goto by n 50 e 0");
    console.hear(SessionEvent::Speedup(PaceChange::wanted(4.0)));
    console
}

/// The reason for which the last event has ended the speed-up.
fn reason(console: &Console) -> Option<String> {
    console.effects.iter().find_map(|effect| match effect {
        Effect::Session(SessionEffect::Speedup(change)) => {
            change.because.as_ref().map(ToString::to_string)
        }
        _ => None,
    })
}

#[test]
fn only_the_last_of_several_arrivals_ends_a_speed_up() {
    let mut console = in_a_hurry();
    for (vehicle, ends) in [(2, false), (1, false), (3, true)] {
        console.row(vehicle, RowState::Done, None);
        assert_eq!(reason(&console).is_some(), ends, "{vehicle}");
    }
}

#[test]
fn what_needs_a_person_ends_a_speed_up_at_once() {
    for state in [
        RowState::Refused,
        RowState::NoEffect,
        RowState::TimedOut,
        RowState::Overtaken,
        RowState::Superseded,
    ] {
        let mut console = in_a_hurry();
        console.row(2, state, None);
        assert!(reason(&console).is_some(), "{state}");
    }
    let mut console = in_a_hurry();
    console.notice(Severity::Warning, Some(2), "low battery");
    assert_eq!(reason(&console).as_deref(), Some("low battery"));
    console = in_a_hurry();
    console.notice(Severity::Info, Some(2), "a text");
    assert_eq!(reason(&console), None);
}

#[test]
fn an_objective_that_changes_ends_a_speed_up_and_a_count_does_not() {
    let mut console = in_a_hurry();
    let mut progress = fixtures::progress();
    progress.objectives[0].detail = "5/9 cells".into();
    progress.feedback = Some("B2 sampled".into());
    console.hear(SessionEvent::Mission(Box::new(progress.clone())));
    assert_eq!(reason(&console), None);
    progress.objectives[0].state = ObjectiveState::Met;
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let expected = "objective met: Measure the air over the yard";
    assert_eq!(reason(&console).as_deref(), Some(expected));
}

#[test]
fn a_new_contact_ends_a_speed_up_and_more_of_a_known_fire_do_not() {
    let contact = |name: &str, kind| ShownContact {
        name: name.to_owned(),
        kind,
        at: fixtures::HOME,
        trust: Trust::Seen,
    };
    let mut progress = fixtures::progress();
    for (name, kind, ends) in [
        ("c1", FindKind::Mine, true),
        ("c2", FindKind::Mine, true),
        ("f1", FindKind::Fire, true),
        ("f2", FindKind::Fire, false),
    ] {
        let mut console = Console::flying(3);
        console.hear(SessionEvent::Mission(Box::new(progress.clone())));
        console.hear(SessionEvent::Speedup(PaceChange::wanted(4.0)));
        progress.contacts.push(contact(name, kind));
        console.hear(SessionEvent::Mission(Box::new(progress.clone())));
        let wanted = ends.then(|| format!("new contact {name}"));
        assert_eq!(reason(&console), wanted);
    }
}

/// A guided lesson asks for one thing at a time.
#[test]
fn the_workload_is_asked_after_two_minutes_but_not_in_a_lesson() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let lesson = sortie::mission::Mission::parse(source).expect("a mission");
    let steps = lesson.advice.lesson;
    let mut console = Console::flying(1);
    let mut asks = |lesson| {
        let progress = Progress {
            elapsed: std::time::Duration::from_secs(121),
            lesson,
            ..fixtures::progress()
        };
        console.hear(SessionEvent::Mission(Box::new(progress)));
        console.state().asks_workload()
    };
    assert!(asks(None));
    assert!(!asks(steps.into_iter().next()));
}
