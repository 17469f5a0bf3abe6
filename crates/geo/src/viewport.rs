//! A part of the earth on a grid of character cells: converts places to the dots and cells of a
//! map, and back.
//!
//! A cell is assumed to be twice as high as it is wide and holds two by four dots, those of a
//! braille pattern, so a dot is square. Places are projected onto a plane that touches the earth at
//! the middle of the view. Both directions use the same scale, so a place and its dot correspond
//! exactly.

use super::{LatLon, LocalFrame};
use crate::maths;

/// Dots in a cell, side by side.
pub const DOTS_ACROSS: u16 = 2;
/// Dots in a cell, one above the other.
pub const DOTS_DOWN: u16 = 4;

/// Widths of a column in metres within a decade: the Renard series R10, rounded.
const STEPS: [f64; 10] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.4, 8.0];
/// Steps of the series per key press.
const STRIDE: i8 = 2;

/// The width of a column on the ground, from a fixed series, so that a fitted view does not change with every metre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Zoom(i8);

impl Zoom {
    /// The closest view: a column is 0.1 m wide.
    pub const CLOSEST: Self = Self(-10);
    /// The widest view: a column is 4 km wide.
    pub const WIDEST: Self = Self(36);

    /// The width of a column, in metres.
    pub fn metres_per_column(self) -> f64 {
        let steps = STEPS.len() as i32;
        let at = i32::from(self.0);
        STEPS[at.rem_euclid(steps) as usize] * maths::powi(10f64, at.div_euclid(steps))
    }

    /// The closest view with columns of at least this width.
    pub fn fitting(metres_per_column: f64) -> Self {
        let fits = |at: &i8| Self(*at).metres_per_column() >= metres_per_column * (1.0 - 1e-9);
        let found = (Self::CLOSEST.0..=Self::WIDEST.0).find(fits);
        found.map_or(Self::WIDEST, Self)
    }

    /// One step closer, within the limits.
    #[must_use]
    pub fn closer(self) -> Self {
        Self(self.0 - STRIDE).max(Self::CLOSEST)
    }

    /// One step wider, within the limits.
    #[must_use]
    pub fn wider(self) -> Self {
        Self(self.0 + STRIDE).min(Self::WIDEST)
    }
}

/// Columns and rows of a grid of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GridSize {
    /// Cells side by side.
    pub columns: u16,
    /// Cells one above the other.
    pub rows: u16,
}

impl GridSize {
    /// A grid of `columns` times `rows` cells.
    pub const fn new(columns: u16, rows: u16) -> Self {
        Self { columns, rows }
    }
}

/// A position in a view, in dots from its upper left corner; may be fractional.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dot {
    /// Dots from the left edge, to the right.
    pub x: f64,
    /// Dots from the top, downwards.
    pub y: f64,
}

impl Dot {
    /// A point `x` dots to the right and `y` dots down.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The point at a share of the way to another point: 0 gives `self`, 1 gives `to`.
    #[must_use]
    pub fn towards(self, to: Self, share: f64) -> Self {
        Self {
            x: self.x + (to.x - self.x) * share,
            y: self.y + (to.y - self.y) * share,
        }
    }
}

/// The area that a grid of cells shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewport {
    /// The place in the middle.
    pub centre: LatLon,
    /// The width of a column.
    pub zoom: Zoom,
    /// Cells side by side.
    pub columns: u16,
    /// Cells one above the other.
    pub rows: u16,
    dots_per_deg_north: f64,
    dots_per_deg_east: f64,
}

impl Viewport {
    /// A view of a place and its surroundings.
    pub fn new(centre: LatLon, zoom: Zoom, size: GridSize) -> Self {
        let dots_per_m = f64::from(DOTS_ACROSS) / zoom.metres_per_column();
        let (north, east) = centre.metres_per_degree();
        Self {
            centre,
            zoom,
            columns: size.columns,
            rows: size.rows,
            dots_per_deg_north: north * dots_per_m,
            dots_per_deg_east: east * dots_per_m,
        }
    }

    /// The width and height of a dot, in metres.
    pub fn metres_per_dot(&self) -> f64 {
        self.zoom.metres_per_column() / f64::from(DOTS_ACROSS)
    }

    /// The lower right corner: one dot beyond the last column and the last row.
    pub fn end(&self) -> Dot {
        Dot {
            x: f64::from(self.columns) * f64::from(DOTS_ACROSS),
            y: f64::from(self.rows) * f64::from(DOTS_DOWN),
        }
    }

    /// The dot of a place, which may lie outside the view.
    pub fn dot(&self, place: LatLon) -> Dot {
        let end = self.end();
        let mut east_deg = place.lon_deg - self.centre.lon_deg;
        if east_deg > 180.0 {
            east_deg -= 360.0;
        } else if east_deg < -180.0 {
            east_deg += 360.0;
        }
        let north_deg = place.lat_deg - self.centre.lat_deg;
        Dot {
            x: end.x / 2.0 + east_deg * self.dots_per_deg_east,
            y: end.y / 2.0 - north_deg * self.dots_per_deg_north,
        }
    }

    /// The place under a dot.
    pub fn place(&self, dot: Dot) -> LatLon {
        let end = self.end();
        let lon = self.centre.lon_deg + (dot.x - end.x / 2.0) / self.dots_per_deg_east;
        let lat = self.centre.lat_deg - (dot.y - end.y / 2.0) / self.dots_per_deg_north;
        LatLon::new(
            lat.clamp(-90.0, 90.0),
            (lon + 180.0).rem_euclid(360.0) - 180.0,
        )
    }

    /// The cell of a place, column and row; `None` outside the view.
    pub fn cell(&self, place: LatLon) -> Option<(u16, u16)> {
        let (Dot { x, y }, end) = (self.dot(place), self.end());
        let inside = (0.0..end.x).contains(&x) && (0.0..end.y).contains(&y);
        let cell = (
            (x / f64::from(DOTS_ACROSS)) as u16,
            (y / f64::from(DOTS_DOWN)) as u16,
        );
        inside.then_some(cell)
    }

    /// The place in the middle of a cell, which may lie outside the view.
    pub fn middle_of(&self, column: i32, row: i32) -> LatLon {
        self.place(Dot {
            x: (f64::from(column) + 0.5) * f64::from(DOTS_ACROSS),
            y: (f64::from(row) + 0.5) * f64::from(DOTS_DOWN),
        })
    }
}

/// A rectangle on the earth with sides that run north and east, in metres around a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    frame: LocalFrame,
    /// The south-west corner: metres east and north.
    low_m: [f64; 2],
    /// The north-east corner: metres east and north.
    high_m: [f64; 2],
}

impl Extent {
    /// An extent of zero size at a place, for [`Self::include`] to enlarge.
    pub fn at(place: LatLon) -> Self {
        Self {
            frame: LocalFrame::at(place),
            low_m: [0.0; 2],
            high_m: [0.0; 2],
        }
    }

    /// The smallest extent that contains all places; `None` without places.
    pub fn around(places: impl IntoIterator<Item = LatLon>) -> Option<Self> {
        let mut places = places.into_iter();
        let mut extent = Self::at(places.next()?);
        places.for_each(|place| extent.include(place));
        Some(extent)
    }

    /// Enlarges the extent just enough to contain a place.
    pub fn include(&mut self, place: LatLon) {
        let [east_m, north_m] = self.offset(place);
        let ([west, south], [east, north]) = (self.low_m, self.high_m);
        self.low_m = [west.min(east_m), south.min(north_m)];
        self.high_m = [east.max(east_m), north.max(north_m)];
    }

    /// Whether a place lies inside or on the edge.
    pub fn contains(&self, place: LatLon) -> bool {
        let at = self.offset(place);
        (0..2).all(|axis| (self.low_m[axis]..=self.high_m[axis]).contains(&at[axis]))
    }

    /// The extent, enlarged on every side by a share of its size, but by at least `least_m`.
    #[must_use]
    pub fn with_margin(mut self, share: f64, least_m: f64) -> Self {
        let size = self.size_m();
        for (axis, size_m) in size.into_iter().enumerate() {
            let margin_m = (size_m * share).max(least_m);
            self.low_m[axis] -= margin_m;
            self.high_m[axis] += margin_m;
        }
        self
    }

    /// Metres from west to east and from south to north.
    pub fn size_m(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high_m[axis] - self.low_m[axis])
    }

    /// The corners of the extent, counterclockwise from the south-west one.
    pub fn corners(&self) -> [LatLon; 4] {
        let ([west, south], [east, north]) = (self.low_m, self.high_m);
        [(south, west), (south, east), (north, east), (north, west)]
            .map(|(north_m, east_m)| self.frame.origin().moved(north_m, east_m))
    }

    /// The place in the middle of the extent.
    pub fn centre(&self) -> LatLon {
        let [east_m, north_m] = [0, 1].map(|axis| self.low_m[axis].midpoint(self.high_m[axis]));
        self.frame.origin().moved(north_m, east_m)
    }

    /// The closest zoom at which a grid of this size shows the whole extent.
    pub fn zoom(&self, size: GridSize) -> Zoom {
        let [east_m, north_m] = self.size_m();
        let per_row = f64::from(DOTS_DOWN / DOTS_ACROSS);
        let columns = f64::from(size.columns.max(1));
        let rows = f64::from(size.rows.max(1));
        // Half a cell is left free on each side, so that places on the edge are visible.
        let across = east_m / (columns - 1.0).max(0.5);
        let down = north_m / (rows - 1.0).max(0.5) / per_row;
        Zoom::fitting(across.max(down))
    }

    fn offset(&self, place: LatLon) -> [f64; 2] {
        let (north_m, east_m) = self.frame.offset_to(place);
        [east_m, north_m]
    }
}

/// The longest round length in metres (1, 2 or 5 times a power of ten) that a scale bar of at most `most_columns` can
/// show, and the bar's width in columns.
pub fn scale_bar(zoom: Zoom, most_columns: u16) -> (f64, u16) {
    let column_m = zoom.metres_per_column();
    let most_m = column_m * f64::from(most_columns.max(1));
    let decade = maths::powf(10f64, maths::log10(most_m).floor());
    let rounds = [10.0, 5.0, 2.0, 1.0].map(|step| step * decade);
    let fits = |length: &f64| *length <= most_m * (1.0 + 1e-9);
    let length_m = rounds.into_iter().find(fits).unwrap_or(decade);
    (length_m, (length_m / column_m).round().max(1.0) as u16)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn zooms() -> impl Strategy<Value = Zoom> {
        (Zoom::CLOSEST.0..=Zoom::WIDEST.0).prop_map(Zoom)
    }

    #[test]
    fn the_largest_grid_has_cells_too() {
        let size = GridSize::new(u16::MAX, u16::MAX);
        let centre = LatLon::new(50.45, 30.52);
        let view = Viewport::new(centre, Zoom::CLOSEST, size);
        assert_eq!(view.cell(centre), Some((u16::MAX / 2, u16::MAX / 2)));
    }

    proptest! {
        #[test]
        fn a_dot_and_its_place_belong_together(
            lat in -80.0..80.0f64, lon in -180.0..180.0f64,
            step in -10i8..26, x in 0.0..240.0f64, y in 0.0..160.0f64,
        ) {
            let view = Viewport::new(LatLon::new(lat, lon), Zoom(step), GridSize::new(120, 40));
            let Dot { x: back_x, y: back_y } = view.dot(view.place(Dot { x, y }));
            prop_assert!((back_x - x).abs() < 1e-3 && (back_y - y).abs() < 1e-3, "{back_x} {back_y}");
        }

        #[test]
        fn a_cell_holds_its_own_middle(step in -10i8..26, column in 0u16..120, row in 0u16..40) {
            let view = Viewport::new(LatLon::new(50.0, 30.0), Zoom(step), GridSize::new(120, 40));
            let middle = view.middle_of(i32::from(column), i32::from(row));
            prop_assert_eq!(view.cell(middle), Some((column, row)));
        }

        #[test]
        fn what_is_fitted_is_seen_and_not_tiny(
            places in proptest::collection::vec((-3000.0..3000.0f64, -3000.0..3000.0f64), 2..20),
            columns in 20u16..200, rows in 8u16..60,
        ) {
            let home = LatLon::new(50.45, 30.52);
            let places: Vec<LatLon> = places.into_iter().map(|(n, e)| home.moved(n, e)).collect();
            let extent = Extent::around(places.iter().copied()).expect("places");
            let size = GridSize::new(columns, rows);
            let zoom = extent.zoom(size);
            let view = Viewport::new(extent.centre(), zoom, size);
            for place in &places {
                prop_assert!(view.cell(*place).is_some(), "{place:?} is outside {view:?}");
            }
            // One step closer, it would no longer fit.
            let closer = Zoom(zoom.0 - 1).metres_per_column();
            let [east_m, north_m] = extent.size_m();
            let fits = east_m <= closer * f64::from(columns - 1)
                && north_m <= closer * 2.0 * f64::from(rows - 1);
            prop_assert!(!fits || zoom == Zoom::CLOSEST);
        }

        #[test]
        fn the_scale_bar_is_round_and_fits(zoom in zooms(), most in 8u16..60) {
            let (length_m, columns) = scale_bar(zoom, most);
            prop_assert!((1..=most).contains(&columns));
            prop_assert!(columns * 3 >= most, "{columns} of {most} is too short to read");
            let digits = length_m / maths::powf(10f64, maths::log10(length_m).floor() + 1e-12);
            let round = [1.0, 2.0, 5.0, 10.0].iter().any(|step| (digits - step).abs() < 1e-6);
            prop_assert!(round, "{length_m}");
        }
    }

    #[test]
    fn every_step_of_the_zoom_is_wider_than_the_one_before() {
        let mut zoom = Zoom::CLOSEST;
        assert!((zoom.metres_per_column() - 0.1).abs() < 1e-12);
        while zoom != Zoom::WIDEST {
            assert!(zoom.wider().metres_per_column() > zoom.metres_per_column() * 1.5);
            assert_eq!(zoom.wider().closer(), zoom);
            assert_eq!(Zoom::fitting(zoom.metres_per_column()), zoom);
            zoom = zoom.wider();
        }
        assert_eq!(zoom.wider(), zoom);
        assert!((zoom.metres_per_column() - 4_000.0).abs() < 1e-6);
    }

    #[test]
    fn north_is_up_and_east_is_right_across_the_date_line() {
        let view = Viewport::new(
            LatLon::new(0.0, 179.999),
            Zoom::fitting(10.0),
            GridSize::new(100, 40),
        );
        let Dot { x, y } = view.dot(view.centre.moved(100.0, 250.0));
        assert!(
            (x - 150.0).abs() < 0.01 && (y - 60.0).abs() < 0.01,
            "{x} {y}"
        );
    }
}
