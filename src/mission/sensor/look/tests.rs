use proptest::prelude::*;

use super::*;
use crate::geo::maths;
use crate::mission::sensor::Sensor;

fn spec(id: &str) -> &'static DetectorSpec {
    let sensor = Sensor::by_id(id).expect("it is in the catalogue");
    sensor.detector().expect("it finds things")
}

fn camera(id: &str) -> &'static Camera {
    match spec(id) {
        DetectorSpec::Camera(camera) => camera,
        DetectorSpec::Ground(_) => panic!("{id} is no camera"),
    }
}

fn above(object: &Object, height_m: f64, speed_m_s: f64, light: Light) -> View<'_> {
    View {
        object,
        offset_m: [0.0; 2],
        toward_m: [0.0; 2],
        height_m,
        speed_m_s,
        light,
        clarity: 1.0,
    }
}

fn chance(id: &str, class: ObjectClass, height_m: f64, speed_m_s: f64, light: Light) -> f64 {
    let object = Object::new(class, [0.0; 2]);
    let look = spec(id).look(&above(&object, height_m, speed_m_s, light));
    look.map_or(0.0, |look| look.chance)
}

/// The probability that the thermal camera of the night search distinguishes a deer from a person; `None` if it does
/// not see the deer.
fn told(height_m: f64, aside_m: f64) -> Option<f64> {
    let object = Object::new(ObjectClass::Animal, [0.0; 2]);
    let view = View {
        offset_m: [aside_m, 0.0],
        ..above(&object, height_m, 0.0, Light::Night)
    };
    spec("s_th160").look(&view).map(|look| look.told_apart)
}

#[test]
fn only_a_look_from_near_and_above_tells_a_deer_from_a_person() {
    for height_m in [12.0, 30.0, 50.0] {
        assert_eq!(told(height_m, 30.0), None, "out of the picture");
    }
    assert!(told(12.0, 0.0).is_some_and(|chance| chance > 0.6));
    assert!(told(30.0, 0.0).is_some_and(|chance| chance < 0.25));
    assert!(told(60.0, 30.0).is_some_and(|chance| chance < 0.05));
}

#[test]
fn pictures_detect_persons_as_the_table_of_the_design_says() {
    // Each row: the height, then P_inf and the swath of s_th160, s_th320 and s_thdual.
    let table = [
        (20.0, [(1.00, 22.0), (1.00, 12.0), (1.00, 12.0)]),
        (40.0, [(0.92, 43.0), (1.00, 24.0), (1.00, 24.0)]),
        (60.0, [(0.67, 65.0), (1.00, 37.0), (1.00, 36.0)]),
        (80.0, [(0.43, 87.0), (1.00, 49.0), (1.00, 47.0)]),
        (100.0, [(0.27, 109.0), (0.99, 61.0), (1.00, 59.0)]),
        (120.0, [(0.18, 130.0), (0.96, 73.0), (1.00, 71.0)]),
    ];
    for (height_m, row) in table {
        for (id, (detected, swath_m)) in ["s_th160", "s_th320", "s_thdual"].iter().zip(row) {
            let cycles = 0.75 / (2.0 * camera(id).pixel_m(height_m));
            let found = task_performance(cycles / DETECT_CYCLES);
            assert!(
                (found - detected).abs() < 0.0075,
                "{id} {height_m} m: {found}"
            );
            let looked = chance(id, ObjectClass::Person, height_m, 5.0, Light::Night);
            assert!(
                (looked - found * NOTICED).abs() < 1e-12,
                "{id} {height_m} m"
            );
            let swath = spec(id).swath_m(height_m);
            assert!((swath - swath_m).abs() < 0.6, "{id} {height_m} m: {swath}");
        }
    }
}

#[test]
fn one_pass_over_a_mine_has_the_probabilities_of_the_design() {
    use ObjectClass::{MetalMine, MinimumMetalMine, SurfaceMine};
    // Far below the limits of height and speed: at a standstill only 1 / (1 + e^-6.67) of the best is missing.
    let still = 1.0 / (1.0 + maths::exp(-1.0_f64 / 0.15));
    for (id, best) in [
        ("s_mag", [0.85, 0.10, 0.80]),
        ("s_md", [0.95, 0.75, 0.95]),
        ("s_gpr", [0.90, 0.85, 0.60]),
    ] {
        for (class, best) in [MetalMine, MinimumMetalMine, SurfaceMine]
            .into_iter()
            .zip(best)
        {
            let found = chance(id, class, 0.2, 0.0, Light::Day);
            assert!((found - best * still).abs() < 1e-12, "{id} {class:?}");
        }
    }
    // Half at the limit of speed; 1/e of that at one scale above the limit of height.
    let half = chance("s_mag", MetalMine, 1.5, 4.0, Light::Day);
    assert!((half - 0.425).abs() < 1e-12);
    let high = chance("s_mag", MetalMine, 2.5, 4.0, Light::Day);
    assert!((high - half / std::f64::consts::E).abs() < 1e-12);
}

#[test]
fn open_mines_show_to_fine_pictures_and_dug_ground_at_dawn() {
    for id in ["s_rgb", "s_rgbg"] {
        let finest = camera(id)
            .mines
            .as_ref()
            .map_or(0.0, |mines| mines.height_m);
        assert!((camera(id).pixel_m(finest) - 0.005).abs() < 0.0001, "{id}");
        assert!(chance(id, ObjectClass::SurfaceMine, 10.0, 1.0, Light::Day) > 0.65);
        assert!(chance(id, ObjectClass::MetalMine, 10.0, 1.0, Light::Day) < 1e-12);
    }
    assert!(chance("s_th320", ObjectClass::MetalMine, 10.0, 1.0, Light::Dawn) > 0.24);
    assert!(chance("s_th320", ObjectClass::MetalMine, 10.0, 1.0, Light::Day) < 1e-12);
}

#[test]
fn the_strip_thins_out_at_its_edges_and_ends_there() {
    for (across_m, share) in [(0.0, 1.0), (0.8, 1.0), (0.9, 0.5), (1.0, 0.0), (1.5, 0.0)] {
        let object = Object::new(ObjectClass::MetalMine, [0.0; 2]);
        let view = View {
            offset_m: [across_m, 0.0],
            ..above(&object, 1.0, 1.0, Light::Day)
        };
        let found = spec("s_mag").look(&view).map_or(0.0, |look| look.chance);
        let middle = chance("s_mag", ObjectClass::MetalMine, 1.0, 1.0, Light::Day);
        assert!((found - middle * share).abs() < 1e-9, "{across_m} m");
    }
}

#[test]
fn light_cover_and_smoke_thin_what_a_camera_finds() {
    let night = chance("s_th160", ObjectClass::Person, 30.0, 5.0, Light::Night);
    let day = chance("s_th160", ObjectClass::Person, 30.0, 5.0, Light::Day);
    assert!((day / night - 0.4).abs() < 1e-9);
    let mut object = Object::new(ObjectClass::Person, [0.0; 2]);
    object.cover = 0.6;
    let covered = spec("s_th160").look(&above(&object, 30.0, 5.0, Light::Night));
    assert!((covered.map_or(0.0, |look| look.chance) / night - 0.4).abs() < 1e-9);
    // Smoke that leaves e^-0.522 of the light leaves e^-0.0522 of far infrared.
    object.cover = 0.0;
    let smoky = View {
        clarity: maths::exp(-0.522_f64),
        ..above(&object, 30.0, 5.0, Light::Day)
    };
    let seen = |id: &str| spec(id).look(&smoky).map_or(0.0, |look| look.chance);
    let clear = |id: &str| chance(id, ObjectClass::Person, 30.0, 5.0, Light::Day);
    assert!((seen("s_rgb") / clear("s_rgb") - maths::exp(-0.522_f64)).abs() < 1e-9);
    assert!((seen("s_th160") / clear("s_th160") - maths::exp(-0.0522_f64)).abs() < 1e-9);
}

/// The probability of noticing a defect on a line that runs north, from `square_m` to the side,
/// offset along the line and in height.
fn inspection(id: &str, square_m: f64, along_m: f64, below_m: f64) -> f64 {
    let object = Object {
        height_m: 20.0,
        axis_deg: Some(0.0),
        ..Object::new(ObjectClass::Defect, [0.0; 2])
    };
    let view = View {
        toward_m: [square_m, along_m],
        ..above(&object, 20.0 - below_m, 1.0, Light::Day)
    };
    spec(id).look(&view).map_or(0.0, |look| look.chance)
}

#[test]
fn defects_want_a_gimbal_a_near_place_and_a_square_view() {
    assert!((inspection("s_rgbg", 12.0, 0.0, 0.0) - 0.9 * NOTICED).abs() < 0.01);
    assert!(inspection("s_rgbg", 24.0, 0.0, 0.0) < 0.5);
    assert!(inspection("s_zoom", 24.0, 0.0, 0.0) > 0.89);
    assert!(
        inspection("s_rgb", 8.0, 0.0, 0.0) < 1e-12,
        "it looks down only"
    );
    // 34 and 36 degrees off the normal, along the line and from below.
    let off = |angle: f64| 10.0 * maths::tan(angle.to_radians());
    for (seen, angle) in [(true, 34.0), (false, 36.0)] {
        assert_eq!(inspection("s_rgbg", 10.0, off(angle), 0.0) > 0.0, seen);
        assert_eq!(inspection("s_rgbg", 10.0, 0.0, off(angle)) > 0.0, seen);
    }
}

proptest! {
    #[test]
    fn lower_and_slower_never_find_less(
        sensor in prop::sample::select(vec!["s_mag", "s_md", "s_gpr", "s_rgb", "s_th160", "s_th320"]),
        class in prop::sample::select(vec![ObjectClass::MetalMine, ObjectClass::SurfaceMine, ObjectClass::Person]),
        heights in (0.1..120.0_f64, 0.1..120.0_f64),
        speeds in (0.0..12.0_f64, 0.0..12.0_f64),
    ) {
        let (low, high) = (heights.0.min(heights.1), heights.0.max(heights.1));
        let (slow, fast) = (speeds.0.min(speeds.1), speeds.0.max(speeds.1));
        let careful = chance(sensor, class, low, slow, Light::Dawn);
        let hasty = chance(sensor, class, high, fast, Light::Dawn);
        // The same chance may be rounded in two ways.
        prop_assert!(careful >= hasty - 1e-12, "{} {:?}: {} < {}", sensor, class, careful, hasty);
    }
}
