//! Tries of an exam at a seat.

use std::sync::Arc;

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::{ClassEvent, SessionEvent};
use sortie::app::state::{ClassRole, Overlay, SeatPlace};
use sortie::campaign::Stake;
use sortie::class::protocol::DeskMessage;
use sortie::class::{Consent, Deed, ExamTry, Outcome, Refusal, Seat, TryName};
use sortie::text::{Language, Locale};

use super::start::{fly, is_reading};
use super::{joined, order, outcomes, pass, place, session_effects, start};
use crate::fixtures;
use crate::harness::Console;

fn opened_try() -> ExamTry {
    ExamTry {
        name: TryName {
            exam: "final".into(),
            begun: 1_800_000_000,
            mission: "00-first-flight".into(),
            number: 1,
            opening: 1,
        },
        title: "Final exam".into(),
        title_uk: Some("Підсумковий іспит".into()),
        tries: 1,
        seed: 7,
        within_s: 600,
    }
}

/// A seat at which the desk has opened a try of the first mission, whose brief is shown.
fn reading_a_try(opened: ExamTry) -> Console {
    let mut console = joined();
    order(&mut console, 1, Deed::Examine(opened));
    start(&mut console, "00-first-flight", Stake::Exam);
    console
}

#[test]
fn a_try_is_the_flight_that_the_desk_has_ordered_however_late_it_begins() {
    let mut console = joined();
    let opened = opened_try();
    order(&mut console, 1, Deed::Examine(opened.clone()));
    assert_eq!(place(&console).flown_try(), None);
    // The vehicles start slowly, and the desk has given the order up.
    pass(&mut console, 30);
    start(&mut console, "00-first-flight", Stake::Exam);
    assert_eq!(place(&console).flown_try(), Some(&opened.name));
    console.give("class leave");
    assert_eq!(place(&console).seat().consent(), Consent::Given);
    let screen = console.screen(120, 40);
    assert!(screen.contains("cannot be left during a try"), "{screen}");

    let mut console = joined();
    order(&mut console, 1, Deed::Examine(opened));
    start(&mut console, "01-air-sample", Stake::Exam);
    assert_eq!(place(&console).flown_try(), None, "another mission");
}

#[test]
fn another_opening_of_a_try_is_refused_while_the_first_is_flown() {
    let opened = opened_try();
    let mut console = reading_a_try(opened.clone());
    let mut again = opened.clone();
    (again.name.opening, again.seed) = (2, 8);
    order(&mut console, 2, Deed::Examine(again));
    assert_eq!(place(&console).flown_try(), Some(&opened.name));
    let refused = Outcome::Refused(Refusal::Flying);
    assert_eq!(outcomes(&console), [(2, refused)]);
}

/// Esc in the brief of a try once used it up without a question.
#[test]
fn leaving_the_brief_of_a_try_is_asked_about() {
    let mut console = reading_a_try(opened_try());
    console.give("abandon");
    assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
    let screen = console.screen(120, 40);
    assert!(screen.contains("uses up the try of the exam"), "{screen}");
    console.press("y");
    assert_eq!(session_effects(&console), [&SessionEffect::Leave]);
}

/// It once said that the flight counts.
#[test]
fn leaving_the_flight_of_a_try_says_that_the_try_does_not_count() {
    for line in ["leave", "quit", "abandon"] {
        let mut console = reading_a_try(opened_try());
        console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
        console.press("enter");
        console.give(line);
        let Some(Overlay::Confirm(asked)) = console.state().overlay() else {
            panic!("{line}: nothing is asked");
        };
        let reason = asked.reason().to_string();
        assert!(reason.contains("does not count"), "{line}: {reason}");
        assert!(!reason.contains("the flight counts"), "{line}: {reason}");
    }
}

#[test]
fn a_try_that_would_be_practice_is_not_used_up() {
    let mut console = joined();
    let opened = opened_try();
    for number in 1..=2 {
        order(&mut console, number, Deed::Examine(opened.clone()));
        let begun = session_effects(&console);
        let [SessionEffect::StartMission(launch)] = begun[..] else {
            panic!("{begun:?}");
        };
        assert_eq!((launch.drawn, &launch.fleet[..]), (Some(7), &[][..]));
        console.hear(ClassEvent::TryRefused(Refusal::Practice));
    }
    // It is no try that another flight could be.
    start(&mut console, "00-first-flight", Stake::Exam);
    assert_eq!(place(&console).flown_try(), None);
    let refused = Outcome::Refused(Refusal::Practice);
    assert_eq!(outcomes(&console), [(1, refused), (2, refused)]);
}

/// The trainee can read the record; with seeds that are the same for all, or for a try that was refused, the seed in it
/// was once a help.
#[test]
fn the_seed_of_a_try_is_not_in_the_record() {
    let mut console = joined();
    order(&mut console, 1, Deed::Examine(opened_try()));
    console.hear(ClassEvent::TryRefused(Refusal::NotRecorded));
    let notes = console.effects.iter().filter_map(|effect| match effect {
        Effect::Class(ClassEffect::Note(line)) => Some(line),
        _ => None,
    });
    let notes: Vec<String> = notes
        .map(|line| serde_json::to_string(line).expect("written"))
        .collect();
    assert_eq!(notes.len(), 1);
    assert!(notes[0].contains("\"seed\":0"), "{notes:?}");
}

#[test]
fn the_trainee_sees_which_try_it_is_and_the_time_that_is_left() {
    let mut console = reading_a_try(ExamTry {
        tries: 2,
        ..opened_try()
    });
    let screen = console.screen(120, 40);
    assert!(screen.contains("try 1 of 2, 10:00 left"), "{screen}");
    let screen = console.screen(80, 24);
    assert!(screen.contains("10:00 left"), "{screen}");
    console.press("enter");
    console.hear(ClassEvent::Said(DeskMessage::Here));
    pass(&mut console, 30);
    let screen = console.screen(120, 40);
    assert!(screen.contains("try 1 of 2, 09:30 left"), "{screen}");
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    let screen = console.screen(120, 40);
    assert!(!screen.contains("try 1 of 2"), "{screen}");
}

/// The brief once named the file of the exam.
#[test]
fn the_trainee_sees_the_title_of_the_exam_and_not_its_name() {
    for (language, title) in [
        (Language::English, "Final exam"),
        (Language::Ukrainian, "Підсумковий іспит"),
    ] {
        let mut console = Console::set_up(|setup| {
            let seat = Seat::new(7, Consent::Given);
            setup.class = ClassRole::Seat(Box::new(SeatPlace::new(seat, "9-A".to_owned())));
            setup.locale = Arc::new(Locale::new(language));
        });
        let mut opened = opened_try();
        (opened.name.exam, opened.name.mission) = ("nine-a-2026".into(), "m01".into());
        order(&mut console, 1, Deed::Examine(opened));
        start(&mut console, "m01", Stake::Exam);
        let brief = console.screen(120, 40);
        assert!(brief.contains(title), "{brief}");
        let notices = console.state().notices().lines();
        let locale = Locale::new(language);
        let told: Vec<String> = notices.map(|it| locale.text(&it.notice.text)).collect();
        assert!(told.iter().any(|line| line.contains(title)), "{told:?}");
        let told = told.join("\n") + &brief;
        assert!(!told.contains("nine-a-2026"), "{told}");
    }
}

/// A hold for the same mission once kept the trainee in the brief of a try, whose time was running.
#[test]
fn a_try_of_an_exam_is_not_held() {
    let mut console = joined();
    order(&mut console, 1, fly("00-first-flight", true));
    order(&mut console, 2, Deed::Examine(opened_try()));
    start(&mut console, "00-first-flight", Stake::Exam);
    console.press("enter");
    assert!(!is_reading(&console));
}

#[test]
fn the_end_is_refused_before_the_time_of_a_try_has_begun() {
    let mut console = reading_a_try(opened_try());
    order(&mut console, 2, Deed::End);
    let refused = Outcome::Refused(Refusal::NotFlying);
    assert_eq!(outcomes(&console).last(), Some(&(2, refused)));
    order(&mut console, 3, Deed::Start);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    order(&mut console, 4, Deed::End);
    assert_eq!(session_effects(&console), [&SessionEffect::Stop]);
}
