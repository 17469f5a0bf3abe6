//! Several seats at once: a tile for each.
//!
//! A tile does not show the seat's screen: a quarter of a terminal has room for a quarter of it only, and the trainee may
//! have another room open than the one that matters. It shows what the instructor compares instead, in the same places
//! for all seats: why the seat needs help, the figures, the true map, the objectives, and what was done last.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::detail::title;
use super::flight::FlightView;
use crate::app::State;
use crate::app::room::class::{TILE_COLUMNS, TilesPage};
use crate::class::{Desk, SeatRecord};
use crate::ui::panel::Panel;
use crate::ui::widget::below;

/// The width from which two tiles stand beside each other.
const BESIDE_FROM: u16 = 110;

pub fn draw(state: &State, desk: &Desk, page: &TilesPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let places = places(page.seats().len(), panel.area);
    let seats = page
        .seats()
        .iter()
        .filter_map(|&seat| desk.seats().get(seat));
    for (number, (place, seat)) in places.into_iter().zip(seats).enumerate() {
        let tile = panel.at(place);
        let inner = tile.focused(&heading(seat), number == page.selected(), buffer);
        let view = FlightView {
            desk,
            seat,
            now: state.wall(),
        };
        view.draw(tile.at(inner), buffer);
    }
}

/// The names of the seat and of the trainee, and the mission.
fn heading(seat: &SeatRecord) -> String {
    let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
    let mission = flight.and_then(|flight| flight.mission.as_ref());
    match mission {
        Some(mission) => format!("{}  {mission}", title(seat)),
        None => title(seat),
    }
}

/// The places of so many tiles, with a free column between those of a row.
fn places(count: usize, area: Rect) -> Vec<Rect> {
    let is_wide = count > 2 || area.width >= BESIDE_FROM;
    let columns = if is_wide {
        count.clamp(1, TILE_COLUMNS)
    } else {
        1
    };
    let rows = count.div_ceil(columns);
    let place = |number: usize| {
        let (row, column) = (number / columns, number % columns);
        let top = usize::from(area.height) * row / rows;
        let bottom = usize::from(area.height) * (row + 1) / rows;
        let left = usize::from(area.width) * column / columns;
        let right = usize::from(area.width) * (column + 1) / columns;
        let gap = usize::from(column + 1 < columns);
        Rect {
            x: area.x + left as u16,
            width: (right - left - gap) as u16,
            height: (bottom - top) as u16,
            ..below(area, top as u16)
        }
    };
    (0..count).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_fill_the_screen_without_touching() {
        for (columns, rows) in [(80, 22), (120, 38), (200, 48)] {
            let area = Rect::new(0, 1, columns, rows);
            for count in 1..=4 {
                let places = places(count, area);
                assert_eq!(places.len(), count);
                let cells: u32 = places.iter().map(|it| it.area()).sum();
                assert!(cells >= area.area() * 3 / 4 - u32::from(rows), "{places:?}");
                for (at, one) in places.iter().enumerate() {
                    assert_eq!(one.intersection(area), *one);
                    let others = places.iter().skip(at + 1);
                    assert!(others.clone().all(|other| !one.intersects(*other)));
                }
            }
        }
    }
}
