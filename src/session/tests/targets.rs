//! A vehicle's target, and when it becomes void.

use mavlink::dialects::ardupilotmega::{
    EXTENDED_SYS_STATE_DATA, GLOBAL_POSITION_INT_DATA, MavFrame, MavLandedState,
    POSITION_TARGET_GLOBAL_INT_DATA, PositionTargetTypemask,
};

use super::*;
use crate::geo::LatLon;

/// A vehicle in the air in GUIDED, on its way to a target according to its telemetry.
pub(super) fn under_way() -> Scene {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
        landed_state: MavLandedState::MAV_LANDED_STATE_IN_AIR,
        ..Default::default()
    }));
    scene.hear(MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        lat: 504_500_000,
        lon: 305_200_000,
        relative_alt: 20_000,
        ..Default::default()
    }));
    let goto = Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: LatLon::new(50.46, 30.52),
            altitude_m: Some(20.0),
        },
        heading: Heading::Auto,
    });
    scene.order(1, "goto", goto);
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

#[test]
fn a_vehicle_that_keeps_another_target_has_dropped_the_goto() {
    let mut scene = under_way();
    let goto = Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: LatLon::new(50.4518, 30.52),
            altitude_m: Some(20.0),
        },
        heading: Heading::Auto,
    });
    scene.order(2, "goto", goto);
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
