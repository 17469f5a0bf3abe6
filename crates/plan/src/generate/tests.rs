use proptest::prelude::*;

use super::layers::{ASIDE_M, gap_m};
use super::share::WORTH;
use super::*;
use crate::check::{CheckOptions, FindingKind, Severity, check};
use crate::command;
use crate::pattern::{course, distance_to_segment, is_in_rings};

const CENTRE: LatLon = LatLon::new(50.45, 30.52);
const HEIGHT_M: f64 = 30.0;
const LAYER_M: f64 = 6.0;

fn place(point: DVec2) -> LatLon {
    CENTRE.moved(point.x, point.y)
}

fn home(point: DVec2) -> Home {
    let (x, y) = place(point).to_e7();
    Home { x, y, z: 170.0 }
}

/// Vehicles in a row, 10 m apart.
fn team(count: usize, first: DVec2) -> Vec<Home> {
    let at = |index: usize| home(first + DVec2::Y * 10.0 * index as f64);
    (0..count).map(at).collect()
}

fn manner() -> Manner {
    Manner {
        height_m: HEIGHT_M,
        layer_m: LAYER_M,
        speed_m_s: None,
        fence: Vec::new(),
    }
}

fn places(points: &[DVec2]) -> Vec<LatLon> {
    points.iter().copied().map(place).collect()
}

fn survey(rings: &[Vec<DVec2>], spacing_m: f64) -> Task {
    Task::Survey {
        rings: rings.iter().map(|ring| places(ring)).collect(),
        spacing_m,
        course: Course::Best,
    }
}

fn fence(corners: &[DVec2], command: u16) -> Vec<Item> {
    let item = |corner: &DVec2| {
        let (x, y) = place(*corner).to_e7();
        Item {
            command,
            params: [corners.len() as f32, 0.0, 0.0, 0.0],
            x,
            y,
            ..Item::default()
        }
    };
    corners.iter().map(item).collect()
}

fn square(centre: DVec2, side_m: f64) -> Vec<DVec2> {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    corners
        .map(|(north, east)| centre + DVec2::new(north, east) * side_m)
        .to_vec()
}

fn flown(part: &Part) -> Vec<(DVec2, f64)> {
    let items = part.document.plan.iter().filter(|item| item.is_waypoint());
    items
        .map(|item| (flat(CENTRE, item.point()), f64::from(item.z)))
        .collect()
}

fn is_at(height_m: f64, wanted_m: f64) -> bool {
    (height_m - wanted_m).abs() < 0.01
}

fn legs_at(part: &Part, height_m: f64) -> Vec<[DVec2; 2]> {
    let level = |pair: &[(DVec2, f64)]| {
        let is_level = pair.iter().all(|(_, height)| is_at(*height, height_m));
        is_level.then_some([pair[0].0, pair[1].0])
    };
    flown(part).windows(2).filter_map(level).collect()
}

fn faults(part: &Part) -> Vec<FindingKind> {
    let found = check(&part.document, &CheckOptions::default()).into_iter();
    found
        .filter(|finding| finding.severity() == Severity::Error)
        .map(|finding| finding.kind)
        .collect()
}

/// Stars of any depth: most of them are concave.
fn star() -> impl Strategy<Value = Vec<DVec2>> {
    proptest::collection::vec(60.0..220.0f64, 3..9).prop_map(|radii| {
        let count = radii.len() as f64;
        let corner = |(index, radius): (usize, f64)| course(index as f64 / count * 360.0) * radius;
        radii.into_iter().enumerate().map(corner).collect()
    })
}

fn samples() -> impl Strategy<Value = Vec<DVec2>> {
    let point = (-220.0..220.0f64, -220.0..220.0f64);
    proptest::collection::vec(point.prop_map(DVec2::from), 80)
}

/// The greatest distance between a point of an area and the leg nearest to it, at the height of the
/// work.
fn worst_gap_m(generated: &Generated, rings: &[Vec<DVec2>], points: &[DVec2]) -> f64 {
    let legs: Vec<[DVec2; 2]> = generated
        .parts
        .iter()
        .flat_map(|part| legs_at(part, HEIGHT_M))
        .collect();
    let gap = |point: &DVec2| {
        let distances = legs
            .iter()
            .map(|[from, to]| distance_to_segment(*point, *from, *to));
        distances.fold(f64::INFINITY, f64::min)
    };
    let inside = points.iter().filter(|point| is_in_rings(**point, rings));
    inside.map(gap).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn all_of_an_area_with_a_hole_is_covered(
        outline in star(),
        hole in proptest::option::of(10.0..40.0f64),
        spacing in 8.0..40.0f64,
        count in 1usize..6,
        points in samples(),
    ) {
        let mut rings = vec![outline];
        rings.extend(hole.map(|side| square(DVec2::ZERO, side)));
        let team = team(count, DVec2::new(-260.0, 0.0));
        let generated = generate(&survey(&rings, spacing), &team, &manner()).expect("plans");
        let worst = worst_gap_m(&generated, &rings, &points);
        prop_assert!(worst <= spacing / 2.0 + 0.1, "{worst} {spacing}");
        for part in &generated.parts {
            prop_assert_eq!(faults(part), vec![]);
        }
    }

    #[test]
    fn nothing_is_planned_outside_the_fence(
        outline in star(),
        spacing in 8.0..40.0f64,
        count in 1usize..4,
        side in 15.0..50.0f64,
        is_same in any::<bool>(),
    ) {
        // The fence is the area itself or a larger one, with an exclusion area in it.
        let around = if is_same { outline.clone() } else { square(DVec2::ZERO, 600.0) };
        let mut items = fence(&around, command::FENCE_POLYGON_INCLUSION);
        let closed = square(DVec2::new(0.0, 35.0), side);
        items.extend(fence(&closed, command::FENCE_POLYGON_EXCLUSION));
        let manner = Manner { fence: items, ..manner() };
        let homes: Vec<Home> = (0..count).map(|_| home(DVec2::new(-25.0, -8.0))).collect();
        match generate(&survey(&[outline], spacing), &homes, &manner) {
            Ok(generated) => {
                for part in &generated.parts {
                    prop_assert_eq!(faults(part), vec![]);
                }
                prop_assert!((0.0..0.9).contains(&generated.uncovered));
            }
            // All of a thin star can lie within the fence's margin.
            Err(error) => prop_assert!(matches!(error, GenerateError::OutsideFence | GenerateError::NoWay(_))),
        }
    }

    #[test]
    fn energy_is_shared_evenly(
        outline in star(),
        spacing in 10.0..30.0f64,
        count in 2usize..8,
    ) {
        let team = team(count, DVec2::new(-230.0, -40.0));
        let outline: Vec<DVec2> = outline.into_iter().map(|corner| corner * 2.5).collect();
        let generated = generate(&survey(&[outline], spacing), &team, &manner()).expect("plans");
        // In a small area, a vehicle can spend most of its energy on the way; it is left out.
        prop_assert_eq!(generated.parts.len() + generated.idle.len(), count);
        prop_assert!(generated.idle.iter().all(|(_, why)| *why == Idle::Spare));
        let efforts = || generated.parts.iter().map(|part| part.effort.hover_s);
        let mean = efforts().sum::<f64>() / generated.parts.len() as f64;
        let most = efforts().fold(0.0, f64::max);
        // The tolerance is a tenth, or one leg: between two cells of a concave area there is no
        // work to cut, and the heights at which vehicles cross depend on where the cuts are.
        let legs = generated.parts.iter().flat_map(|part| legs_at(part, HEIGHT_M));
        let longest_m = legs.map(|[from, to]| from.distance(to)).fold(0.0, f64::max);
        let leg_s = Pace::default().path(&[DVec2::ZERO, DVec2::X * longest_m]).hover_s;
        prop_assert!(most <= (mean * 1.1).max(mean + leg_s), "{most} {mean} {leg_s}");
    }

    #[test]
    fn vehicles_whose_ways_meet_cross_at_different_heights(
        outline in star(),
        count in 2usize..8,
        homes in proptest::collection::vec((-260.0..260.0f64, -260.0..260.0f64), 8),
    ) {
        let homes: Vec<Home> = homes.into_iter().take(count).map(|it| home(it.into())).collect();
        let generated = generate(&survey(&[outline], 25.0), &homes, &manner()).expect("plans");
        for (index, one) in generated.parts.iter().enumerate() {
            prop_assert!(generated.parts.len() == 1 || one.layer_m >= HEIGHT_M + LAYER_M - 1e-9);
            for other in &generated.parts[..index] {
                let (mine, theirs) = (legs_at(one, one.layer_m), legs_at(other, other.layer_m));
                let nearest = mine
                    .iter()
                    .flat_map(|mine| theirs.iter().map(|theirs| gap_m(*mine, *theirs)))
                    .fold(f64::INFINITY, f64::min);
                let apart = (one.layer_m - other.layer_m).abs();
                prop_assert!(nearest >= ASIDE_M - 0.1 || apart >= LAYER_M - 1e-9);
            }
        }
    }
}

#[test]
fn a_rectangle_is_flown_in_equal_parts() {
    // 400 m by 200 m at 20 m: ten lanes of 400 m for four vehicles.
    let area = [
        DVec2::ZERO,
        DVec2::new(400.0, 0.0),
        DVec2::new(400.0, 200.0),
        DVec2::new(0.0, 200.0),
    ];
    let team = team(4, DVec2::new(-50.0, 85.0));
    let generated = generate(&survey(&[area.to_vec()], 20.0), &team, &manner()).expect("plans");
    assert_eq!(generated.parts.len(), 4);
    assert!(generated.imbalance() < 1.05, "{}", generated.imbalance());
    for (index, part) in generated.parts.iter().enumerate() {
        let commands: Vec<u16> = part.document.plan.iter().map(|item| item.command).collect();
        assert_eq!(part.vehicle, index);
        assert_eq!(commands[0], command::TAKEOFF);
        assert_eq!(commands[commands.len() - 1], command::LAND);
        assert_eq!(faults(part), vec![]);
    }
}

#[test]
fn heights_are_those_above_the_first_home() {
    let mut homes = team(2, DVec2::ZERO);
    homes[1].z = 174.0;
    let area = square(DVec2::new(150.0, 0.0), 100.0);
    let generated = generate(&survey(&[area], 20.0), &homes, &manner()).expect("plans");
    let works = |part: &Part, height_m: f64| {
        let mut items = part.document.plan.iter();
        items.any(|item| is_at(f64::from(item.z), height_m))
    };
    assert!(works(&generated.parts[0], 30.0));
    assert!(works(&generated.parts[1], 26.0));
    assert!(!works(&generated.parts[1], 30.0));
}

#[test]
fn searches_lines_and_orbits_are_flown_by_all_at_safe_heights() {
    let datum = place(DVec2::new(200.0, 0.0));
    let way = places(&[
        DVec2::new(60.0, 0.0),
        DVec2::new(200.0, 80.0),
        DVec2::new(340.0, 0.0),
    ]);
    let tasks = [
        Task::Square {
            datum,
            spacing_m: 20.0,
            radius_m: 120.0,
        },
        Task::Sector {
            datum,
            radius_m: 100.0,
        },
        Task::Line {
            points: way.clone(),
            spacing_m: 15.0,
        },
        Task::Line {
            points: way,
            spacing_m: ASIDE_M,
        },
        Task::Orbit {
            centre: datum,
            radius_m: 40.0,
            turns: 3,
        },
    ];
    for task in tasks {
        let team = team(3, DVec2::ZERO);
        let generated = generate(&task, &team, &manner()).expect("plans");
        assert_eq!(generated.parts.len(), 3, "{task:?}");
        for part in &generated.parts {
            assert_eq!(faults(part), vec![], "{task:?}");
            assert!(part.length_m > 200.0, "{task:?}");
            assert!(part.layer_m >= HEIGHT_M, "{task:?}");
        }
    }
}

#[test]
fn an_orbit_has_its_radius_and_turns() {
    let task = Task::Orbit {
        centre: place(DVec2::new(100.0, 0.0)),
        radius_m: 40.0,
        turns: 3,
    };
    let generated = generate(&task, &team(2, DVec2::ZERO), &manner()).expect("plans");
    for part in &generated.parts {
        let mut items = part.document.plan.iter();
        let circle = items.find(|item| item.command == command::LOITER_TURNS);
        let circle = circle.expect("a circle");
        assert_eq!((circle.params[0], circle.params[2]), (3.0, 40.0));
    }
    let angle = |part: &Part| flown(part)[1].0;
    let apart = angle(&generated.parts[0]).distance(angle(&generated.parts[1]));
    assert!((apart - 80.0).abs() < 0.1, "{apart}");
}

#[test]
fn a_pattern_that_breaks_the_fence_is_refused() {
    let manner = Manner {
        fence: fence(
            &square(DVec2::ZERO, 100.0),
            command::FENCE_POLYGON_INCLUSION,
        ),
        ..manner()
    };
    let task = Task::Sector {
        datum: place(DVec2::ZERO),
        radius_m: 80.0,
    };
    let refused = generate(&task, &team(1, DVec2::ZERO), &manner);
    assert_eq!(refused, Err(GenerateError::OutsideFence));
    let none = generate(&task, &[], &manner);
    assert_eq!(none, Err(GenerateError::NoVehicle));
}

#[test]
fn lanes_that_are_too_close_together_are_refused_at_once() {
    let task = Task::Line {
        points: places(&[DVec2::new(60.0, 0.0), DVec2::new(260.0, 0.0)]),
        spacing_m: 4.0,
    };
    let made = |vehicles| generate(&task, &team(vehicles, DVec2::ZERO), &manner());
    assert_eq!(made(3).err(), Some(GenerateError::TooNarrow(6)));
    assert!(made(1).is_ok(), "one vehicle has one lane");
}

/// An expanding square leads around exclusion areas, as the transits of its vehicles do.
#[test]
fn a_square_leads_around_forbidden_areas() {
    let centre = DVec2::new(150.0, 30.0);
    let (x, y) = place(centre).to_e7();
    let circle = Item {
        command: command::FENCE_CIRCLE_EXCLUSION,
        params: [30.0, 0.0, 0.0, 0.0],
        x,
        y,
        ..Item::default()
    };
    let manner = Manner {
        fence: vec![circle],
        ..manner()
    };
    let task = Task::Square {
        datum: place(DVec2::new(200.0, 0.0)),
        spacing_m: 20.0,
        radius_m: 120.0,
    };
    let generated = generate(&task, &team(3, DVec2::ZERO), &manner).expect("plans");
    assert!(generated.uncovered > 0.02, "{}", generated.uncovered);
    for part in &generated.parts {
        assert_eq!(faults(part), vec![]);
        assert_eq!(part.document.fence.len(), 1);
        for leg in flown(part).windows(2) {
            let near_m = distance_to_segment(centre, leg[0].0, leg[1].0);
            assert!(near_m > 30.0, "{near_m}");
        }
    }
}

/// A vehicle far away, and vehicles that a small area does not need, have no part, each with its reason.
#[test]
fn vehicles_that_do_not_help_have_a_reason() {
    let field = square(DVec2::new(100.0, 0.0), 100.0);
    let mut homes = team(2, DVec2::ZERO);
    homes.push(home(DVec2::new(-3000.0, 0.0)));
    let generated = generate(&survey(&[field], 20.0), &homes, &manner()).expect("plans");
    assert_eq!(generated.idle, [(2, Idle::Far)]);
    assert_eq!(generated.parts.len(), 2);
    // An area of 240 m by 180 m: the fifth and the sixth would climb over all others for a few metres.
    let field = [
        DVec2::new(60.0, -120.0),
        DVec2::new(60.0, 120.0),
        DVec2::new(240.0, 120.0),
        DVec2::new(240.0, -120.0),
    ];
    for spacing_m in [10.0, 20.0] {
        let homes: Vec<Home> = (0..6)
            .map(|it| home(DVec2::Y * 5.0 * f64::from(it)))
            .collect();
        let generated = generate(&survey(&[field.to_vec()], spacing_m), &homes, &manner());
        let generated = generated.expect("plans");
        assert_eq!(generated.parts.len() + generated.idle.len(), 6);
        assert!(generated.idle.iter().all(|(_, why)| *why == Idle::Spare));
        let most = |parts: &[Part]| {
            let efforts = parts.iter().map(|part| part.effort.hover_s);
            efforts.fold(0.0, f64::max)
        };
        let four = generate(
            &survey(&[field.to_vec()], spacing_m),
            &homes[..4],
            &manner(),
        );
        let limit = 1.11 * most(&four.expect("plans").parts);
        assert!(most(&generated.parts) <= limit, "{spacing_m}");
        for part in &generated.parts {
            let legs = legs_at(part, HEIGHT_M);
            let work_m: f64 = legs.iter().map(|[from, to]| from.distance(*to)).sum();
            assert!(
                work_m > 0.25 * part.length_m,
                "{work_m} of {}",
                part.length_m
            );
        }
    }
}

/// A larger team uses hardly more energy than a smaller one: vehicles that do not help are left out.
#[test]
fn more_vehicles_never_make_plans_clearly_worse() {
    let field = [
        DVec2::new(22.0, 14.0),
        DVec2::new(111.0, 14.0),
        DVec2::new(111.0, 106.0),
        DVec2::new(22.0, 106.0),
    ];
    let mut least = f64::INFINITY;
    for count in [1, 2, 3, 4, 6, 9] {
        let homes = (0..count).map(|it| home(DVec2::new(0.0, 5.0 * f64::from(it))));
        let homes: Vec<Home> = homes.collect();
        let generated = generate(&survey(&[field.to_vec()], 20.0), &homes, &manner());
        let parts = generated.expect("plans").parts;
        let efforts = parts.iter().map(|part| part.effort.hover_s);
        let most = efforts.fold(0.0, f64::max);
        assert!(most <= least * WORTH, "{count}: {most} {least}");
        least = least.min(most);
    }
}

/// A vehicle whose pad the fence cuts off has no part, and the others do its work.
#[test]
fn a_vehicle_that_cannot_leave_its_pad_has_no_part() {
    let manner = Manner {
        fence: fence(
            &square(DVec2::ZERO, 400.0),
            command::FENCE_POLYGON_INCLUSION,
        ),
        ..manner()
    };
    let mut homes = team(2, DVec2::ZERO);
    homes.push(home(DVec2::new(-270.0, 0.0)));
    let area = square(DVec2::new(100.0, 0.0), 120.0);
    let generated = generate(&survey(&[area], 20.0), &homes, &manner).expect("plans");
    assert_eq!(generated.idle, [(2, Idle::NoWay)]);
    assert_eq!(generated.parts.len(), 2);
}
