//! A vehicle's target, and when it becomes void.

use mavlink::dialects::ardupilotmega::{
    EXTENDED_SYS_STATE_DATA, GLOBAL_POSITION_INT_DATA, LOCAL_POSITION_NED_DATA, MavFrame,
    MavLandedState, POSITION_TARGET_GLOBAL_INT_DATA, PositionTargetTypemask,
};

use super::*;
use crate::geo::LatLon;

/// A vehicle in the air in GUIDED, without a target.
fn in_the_air() -> Scene {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
        landed_state: MavLandedState::MAV_LANDED_STATE_IN_AIR,
        ..Default::default()
    }));
    hear_position(&mut scene, 0);
    scene
}

/// The same, on its way to a target according to its telemetry.
pub(super) fn under_way() -> Scene {
    let mut scene = in_the_air();
    let destination = Destination::Global {
        at_point: LatLon::new(50.46, 30.52),
        altitude_m: Some(20.0),
    };
    scene.order(1, "goto", goto(destination));
    hear_target(&mut scene);
    scene
}

fn hear_target(scene: &mut Scene) {
    let position_only = PositionTargetTypemask::from_bits_truncate(0x0DF8);
    scene.hear(MavMessage::POSITION_TARGET_GLOBAL_INT(
        POSITION_TARGET_GLOBAL_INT_DATA {
            lat_int: 504_600_000,
            lon_int: 305_200_000,
            type_mask: position_only,
            coordinate_frame: MavFrame::MAV_FRAME_GLOBAL,
            ..Default::default()
        },
    ));
}

fn has_target(scene: &Scene) -> bool {
    scene.session.vehicle().target.is_some()
}

#[test]
fn a_velocity_takes_the_place_of_a_goto_and_of_its_target() {
    let mut scene = under_way();
    assert!(has_target(&scene));
    let velocity = Command::Motion(MotionCommand::Velocity {
        ned_m_s: [2.0, 0.0, 0.0],
        lasting: ms(10_000),
    });
    scene.order(2, "velocity", velocity);
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    assert!(!has_target(&scene));
    hear_target(&mut scene);
    assert!(has_target(&scene), "what the vehicle says counts");
}

#[test]
fn a_session_is_looked_at_often_only_while_it_has_something_to_send() {
    let mut scene = under_way();
    scene.pass(ms(2000));
    assert_eq!(scene.session.patience(), IDLE_POLL, "the way there is long");
    let velocity = Command::Motion(MotionCommand::Velocity {
        ned_m_s: [2.0, 0.0, 0.0],
        lasting: ms(10_000),
    });
    scene.order(2, "velocity", velocity);
    assert_eq!(scene.session.patience(), BUSY_POLL, "it is said again");
    scene.order(3, "arm", Command::Arming(ArmingCommand::Arm));
    assert_eq!(scene.session.patience(), BUSY_POLL, "it is not answered");
}

#[test]
fn a_target_that_is_not_sent_any_more_is_forgotten_unless_the_vehicle_is_silent() {
    for (goes_on, remembered) in [(true, false), (false, true)] {
        let mut scene = under_way();
        for _ in 0..5 {
            scene.pass(ms(1000));
            if goes_on {
                scene.heartbeat(GUIDED, true);
            }
        }
        assert_eq!(has_target(&scene), remembered);
    }
}

/// To a point on the earth, or to one 200 m north of the vehicle, which is at the origin of its local coordinates.
#[test]
fn a_vehicle_that_keeps_another_target_has_dropped_the_goto() {
    let on_earth = Destination::Global {
        at_point: LatLon::new(50.4518, 30.52),
        altitude_m: Some(20.0),
    };
    for destination in [on_earth, NORTH] {
        let mut scene = under_way();
        hear_local(&mut scene);
        scene.order(2, "goto", goto(destination));
        for second in 1..=3 {
            assert!(!scene.states(2).contains(&RowState::NoEffect), "{second}");
            scene.pass(ms(1000));
            scene.heartbeat(GUIDED, true);
            hear_target(&mut scene);
        }
        scene.pass(ms(100));
        assert_eq!(scene.states(2).last(), Some(&RowState::NoEffect));
        assert!(scene.explanation(2).contains("outside its fence?"));
        assert!(!scene.states(1).contains(&RowState::NoEffect));
    }
}

/// After its takeoff, it reports no target until it takes one.
#[test]
fn a_vehicle_that_stands_still_without_a_target_has_dropped_the_goto() {
    for moves in [false, true] {
        let mut scene = in_the_air();
        hear_local(&mut scene);
        scene.order(1, "goto", goto(NORTH));
        for _ in 0..7 {
            scene.pass(ms(1000));
            scene.heartbeat(GUIDED, true);
            hear_position(&mut scene, if moves { 200 } else { 0 });
        }
        scene.pass(ms(100));
        assert_eq!(scene.states(1).contains(&RowState::NoEffect), !moves);
    }
}

/// 200 m north of the vehicle.
const NORTH: Destination = Destination::Local {
    north_m: 200.0,
    east_m: 0.0,
    up_m: Some(20.0),
};

fn goto(destination: Destination) -> Command {
    Command::Motion(MotionCommand::Goto {
        destination,
        heading: Heading::Auto,
    })
}

fn hear_position(scene: &mut Scene, north_cm_s: i16) {
    scene.hear(MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        lat: 504_500_000,
        lon: 305_200_000,
        relative_alt: 20_000,
        vx: north_cm_s,
        ..Default::default()
    }));
}

fn hear_local(scene: &mut Scene) {
    scene.hear(MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
        z: -20.0,
        ..Default::default()
    }));
}
