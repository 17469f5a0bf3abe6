//! Autopilots other than ArduPilot.

use super::*;

/// A copter with PX4, in its mode AUTO.LOITER.
fn with_px4() -> Vehicle {
    let mut vehicle = flying("LOITER");
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.autopilot = 12;
        heartbeat.mode = crate::vehicle::Mode {
            class: VehicleClass::Other,
            number: 0x0304_0000,
        };
    }
    vehicle
}

#[test]
fn other_autopilots_get_no_mode_numbers_of_ardupilot() {
    let px4 = with_px4();
    let guided = Command::Flight(FlightCommand::SetMode {
        name: "GUIDED".to_owned(),
    });
    let refusal = guided.request(&px4, 0).map(drop);
    let text = "it does not run ArduPilot: its modes are not known by name; use `land` or `rtl`";
    assert_eq!(refusal.map_err(|why| why.to_string()), Err(text.to_owned()));
    let refusal = offset(0.0).request(&px4, 0).map(drop);
    let text = "goto needs GUIDED, a mode of ArduPilot, which this vehicle does not run";
    assert_eq!(refusal.map_err(|why| why.to_string()), Err(text.to_owned()));
}

#[test]
fn other_autopilots_land_and_return_without_a_mode_to_wait_for() {
    let px4 = with_px4();
    for (command, number) in [
        (FlightCommand::Land, 21),
        (FlightCommand::ReturnToLaunch, 20),
    ] {
        let command = Command::Flight(command);
        assert_eq!(long(&command, &px4).0, number);
        assert_eq!(command.effect(&px4).seen(&px4), None, "{command:?}");
        assert!(command.claim(&px4).is_empty(), "{command:?}");
    }
}

#[test]
fn px4_gets_the_parts_of_an_announced_mode() {
    let mut px4 = with_px4();
    px4.modes.add(
        crate::vehicle::AnnouncedMode {
            index: 1,
            number: 0x0304_0000,
            name: "Mission".to_owned(),
            is_selectable: true,
        },
        1,
    );
    let mission = Command::Flight(FlightCommand::SetMode {
        name: "mission".to_owned(),
    });
    let (number, fields) = long(&mission, &px4);
    assert_eq!(number, 176);
    assert_eq!(fields[..3], [1.0, 4.0, 3.0]);
    // It is in this mode already.
    assert_eq!(mission.effect(&px4).seen(&px4), Some(true));
}
