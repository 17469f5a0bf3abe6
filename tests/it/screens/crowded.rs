//! A mission with every kind of object at once: areas, people and aircraft, contacts, alerts, loads.

use std::time::Duration;

use sortie::app::effect::{Effect, SessionEffect};
use sortie::app::event::SessionEvent;
use sortie::app::state::Activity;
use sortie::campaign::Stake;
use sortie::commands::FindKind;
use sortie::config::Symbols;
use sortie::geo::Outline;
use sortie::mission::{
    Area, AreaKind, ClueProgress, Ground, Inject, LoadLeft, MoverKind, MovingThing, OpenAlert,
    Progress, ShownContact, ShownMark, Trust,
};
use sortie::scoring::AlertLevel;
use sortie::text::Language;

use super::map::{drawn, resized};
use crate::fixtures;
use crate::harness::Console;

fn area(name: &str, kind: AreaKind, north_m: f64, east_m: f64, side_m: f64) -> Area {
    Area {
        name: name.to_owned(),
        kind,
        outline: Outline::square(fixtures::HOME.moved(north_m, east_m), side_m),
        ceiling_m: None,
    }
}

fn progress() -> Progress {
    let mover = |name: &str, kind, north_m, east_m| MovingThing {
        name: name.to_owned(),
        kind,
        at: fixtures::HOME.moved(north_m, east_m),
        height_m: 30.0,
        // Too high to be a danger.
        altitude_amsl_m: 900.0,
        velocity_m_s: [0.0, 20.0],
        callsign: name.to_uppercase(),
        keep_out_m: 15.0,
    };
    let contact = |name: &str, trust, north_m| ShownContact {
        name: name.to_owned(),
        kind: FindKind::Mine,
        at: fixtures::HOME.moved(north_m, 30.0),
        trust,
    };
    let alert = |text: &str, level, seconds| OpenAlert {
        text: text.into(),
        level,
        remaining: Duration::from_secs(seconds),
    };
    let load = |name: &str, left| LoadLeft {
        vehicle: 1,
        load: name.into(),
        left,
        unit: "",
    };
    Progress {
        cells: Vec::new(),
        loads: vec![load("ball", 3), load("kit", 1)],
        areas: vec![
            area("fence", AreaKind::Geofence, 50.0, 20.0, 240.0),
            area("school", AreaKind::NoFly, 110.0, -40.0, 50.0),
            area("valley", AreaKind::Jamming, 110.0, 70.0, 60.0),
            area("square", AreaKind::People, 30.0, -40.0, 50.0),
            area("ridge", AreaKind::Radio, 30.0, 90.0, 50.0),
        ],
        movers: vec![
            mover("walker", MoverKind::Person, 70.0, -10.0),
            mover("heli", MoverKind::Aircraft, 140.0, -25.0),
        ],
        contacts: vec![
            contact("c1", Trust::Seen, 20.0),
            contact("c2", Trust::Confirmed, 40.0),
            contact("c3", Trust::Reported, 60.0),
        ],
        marks: vec![ShownMark {
            kind: Some(FindKind::Mine),
            at: fixtures::HOME.moved(80.0, 30.0),
        }],
        alerts: vec![
            alert(
                "a helicopter comes in: go below 20 m",
                AlertLevel::Critical,
                12,
            ),
            alert("drone 2 is jammed: bring it out", AlertLevel::Warning, 40),
        ],
        margins_db: [(1, 20.0), (2, 3.4)].into(),
        clues: ClueProgress {
            is_news: true,
            given: vec![(1, "look upwind".into())],
            next: Some((2, 0.05)),
            factor: 0.98,
        },
        injects: vec![Inject {
            name: "gust".to_owned(),
            title: "A gust".into(),
        }],
        ..fixtures::progress()
    }
}

fn crowded() -> Console {
    let mut console = Console::new();
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    for id in 1..=3 {
        console.vehicle(fixtures::airborne(id, 20.0 * f64::from(id), 20.0));
    }
    console.hear(SessionEvent::Mission(Box::new(progress())));
    console.at(1).press("F");
    console
}

#[test]
fn alerts_loads_contacts_and_hints_are_in_the_flight_screen() {
    for size in [(80, 24), (200, 50)] {
        let console = resized(crowded(), size);
        let text = drawn(&console, Symbols::Braille, Language::English, size);
        insta::assert_snapshot!(format!("crowded_fly_{}x{}", size.0, size.1), text);
    }
}

/// One kind of detector confirms nothing.
#[test]
fn confirmed_contacts_are_counted_only_where_a_second_kind_of_detector_can_confirm() {
    let shown = |can_confirm| {
        let mut console = crowded();
        let progress = Progress {
            can_confirm,
            ..progress()
        };
        console.hear(SessionEvent::Mission(Box::new(progress)));
        let size = (80, 24);
        let text = drawn(
            &resized(console, size),
            Symbols::Braille,
            Language::English,
            size,
        );
        [text.contains("confirmed 1"), text.contains("contacts 3")]
    };
    assert_eq!(shown(true), [true, true]);
    assert_eq!(shown(false), [false, true]);
}

#[test]
fn what_cannot_wait_is_told_in_every_room_and_in_ukrainian() {
    let mut console = resized(crowded(), (80, 24));
    let fly = drawn(&console, Symbols::Braille, Language::Ukrainian, (80, 24));
    insta::assert_snapshot!("crowded_fly_uk_80x24", fly);
    for (key, expected) in [
        ("F", "! 12 s: a helicopter comes in: go below 20 m"),
        ("M", "! 12 s: a helicopter comes in: go below 20 m"),
        ("V", "! 12 s"),
        ("B", "! 12 s"),
        ("I", "! 12 s"),
    ] {
        let text = console.press(key).screen(80, 24);
        assert!(text.contains(expected), "{key}: {text}");
    }
}

#[test]
fn of_many_things_that_cannot_wait_the_rest_is_counted() {
    let mut console = resized(crowded(), (80, 24));
    let mut progress = progress();
    progress.margins_db = (1..=9).map(|id| (id, 1.0)).collect();
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let text = console.screen(80, 24);
    assert!(text.contains("! weak radio link to 1: 1 dB"), "{text}");
    assert!(text.contains("and 8 more urgent"), "{text}");
    assert!(!text.contains("! weak radio link to 2"), "{text}");
}

#[test]
fn a_pause_is_on_the_screen_until_it_ends() {
    let size = (80, 24);
    let mut console = resized(crowded(), size);
    console.hear(SessionEvent::Paused(true));
    for language in Language::ALL {
        let text = drawn(&console, Symbols::Braille, language, size);
        let name = format!("crowded_paused_{}_80x24", language.code());
        insta::assert_snapshot!(name, text);
    }
    console.hear(SessionEvent::Paused(false));
    assert!(!console.screen(80, 24).contains("PAUSED"));
}

#[test]
fn burnt_ground_is_edged_as_it_was_seen_and_explained() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    console.press("M").press("z");
    let before = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(!before.contains("fire: burnt"), "{before}");
    let ground = |north_m, east_m| Ground {
        centre: fixtures::HOME.moved(north_m, east_m),
        side_m: 20.0,
    };
    let block = [-20.0, 0.0, 20.0].map(|north| [-20.0, 0.0, 20.0].map(|east| (north, east)));
    let block = block.concat().into_iter();
    let progress = Progress {
        mapped: block
            .map(|(north, east)| ground(100.0 + north, -90.0 + east))
            .collect(),
        ..progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("z");
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(
        text.contains("fire: burnt, flames") && text.contains("%%%"),
        "{text}"
    );
    insta::assert_snapshot!("burnt_map_120x40", text);
}

#[test]
fn names_on_the_map_are_whole_or_only_a_sign_but_never_run_into_each_other() {
    let size = (80, 24);
    let mut console = resized(crowded(), size);
    let contact = |number: u32| ShownContact {
        name: format!("c{number}"),
        kind: FindKind::Mine,
        at: fixtures::HOME.moved(100.0, f64::from(number) * 4.0),
        trust: Trust::Confirmed,
    };
    let progress = Progress {
        contacts: (10..30).map(contact).collect(),
        ..progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    let row = text
        .lines()
        .find(|line| line.contains("!c29"))
        .expect("the newest contact");
    for word in row.split_whitespace().filter(|word| word.starts_with('!')) {
        let name = word.trim_start_matches('!');
        let known = name
            .strip_prefix('c')
            .and_then(|number| number.parse().ok());
        assert!(
            name.is_empty() || known.is_some_and(|it: u32| (10..30).contains(&it)),
            "{row}"
        );
    }
}

#[test]
fn what_one_sensor_has_seen_is_a_sign_and_only_the_nearest_has_its_name() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    let contact = |number: u32| ShownContact {
        name: format!("c{number}"),
        kind: FindKind::Mine,
        at: fixtures::HOME.moved(
            100.0 + f64::from(number % 7) * 12.0,
            f64::from(number) * 5.0,
        ),
        trust: Trust::Seen,
    };
    let progress = Progress {
        contacts: (10..30).map(contact).collect(),
        ..progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    let named = |console: &Console| {
        let text = drawn(console, Symbols::Ascii, Language::English, size);
        let words = text.split_whitespace().map(str::to_owned);
        words
            .filter(|word| word.starts_with("?c"))
            .collect::<Vec<_>>()
    };
    // The legend contains one of the names as well.
    assert_eq!(named(&console).len(), 2, "nearest to the vehicle");
    for _ in 0..12 {
        console.press("l");
    }
    let names = named(&console);
    assert!(
        (2..=3).contains(&names.len()),
        "also to the cursor: {names:?}"
    );
}

#[test]
fn fire_is_a_field_and_what_was_searched_a_light_shade() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    let fire = |number: u32| ShownContact {
        name: format!("c{number}"),
        kind: FindKind::Fire,
        at: fixtures::HOME.moved(100.0, f64::from(number) * 12.0 - 200.0),
        trust: if number > 8 {
            Trust::Confirmed
        } else {
            Trust::Seen
        },
    };
    let ground = |north_m, east_m| Ground {
        centre: fixtures::HOME.moved(north_m, east_m),
        side_m: 20.0,
    };
    let progress = Progress {
        contacts: (1..12).map(fire).collect(),
        mapped: (0..6)
            .map(|at| ground(120.0, f64::from(at) * 20.0 - 200.0))
            .collect(),
        swept: (0..6)
            .map(|at| ground(60.0, f64::from(at) * 20.0 - 200.0))
            .collect(),
        ..progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    let text = drawn(&console, Symbols::Braille, Language::English, size);
    let names = text.matches("?c").count() + text.matches("!c").count();
    assert!(names <= 1, "a field has no names but the nearest: {text}");
    for shown in [
        "fire ▒ burnt",
        "▓ flames, one sensor",
        "█ flames, confirmed",
        "····",
        "searched or sampled",
    ] {
        assert!(text.contains(shown), "{shown}: {text}");
    }
    insta::assert_snapshot!("fire_map_120x40", text);
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(text.contains("^^^") && text.contains(",,,"), "{text}");
}

#[test]
fn areas_people_aircraft_and_contacts_are_on_the_map_and_told_apart_by_signs() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    console.press("M").press("z");
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    for sign in [
        "x school", "~ valley", "& square", "% ridge", "P:walker", "A>HELI", "?c1", "!c2", "#c3",
        "#mine",
    ] {
        assert!(text.contains(sign), "{sign}: {text}");
    }
    insta::assert_snapshot!("crowded_map_120x40", text);
}

#[test]
fn an_area_that_is_switched_off_and_a_walker_who_is_gone_leave_the_map() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    console.press("M").press("z");
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(
        !text.contains("x school") && !text.contains("P:walker"),
        "{text}"
    );
}

#[test]
fn the_room_of_the_mission_tells_what_the_next_hint_takes() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    console.press("B");
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(text.contains("hint 1: look upwind"), "{text}");
    assert!(text.contains("level 2: it costs 5 %"), "{text}");
    let mut progress = progress();
    progress.clues.next = Some((2, 0.0));
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    assert!(text.contains("level 2: it is free"), "{text}");
}

#[test]
fn a_hint_that_costs_points_is_asked_about_and_a_free_one_is_not() {
    for (price, asks) in [(0.10, true), (0.0, false)] {
        let mut console = resized(crowded(), (80, 24));
        let mut progress = progress();
        progress.clues.next = Some((3, price));
        console.hear(SessionEvent::Mission(Box::new(progress)));
        console.write(":hint").press("enter");
        let text = drawn(&console, Symbols::Ascii, Language::English, (80, 24));
        assert_eq!(text.contains("costs 10 % of the score"), asks, "{text}");
        let sent = console.effects.iter();
        let sent = sent.filter(|effect| matches!(effect, Effect::Order { .. }));
        assert_eq!(sent.count(), usize::from(!asks));
    }
}

#[test]
fn what_an_instructor_may_have_happen_is_offered_by_name() {
    let mut console = crowded();
    console.press("e");
    for language in Language::ALL {
        let text = drawn(&console, Symbols::Braille, language, (80, 24));
        insta::assert_snapshot!(format!("inject_{}_80x24", language.code()), text);
    }
    console.write("gust").press("enter");
    assert!(
        matches!(console.effects.as_slice(), [Effect::Session(SessionEffect::Inject(name))] if name == "gust"),
        "{:?}",
        console.effects
    );
    console.give("inject flood");
    assert!(console.effects.is_empty(), "{:?}", console.effects);
}

#[test]
fn a_few_contacts_all_have_their_names_on_the_map() {
    let size = (120, 40);
    let mut console = resized(crowded(), size);
    let contact = |number: u32, trust| ShownContact {
        name: format!("c{number}"),
        kind: FindKind::Mine,
        at: fixtures::HOME.moved(100.0 + f64::from(number) * 15.0, f64::from(number) * 12.0),
        trust,
    };
    let contacts = (1..=3).map(|number| contact(number, Trust::Seen));
    let progress = Progress {
        contacts: contacts.collect(),
        ..progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    let text = drawn(&console, Symbols::Ascii, Language::English, size);
    for name in ["?c1", "?c2", "?c3"] {
        assert!(text.contains(name), "{name}: {text}");
    }
}
