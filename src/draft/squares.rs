//! The squares of ground below a plan.

use crate::geo::{Extent, LatLon, Square};
use crate::plan::{Document, Item};

const MOST_SQUARES: usize = 36;

/// The squares that a plan crosses.
pub fn squares(document: &Document) -> Vec<Square> {
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let places = document.plan.iter().filter_map(Item::place);
    let Some(extent) = Extent::around(places.chain(home)) else {
        return Vec::new();
    };
    let [south_west, _, north_east, _] = extent.corners().map(Square::of);
    let squares = (south_west.lat..=north_east.lat)
        .flat_map(|lat| (south_west.lon..=north_east.lon).map(move |lon| Square { lat, lon }));
    squares.take(MOST_SQUARES).collect()
}
