//! Collisions of flying vehicles, and of bodies placed by hand.

use mavlink::dialects::ardupilotmega::MavCmd;
use proptest::prelude::*;

use super::*;
use crate::WorldConfig;
use crate::arming::ArmingMethod;
use crate::tests::{Ground, start};
use crate::wind::Wind;

/// The size of the default airframe.
const SIZE_M: f64 = 0.5;

fn autopilot(at: [f64; 3], velocity: [f64; 3], in_air: bool) -> Autopilot {
    let mut autopilot = Autopilot::new(
        crate::VehicleKind::Copter,
        1,
        start(),
        crate::Airframe::shared_default(),
        Wind::new(0, 0),
    );
    autopilot.vehicle.plant.body.position_m = DVec3::from_array(at);
    autopilot.vehicle.plant.body.velocity_m_s = DVec3::from_array(velocity);
    autopilot.vehicle.plant.body.on_ground = !in_air;
    autopilot
}

/// The effects on each vehicle, and the pairs.
fn outcome(autopilots: &[Autopilot]) -> (Vec<DVec3>, Vec<(usize, Met)>) {
    let mut collisions = Collisions::new(Some(start()), &[]);
    let mut changes = vec![DVec3::ZERO; autopilots.len()];
    for hit in collisions.find(Duration::ZERO, autopilots.iter()) {
        changes[hit.vehicle] += hit.change_m_s;
    }
    let met = collisions
        .events()
        .iter()
        .map(|event| (event.vehicle, event.with));
    (changes, met.collect())
}

/// The pairs that touch and approach, by brute force.
fn pairs_by_hand(autopilots: &[Autopilot]) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    for (first, a) in autopilots.iter().enumerate() {
        for (second, b) in autopilots.iter().enumerate().skip(first + 1) {
            let apart = a.vehicle.plant.body.position_m - b.vehicle.plant.body.position_m;
            let closing = (b.vehicle.plant.body.velocity_m_s - a.vehicle.plant.body.velocity_m_s)
                .dot(apart)
                > 0.0;
            let flying = !(a.vehicle.plant.body.on_ground && b.vehicle.plant.body.on_ground);
            if apart.length() < SIZE_M && closing && flying {
                pairs.push((first, second));
            }
        }
    }
    pairs
}

fn crowd() -> impl Strategy<Value = Vec<Autopilot>> {
    let place = [-4.5f64..4.5, -4.5..4.5, -2.0..0.0];
    let velocity = [-5.0f64..5.0, -5.0..5.0, -2.0..2.0];
    let vehicle = (place, velocity, proptest::bool::weighted(0.8));
    proptest::collection::vec(vehicle.prop_map(|(p, v, air)| autopilot(p, v, air)), 0..120)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]
    #[test]
    fn the_grid_finds_the_pairs_that_a_look_at_all_of_them_finds(crowd in crowd()) {
        let (_, met) = outcome(&crowd);
        let pairs = pairs_by_hand(&crowd);
        let expected: Vec<_> = pairs.into_iter().map(|(a, b)| (a, Met::Vehicle(b))).collect();
        prop_assert_eq!(met, expected);
    }

    #[test]
    fn the_order_of_the_vehicles_changes_nothing(crowd in crowd()) {
        let (changes, met) = outcome(&crowd);
        let backwards: Vec<_> = crowd.iter().rev().cloned().collect();
        let (mirrored, mirrored_met) = outcome(&backwards);
        for (own, other) in changes.iter().zip(mirrored.iter().rev()) {
            prop_assert!(own.distance(*other) < 1e-12, "{} {}", own, other);
        }
        prop_assert_eq!(met.len(), mirrored_met.len());
        // Momentum is conserved.
        prop_assert!(changes.iter().sum::<DVec3>().length() < 1e-9);
    }
}

/// A world of two vehicles 5 m apart that hover at 10 m; the ground station talks to the first.
fn two_in_the_air() -> Ground {
    let mut ground = Ground::in_world(&WorldConfig::row(2, start()));
    ground.run(2.0);
    for autopilot in ground
        .world
        .slots
        .iter_mut()
        .map(|slot| &mut slot.autopilot)
    {
        autopilot.set_mode_numbered(4);
        assert!(autopilot.arm(ArmingMethod::Command));
    }
    ground.takeoff(10.0);
    let goal = DVec3::new(0.0, 0.0, -10.0);
    let other = &mut ground.world.slots[1].autopilot;
    other.vehicle.safety.landed = false;
    other.vehicle.flight.task = crate::task::Task::goto(goal);
    ground.run(25.0);
    ground
}

#[test]
fn two_vehicles_that_meet_break_and_fall() {
    let mut ground = two_in_the_air();
    assert_eq!(ground.world.collisions(), []);
    ground.goto([0.0, 10.0, -10.0]);
    ground.run(20.0);
    let [collision] = *ground.world.collisions() else {
        panic!("{:?}", ground.world.collisions())
    };
    assert_eq!((collision.vehicle, collision.with), (0, Met::Vehicle(1)));
    assert!((collision.altitude_amsl_m - 594.0).abs() < 0.3);
    let (_, east_m) = start().at.offset_to(collision.place);
    assert!((east_m - 4.5).abs() < 0.1, "{east_m}");
    assert!((1.0..5.0).contains(&collision.speed_m_s), "{collision:?}");
    for vehicle in 0..2 {
        let truth = ground.world.truth(vehicle);
        assert!(
            truth.on_ground && truth.position_ned_m[2].abs() < 0.1,
            "{truth:?}"
        );
        let [north, east, _] = truth.position_ned_m;
        assert!(north.is_finite() && east.abs() < 12.0);
    }
}

#[test]
fn a_wreck_flies_again_after_a_reboot() {
    let mut ground = two_in_the_air();
    ground.goto([0.0, 10.0, -10.0]);
    ground.run(20.0);
    let own = &mut ground.world.slots[0].autopilot;
    assert!(own.vehicle.plant.body.wrecked);
    own.disarm();
    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(1.0);
    assert!(!ground.world.slots[0].autopilot.vehicle.plant.body.wrecked);
}

fn obstacle(north_m: f64, shape: Shape, height_m: f64) -> Obstacle {
    Obstacle {
        placement: Placement::Ned([north_m, 0.0, 0.0]),
        shape,
        height_m,
    }
}

fn house(north_m: f64, height_m: f64) -> Obstacle {
    let shape = Shape::Box {
        length_m: 4.0,
        width_m: 10.0,
        heading_deg: 0.0,
    };
    obstacle(north_m, shape, height_m)
}

/// Hovers at 10 m, then flies 40 m north at 5 m/s past or into these obstacles.
fn fly_north(obstacles: &[Obstacle]) -> Ground {
    let mut ground = Ground::in_world(&WorldConfig {
        obstacles: obstacles.to_vec(),
        ..WorldConfig::row(1, start())
    });
    ground.arm();
    ground.takeoff(10.0);
    ground.run(20.0);
    for _ in 0..40 {
        ground.fly([5.0, 0.0, 0.0]);
        ground.run(0.2);
    }
    ground
}

#[test]
fn a_vehicle_breaks_on_what_stands_in_its_way() {
    let mast = Shape::Cylinder { radius_m: 0.5 };
    let turned = Shape::Box {
        length_m: 30.0,
        width_m: 2.0,
        heading_deg: 45.0,
    };
    let tower = Obstacle {
        placement: Placement::Global {
            at: start().at.moved(20.0, 0.0),
            altitude_amsl_m: 584.0,
        },
        shape: mast,
        height_m: 30.0,
    };
    for (what, obstacle, wall_m) in [
        ("a house", house(20.0, 12.0), Some(18.0)),
        ("a low house", house(20.0, 9.0), None),
        ("a mast", obstacle(20.0, mast, 30.0), Some(19.5)),
        ("a mast behind", obstacle(-20.0, mast, 30.0), None),
        ("a tower on the map", tower, Some(19.5)),
        (
            "a turned wall",
            obstacle(20.0, turned, 30.0),
            Some(20.0 - 2f64.sqrt()),
        ),
        (
            "a country",
            obstacle(20_020.0, Shape::Cylinder { radius_m: 20_000.0 }, 30.0),
            Some(20.0),
        ),
        (
            "nothing",
            obstacle(20.0, Shape::Cylinder { radius_m: 0.0 }, 30.0),
            None,
        ),
        ("nowhere", obstacle(f64::NAN, mast, 30.0), None),
    ] {
        let ground = fly_north(&[house(500.0, 5.0), obstacle]);
        let truth = ground.truth();
        let Some(wall_m) = wall_m else {
            assert_eq!(ground.world.collisions(), [], "{what}");
            assert!(truth.position_ned_m[0] > 30.0, "{what}");
            continue;
        };
        let [collision] = *ground.world.collisions() else {
            panic!("{what}: {:?}", ground.world.collisions())
        };
        assert_eq!(collision.with, Met::Obstacle(1), "{what}");
        assert!(
            (collision.speed_m_s - 5.0).abs() < 0.3,
            "{what}: {collision:?}"
        );
        let (north_m, _) = start().at.offset_to(collision.place);
        assert!(
            (wall_m - 0.5..wall_m).contains(&north_m),
            "{what}: {north_m}"
        );
        let [north_m, east_m, _] = truth.position_ned_m;
        assert!(
            truth.on_ground && north_m - east_m < wall_m,
            "{what}: {truth:?}"
        );
    }
}

#[test]
fn a_vehicle_may_land_on_a_roof() {
    let mut ground = fly_north(&[house(40.0, 5.0)]);
    ground.goto([40.0, 0.0, -10.0]);
    ground.run(10.0);
    ground.goto([40.0, 0.0, -5.5]);
    ground.run(10.0);
    ground.fly([0.0, 0.0, 0.5]);
    ground.run(2.9);
    assert_eq!(ground.world.collisions(), []);
    let height_m = -ground.truth().position_ned_m[2];
    assert!((height_m - 5.0).abs() < 0.05, "{height_m}");
}
