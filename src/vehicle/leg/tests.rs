use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use crate::plan::Item;
use crate::vehicle::{
    GlobalPosition, Heartbeat, LandedState, Mode, Place, Plan, Stored, SystemStatus, Transfer,
    VehicleClass,
};

const HOME: LatLon = LatLon::new(50.0, 30.0);

/// An item some metres north of home, 20 m high.
fn item(command: u16, params: [f32; 3], north_m: f64) -> Item {
    let (x, y) = HOME.moved(north_m, 0.0).to_e7();
    Item {
        command,
        frame: 3,
        auto_continue: true,
        params: [params[0], params[1], params[2], 0.0],
        x,
        y,
        z: 20.0,
    }
}

fn waypoint(north_m: f64) -> Item {
    item(16, [0.0; 3], north_m)
}

/// A copter in AUTO above home at an item, 20 m high; it has flown at 10 m/s.
fn flying(items: &[Item], current: u16) -> Vehicle {
    let mut vehicle = Vehicle::new(1, 1);
    let class = VehicleClass::Copter;
    let at = Duration::ZERO;
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class,
        mode: Mode { class, number: 3 },
        armed: true,
        status: SystemStatus::Active,
        at,
    });
    vehicle.landed = LandedState::InAir;
    vehicle.home = Some(Place {
        at_point: HOME,
        altitude_amsl_m: 170.0,
    });
    vehicle.global = Some(GlobalPosition {
        at_point: HOME,
        altitude_amsl_m: 190.0,
        altitude_m: 20.0,
        north_m_s: 10.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: None,
        at,
    });
    vehicle.cruise = LegSpeed::after(None, 10.0, at);
    let home = item(16, [0.0; 3], 0.0);
    vehicle.plans.plan = Stored {
        content: Some(Arc::new(Plan {
            items: std::iter::once(home).chain(items.iter().copied()).collect(),
            home_first: true,
        })),
        transfer: Transfer::Done,
    };
    vehicle.plan.current = current;
    vehicle.plan.total = u16::try_from(items.len()).ok();
    vehicle
}

/// The seconds to the next place and to the end.
fn times(vehicle: &Vehicle) -> (Option<f64>, Option<f64>) {
    let leg = vehicle.plan_leg().expect("it flies a plan");
    let seconds = |time: Option<Duration>| time.map(|it| (it.as_secs_f64() * 10.0).round() / 10.0);
    (seconds(leg.next), seconds(leg.end))
}

#[test]
fn legs_stays_and_the_way_home_add_up() {
    let plan = [
        item(22, [0.0; 3], 0.0),
        waypoint(100.0),
        item(16, [5.0, 0.0, 0.0], 300.0),
        item(93, [12.0, -1.0, -1.0], 0.0),
        item(20, [0.0; 3], 0.0),
    ];
    let vehicle = flying(&plan, 2);
    let leg = vehicle.plan_leg().expect("it flies a plan");
    assert_eq!((leg.item, leg.last), (2, 5));
    assert!(
        leg.left_m
            .is_some_and(|left_m| (left_m - 100.0).abs() < 0.5)
    );
    // 10 s, 20 s and the stay, the delay; 300 m home, 6.7 s and 20 s down, and the pauses.
    assert_eq!(
        times(&vehicle),
        (Some(10.0), Some(47.0 + 30.0 + 26.7 + 12.0))
    );
}

#[test]
fn a_takeoff_is_a_climb_and_a_delay_passes() {
    let plan = [item(22, [0.0; 3], 0.0), item(93, [12.0, -1.0, -1.0], 0.0)];
    let mut vehicle = flying(&plan, 1);
    if let Some(global) = &mut vehicle.global {
        global.altitude_m = 10.0;
    }
    assert_eq!(times(&vehicle), (Some(4.0), Some(16.0)));
    vehicle.plan.current = 2;
    vehicle.plan.since = Some(Duration::from_secs(3));
    vehicle.boot_ms = Some(8000);
    assert_eq!(times(&vehicle), (Some(7.0), Some(7.0)));
    let again = [
        item(93, [12.0, -1.0, -1.0], 0.0),
        item(177, [1.0, 1.0, 0.0], 0.0),
    ];
    let mut vehicle = flying(&again, 1);
    vehicle.plan.since = Some(Duration::from_secs(3));
    vehicle.boot_ms = Some(8000);
    assert_eq!(
        times(&vehicle),
        (Some(7.0), Some(19.0)),
        "the next time is whole"
    );
}

#[test]
fn speeds_of_the_plan_count_from_their_item_on() {
    let change = item(178, [1.0, 4.0, -1.0], 0.0);
    let mut vehicle = flying(&[waypoint(100.0), change, waypoint(180.0)], 1);
    assert_eq!(times(&vehicle), (Some(10.0), Some(30.0)));
    vehicle.plan.current = 3;
    vehicle.cruise = None;
    assert_eq!(times(&vehicle), (Some(45.0), Some(45.0)));
    vehicle.plan.current = 1;
    assert_eq!(times(&vehicle), (Some(10.0), Some(30.0)), "the usual speed");
}

/// Before a vehicle has a speed, the duration of its takeoff is known, and so is that of the rest
/// of the plan.
#[test]
fn from_the_takeoff_on_the_end_is_known() {
    let mut vehicle = flying(&[item(22, [0.0; 3], 0.0), waypoint(100.0)], 1);
    vehicle.cruise = None;
    if let Some(global) = &mut vehicle.global {
        global.altitude_m = 0.0;
    }
    assert_eq!(times(&vehicle), (Some(8.0), Some(8.0 + 16.5)));
}

/// A plane comes down on its last leg.
#[test]
fn a_plane_that_lands_has_an_end() {
    let mut vehicle = flying(&[waypoint(100.0), item(21, [0.0; 3], 300.0)], 1);
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.mav_type = 1;
        heartbeat.class = VehicleClass::Plane;
        heartbeat.mode = VehicleClass::Plane.mode("AUTO").expect("a mode");
    }
    assert_eq!(times(&vehicle), (Some(10.0), Some(30.0)));
}

/// Two turns with a radius of 25 m take 56.2 s; the part already flown, by the vehicle's clock, no
/// longer counts.
#[test]
fn turns_count_from_their_circle_on() {
    let plan = [item(18, [2.0, 0.0, 25.0], 125.0), waypoint(125.0)];
    let mut vehicle = flying(&plan, 1);
    let (next, end) = times(&vehicle);
    assert_eq!(next, Some(66.2), "100 m to the circle");
    assert!(end > next, "{end:?}");
    let at = |vehicle: &mut Vehicle, north_m: f64, clock_s: u64| {
        if let Some(global) = &mut vehicle.global {
            global.at_point = HOME.moved(north_m, 0.0);
        }
        vehicle.boot_ms = Some(clock_s as u32 * 1000);
        vehicle.note_arrival(Duration::from_secs(clock_s));
    };
    at(&mut vehicle, 50.0, 100);
    assert_eq!(vehicle.plan.arrived, None, "on the way");
    at(&mut vehicle, 99.0, 105);
    assert_eq!(times(&vehicle).0, Some(56.2));
    // With a speed-up, this took only a second on the console's clock.
    vehicle.link.last_heard = Some(Duration::from_secs(1));
    at(&mut vehicle, 150.0, 125);
    assert_eq!(times(&vehicle).0, Some(36.2));
}

#[test]
fn a_hold_passes_at_its_place() {
    let mut vehicle = flying(&[item(16, [20.0, 0.0, 0.0], 100.0), waypoint(200.0)], 1);
    assert_eq!(times(&vehicle).0, Some(30.0), "10 s and the hold");
    vehicle.plan.arrived = Some(Duration::from_secs(50));
    vehicle.boot_ms = Some(65_000);
    if let Some(global) = &mut vehicle.global {
        global.at_point = HOME.moved(100.0, 0.0);
    }
    assert_eq!(times(&vehicle), (Some(5.0), Some(5.0 + 16.5)));
}

#[test]
fn a_descent_at_home_counts_no_way() {
    let mut vehicle = flying(&[waypoint(100.0), item(20, [0.0; 3], 0.0)], 2);
    assert_eq!(times(&vehicle).1, Some(round(5.0 + 6.7 + 20.0 + 2.0)));
    if let Some(global) = &mut vehicle.global {
        (global.altitude_m, global.down_m_s) = (5.0, 0.5);
    }
    assert_eq!(times(&vehicle), (Some(12.0), Some(12.0)));
}

fn round(seconds: f64) -> f64 {
    (seconds * 10.0).round() / 10.0
}

#[test]
fn jumps_are_flown_as_often_as_they_say_less_those_taken() {
    let jump = |times| item(177, [1.0, times, 0.0], 0.0);
    let there_and_back = |times| [waypoint(100.0), waypoint(0.0), jump(times)];
    let mut vehicle = flying(&there_and_back(2.0), 1);
    // Each of the five turns costs 6.5 s.
    assert_eq!(times(&vehicle), (Some(10.0), Some(60.0 + 32.5)));
    vehicle.plan_jumps.insert(3, 1);
    assert_eq!(times(&vehicle), (Some(10.0), Some(40.0 + 19.5)));
    let vehicle = flying(&there_and_back(-1.0), 1);
    assert_eq!(times(&vehicle), (Some(10.0), None), "it never ends");
}

#[test]
fn what_has_no_known_end_has_no_time() {
    for endless in [17, 94, 92] {
        let vehicle = flying(&[waypoint(100.0), item(endless, [0.0; 3], 100.0)], 1);
        assert_eq!(times(&vehicle), (Some(10.0), None), "{endless}");
    }
    let mut vehicle = flying(&[waypoint(100.0)], 1);
    vehicle.plan.phase = Some(PlanPhase::Paused);
    assert_eq!(times(&vehicle), (None, None));
    assert!(vehicle.plan_leg().is_some_and(|leg| leg.left_m.is_some()));
}

#[test]
fn only_a_plan_that_is_flown_and_known_has_a_leg() {
    let flown = flying(&[waypoint(100.0)], 1);
    let change = |change: fn(&mut Vehicle)| {
        let mut vehicle = flown.clone();
        change(&mut vehicle);
        vehicle.plan_leg()
    };
    assert!(change(|_| {}).is_some());
    assert!(change(|it| it.plans.plan.content = None).is_none());
    assert!(change(|it| it.plan.current = 0).is_none());
    assert!(change(|it| it.plan.current = 2).is_none());
    assert!(change(|it| it.plan.phase = Some(PlanPhase::Complete)).is_none());
    assert!(change(|it| it.heartbeat = None).is_none());
    let nowhere = change(|it| it.global = None).expect("an item");
    assert_eq!(
        (nowhere.left_m, nowhere.next, nowhere.end),
        (None, None, None)
    );
}

#[test]
fn stops_do_not_change_the_speed_and_a_new_one_is_soon_known() {
    let at = Duration::from_secs;
    let mut mean = LegSpeed::after(None, 2.0, at(0));
    mean = LegSpeed::after(mean, 10.0, at(1));
    mean = LegSpeed::after(mean, 0.2, at(60));
    assert_eq!(mean.map(|mean| mean.speed_m_s), Some(10.0));
    mean = LegSpeed::after(mean, 3.0, at(90));
    let slow_m_s = mean.map_or(0.0, |mean| mean.speed_m_s);
    assert!((3.0..3.5).contains(&slow_m_s), "{slow_m_s}");
    assert_eq!(LegSpeed::after(None, 0.5, at(0)), None);
}

proptest! {
    #[test]
    fn any_plan_has_times_that_are_not_negative(
        list in proptest::collection::vec(
            (prop_oneof![Just(16u16), Just(17), Just(18), Just(19), Just(20), Just(21), Just(22), Just(93), Just(177), Just(178), Just(600), Just(601), any::<u16>()],
             proptest::array::uniform3(prop_oneof![-3.0..30.0f32, Just(f32::NAN)]), -500.0..500.0f64), 0..12),
        current in 0u16..14,
    ) {
        let items: Vec<Item> = list.into_iter().map(|(command, params, north_m)| item(command, params, north_m)).collect();
        let vehicle = flying(&items, current);
        if let Some(leg) = vehicle.plan_leg() {
            prop_assert!(leg.item <= leg.last);
            prop_assert!(leg.left_m.is_none_or(|left_m| left_m >= 0.0));
        }
    }
}
