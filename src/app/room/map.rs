//! The map: the area shown, the cursor, and the trails.

use std::collections::BTreeMap;

use crate::app::room_list::Room;
use crate::geo::{Dot, GridSize, LatLon, Viewport, Zoom};
use crate::vehicle::VehicleId;

pub(super) mod act;
mod overview;
mod samples;
mod scene;
mod trail;
mod watch;

pub use overview::Overview;
pub use samples::{SampleField, Samples};
pub use scene::{PAUSED, PYLON, Sketch, SketchKind, planned, shows_leg, sketches, wires};
pub use trail::Trail;
pub use watch::{began, heard, leg, measured, refit, tick};

/// The distances from the centre, in columns and in rows, that a followed vehicle may reach before
/// the map moves.
const LEASH_COLUMNS: f64 = 12.0;
const LEASH_ROWS: f64 = 4.0;
/// How far ahead of the vehicle the map is then centred, as a fraction of the distance that the
/// vehicle has moved.
const AHEAD: f64 = 0.7;

/// The minimum screen size with room for the legend.
const LEGEND_LEAST: GridSize = GridSize::new(110, 30);
/// Columns of the legend beside the canvas, with a gap.
pub const LEGEND_WIDTH: u16 = 35;
/// Rows of the screen above the canvas: the header, the title.
const ROWS_ABOVE: u16 = 2;
/// Rows of the screen outside the canvas: those above, the cursor's line, the footer.
const OTHER_ROWS: u16 = ROWS_ABOVE + 2;

/// The map's own state.
#[derive(Debug, Clone, Default)]
pub struct Map {
    /// Where the view is centred.
    pub(in crate::app) aim: Aim,
    /// The position of the cursor; `None` for the centre of the view.
    pub(in crate::app) cursor: Option<LatLon>,
    /// The start of the ruler.
    pub(in crate::app) mark: Option<LatLon>,
    /// Whether the user wants the legend; `None` leaves it to the size of the terminal.
    pub(in crate::app) legend: Option<bool>,
    /// Whether trails are hidden.
    pub(in crate::app) trails_hidden: bool,
    /// The index of the sensor drawn, modulo the number of sensors.
    pub(in crate::app) sensor: usize,
    pub(in crate::app) trails: BTreeMap<VehicleId, Trail>,
    pub(in crate::app) samples: Samples,
    /// The extent of everything on the map.
    pub(in crate::app) overview: Overview,
    /// The room from which the map was opened.
    pub(in crate::app) came_from: Room,
}

/// Where the view is centred: on everything, a place or a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Aim {
    /// Everything, at the scale that fits.
    #[default]
    All,
    /// A place, at a scale.
    Place(LatLon, Zoom),
    /// At or near the vehicle under the cursor, at a scale; the place is the centre of the view.
    Vehicle(LatLon, Zoom),
}

impl Map {
    /// Where the view is centred.
    pub fn aim(&self) -> Aim {
        self.aim
    }

    /// The position of the cursor; `None` for the centre of the view.
    pub fn cursor(&self) -> Option<LatLon> {
        self.cursor
    }

    /// The start of the ruler.
    pub fn mark(&self) -> Option<LatLon> {
        self.mark
    }

    /// Whether the user wants the legend; `None` leaves it to the size of the terminal.
    pub fn legend(&self) -> Option<bool> {
        self.legend
    }

    /// Whether trails are hidden.
    pub fn hides_trails(&self) -> bool {
        self.trails_hidden
    }

    pub fn trails(&self) -> &BTreeMap<VehicleId, Trail> {
        &self.trails
    }

    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The extent of everything on the map.
    pub fn overview(&self) -> &Overview {
        &self.overview
    }

    /// The map for the next session: readings and trails are dropped, and the user's settings stay.
    #[must_use]
    pub fn for_next_session(&self) -> Self {
        Self {
            legend: self.legend,
            trails_hidden: self.trails_hidden,
            came_from: self.came_from,
            ..Self::default()
        }
    }

    /// Restores the readings and trails of another time; the user's view stays.
    pub(in crate::app) fn remember(&mut self, then: Self) {
        self.trails = then.trails;
        self.samples = then.samples;
        self.overview = then.overview;
    }

    /// The viewport of a canvas; `None` while nothing has a position.
    pub fn view(&self, size: GridSize) -> Option<Viewport> {
        let (centre, zoom) = match self.aim {
            Aim::Place(centre, zoom) | Aim::Vehicle(centre, zoom) => (centre, zoom),
            Aim::All => {
                let frame = self.overview.frame()?;
                (frame.centre(), frame.zoom(size))
            }
        };
        Some(Viewport::new(centre, zoom, size))
    }

    /// The position under the cursor.
    pub fn pointed(&self, view: &Viewport) -> LatLon {
        let (column, row) = (i32::from(view.columns / 2), i32::from(view.rows / 2));
        self.cursor.unwrap_or_else(|| view.middle_of(column, row))
    }

    /// Moves the cursor by cells, from the centre if it is out of sight; the view scrolls when the cursor reaches its
    /// edge.
    pub fn step(&mut self, size: GridSize, right: i32, down: i32) {
        let Some(view) = self.view(size) else {
            return;
        };
        let (column, row) = self
            .cursor
            .and_then(|cursor| view.cell(cursor))
            .unwrap_or((view.columns / 2, view.rows / 2));
        let (column, row) = (i32::from(column) + right, i32::from(row) + down);
        self.cursor = Some(view.middle_of(column, row));
        let shift = (beyond(column, view.columns), beyond(row, view.rows));
        if shift != (0, 0) {
            let middle = Dot {
                x: f64::from(view.columns) + f64::from(shift.0) * 2.0,
                y: f64::from(view.rows * 2) + f64::from(shift.1) * 4.0,
            };
            self.aim = Aim::Place(view.place(middle), view.zoom);
        }
    }

    /// Puts the cursor on a cell of the screen, if the canvas covers it.
    pub fn click(&mut self, screen: GridSize, column: u16, row: u16) {
        let size = self.canvas(screen);
        let row = row.checked_sub(ROWS_ABOVE);
        if let (Some(view), Some(row)) = (self.view(size), row)
            && column < size.columns
            && row < size.rows
        {
            self.cursor = Some(view.middle_of(column.into(), row.into()));
        }
    }

    /// Zooms in or out; a followed vehicle, or otherwise the position under the cursor, stays in
    /// place on the screen.
    pub fn zoom(&mut self, size: GridSize, closer: bool) {
        let Some(view) = self.view(size) else {
            return;
        };
        let zoom = if closer {
            view.zoom.closer()
        } else {
            view.zoom.wider()
        };
        if let Aim::Vehicle(place, _) = self.aim {
            self.aim = Aim::Vehicle(place, zoom);
            return;
        }
        let fixed = self
            .cursor
            .filter(|&cursor| view.cell(cursor).is_some())
            .unwrap_or(view.centre);
        let (before, end) = (view.dot(fixed), view.end());
        let mut centre = view.centre;
        // A view's scale is that of its centre, which moves: the second iteration is exact to a fraction of a dot.
        for _ in 0..2 {
            let next = Viewport::new(centre, zoom, size);
            let then = next.dot(fixed);
            centre = next.place(Dot {
                x: end.x / 2.0 + then.x - before.x,
                y: end.y / 2.0 + then.y - before.y,
            });
        }
        self.aim = Aim::Place(centre, zoom);
    }

    /// Centres the view and the cursor on a place.
    pub fn centre_on(&mut self, size: GridSize, place: LatLon) {
        if let Some(view) = self.view(size) {
            self.aim = Aim::Place(place, view.zoom);
            self.cursor = Some(place);
        }
    }

    /// Follows a vehicle at this place, at the current scale.
    pub fn follow(&mut self, size: GridSize, place: LatLon) {
        if let Some(view) = self.view(size) {
            self.aim = Aim::Vehicle(place, view.zoom);
        }
    }

    /// Updates the followed vehicle's place. The view moves only once the vehicle is some cells
    /// away from the centre, and then to a point ahead of the vehicle.
    pub fn followed(&mut self, place: LatLon) {
        let Aim::Vehicle(stand, zoom) = self.aim else {
            return;
        };
        let (north_m, east_m) = stand.offset_to(place);
        let column_m = zoom.metres_per_column();
        let (across_m, down_m) = (LEASH_COLUMNS * column_m, LEASH_ROWS * 2.0 * column_m);
        if east_m.abs() > across_m || north_m.abs() > down_m {
            let ahead = |way_m: f64, most_m: f64| (way_m * AHEAD).clamp(-most_m, most_m);
            let stand = place.moved(
                ahead(north_m, down_m * AHEAD),
                ahead(east_m, across_m * AHEAD),
            );
            self.aim = Aim::Vehicle(stand, zoom);
        }
    }

    /// Whether the legend is shown on a screen of this size.
    pub fn shows_legend(&self, screen: GridSize) -> bool {
        let has_room = screen.columns >= LEGEND_LEAST.columns && screen.rows >= LEGEND_LEAST.rows;
        self.legend.unwrap_or(has_room)
    }

    /// The size of the room's canvas on a screen of this size.
    pub fn canvas(&self, screen: GridSize) -> GridSize {
        let legend = if self.shows_legend(screen) {
            LEGEND_WIDTH
        } else {
            0
        };
        GridSize {
            columns: screen.columns.saturating_sub(legend),
            rows: screen.rows.saturating_sub(OTHER_ROWS),
        }
    }

    /// The sensor drawn, by name, and its readings.
    pub fn field(&self) -> Option<(&str, &SampleField)> {
        let count = self.samples.fields().len();
        self.samples.fields().nth(self.sensor.checked_rem(count)?)
    }
}

/// The cells by which the view must scroll for a cursor at or beyond its edge: at least a third of
/// the view, and enough to bring the cursor back into it; otherwise 0.
fn beyond(at: i32, count: u16) -> i32 {
    let last = i32::from(count) - 1;
    let jump = (i32::from(count) / 3).max(1);
    if at < 1 {
        (at - 1).min(-jump)
    } else if at > last - 1 {
        (at - last + 1).max(jump)
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const HOME: LatLon = LatLon::new(50.45, 30.52);
    const SIZE: GridSize = GridSize::new(100, 30);

    fn map() -> Map {
        let mut map = Map::default();
        map.overview.see(HOME);
        map.overview.see(HOME.moved(200.0, 300.0));
        map
    }

    #[test]
    fn without_any_place_there_is_no_view_and_no_key_fails() {
        let mut map = Map::default();
        map.step(SIZE, 1, 0);
        map.zoom(SIZE, true);
        map.follow(SIZE, HOME);
        assert!(map.view(SIZE).is_none());
    }

    #[test]
    fn the_view_jumps_after_a_followed_vehicle_and_rests_in_between() {
        let mut map = map();
        map.follow(SIZE, HOME);
        let mut stands = vec![map.aim];
        for metre in 0..600 {
            let place = HOME.moved(0.0, f64::from(metre));
            map.followed(place);
            let view = map.view(SIZE).expect("a view");
            let (column, _) = view.cell(place).expect("in sight");
            assert!((30..70).contains(&column), "{column}");
            if stands.last() != Some(&map.aim) {
                stands.push(map.aim);
            }
        }
        let column_m = map.view(SIZE).expect("a view").zoom.metres_per_column();
        assert!(
            stands.len() as f64 <= 600.0 / (12.0 * column_m) + 2.0,
            "{}",
            stands.len()
        );
    }

    proptest! {
        #[test]
        fn the_cursor_is_always_in_sight_and_zooming_holds_it(
            steps in proptest::collection::vec((-40i32..40, -40i32..40, 0u8..4), 1..60),
        ) {
            let mut map = map();
            for (right, down, key) in steps {
                match key {
                    0 => map.step(SIZE, right.signum(), down.signum()),
                    1 => map.step(SIZE, right, down),
                    _ => {
                        let before = map.view(SIZE).expect("a view");
                        let cursor = map.pointed(&before);
                        map.cursor = Some(cursor);
                        let was = before.dot(cursor);
                        map.zoom(SIZE, key == 2);
                        let then = map.view(SIZE).expect("a view").dot(cursor);
                        prop_assert!((was.x - then.x).abs() < 0.6 && (was.y - then.y).abs() < 0.6);
                    }
                }
                let view = map.view(SIZE).expect("a view");
                let cursor = map.pointed(&view);
                prop_assert!(view.cell(cursor).is_some(), "{cursor:?} {view:?}");
            }
        }
    }
}
