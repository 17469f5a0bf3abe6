use std::time::Duration;

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavMessage};
use proptest::prelude::*;

use super::*;
use crate::geo::LatLon;
use crate::vehicle::{
    Attitude, GlobalPosition, Heartbeat, LandedState, LocalPosition, SpeedAxis, SystemStatus,
    Vehicle, VehicleClass,
};
use crate::wire::Outgoing;

mod other_autopilots;
mod outcome;

const HERE: LatLon = LatLon::new(50.45, 30.52);

/// A copter in a mode, 20 m above home and 10 m north of the origin, heading east.
pub(super) fn flying(mode: &str) -> Vehicle {
    let class = VehicleClass::Copter;
    let at = Duration::ZERO;
    let mut vehicle = Vehicle::new(3, 1);
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class,
        mode: class.mode(mode).expect("a copter's mode"),
        armed: true,
        status: SystemStatus::Active,
        at,
    });
    vehicle.landed = LandedState::InAir;
    vehicle.attitude = Some(Attitude {
        roll_deg: 0.0,
        pitch_deg: 0.0,
        yaw_deg: 90.0,
        at,
    });
    vehicle.global = Some(GlobalPosition {
        at_point: HERE,
        altitude_amsl_m: 200.0,
        altitude_m: 20.0,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: Some(90.0),
        at,
    });
    vehicle.local = Some(LocalPosition {
        ned_m: [10.0, 0.0, -20.0],
        velocity_m_s: [0.0; 3],
        at,
    });
    vehicle
}

fn on_the_ground(mode: &str) -> Vehicle {
    let mut vehicle = flying(mode);
    vehicle.landed = LandedState::OnGround;
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.armed = false;
    }
    vehicle
}

fn goto(destination: Destination, heading: Heading) -> Command {
    Command::Motion(MotionCommand::Goto {
        destination,
        heading,
    })
}

fn offset(up_m: f64) -> Command {
    let destination = Destination::Offset {
        north_m: 5.0,
        east_m: -2.0,
        up_m,
    };
    goto(destination, Heading::Keep)
}

fn only_message(command: &Command, vehicle: &Vehicle) -> MavMessage {
    let request = command.request(vehicle, 0).expect("it makes sense");
    match request.messages.as_slice() {
        [Outgoing::Message(message)] => message.clone(),
        other => panic!("{other:?}"),
    }
}

fn long(command: &Command, vehicle: &Vehicle) -> (u16, [f32; 7]) {
    match only_message(command, vehicle) {
        MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            param1,
            param2,
            param3,
            param4,
            param5,
            param6,
            param7,
            command,
            target_system: 3,
            target_component: 1,
            ..
        }) => (
            command as u16,
            [param1, param2, param3, param4, param5, param6, param7],
        ),
        other => panic!("{other:?}"),
    }
}

#[test]
fn commands_carry_the_parameters_that_the_recordings_show() {
    let guided = flying("GUIDED");
    let loiter = flying("LOITER");
    let ground = on_the_ground("GUIDED");
    let mut starting = flying("GUIDED");
    starting.landed = LandedState::OnGround;
    let turn = |angle_deg| {
        Command::Motion(MotionCommand::Yaw {
            angle_deg,
            relative: true,
            rate_deg_s: None,
        })
    };
    let mode = |name: &str| {
        Command::Flight(FlightCommand::SetMode {
            name: name.to_owned(),
        })
    };
    let climb = Command::Motion(MotionCommand::Speed {
        axis: SpeedAxis::Climb,
        speed_m_s: 4.0,
    });
    let interval = |rate_hz| {
        Command::Query(QueryCommand::Interval {
            message: 30,
            rate_hz,
        })
    };
    let cases: [(Command, &Vehicle, u16, &[f32]); 14] = [
        (Command::Arming(ArmingCommand::Arm), &ground, 400, &[1.0]),
        (Command::Arming(ArmingCommand::Disarm), &ground, 400, &[0.0]),
        (
            Command::Arming(ArmingCommand::Kill),
            &guided,
            400,
            &[0.0, 21196.0],
        ),
        (mode("guided"), &loiter, 176, &[1.0, 4.0]),
        (mode("27"), &loiter, 176, &[1.0, 27.0]),
        (
            Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
            &ground,
            22,
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 20.0],
        ),
        (Command::Flight(FlightCommand::Hold), &guided, 193, &[0.0]),
        (
            Command::Flight(FlightCommand::Hold),
            &loiter,
            176,
            &[1.0, 17.0],
        ),
        // A copter takes off despite a pause if it still stands on the ground.
        (
            Command::Flight(FlightCommand::Hold),
            &starting,
            176,
            &[1.0, 17.0],
        ),
        (climb, &guided, 178, &[2.0, 4.0, -1.0]),
        (turn(-120.0), &guided, 115, &[330.0, 0.0, -1.0]),
        (turn(30.0), &guided, 115, &[120.0, 0.0, 1.0]),
        (interval(4.0), &guided, 511, &[30.0, 250_000.0]),
        (interval(0.0), &guided, 511, &[30.0, -1.0]),
    ];
    for (command, vehicle, number, params) in cases {
        let (sent, all) = long(&command, vehicle);
        assert_eq!(
            (sent, &all[..params.len()]),
            (number, params),
            "{command:?}"
        );
        assert!(
            all[params.len()..].iter().all(|&rest| rest == 0.0),
            "{command:?}"
        );
    }
}

#[test]
fn an_offset_becomes_a_local_target_with_the_present_heading() {
    let MavMessage::SET_POSITION_TARGET_LOCAL_NED(target) =
        only_message(&offset(2.0), &flying("GUIDED"))
    else {
        panic!("not a local target");
    };
    assert_eq!(
        format!("{} {} {}", target.x, target.y, target.z),
        "15 -2 -22"
    );
    assert_eq!(target.type_mask.bits(), 0x09F8);
    assert!((target.yaw.to_degrees() - 90.0).abs() < 1e-4);
    assert_eq!(target.coordinate_frame as u8, 1);
}

#[test]
fn a_point_without_a_height_keeps_the_present_one() {
    let destination = Destination::Global {
        at_point: HERE,
        altitude_m: None,
    };
    let MavMessage::SET_POSITION_TARGET_GLOBAL_INT(target) =
        only_message(&goto(destination, Heading::Auto), &flying("GUIDED"))
    else {
        panic!("not a global target");
    };
    assert_eq!((target.lat_int, target.lon_int), (504_500_000, 305_200_000));
    assert!((target.alt - 20.0).abs() < f32::EPSILON);
    assert_eq!(target.type_mask.bits(), 0x0DF8);
    assert_eq!(target.coordinate_frame as u8, 6);
}

#[test]
fn a_velocity_is_repeated_and_ends_with_a_stop() {
    let command = Command::Motion(MotionCommand::Velocity {
        ned_m_s: [1.0, 0.0, 0.0],
        lasting: Duration::from_secs(5),
    });
    let request = command.request(&flying("GUIDED"), 0).expect("it flies");
    assert_eq!(request.answer, Answer::None);
    let Some(Outgoing::Message(MavMessage::SET_POSITION_TARGET_LOCAL_NED(stop))) = request.closing
    else {
        panic!("no stop");
    };
    assert_eq!((stop.vx, stop.type_mask.bits()), (0.0, 0x0DC7));
    let repeat = command.repeat().expect("it has to be repeated");
    assert_eq!(repeat.every, Duration::from_millis(200));
    assert_eq!(repeat.lasting, Duration::from_secs(5));
}

#[test]
fn what_makes_no_sense_is_said_in_plain_words() {
    let up = offset(1.0);
    let mut blind = flying("GUIDED");
    (blind.local, blind.global) = (None, None);
    let mut falling = flying("GUIDED");
    if let Some(heartbeat) = &mut falling.heartbeat {
        heartbeat.armed = false;
    }
    let mut waiting = flying("GUIDED");
    waiting.landed = LandedState::OnGround;
    let unknown = Command::Flight(FlightCommand::SetMode {
        name: "QLOITER".to_owned(),
    });
    let nan = Command::Flight(FlightCommand::Takeoff {
        altitude_m: f64::NAN,
    });
    let long_name = Command::Parameter(ParameterCommand::Get {
        name: "A_NAME_THAT_IS_TOO_LONG".to_owned(),
    });
    let cases = [
        (
            &up,
            flying("LOITER"),
            "goto needs GUIDED: it is in LOITER; use `3 guided` first",
        ),
        (&up, on_the_ground("GUIDED"), "use `3 arm` first"),
        (&up, waiting, "use `3 takeoff 10` first"),
        (&up, blind, "no position received yet"),
        (&up, Vehicle::new(3, 1), "not in contact yet"),
        (&offset(-30.0), flying("GUIDED"), "too low to fly to"),
        (&Command::Arming(ArmingCommand::Arm), falling, "in the air"),
        (
            &Command::Device(DeviceCommand::Reboot),
            flying("GUIDED"),
            "is armed",
        ),
        (&unknown, flying("GUIDED"), "no mode QLOITER"),
        (&nan, flying("GUIDED"), "not a number"),
        (&long_name, flying("GUIDED"), "cannot be a parameter"),
    ];
    for (command, vehicle, reason) in cases {
        let fault = command.request(&vehicle, 0).expect_err(reason);
        assert!(fault.contains(reason), "{fault}");
    }
}

/// The vehicle descends at 1.5 m/s, and its local position is 0.4 s older than its global one.
#[test]
fn a_low_place_is_not_refused_because_the_vehicle_descends_to_it() {
    let mut vehicle = flying("GUIDED");
    let global = vehicle.global.as_mut().expect("it has a position");
    (global.altitude_m, global.down_m_s) = (1.0, 1.5);
    global.at = Duration::from_millis(400);
    let local = vehicle.local.as_mut().expect("it has a position");
    local.ned_m[2] = -1.6;
    local.velocity_m_s[2] = 1.5;
    let place = |up_m| {
        let destination = Destination::Local {
            north_m: 5.0,
            east_m: 0.0,
            up_m: Some(up_m),
        };
        goto(destination, Heading::Keep).request(&vehicle, 0)
    };
    assert!(place(0.7).is_ok());
    assert!(place(0.4).is_err());
}

/// Each row: the vehicle's ground state, height and climb, and the answer to a setpoint.
#[test]
fn a_setpoint_does_not_break_off_a_takeoff() {
    for (landed, altitude_m, climb_m_s, refusal) in [
        (LandedState::Takeoff, 0.0, 0.0, Some("still taking off")),
        (LandedState::Takeoff, 8.0, 2.5, Some("still taking off")),
        (LandedState::Takeoff, 19.1, 1.1, None),
        (LandedState::OnGround, 0.2, 0.6, Some("still taking off")),
        (LandedState::OnGround, 0.0, 0.0, Some("is on the ground")),
        (LandedState::InAir, 1.0, 2.5, None),
        (LandedState::Undefined, 8.0, 2.5, None),
    ] {
        let mut vehicle = flying("GUIDED");
        vehicle.landed = landed;
        if let Some(global) = &mut vehicle.global {
            (global.altitude_m, global.down_m_s) = (altitude_m, -climb_m_s);
        }
        if let Some(local) = &mut vehicle.local {
            local.ned_m[2] = -altitude_m as f32;
        }
        let ahead = Destination::Local {
            north_m: 5.0,
            east_m: 0.0,
            up_m: Some(5.0),
        };
        let said = goto(ahead, Heading::Auto).request(&vehicle, 0).err();
        assert_eq!(said.is_some(), refusal.is_some(), "{landed:?} {said:?}");
        let said = said.unwrap_or_default();
        assert!(said.contains(refusal.unwrap_or_default()), "{said}");
    }
}

#[test]
fn a_mode_by_number_is_sent_and_seen() {
    for (name, number) in [("9", 9), ("99", 99)] {
        let command = Command::Flight(FlightCommand::SetMode {
            name: name.to_owned(),
        });
        let before = flying("GUIDED");
        let (sent, params) = long(&command, &before);
        assert_eq!((sent, params[1]), (176, number as f32));
        let effect = command.effect(&before);
        assert_eq!(effect.seen(&before), Some(false));
        let mut after = before.clone();
        if let Some(heartbeat) = &mut after.heartbeat {
            heartbeat.mode.number = number;
        }
        assert_eq!(effect.seen(&after), Some(true), "{name}");
    }
}

#[test]
fn numbers_without_a_name_go_out_raw_and_count_their_tries() {
    let command = Command::Raw(RawCommand::Long {
        command: 40000,
        params: [1.5, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0],
    });
    let vehicle = flying("GUIDED");
    let mut request = command.request(&vehicle, 0).expect("anything goes");
    assert_eq!(request.answer, Answer::Ack(40000));
    request.again();
    let [Outgoing::Raw { id: 76, payload }] = request.messages.as_slice() else {
        panic!("{request:?}");
    };
    assert_eq!(payload[..4], 1.5_f32.to_le_bytes());
    assert_eq!(payload[24..28], (-2.0_f32).to_le_bytes());
    assert_eq!(payload[28..], [0x40, 0x9C, 3, 1, 1]);

    let mut arm = Command::Arming(ArmingCommand::Arm)
        .request(&on_the_ground("GUIDED"), 0)
        .expect("on the ground");
    arm.again();
    arm.again();
    let [Outgoing::Message(MavMessage::COMMAND_LONG(message))] = arm.messages.as_slice() else {
        panic!("{arm:?}");
    };
    assert_eq!(message.confirmation, 2);
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>(),
        proptest::sample::select(vec![f64::NAN, f64::INFINITY, 1e300, 0.0, 20.0]),
    ]
}

proptest! {
    /// A NaN in a setpoint crashes ArduPilot's simulator.
    #[test]
    fn nothing_but_finite_numbers_goes_out(a in any_number(), b in any_number(), c in any_number()) {
        let point = LatLon::new(a, b);
        let commands = [
            goto(Destination::Local { north_m: a, east_m: b, up_m: Some(c) }, Heading::Fixed(b)),
            goto(Destination::Offset { north_m: a, east_m: b, up_m: c }, Heading::Auto),
            goto(Destination::Global { at_point: point, altitude_m: Some(c) }, Heading::Fixed(a)),
            Command::Motion(MotionCommand::Altitude { altitude_m: a }),
            Command::Motion(MotionCommand::Velocity { ned_m_s: [a, b, c], lasting: Duration::ZERO }),
            Command::Motion(MotionCommand::Orbit { radius_m: a, speed_m_s: b, centre: Some(point), altitude_m: Some(c) }),
            Command::Motion(MotionCommand::SetHome { place: Some((point, c)) }),
            Command::Motion(MotionCommand::Yaw { angle_deg: a, relative: true, rate_deg_s: Some(b) }),
            Command::Parameter(ParameterCommand::Set { name: "X".to_owned(), value: a }),
        ];
        for command in commands {
            if let Ok(request) = command.request(&flying("GUIDED"), 0) {
                let sent = format!("{:?}", request.messages);
                prop_assert!(!sent.contains("NaN") && !sent.contains("inf"), "{}", sent);
            }
        }
    }
}
