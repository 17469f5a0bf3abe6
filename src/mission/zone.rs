//! Zones: areas with a meaning.

use super::Point;

/// An area with a meaning.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Zone {
    pub id: String,
    pub kind: ZoneKind,
    pub shape: Shape,
}

/// What a zone means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ZoneKind {
    /// Objectives refer to it.
    Task,
    /// Must not be left, nor flown above the ceiling.
    Geofence { ceiling_m: Option<f64> },
}

/// An area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    Polygon(Vec<Point>),
    Circle { center: Point, radius_m: f64 },
}

impl Shape {
    /// Whether a point lies inside (polygons by the even-odd rule).
    pub fn contains(&self, [x, y]: Point) -> bool {
        match self {
            Self::Circle { center, radius_m } => (x - center[0]).hypot(y - center[1]) <= *radius_m,
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

    /// The smallest upright rectangle around it: its south-west and north-east corners.
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
