//! Patterns that cover an area or search around a place, on a plane: x is metres to the north, y to the east.

use glam::DVec2;
use sortie_geo::maths;

mod lanes;
mod search;

pub use lanes::{Lane, NoLanes, Strips, gaps_m, is_in_rings, lanes};
pub use search::{pieces, sector, square};

/// The unit vector of a course, degrees clockwise from north.
pub fn course(degrees: f64) -> DVec2 {
    let (sine, cosine) = maths::sin_cos(degrees.to_radians());
    DVec2::new(cosine, sine)
}

/// The distance between a point and a segment.
pub fn distance_to_segment(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let way = to - from;
    let length_squared = way.length_squared();
    let share = if length_squared > 0.0 {
        ((point - from).dot(way) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    point.distance(from + way * share)
}
