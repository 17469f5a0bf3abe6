//! Effects and explanations.

use super::*;
use crate::text::Text;
use crate::vehicle::{Place, SpeedAxis};

#[test]
fn an_effect_shows_when_telemetry_says_so_and_not_before() {
    let ground = on_the_ground("GUIDED");
    let air = flying("GUIDED");
    let mut landing = flying("LAND");
    landing.home = Some(Place {
        at_point: HERE,
        altitude_amsl_m: 180.0,
    });
    let mut down = landing.clone();
    down.landed = LandedState::OnGround;
    let mut low = air.clone();
    if let Some(global) = &mut low.global {
        global.altitude_m = 12.0;
    }
    let mut there = air.clone();
    if let Some(local) = &mut there.local {
        local.ned_m = [15.0, -2.0, -22.0];
    }
    let mut turned = air.clone();
    if let Some(attitude) = &mut turned.attitude {
        attitude.yaw_deg = 2.0;
    }
    let mut rebooted = ground.clone();
    rebooted.link.reboots = 1;
    let yaw = Command::Motion(MotionCommand::Yaw {
        angle_deg: 0.0,
        relative: false,
        rate_deg_s: None,
    });
    let cases = [
        (Command::Arming(ArmingCommand::Arm), &ground, &air),
        (Command::Arming(ArmingCommand::Kill), &air, &ground),
        (Command::Flight(FlightCommand::Land), &landing, &down),
        (
            Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
            &low,
            &air,
        ),
        (
            Command::Motion(MotionCommand::Altitude { altitude_m: 20.5 }),
            &low,
            &air,
        ),
        (offset(2.0), &air, &there),
        (yaw, &air, &turned),
        (
            Command::Motion(MotionCommand::SetHome { place: None }),
            &air,
            &landing,
        ),
        (Command::Device(DeviceCommand::Reboot), &ground, &rebooted),
    ];
    for (command, before, after) in cases {
        let effect = command.effect(before);
        assert_eq!(effect.seen(before), Some(false), "{command:?}");
        assert_eq!(effect.seen(after), Some(true), "{command:?}");
        assert!(effect.within() >= Duration::from_secs(3), "{command:?}");
    }
    let request = Command::Query(QueryCommand::Request { message: 148 });
    assert_eq!(request.effect(&air).seen(&air), None);
}

#[test]
fn a_low_takeoff_is_not_over_before_it_began() {
    let mut ground = on_the_ground("GUIDED");
    if let Some(global) = &mut ground.global {
        global.altitude_m = 0.1;
    }
    let takeoff = Command::Flight(FlightCommand::Takeoff { altitude_m: 0.8 });
    assert_eq!(takeoff.effect(&ground).seen(&ground), Some(false));
}

#[test]
fn patience_grows_with_the_way() {
    let near = offset(1.0).effect(&flying("GUIDED")).within();
    let destination = Destination::Local {
        north_m: 310.0,
        east_m: 0.0,
        up_m: None,
    };
    let far = goto(destination, Heading::Auto)
        .effect(&flying("GUIDED"))
        .within();
    assert_eq!(far, Duration::from_secs(220));
    assert!(near < Duration::from_secs(30));
}

/// A row: verb, texts, vehicle, command, `MAV_RESULT`, and the expected explanation.
type Refusal<'a> = (
    &'static str,
    &'a [Text],
    &'a Vehicle,
    &'a Command,
    u8,
    &'a str,
);

#[test]
fn a_refused_takeoff_names_every_missing_step_in_order() {
    let takeoff = Command::Flight(FlightCommand::Takeoff { altitude_m: 5.0 });
    let said = |vehicle: &Vehicle| {
        let result = AckResult::from_wire(4);
        explain("takeoff", result, &[], vehicle, &takeoff).to_string()
    };
    assert_eq!(
        said(&on_the_ground("STABILIZE")),
        "takeoff refused: it is in STABILIZE and not armed: `guided`, `arm`, then `takeoff`"
    );
    let mut armed = on_the_ground("STABILIZE");
    armed.heartbeat.as_mut().expect("it was heard").armed = true;
    assert_eq!(
        said(&armed),
        "takeoff refused: it is in STABILIZE: `guided`, then `takeoff`"
    );
    let mut disarming = on_the_ground("GUIDED");
    disarming.heartbeat.as_mut().expect("it was heard").armed = true;
    assert_eq!(
        said(&disarming),
        "takeoff refused: it has probably just disarmed itself: `arm`, then `takeoff`"
    );
}

#[test]
fn refusals_are_explained_by_the_texts_else_by_the_state() {
    let air = flying("GUIDED");
    let mut ground = on_the_ground("GUIDED");
    ground.prearm = vec!["Need Position Estimate".to_owned()];
    let text = [Text::from("Arm: LAND mode not armable")];
    let takeoff = Command::Flight(FlightCommand::Takeoff { altitude_m: 5.0 });
    let orbit = Command::Motion(MotionCommand::Orbit {
        radius_m: 5.0,
        speed_m_s: 1.0,
        centre: None,
        altitude_m: None,
    });
    let speed = Command::Motion(MotionCommand::Speed {
        axis: SpeedAxis::Ground,
        speed_m_s: 3.0,
    });
    let loiter = flying("LOITER");
    let cases: [Refusal; 9] = [
        (
            "arm",
            &text,
            &ground,
            &Command::Arming(ArmingCommand::Arm),
            4,
            "arm refused: Arm: LAND mode not armable",
        ),
        (
            "arm",
            &[],
            &ground,
            &Command::Arming(ArmingCommand::Arm),
            4,
            "arm refused: PreArm: Need Position Estimate",
        ),
        (
            "takeoff",
            &[],
            &ground,
            &takeoff,
            4,
            "takeoff refused: it is not armed: `arm`, then `takeoff`",
        ),
        (
            "takeoff",
            &[],
            &air,
            &takeoff,
            4,
            "takeoff refused: it is already flying",
        ),
        (
            "disarm",
            &[],
            &air,
            &Command::Arming(ArmingCommand::Disarm),
            4,
            "disarm refused: it is in the air: use `land`, or `kill` to stop the motors",
        ),
        (
            "orbit",
            &[],
            &air,
            &orbit,
            3,
            "orbit refused: this autopilot cannot orbit: use mode CIRCLE",
        ),
        (
            "speed",
            &[],
            &loiter,
            &speed,
            4,
            "speed refused: it is in LOITER, which takes no speed; change to GUIDED first",
        ),
        (
            "speed",
            &[],
            &air,
            &speed,
            4,
            "speed refused: the vehicle gave no reason",
        ),
        (
            "rtl",
            &[],
            &air,
            &Command::Flight(FlightCommand::ReturnToLaunch),
            77,
            "rtl refused: result 77",
        ),
    ];
    for (verb, texts, vehicle, command, result, words) in cases {
        let result = AckResult::from_wire(result);
        assert_eq!(explain(verb, result, texts, vehicle, command), words);
    }
}

#[test]
fn planes_get_advice_that_planes_can_follow() {
    let plane = |mut vehicle: Vehicle| {
        if let Some(heartbeat) = &mut vehicle.heartbeat {
            heartbeat.class = VehicleClass::Plane;
        }
        vehicle
    };
    let said = |verb, texts: &[Text], vehicle: &Vehicle, command| {
        let command = Command::Arming(command);
        let failed = AckResult::Failed;
        explain(verb, failed, texts, vehicle, &command).to_string()
    };
    let mut landed = plane(on_the_ground("GUIDED"));
    landed.prearm = vec!["In landing sequence".to_owned()];
    let way_out = "its plan is still at the landing: `mode manual` ends that, then `arm`";
    let text = "Arm: In landing sequence";
    let arm = ArmingCommand::Arm;
    assert_eq!(
        said("arm", &[Text::from(text)], &landed, arm),
        format!("arm refused: {text}; {way_out}")
    );
    assert_eq!(
        said("arm", &[], &landed, arm),
        format!("arm refused: Pre{text}; {way_out}")
    );
    let air = plane(flying("GUIDED"));
    let said = said("disarm", &[], &air, ArmingCommand::Disarm);
    assert!(said.contains("land it by a plan"), "{said}");
}

#[test]
fn a_parameter_that_kept_its_value_is_noticed() {
    let set = |value| ParameterCommand::Set {
        name: "X".to_owned(),
        value,
    };
    assert_eq!(set(500.0).outcome(500.0), Ok("X = 500".into()));
    assert_eq!(set(0.1).outcome(0.1), Ok("X = 0.1".into()));
    for (wanted, kept, told) in [
        (1500.7, 1500.0, "X = 1500 (requested: 1500.7)"),
        (99_999_999.0, 1e8, "X = 100000000 (requested: 99999999)"),
        (
            0.123_456_789,
            0.123_456_79,
            "X = 0.12345679 (requested: 0.123456789)",
        ),
    ] {
        let outcome = set(wanted).outcome(kept);
        assert_eq!(outcome.map(|text| text.to_string()), Ok(told.to_owned()));
    }
    let large = set(2_147_483_520.0).outcome(2_147_483_520.0);
    assert!(large.is_ok_and(|text| !text.contains("asked")));
    assert!(set(500.0).outcome(7.0).is_err());
}
