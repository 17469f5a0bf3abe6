//! The height of the ground from files of the Shuttle Radar Topography Mission (`.hgt`): squares of one degree with a
//! height every 1 or 3 arc seconds, in rows from north to south, each from west to east; two bytes each, big-endian, in
//! metres above mean sea level. The file is named after its south-west corner: `N50E030.hgt`.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::LatLon;

/// Points on a side at 1 arc second.
const FINE: usize = 3601;
/// Points on a side at 3 arc seconds.
const COARSE: usize = 1201;
/// The value that a file holds where no height was measured.
const VOID: i16 = -32_768;

/// A one-degree square, identified by the whole degrees of its south-west corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Square {
    /// Latitude of the south edge, in degrees.
    pub lat: i16,
    /// Longitude of the west edge, in degrees.
    pub lon: i16,
}

/// The error for a file whose length fits neither resolution; contains the length in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WrongSize(pub usize);

impl Square {
    /// The square in which a place lies.
    pub fn of(place: LatLon) -> Self {
        let degrees = |degrees: f64, most: i16| (degrees.floor() as i16).clamp(-most, most - 1);
        Self {
            lat: degrees(place.lat_deg, 90),
            lon: degrees(place.lon_deg, 180),
        }
    }

    /// The name of the square's file, such as `N50E030.hgt`.
    pub fn file_name(self) -> String {
        let north = if self.lat < 0 { 'S' } else { 'N' };
        let east = if self.lon < 0 { 'W' } else { 'E' };
        let (lat, lon) = (self.lat.unsigned_abs(), self.lon.unsigned_abs());
        format!("{north}{lat:02}{east}{lon:03}.hgt")
    }
}

#[derive(Debug, Clone, PartialEq)]
struct Grid {
    /// Points on a side.
    side: usize,
    heights_m: Vec<i16>,
}

impl Grid {
    fn read(bytes: &[u8]) -> Result<Self, WrongSize> {
        let side = [FINE, COARSE]
            .into_iter()
            .find(|side| side * side * 2 == bytes.len())
            .ok_or(WrongSize(bytes.len()))?;
        let pairs = bytes.chunks_exact(2);
        Ok(Self {
            side,
            heights_m: pairs
                .map(|two| i16::from_be_bytes([two[0], two[1]]))
                .collect(),
        })
    }

    /// The height interpolated between the four points around a place, given as fractions of a side
    /// from the square's south-west corner; `None` if one of the four was not measured.
    fn at(&self, north: f64, east: f64) -> Option<f64> {
        let last = self.side - 1;
        let (row, column) = ((1.0 - north) * last as f64, east * last as f64);
        let (top, left) = (
            (row.floor().max(0.0) as usize).min(last - 1),
            (column.floor().max(0.0) as usize).min(last - 1),
        );
        let (down, right) = (row - top as f64, column - left as f64);
        let corners = [
            (top, left, (1.0 - down) * (1.0 - right)),
            (top, left + 1, (1.0 - down) * right),
            (top + 1, left, down * (1.0 - right)),
            (top + 1, left + 1, down * right),
        ];
        let mut sum_m = 0.0;
        for (row, column, weight) in corners {
            if weight < 1e-9 {
                continue;
            }
            let height_m = *self.heights_m.get(row * self.side + column)?;
            if height_m == VOID {
                return None;
            }
            sum_m += weight * f64::from(height_m);
        }
        Some(sum_m)
    }
}

/// The ground of several squares. Cheap to clone: the heights are shared.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Terrain {
    squares: BTreeMap<Square, Arc<Grid>>,
}

impl Terrain {
    /// Adds the content of a square's file.
    ///
    /// # Errors
    /// The number of bytes matches neither resolution.
    pub fn add(&mut self, square: Square, bytes: &[u8]) -> Result<(), WrongSize> {
        self.squares.insert(square, Arc::new(Grid::read(bytes)?));
        Ok(())
    }

    /// Adds the squares of another terrain.
    pub fn join(&mut self, other: Self) {
        self.squares.extend(other.squares);
    }

    /// Whether the terrain has no squares.
    pub fn is_empty(&self) -> bool {
        self.squares.is_empty()
    }

    /// The height of the ground above mean sea level, in metres; `None` if no file covers the place
    /// or the height there was not measured.
    pub fn height_m(&self, place: LatLon) -> Option<f64> {
        let square = Square::of(place);
        let grid = self.squares.get(&square)?;
        let north = place.lat_deg - f64::from(square.lat);
        let east = place.lon_deg - f64::from(square.lon);
        grid.at(north, east)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Square = Square { lat: 50, lon: 30 };

    /// A square with heights computed from row and column.
    fn terrain(side: usize, height: impl Fn(usize, usize) -> i16) -> Terrain {
        let points = (0..side * side).map(|at| height(at / side, at % side));
        let bytes: Vec<u8> = points.flat_map(i16::to_be_bytes).collect();
        let mut terrain = Terrain::default();
        terrain.add(HERE, &bytes).expect("the right size");
        terrain
    }

    #[test]
    fn names_have_the_south_west_corner() {
        let name = |lat, lon| Square::of(LatLon::new(lat, lon)).file_name();
        assert_eq!(name(50.45, 30.52), "N50E030.hgt");
        assert_eq!(name(-0.5, -0.5), "S01W001.hgt");
        assert_eq!(name(-33.9, 151.2), "S34E151.hgt");
        assert_eq!(name(90.0, 180.0), "N89E179.hgt");
    }

    #[test]
    fn rows_run_from_north_to_south_and_columns_to_the_east() {
        for side in [COARSE, FINE] {
            let last = side - 1;
            // 0 at the north-western corner, 600 m lower in the south, 1200 m higher in the east.
            let ground = terrain(side, |row, column| {
                (column * 1200 / last) as i16 - (row * 600 / last) as i16
            });
            let at = |lat, lon| ground.height_m(LatLon::new(lat, lon)).expect("covered");
            assert!((at(50.0, 30.0) + 600.0).abs() < 1e-6);
            assert!((at(50.999_999, 30.0)).abs() < 1.1);
            assert!((at(50.5, 30.5) - 300.0).abs() < 1e-6, "{}", at(50.5, 30.5));
            assert!((at(50.25, 30.75) - 450.0).abs() < 1.1);
        }
    }

    #[test]
    fn between_points_the_height_changes_evenly() {
        let ground = terrain(COARSE, |row, column| ((row + column) % 2 * 100) as i16);
        let step = 1.0 / 1200.0;
        let at = |rows: f64, columns: f64| {
            let place = LatLon::new(50.0 + step * rows, 30.0 + step * columns);
            ground.height_m(place).expect("covered")
        };
        assert!((at(0.0, 0.5) - 50.0).abs() < 1e-6);
        assert!((at(0.5, 0.5) - 50.0).abs() < 1e-6);
        assert!((at(0.25, 0.0) - 25.0).abs() < 1e-6);
    }

    #[test]
    fn what_was_not_measured_has_no_height() {
        let ground = terrain(COARSE, |row, _| if row == 600 { VOID } else { 7 });
        let at = |lat| ground.height_m(LatLon::new(lat, 30.1));
        assert_eq!(at(50.5), None);
        assert_eq!(at(50.5 + 0.5 / 1200.0), None);
        assert_eq!(at(50.6).map(f64::round), Some(7.0));
        assert_eq!(ground.height_m(LatLon::new(51.5, 30.1)), None);
        let mut none = Terrain::default();
        assert_eq!(none.add(HERE, &[0; 100]), Err(WrongSize(100)));
    }
}
