//! Distances that break a rule, and those that do not.

use std::time::Duration;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::mission::event::mover::Spawn;

fn kind(breach: Option<Breach>) -> Option<SafetyKind> {
    breach.map(|(kind, _)| kind)
}

#[test]
fn vehicles_are_too_close_below_the_separation_and_collide_below_half_a_metre() {
    for (distance_m, expected) in [
        (0.0, Some(SafetyKind::Collision)),
        (0.49, Some(SafetyKind::Collision)),
        (0.51, Some(SafetyKind::Separation)),
        (3.99, Some(SafetyKind::Separation)),
        (4.0, None),
        (50.0, None),
    ] {
        assert_eq!(
            kind(too_close(distance_m, 2, 4.0)),
            expected,
            "{distance_m}"
        );
    }
}

#[test]
fn those_who_pass_each_other_between_two_looks_are_seen_to_meet() {
    let airspace = |before: [Place; 2]| Airspace {
        before: BTreeMap::from([(1, before[0]), (2, before[1])]),
    };
    let closest_m = |before: [Place; 2], now: [Place; 2]| airspace(before).closest_m([1, 2], now);
    // Head on, each 2 m per step; one above the other; apart; and standing still.
    for (before, now, expected) in [
        (
            [[-2.0, 0.0, 20.0], [2.0, 0.0, 20.0]],
            [[2.0, 0.0, 20.0], [-2.0, 0.0, 20.0]],
            0.0,
        ),
        (
            [[-2.0, 0.0, 20.0], [2.0, 0.0, 23.0]],
            [[2.0, 0.0, 20.0], [-2.0, 0.0, 23.0]],
            3.0,
        ),
        (
            [[-2.0, 0.0, 20.0], [2.0, 0.0, 20.0]],
            [[-9.0, 0.0, 20.0], [9.0, 0.0, 20.0]],
            4.0,
        ),
        (
            [[0.0, 0.0, 20.0], [5.0, 0.0, 20.0]],
            [[0.0, 0.0, 20.0], [5.0, 0.0, 20.0]],
            5.0,
        ),
    ] {
        let found = closest_m(before, now);
        assert!((found - expected).abs() < 1e-9, "{before:?}: {found}");
    }
    let unknown = Airspace::default().closest_m([1, 2], [[0.0; 3], [0.0, 3.0, 4.0]]);
    assert!(
        (unknown - 5.0).abs() < 1e-9,
        "without a look before: {unknown}"
    );
}

#[test]
fn who_comes_by_is_disturbed_then_hit() {
    let mover = |kind, height_m| {
        let spawn = Spawn {
            id: "it".to_owned(),
            callsign: String::new(),
            kind,
            path: vec![[0.0, 0.0], [100.0, 0.0]],
            speed_m_s: 1.0,
            height_m,
            keep_out_m: 30.0,
            jitter_m: 0.0,
        };
        Mover::new(&spawn, Duration::ZERO, &mut ChaCha8Rng::seed_from_u64(1))
    };
    for (who, height_m, place, expected) in [
        (MoverKind::Aircraft, 60.0, [0.0, 31.0, 60.0], None),
        (
            MoverKind::Aircraft,
            60.0,
            [0.0, 29.0, 60.0],
            Some(SafetyKind::Bubble),
        ),
        (
            MoverKind::Aircraft,
            60.0,
            [0.0, 0.0, 31.0],
            Some(SafetyKind::Bubble),
        ),
        (MoverKind::Aircraft, 60.0, [0.0, 0.0, 29.0], None),
        (
            MoverKind::Aircraft,
            60.0,
            [0.0, 4.0, 60.0],
            Some(SafetyKind::AircraftHit),
        ),
        (
            MoverKind::Intruder,
            40.0,
            [0.0, 5.0, 40.0],
            Some(SafetyKind::Separation),
        ),
        (
            MoverKind::Intruder,
            40.0,
            [0.0, 0.4, 40.0],
            Some(SafetyKind::Collision),
        ),
        (
            MoverKind::Person,
            0.0,
            [0.0, 5.0, 20.0],
            Some(SafetyKind::People),
        ),
        (MoverKind::Person, 0.0, [0.0, 5.0, 31.0], None),
        (
            MoverKind::Person,
            0.0,
            [0.0, 0.5, 1.0],
            Some(SafetyKind::Injury),
        ),
    ] {
        let found = kind(near(&mover(who, height_m), place));
        assert_eq!(found, expected, "{who:?} at {height_m} m, {place:?}");
    }
}
