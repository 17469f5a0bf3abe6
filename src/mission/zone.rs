//! Zones: areas with an effect on the mission.

use rand::RngExt;

use super::Point;
use super::report::distance_m;
use crate::geo::maths;

/// An area with an effect on the mission.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Zone {
    pub id: String,
    pub kind: ZoneKind,
    pub shape: Shape,
    /// Whether it is active from the start; events switch zones on and off.
    pub active: bool,
    /// The maximum distance by which the seed moves it on each axis, in metres.
    pub jitter_m: f64,
}

impl Zone {
    /// The zone at a position drawn from `random`.
    pub fn moved(&self, random: &mut impl RngExt) -> Self {
        let mut by = || random.random_range(-1.0..=1.0) * self.jitter_m;
        let [east_m, north_m] = [by(), by()];
        let moved = |[x, y]: &Point| [x + east_m, y + north_m];
        let shape = match &self.shape {
            Shape::Polygon(corners) => Shape::Polygon(corners.iter().map(moved).collect()),
            Shape::Circle { center, radius_m } => Shape::Circle {
                center: moved(center),
                radius_m: *radius_m,
            },
        };
        Self {
            shape,
            ..self.clone()
        }
    }
}

/// The effect of a zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ZoneKind {
    /// An area that objectives refer to.
    Task,
    /// Vehicles must stay inside, below the ceiling.
    Geofence {
        ceiling_m: Option<f64>,
    },
    /// Vehicles must stay out between these heights.
    NoFly {
        floor_m: f64,
        ceiling_m: f64,
    },
    /// Satellite navigation fails in it; within the edge around it, satellites drop out one by one.
    GnssJam {
        edge_m: f64,
    },
    /// Satellite navigation is off by this much to the east and north.
    GnssGlitch {
        offset_m: Point,
    },
    /// People are below: vehicles must stay above this height.
    People {
        below_m: f64,
    },
    /// Radio noise rises by this much in it; the effect falls off across the edge around it.
    RadioJam {
        noise_db: f64,
        edge_m: f64,
    },
    CommShadow(Shadow),
}

impl ZoneKind {
    /// The ceiling of a fence, in metres; `None` without a ceiling, and for other zones.
    pub fn fence_ceiling_m(self) -> Option<f64> {
        match self {
            Self::Geofence { ceiling_m } => ceiling_m,
            Self::Task
            | Self::NoFly { .. }
            | Self::GnssJam { .. }
            | Self::GnssGlitch { .. }
            | Self::People { .. }
            | Self::RadioJam { .. }
            | Self::CommShadow(_) => None,
        }
    }

    /// Whether it forbids flight at every height between two heights.
    pub fn forbids_all(self, low_m: f64, high_m: f64) -> bool {
        match self {
            Self::NoFly { floor_m, ceiling_m } => floor_m <= low_m && high_m <= ceiling_m,
            Self::Task
            | Self::Geofence { .. }
            | Self::GnssJam { .. }
            | Self::GnssGlitch { .. }
            | Self::People { .. }
            | Self::RadioJam { .. }
            | Self::CommShadow(_) => false,
        }
    }
}

/// How an area obstructs radio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shadow {
    /// A ridge of this height, with diffraction over its edge.
    Ridge { height_m: f64 },
    /// Walls or trees, with a loss for every node inside.
    Inside { loss_db: f64 },
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    Polygon(Vec<Point>),
    Circle { center: Point, radius_m: f64 },
}

/// Corners of the polygon that approximates a circle.
const ROUND: u32 = 24;

impl Shape {
    /// Whether a point lies inside (polygons by the even-odd rule).
    pub fn contains(&self, [x, y]: Point) -> bool {
        match self {
            Self::Circle { center, radius_m } => {
                maths::hypot(x - center[0], y - center[1]) <= *radius_m
            }
            Self::Polygon(corners) => {
                let mut inside = false;
                let mut previous = corners.last();
                for corner in corners {
                    if let Some(&[px, py]) = previous {
                        let [cx, cy] = *corner;
                        if (cy > y) != (py > y) && x < (px - cx) * (y - cy) / (py - cy) + cx {
                            inside = !inside;
                        }
                    }
                    previous = Some(corner);
                }
                inside
            }
        }
    }

    /// The distance from a point to the shape, in metres; zero inside.
    pub fn distance_m(&self, at: Point) -> f64 {
        match self {
            _ if self.contains(at) => 0.0,
            Self::Circle { center, radius_m } => {
                (maths::hypot(at[0] - center[0], at[1] - center[1]) - radius_m).max(0.0)
            }
            Self::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                let sides = corners.iter().zip(next);
                let distances = sides.map(|(&from, &to)| distance_to_side_m(at, from, to));
                distances.fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// The distance from a point to the farthest point of the shape.
    pub fn farthest_m(&self, from: Point) -> f64 {
        match self {
            Self::Polygon(corners) => {
                let far = corners.iter().map(|&corner| distance_m(from, corner));
                far.fold(0.0, f64::max)
            }
            Self::Circle { center, radius_m } => distance_m(from, *center) + radius_m,
        }
    }

    /// Its corners; for a circle, those of an approximating polygon.
    pub fn corners(&self) -> Vec<Point> {
        match self {
            Self::Polygon(corners) => corners.clone(),
            Self::Circle { center, radius_m } => {
                let corner = |at: u32| {
                    let turn = f64::from(at) / f64::from(ROUND) * std::f64::consts::TAU;
                    [
                        center[0] + radius_m * maths::sin(turn),
                        center[1] + radius_m * maths::cos(turn),
                    ]
                };
                (0..ROUND).map(corner).collect()
            }
        }
    }

    /// The smallest bounding rectangle: its south-west and north-east corners.
    pub fn bounds(&self) -> (Point, Point) {
        match self {
            Self::Circle {
                center: [x, y],
                radius_m: r,
            } => ([x - r, y - r], [x + r, y + r]),
            Self::Polygon(corners) => corners.iter().fold(
                ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]),
                |(low, high), corner| {
                    (
                        [low[0].min(corner[0]), low[1].min(corner[1])],
                        [high[0].max(corner[0]), high[1].max(corner[1])],
                    )
                },
            ),
        }
    }
}

/// The distance from a point to the line segment between two others.
pub(in crate::mission) fn distance_to_side_m(at: Point, from: Point, to: Point) -> f64 {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length_2 = dx * dx + dy * dy;
    let along = if length_2 > 0.0 {
        (((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / length_2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    maths::hypot(at[0] - from[0] - along * dx, at[1] - from[1] - along * dy)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng as _;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn distances_to_a_shape_are_those_to_its_nearest_side() {
        let square = Shape::Polygon(vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]);
        let circle = Shape::Circle {
            center: [5.0, 5.0],
            radius_m: 5.0,
        };
        for (at, to_square, to_circle) in [
            ([5.0, 5.0], 0.0, 0.0),
            ([15.0, 5.0], 5.0, 5.0),
            ([5.0, -3.0], 3.0, 3.0),
            ([13.0, 14.0], 5.0, 145f64.sqrt() - 5.0),
        ] {
            assert!((square.distance_m(at) - to_square).abs() < 1e-9, "{at:?}");
            assert!((circle.distance_m(at) - to_circle).abs() < 1e-9, "{at:?}");
        }
    }

    #[test]
    fn a_seed_moves_a_zone_by_its_jitter_at_most_and_as_a_whole() {
        let shape = Shape::Polygon(vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]);
        let zone = |jitter_m| Zone {
            id: "ridge".to_owned(),
            kind: ZoneKind::GnssJam { edge_m: 0.0 },
            shape: shape.clone(),
            active: true,
            jitter_m,
        };
        let mut random = ChaCha8Rng::seed_from_u64(1);
        assert_eq!(zone(0.0).moved(&mut random), zone(0.0));
        let mut places = Vec::new();
        for _ in 0..50 {
            let ([west, south], [east, north]) = zone(4.0).moved(&mut random).shape.bounds();
            assert!(west.abs() <= 4.0 && south.abs() <= 4.0, "{west} {south}");
            assert!((east - west - 10.0).abs() < 1e-9 && (north - south - 10.0).abs() < 1e-9);
            places.push(west);
        }
        assert!(places.iter().any(|&west| west > 2.0) && places.iter().any(|&west| west < -2.0));
    }
}
