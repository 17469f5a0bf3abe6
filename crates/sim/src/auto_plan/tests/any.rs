//! Missions of random items, most of them meaningless.

use proptest::prelude::*;

use super::*;
use sortie_geo::LatLon;

fn any_item() -> impl Strategy<Value = Item> {
    let commands = prop_oneof![
        Just(16u16),
        Just(17),
        Just(18),
        Just(19),
        Just(20),
        Just(21),
        Just(22),
        Just(30),
        Just(31),
        Just(82),
        Just(92),
        Just(93),
        Just(112),
        Just(114),
        Just(115),
        Just(177),
        Just(178),
        Just(179),
        Just(183),
        Just(189),
        Just(201),
        Just(205),
        Just(600),
        Just(601),
        any::<u16>(),
    ];
    let number = || prop_oneof![Just(0.0f32), -5.0..20.0f32, any::<f32>()];
    let place = prop_oneof![
        Just(LatLon::new(0.0, 0.0).to_e7()),
        (-80.0..80.0f64, -80.0..80.0f64).prop_map(|(n, e)| start().at.moved(n, e).to_e7()),
        any::<(i32, i32)>(),
    ];
    let p = [number(), number(), number(), number()];
    (commands, 0u8..12, p, place, number()).prop_map(|(command, frame, p, (x, y), z)| Item {
        command,
        frame,
        auto_continue: true,
        params: p,
        x,
        y,
        z,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_list_of_items_breaks_the_vehicle(items in proptest::collection::vec(any_item(), 1..12), set in 0u16..15, speed in prop_oneof![Just(1000.0f32), -10.0..99999.0f32], jerk in -1.0..20.0f32) {
        let mut list = vec![act(22, [0.0; 4], 8.0)];
        list.extend(items);
        let mut ground = ready_with(&list);
        ground.set("WPNAV_SPEED", speed);
        ground.set("WPNAV_JERK", jerk);
        ground.start_mission();
        for round in 0..12 {
            ground.run(4.0);
            let truth = ground.truth();
            prop_assert!(truth.position_ned_m.iter().chain(&truth.velocity_ned_m_s).all(|v| v.is_finite()), "{truth:?}");
            prop_assert!(truth.position_ned_m[2] <= 1e-9, "under ground");
            match round {
                4 => ground.autopilot().plans_changed(ListKind::Plan),
                6 => { ground.with_plan(|plan, vehicle| plan.set_item(vehicle, set)); }
                8 => { ground.with_plan(|plan, vehicle| plan.pause(vehicle, true)); }
                9 => { ground.with_plan(|plan, vehicle| plan.pause(vehicle, false)); }
                _ => {}
            }
            ground.heard.clear();
        }
    }
}
