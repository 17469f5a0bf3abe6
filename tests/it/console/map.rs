//! The keys of the map.

use sortie::app::event::{SessionEvent, TerminalEvent};
use sortie::app::room::map::Aim;
use sortie::app::state::Room;
use sortie::geo::{GridSize, LatLon};

use super::{palette_line, selection};
use crate::fixtures;
use crate::harness::Console;

/// Four vehicles in a row, five metres apart, seen on the map.
fn on_the_map() -> Console {
    let mut console = Console::flying(4);
    console.hear(TerminalEvent::Resize {
        columns: 120,
        rows: 40,
    });
    console.press("M").press("z");
    assert_eq!(console.state().room(), Room::Map);
    console
}

fn pointed(console: &Console) -> LatLon {
    let map = console.state().rooms().map();
    let view = map
        .view(map.canvas(GridSize::new(120, 40)))
        .expect("a view");
    map.pointed(&view)
}

#[test]
fn the_cursor_goes_where_its_keys_say() {
    let mut console = on_the_map();
    console.press("end");
    let start = fixtures::HOME.moved(0.0, 5.0);
    assert!(start.distance_m(pointed(&console)) < 0.01, "on vehicle 1");
    for (keys, north, east) in [
        ("h", 0.0, -1.0),
        ("right", 0.0, 1.0),
        ("k", 1.0, 0.0),
        ("down", -1.0, 0.0),
    ] {
        console.press("end");
        for _ in 0..3 {
            console.press(keys);
        }
        let (north_m, east_m) = start.offset_to(pointed(&console));
        assert!(
            north_m * north + east_m * east > 0.5,
            "{keys}: {north_m} {east_m}"
        );
        assert!(
            north_m * east + east_m * north < 3.0,
            "{keys}: {north_m} {east_m}"
        );
    }
}

#[test]
fn escape_leads_back_to_where_the_map_was_opened() {
    let mut console = on_the_map();
    console.press("V").press("M").press("space").press("u");
    for room in [Room::Map, Room::Map, Room::Vehicle] {
        console.press("esc");
        assert_eq!(console.state().room(), room, "ruler, selection, room");
    }
    console.press("F").press("M").press("M").press("esc");
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn a_click_points_at_a_place_of_the_map_and_nowhere_else() {
    let mut console = on_the_map();
    let click = |console: &mut Console, column, row| {
        console.hear(TerminalEvent::Click { column, row });
        pointed(console)
    };
    let size = GridSize::new(120, 40);
    let map = console.state().rooms().map();
    let view = map.view(map.canvas(size)).expect("a view");
    // Below the header and the title of the map.
    let place = click(&mut console, 20, 2 + 9);
    assert_eq!(view.cell(place), Some((20, 9)));
    for (column, row) in [(20, 1), (20, 39), (119, 10)] {
        let same = click(&mut console, column, row);
        assert!(same.distance_m(place) < 0.01, "{column} {row}");
    }
    console.press("?");
    let under_help = click(&mut console, 30, 12);
    assert!(under_help.distance_m(place) < 0.01);
}

#[test]
fn goto_is_written_with_the_place_under_the_cursor_and_sent_only_by_enter() {
    let mut console = on_the_map();
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 0.0, 20.0));
    }
    console.write("2-3");
    assert_eq!(
        console.state().typing().targets(),
        "2-3",
        "`-` belongs to the list"
    );
    console.press("enter");
    assert_eq!(selection(&console), [2, 3]);
    console.press("home").press("g");
    assert!(console.effects.is_empty(), "nothing has been sent");
    assert_eq!(palette_line(&console), "goto 50.4501000 30.5235408 ");
    console.press("enter");
    assert_eq!(console.sent_to(), [2, 3]);
}

#[test]
fn goto_names_the_place_that_is_under_the_cursor() {
    let mut console = on_the_map();
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 0.0, 20.0));
    }
    let mut progress = fixtures::progress();
    let home = console
        .state()
        .session()
        .under_cursor()
        .and_then(|it| it.home);
    let at = home.expect("a home").at_point;
    progress.places = [("gate1".to_owned(), at)].into();
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("home").press("g");
    assert_eq!(palette_line(&console), "goto gate1 ");
}

#[test]
fn enter_takes_the_vehicle_nearest_to_the_cursor_and_tab_the_next_one() {
    let mut console = on_the_map();
    assert_eq!(console.state().session().cursor(), Some(1));
    console.press("tab").press("tab");
    assert_eq!(console.state().session().cursor(), Some(3));
    let third = fixtures::HOME.moved(0.0, 15.0);
    assert!(pointed(&console).distance_m(third) < 0.01);
    console.press("tab").press("tab");
    assert_eq!(
        console.state().session().cursor(),
        Some(1),
        "round and round"
    );
    console.press("shift-tab");
    assert_eq!(console.state().session().cursor(), Some(4));
    for _ in 0..60 {
        console.press("h");
    }
    assert_eq!(console.press("enter").state().session().cursor(), Some(1));
}

#[test]
fn the_ruler_begins_and_ends_with_one_key() {
    let mut console = on_the_map();
    console.press("end").press("u");
    let mark = console.state().rooms().map().mark().expect("a mark");
    console.press("l").press("l");
    assert!(console.screen(120, 40).contains("ruler"));
    assert!(mark.distance_m(pointed(&console)) > 0.5);
    console.press("esc");
    assert_eq!(console.state().rooms().map().mark(), None);
    assert_eq!(
        console.press("u").press("u").state().rooms().map().mark(),
        None
    );
}

#[test]
fn a_followed_vehicle_stays_in_view_until_the_cursor_leads_away() {
    let mut console = on_the_map();
    console.press("f");
    for metre in 0..300 {
        console.vehicle(fixtures::airborne(1, f64::from(metre), 20.0));
    }
    let map = console.state().rooms().map();
    assert!(matches!(map.aim(), Aim::Vehicle(..)));
    let view = map
        .view(map.canvas(GridSize::new(120, 40)))
        .expect("a view");
    let place = fixtures::HOME.moved(299.0, 5.0);
    let (column, row) = view.cell(place).expect("in view");
    assert!((28..58).contains(&column) && (12..24).contains(&row));
    assert!(console.screen(120, 40).contains("follows 1"));
    console.press("f");
    assert!(matches!(
        console.state().rooms().map().aim(),
        Aim::Place(..)
    ));
    assert_eq!(console.press("z").state().rooms().map().aim(), Aim::All);
}

#[test]
fn the_room_is_as_it_was_left_and_a_new_session_sees_nothing_of_the_old_one() {
    let mut console = on_the_map();
    console.vehicle(fixtures::airborne(1, 10.0, 20.0));
    console
        .press("end")
        .press("+")
        .press("u")
        .press("w")
        .press("i");
    let before = console.state().rooms().map().clone();
    console.press("F").press("M");
    let map = console.state().rooms().map();
    assert_eq!((map.aim(), map.mark()), (before.aim(), before.mark()));
    assert!(map.hides_trails() && map.legend().is_some() && !map.trails().is_empty());
    console.start(sortie::app::state::Activity::Free);
    let map = console.state().rooms().map();
    assert_eq!(
        (map.aim(), map.mark(), map.cursor()),
        (Aim::All, None, None)
    );
    assert!(map.trails().is_empty() && map.overview().frame().is_none());
    assert!(map.hides_trails(), "what the user wants to see stays");
}

#[test]
fn a_hovering_swarm_does_not_move_the_map() {
    let mut console = on_the_map();
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 20.0, 20.0));
    }
    // By then, the vehicles are known to be close to each other.
    console.at(1);
    let before = console.screen(120, 40);
    let rows = |screen: &str| {
        screen
            .lines()
            .skip(2)
            .take(35)
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    for second in 2..60 {
        console.at(second);
        let sway = f64::from(second as u32 % 3) * 0.01;
        console.vehicle(fixtures::airborne(1, 20.0 + sway, 20.0));
    }
    assert_eq!(rows(&console.screen(120, 40)), rows(&before));
}
