//! A crew: what a member and the host see.

use std::time::Duration;

use sortie::app::effect::{CrewEffect, Effect};
use sortie::app::event::{CrewEvent, ReplayEvent, SessionEvent, VehicleEvent};
use sortie::app::state::{Activity, CrewPart, MemberPlace, ReplayPosition, ReplayView, Room};
use sortie::campaign::Stake;
use sortie::crew::Role;
use sortie::crew::protocol::{HostMessage, MemberMessage, RosterLine, VERSION};
use sortie::language::verb;
use sortie::ledger::{EntryId, Risk, RowState, RowUpdate};
use sortie::mission::Progress;
use sortie::pilot_in_command::{Person, PilotsInCommand};
use sortie::text::{Language, Locale};

use super::check;
use crate::fixtures;
use crate::harness::Console;

mod host;

fn mission() -> Activity {
    Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Practice,
    }
}

/// A member before the host has let it in.
fn waiting(language: Language) -> Console {
    Console::set_up(|setup| {
        setup.locale = Locale::new(language).into();
        setup.crew = CrewPart::Member(Box::new(MemberPlace::new("alpha")));
    })
}

/// A member that sees the host's flight before it begins: anna flies 1 and 2, bohdan the others.
fn joined(language: Language, role: Role) -> Console {
    let mut console = waiting(language);
    console.hear(CrewEvent::Said(HostMessage::Welcome {
        protocol: VERSION,
        crew: "alpha".into(),
        host: "bohdan".into(),
        name: "anna".into(),
        role,
    }));
    let line = |name: &str, role| RosterLine {
        name: name.into(),
        role,
        proposals: Vec::new(),
    };
    console.hear(CrewEvent::Said(HostMessage::Roster(vec![
        line("bohdan", None),
        line("anna", Some(role)),
        line("olena", Some(Role::Safety)),
    ])));
    let view = ReplayView {
        is_live: true,
        ..ReplayView::new(
            "2026-11-27_m01".to_owned(),
            1_763_647_402_000_000,
            Duration::ZERO,
        )
    };
    console.replay(view, mission());
    let [anna, bohdan] = ["anna", "bohdan"].map(Person::named);
    let flown = [(anna.clone(), vec![1, 2])];
    let pilots = PilotsInCommand::seen_by(&anna, &bohdan, &flown);
    console.hear(VehicleEvent::Pilots(pilots));
    // The welcome on the last line has been read.
    console.at(20);
    console.hear(CrewEvent::Said(HostMessage::Here));
    console
}

/// A member that sees the host's flight.
fn following(language: Language, role: Role) -> Console {
    let mut console = joined(language, role);
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 20.0, 60.0));
    }
    let progress = Progress {
        hint: Some("Fly over the cells: `1 goto a1`.".into()),
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let position = ReplayPosition {
        at: Duration::from_secs(95),
        ..ReplayPosition::default()
    };
    console.hear(ReplayEvent::At(position));
    for (number, (line, by, vehicles)) in [
        ("all takeoff 20", Some(Person::named("bohdan")), vec![3, 4]),
        ("1-2 takeoff 20", None, vec![1, 2]),
    ]
    .into_iter()
    .enumerate()
    {
        console.hear(VehicleEvent::Given {
            at: Duration::from_secs(80),
            line: line.to_owned(),
            verb: verb("takeoff").expect("a verb"),
            risk: Risk::None,
            by,
            vehicles: vehicles.clone(),
        });
        for vehicle in vehicles {
            console.hear(VehicleEvent::Row(RowUpdate {
                entry: EntryId(number as u32),
                vehicle,
                state: RowState::Done,
                tries: 1,
                at: Duration::from_secs(90),
                explanation: None,
            }));
        }
    }
    console
}

#[test]
fn a_member_reads_the_brief_until_the_host_begins() {
    check("crew_brief", &joined(Language::English, Role::Pilot));
    let mut console = following(Language::English, Role::Pilot);
    assert_eq!(console.state().room(), Room::Fly);
    // In flight, the member opens it, and it stays.
    console.press("b");
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    assert_eq!(console.state().room(), Room::Mission);
}

#[test]
fn a_member_sees_the_flight_and_who_flies_what() {
    check("crew_member", &following(Language::English, Role::Pilot));
    check(
        "crew_member_uk",
        &following(Language::Ukrainian, Role::Pilot),
    );
}

#[test]
fn a_member_sees_that_the_host_says_nothing() {
    let mut console = following(Language::English, Role::Pilot);
    console.at(29);
    let header = |console: &Console| console.screen(80, 24).lines().next().map(str::to_owned);
    assert!(!header(&console).is_some_and(|it| it.contains("NO WORD")));
    console.at(31);
    let shown = header(&console).unwrap_or_default();
    assert!(shown.contains("CREW, NO WORD FOR 11 s"), "{shown}");
}

#[test]
fn a_member_is_offered_only_what_is_open_and_refused_the_rest_with_the_reason() {
    let footer = |console: &Console| console.screen(200, 24).lines().last().map(str::to_owned);
    let has = |role: Role, word: &str| {
        let footer = footer(&following(Language::English, role)).unwrap_or_default();
        footer.contains(word)
    };
    for role in Role::ALL {
        assert!(!has(role, "pause"), "{role:?}");
        assert!(has(role, "help"), "{role:?}");
        let flies = role == Role::Pilot || role == Role::Safety;
        assert_eq!(has(role, "commands"), flies, "{role:?}");
    }
    let mut console = following(Language::English, Role::Pilot);
    for key in ["p", ">"] {
        console.press(key);
        let said = footer(&console).unwrap_or_default();
        let expected = "only the host can do this: it concerns the whole flight";
        assert!(said.contains(expected), "{key}: {said}");
    }
    for line in ["pause", "speedup 2", "restart", "abandon", "fly m01"] {
        console.give(line);
        let shown = console.screen(120, 40);
        assert!(
            shown.contains("only the host can do this"),
            "{line}: {shown}"
        );
        console.press("esc");
    }
}

#[test]
fn the_keys_offered_are_those_of_the_role() {
    let keys = |role: Role| {
        let screen = following(Language::English, role).screen(80, 24);
        screen.lines().last().unwrap_or_default().to_owned()
    };
    let pilot = keys(Role::Pilot);
    assert!(pilot.contains("  a t g l r h m d commands"), "{pilot}");
    let safety = keys(Role::Safety);
    assert!(safety.contains("  l r h d commands"), "{safety}");
}

#[test]
fn a_member_without_vehicles_reads_the_role_in_the_header() {
    let header = |role: Role| {
        let mut console = following(Language::English, role);
        let [anna, bohdan] = ["anna", "bohdan"].map(Person::named);
        let pilots = PilotsInCommand::seen_by(&anna, &bohdan, &[]);
        console.hear(VehicleEvent::Pilots(pilots));
        let screen = console.screen(120, 40);
        screen.lines().next().unwrap_or_default().to_owned()
    };
    for (role, words) in [
        (Role::Pilot, "you fly no vehicle"),
        (Role::Sensors, "   sensors   "),
        (Role::Safety, "   safety   "),
        (Role::Observer, "   observer   "),
    ] {
        let shown = header(role);
        assert!(shown.contains(words), "{role:?}: {shown}");
    }
}

#[test]
fn the_badge_of_a_member_is_whole_on_a_narrow_screen() {
    let mut console = following(Language::Ukrainian, Role::Pilot);
    let [anna, bohdan] = ["anna", "bohdan"].map(Person::named);
    let pilots = PilotsInCommand::seen_by(&anna, &bohdan, &[]);
    console.hear(VehicleEvent::Pilots(pilots));
    let header = |console: &Console| {
        let screen = console.screen(80, 24);
        screen.lines().next().unwrap_or_default().to_owned()
    };
    let shown = header(&console);
    assert!(shown.contains(" ЕКІПАЖ "), "{shown}");
    console.at(33);
    let shown = header(&console);
    assert!(shown.contains(" ЕКІПАЖ, 13 с БЕЗ ВІДПОВІДІ "), "{shown}");
}

#[test]
fn a_member_says_when_a_line_was_given_and_sees_that_it_waits() {
    let mut console = following(Language::English, Role::Pilot);
    for (at, ms) in [(20, 100_000), (21, 101_000), (23, 101_900)] {
        console.at(at);
        console.hear(CrewEvent::Said(HostMessage::Clock { ms }));
    }
    console.at(24).give("1 land");
    let said = console.effects.iter().find_map(|effect| match effect {
        Effect::Crew(CrewEffect::Say(MemberMessage::Say { id, given_ms, .. })) => {
            Some((*id, *given_ms))
        }
        _ => None,
    });
    let (id, given_ms) = said.expect("the host is asked");
    // Words that took their time do not set the clock back.
    assert_eq!(given_ms, Some(104_000));
    let words = "waiting for the host: 1 land";
    assert!(!console.screen(120, 40).contains(words));
    let mut told = console.clone();
    told.at(26);
    assert!(told.screen(120, 40).contains(words));
    let answer = HostMessage::Answer { id, fault: None };
    console.hear(CrewEvent::Said(answer)).at(26);
    assert!(!console.screen(120, 40).contains(words));
}

#[test]
fn a_console_without_a_screen_says_that_it_ends_with_the_crew() {
    let said = |has_rooms| {
        let mut console = Console::set_up(|setup| {
            setup.has_rooms = has_rooms;
            setup.crew = CrewPart::Member(Box::new(MemberPlace::new("alpha")));
        });
        console.hear(CrewEvent::Said(HostMessage::Welcome {
            protocol: VERSION,
            crew: "alpha".into(),
            host: "bohdan".into(),
            name: "anna".into(),
            role: Role::Pilot,
        }));
        console.hear(CrewEvent::Said(HostMessage::Closing));
        let message = console.state().message();
        message.map(|it| it.text.to_string()).unwrap_or_default()
    };
    assert!(said(true).ends_with("`quit` leaves"));
    let ends = "bohdan has ended the crew: this console ends";
    assert_eq!(said(false), ends);
}

#[test]
fn the_palette_of_a_member_lists_the_verbs_of_the_role() {
    let lists = |role: Role, written: &str, verb: &str| {
        let mut console = following(Language::English, role);
        console.press(":").write(written);
        let shown = console.screen(120, 40);
        let edges = ['│', ' ', '>'];
        let mut lines = shown.lines();
        lines.any(|line| line.trim_start_matches(edges).starts_with(verb))
    };
    assert!(lists(Role::Pilot, "takeo", "takeoff"));
    assert!(!lists(Role::Safety, "takeo", "takeoff"));
    assert!(lists(Role::Safety, "lan", "land"));
    assert!(!lists(Role::Observer, "lan", "land"));
    assert!(!lists(Role::Pilot, "paus", "pause"));
}

#[test]
fn a_member_waits_for_its_crew() {
    check("crew_waiting", &waiting(Language::English));
}

#[test]
fn the_crew_is_listed_with_roles_and_vehicles() {
    let mut console = following(Language::English, Role::Pilot);
    console.give("crew");
    check("crew_list", &console);
}

#[test]
fn a_proposal_has_the_words_to_type() {
    let mut console = following(Language::English, Role::Pilot);
    let offer = sortie::text!("crew-offers", who = "bohdan", vehicles = "3");
    console.hear(CrewEvent::Said(HostMessage::Notice((&offer).into())));
    check("crew_offer", &console);
}
