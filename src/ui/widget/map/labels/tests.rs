use ratatui::style::Modifier;

use super::*;
use crate::ui::look::Look;

const SIZE: GridSize = GridSize::new(80, 20);

fn label(column: u16, kind: LabelKind, text: &str) -> Label {
    Label {
        cell: (column, 0),
        kind,
        text: text.to_owned(),
        role: Role::Danger,
    }
}

#[test]
fn a_vehicle_leaves_no_piece_of_a_word() {
    let kept = |vehicle: u16| -> Vec<String> {
        let labels = vec![
            label(10, LabelKind::Word, "peak4"),
            label(20, LabelKind::Signed, "!c2"),
            label(30, LabelKind::Word, "H"),
        ];
        let kept = readable(labels, &[(vehicle, 0)], SIZE);
        kept.into_iter().rev().map(|label| label.text).collect()
    };
    assert_eq!(kept(41), ["peak4", "!c2", "H"]);
    assert_eq!(kept(9), ["!c2", "H"]);
    assert_eq!(kept(23), ["peak4", "!", "H"], "a sign says what is there");
    assert_eq!(kept(30), ["peak4", "!c2", "H"], "a sign is never in pieces");
}

#[test]
fn the_name_of_a_place_moves_away_from_what_covers_it() {
    let kept = |at: MapCell, target: MapCell, vehicle: MapCell| -> Vec<(MapCell, String)> {
        let place = Label {
            cell: at,
            ..label(0, LabelKind::Place, "+gate2")
        };
        let target = Label {
            cell: target,
            ..label(0, LabelKind::Word, "x")
        };
        let number = (vehicle.0 + 1, vehicle.1);
        let kept = readable(vec![place, target], &[vehicle, number], SIZE).into_iter();
        let names = kept.filter(|label| label.text != "x");
        names.map(|label| (label.cell, label.text)).collect()
    };
    let far = (0, 0);
    let of = |cell, text: &str| (cell, text.to_owned());
    let place = (10, 5);
    assert_eq!(kept(place, far, far), [of(place, "+gate2")]);
    assert_eq!(kept(place, place, far), [of((12, 5), "gate2")], "a target");
    let left = [of(place, "+"), of((4, 5), "gate2")];
    assert_eq!(kept(place, far, place), left, "a vehicle");
    let corner = (0, 5);
    let below = [of(corner, "+"), of((0, 6), "gate2")];
    assert_eq!(kept(corner, far, corner), below, "at the left edge");
    let two = |text: &str| Label {
        cell: place,
        ..label(0, LabelKind::Place, text)
    };
    let kept_of_two = readable(vec![two("+pad"), two("+pad1")], &[], SIZE);
    let texts: Vec<&str> = kept_of_two.iter().map(|it| it.text.as_str()).collect();
    assert_eq!(texts, ["+pad1"], "one place has one name");
    let edge = (77, 5);
    let left = [of(edge, "+"), of((71, 5), "gate2")];
    assert_eq!(kept(edge, far, far), left, "the edge of the map");
}

#[test]
fn the_name_of_a_place_leaves_the_marks_of_others_visible() {
    let place = |column, text| label(column, LabelKind::Place, text);
    let labels = vec![place(14, "+B"), place(10, "+depot")];
    let mut kept = readable(labels, &[], SIZE);
    kept.sort_by_key(|it| it.cell);
    let texts = kept.iter().map(|it| (it.cell, it.text.as_str()));
    let shown: Vec<_> = texts.collect();
    assert_eq!(shown, [((4, 0), "depot"), ((10, 0), "+"), ((14, 0), "+B")]);
}

#[test]
fn a_number_on_a_trail_never_stands_beside_a_name_or_a_vehicle() {
    let number = |column| label(column, LabelKind::Number, "3");
    let labels = vec![
        number(12),
        number(14),
        number(31),
        label(10, LabelKind::Signed, "c1"),
    ];
    let kept = readable(labels, &[(30, 0)], SIZE);
    let cells: Vec<u16> = kept.iter().map(|it| it.cell.0).collect();
    assert_eq!(cells, [10, 14]);
}

#[test]
fn a_sign_never_stands_beside_a_word() {
    let sign = |column, text| label(column, LabelKind::Signed, text);
    let labels = vec![sign(13, "?"), sign(14, "?"), sign(10, "!c2")];
    let kept = readable(labels, &[], SIZE);
    let texts: Vec<&str> = kept.iter().rev().map(|it| it.text.as_str()).collect();
    assert_eq!(texts, ["?", "!c2"]);
    assert_eq!(kept[1].cell, (14, 0));
}

#[test]
fn labels_in_one_place_are_spread_over_the_rows_around_it() {
    let at = |row| Label {
        cell: (10, row),
        ..label(10, LabelKind::Signed, "!1/2")
    };
    let rows = |labels, rows| -> Vec<u16> {
        let spread = spread(labels, rows).into_iter();
        spread.map(|label| label.cell.1).collect()
    };
    assert_eq!(rows(vec![at(5), at(5), at(5)], 20), [5, 6, 4]);
    assert_eq!(rows(vec![at(0), at(0), at(9)], 10), [0, 1, 9]);
}

#[test]
fn two_figures_side_by_side_do_not_make_one_number() {
    let kept = |kind| -> Vec<String> {
        let labels = [(10, "3"), (11, "5"), (20, "7")];
        let labels = labels.map(|(column, text)| label(column, kind, text));
        let kept = readable(labels.into(), &[], SIZE).into_iter().rev();
        kept.map(|label| label.text).collect()
    };
    assert_eq!(kept(LabelKind::Number), ["5", "7"]);
    assert_eq!(
        kept(LabelKind::Word),
        ["3", "5", "7"],
        "places of these names"
    );
}

#[test]
fn a_label_takes_no_style_from_below_and_no_figure_from_beside() {
    let look = Look::default();
    let area = Rect::new(0, 0, 8, 1);
    let mut buffer = Buffer::empty(area);
    let below = Style::new().add_modifier(Modifier::BOLD | Modifier::REVERSED);
    buffer.set_string(0, 0, "66666666", below);
    let panel = Panel::new(&look, area);
    draw(
        vec![label(2, LabelKind::Word, "A3")],
        &[],
        panel,
        &mut buffer,
    );
    let shown: String = buffer
        .content
        .iter()
        .map(ratatui::buffer::Cell::symbol)
        .collect();
    assert_eq!(shown, "6 A3 666");
    let style = look.style(Role::Text).patch(look.style(Role::Danger));
    for cell in &buffer.content[2..4] {
        assert_eq!(cell.modifier, style.add_modifier);
    }
}
