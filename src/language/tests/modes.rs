//! Modes that vehicles announce, in lines and completion.

use super::*;
use crate::vehicle::{AnnouncedMode, Vehicle};

/// A vehicle with its own modes: one for users, one that only it sets.
fn own(id: u8) -> Vehicle {
    let mut vehicle = Vehicle::new(id, 1);
    for (index, number, name, is_selectable) in
        [(1, 65, "LAWN_MOWER", true), (2, 66, "HIDE", false)]
    {
        let mode = AnnouncedMode {
            index,
            number,
            name: name.to_owned(),
            is_selectable,
        };
        vehicle.modes.add(mode, 2);
    }
    vehicle
}

fn offered(vehicles: &[Vehicle]) -> Vec<String> {
    let modes = OfferedModes::of(vehicles.iter());
    let context = Context {
        modes: modes.as_ref(),
        ..Context::default()
    };
    let line = "mode ";
    let completions = complete(line, line.len(), &context);
    completions.into_iter().map(|it| it.text).collect()
}

#[test]
fn completion_offers_the_announced_modes_that_users_may_set() {
    assert_eq!(offered(&[own(1)]), ["LAWN_MOWER"]);
    let mixed = offered(&[own(1), Vehicle::new(2, 1)]);
    assert!(mixed.contains(&"LAWN_MOWER".to_owned()), "{mixed:?}");
    assert!(mixed.contains(&"GUIDED".to_owned()), "{mixed:?}");
    assert!(!mixed.contains(&"HIDE".to_owned()), "{mixed:?}");
    let plain = offered(&[Vehicle::new(2, 1)]);
    assert!(plain.contains(&"GUIDED".to_owned()), "{plain:?}");
}

#[test]
fn announced_modes_are_read_in_any_case_and_as_a_verb() {
    let modes = OfferedModes::of([own(1)].iter());
    let context = Context {
        modes: modes.as_ref(),
        ..Context::default()
    };
    for (line, expected) in [
        ("mode lawnmower", "LAWN_MOWER"),
        ("lawn_mower", "LAWN_MOWER"),
        // The vehicle refuses it with the reason.
        ("mode hide", "HIDE"),
    ] {
        let statement = parse(line, &context).expect(line);
        let Meaning::Act(Act::Command(command)) = statement.meaning else {
            panic!("{line}");
        };
        let expected = Command::Flight(FlightCommand::SetMode {
            name: expected.to_owned(),
        });
        assert_eq!(command, expected, "{line}");
    }
    assert!(parse("mode lawnmower", &Context::default()).is_err());
}
