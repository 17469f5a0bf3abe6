//! Questions about the plans on board.

use std::sync::Arc;

use sortie::app::state::Overlay;
use sortie::plan::Item;
use sortie::vehicle::{Plan, Severity, Stored, Transfer, Vehicle};

use crate::fixtures;
use crate::harness::Console;

/// A vehicle that carries this many items after home.
fn carrying(id: u16, items: usize) -> Vehicle {
    let mut vehicle = fixtures::parked(id);
    vehicle.plans.plan = Stored {
        content: Some(Arc::new(Plan {
            items: vec![Item::default(); items + 1],
            home_first: true,
        })),
        transfer: Transfer::Done,
    };
    vehicle
}

fn said(console: &mut Console, line: &str) -> (Severity, String) {
    console.give(line);
    if let Some(Overlay::Palette(palette)) = console.state().overlay() {
        panic!("{line}: {:?}", palette.fault());
    }
    let message = console.state().message().expect("an answer");
    (message.severity, message.text.to_string())
}

#[test]
fn the_console_says_which_vehicles_differ() {
    let mut console = Console::flying(0);
    for id in 1..=5 {
        let items = if id == 4 { 2 } else { 3 };
        console.vehicle(carrying(id, items));
    }
    console.vehicle(fixtures::parked(6));
    let (severity, all) = said(&mut console, "all plan status");
    assert_eq!(severity, Severity::Warning);
    assert!(all.starts_with("4 of 6 carry plan "), "{all}");
    assert!(all.contains("4 differs: 4 with 2 items ("), "{all}");
    assert!(all.ends_with("; not read yet: 6"), "{all}");
    let (severity, some) = said(&mut console, "1-3 plan status");
    assert_eq!(severity, Severity::Notice);
    assert!(
        some.starts_with("3 of 3 carry plan ") && some.ends_with("(3 items)"),
        "{some}"
    );
    let (_, fence) = said(&mut console, "1-2 fence status");
    assert_eq!(fence, "not read yet: 1-2");
    assert!(console.effects.is_empty(), "nothing is sent");
}

/// A question about a vehicle that was never heard is a fault of the line, not an empty answer.
#[test]
fn a_question_about_an_unknown_vehicle_is_a_fault() {
    let fault = |console: &mut Console, line: &str| {
        console.give(line);
        let Some(Overlay::Palette(palette)) = console.state().overlay() else {
            panic!("{line} is accepted");
        };
        palette.fault().expect("a fault").message.to_string()
    };
    let mut console = Console::flying(0);
    let none = fault(&mut console, "9 plan status");
    assert!(none.contains("no vehicle"), "{none}");
    for id in [1, 2, 4] {
        console.vehicle(carrying(id, 3));
    }
    for line in ["9 plan status", "2,9 rally status"] {
        assert_eq!(fault(&mut console, line), "no vehicle 9, only 1-2,4");
    }
}
