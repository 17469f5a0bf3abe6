//! The fence, compared with measurements of the real vehicle.

use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, FENCE_STATUS_DATA, FenceMitigate, MavCmd, MavFrame, MavMessage, MavResult,
    SYS_STATUS_DATA,
};

mod limits;

use super::*;
use crate::autopilot::Autopilot;
use crate::autopilot::telemetry;
use crate::plan::Item;
use crate::tests::{Ground, start};
use sortie_geo::maths;

const RTL: u8 = 6;
const LAND: u8 = 9;
const BRAKE: u8 = 17;

/// The polygon that was flown with the real vehicle, with its northern corner 90 m north of the
/// start.
const PENTAGON: [(f64, f64); 5] = [
    (-60.0, -60.0),
    (-60.0, 60.0),
    (60.0, 90.0),
    (90.0, 0.0),
    (60.0, -60.0),
];

fn item(command: u16, first: f32, (north_m, east_m): (f64, f64)) -> Item {
    let (x, y) = start().at.moved(north_m, east_m).to_e7();
    Item {
        command,
        params: [first, 0.0, 0.0, 0.0],
        x,
        y,
        ..Item::default()
    }
}

fn polygon(command: u16, corners: &[(f64, f64)]) -> Vec<Item> {
    corners
        .iter()
        .map(|&corner| item(command, corners.len() as f32, corner))
        .collect()
}

fn pentagon_with_a_hole() -> Vec<Item> {
    let mut items = polygon(5001, &PENTAGON);
    items.push(item(5004, 8.0, (30.0, 30.0)));
    items
}

fn square(half_m: f64) -> Vec<Item> {
    let h = half_m;
    polygon(5001, &[(-h, -h), (-h, h), (h, h), (h, -h)])
}

const FENCE_STATUS: u32 = 162;

fn obstacle(ground: &mut Ground) -> Option<&'static str> {
    autopilot(ground).arming_checks().fence
}

fn autopilot(ground: &mut Ground) -> &mut Autopilot {
    &mut ground.world.slots[0].autopilot
}

fn set_fence(ground: &mut Ground, items: Vec<Item>) {
    autopilot(ground).vehicle.plans.fence = items;
    autopilot(ground).vehicle.fence_changed();
}

fn enable(ground: &mut Ground, on: f32) -> MavResult {
    ground.long(MavCmd::MAV_CMD_DO_FENCE_ENABLE, [on])
}

/// A vehicle hovering at 20 m inside an enabled fence.
fn fenced(items: Vec<Item>) -> Ground {
    let mut ground = Ground::hovering(20.0);
    set_fence(&mut ground, items);
    assert_eq!(enable(&mut ground, 1.0), MavResult::MAV_RESULT_ACCEPTED);
    ground
}

fn status(ground: &Ground) -> Option<FENCE_STATUS_DATA> {
    let message = telemetry::message(FENCE_STATUS, &ground.world.slots[0].autopilot);
    message.map(|message| match message {
        MavMessage::FENCE_STATUS(data) => data,
        other => panic!("{other:?}"),
    })
}

/// The fence's bit in the fields `present`, `enabled` and `health`.
fn bits(ground: &Ground) -> [bool; 3] {
    let message = telemetry::message(1, &ground.world.slots[0].autopilot);
    let Some(MavMessage::SYS_STATUS(SYS_STATUS_DATA {
        onboard_control_sensors_present: present,
        onboard_control_sensors_enabled: enabled,
        onboard_control_sensors_health: health,
        ..
    })) = message
    else {
        panic!("{message:?}")
    };
    [present, enabled, health].map(|bits| bits.bits() & 0x0010_0000 != 0)
}

fn said(ground: &Ground, text: &str) -> usize {
    ground.texts().iter().filter(|own| *own == text).count()
}

/// Requests a velocity every 0.4 s, as in the recording, for a time or until a condition holds.
fn push(
    ground: &mut Ground,
    v: [f32; 3],
    seconds: f64,
    mut see: impl FnMut(&mut Ground) -> bool,
) -> bool {
    for step in 0..(seconds * 100.0) as usize {
        if step % 40 == 0 {
            ground.fly(v);
        }
        ground.step();
        if see(ground) {
            return true;
        }
    }
    false
}

#[test]
fn lists_that_make_no_sense_are_found_with_the_vehicles_words() {
    let two = polygon(5001, &PENTAGON[..2]);
    let mut short = polygon(5001, &PENTAGON[..3]);
    short.pop();
    let mut mixed = polygon(5001, &PENTAGON[..3]);
    mixed[1].command = 5002;
    let mut uneven = polygon(5001, &PENTAGON[..3]);
    uneven[1].params[0] = 4.0;
    let mut inside = polygon(5001, &PENTAGON[..3]);
    inside[1].command = 5003;
    let mut nowhere = polygon(5001, &PENTAGON[..3]);
    nowhere[1].x = 910_000_000;
    let returns = vec![item(5000, 0.0, (0.0, 0.0)); 2];
    for (items, text) in [
        (two, "Invalid vertex count (2)"),
        (short, "Incorrect item count"),
        (
            vec![item(5003, 0.0, (0.0, 0.0))],
            "Non-positive circle radius",
        ),
        (
            vec![item(5004, f32::NAN, (0.0, 0.0))],
            "Non-positive circle radius",
        ),
        (mixed, "Received incorrect vertex type (want=98 got=97)"),
        (uneven, "Unexpected vertex count want=3 got=4\n"),
        (inside, "Received incorrect type (want=98 got=92)"),
        (nowhere, "Bad lat or lon"),
        (returns, "Multiple return points"),
    ] {
        let error = Fence::check(&items).expect_err(text);
        assert_eq!(error.to_string(), text);
    }
    for items in [Vec::new(), pentagon_with_a_hole()] {
        assert!(Fence::check(&items).is_ok());
    }
}

#[test]
fn a_fence_shows_in_the_status_while_it_is_enabled() {
    let mut ground = Ground::new();
    ground.run(2.0);
    assert_eq!(status(&ground), None);
    assert_eq!(bits(&ground), [true, false, true]);
    assert_eq!(enable(&mut ground, 1.0), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(bits(&ground), [true, true, true]);
    let told = status(&ground).expect("a status");
    assert_eq!(told.breach_status, 0);
    assert_eq!(told.breach_mitigation, FenceMitigate::FENCE_MITIGATE_NONE);
    ground.set("FENCE_ACTION", 0.0);
    assert_eq!(bits(&ground), [true, false, true]);
    assert_eq!(enable(&mut ground, 0.0), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(status(&ground), None);
    assert_eq!(enable(&mut ground, 7.0), MavResult::MAV_RESULT_FAILED);
    // Only polygons are enabled, and none is stored.
    ground.set("FENCE_TYPE", 4.0);
    assert_eq!(enable(&mut ground, 1.0), MavResult::MAV_RESULT_FAILED);
    assert_eq!(bits(&ground), [false, false, true]);
}

#[test]
fn points_outside_the_fence_are_refused() {
    let mut ground = fenced(pentagon_with_a_hole());
    for target in [[150.0, 0.0, -20.0], [30.0, 30.0, -20.0], [0.0, 0.0, -101.0]] {
        ground.goto(target);
        ground.run(3.0);
        let at = ground.truth().position_ned_m;
        assert!(
            maths::hypot(at[0], at[1]) < 0.1 && (at[2] + 20.0).abs() < 0.2,
            "{target:?}: {at:?}"
        );
    }
    let (x, y) = start().at.moved(160.0, 0.0).to_e7();
    let mut reposition = COMMAND_INT_DATA {
        command: MavCmd::MAV_CMD_DO_REPOSITION,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        param1: -1.0,
        x,
        y,
        z: 20.0,
        ..Default::default()
    };
    assert_eq!(ground.int(&reposition), MavResult::MAV_RESULT_FAILED);
    (reposition.x, reposition.y) = start().at.moved(10.0, 0.0).to_e7();
    assert_eq!(ground.int(&reposition), MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn a_fence_that_cannot_be_kept_forbids_arming() {
    for (name, value, reason) in [
        ("FENCE_TYPE", 0.0, Some("Fences enabled, but none selected")),
        ("FENCE_RADIUS", -1.0, Some("Invalid FENCE_RADIUS value")),
        (
            "FENCE_MARGIN",
            200.0,
            Some("Margin is less than inclusion circle radius"),
        ),
        ("FENCE_ALT_MAX", -1.0, Some("Invalid FENCE_ALT_MAX value")),
        ("FENCE_ALT_MIN", -101.0, Some("Invalid FENCE_ALT_MIN value")),
        ("FENCE_MARGIN", -1.0, Some("Invalid FENCE_MARGIN value")),
        (
            "FENCE_ALT_MIN",
            101.0,
            Some("FENCE_ALT_MAX < FENCE_ALT_MIN"),
        ),
        ("FENCE_MARGIN", 60.0, Some("FENCE_MARGIN too big")),
        ("FENCE_MARGIN", 20.0, None),
    ] {
        let mut ground = Ground::new();
        set_fence(&mut ground, vec![item(5003, 90.0, (0.0, 0.0))]);
        ground.set("FENCE_ENABLE", 1.0);
        let early = obstacle(&mut ground);
        assert_eq!(early, Some("Fence requires position"));
        ground.run(2.0);
        ground.set(name, value);
        assert_eq!(obstacle(&mut ground), reason, "{name} {value}");
    }
}

#[test]
fn a_vehicle_outside_its_fence_cannot_be_armed() {
    let mut ground = Ground::new();
    ground.run(2.0);
    set_fence(
        &mut ground,
        polygon(5001, &[(200.0, 200.0), (200.0, 260.0), (260.0, 230.0)]),
    );
    enable(&mut ground, 1.0);
    ground.run(0.1);
    let told = status(&ground).expect("a status");
    assert_eq!((told.breach_status, told.breach_count), (1, 1));
    assert_eq!(bits(&ground), [true, true, false]);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    let armed = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(armed, MavResult::MAV_RESULT_FAILED);
    assert_eq!(said(&ground, "Arm: vehicle outside fence"), 1);
    enable(&mut ground, 0.0);
    let armed = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(armed, MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn without_avoidance_a_breach_returns_the_vehicle_in_one_tick() {
    let mut ground = fenced(square(60.0));
    ground.set("AVOID_ENABLE", 0.0);
    let before = ground.heard.len();
    assert!(push(&mut ground, [5.0, 0.0, 0.0], 40.0, |ground| ground
        .truth()
        .mode
        == RTL));
    let north_m = ground.truth().position_ned_m[0];
    assert!((north_m - 60.0).abs() < 0.4, "{north_m}");
    let told = status(&ground).expect("a status");
    assert_eq!((told.breach_status, told.breach_count), (1, 1));
    assert_eq!(told.breach_type, FenceBreach::FENCE_BREACH_BOUNDARY);
    assert_eq!(bits(&ground), [true, true, false]);
    let kinds: Vec<_> = ground
        .messages_since(before)
        .iter()
        .filter_map(|message| match message {
            MavMessage::HEARTBEAT(data) if data.custom_mode == u32::from(RTL) => Some("mode"),
            MavMessage::FENCE_STATUS(_) => Some("status"),
            MavMessage::STATUSTEXT(_) => Some("text"),
            _ => None,
        })
        .collect();
    assert_eq!(kinds, ["mode", "status", "text"]);
    let mut most: f64 = 0.0;
    for _ in 0..1500 {
        ground.step();
        most = most.max(ground.truth().position_ned_m[0]);
    }
    println!("overshoot {:.2}, measured 6", most - 60.0);
    assert!((most - 66.0).abs() < 0.8, "{most}");
    ground.run(10.0);
    let told = status(&ground).expect("a status");
    assert_eq!((told.breach_status, told.breach_count), (0, 1));
    assert_eq!(bits(&ground), [true, true, true]);
}

#[test]
fn a_return_stays_under_the_ceiling() {
    let mut ground = Ground::armed();
    enable(&mut ground, 1.0);
    ground.set("FENCE_ALT_MAX", 14.0);
    ground.takeoff(6.0);
    ground.run(20.0);
    ground.goto([40.0, 0.0, -6.0]);
    ground.run(15.0);
    ground.long(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0]);
    let mut highest_m: f64 = 0.0;
    push_nothing(&mut ground, 30.0, |at| highest_m = highest_m.max(-at[2]));
    assert!((highest_m - 12.0).abs() < 0.1, "{highest_m}");
}

fn push_nothing(ground: &mut Ground, seconds: f64, mut see: impl FnMut([f64; 3])) {
    for _ in 0..(seconds * 100.0) as usize {
        ground.step();
        see(ground.truth().position_ned_m);
    }
}

#[test]
fn a_return_lands_at_the_rally_point_as_the_real_one_did() {
    let rally = |north_m, east_m, z| Item {
        command: 5100,
        frame: 3,
        z,
        ..item(5100, 0.0, (north_m, east_m))
    };
    for (with_home, landed_at) in [(0.0, (-30.0, -20.0)), (1.0, (0.0, 0.0))] {
        let mut ground = Ground::hovering(10.0);
        ground.set("RALLY_INCL_HOME", with_home);
        autopilot(&mut ground).vehicle.plans.rally =
            vec![rally(-30.0, -20.0, 18.0), rally(-30.0, 30.0, 12.0)];
        ground.long(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0]);
        let mut highest_m: f64 = 0.0;
        push_nothing(&mut ground, 80.0, |at| highest_m = highest_m.max(-at[2]));
        let truth = ground.truth();
        // Measured: landed at N -29.99, E -20.02.
        let [north_m, east_m, _] = truth.position_ned_m;
        let off_m = maths::hypot(north_m - landed_at.0, east_m - landed_at.1);
        assert!(off_m < 0.3 && !truth.armed, "{truth:?}");
        // The climb is to the altitude of the rally point, not to RTL_ALT; over home itself, no climb is needed.
        let least_m = if with_home > 0.0 { 10.0 } else { 18.0 };
        assert!((highest_m - least_m).abs() < 0.2, "{highest_m}");
    }
}

#[test]
fn guided_is_allowed_outside_and_not_broken_anew() {
    let mut ground = fenced(square(60.0));
    ground.set("AVOID_ENABLE", 0.0);
    push(&mut ground, [5.0, 0.0, 0.0], 40.0, |ground| {
        ground.truth().mode == RTL
    });
    let guided = ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    assert_eq!(guided, MavResult::MAV_RESULT_ACCEPTED);
    push(&mut ground, [1.0, 0.0, 0.0], 20.0, |_| false);
    assert_eq!(ground.truth().mode, 4);
    assert_eq!(status(&ground).map(|told| told.breach_count), Some(1));
    // The circle around home is larger and is checked separately.
    push(&mut ground, [8.0, 0.0, 0.0], 20.0, |ground| {
        ground.truth().mode == RTL
    });
    let north_m = ground.truth().position_ned_m[0];
    assert!((north_m - 150.0).abs() < 0.5, "{north_m}");
}

#[test]
fn each_action_does_what_it_says() {
    for (action, mode) in [
        (0.0, 4),
        (1.0, RTL),
        (2.0, LAND),
        (3.0, 21),
        (4.0, BRAKE),
        (5.0, 21),
    ] {
        let mut ground = fenced(square(20.0));
        ground.set("AVOID_ENABLE", 0.0);
        ground.set("FENCE_ACTION", action);
        push(&mut ground, [5.0, 0.0, 0.0], 10.0, |ground| {
            said(ground, "Fence Breached") > 0
        });
        assert_eq!(ground.truth().mode, mode, "action {action}");
        assert_eq!(said(&ground, "Fence Breached"), 1, "action {action}");
    }
}

#[test]
fn a_limit_is_broken_anew_20_m_further_out_and_the_vehicle_gives_up_100_m_outside() {
    let rules = FenceRules {
        is_enabled: true,
        ..FenceRules::read(&Parameters::new(crate::VehicleKind::Copter, 1))
    };
    let mut fence = Geofence::default();
    let mut check = |distance_m: f64, seconds: u64| {
        let point = DVec3::new(distance_m, 0.0, -10.0);
        let spot = FencePosition::new(point, DVec3::ZERO);
        let fresh = fence.check(&rules, spot, Duration::from_secs(seconds));
        (fresh, fence.breaches, fence.farthest_m(fresh))
    };
    assert_eq!(check(149.0, 1), (0, 0, 0.0));
    assert_eq!(check(151.0, 2), (CIRCLE, 1, 1.0));
    assert_eq!(check(170.0, 3), (0, 1, 0.0));
    assert_eq!(check(172.0, 4), (CIRCLE, 2, 22.0));
    assert_eq!(check(260.0, 5), (CIRCLE, 3, 110.0));
    assert_eq!(check(149.0, 6), (0, 3, 0.0));
    assert_eq!(check(150.0, 7), (CIRCLE, 4, 0.0));
}

#[test]
fn a_reboot_keeps_the_fence() {
    let mut ground = Ground::new();
    ground.run(2.0);
    set_fence(&mut ground, square(60.0));
    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(1.0);
    assert_eq!(autopilot(&mut ground).vehicle.fence.areas.len(), 1);
}
