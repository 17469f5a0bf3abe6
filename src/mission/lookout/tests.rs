use super::*;
use crate::geo::maths;
use crate::mission::ground_truth::{Object, ObjectClass};
use crate::mission::weather::{Light, Weather};

const SEEDS: u64 = 2000;

fn sensor(id: &str) -> &'static Sensor {
    Sensor::by_id(id).expect("it is in the catalogue")
}

/// A vehicle in the air south of the origin, flying north.
fn craft(id: VehicleId, sensor_id: &str, height_m: f64, speed_m_s: f64) -> Craft {
    let mut craft = Craft::new(id, &[sensor(sensor_id)], 1);
    craft.at = Some([0.0, -10.0]);
    craft.heard = true;
    craft.under_way = true;
    craft.height_m = height_m;
    craft.speed_m_s = speed_m_s;
    craft
}

fn world(objects: Vec<Object>, light: Light) -> World {
    let weather = Weather {
        light,
        ..Weather::CALM
    };
    World::of_objects(weather, objects)
}

/// Flies past the origin, this far east of it, from 10 m before it to 10 m beyond it; returns the number of sightings.
fn pass(
    lookout: &mut Lookout,
    craft: &mut Craft,
    world: &World,
    east_m: f64,
    now: &mut Duration,
) -> usize {
    let mut seen = 0;
    let steps = (20.0 / (craft.speed_m_s * TICK.as_secs_f64())) as u32;
    for step in 0..steps {
        let way_m = f64::from(step) * craft.speed_m_s * TICK.as_secs_f64();
        craft.at = Some([east_m, way_m - 10.0]);
        *now += TICK;
        seen += lookout
            .step(craft, world, &[], *now)
            .iter()
            .filter(|s| s.object.is_some())
            .count();
    }
    seen
}

/// The share of seeds with at least one find.
fn share(passes: u32, sensor: &str, class: ObjectClass, height_m: f64, speed_m_s: f64) -> f64 {
    let world = world(vec![Object::new(class, [0.0; 2])], Light::Night);
    let found = (0..SEEDS).filter(|&seed| {
        let mut lookout = Lookout::new(seed);
        let mut craft = craft(1, sensor, height_m, speed_m_s);
        let mut now = Duration::ZERO;
        (0..passes)
            .map(|_| pass(&mut lookout, &mut craft, &world, 0.0, &mut now))
            .sum::<usize>()
            > 0
    });
    found.count() as f64 / SEEDS as f64
}

/// Four standard deviations of a share over [`SEEDS`] seeds.
fn sure(share: f64) -> f64 {
    4.0 * (share * (1.0 - share) / SEEDS as f64).sqrt()
}

#[test]
fn passes_over_a_mine_add_up_to_one_minus_the_product_of_misses() {
    // The sensor's best probability times the remainder at 2 m/s: 1 / (1 + e^((2 - 4) / 0.6)).
    let one = 0.10 / (1.0 + maths::exp(-2.0_f64 / 0.6));
    for passes in [1, 4] {
        let all = (1.0 - NEVER_SEEN) * (1.0 - maths::powi(1.0 - one, passes));
        let found = share(
            passes as u32,
            "s_mag",
            ObjectClass::MinimumMetalMine,
            1.0,
            2.0,
        );
        assert!(
            (found - all).abs() < sure(all),
            "{passes} passes: {found}, not {all}"
        );
    }
}

#[test]
fn a_pass_beside_a_mine_hides_nothing_from_the_pass_after_it() {
    let world = world(
        vec![Object::new(ObjectClass::MinimumMetalMine, [0.0; 2])],
        Light::Day,
    );
    // The strip is 2 m wide: the first pass sees the mine at its edge only.
    let finds = |seed: u64, ways: &[f64]| {
        let mut lookout = Lookout::new(seed);
        let mut craft = craft(1, "s_mag", 1.0, 2.0);
        let mut now = Duration::ZERO;
        let passes = ways
            .iter()
            .map(|&east| pass(&mut lookout, &mut craft, &world, east, &mut now));
        passes.sum::<usize>()
    };
    let hidden =
        (0..SEEDS).filter(|&seed| finds(seed, &[0.0]) > 0 && finds(seed, &[0.98, 0.0]) == 0);
    assert_eq!(hidden.count(), 0);
}

#[test]
fn some_mines_are_never_seen_by_one_kind_of_sensor() {
    let found = share(12, "s_mag", ObjectClass::MetalMine, 1.0, 2.0);
    assert!((found - 0.97).abs() < sure(0.97), "{found}");
}

#[test]
fn a_dwell_over_a_person_finds_as_often_as_the_looks_that_fit_into_it() {
    // A view of 44 degrees along the course from 80 m covers 64.6 m: all 20 m of the pass, ten looks of 2 s at 1 m/s.
    let object = Object::new(ObjectClass::Person, [0.0; 2]);
    let view = View {
        object: &object,
        offset_m: [0.0; 2],
        toward_m: [0.0; 2],
        height_m: 118.0,
        speed_m_s: 10.0,
        light: Light::Night,
        clarity: 1.0,
    };
    let look = sensor("s_th160")
        .detector()
        .and_then(|spec| spec.look(&view));
    let one = look.expect("it is in the picture").chance;
    let all = 1.0 - maths::powf(1.0 - one, 2.0 / 2.0);
    let found = share(1, "s_th160", ObjectClass::Person, 118.0, 10.0);
    assert!((found - all).abs() < sure(all), "{found}, not {all}");
}

#[test]
fn false_alarms_come_by_the_area_that_is_swept() {
    // The world has a distant mine; otherwise there would be no false alarms for mines.
    let world = world(
        vec![Object::new(ObjectClass::MetalMine, [900.0; 2])],
        Light::Day,
    );
    let (mut alarms, mut metres) = (0_u32, 0.0);
    let mut lookout = Lookout::new(5);
    let mut craft = craft(1, "s_mag", 1.0, 3.0);
    for tick in 1..=200_000 {
        let now = TICK * tick;
        let seen = lookout.step(&craft, &world, &[], now);
        alarms += seen
            .iter()
            .filter(|sighting| sighting.object.is_none())
            .count() as u32;
        metres += craft.speed_m_s * TICK.as_secs_f64();
    }
    let expected = 0.003 * 2.0 * metres;
    assert!(
        (f64::from(alarms) - expected).abs() < 4.0 * expected.sqrt(),
        "{alarms}, not {expected}"
    );
    craft.under_way = false;
    assert!(lookout.step(&craft, &world, &[], TICK * 200_001).is_empty());
}

#[test]
fn false_alarms_lie_where_they_are_for_any_way_to_sweep() {
    let world = world(
        vec![Object::new(ObjectClass::MetalMine, [900.0; 2])],
        Light::Day,
    );
    // Lines of 400 m to the north, 2 m apart, as wide as the strip.
    let sweep = |east_m: f64, speed_m_s: f64| {
        let mut lookout = Lookout::new(5);
        let mut found = Vec::new();
        for line in 0..20 {
            let ticks = (400.0 / (speed_m_s * TICK.as_secs_f64())) as u32;
            for tick in 0..ticks {
                let mut craft = craft(1, "s_mag", 1.0, speed_m_s);
                let north_m = f64::from(tick) * speed_m_s * TICK.as_secs_f64();
                craft.at = Some([f64::from(line) * 2.0 + 1.0 + east_m, north_m]);
                let seen = lookout.step(&craft, &world, &[], TICK * tick);
                found.extend(seen.iter().map(|sighting| sighting.at.map(f64::to_bits)));
            }
        }
        found
    };
    let (one, other) = (sweep(0.0, 2.0), sweep(0.1, 1.9));
    let common = one.iter().filter(|at| other.contains(at)).count();
    let share = common as f64 / one.len().max(other.len()) as f64;
    assert!(one.len() > 20 && share > 0.85, "{} {common}", one.len());
}

#[test]
fn what_one_vehicle_sees_does_not_depend_on_the_order_or_on_the_others() {
    let objects = (0..40)
        .map(|index| Object::new(ObjectClass::MetalMine, [0.0, f64::from(index) / 2.0 - 10.0]));
    let world = world(objects.collect(), Light::Day);
    let fly = |order: &[VehicleId]| {
        let mut lookout = Lookout::new(3);
        let mut seen: Vec<(VehicleId, Duration, Option<ObjectId>)> = Vec::new();
        for step in 0..100_u32 {
            for &id in order {
                let mut craft = craft(id, "s_mag", 1.0, 2.0);
                craft.at = Some([0.0, f64::from(step) * 0.2 - 10.0]);
                let found = lookout.step(&craft, &world, &[], TICK * step);
                seen.extend(
                    found
                        .iter()
                        .map(|sighting| (id, TICK * step, sighting.object)),
                );
            }
        }
        seen.sort_unstable();
        seen
    };
    let both = fly(&[1, 2]);
    assert_eq!(both, fly(&[2, 1]));
    let second: Vec<_> = both.into_iter().filter(|(id, ..)| *id == 2).collect();
    assert!(!second.is_empty());
    assert_eq!(second, fly(&[2]));
}

/// The share of 5 s looks from a height that identify a contact as not a person.
fn told_apart(height_m: f64) -> f64 {
    let world = world(Vec::new(), Light::Night);
    let contact = Contact {
        name: "c1".to_owned(),
        at: [0.0, -9.0],
        kind: FindKind::Person,
        sensors: ["s_th160"].into(),
        by: 2,
        first: Duration::ZERO,
        last: Duration::ZERO,
        looks: 1,
        reported: false,
        harmless: false,
        object: None,
    };
    let told = (0..SEEDS).filter(|&seed| {
        let mut lookout = Lookout::new(seed);
        let craft = craft(1, "s_th160", height_m, 0.0);
        let contacts = std::slice::from_ref(&contact);
        let mut ticks = (1..=50).map(|step| lookout.step(&craft, &world, contacts, TICK * step));
        ticks.any(|seen| seen.iter().any(|sighting| sighting.harmless))
    });
    told.count() as f64 / SEEDS as f64
}

#[test]
fn a_look_from_near_tells_a_false_alarm_and_one_from_afar_does_not() {
    let (near, far) = (told_apart(12.0), told_apart(60.0));
    assert!(near > 0.8 && far < 0.1, "{near} {far}");
}
