//! Modes that vehicles announce, in lines and completion.

use super::*;
use crate::vehicle::{AnnouncedMode, Vehicle};

/// A vehicle with its own modes: one for users, and one that only the vehicle itself sets.
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

#[test]
fn announced_names_in_another_spelling_keep_their_place_and_their_warning() {
    let mut vehicle = Vehicle::new(1, 1);
    let names = ["Lawn_Mower", "Stabilize", "Loiter", "Guided", "Smart_RTL"];
    for (place, name) in names.into_iter().enumerate() {
        let mode = AnnouncedMode {
            index: place as u8 + 1,
            number: 60 + place as u32,
            name: name.to_owned(),
            is_selectable: name != "Smart_RTL",
        };
        vehicle.modes.add(mode, 5);
    }
    // One vehicle has the built-in names; its LOITER is not offered a second time.
    let plain = Vehicle::new(2, 1);
    let modes = OfferedModes::of([vehicle, plain].iter());
    let context = Context {
        modes: modes.as_ref(),
        ..Context::default()
    };
    let line = "mode ";
    let completions = complete(line, line.len(), &context);
    let found: Vec<&str> = completions.iter().map(|it| it.text.as_str()).collect();
    assert_eq!(found[..2], ["Guided", "Loiter"]);
    for name in ["GUIDED", "LOITER", "STABILIZE", "SMART_RTL"] {
        assert!(!found.contains(&name), "{name} in {found:?}");
    }
    let hint = |name: &str| {
        let found = completions.iter().find(|it| it.text == name);
        found.map(|it| it.hint.to_string())
    };
    let usual = offered_hints();
    for (name, same) in [
        ("Guided", "GUIDED"),
        ("Loiter", "LOITER"),
        ("Stabilize", "STABILIZE"),
    ] {
        assert_eq!(hint(name).as_ref(), usual.get(same), "{name}");
    }
    assert_ne!(hint("Loiter"), hint("Lawn_Mower"), "it warns");
}

/// The hints of the built-in modes.
fn offered_hints() -> std::collections::BTreeMap<String, String> {
    let line = "mode ";
    let completions = complete(line, line.len(), &Context::default());
    let hints = completions.into_iter();
    hints.map(|it| (it.text, it.hint.to_string())).collect()
}

#[test]
fn rovers_and_planes_have_purposes_of_their_own() {
    let summary = |class, name| {
        let context = Context {
            class,
            ..Context::default()
        };
        super::super::modes::mode_summary(name, &context).to_string()
    };
    for (class, name, words) in [
        (VehicleClass::Copter, "RTL", "land there"),
        (VehicleClass::Rover, "RTL", "stop there"),
        (VehicleClass::Plane, "RTL", "circle above home"),
        (VehicleClass::Rover, "HOLD", "drifts"),
        (VehicleClass::Rover, "GUIDED", "ground stations"),
        (VehicleClass::Plane, "TAKEOFF", "straight ahead"),
    ] {
        let said = summary(class, name);
        assert!(said.contains(words), "{class:?} {name}: {said}");
    }
}
