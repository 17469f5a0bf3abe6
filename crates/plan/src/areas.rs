//! The areas of a fence: reading and checking a list.

use sortie_geo::LatLon;

use crate::{Item, command};

/// One area, with points on the earth or in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct FenceArea<P> {
    /// Whether the vehicle must stay inside the area rather than outside it.
    pub keeps_in: bool,
    /// The outline of the area.
    pub shape: AreaShape<P>,
}

/// The outline of an area.
#[derive(Debug, Clone, PartialEq)]
pub enum AreaShape<P> {
    /// At least three corners, in order.
    Polygon(Vec<P>),
    /// All points within a distance from the centre.
    Circle {
        /// The centre of the circle.
        centre: P,
        /// The distance in metres, more than 0.
        radius_m: f64,
    },
}

impl<P> FenceArea<P> {
    /// The same area with each point converted by `point`.
    pub fn map<Q>(&self, point: impl Fn(&P) -> Q) -> FenceArea<Q> {
        FenceArea {
            keeps_in: self.keeps_in,
            shape: match &self.shape {
                AreaShape::Polygon(corners) => {
                    AreaShape::Polygon(corners.iter().map(point).collect())
                }
                AreaShape::Circle { centre, radius_m } => AreaShape::Circle {
                    centre: point(centre),
                    radius_m: *radius_m,
                },
            },
        }
    }
}

impl<P: Copy + Into<[f64; 2]>> FenceArea<P> {
    /// Whether a vehicle at a point breaches this area; all points are in metres north and east.
    pub fn is_broken_at(&self, point: P) -> bool {
        match &self.shape {
            AreaShape::Polygon(corners) => is_inside(point, corners) != self.keeps_in,
            AreaShape::Circle { centre, radius_m } => {
                let ([north, east], [to_north, to_east]) = (point.into(), (*centre).into());
                let (north, east) = (to_north - north, to_east - east);
                let distance_m = (north * north + east * east).sqrt();
                if self.keeps_in {
                    distance_m > *radius_m
                } else {
                    distance_m < *radius_m
                }
            }
        }
    }
}

/// Whether a point lies inside a polygon: a ray towards the east crosses an odd number of edges.
pub fn is_inside<P: Copy + Into<[f64; 2]>>(point: P, corners: &[P]) -> bool {
    let [north, east] = point.into();
    let Some(mut from) = corners.last().map(|last| (*last).into()) else {
        return false;
    };
    let mut inside = false;
    for corner in corners {
        let to: [f64; 2] = (*corner).into();
        if (from[0] > north) != (to[0] > north) {
            let share = (north - from[0]) / (to[0] - from[0]);
            inside ^= east < from[1] + share * (to[1] - from[1]);
        }
        from = to;
    }
    inside
}

/// The fault of an invalid fence; its `Display` text is the vehicle's own message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FenceError {
    /// A polygon that states fewer than three corners.
    #[error("Invalid vertex count ({0})")]
    VertexCount(u8),
    /// Two corners of one polygon that state different counts.
    #[error("Unexpected vertex count want={wanted} got={got}\n")]
    OtherCount {
        /// The number of corners that the first corner states.
        wanted: u8,
        /// The number of corners that this item states.
        got: u8,
    },
    /// An item of another kind inside a polygon; the numbers are those of the vehicle's own item types.
    #[error("Received incorrect vertex type (want={wanted} got={got})")]
    OtherVertex {
        /// The type of the first corner.
        wanted: u8,
        /// The type of this item.
        got: u8,
    },
    /// A circle or a return point inside a polygon.
    #[error("Received incorrect type (want={wanted} got={got})")]
    OtherType {
        /// The type of the first corner.
        wanted: u8,
        /// The type of this item.
        got: u8,
    },
    /// A polygon whose last corners are missing.
    #[error("Incorrect item count")]
    ItemCount,
    /// A circle whose radius is not positive.
    #[error("Non-positive circle radius")]
    Radius,
    /// A second return point.
    #[error("Multiple return points")]
    ReturnPoints,
    /// A point that is not on the earth.
    #[error("Bad lat or lon")]
    Place,
}

/// The areas of a list.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fence {
    /// The areas, in the order of the list.
    pub areas: Vec<FenceArea<LatLon>>,
}

/// A polygon with missing corners.
struct Unfinished {
    command: u16,
    count: u8,
    corners: Vec<LatLon>,
}

impl Fence {
    /// Builds a fence from a list.
    ///
    /// # Errors
    /// The index and the fault of the first invalid item, in the vehicle's order. Commands that are
    /// not fence items are skipped; the upload has already refused them.
    pub fn check(items: &[Item]) -> Result<Self, (usize, FenceError)> {
        let mut fence = Self::default();
        let mut unfinished = None;
        let mut has_return = false;
        for (index, item) in items.iter().enumerate() {
            unfinished = fence
                .take(unfinished, item, &mut has_return)
                .map_err(|error| (index, error))?;
        }
        match unfinished {
            Some(_) => Err((items.len().saturating_sub(1), FenceError::ItemCount)),
            None => Ok(fence),
        }
    }

    /// Adds an item; returns the polygon if it needs more corners.
    fn take(
        &mut self,
        unfinished: Option<Unfinished>,
        item: &Item,
        has_return: &mut bool,
    ) -> Result<Option<Unfinished>, FenceError> {
        let Some(got) = own_type(item.command) else {
            return Ok(unfinished);
        };
        if command::is_corner(item.command) {
            return self.corner(unfinished, item);
        }
        if let Some(Unfinished { command, .. }) = &unfinished {
            let wanted = own_type(*command).unwrap_or_default();
            return Err(FenceError::OtherType { wanted, got });
        }
        if item.command != command::FENCE_RETURN_POINT {
            self.areas.push(circle(item)?);
        } else if std::mem::replace(has_return, true) {
            return Err(FenceError::ReturnPoints);
        } else {
            place(item)?;
        }
        Ok(None)
    }

    /// Adds a corner; returns the polygon if it needs more corners.
    fn corner(
        &mut self,
        unfinished: Option<Unfinished>,
        item: &Item,
    ) -> Result<Option<Unfinished>, FenceError> {
        let count = item.params[0] as u8;
        if count < 3 {
            return Err(FenceError::VertexCount(count));
        }
        let mut polygon = unfinished.unwrap_or(Unfinished {
            command: item.command,
            count,
            corners: Vec::new(),
        });
        if polygon.command != item.command {
            return Err(FenceError::OtherVertex {
                wanted: own_type(polygon.command).unwrap_or_default(),
                got: own_type(item.command).unwrap_or_default(),
            });
        }
        if polygon.count != count {
            return Err(FenceError::OtherCount {
                wanted: polygon.count,
                got: count,
            });
        }
        polygon.corners.push(place(item)?);
        if polygon.corners.len() < usize::from(count) {
            return Ok(Some(polygon));
        }
        self.areas.push(FenceArea {
            keeps_in: item.command == command::FENCE_POLYGON_INCLUSION,
            shape: AreaShape::Polygon(polygon.corners),
        });
        Ok(None)
    }
}

/// The number of an item's type in the vehicle's texts.
fn own_type(command: u16) -> Option<u8> {
    match command {
        command::FENCE_POLYGON_INCLUSION => Some(98),
        command::FENCE_POLYGON_EXCLUSION => Some(97),
        command::FENCE_RETURN_POINT => Some(95),
        command::FENCE_CIRCLE_EXCLUSION => Some(93),
        command::FENCE_CIRCLE_INCLUSION => Some(92),
        _ => None,
    }
}

fn place(item: &Item) -> Result<LatLon, FenceError> {
    let at = LatLon::from_e7(item.x, item.y);
    at.is_valid().then_some(at).ok_or(FenceError::Place)
}

fn circle(item: &Item) -> Result<FenceArea<LatLon>, FenceError> {
    let radius_m = f64::from(item.params[0]);
    if !(radius_m > 0.0 && radius_m.is_finite()) {
        return Err(FenceError::Radius);
    }
    Ok(FenceArea {
        keeps_in: item.command == command::FENCE_CIRCLE_INCLUSION,
        shape: AreaShape::Circle {
            centre: place(item)?,
            radius_m,
        },
    })
}
