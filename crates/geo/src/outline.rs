//! Areas on the earth.

use super::LatLon;
use crate::maths;

/// The number of corners of the polygon that replaces a circle; enough to look round at any size on a screen.
const CIRCLE_CORNERS: u32 = 48;

/// The edge of an area.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// Corners in order; the last one is joined to the first.
    Polygon(Vec<LatLon>),
    /// All places at the same distance from the centre, measured along the ground.
    Circle {
        /// The centre, in degrees.
        centre: LatLon,
        /// The radius in metres.
        radius_m: f64,
    },
}

impl Outline {
    /// A square around `centre` with sides of `side_m` metres that run north and east.
    pub fn square(centre: LatLon, side_m: f64) -> Self {
        let half = side_m / 2.0;
        let corners = [(-half, -half), (-half, half), (half, half), (half, -half)];
        Self::Polygon(
            corners
                .map(|(north_m, east_m)| centre.moved(north_m, east_m))
                .to_vec(),
        )
    }

    /// The corners of the polygon, or of a polygon that approximates the circle.
    pub fn corners(&self) -> Vec<LatLon> {
        match self {
            Self::Polygon(corners) => corners.clone(),
            Self::Circle { centre, radius_m } => (0..CIRCLE_CORNERS)
                .map(|at| {
                    let turn = f64::from(at) / f64::from(CIRCLE_CORNERS) * std::f64::consts::TAU;
                    centre.moved(radius_m * maths::cos(turn), radius_m * maths::sin(turn))
                })
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_lie_where_the_outline_says() {
        let centre = LatLon::new(50.0, 30.0);
        for corner in Outline::square(centre, 20.0).corners() {
            let (north_m, east_m) = centre.offset_to(corner);
            assert!((north_m.abs() - 10.0).abs() < 1e-6 && (east_m.abs() - 10.0).abs() < 1e-6);
        }
        let circle = Outline::Circle {
            centre,
            radius_m: 300.0,
        };
        for corner in circle.corners() {
            assert!((centre.distance_m(corner) - 300.0).abs() < 1e-6);
        }
    }
}
