//! `SMART_RTL`: retracing the flown path.

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::*;
use sortie_geo::maths;

const SMART_RTL: f32 = 21.0;
const RTL: f32 = 6.0;

/// Seconds after the command, and the position of a real vehicle at that time.
const WAY_BACK: [(f64, [f64; 3]); 8] = [
    (4.1, [60.0, 48.1, -10.0]),
    (8.1, [60.3, 26.7, -10.0]),
    (12.1, [59.9, 1.3, -10.0]),
    (16.1, [37.0, -0.3, -10.0]),
    (20.1, [6.1, -0.1, -10.0]),
    (24.1, [0.0, 0.0, -9.3]),
    (28.1, [-0.1, 0.0, -4.0]),
    (32.1, [0.0, 0.0, -1.6]),
];

fn enter(ground: &mut Ground, mode: f32) -> MavResult {
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, mode])
}

/// Flies around a corner: north, then east.
fn around_the_corner() -> Ground {
    let mut ground = Ground::hovering(10.0);
    for goal in [[60.0, 0.0, -10.0], [60.0, 50.0, -10.0]] {
        ground.goto(goal);
        ground.run(25.0);
    }
    ground
}

#[test]
fn it_goes_back_around_the_corner_as_the_real_one_did_and_lands_where_it_was_armed() {
    let mut ground = around_the_corner();
    assert_eq!(
        enter(&mut ground, SMART_RTL),
        MavResult::MAV_RESULT_ACCEPTED
    );
    let mut off_m: f64 = 0.0;
    let mut elapsed_s = 0.0;
    for (at_s, place_m) in WAY_BACK {
        while elapsed_s < at_s {
            ground.step();
            elapsed_s += STEP.as_secs_f64();
            let [north, east, _] = ground.truth().position_ned_m;
            off_m = off_m.max((60.0 - north).abs().min(east.abs()));
        }
        let here_m = ground.truth().position_ned_m;
        let apart_m = glam::DVec3::from(here_m).distance(glam::DVec3::from(place_m));
        assert!(
            apart_m < 2.5,
            "{here_m:?} after {at_s} s, measured {place_m:?}"
        );
    }
    assert!(off_m < 2.0, "{off_m} m off the way it came");
    let disarmed_s = elapsed_s + ground.until(20.0, |truth| !truth.armed);
    assert!((disarmed_s - 37.3).abs() < 1.5, "{disarmed_s}");
    assert_eq!(ground.truth().mode, 21);
}

#[test]
fn an_interrupted_return_goes_on_from_where_it_is() {
    let mut ground = around_the_corner();
    enter(&mut ground, SMART_RTL);
    ground.until(60.0, |truth| truth.position_ned_m[0] < 40.0);
    enter(&mut ground, super::ground::GUIDED);
    ground.goto([30.0, -30.0, -10.0]);
    ground.run(15.0);
    enter(&mut ground, SMART_RTL);
    ground.until(120.0, |truth| !truth.armed);
    let [north, east, _] = ground.truth().position_ned_m;
    assert!(maths::hypot(north, east) < 1.5, "{north} {east}");
}

#[test]
fn without_a_way_back_it_is_refused_and_with_a_final_height_it_stays_there() {
    let mut ground = Ground::new();
    ground.run(0.05);
    assert_eq!(enter(&mut ground, SMART_RTL), MavResult::MAV_RESULT_FAILED);
    assert!(
        ground
            .texts()
            .contains(&"Mode change to SMARTRTL failed: init failed".to_owned())
    );
    ground.set("SRTL_POINTS", 0.0);
    let mut ground = ground.hover(6.0);
    assert_eq!(enter(&mut ground, SMART_RTL), MavResult::MAV_RESULT_FAILED);
    assert_eq!(enter(&mut ground, RTL), MavResult::MAV_RESULT_ACCEPTED);

    let mut ground = Ground::hovering(10.0);
    ground.set("RTL_ALT_FINAL", 400.0);
    enter(&mut ground, SMART_RTL);
    ground.run(40.0);
    let height_m = -ground.truth().position_ned_m[2];
    assert!((height_m - 4.0).abs() < 0.3, "{height_m}");
    assert!(ground.truth().armed);
}
