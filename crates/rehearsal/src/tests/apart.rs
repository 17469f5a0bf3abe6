//! Vehicles that come close to each other, and changes that keep them apart.

use sortie_plan::generate::{Course, Manner, Part, Task, generate};

use super::*;

fn search<'a>(
    participants: &'a [Participant],
    conditions: &'a Conditions,
) -> deconflict::Search<'a> {
    deconflict::Search {
        participants,
        conditions,
        late_s: LATE_S,
    }
}

#[test]
fn crossing_ways_are_a_conflict_that_later_starts_or_layers_end() {
    let both = crossing();
    let outcome = rehearse(&both, &calm()).expect("they can fly");
    let conflict = outcome.conflicts().next().expect("they meet");
    assert_eq!((conflict.a, conflict.b), (0, 1));
    assert!(conflict.at_s > 10.0, "{conflict:?}");
    let proposal = deconflict(&both, &calm(), 6.0)
        .expect("they can fly")
        .expect("there is a way");
    assert_eq!(proposal.outcome.conflicts().count(), 0);
    let changed = proposal
        .remedies
        .iter()
        .filter(|it| **it != Remedy::Nothing);
    assert_eq!(changed.count(), 1);
    assert!(
        proposal.lost_s > 0.0 && proposal.lost_s < 60.0,
        "{}",
        proposal.lost_s
    );
    let alone = deconflict::alone(&both, &calm()).expect("they can fly");
    let tracks: Vec<_> = alone.into_iter().map(|(_, track)| track).collect();
    let conditions = calm();
    let search = search(&both, &conditions);
    for (what, proposal) in [
        ("delays", search.by_delays(&tracks)),
        ("layers", search.by_layers(&outcome, 6.0)),
    ] {
        let proposal = proposal.expect("they can fly");
        assert!(proposal.is_some(), "{what}");
    }
}

/// Plans that the generator makes for a task and vehicles in a row.
fn generated(task: &Task, vehicles: usize, gap_m: f64) -> Vec<Participant> {
    let homes: Vec<Home> = (0..vehicles)
        .map(|index| {
            let (x, y) = HOME.moved(0.0, gap_m * index as f64).to_e7();
            Home { x, y, z: 170.0 }
        })
        .collect();
    let manner = Manner {
        height_m: 30.0,
        layer_m: 6.0,
        speed_m_s: None,
        fence: Vec::new(),
    };
    let plans = generate(task, &homes, &manner).expect("plans");
    let participant = |part: Part| Participant {
        document: part.document,
        airframe: None,
        charge_percent: None,
        delay_s: 0.0,
        parameters: Vec::new(),
        fence_switch: None,
    };
    plans.parts.into_iter().map(participant).collect()
}

#[test]
fn generated_plans_are_flown_apart_and_take_about_the_same_energy() {
    let at = |north_m, east_m| HOME.moved(north_m, east_m);
    let outline = vec![
        at(60.0, -80.0),
        at(330.0, -80.0),
        at(260.0, 10.0),
        at(330.0, 120.0),
        at(60.0, 120.0),
    ];
    let datum = at(150.0, 20.0);
    let tasks = [
        Task::Survey {
            rings: vec![outline],
            spacing_m: 20.0,
            course: Course::Best,
        },
        Task::Square {
            datum,
            spacing_m: 20.0,
            radius_m: 100.0,
        },
        Task::Sector {
            datum,
            radius_m: 80.0,
        },
        Task::Line {
            points: vec![at(60.0, 0.0), at(200.0, 60.0), at(340.0, 0.0)],
            spacing_m: 12.0,
        },
        Task::Orbit {
            centre: datum,
            radius_m: 40.0,
            turns: 2,
        },
    ];
    for task in tasks {
        let outcome = rehearse(&generated(&task, 4, 10.0), &calm()).expect("they can fly");
        let used = outcome.vehicles.iter().map(|flown| {
            assert_eq!(flown.ending, FlightEnding::Landed, "{task:?}");
            flown.energy_used_percent
        });
        let used: Vec<f64> = used.collect();
        assert_eq!(outcome.conflicts().next(), None, "{task:?}");
        if matches!(task, Task::Survey { .. } | Task::Square { .. }) {
            let most = used.iter().copied().fold(0.0, f64::max);
            let least = used.iter().copied().fold(f64::INFINITY, f64::min);
            assert!(most < 1.1 * least, "{task:?}: {used:?}");
        }
    }
}

/// Delays are written as items before the takeoff: the vehicles stay apart when the files are flown, too.
#[test]
fn delays_that_are_written_keep_the_vehicles_apart() {
    let waits = calm();
    let three = [
        vehicle((0.0, 0.0), &[(100.0, 100.0)]),
        vehicle((0.0, 100.0), &[(100.0, 0.0)]),
        vehicle((50.0, -20.0), &[(50.0, 130.0)]),
    ];
    let alone = deconflict::alone(&three, &waits).expect("they can fly");
    let tracks: Vec<_> = alone.into_iter().map(|(_, track)| track).collect();
    let found = search(&three, &waits)
        .by_delays(&tracks)
        .expect("they can fly");
    let proposal = found.expect("there is a way");
    let written: Vec<Participant> = three
        .iter()
        .zip(&proposal.remedies)
        .map(|(participant, remedy)| Participant {
            document: remedy.apply(&participant.document),
            ..participant.clone()
        })
        .collect();
    let is_changed = |(new, old): (&Participant, &Participant)| new.document != old.document;
    assert!(written.iter().zip(&three).any(is_changed));
    let flown = rehearse(&written, &waits).expect("they can fly");
    assert_eq!(
        flown.conflicts().next(),
        None,
        "{:?} {:?}",
        proposal.remedies,
        flown.vehicles
    );
    assert!(flown.is_apart(LATE_S), "{:?}", flown.closest);
    for (vehicle, remedy) in flown.vehicles.iter().zip(&proposal.remedies) {
        assert_eq!(vehicle.ending, FlightEnding::Landed);
        let waits = matches!(remedy, Remedy::Delay(_));
        assert_eq!(vehicle.was_kept_armed, waits, "{remedy:?}");
    }
    let together = rehearse(&three, &waits).expect("they can fly");
    assert!(together.conflicts().next().is_some());
}

/// Vehicles on pads 5 m apart are close to each other from the start; that is not a conflict, but flying over each
/// other is.
#[test]
fn neighbours_on_their_pads_are_no_conflict() {
    let at = |north_m, east_m| HOME.moved(north_m, east_m);
    let task = Task::Survey {
        rings: vec![vec![
            at(30.0, -60.0),
            at(150.0, -60.0),
            at(150.0, 60.0),
            at(30.0, 60.0),
        ]],
        spacing_m: 20.0,
        course: Course::Best,
    };
    let outcome = rehearse(&generated(&task, 4, 5.0), &calm()).expect("they can fly");
    assert_eq!(outcome.conflicts().next(), None, "{:?}", outcome.closest);
    let limits = outcome.closest.iter().map(|it| it.limit_m);
    let least = limits.fold(f64::INFINITY, f64::min);
    assert!((least - 3.75).abs() < 0.01, "{least}");
}

/// One vehicle hovers at the end of its plan, and another one flies into it: neither has landed.
#[test]
fn both_struck_vehicles_have_collided() {
    let mut hovers = vehicle((60.0, 0.0), &[]);
    hovers.document.plan.pop();
    let passes = vehicle((0.0, 0.0), &[(120.0, 0.0)]);
    for both in [[hovers.clone(), passes.clone()], [passes, hovers]] {
        let outcome = rehearse(&both, &calm()).expect("they can fly");
        let endings: Vec<FlightEnding> = outcome.vehicles.iter().map(|it| it.ending).collect();
        assert_eq!(endings, [FlightEnding::Crashed, FlightEnding::Crashed]);
    }
}

/// Two vehicles that cross the same place two seconds apart: no conflict, unless one of them is late.
#[test]
fn vehicles_that_pass_a_place_shortly_one_after_the_other_are_kept_apart() {
    let both = [
        vehicle((0.0, 0.0), &[(100.0, 100.0)]),
        vehicle((-9.0, 100.0), &[(91.0, 0.0)]),
    ];
    let outcome = rehearse(&both, &calm()).expect("they can fly");
    let approach = outcome.closest[0];
    assert!(!approach.is_conflict(), "{approach:?}");
    assert!(
        approach
            .late_s
            .is_some_and(|late_s| (1..=LATE_S).contains(&late_s)),
        "{approach:?}"
    );
    assert!(outcome.is_apart(0) && !outcome.is_apart(LATE_S));
    let proposal = deconflict(&both, &calm(), 6.0)
        .expect("they can fly")
        .expect("a way");
    assert_eq!(proposal.late_s, LATE_S);
    assert!(proposal.outcome.is_apart(LATE_S));
    let changed = proposal.remedies.iter().any(|it| *it != Remedy::Nothing);
    assert!(changed, "{:?}", proposal.remedies);
}

/// The narrowest lanes that the generator accepts are far enough apart, even in wind.
#[test]
fn the_narrowest_lanes_are_no_conflict() {
    let at = |north_m, east_m| HOME.moved(north_m, east_m);
    let task = Task::Line {
        points: vec![at(60.0, 0.0), at(200.0, 60.0), at(340.0, 0.0)],
        spacing_m: 6.0,
    };
    for wind_m_s in [0.0, 8.0] {
        let windy = Conditions {
            wind_m_s,
            wind_from_deg: 200.0,
            ..calm()
        };
        for gap_m in [5.0, 8.0, 12.0] {
            let outcome = rehearse(&generated(&task, 4, gap_m), &windy).expect("they can fly");
            assert_eq!(outcome.conflicts().next(), None, "{gap_m} {wind_m_s}");
        }
    }
}

/// Vehicles that start 5 m apart may be close to each other beside their pads, but not far away from them.
#[test]
fn neighbours_keep_the_full_distance_away_from_their_pads() {
    let beside_m = 4.3;
    let two = [
        vehicle((0.0, 0.0), &[(60.0, 0.0), (200.0, 0.0)]),
        vehicle((0.0, 5.0), &[(60.0, beside_m), (200.0, beside_m)]),
    ];
    let outcome = rehearse(&two, &calm()).expect("they can fly");
    let conflict = outcome.conflicts().next().expect("too close on their way");
    assert!((conflict.limit_m - TOO_NEAR_M).abs() < 1e-9, "{conflict:?}");
    assert!(
        (conflict.horizontal_m - beside_m).abs() < 0.5,
        "{conflict:?}"
    );
    let short = [
        vehicle((0.0, 0.0), &[(12.0, 0.0)]),
        vehicle((0.0, 5.0), &[(12.0, 5.0)]),
    ];
    let outcome = rehearse(&short, &calm()).expect("they can fly");
    assert_eq!(outcome.conflicts().next(), None, "{:?}", outcome.closest);
    let proposal = deconflict(&two, &calm(), 6.0).expect("they can fly");
    let proposal = proposal.expect("a way");
    assert_eq!(proposal.outcome.conflicts().next(), None);
}
