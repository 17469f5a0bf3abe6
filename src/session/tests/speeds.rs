//! Speeds that the autopilot forgets are repeated.

use super::targets::under_way;
use super::*;
use crate::commands::Setpoint;
use crate::geo::LatLon;
use crate::vehicle::{Health, SpeedAxis, VehicleClass};

const CHANGE_SPEED: MavCmd = MavCmd::MAV_CMD_DO_CHANGE_SPEED;

fn speed(scene: &mut Scene, entry: u32, axis: SpeedAxis, speed_m_s: f64) {
    let command = Command::Motion(MotionCommand::Speed { axis, speed_m_s });
    scene.order(entry, "speed", command);
    scene.ack(CHANGE_SPEED, MavResult::MAV_RESULT_ACCEPTED);
}

fn goto(scene: &mut Scene, entry: u32) {
    let goto = Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: LatLon::new(50.46, 30.52),
            altitude_m: Some(20.0),
        },
        heading: Heading::Auto,
    });
    scene.order(entry, "goto", goto);
}

fn steer(scene: &mut Scene, velocity_m_s: Option<[f64; 3]>) {
    let steering = Steering {
        verb: language::verb("survey").expect("a verb"),
        setpoint: Setpoint {
            at_point: LatLon::new(50.46, 30.52),
            altitude_m: 20.0,
            velocity_m_s,
        },
    };
    scene.session.steer(&steering, scene.now).expect("flies");
    scene.collect();
}

/// The speed types and speeds that were sent, in order.
fn said(scene: &Scene) -> Vec<(f32, f32)> {
    let longs = scene.longs(CHANGE_SPEED).into_iter();
    longs.map(|long| (long.param1, long.param2)).collect()
}

#[test]
fn a_speed_is_said_again_after_the_place_that_makes_the_autopilot_forget_it() {
    let mut scene = under_way();
    speed(&mut scene, 2, SpeedAxis::Ground, 3.0);
    scene.sent.clear();
    goto(&mut scene, 3);
    let is_place = |sent: &Outgoing| {
        matches!(
            sent,
            Outgoing::Message(MavMessage::SET_POSITION_TARGET_GLOBAL_INT(_))
        )
    };
    let place = scene.sent.iter().position(is_place).expect("a place");
    assert!(scene.sent.len() > place + 1, "the speed follows the place");
    assert_eq!(said(&scene), [(1.0, 3.0)]);
}

#[test]
fn a_plane_without_an_airspeed_sensor_flies_by_its_throttle() {
    for (enabled, is_measured) in [(Health::AIRSPEED, true), (0, false)] {
        let mut scene = under_way();
        let vehicle = &mut scene.session.vehicle;
        if let Some(heartbeat) = &mut vehicle.heartbeat {
            heartbeat.class = VehicleClass::Plane;
            heartbeat.mode = VehicleClass::Plane.mode("GUIDED").expect("a mode");
        }
        vehicle.health = Some(Health {
            present: Health::AIRSPEED,
            enabled,
            healthy: 0,
            load_percent: f32::NAN,
            at: Duration::ZERO,
        });
        speed(&mut scene, 2, SpeedAxis::Ground, 15.0);
        scene.pass(ms(10));
        let words = scene.explanation(2);
        assert_eq!(words.contains("TRIM_THROTTLE"), !is_measured, "{words}");
    }
}

#[test]
fn of_climb_and_descent_the_last_one_holds() {
    let mut scene = under_way();
    speed(&mut scene, 2, SpeedAxis::Climb, 4.0);
    speed(&mut scene, 3, SpeedAxis::Descend, 1.0);
    speed(&mut scene, 4, SpeedAxis::Ground, 3.0);
    scene.sent.clear();
    goto(&mut scene, 5);
    assert_eq!(said(&scene), [(1.0, 3.0), (3.0, 1.0)]);
}

#[test]
fn a_speed_that_was_refused_is_not_said_again() {
    let mut scene = under_way();
    let command = Command::Motion(MotionCommand::Speed {
        axis: SpeedAxis::Ground,
        speed_m_s: 3.0,
    });
    scene.order(2, "speed", command);
    scene.ack(CHANGE_SPEED, MavResult::MAV_RESULT_FAILED);
    scene.pass(ms(500));
    scene.sent.clear();
    goto(&mut scene, 3);
    assert_eq!(said(&scene), []);
}

#[test]
fn a_manoeuvre_says_the_speed_with_its_first_places_but_not_with_moving_ones() {
    let mut scene = under_way();
    speed(&mut scene, 2, SpeedAxis::Ground, 3.0);
    scene.sent.clear();
    steer(&mut scene, Some([1.0, 0.0, 0.0]));
    assert_eq!(said(&scene), []);
    for _ in 0..9 {
        steer(&mut scene, None);
    }
    assert_eq!(said(&scene), [(1.0, 3.0); 3]);
    steer(&mut scene, Some([1.0, 0.0, 0.0]));
    steer(&mut scene, None);
    assert_eq!(said(&scene).len(), 4);
}

#[test]
fn the_answer_to_a_speed_that_was_said_again_is_not_taken_for_that_of_a_new_one() {
    let mut scene = under_way();
    speed(&mut scene, 2, SpeedAxis::Ground, 3.0);
    goto(&mut scene, 3);
    let command = Command::Motion(MotionCommand::Speed {
        axis: SpeedAxis::Ground,
        speed_m_s: 5.0,
    });
    scene.order(4, "speed", command);
    scene.ack(CHANGE_SPEED, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(4).last(), Some(&RowState::Sent));
    scene.ack(CHANGE_SPEED, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(4).last(), Some(&RowState::Done));
}
