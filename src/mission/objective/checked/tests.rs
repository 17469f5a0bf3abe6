//! Looks that count, and how they are shared among reports.

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, Normal};

use super::*;
use crate::text::{Language, Locale};

fn plan(dwell_s: f64, crossings: u32) -> Checked {
    Checked {
        radius_m: 6.0,
        max_speed_m_s: 3.0,
        heights_m: None,
        dwell_s,
        crossings,
    }
}

/// A straight look of 6 s from one point to another.
fn look(from: Point, to: Point) -> Vec<Point> {
    let part = |step: u32| f64::from(step) / 59.0;
    let at = |step| [0, 1].map(|axis: usize| from[axis] + (to[axis] - from[axis]) * part(step));
    (0..60).map(at).collect()
}

#[test]
fn a_place_is_checked_by_a_long_look_however_often_interrupted() {
    let (one, two) = (look([1.0, 0.0], [2.0, 0.0]), look([0.0, 3.0], [0.0, 4.0]));
    assert!(plan(6.0, 0).is_shown_by(std::slice::from_ref(&one)));
    assert!(!plan(7.0, 0).is_shown_by(std::slice::from_ref(&one)));
    assert!(plan(12.0, 0).is_shown_by(&[one, two]));
    assert!(!plan(0.0, 0).is_shown_by(&[]));
}

/// A tracker after stops of 6 s at these places, with a radius of 10 m.
fn after_stops(at: &[Point]) -> CheckedTracker {
    let moments = at.iter().flat_map(|at| [*at; 60]);
    let moments = (1..).zip(moments).map(|(step, at)| SlowMoment {
        step,
        at,
        is_used: false,
    });
    CheckedTracker {
        plan: Checked {
            radius_m: 10.0,
            ..plan(4.0, 0)
        },
        steps: 0,
        slow: [(1, moments.collect())].into(),
        judged: Vec::new(),
    }
}

#[test]
fn a_stop_between_two_places_is_a_look_at_one_of_them() {
    let places = [[0.0, 7.0], [8.0, 7.0]];
    let served = |stops: &[Point]| {
        let served = after_stops(stops).allot(&places);
        served.into_iter().filter(|served| *served).count()
    };
    assert_eq!(served(&[[4.0, 0.0]]), 1);
    // Each stop is before its place, and the second is nearer to the first place.
    assert_eq!(served(&[[-4.9, 0.0], [3.1, 0.0]]), 2);
    let mut tracker = after_stops(&[[4.0, 0.0]]);
    assert_eq!(tracker.allot(&places[..1]), [true]);
    assert_eq!(tracker.allot(&places[1..]), [false], "reported later");
}

#[test]
fn lanes_of_a_survey_cross_a_place_in_one_direction_only() {
    let north = look([1.0, -5.9], [1.0, 5.9]);
    let south = look([-3.0, 5.2], [-3.0, -5.2]);
    let east = look([-5.5, 2.0], [5.5, 2.0]);
    let edge = look([-3.5, 5.0], [3.5, 5.0]);
    assert!(!plan(0.0, 2).is_shown_by(&[north.clone(), south.clone()]));
    assert!(!plan(0.0, 2).is_shown_by(&[north.clone(), edge]));
    assert!(plan(0.0, 2).is_shown_by(&[south, north, east.clone()]));
    assert!(plan(0.0, 1).is_shown_by(&[east]));
}

#[test]
fn a_look_that_turns_on_the_way_crosses_by_its_straight_parts() {
    let legs = [
        look([0.0, 0.0], [0.0, 5.0]),
        look([0.0, 5.0], [0.0, -5.0]),
        look([0.0, -5.0], [0.0, 0.0]),
        look([0.0, 0.0], [5.5, 0.0]),
        look([5.5, 0.0], [-5.5, 0.0]),
    ];
    assert!(plan(0.0, 2).is_shown_by(&[legs.concat()]));
    assert!(!plan(0.0, 2).is_shown_by(&[legs[..4].concat()]));
}

/// An orbit never leads across its centre, however wide it is.
#[test]
fn rings_around_a_place_do_not_cross_it() {
    for radius_m in [2.0, 6.0, 8.0, 30.0] {
        let plan = Checked {
            radius_m,
            ..plan(0.0, 1)
        };
        for share in [0.5, 0.7, 0.83, 0.9, 0.98] {
            let ring = |step: u32| {
                let angle = f64::from(step) / 30.0;
                [maths::sin(angle), maths::cos(angle)].map(|part| share * radius_m * part)
            };
            let laps = (0..400).map(ring).collect();
            assert!(!plan.is_shown_by(&[laps]), "{share} of {radius_m} m");
        }
    }
}

/// A slow flight with noise in its positions is long, but straight.
#[test]
fn slow_crossings_with_noisy_positions_count() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let noise = Normal::new(0.0, 0.1).expect("a finite deviation");
    // 11 m at 1 m/s, one position a step.
    let mut crossing = |way: fn(f64) -> Point| -> Vec<Point> {
        let along = (0..110).map(|step| way(f64::from(step) * 0.1 - 5.5));
        let noisy = |at: Point| at.map(|axis| axis + noise.sample(&mut random));
        along.map(noisy).collect()
    };
    let (north, east) = (
        crossing(|along| [1.0, along]),
        crossing(|along| [along, -1.0]),
    );
    assert!(plan(0.0, 1).is_shown_by(std::slice::from_ref(&north)));
    assert!(!plan(0.0, 2).is_shown_by(std::slice::from_ref(&north)));
    assert!(plan(0.0, 2).is_shown_by(&[north, east]));
}

/// The advice names every condition, and rounds none away.
#[test]
fn the_advice_names_every_condition_of_a_look() {
    let small = Checked {
        radius_m: 0.5,
        heights_m: Some([5.0, 17.5]),
        ..plan(4.0, 2)
    };
    let advice = small.advice();
    assert_eq!(
        advice.to_string(),
        "Before you report a place, stay within 0.5 m of it for 4 s, at 3 m/s at most. \
         Before you report a place, fly straight across it from 2 sides, within 0.5 m of it, at 3 m/s at most. \
         Only heights of 5 to 17.5 m count."
    );
    let ukrainian = Locale::new(Language::Ukrainian);
    let ukrainian = ukrainian.text(&advice);
    for condition in ["4 s", "0.5 m", "з 2 боків", "3 m/s", "від 5 до 17.5 m"] {
        assert!(ukrainian.contains(condition), "{ukrainian}");
    }
    let stop = plan(4.0, 0).advice().to_string();
    assert!(
        !stop.contains("across") && !stop.contains("heights"),
        "{stop}"
    );
    let cross = plan(0.0, 1).advice().to_string();
    assert!(
        !cross.contains("stay") && !cross.contains("heights"),
        "{cross}"
    );
}
