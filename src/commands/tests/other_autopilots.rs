//! Autopilots other than ArduPilot.

use mavlink::dialects::ardupilotmega::{MavCmd, MavFrame};

use super::*;
use crate::vehicle::{AnnouncedMode, GlobalPosition, Heartbeat, Mode, Place};

/// Home is this far above sea level, in metres.
const HOME_AMSL_M: f64 = 488.0;

/// A copter of another autopilot in a mode, 20 m above home.
fn with_autopilot(autopilot: u8, class: VehicleClass, number: u32) -> Vehicle {
    let mut vehicle = flying("LOITER");
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.autopilot = autopilot;
        heartbeat.mode = Mode { class, number };
    }
    let home = LatLon::new(47.0, 8.0);
    vehicle.home = Some(Place {
        at_point: home,
        altitude_amsl_m: HOME_AMSL_M,
    });
    if let Some(global) = &mut vehicle.global {
        *global = GlobalPosition {
            at_point: home,
            altitude_m: 20.0,
            altitude_amsl_m: HOME_AMSL_M + 20.0,
            ..*global
        };
    }
    vehicle
}

/// A copter with PX4, in its mode AUTO.LOITER.
fn with_px4() -> Vehicle {
    with_autopilot(Heartbeat::PX4, VehicleClass::Px4, 0x0304_0000)
}

fn enters(vehicle: &mut Vehicle, mode: &str) {
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.mode = heartbeat.mode.class.mode(mode).expect("a mode");
    }
}

fn set_mode(name: &str) -> Command {
    Command::Flight(FlightCommand::SetMode {
        name: name.to_owned(),
    })
}

fn refused(command: &Command, vehicle: &Vehicle) -> String {
    let refusal = command.request(vehicle, 0).map(drop);
    refusal.expect_err("a refusal").to_string()
}

#[test]
fn other_autopilots_get_no_mode_numbers_of_ardupilot() {
    let other = with_autopilot(4, VehicleClass::Other, 7);
    assert_eq!(
        refused(&set_mode("GUIDED"), &other),
        "it does not run ArduPilot: its modes are not known by name; use `land` or `rtl`"
    );
    assert_eq!(
        refused(&offset(0.0), &other),
        "goto needs GUIDED, a mode of ArduPilot, which this vehicle does not run"
    );
    for (command, number) in [
        (FlightCommand::Land, 21),
        (FlightCommand::ReturnToLaunch, 20),
    ] {
        let command = Command::Flight(command);
        assert_eq!(long(&command, &other).0, number);
        assert_eq!(command.effect(&other).seen(&other), None, "{command:?}");
        assert!(command.claim(&other).is_empty(), "{command:?}");
    }
}

#[test]
fn px4_gets_the_parts_of_a_mode() {
    let px4 = with_px4();
    let why = "PX4 has no GUIDED and needs none: use `goto` or `takeoff` in any mode";
    assert_eq!(refused(&set_mode("GUIDED"), &px4), why);
    assert_eq!(refused(&set_mode("SPORT"), &px4), "it has no mode SPORT");
    for (name, main, sub) in [
        ("POSCTL", 3.0, 0.0),
        ("AUTO.MISSION", 4.0, 4.0),
        ("rtl", 4.0, 5.0),
        ("OFFBOARD", 6.0, 0.0),
        ("7", 7.0, 0.0),
    ] {
        let (number, fields) = long(&set_mode(name), &px4);
        assert_eq!(
            (number, &fields[..3]),
            (176, &[1.0, main, sub][..]),
            "{name}"
        );
    }
    let (_, fields) = long(&Command::Flight(FlightCommand::Hold), &px4);
    assert_eq!(fields[..3], [1.0, 4.0, 3.0]);
}

#[test]
fn px4_gets_the_parts_of_an_announced_mode() {
    let mut px4 = with_px4();
    px4.modes.add(
        AnnouncedMode {
            index: 1,
            number: 0x0304_0000,
            name: "Hold".to_owned(),
            is_selectable: true,
        },
        1,
    );
    let hold = set_mode("hold");
    let (number, fields) = long(&hold, &px4);
    assert_eq!(number, 176);
    assert_eq!(fields[..3], [1.0, 4.0, 3.0]);
    // It is in this mode already.
    assert_eq!(hold.effect(&px4).seen(&px4), Some(true));
    // The list is complete, and has no other modes.
    assert_eq!(refused(&set_mode("ACRO"), &px4), "it has no mode ACRO");
}

#[test]
fn px4_takes_off_to_a_height_above_sea_level() {
    let mut px4 = with_px4();
    let takeoff = Command::Flight(FlightCommand::Takeoff { altitude_m: 30.0 });
    let (number, fields) = long(&takeoff, &px4);
    assert_eq!((number, fields[0], fields[6]), (22, -1.0, 518.0));
    assert!(fields[3..6].iter().all(|field| field.is_nan()));
    let effect = takeoff.effect(&px4);
    enters(&mut px4, "AUTO.TAKEOFF");
    if let Some(global) = &mut px4.global {
        global.altitude_m = 30.0;
    }
    assert_eq!(effect.seen(&px4), Some(false), "the vehicle still climbs");
    assert_eq!(takeoff.claim(&px4).contradicted(&px4), None);
    enters(&mut px4, "AUTO.LOITER");
    assert_eq!(effect.seen(&px4), Some(true));
    assert_eq!(takeoff.claim(&px4).contradicted(&px4), None);
    enters(&mut px4, "POSCTL");
    assert!(takeoff.claim(&px4).contradicted(&px4).is_some());
    if let Some(heartbeat) = &mut px4.heartbeat {
        heartbeat.armed = false;
    }
    assert_eq!(
        refused(&takeoff, &px4),
        "takeoff needs an armed vehicle: use `3 arm` first"
    );
}

#[test]
fn px4_flies_to_places_by_reposition_with_a_change_of_mode() {
    let mut px4 = with_px4();
    px4.local = None;
    let goto = Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: LatLon::new(47.001, 8.0),
            altitude_m: Some(25.0),
        },
        heading: Heading::Fixed(270.0),
    });
    let request = goto.request(&px4, 0).expect("a request");
    let [Outgoing::Message(MavMessage::COMMAND_INT(sent))] = &request.messages[..] else {
        panic!("{request:?}");
    };
    assert_eq!(sent.command, MavCmd::MAV_CMD_DO_REPOSITION);
    assert_eq!(sent.frame, MavFrame::MAV_FRAME_GLOBAL);
    assert_eq!((sent.x, sent.y, sent.z), (470_010_000, 80_000_000, 513.0));
    assert_eq!((sent.param1, sent.param2), (-1.0, 1.0));
    assert!((sent.param4 + std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    let climb = Command::Motion(MotionCommand::Altitude { altitude_m: 40.0 });
    let (number, fields) = long(&climb, &px4);
    assert_eq!((number, fields[1], fields[6]), (192, 1.0, 528.0));
    assert!(fields[3..6].iter().all(|field| field.is_nan()));
    enters(&mut px4, "AUTO.TAKEOFF");
    let why = "still taking off: wait until `takeoff` shows `effect seen`, then goto";
    assert_eq!(refused(&goto, &px4), why);
    enters(&mut px4, "AUTO.RTL");
    assert!(goto.claim(&px4).contradicted(&px4).is_some());
    enters(&mut px4, "AUTO.LOITER");
    assert_eq!(goto.claim(&px4).contradicted(&px4), None);
}

#[test]
fn px4_lands_and_may_change_its_mode_when_it_disarms() {
    let mut px4 = with_px4();
    for (command, number, mode) in [
        (FlightCommand::Land, 21, "AUTO.LAND"),
        (FlightCommand::ReturnToLaunch, 20, "AUTO.RTL"),
    ] {
        let command = Command::Flight(command);
        assert_eq!(long(&command, &px4).0, number);
        let (effect, claim) = (command.effect(&px4), command.claim(&px4));
        assert_eq!(effect.seen(&px4), Some(false));
        let mut down = px4.clone();
        enters(&mut down, mode);
        assert_eq!(claim.contradicted(&down), None);
        down.landed = LandedState::OnGround;
        assert_eq!(effect.seen(&down), Some(true));
        enters(&mut down, "POSCTL");
        assert!(claim.contradicted(&down).is_some(), "a pilot took over");
        if let Some(heartbeat) = &mut down.heartbeat {
            heartbeat.armed = false;
        }
        assert_eq!(claim.contradicted(&down), None);
        assert_eq!(effect.seen(&down), Some(true));
    }
    enters(&mut px4, "AUTO.MISSION");
    assert!(px4.flies_plan());
}

#[test]
fn px4_orbits_in_a_mode_of_its_own() {
    let mut px4 = with_px4();
    let orbit = Command::Motion(MotionCommand::Orbit {
        radius_m: 30.0,
        speed_m_s: 4.0,
        centre: None,
        altitude_m: None,
    });
    let request = orbit.request(&px4, 0).expect("a request");
    let [Outgoing::Message(MavMessage::COMMAND_INT(sent))] = &request.messages[..] else {
        panic!("{request:?}");
    };
    assert_eq!(sent.command, MavCmd::MAV_CMD_DO_ORBIT);
    assert_eq!((sent.param1, sent.param2, sent.z), (30.0, 4.0, 508.0));
    assert_eq!(orbit.effect(&px4).seen(&px4), Some(false));
    enters(&mut px4, "POSCTL.ORBIT");
    assert_eq!(orbit.effect(&px4).seen(&px4), Some(true));
}

#[test]
fn what_px4_lacks_is_refused_with_its_reason() {
    let px4 = with_px4();
    let climb = MotionCommand::Speed {
        axis: SpeedAxis::Climb,
        speed_m_s: 2.0,
    };
    for (command, word) in [
        (Command::Motion(climb), "MPC_Z_VEL_MAX_UP"),
        (Command::Flight(FlightCommand::Resume), "plan resume"),
        (Command::PlanFlight(PlanFlight::Skip), "ArduPilot"),
        (
            Command::Device(DeviceCommand::Fence { on: true }),
            "GF_ACTION",
        ),
        (
            Command::Device(DeviceCommand::Relay { relay: 0, on: true }),
            "relays",
        ),
    ] {
        let why = refused(&command, &px4);
        assert!(why.contains("PX4") && why.contains(word), "{why}");
    }
}

#[test]
fn px4_gets_setpoints_before_the_mode_that_takes_them() {
    let mut px4 = with_px4();
    let velocity = Command::Motion(MotionCommand::Velocity {
        ned_m_s: [1.0, 0.0, 0.0],
        lasting: Duration::from_secs(5),
    });
    let (number, fields) = long(&velocity, &px4);
    assert_eq!((number, &fields[..3]), (176, &[1.0, 6.0, 0.0][..]));
    let offboard = |px4: &Vehicle| {
        let request = velocity.request(px4, 0).expect("a request");
        request.offboard.expect("it needs OFFBOARD")
    };
    assert!(offboard(&px4).lead > Duration::from_secs(1));
    enters(&mut px4, "OFFBOARD");
    assert_eq!(offboard(&px4).lead, Duration::ZERO);
    px4.heartbeat = px4.heartbeat.map(|heartbeat| Heartbeat {
        armed: false,
        ..heartbeat
    });
    assert!(refused(&velocity, &px4).contains("armed"));
}
