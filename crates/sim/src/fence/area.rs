//! The areas of a fence: parsing and checking an upload, and whether a point is inside.

use glam::DVec2;
use mavlink::dialects::ardupilotmega::MavSeverity;

use crate::cmd;
use crate::plan::Item;
use sortie_geo::LatLon;

/// One area, with points on the earth or in metres.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FenceArea<P> {
    /// Whether the vehicle must stay inside it instead of outside.
    pub(crate) keeps_in: bool,
    pub(crate) shape: AreaShape<P>,
}

/// The outline of an area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum AreaShape<P> {
    /// At least three corners, in order.
    Polygon(Vec<P>),
    Circle {
        centre: P,
        radius_m: f64,
    },
}

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Fence {
    areas: Vec<FenceArea<LatLon>>,
}

/// The fault of an invalid fence, shown in the vehicle's own words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(crate) enum FenceError {
    /// A polygon that claims fewer than three corners.
    #[error("Invalid vertex count ({0})")]
    VertexCount(u8),
    /// Two corners of one polygon that claim different counts.
    #[error("Unexpected vertex count want={wanted} got={got}\n")]
    OtherCount { wanted: u8, got: u8 },
    /// An item of another kind inside a polygon; the numbers are those of the vehicle's own item types.
    #[error("Received incorrect vertex type (want={wanted} got={got})")]
    OtherVertex { wanted: u8, got: u8 },
    /// A circle or a return point inside a polygon.
    #[error("Received incorrect type (want={wanted} got={got})")]
    OtherType { wanted: u8, got: u8 },
    /// A polygon whose last corners are missing.
    #[error("Incorrect item count")]
    ItemCount,
    #[error("Non-positive circle radius")]
    Radius,
    #[error("Multiple return points")]
    ReturnPoints,
    #[error("Bad lat or lon")]
    Place,
}

impl FenceError {
    /// The severity of the vehicle's message.
    pub(crate) fn severity(self) -> MavSeverity {
        match self {
            Self::ItemCount => MavSeverity::MAV_SEVERITY_INFO,
            Self::VertexCount(_)
            | Self::OtherCount { .. }
            | Self::OtherVertex { .. }
            | Self::OtherType { .. }
            | Self::Radius
            | Self::ReturnPoints
            | Self::Place => MavSeverity::MAV_SEVERITY_WARNING,
        }
    }
}

/// A polygon with missing corners.
struct Unfinished {
    command: u16,
    count: u8,
    corners: Vec<LatLon>,
}

impl Fence {
    /// Builds a fence from an uploaded list.
    ///
    /// # Errors
    /// The first invalid item, in the vehicle's order. Commands that are not fence items are skipped; the upload has
    /// already refused them.
    pub(crate) fn check(items: &[Item]) -> Result<Self, FenceError> {
        let mut fence = Self::default();
        let mut unfinished = None;
        let mut returns = 0;
        for item in items {
            let Some(kind) = own_type(item.command) else {
                continue;
            };
            match item.command {
                cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION
                | cmd::NAV_FENCE_POLYGON_VERTEX_EXCLUSION => {
                    unfinished = fence.corner(unfinished.take(), item)?;
                    continue;
                }
                _ => {}
            }
            if let Some(Unfinished { command, .. }) = &unfinished {
                let wanted = own_type(*command).unwrap_or_default();
                return Err(FenceError::OtherType { wanted, got: kind });
            }
            if item.command == cmd::NAV_FENCE_RETURN_POINT {
                returns += 1;
                if returns > 1 {
                    return Err(FenceError::ReturnPoints);
                }
                place(item)?;
            } else {
                fence.areas.push(circle(item)?);
            }
        }
        match unfinished {
            Some(_) => Err(FenceError::ItemCount),
            None => Ok(fence),
        }
    }

    /// Adds a corner; returns the polygon if more corners belong to it.
    fn corner(
        &mut self,
        unfinished: Option<Unfinished>,
        item: &Item,
    ) -> Result<Option<Unfinished>, FenceError> {
        let count = item.p[0] as u8;
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
            keeps_in: item.command == cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION,
            shape: AreaShape::Polygon(polygon.corners),
        });
        Ok(None)
    }

    /// The areas in metres north and east of a place, polygons first and inclusions before exclusions: the order in
    /// which the vehicle checks them.
    pub(crate) fn in_metres(&self, from: LatLon) -> Vec<FenceArea<DVec2>> {
        let metres = |point: &LatLon| {
            let (north, east) = from.offset_to(*point);
            DVec2::new(north, east)
        };
        let mut areas: Vec<_> = self
            .areas
            .iter()
            .map(|area| FenceArea {
                keeps_in: area.keeps_in,
                shape: match &area.shape {
                    AreaShape::Polygon(corners) => {
                        AreaShape::Polygon(corners.iter().map(metres).collect())
                    }
                    AreaShape::Circle { centre, radius_m } => AreaShape::Circle {
                        centre: metres(centre),
                        radius_m: *radius_m,
                    },
                },
            })
            .collect();
        areas.sort_by_key(|area| {
            (
                matches!(area.shape, AreaShape::Circle { .. }),
                !area.keeps_in,
            )
        });
        areas
    }
}

impl FenceArea<DVec2> {
    /// Whether a vehicle at a point breaks the rule of this area.
    pub(crate) fn is_broken_at(&self, point: DVec2) -> bool {
        match &self.shape {
            AreaShape::Polygon(corners) => is_inside(point, corners) != self.keeps_in,
            AreaShape::Circle { centre, radius_m } => {
                let distance_m = point.distance(*centre);
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
pub(crate) fn is_inside(point: DVec2, corners: &[DVec2]) -> bool {
    let Some(mut from) = corners.last().copied() else {
        return false;
    };
    let mut inside = false;
    for &to in corners {
        if (from.x > point.x) != (to.x > point.x) {
            let share = (point.x - from.x) / (to.x - from.x);
            inside ^= point.y < from.y + share * (to.y - from.y);
        }
        from = to;
    }
    inside
}

/// The number of an item's type in the vehicle's texts.
fn own_type(command: u16) -> Option<u8> {
    match command {
        cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION => Some(98),
        cmd::NAV_FENCE_POLYGON_VERTEX_EXCLUSION => Some(97),
        cmd::NAV_FENCE_RETURN_POINT => Some(95),
        cmd::NAV_FENCE_CIRCLE_EXCLUSION => Some(93),
        cmd::NAV_FENCE_CIRCLE_INCLUSION => Some(92),
        _ => None,
    }
}

fn place(item: &Item) -> Result<LatLon, FenceError> {
    let at = LatLon::from_e7(item.x, item.y);
    at.is_valid().then_some(at).ok_or(FenceError::Place)
}

fn circle(item: &Item) -> Result<FenceArea<LatLon>, FenceError> {
    let radius_m = f64::from(item.p[0]);
    if !(radius_m > 0.0 && radius_m.is_finite()) {
        return Err(FenceError::Radius);
    }
    Ok(FenceArea {
        keeps_in: item.command == cmd::NAV_FENCE_CIRCLE_INCLUSION,
        shape: AreaShape::Circle {
            centre: place(item)?,
            radius_m,
        },
    })
}
