//! Changes after which a list is read again.

use mavlink::dialects::ardupilotmega::{
    MISSION_ACK_DATA, MavMissionResult, MavMissionType, PARAM_VALUE_DATA, STATUSTEXT_DATA,
};

use super::*;

const MISSION: MavMissionType = MavMissionType::MAV_MISSION_TYPE_MISSION;
const FENCE: MavMissionType = MavMissionType::MAV_MISSION_TYPE_FENCE;
const RALLY: MavMissionType = MavMissionType::MAV_MISSION_TYPE_RALLY;

fn text(text: &str) -> MavMessage {
    MavMessage::STATUSTEXT(STATUSTEXT_DATA {
        text: text.into(),
        ..STATUSTEXT_DATA::DEFAULT
    })
}

fn current(total: u16, mission_id: u32, fence_id: u32) -> MavMessage {
    MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
        total,
        mission_id,
        fence_id,
        ..MISSION_CURRENT_DATA::DEFAULT
    })
}

/// Another ground station's upload of rally points.
fn others_upload() -> MavMessage {
    MavMessage::MISSION_ACK(MISSION_ACK_DATA {
        target_system: 254,
        mission_type: RALLY,
        ..MISSION_ACK_DATA::DEFAULT
    })
}

fn rally_total() -> MavMessage {
    MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_id: "RALLY_TOTAL".into(),
        param_index: NO_INDEX,
        ..PARAM_VALUE_DATA::DEFAULT
    })
}

#[test]
fn another_count_or_id_or_upload_has_the_list_read_again() {
    for (sign, kind) in [
        (current(3, 7, 0), Some(MISSION)),
        (current(2, 8, 0), Some(MISSION)),
        (current(2, 7, 9), Some(FENCE)),
        (current(2, 7, 0), None),
        (text("Flight plan received"), Some(MISSION)),
        (text("Fence Indexed OK"), Some(FENCE)),
        (text("Arming motors"), None),
        (others_upload(), Some(RALLY)),
        (rally_total(), Some(RALLY)),
    ] {
        let mut scene = Scene::new(Manner::Modern, 3);
        scene.announce(2, 7);
        scene.pass(Duration::from_secs(20));
        scene.asked.clear();
        scene.lists[0] = plan_of(5);
        scene.hear(sign.clone());
        scene.pass(Duration::from_secs(20));
        let lists: Vec<MavMissionType> = scene
            .asked
            .iter()
            .filter_map(|asked| match asked {
                MavMessage::MISSION_REQUEST_LIST(data) => Some(data.mission_type),
                _ => None,
            })
            .collect();
        assert_eq!(lists, Vec::from_iter(kind), "{sign:?}");
    }
}

#[test]
fn signs_that_come_all_the_time_do_not_flood_the_vehicle() {
    let mut scene = Scene::new(Manner::Modern, 2);
    for step in 0..600u16 {
        scene.announce(step, 0);
        scene.pass(ms(100));
    }
    // The reader waits for an upload under way.
    let during = scene.asked_for(is_list);
    assert!(during <= 4, "{during}");
    scene.pass(Duration::from_secs(10));
    assert_eq!(scene.vehicle.plans.plan.transfer, Transfer::Done);
}

#[test]
fn a_list_that_changes_while_it_is_read_is_broken_off_and_read_anew() {
    let mut scene = Scene::new(Manner::Modern, 40);
    scene.announce(39, 0);
    // Nothing gets through after the middle of the list.
    scene.losses = vec![true; 2];
    scene.losses.extend([false; 60]);
    scene.pass(ms(3500));
    assert!(
        matches!(scene.vehicle.plans.plan.transfer, Transfer::Coming { received, total: Some(40) } if received > 0)
    );
    scene.lists[0] = plan_of(7);
    scene.announce(6, 0);
    scene.losses.clear();
    scene.pass(Duration::from_secs(10));
    assert_eq!(scene.plan().map(|plan| plan.items.len()), Some(7));
    let cancelled = |asked: &MavMessage| {
        matches!(asked, MavMessage::MISSION_ACK(data)
            if data.mavtype == MavMissionResult::MAV_MISSION_OPERATION_CANCELLED)
    };
    assert_eq!(scene.asked_for(cancelled), 1);
}

/// ArduCopter reports an upload only on the port that it came from.
#[test]
fn beside_another_station_a_list_without_an_id_is_read_again_soon() {
    for (station, rounds) in [(false, 1), (true, 3)] {
        let mut scene = Scene::new(Manner::Modern, 5);
        scene.announce(4, 0);
        for _ in 0..70 {
            scene.pass(Duration::from_secs(1));
            if station {
                scene.reader.station_heard(scene.now);
            }
        }
        let of_the_plan = |asked: &MavMessage| matches!(asked, MavMessage::MISSION_REQUEST_LIST(data) if data.mission_type == MISSION);
        assert_eq!(scene.asked_for(of_the_plan), rounds, "{station}");
    }
}
