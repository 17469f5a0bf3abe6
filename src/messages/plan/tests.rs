use std::sync::Arc;

use mavlink::dialects::ardupilotmega::{
    HEARTBEAT_DATA, MISSION_CURRENT_DATA, MISSION_ITEM_REACHED_DATA, MavAutopilot, MavMessage,
    MavModeFlag, MavType, MissionState,
};

use super::*;
use crate::messages::testing::Bench;
use crate::vehicle::{Stored, Transfer};

const AUTO: u32 = 3;

/// A bench with an armed copter in AUTO that has these commands on board, after home.
fn flying(commands: &[u16]) -> Bench {
    let mut bench = Bench::new();
    bench.hear(MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: AUTO,
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode: MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED,
        ..HEARTBEAT_DATA::DEFAULT
    }));
    let item = |command: u16| Item {
        command,
        ..Item::default()
    };
    let items = std::iter::once(16)
        .chain(commands.iter().copied())
        .map(item);
    let plan = Plan {
        items: items.collect(),
        home_first: true,
    };
    bench.vehicle.plans.plan = Stored {
        content: Some(Arc::new(plan)),
        transfer: Transfer::Done,
    };
    bench.said();
    bench
}

fn current(bench: &mut Bench, seq: u16, state: MissionState) {
    let total = bench.vehicle.last_item().expect("a plan");
    bench.hear_after(
        1000,
        MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
            seq,
            total,
            mission_state: state,
            mission_mode: 1,
            ..MISSION_CURRENT_DATA::DEFAULT
        }),
    );
}

fn at(bench: &mut Bench, seq: u16) {
    current(bench, seq, MissionState::MISSION_STATE_ACTIVE);
}

fn reached(bench: &mut Bench, seq: u16) {
    bench.hear(MavMessage::MISSION_ITEM_REACHED(
        MISSION_ITEM_REACHED_DATA { seq },
    ));
}

#[test]
fn items_left_out_without_an_order_are_named() {
    let mut bench = flying(&[22, 16, 16, 178, 16, 16, 20]);
    at(&mut bench, 1);
    at(&mut bench, 2);
    assert_eq!(bench.said(), Vec::<String>::new());
    // Item 4 does not navigate.
    at(&mut bench, 6);
    assert_eq!(
        bench.said(),
        ["plan went on from item 2 to 6; not reported as reached: 3, 5"]
    );
    at(&mut bench, 2);
    assert_eq!(bench.said(), ["plan went back from item 6 to 2"]);
}

#[test]
fn short_items_that_were_reached_orders_and_jumps_are_no_news() {
    let mut bench = flying(&[22, 16, 93, 16, 20]);
    at(&mut bench, 2);
    reached(&mut bench, 2);
    reached(&mut bench, 3);
    at(&mut bench, 4);
    bench.vehicle.plan.asked = Some(bench.now);
    at(&mut bench, 2);
    at(&mut bench, 5);
    assert_eq!(bench.said(), Vec::<String>::new());
    let mut bench = flying(&[22, 16, 16, 177, 16]);
    at(&mut bench, 3);
    at(&mut bench, 2);
    at(&mut bench, 5);
    assert_eq!(bench.said(), Vec::<String>::new());
}

#[test]
fn the_end_of_a_plan_is_said_once() {
    let mut bench = flying(&[22, 16]);
    at(&mut bench, 2);
    for _ in 0..2 {
        current(&mut bench, 2, MissionState::MISSION_STATE_COMPLETE);
    }
    assert_eq!(bench.said(), ["plan flown to its end"]);
}

#[test]
fn a_landing_that_begins_the_plan_anew_is_its_end() {
    let mut bench = flying(&[22, 16, 21]);
    at(&mut bench, 3);
    bench.hear(MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: AUTO,
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        ..HEARTBEAT_DATA::DEFAULT
    }));
    bench.said();
    at(&mut bench, 1);
    assert_eq!(bench.said(), ["plan flown to its end"]);
    // The motors may also still be turning.
    let mut bench = flying(&[22, 16, 21]);
    at(&mut bench, 3);
    at(&mut bench, 1);
    assert_eq!(bench.said(), ["plan flown to its end"]);
}

#[test]
fn remarks_of_the_vehicle_are_read() {
    let of = PlanRemark::of;
    let jumped = |item, times| Some(PlanRemark::Jumped { item, times });
    assert_eq!(of("Mission: 5 Jump 2/3"), jumped(5, 2));
    assert_eq!(of("Mission: 12 Jump 64/unlimited"), jumped(12, 64));
    for other in [
        "Mission: 3 WP",
        "Mission: 3 JumpTag 0",
        "Reached command #3",
        "",
    ] {
        assert_eq!(of(other), None, "{other}");
    }
    let unknown = Some(PlanRemark::Unknown { command: 210 });
    assert_eq!(of("Skipping invalid cmd #210"), unknown);
}

#[test]
fn an_unknown_command_is_found_in_the_plan() {
    let mut bench = flying(&[210, 22, 16, 210, 16]);
    at(&mut bench, 5);
    bench.said();
    let mut notices = Vec::new();
    let mut report = HandlerNotices {
        vehicle: 7,
        now: bench.now,
        notices: &mut notices,
    };
    apply_text(&mut bench.vehicle, "Skipping invalid cmd #210", &mut report);
    apply_text(&mut bench.vehicle, "Skipping invalid cmd #9", &mut report);
    let said: Vec<String> = notices.iter().map(|it| it.text.to_string()).collect();
    assert_eq!(
        said,
        [
            "item 4 skipped: the vehicle does not know command 210 in a plan",
            "an item was skipped: the vehicle does not know command 9 in a plan",
        ]
    );
}
