//! CIRCLE, FOLLOW and DOCK of rovers.

use mavlink::dialects::ardupilotmega::{GLOBAL_POSITION_INT_DATA, MavCmd, MavMessage, MavResult};

use sortie_wire::Encoder;

use super::driving::{enter, guided, speed};
use super::*;

const FOLLOW: f32 = 6.0;
const DOCK: f32 = 8.0;
const CIRCLE: f32 = 9.0;
const HOLD: f32 = 4.0;
const GUIDED: f32 = 15.0;
/// The leader's system id.
const LEADER: u8 = 2;

fn set(ground: &mut Ground, parameters: &[(&str, f32)]) {
    for (name, value) in parameters {
        ground.set(name, *value);
    }
}

/// Reports a leader north of the start, which drives north.
fn report(ground: &mut Ground, north_m: f64, speed_m_s: f64) {
    let at = start().at.moved(north_m, 0.0);
    let data = GLOBAL_POSITION_INT_DATA {
        lat: (at.lat_deg * 1e7).round() as i32,
        lon: (at.lon_deg * 1e7).round() as i32,
        alt: (start().altitude_amsl_m * 1000.0) as i32,
        vx: (speed_m_s * 100.0) as i16,
        hdg: 0,
        ..Default::default()
    };
    let mut bytes = Vec::new();
    let message = MavMessage::GLOBAL_POSITION_INT(data);
    Encoder::new(LEADER, 1).encode(&message.into(), &mut bytes);
    ground.world.receive(ground.port, &bytes);
}

/// Reports the leader five times a second while it drives; returns where it ends.
fn lead(ground: &mut Ground, from_m: f64, speed_m_s: f64, seconds: u32) -> f64 {
    let mut north_m = from_m;
    for _ in 0..seconds * 5 {
        report(ground, north_m, speed_m_s);
        ground.run(0.2);
        north_m += speed_m_s * 0.2;
    }
    north_m
}

#[test]
fn dock_and_follow_are_refused_with_their_reasons() {
    let mut ground = guided(Chassis::Ackermann);
    assert_eq!(enter(&mut ground, DOCK), MavResult::MAV_RESULT_FAILED);
    let failed = "Flight mode change failed";
    let said = ground.texts();
    assert!(said.ends_with(&["Dock: target not acquired".to_owned(), failed.to_owned()]));
    assert_eq!(enter(&mut ground, FOLLOW), MavResult::MAV_RESULT_FAILED);
    assert_eq!(ground.texts().last().map(String::as_str), Some(failed));
}

#[test]
fn a_circle_is_driven_around_the_place_where_it_begins() {
    for (chassis, turns_right) in [(Chassis::Ackermann, true), (Chassis::Skid, false)] {
        let mut ground = guided(chassis);
        let direction = if turns_right { 0.0 } else { 1.0 };
        set(
            &mut ground,
            &[
                ("CIRC_RADIUS", 10.0),
                ("CIRC_SPEED", 2.0),
                ("CIRC_DIR", direction),
            ],
        );
        assert_eq!(enter(&mut ground, CIRCLE), MavResult::MAV_RESULT_ACCEPTED);
        ground.run(40.0);
        let mut turned = 0.0;
        for _ in 0..2000 {
            let before = ground.truth().heading_deg;
            ground.step();
            let truth = ground.truth();
            turned += sortie_geo::wrap_180(truth.heading_deg - before);
            let [north, east, _] = truth.position_ned_m;
            let off_m = sortie_geo::maths::hypot(north, east);
            assert!((7.0..13.0).contains(&off_m), "{chassis:?}: {off_m}");
        }
        assert!(
            turned.abs() > 90.0 && (turned > 0.0) == turns_right,
            "{turned}"
        );
    }
}

#[test]
fn a_circle_that_is_too_narrow_or_fast_is_limited_and_says_so() {
    let mut ground = guided(Chassis::Ackermann);
    set(&mut ground, &[("CIRC_RADIUS", 0.2)]);
    enter(&mut ground, CIRCLE);
    let slower = "Circle: max speed is  2.3";
    let said = ground.texts();
    let expected = ["Circle: radius increased to TURN_RADIUS ( 0.9)", slower];
    assert!(said.ends_with(&expected.map(str::to_owned)), "{said:?}");
    for (asked, result) in [
        (1.0, MavResult::MAV_RESULT_ACCEPTED),
        (50.0, MavResult::MAV_RESULT_ACCEPTED),
        (-1.0, MavResult::MAV_RESULT_FAILED),
        (0.0, MavResult::MAV_RESULT_FAILED),
    ] {
        let answer = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [0.0, asked]);
        assert_eq!(answer, result, "{asked}");
    }
    assert_eq!(ground.texts().last().map(String::as_str), Some(slower));
}

#[test]
fn a_rover_keeps_its_place_behind_a_leader_and_stops_when_it_is_silent() {
    for chassis in [Chassis::Ackermann, Chassis::Skid, Chassis::Boat] {
        let mut ground = guided(chassis);
        set(
            &mut ground,
            &[
                ("FOLL_ENABLE", 1.0),
                ("FOLL_SYSID", f32::from(LEADER)),
                ("FOLL_OFS_X", -5.0),
            ],
        );
        assert_eq!(enter(&mut ground, FOLLOW), MavResult::MAV_RESULT_ACCEPTED);
        ground.run(2.0);
        assert!(speed(&ground.truth()) < 0.1, "{chassis:?} has no leader");
        let north_m = lead(&mut ground, 5.0, 1.0, 60);
        let behind_m = north_m - ground.truth().position_ned_m[0];
        assert!((behind_m - 5.0).abs() < 1.5, "{chassis:?}: {behind_m}");
        ground.run(10.0);
        assert!(
            speed(&ground.truth()) < 0.3,
            "{chassis:?} stops without reports"
        );
    }
}

#[test]
fn the_first_vehicle_heard_leads_and_the_first_offset_is_kept_until_the_mode_ends() {
    let mut ground = guided(Chassis::Skid);
    set(&mut ground, &[("FOLL_ENABLE", 1.0)]);
    report(&mut ground, 7.0, 0.0);
    ground.run(0.5);
    assert!((ground.world.parameter(0, "FOLL_SYSID") - f64::from(LEADER)).abs() < 0.1);
    enter(&mut ground, FOLLOW);
    ground.run(0.5);
    assert_eq!(
        ground.texts().last().map(String::as_str),
        Some("N-E-D follow offset loaded")
    );
    assert!((ground.world.parameter(0, "FOLL_OFS_X") + 7.0).abs() < 0.3);
    let north_m = lead(&mut ground, 7.0, 1.0, 40);
    let behind_m = north_m - ground.truth().position_ned_m[0];
    assert!((behind_m - 7.0).abs() < 1.5, "{behind_m}");
    enter(&mut ground, HOLD);
    ground.run(0.1);
    assert!(ground.world.parameter(0, "FOLL_OFS_X").abs() < 1e-6);
    assert_eq!(enter(&mut ground, GUIDED), MavResult::MAV_RESULT_ACCEPTED);
}
