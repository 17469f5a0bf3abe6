//! The map as text: in the room and as a pane, in every kind of symbols, for one vehicle and for many.

use std::sync::Arc;
use std::time::Duration;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::app::event::{SessionEvent, Started, TerminalEvent, VehicleEvent};
use sortie::app::room::map::{SketchKind, sketches};
use sortie::app::state::Activity;
use sortie::campaign::Stake;
use sortie::config::Symbols;
use sortie::geo::{LatLon, Outline};
use sortie::mission::{Area, AreaKind, Mission};
use sortie::operator::{Meeting, RehearsalFindings};
use sortie::plan::{HeightFrame, Item};
use sortie::text::{Language, Locale};
use sortie::ui::{self, Look, Role};
use sortie::vehicle::{
    FenceArea, FencePlan, FenceShape, Plan, RallyPlan, RallyPoint, Target, Vehicle,
};

use crate::fixtures;
use crate::harness::Console;

/// A vehicle that has flown some metres north, on its way to a farther point.
fn under_way(id: u16, north_m: f64) -> Vehicle {
    let mut vehicle = fixtures::airborne(id, north_m, 20.0);
    let target = fixtures::HOME.moved(90.0, 5.0 * f64::from(id));
    vehicle.target = Some(Target {
        at_point: Some(target),
        altitude_m: Some(20.0),
        velocity_m_s: None,
        at: Duration::ZERO,
    });
    vehicle
}

/// A survey under way: one vehicle flies, one is lost, four stand on their pads, two of them selected.
pub fn surveyed() -> Console {
    surveyed_with(None)
}

/// The same with another area.
fn surveyed_with(another: Option<Area>) -> Console {
    let mut console = Console::new();
    let area = |name: &str, kind, side_m| Area {
        name: name.to_owned(),
        kind,
        outline: Outline::square(fixtures::HOME.moved(40.0, 10.0), side_m),
        ceiling_m: None,
    };
    let mut areas = vec![
        area("fence", AreaKind::Geofence, 160.0),
        area("yard", AreaKind::Task, 60.0),
    ];
    areas.extend(another);
    console.hear(SessionEvent::Started(Box::new(Started {
        mission: None,
        activity: Activity::Mission {
            id: "m01".to_owned(),
            title: "Air sample at the yard".into(),
            stake: Stake::Graded,
        },
        places: [("street".to_owned(), fixtures::HOME.moved(0.0, -40.0))].into(),
        areas: areas.clone(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    })));
    for id in 3..=6 {
        console.vehicle(fixtures::parked(id));
    }
    let mut lost = fixtures::airborne(2, 70.0, 20.0);
    lost.link.lost = true;
    console.vehicle(lost);
    for metre in 0..40 {
        console.vehicle(under_way(1, f64::from(metre)));
        let mut progress = fixtures::progress();
        progress.readings[0].value = f64::from(metre);
        progress.areas.clone_from(&areas);
        console.hear(SessionEvent::Mission(Box::new(progress)));
    }
    console.write("4-5").press("enter").press("M").press("z");
    for _ in 0..3 {
        console.press("shift-tab");
    }
    console.at(1);
    console
}

pub fn drawn(console: &Console, symbols: Symbols, language: Language, size: (u16, u16)) -> String {
    let look = Look {
        symbols,
        locale: Arc::new(Locale::new(language)),
        ..Look::default()
    };
    let backend = TestBackend::new(size.0, size.1);
    let mut terminal = Terminal::new(backend).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    let buffer = terminal.backend().buffer();
    let rows = buffer.content.chunks(usize::from(size.0));
    let lines = rows.map(|row| {
        let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    });
    lines.collect::<Vec<_>>().join("\n")
}

pub fn resized(mut console: Console, (columns, rows): (u16, u16)) -> Console {
    console.hear(TerminalEvent::Resize { columns, rows });
    console
}

#[test]
fn the_room_of_the_map() {
    for size in [(80, 24), (120, 40), (200, 50)] {
        let console = resized(surveyed(), size);
        let text = drawn(&console, Symbols::Braille, Language::English, size);
        insta::assert_snapshot!(format!("map_{}x{}", size.0, size.1), text);
    }
}

/// The fence once ran into the text, and was once hidden beside it.
#[test]
fn the_fence_stays_apart_from_the_next_objective() {
    let mut hides_fence = false;
    for size in [(80, 24), (200, 50)] {
        let console = resized(surveyed(), size);
        let text = drawn(&console, Symbols::Braille, Language::English, size);
        let row = text.lines().find_map(|row| row.strip_prefix("next: "));
        let row = row.expect("an objective");
        let before_north = row.split("N↑").next().unwrap_or_default();
        let beside = before_north.strip_prefix("Measure the air over the yard (4/9 cells)");
        let beside = beside.expect("the objective");
        assert!(beside.starts_with("   "), "{row}");
        hides_fence |= beside.trim().is_empty();
    }
    assert!(!hides_fence);
}

#[test]
fn the_map_without_braille_and_in_ukrainian() {
    let size = (120, 40);
    let console = resized(surveyed(), size);
    let kinds = [("block", Symbols::Block), ("ascii", Symbols::Ascii)];
    for (name, symbols) in kinds {
        let text = drawn(&console, symbols, Language::English, size);
        insta::assert_snapshot!(format!("map_{name}_120x40"), text);
    }
    let text = drawn(&console, Symbols::Braille, Language::Ukrainian, size);
    insta::assert_snapshot!("map_ukrainian_120x40", text);
}

#[test]
fn the_canvas_is_pure_ascii_where_only_ascii_is_to_be_had() {
    let console = resized(surveyed(), (120, 40));
    let text = drawn(&console, Symbols::Ascii, Language::English, (120, 40));
    // The rules, the frame of the legend and the scale bar become ASCII as on every screen.
    let canvas = text.chars().filter(|c| !"─│┌┐└┘├┤┼°".contains(*c));
    let strange: String = canvas.filter(|c| !c.is_ascii()).collect();
    assert_eq!(strange, "");
}

#[test]
fn the_flight_screen_has_the_map_where_there_is_room() {
    let mut console = surveyed();
    console.press("F");
    for (size, has_map) in [((80, 24), false), ((120, 40), true), ((200, 50), true)] {
        let console = resized(console.clone(), size);
        let text = drawn(&console, Symbols::Braille, Language::English, size);
        assert_eq!(text.contains("── map "), has_map, "{size:?}\n{text}");
    }
}

#[test]
fn every_vehicle_of_a_swarm_is_on_the_map_or_counted() {
    let mut console = Console::flying(300);
    console.press("M").press("z");
    let size = (80, 24);
    let console = resized(console, size);
    let text = drawn(&console, Symbols::Braille, Language::English, size);
    let number = |text: &str| -> usize {
        let digits: String = text.chars().take_while(char::is_ascii_digit).collect();
        digits.parse().expect("a number")
    };
    let counted: usize = text.split('×').skip(1).map(number).sum();
    let hidden = number(text.split("[o1+").nth(1).expect("a count"));
    assert_eq!(
        counted + hidden,
        299,
        "all but the one under the cursor:\n{text}"
    );
}

#[test]
fn without_a_position_the_map_says_so() {
    let mut console = Console::flying(0);
    let text = console.press("M").screen(80, 24);
    assert!(text.contains("No position is known yet."), "{text}");
}

#[test]
fn no_size_and_no_zoom_panics() {
    let mut console = surveyed();
    for key in [
        "-", "-", "-", "-", "u", "+", "+", "+", "+", "+", "+", "+", "+", "f",
    ] {
        console.press(key);
        for width in [80, 81, 119, 160, 300] {
            for height in [24, 25, 100] {
                console.screen(width, height);
            }
        }
    }
}

/// A vehicle with a plan of three points, a fence with a hole in it, and a rally point.
pub fn planned(id: u16) -> Vehicle {
    let mut vehicle = fixtures::airborne(id, 0.0, 20.0);
    let place = |north_m, east_m| fixtures::HOME.moved(north_m, east_m);
    let item = |at_point: LatLon| {
        let (x, y) = at_point.to_e7();
        Item {
            command: 16,
            frame: 3,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y,
            z: 20.0,
        }
    };
    let points = [(0.0, 0.0), (60.0, -30.0), (60.0, 50.0), (10.0, 70.0)];
    let items = points.into_iter().map(|(n, e)| item(place(n, e)));
    vehicle.plans.plan.content = Some(Arc::new(Plan {
        items: items.collect(),
        home_first: true,
    }));
    let circle = |radius_m, inclusion| FenceArea {
        shape: FenceShape::Circle {
            center: place(30.0, 20.0),
            radius_m,
        },
        inclusion,
    };
    vehicle.plans.fence.content = Some(Arc::new(FencePlan {
        areas: vec![circle(75.0, true), circle(12.0, false)],
        ..FencePlan::default()
    }));
    vehicle.plans.rally.content = Some(Arc::new(RallyPlan {
        points: vec![RallyPoint {
            at_point: place(-20.0, 40.0),
            altitude_m: Some(15.0),
            frame: HeightFrame::Home,
        }],
        ..RallyPlan::default()
    }));
    vehicle
}

#[test]
fn what_the_cursors_vehicle_has_on_board() {
    let mut console = Console::flying(0);
    console.vehicle(planned(1)).vehicle(planned(2)).press("M");
    let mut console = resized(console, (120, 40));
    console.press("z");
    let text = drawn(&console, Symbols::Braille, Language::English, (120, 40));
    insta::assert_snapshot!("map_plan_120x40", text);
    let fences = sketches(console.press("*").state());
    let borders = fences.iter().filter(|it| it.kind == SketchKind::Fence);
    assert_eq!(borders.count(), 1, "two vehicles share it");
}

/// The cells of the map in a role's colour that show a sign, by rows.
fn signs_in(console: &Console, role: Role, size: (u16, u16)) -> Vec<String> {
    let look = Look::default();
    let backend = TestBackend::new(size.0, size.1);
    let mut terminal = Terminal::new(backend).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    let colour = look.style(role).fg;
    let sign = |cell: &ratatui::buffer::Cell| {
        let is_meant = Some(cell.fg) == colour && cell.symbol() != "\u{2800}";
        if is_meant { cell.symbol() } else { " " }.to_owned()
    };
    let rows = terminal.backend().buffer().content.chunks(size.0.into());
    rows.map(|row| row.iter().map(sign).collect()).collect()
}

/// A vehicle in flight has the colour of its plan, even if all are selected.
#[test]
fn selected_vehicles_keep_their_own_colours() {
    let size = (120, 40);
    let mut console = Console::flying(0);
    for (id, north_m) in [(1, 0.0), (2, 80.0)] {
        console.vehicle(fixtures::airborne(id, north_m, 20.0));
    }
    console.press("M");
    let mut console = resized(console, size);
    console.press("*").press("z");
    for (mark, role) in ["1*", "2*"].into_iter().zip(Role::DRONES) {
        let own = signs_in(&console, role, size);
        assert!(own.iter().any(|row| row.contains(mark)), "{mark}: {own:#?}");
    }
}

#[test]
fn the_fence_is_dashed_in_a_colour_of_its_own_and_an_alert_in_that_of_alerts() {
    let size = (120, 40);
    let mut console = Console::flying(0);
    let mut low = planned(1);
    for battery in &mut low.batteries {
        battery.remaining_percent = Some(4);
    }
    console.vehicle(low).press("M");
    let mut console = resized(console, size);
    console.press("z");
    let fence = signs_in(&console, Role::Fence, size);
    let dashes = |row: &String| row.split_whitespace().count();
    // The upper and the lower edge of a circle are strokes with gaps.
    let most = fence.iter().map(dashes).max();
    assert!(most.is_some_and(|most| most >= 3), "{fence:#?}");
    let longest = fence.iter().flat_map(|row| row.split_whitespace());
    let longest = longest.map(|it| it.chars().count()).max();
    assert!(longest.is_some_and(|longest| longest <= 6), "{fence:#?}");
    let alarmed = signs_in(&console, Role::Danger, size);
    assert!(alarmed.iter().any(|row| row.contains("1!")), "{alarmed:#?}");
    assert!(!fence.iter().any(|row| row.contains('!')));
    let pressing = signs_in(&console, Role::Alert, size);
    assert!(pressing[0].contains("! 1 alert"), "{}", pressing[0]);
}

#[test]
fn places_where_a_rehearsal_shows_a_conflict_are_on_the_map_until_the_next_one() {
    let mut console = surveyed();
    let meeting = Meeting {
        vehicles: [1, 2],
        at_point: fixtures::HOME.moved(60.0, -10.0),
    };
    console.hear(VehicleEvent::Rehearsed(RehearsalFindings {
        meetings: vec![meeting],
        ..RehearsalFindings::default()
    }));
    let shown = || drawn(&console, Symbols::Braille, Language::English, (120, 40));
    assert!(shown().contains("!1/2"), "{}", shown());
    console.press("i");
    let text = drawn(&console, Symbols::Braille, Language::Ukrainian, (120, 40));
    assert!(text.contains("надто близько"), "{text}");
    console.hear(VehicleEvent::Rehearsed(RehearsalFindings {
        passed: vec![1, 2],
        ..RehearsalFindings::default()
    }));
    let text = drawn(&console, Symbols::Braille, Language::English, (120, 40));
    assert!(!text.contains("!1/2"), "{text}");
}

#[test]
fn everything_in_view_is_the_task_and_the_drones_but_not_the_fence() {
    let console = surveyed();
    let map = console.state().rooms().map();
    let frame = map.overview().frame().expect("a frame");
    let yard = Outline::square(fixtures::HOME.moved(40.0, 10.0), 60.0);
    assert!(
        yard.corners()
            .into_iter()
            .all(|corner| frame.contains(corner))
    );
    let fence = Outline::square(fixtures::HOME.moved(40.0, 10.0), 160.0);
    assert!(
        !fence
            .corners()
            .into_iter()
            .any(|corner| frame.contains(corner))
    );
}

/// A brief that tells of a jammer lets the trainee look for it on the map.
#[test]
fn the_first_view_contains_what_the_mission_warns_of() {
    let console = surveyed_with(Some(Area {
        name: "mast".to_owned(),
        kind: AreaKind::Jamming,
        outline: Outline::square(fixtures::HOME.moved(0.0, 150.0), 20.0),
        ceiling_m: None,
    }));
    let map = console.state().rooms().map();
    let frame = map.overview().frame().expect("a frame");
    assert!(frame.contains(fixtures::HOME.moved(0.0, 155.0)));
}

#[test]
fn the_title_says_what_is_in_view_and_the_legend_lists_it() {
    let size = (120, 40);
    let mut console = resized(surveyed(), size);
    let shown = |console: &Console| drawn(console, Symbols::Braille, Language::English, size);
    let text = shown(&console);
    assert!(text.contains("map  task and vehicles in view"), "{text}");
    // So close that no line of the yard is left.
    for _ in 0..9 {
        console.press("+");
    }
    let text = shown(&console);
    assert!(!text.contains("task area"), "{text}");
}

/// Sensors must find a hazard: until then, the map shows nothing of it.
#[test]
fn a_mission_tells_its_areas_and_nothing_of_its_hazards() {
    let source = include_str!("../../../missions/01-air-sample.toml");
    let mission = Mission::parse(source).expect("a mission");
    let areas = mission.areas();
    let told: Vec<_> = areas.iter().map(|it| (it.name.as_str(), it.kind)).collect();
    assert_eq!(
        told,
        [("yard", AreaKind::Task), ("fence", AreaKind::Geofence)]
    );
}

#[test]
fn sensors_on_the_ground_leave_no_samples() {
    let mut console = Console::flying(1);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    assert_eq!(console.state().rooms().map().samples().fields().len(), 0);
    console.vehicle(fixtures::airborne(1, 0.0, 20.0));
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    let map = console.state().rooms().map();
    assert_eq!(map.field().map(|(name, _)| name), Some("co"));
}

#[test]
fn without_colours_trails_have_the_numbers_of_their_vehicles() {
    let mut console = Console::flying(0);
    for metre in 0..60 {
        for id in [1, 2] {
            let mut vehicle = fixtures::airborne(id, 0.0, 20.0);
            let away_m = 100.0 * f64::from(id);
            let global = vehicle.global.as_mut().expect("it has a position");
            global.at_point = fixtures::HOME.moved(f64::from(metre), away_m);
            console.vehicle(vehicle);
        }
    }
    console.press("M").press("z");
    let size = (80, 24);
    let console = resized(console, size);
    let count = |text: &str, number: char| text.chars().filter(|&c| c == number).count();
    let coloured = drawn(&console, Symbols::Braille, Language::English, size);
    let plain = drawn(&console, Symbols::Ascii, Language::English, size);
    for number in ['1', '2'] {
        let more = count(&plain, number) - count(&coloured, number);
        assert!(more > 0, "{coloured}\n{plain}");
    }
}
