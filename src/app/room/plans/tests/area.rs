//! Areas that are drawn, their division among vehicles, and the ground.

use super::*;
use crate::geo::{Square, Terrain};
use crate::plan::check::{Finding, FindingKind};
use crate::vehicle::GlobalPosition;

#[test]
fn a_draft_on_board_of_its_vehicle_is_not_lost() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    draw_field(&mut desk);
    desk.give("draft survey 1");
    let plan = desk.room().items().to_vec();
    let is_safe = |desk: &Desk| {
        let draft = desk.room().drafts().current().expect("a draft");
        is_elsewhere(desk.app.state(), draft)
    };
    assert!(!is_safe(&desk));
    let kept = desk.kept_at(100).expect("it is unsaved");
    assert!(kept.contains("vehicle-1"), "{kept}");
    desk.vehicle(1, |vehicle| {
        read_empty(vehicle);
        let home = std::iter::once(Item::default());
        vehicle.plans.plan.content = Some(Arc::new(Plan {
            items: home.chain(plan).collect(),
            home_first: true,
        }));
    });
    assert!(is_safe(&desk));
    let kept = desk.kept_at(200).expect("the field is unsaved");
    assert!(!kept.contains("vehicle-1"), "{kept}");
    desk.press("x");
    assert!(!is_safe(&desk));
    let kept = desk.kept_at(300).expect("it has changed");
    assert!(kept.contains("vehicle-1"), "{kept}");
}

/// Adds a vehicle that stands ready at its place.
pub(super) fn standing(desk: &mut Desk, id: VehicleId) {
    desk.vehicle(id, |vehicle| {
        read_empty(vehicle);
        vehicle.global = Some(GlobalPosition {
            at_point: HOME.moved(0.0, 8.0 * f64::from(id)),
            altitude_amsl_m: 170.0,
            altitude_m: 0.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: std::time::Duration::ZERO,
        });
    });
}

/// Draws a field of 300 m by 200 m as a fence.
pub(super) fn draw_field(desk: &mut Desk) {
    desk.give("draft new field");
    desk.give("draft fence polygon n 50 e -100");
    for corner in ["n 250 e -100", "n 250 e 200", "n 50 e 200"] {
        desk.give(&format!("draft fence corner {corner}"));
    }
}

#[test]
fn the_area_drawn_is_divided_among_vehicles_by_a_key() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    standing(&mut desk, 2);
    draw_field(&mut desk);
    desk.press("S");
    assert_eq!(desk.line(), "draft survey all ");
    let _ = desk.key(KeyCode::Enter);
    let drafts = desk.room().drafts();
    let own: Vec<_> = drafts
        .all()
        .iter()
        .map(|it| (it.name(), it.vehicle()))
        .collect();
    assert_eq!(
        own,
        [
            ("field", None),
            ("vehicle-1", Some(1)),
            ("vehicle-2", Some(2))
        ]
    );
    assert_eq!(drafts.current_index(), 1);
    for draft in &drafts.all()[1..] {
        assert!(draft.document().plan.len() > 6, "{draft:?}");
    }
    assert!(desk.said().contains("1-2"), "{}", desk.said());
    desk.press("U");
    assert_eq!(desk.line(), "draft upload each");
    let orders = desk.key(KeyCode::Enter);
    assert_eq!(orders.len(), 2, "{orders:?}");
}

#[test]
fn a_second_division_replaces_the_first_and_can_be_undone() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    standing(&mut desk, 2);
    draw_field(&mut desk);
    desk.give("draft survey all spacing 40");
    let few = desk.plan().len();
    desk.give("draft use field");
    desk.give("draft survey 1 spacing 20");
    assert!(desk.plan().len() > few);
    desk.press("u");
    assert_eq!(desk.plan().len(), few);
}

#[test]
fn lines_to_vehicles_know_the_area_drawn() {
    let mut desk = Desk::new();
    standing(&mut desk, 1);
    standing(&mut desk, 2);
    desk.give("draft new empty");
    desk.give("draft survey all");
    let fault = match desk.app.state().overlay() {
        Some(Overlay::Palette(palette)) => palette.fault().map(|it| it.message.to_string()),
        _ => None,
    };
    assert!(fault.is_some_and(|it| it.contains("no area is drawn")));
    let _ = desk.key(KeyCode::Esc);
    draw_field(&mut desk);
    for line in [
        "all plan survey drawn spacing 30",
        "all plan search parallel drawn",
        "all plan search creeping drawn up 40",
    ] {
        let effects = desk.give(line);
        let [Effect::Order { order, .. }] = &effects[..] else {
            panic!("{line}: {effects:?}");
        };
        assert!(matches!(order.act, Act::Plans(_)), "{order:?}");
    }
    desk.give("draft fence circle 40 n 300 e 0");
    let two = desk.app.state().with_context(|context| {
        let areas = context.areas.expect("known");
        areas.keys().cloned().collect::<Vec<String>>()
    });
    assert_eq!(two, ["drawn", "drawn-1", "drawn-2"]);
    desk.give("draft search square 1 around tower radius 60");
    let name = desk.room().drafts().current().map(Draft::name);
    assert_eq!(name, Some("vehicle-1"), "{}", desk.said());
}

/// A square whose ground rises by 1 m for each 10 m to the north, from 170 m at home.
fn slope() -> Terrain {
    const SIDE: usize = 1201;
    let square = Square::of(HOME);
    let rows = (0..SIDE).map(|row| {
        let lat_deg = f64::from(square.lat) + 1.0 - row as f64 / (SIDE - 1) as f64;
        let (north_m, _) = HOME.offset_to(LatLon::new(lat_deg, HOME.lon_deg));
        (170.0 + north_m / 10.0).clamp(-400.0, 9000.0) as i16
    });
    let bytes: Vec<u8> = rows
        .flat_map(|height| std::iter::repeat_n(height.to_be_bytes(), SIDE))
        .flatten()
        .collect();
    let mut terrain = Terrain::default();
    terrain.add(square, &bytes).expect("the right size");
    terrain
}

#[test]
fn the_ground_comes_from_files_of_a_folder() {
    let mut desk = Desk::new();
    desk.give("draft add takeoff 20");
    desk.give("draft add n 50 e 0 up 20");
    desk.give("draft add n 400 e 0 up 20");
    let asked = desk.give("draft ground srtm");
    let [Effect::File(FileEffect::Ground { folder, squares })] = &asked[..] else {
        panic!("{asked:?}");
    };
    assert_eq!(
        (folder.as_str(), &squares[..]),
        ("srtm", &[Square::of(HOME)][..])
    );
    let (folder, terrain) = ("srtm".to_owned(), slope());
    let _ = desk
        .app
        .update(Event::from(FileEvent::Ground { folder, terrain }));
    assert!(desk.said().contains("srtm"), "{}", desk.said());
    let faults = |desk: &Desk| {
        let draft = desk.room().drafts().current().expect("a draft");
        let found = findings(desk.app.state(), draft.document()).into_iter();
        let is_low = |it: &Finding| matches!(it.kind, FindingKind::LowOverGround { .. });
        found.filter(|it| it.item == Some(2) && is_low(it)).count()
    };
    assert_eq!(
        faults(&desk),
        1,
        "20 m above home is below ground 400 m away"
    );
    desk.give("draft frame 2-3 terrain");
    let heights: Vec<i32> = desk
        .room()
        .items()
        .iter()
        .map(|it| it.z.round() as i32)
        .collect();
    assert_eq!(heights, [20, 15, -20], "the flight stays where it is");
    desk.give("draft height 2-3 20");
    assert_eq!(faults(&desk), 0);
    assert!(desk.give("draft ground").is_empty());
    assert!(desk.room().ground().is_empty());
}

/// A change of frame reports that it assumed level ground, even if only one of the items is outside
/// the files.
#[test]
fn a_change_of_frame_on_unknown_ground_is_not_silent() {
    let mut desk = Desk::new();
    desk.give("draft add n 50 e 0 up 20");
    desk.give("draft frame 1 terrain");
    assert!(desk.said().contains("level"), "kept: {}", desk.said());
    desk.give("draft frame 1 terrain");
    assert!(!desk.said().contains("level"), "no change: {}", desk.said());
    desk.give("draft frame 1 home");
    desk.give("draft ground srtm");
    let (folder, terrain) = ("srtm".to_owned(), slope());
    let _ = desk
        .app
        .update(Event::from(FileEvent::Ground { folder, terrain }));
    let is_level = |desk: &mut Desk, line: &str| {
        desk.give(line);
        desk.said().contains("level")
    };
    assert!(!is_level(&mut desk, "draft frame 1 terrain"));
    assert!(!is_level(&mut desk, "draft frame 1 sea"));
    desk.give("draft add 50.45 31.2 up 30 frame home");
    for frame in ["terrain", "sea", "terrain", "home"] {
        let line = format!("draft frame 2 {frame}");
        assert!(is_level(&mut desk, &line), "{line}: {}", desk.said());
    }
    assert!(is_level(&mut desk, "draft frame 1-2 terrain"), "one of two");
    desk.give("draft frame 2 home");
    desk.give("draft frame 2 sea");
    assert!(!desk.said().contains("level"), "{}", desk.said());
}

/// Vehicles that have no part in smaller work keep their plans until they are cleared, so a lasting notice names them.
#[test]
fn vehicles_without_a_part_now_are_named_in_a_notice() {
    let mut desk = Desk::new();
    for id in [1, 2, 3] {
        standing(&mut desk, id);
    }
    draw_field(&mut desk);
    desk.give("draft survey all");
    let notices = |desk: &Desk| -> Vec<String> {
        let lines = desk.app.state().notices().lines();
        lines.map(|line| line.notice.text.to_string()).collect()
    };
    assert!(notices(&desk).is_empty(), "{:?}", notices(&desk));
    for id in [1, 2, 3] {
        standing(&mut desk, id);
        let vehicle = desk.app.state().session().vehicles().get(&id);
        let mut vehicle = Vehicle::clone(vehicle.expect("heard"));
        vehicle.plans.plan.content = Some(Arc::new(Plan {
            items: vec![Item::default(); 3],
            home_first: true,
        }));
        let event = VehicleEvent::Telemetry(Arc::new(vehicle));
        let _ = desk.app.update(Event::from(event));
    }
    desk.give("draft use field");
    desk.give("draft survey 1");
    let said = notices(&desk);
    assert!(
        said.len() == 1 && said[0].contains("`2-3 plan clear`"),
        "{said:?}"
    );
    assert!(desk.said().contains("`2-3 plan clear`"), "{}", desk.said());
    let drafts = desk.room().drafts().all().iter();
    let vehicles: Vec<Option<VehicleId>> = drafts.map(Draft::vehicle).collect();
    assert_eq!(vehicles, [None, Some(1)], "their drafts are closed");
}

#[test]
fn in_a_mission_lines_lie_as_close_as_its_sensors_need() {
    let toml = include_str!("../../../../../missions/07-clearance.toml");
    let mission = crate::mission::Mission::parse(toml).expect("it is good");
    let mut desk = Desk::new();
    let _ = desk
        .app
        .update(Event::Session(SessionEvent::Started(Box::new(Started {
            activity: Activity::Free,
            mission: Some(Box::new(mission.listing())),
            places: std::collections::BTreeMap::new(),
            areas: Vec::new(),
            processes: None,
            speedup: 1.0,
            is_again: false,
        }))));
    desk.press("E");
    standing(&mut desk, 1);
    desk.give("draft new strip");
    desk.give("draft fence polygon n 50 e 0");
    for corner in ["n 60 e 0", "n 60 e 8", "n 50 e 8"] {
        desk.give(&format!("draft fence corner {corner}"));
    }
    desk.give("draft survey 1 up 1");
    let items = desk.room().items().iter();
    let lines = items.filter(|item| item.command == command::WAYPOINT && item.z < 1.5);
    // Ten lines of 0.8 m with two ends each.
    assert!(lines.count() >= 20, "{:?}", desk.room().items());
}

/// The legs of all parts avoid the drawn keep-out areas, and each draft is checked against them.
#[test]
fn divided_work_keeps_out_of_forbidden_areas() {
    let mut desk = Desk::new();
    for id in 1..=6 {
        standing(&mut desk, id);
    }
    draw_field(&mut desk);
    desk.give("draft fence circle 30 out n 150 e 0");
    desk.give("draft survey all spacing 20 up 30");
    let centre = HOME.moved(150.0, 0.0);
    let drafts = desk.room().drafts().all().iter();
    let parts: Vec<_> = drafts.filter(|it| it.vehicle().is_some()).collect();
    assert!(parts.len() > 1);
    for draft in parts {
        let document = draft.document();
        assert_eq!(document.fence.len(), 1, "the circle");
        let places: Vec<_> = document.plan.iter().filter_map(Item::place).collect();
        let nearest_m = |leg: &[crate::geo::LatLon]| {
            let (north_m, east_m) = leg[0].offset_to(leg[1]);
            let along = (0..=100).map(|step| f64::from(step) / 100.0);
            let gaps = along.map(|share| {
                let here = leg[0].moved(north_m * share, east_m * share);
                here.distance_m(centre)
            });
            gaps.fold(f64::INFINITY, f64::min)
        };
        for leg in places.windows(2) {
            assert!(nearest_m(leg) > 30.0, "{}", nearest_m(leg));
        }
    }
}

/// A small area does not need six vehicles: a notice states why some have no part.
#[test]
fn vehicles_that_are_not_needed_are_named_with_the_reason() {
    let mut desk = Desk::new();
    for id in 1..=6 {
        standing(&mut desk, id);
    }
    desk.give("draft new garden");
    desk.give("draft fence polygon n 50 e 0");
    for corner in ["n 90 e 0", "n 90 e 40", "n 50 e 40"] {
        desk.give(&format!("draft fence corner {corner}"));
    }
    desk.give("draft survey all spacing 20");
    let parts = desk.room().drafts().all().iter();
    let busy = parts.filter(|it| it.vehicle().is_some()).count();
    assert!((1..6).contains(&busy), "{busy}");
    let lines = desk.app.state().notices().lines();
    let said: Vec<String> = lines.map(|line| line.notice.text.to_string()).collect();
    let has_reason = said
        .iter()
        .any(|it| it.starts_with("no part for ") && it.contains("energy"));
    assert!(has_reason, "{said:?}");
    assert!(desk.said().contains("no part for"), "{}", desk.said());
}
