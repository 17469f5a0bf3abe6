//! The fence of a `.plan` file.

use serde::Serialize;

use super::{check_version, degrees};
use crate::fault::{Fault, FaultKind, Unwritable};
use crate::files::Parsed;
use crate::files::json::{Node, Value};
use crate::{Item, ListKind, command, frame};

/// Reads a fence: version 1 has a single inclusion polygon, and a return point without a height;
/// version 2 has any number of areas of both kinds.
pub(super) fn read(node: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    let point = given(node, "breachReturn");
    if check_version(node, &[1, 2], "1, 2")? == 1 {
        read_single(node, parsed)?;
        let Some(point) = point else {
            return Ok(());
        };
        let [lat, lon] = point.array::<2>()?;
        return read_return([lat, lon], 0.0, point, parsed);
    }
    read_areas(node, parsed)?;
    let Some(point) = point else {
        return Ok(());
    };
    let [lat, lon, height] = point.array::<3>()?;
    read_return([lat, lon], height.number_or_null()? as f32, point, parsed)
}

/// The value of a key, if it is present and not null.
fn given<'a>(node: &'a Node, key: &str) -> Option<&'a Node> {
    let value = node.get(key)?;
    (!matches!(value.value, Value::Null)).then_some(value)
}

/// Reads the polygon of version 1, if it has corners.
fn read_single(node: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    let outline = given(node, "polygon");
    match outline {
        Some(outline) if !outline.list()?.is_empty() => {
            read_corners(outline, command::FENCE_POLYGON_INCLUSION, parsed)
        }
        Some(_) | None => Ok(()),
    }
}

fn read_areas(node: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    for polygon in node.get("polygons").map_or(Ok(&[][..]), Node::list)? {
        read_polygon(polygon, parsed)?;
    }
    for circle in node.get("circles").map_or(Ok(&[][..]), Node::list)? {
        let shape = circle.need("circle")?;
        let [lat, lon] = shape.need("center")?.array::<2>()?;
        let command = if circle.need("inclusion")?.flag()? {
            command::FENCE_CIRCLE_INCLUSION
        } else {
            command::FENCE_CIRCLE_EXCLUSION
        };
        let radius = shape.need("radius")?.number()? as f32;
        let (x, y) = (lat.fixed(7)?, lon.fixed(7)?);
        let item = Item::of_fence(command, radius, x, y);
        parsed.push(ListKind::Fence, item, circle.span.clone());
    }
    Ok(())
}

/// Reads the return point; `height_m` is above home.
fn read_return(
    [lat, lon]: [&Node; 2],
    height_m: f32,
    point: &Node,
    parsed: &mut Parsed,
) -> Result<(), Fault> {
    let item = Item {
        frame: frame::ABOVE_HOME,
        z: height_m,
        ..Item::of_fence(
            command::FENCE_RETURN_POINT,
            0.0,
            lat.fixed(7)?,
            lon.fixed(7)?,
        )
    };
    parsed.push(ListKind::Fence, item, point.span.clone());
    Ok(())
}

fn read_polygon(polygon: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    let command = if polygon.need("inclusion")?.flag()? {
        command::FENCE_POLYGON_INCLUSION
    } else {
        command::FENCE_POLYGON_EXCLUSION
    };
    read_corners(polygon.need("polygon")?, command, parsed)
}

/// Reads the corners of a polygon; `command` is the one for its kind.
fn read_corners(outline: &Node, command: u16, parsed: &mut Parsed) -> Result<(), Fault> {
    let corners = outline.list()?;
    if corners.len() < 3 {
        return Err(Fault::new(
            outline.span.clone(),
            FaultKind::FewCorners(corners.len()),
        ));
    }
    for corner in corners {
        let [lat, lon] = corner.array::<2>()?;
        let (x, y) = (lat.fixed(7)?, lon.fixed(7)?);
        let item = Item::of_fence(command, corners.len() as f32, x, y);
        parsed.push(ListKind::Fence, item, corner.span.clone());
    }
    Ok(())
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct FenceBlock {
    #[serde(skip_serializing_if = "Option::is_none")]
    breach_return: Option<(f64, f64, f32)>,
    circles: Vec<CircleArea>,
    polygons: Vec<PolygonArea>,
    version: u8,
}

#[derive(Serialize)]
struct CircleArea {
    circle: Circle,
    inclusion: bool,
    version: u8,
}

#[derive(Serialize)]
struct Circle {
    center: (f64, f64),
    radius: f32,
}

#[derive(Serialize)]
struct PolygonArea {
    inclusion: bool,
    polygon: Vec<(f64, f64)>,
    version: u8,
}

/// The fence as the file stores it.
///
/// # Errors
/// Items that belong to no complete area, or a second return point.
pub(super) fn block(items: &[Item]) -> Result<FenceBlock, Unwritable> {
    let mut block = FenceBlock {
        breach_return: None,
        circles: Vec::new(),
        polygons: Vec::new(),
        version: 2,
    };
    let mut at = 0;
    while let Some(first) = items.get(at) {
        let place = |item: &Item| (degrees(item.x), degrees(item.y));
        if command::is_corner(first.command) {
            let count = first.params[0] as usize;
            let corners = items.get(at..at + count).unwrap_or_default();
            let is_whole = corners.iter().all(|corner| {
                corner.command == first.command
                    && corner.params[0].to_bits() == first.params[0].to_bits()
            });
            if corners.len() < 3 || !is_whole {
                return Err(Unwritable::FenceShape(at));
            }
            block.polygons.push(PolygonArea {
                inclusion: first.command == command::FENCE_POLYGON_INCLUSION,
                polygon: corners.iter().map(place).collect(),
                version: 1,
            });
            at += count;
            continue;
        }
        if command::is_circle(first.command) && first.params[0].is_finite() {
            block.circles.push(CircleArea {
                circle: Circle {
                    center: place(first),
                    radius: first.params[0],
                },
                inclusion: first.command == command::FENCE_CIRCLE_INCLUSION,
                version: 1,
            });
        } else if first.command == command::FENCE_RETURN_POINT && block.breach_return.is_none() {
            let (lat, lon) = place(first);
            block.breach_return = Some((lat, lon, first.z));
        } else {
            return Err(Unwritable::FenceShape(at));
        }
        at += 1;
    }
    Ok(block)
}
