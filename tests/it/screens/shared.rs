//! Vehicles with another ground station in control, with a twin, and flown by keys.

use std::time::Duration;

use sortie::app::event::LinkEvent;
use sortie::app::state::LinkSummary;
use sortie::text::Language;
use sortie::vehicle::{ControlStatus, HeldChannels};

use crate::fixtures;
use crate::harness::Console;

/// Vehicle 1 is controlled here, 2 by another station, 3 has a twin, and channels of 4 are held.
fn shared(mut console: Console) -> Console {
    let status = |owner| {
        Some(ControlStatus {
            owner: Some(owner),
            others: [0; 10],
            takeover: owner == 255,
        })
    };
    for id in 1..=4 {
        let mut vehicle = fixtures::airborne(id, 30.0, 5.0);
        vehicle.link.via = Some(0);
        match id {
            1 => vehicle.control = status(255),
            2 => vehicle.control = status(250),
            3 => vehicle.twin = Some(Duration::from_secs(1)),
            _ => {
                let mut held = HeldChannels::default();
                held.hold(2, 1500);
                held.hold(0, 1650);
                vehicle.held = Some(held);
            }
        }
        console.vehicle(vehicle);
    }
    console.at(20);
    console
}

#[test]
fn the_table_marks_shared_vehicles() {
    for (width, height) in [(80, 24), (200, 50)] {
        let console = shared(Console::flying(4));
        let screen = console.screen(width, height);
        for mark in [" @", "3!", " RC"] {
            assert!(screen.contains(mark), "{mark}: {screen}");
        }
        insta::assert_snapshot!(format!("shared_table_{width}x{height}"), screen);
    }
}

#[test]
fn a_vehicle_names_the_station_in_control_and_the_held_channels() {
    let mut console = shared(Console::flying(4));
    console.press("V");
    let screen = console.screen(200, 50);
    assert!(
        screen.contains("this console, may be taken over"),
        "{screen}"
    );
    console.press("j");
    let screen = console.screen(80, 24);
    assert!(screen.contains("station 250"), "{screen}");
    console.press("j").press("j");
    let screen = console.screen(80, 24);
    assert!(screen.contains("1: 1650, 3: 1500"), "{screen}");
}

#[test]
fn the_room_of_links_lists_the_stations_in_control() {
    let mut console = shared(Console::flying(4));
    console.hear(LinkEvent::Summaries(vec![LinkSummary {
        up: true,
        ..LinkSummary::default()
    }]));
    console.press("L");
    let screen = console.screen(80, 24);
    assert!(screen.contains("250: 2; 255: 1"), "{screen}");
}

#[test]
fn the_sticks_are_shown_while_they_are_held() {
    for (language, name) in [(Language::English, "en"), (Language::Ukrainian, "uk")] {
        for (width, height) in [(80, 24), (200, 50)] {
            let mut console = Console::in_language(language).in_flight(3);
            console.press("J").press("right").press("w");
            let screen = console.screen(width, height);
            assert!(screen.contains("1700"), "{screen}");
            insta::assert_snapshot!(format!("sticks_{name}_{width}x{height}"), screen);
            console.press("esc");
            assert!(!console.screen(width, height).contains("1700"));
        }
    }
}
