use ratatui::layout::Rect;
use ratatui::style::Style;

use super::*;

/// Vehicles in a row: column, number and marks.
fn drawn(vehicles: &[(u16, VehicleId, &str)]) -> String {
    drawn_in(1, vehicles).concat()
}

/// The rows of a map with these vehicles in the middle one.
fn drawn_in(rows: u16, vehicles: &[(u16, VehicleId, &str)]) -> Vec<String> {
    let (look, area) = (Look::default(), Rect::new(0, 0, 10, rows));
    let row = rows / 2;
    let mut buffer = Buffer::empty(area);
    let mut board = Board::new(Panel::new(&look, area), NumberSpots::Around, &mut buffer);
    let marker = |&(column, id, marks): &(u16, VehicleId, &str)| Marker {
        id,
        column,
        row,
        sign: '^',
        marks: marks.to_owned(),
        role: Role::Text,
        rank: 0,
    };
    let markers: Vec<Marker> = vehicles.iter().map(marker).collect();
    for it in &markers {
        board.put(it.column, row, "^", Style::new());
    }
    for it in &markers {
        name(it, &mut board, &look);
    }
    let row = |y| (0..10).map(|x| buffer[(x, y)].symbol()).collect();
    (0..rows).map(row).collect()
}

#[test]
fn a_vehicle_with_an_alert_keeps_its_number_beside_neighbours() {
    assert_eq!(drawn(&[(1, 2, "!"), (5, 3, "")]), " ^2! ^3   ");
    assert_eq!(drawn(&[(1, 2, "!"), (3, 3, "")]), " !2^3     ");
    assert_eq!(drawn(&[(1, 2, "*"), (3, 3, "!")]), " *2^3!    ");
}

#[test]
fn no_number_stands_between_two_signs_unless_it_follows_its_own() {
    // The number of vehicle 3 would look like that of vehicle 2.
    assert_eq!(drawn(&[(1, 2, ""), (3, 3, ""), (4, 4, "")]), " ^2^^4    ");
    assert_eq!(drawn(&[(3, 3, ""), (4, 4, "")]), "  3^^4    ");
}

#[test]
fn neighbours_without_a_gap_have_their_numbers_above_and_below() {
    let vehicles = [(1, 1, ""), (3, 2, ""), (5, 3, "")];
    assert_eq!(
        drawn_in(3, &vehicles),
        [" 1 2      ", " ^ ^ ^3   ", "          "]
    );
}

#[test]
fn the_numbers_of_a_group_are_not_reversed_like_their_sign() {
    let look = Look {
        theme: crate::ui::theme::Theme::named("monochrome").expect("a theme"),
        ..Look::default()
    };
    let area = Rect::new(0, 0, 12, 3);
    let mut buffer = Buffer::empty(area);
    let mut board = Board::new(Panel::new(&look, area), NumberSpots::Around, &mut buffer);
    let markers = [marker_at(4, 2, "!"), marker_at(4, 3, "")];
    let group = Group {
        row: 1,
        cells: 4..8,
        markers: markers.iter().collect(),
    };
    list(&group, &mut board, &look);
    let is_reversed = |cell: &ratatui::buffer::Cell| cell.modifier.contains(Modifier::REVERSED);
    assert_eq!(buffer[(4, 0)].symbol(), "2");
    assert!(!buffer.content.iter().any(is_reversed));
}

#[test]
fn where_signs_are_close_the_numbers_stand_above_or_below_them() {
    let vehicles = [(1, 2, ""), (3, 3, ""), (4, 4, ""), (6, 5, "!"), (7, 6, "")];
    assert_eq!(
        drawn_in(3, &vehicles),
        [" 2 3  5!  ", " ^ ^^ ^^6 ", "    4     "]
    );
}

fn marker_at(column: u16, id: VehicleId, marks: &str) -> Marker {
    let has_alert = marks.contains(ALERT);
    Marker {
        id,
        column,
        row: 1,
        sign: 'o',
        marks: marks.to_owned(),
        role: if has_alert { Role::Danger } else { Role::Muted },
        rank: if has_alert { 0 } else { USUAL_RANK },
    }
}

#[test]
fn the_sign_of_several_vehicles_shows_the_worst_state_of_those_that_it_hides() {
    let (look, area) = (Look::default(), Rect::new(0, 0, 12, 3));
    let mut buffer = Buffer::empty(area);
    let mut board = Board::new(Panel::new(&look, area), NumberSpots::Around, &mut buffer);
    let mut others = vec![marker_at(4, 2, ""), marker_at(4, 3, "!")];
    let chosen = Chosen::new(marker_at(4, 1, ""), &mut others);
    assert!(others.is_empty());
    put_chosen(&chosen, &mut board, &look);
    let group = chosen.group().expect("a group");
    list(&group, &mut board, &look);
    let row = |y| -> String { (0..12).map(|x| buffer[(x, y)].symbol()).collect() };
    assert_eq!(row(0), "   2-3      ");
    assert_eq!(row(1), "   [o1+2!]  ");
    let danger = look.style(Role::Danger).fg;
    assert_eq!(buffer[(8, 1)].style().fg, danger, "the mark");
    assert_ne!(buffer[(4, 1)].style().fg, danger, "the vehicle itself");
}
