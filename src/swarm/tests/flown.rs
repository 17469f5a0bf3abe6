//! What is flown is what was asked for.

use super::*;

/// Bits of luck aside: GPS, wind and control leave so much.
const NOISE_M: f64 = 0.6;

#[test]
fn four_share_a_survey_and_cover_every_point_of_it() {
    let mut stage = Stage::flying(4, 10.0);
    stage.say("all survey lane spacing 12 up 25");
    let mut trails: Vec<[f64; 3]> = Vec::new();
    let done = stage.watch(400.0, |stage| {
        trails.extend((1..=4).map(|id| stage.place(id)));
        stage.is_done("survey")
    });
    println!(
        "{:?} after {:?}, nearest {:.2} m",
        stage.rows("survey"),
        stage.now(),
        stage.nearest_m
    );
    assert!(done);
    let working: Vec<&[f64; 3]> = trails
        .iter()
        .filter(|at| (at[2] - 25.0).abs() < 2.0)
        .collect();
    for north in (22..=138).step_by(4) {
        for east in (2..=58).step_by(4) {
            let (north, east) = (f64::from(north), f64::from(east));
            let distance = |at: &&[f64; 3]| (at[0] - north).hypot(at[1] - east);
            let nearest = working.iter().map(distance).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 6.0 + NOISE_M, "{north} {east}: {nearest}");
        }
    }
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
}

#[test]
fn a_wedge_keeps_its_shape_while_its_leader_goes_somewhere() {
    let mut stage = Stage::flying(5, 8.0);
    stage.say("all formation wedge spacing 10");
    assert!(
        stage.watch(90.0, |stage| stage.is_done("formation")),
        "{:?}",
        stage.rows("formation")
    );
    stage.run(3.0);
    stage.say("1 goto n 150 e 0 up 30");
    let mut worst: f64 = 0.0;
    let arrived = stage.watch(120.0, |stage| {
        for (a, b) in [(1, 2), (1, 3), (1, 4), (1, 5)] {
            let (a, b) = (stage.place(a), stage.place(b));
            worst = worst.max((a[2] - b[2]).abs());
        }
        stage.is_done("goto")
    });
    println!(
        "after {:?}, nearest {:.2} m, heights differ by {worst:.2} m",
        stage.now(),
        stage.nearest_m
    );
    assert!(arrived, "{:?}", stage.rows("goto"));
    let leader = stage.place(1);
    assert!(
        (leader[0] - 150.0).abs() < 1.5 && (leader[2] - 30.0).abs() < 1.0,
        "{leader:?}"
    );
    assert!(stage.nearest_m >= 6.0, "{}", stage.nearest_m);
    assert!(worst < 1.5, "{worst}");
}
