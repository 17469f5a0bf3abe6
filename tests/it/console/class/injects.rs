//! Injects of the desk.

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::{ClassEvent, SessionEvent};
use sortie::campaign::Stake;
use sortie::class::protocol::SeatMessage;
use sortie::class::{
    ArmedInject, Deed, Entry, FlightReport, Happening, JournalBatch, OfferedInject, OrderId,
    Outcome, Refusal,
};
use sortie::mission::{Injected, Progress};
use sortie::text::Language;

use super::desk::{deeds, desk, flight, report, say};
use super::{flying_mission, joined, journal, order, outcomes, pass};
use crate::fixtures;
use crate::harness::Console;

/// A flight of a mission that permits some injects.
fn flying_with_injects(stake: Stake) -> Console {
    let mut console = flying_mission(stake);
    mission_says(&mut console, &[]);
    console
}

/// The mission has carried out these injects so far, each with its condition.
fn mission_says(console: &mut Console, injected: &[(&str, Option<&str>)]) {
    let inject = |name: &str, title: &str| sortie::mission::Inject {
        name: name.to_owned(),
        title: title.to_owned().into(),
    };
    let injected = injected.iter().map(|(name, when)| Injected {
        name: (*name).to_owned(),
        when: when.map(str::to_owned),
        // A gust hits no vehicle.
        vehicles: if *name == "motor_fail" {
            vec![3]
        } else {
            Vec::new()
        },
    });
    let progress = Progress {
        injects: vec![
            inject("gust", "Gust of wind"),
            inject("motor_fail", "Motor failure"),
        ],
        injected: injected.collect(),
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
}

fn inject(name: &str, when: Option<&str>) -> Deed {
    let name = name.into();
    let when = when.map(Into::into);
    Deed::Inject { name, when }
}

/// The shell does what the last order wants.
fn begin(console: &mut Console, number: u32) {
    let id = OrderId { desk: 1, number };
    let refusal = None;
    console.hear(ClassEvent::Begun { id, refusal });
}

#[test]
fn an_inject_is_done_when_the_mission_has_carried_it_out_and_the_trainee_is_not_told() {
    let mut console = flying_with_injects(Stake::Graded);
    let notices = console.state().notices().lines().len();
    let message = console.state().message().map(|it| it.text.to_string());
    order(&mut console, 1, inject("gust", None));
    let wanted = console.effects.clone();
    let [Effect::Class(ClassEffect::Inject { name, when, .. })] = wanted.as_slice() else {
        panic!("{wanted:?}");
    };
    assert_eq!((name.as_str(), when), ("gust", &None));
    begin(&mut console, 1);
    assert_eq!(outcomes(&console), [], "the effect has not been seen");
    mission_says(&mut console, &[("gust", None)]);
    let noted = console.effects.iter().find_map(|effect| match effect {
        Effect::Class(ClassEffect::Note(line)) => Some(line.text().to_string()),
        _ => None,
    });
    assert_eq!(noted.as_deref(), Some("petro: inject gust: done"));
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    assert_eq!(console.state().notices().lines().len(), notices);
    let now = console.state().message().map(|it| it.text.to_string());
    assert_eq!(now, message);

    order(&mut console, 2, inject("gust", None));
    begin(&mut console, 2);
    pass(&mut console, 5);
    assert_eq!(outcomes(&console)[1..], [(2, Outcome::NoEffect)]);
}

#[test]
fn injects_that_cannot_be_are_refused_in_silence() {
    let refusals = |console: &mut Console, deed: Deed| {
        let notices = console.state().notices().lines().len();
        order(console, 1, deed);
        assert_eq!(console.state().notices().lines().len(), notices);
        match outcomes(console).as_slice() {
            [(1, Outcome::Refused(refusal))] => *refusal,
            other => panic!("{other:?}"),
        }
    };
    let gust = || inject("gust", None);
    assert_eq!(refusals(&mut joined(), gust()), Refusal::NoMission);
    let mut exam = flying_with_injects(Stake::Exam);
    assert_eq!(refusals(&mut exam, gust()), Refusal::Exam);
    let mut console = flying_with_injects(Stake::Graded);
    assert_eq!(
        refusals(&mut console, inject("link_loss", None)),
        Refusal::NoInject
    );
    let mut console = flying_with_injects(Stake::Graded);
    console.hear(SessionEvent::Paused(true));
    assert_eq!(refusals(&mut console, gust()), Refusal::Paused);
    let mut console = flying_with_injects(Stake::Graded);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert_eq!(refusals(&mut console, gust()), Refusal::NotFlying);
    let mut console = flying_with_injects(Stake::Graded);
    let name = None;
    assert_eq!(
        refusals(&mut console, Deed::Disarm { name }),
        Refusal::NotArmed
    );
}

fn armed(console: &Console) -> Vec<String> {
    let flight = console.state().seat_report(false).flight;
    let armed = flight.expect("it flies").armed.into_iter();
    armed.map(|it| format!("{} {}", it.name, it.when)).collect()
}

#[test]
fn an_armed_inject_is_reported_until_it_comes_or_is_disarmed() {
    let mut console = flying_with_injects(Stake::Graded);
    for (number, name, when) in [
        (1, "gust", "t > 60"),
        (2, "gust", "t > 90"),
        (3, "motor_fail", "t > 90"),
    ] {
        order(&mut console, number, inject(name, Some(when)));
        begin(&mut console, number);
    }
    assert_eq!(
        armed(&console),
        ["gust t > 60", "gust t > 90", "motor_fail t > 90"]
    );
    pass(&mut console, 60);
    mission_says(&mut console, &[("gust", Some("t > 60"))]);
    let name = Some("gust".into());
    order(&mut console, 4, Deed::Disarm { name });
    begin(&mut console, 4);
    assert_eq!(armed(&console), ["motor_fail t > 90"]);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert_eq!(armed(&console), [""; 0]);
    let ended = [
        (1, Outcome::Armed),
        (2, Outcome::Armed),
        (3, Outcome::Armed),
        (1, Outcome::Done),
        (2, Outcome::Disarmed),
        (4, Outcome::Done),
        (3, Outcome::Disarmed),
    ];
    assert_eq!(outcomes(&console), ended);
}

/// The instructor could not learn which vehicle it was: the mission draws it.
#[test]
fn an_inject_names_the_vehicle_that_it_has_hit() {
    let mut console = flying_with_injects(Stake::Graded);
    for (number, when) in [(1, None), (2, Some("t > 60"))] {
        order(&mut console, number, inject("motor_fail", when));
        begin(&mut console, number);
    }
    let both = [("motor_fail", None), ("motor_fail", Some("t > 60"))];
    mission_says(&mut console, &both);
    let ended = journal(&console).into_iter().filter_map(|what| match what {
        Happening::Order {
            id,
            why,
            outcome: Outcome::Done,
            ..
        } => Some((id.number, why?)),
        _ => None,
    });
    let ended: Vec<(u32, String)> = ended.map(|(id, why)| (id, why.to_string())).collect();
    let hit = || "vehicle 3".to_owned();
    assert_eq!(ended, [(1, hit()), (2, hit())]);
}

/// A flight whose mission permits an inject, and in which another one waits.
pub fn flight_with_injects() -> FlightReport {
    let (name, title) = ("gust".into(), "Gust of wind".into());
    let armed = ArmedInject {
        name: "motor_fail".into(),
        when: "vehicle(2).z > 20".into(),
    };
    FlightReport {
        injects: vec![OfferedInject { name, title }],
        armed: vec![armed],
        ..flight(5.0)
    }
}

#[test]
fn the_desk_completes_injects_and_checks_conditions_before_it_sends() {
    let mut console = desk(Language::English);
    console.give("class inject gust");
    assert_eq!(deeds(&console), [], "no seat permits it");
    console.press("esc");
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("e");
    let screen = console.screen(120, 40);
    assert!(screen.contains("Gust of wind"), "{screen}");
    console.press("esc");
    console.give("class inject @anna gust when alt > 20");
    let screen = console.screen(120, 40);
    assert!(screen.contains("alt"), "{screen}");
    assert_eq!(deeds(&console), []);
    console.press("esc");
    console.give("class inject @anna gust");
    console.give("class inject @anna gust when t > 60 and inside('lane') > 0");
    console.give("class disarm @anna gust");
    console.give("class disarm @anna");
    let expected = [
        inject("gust", None),
        inject("gust", Some("t > 60 and inside('lane') > 0")),
        Deed::Disarm {
            name: Some("gust".into()),
        },
        Deed::Disarm { name: None },
    ];
    let anna = |deed| ("anna".to_owned(), deed);
    assert_eq!(deeds(&console), expected.map(anna));
}

/// It once said that `gust` does not fit, and that a seat or a name is expected.
#[test]
fn an_inject_of_a_mission_that_permits_none_says_so() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight(5.0));
    for line in [
        "class inject gust @anna",
        "class inject @anna gust",
        "class inject gust",
    ] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(
            screen.contains("the mission permits no injects"),
            "{line}: {screen}"
        );
        assert!(!screen.contains("does not fit"), "{line}: {screen}");
        console.press("esc");
    }
    assert_eq!(deeds(&console), []);
}

/// It was once to be seen only among the newest three orders, with rows to spare.
#[test]
fn an_armed_inject_that_has_come_stays_on_the_board() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_with_injects());
    console.give("class inject @anna gust when t > 60");
    let id = console.state().class_role().desk().expect("a desk").seats()[0]
        .orders()
        .next_back()
        .expect("an order")
        .order
        .id;
    for number in 1..=6 {
        console.give(&format!("class message @anna word {number}"));
    }
    let deed = inject("gust", Some("t > 60"));
    let entry = |number, outcome, why: Option<&str>| Entry {
        number,
        clock_s: Some(61.0),
        what: Happening::Order {
            id,
            deed: deed.clone(),
            outcome,
            why: why.map(Into::into),
        },
    };
    let entries = vec![
        entry(1, Outcome::Armed, None),
        entry(2, Outcome::Done, Some("vehicle 3")),
    ];
    let batch = JournalBatch {
        kept_from: 1,
        entries,
    };
    say(&mut console, 1, "anna", SeatMessage::Entries(batch));
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("message “word 1”"),
        "the rows are free: {screen}"
    );
    let screen = console.screen(80, 24);
    let come = "01:01  inject gust when t > 60: done: vehicle 3";
    assert!(screen.contains(come), "{screen}");
}

#[test]
fn the_list_of_injects_closes_before_marks_are_removed() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("space").press("i");
    let screen = console.screen(80, 24);
    assert!(screen.contains("gust: Gust of wind"), "{screen}");
    console.press("esc");
    assert!(!console.screen(80, 24).contains("gust: Gust of wind"));
    assert_eq!(console.state().rooms().class().marked(), 1);
    console.press("esc");
    assert_eq!(console.state().rooms().class().marked(), 0);
}
