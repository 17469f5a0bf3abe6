//! The shapes in a document from which tasks are made.

use sortie_geo::{LatLon, Outline};

use crate::areas::{AreaShape, Fence, FenceArea};
use crate::{Document, Item, command, is_inside};

/// The areas of a document, each as its outline and then its holes: the inclusion areas of its fence, with the
/// exclusion areas inside them as holes; without an inclusion area, the area within the places of its plan.
pub fn areas(document: &Document) -> Vec<Vec<Vec<LatLon>>> {
    let fence = Fence::check(&document.fence).unwrap_or_default();
    let (inside, outside): (Vec<_>, Vec<_>) = fence.areas.iter().partition(|it| it.keeps_in);
    let holes: Vec<Vec<LatLon>> = outside.into_iter().map(corners).collect();
    let areas = inside.into_iter().map(|area| {
        let outline = corners(area);
        let degrees = |at: &LatLon| [at.lat_deg, at.lon_deg];
        let edge: Vec<[f64; 2]> = outline.iter().map(degrees).collect();
        let within = |hole: &&Vec<LatLon>| {
            let first = hole.first().map(degrees);
            first.is_some_and(|first| is_inside(first, &edge))
        };
        let own = holes.iter().filter(within).cloned();
        std::iter::once(outline.clone()).chain(own).collect()
    });
    let mut areas: Vec<Vec<Vec<LatLon>>> = areas.collect();
    let way = line(document);
    if areas.is_empty() && way.len() >= 3 {
        areas.push(vec![way]);
    }
    areas
}

/// The items of the exclusion areas of a fence.
pub fn keep_out(fence: &[Item]) -> Vec<Item> {
    let forbids = |item: &&Item| {
        matches!(
            item.command,
            command::FENCE_POLYGON_EXCLUSION | command::FENCE_CIRCLE_EXCLUSION
        )
    };
    fence.iter().filter(forbids).copied().collect()
}

/// A fence, extended by the areas of `more` that it lacks.
#[must_use]
pub fn with_areas(mut fence: Vec<Item>, more: &[Item]) -> Vec<Item> {
    let mut left = more;
    while let Some(first) = left.first() {
        let count = if command::is_corner(first.command) {
            (first.params[0].max(1.0) as usize).min(left.len())
        } else {
            1
        };
        let (area, rest) = left.split_at(count);
        let is_same = |own: &[Item]| {
            let mut pairs = own.iter().zip(area);
            pairs.all(|(own, new)| {
                (own.command, own.x, own.y, own.params[0])
                    == (new.command, new.x, new.y, new.params[0])
            })
        };
        if !fence.windows(count).any(is_same) {
            fence.extend_from_slice(area);
        }
        left = rest;
    }
    fence
}

/// The holes of an area (its rings after the first) as exclusion areas of a fence.
pub fn holes(rings: &[Vec<LatLon>]) -> Vec<Item> {
    let corners = rings.iter().skip(1).flat_map(|hole| {
        hole.iter().map(|corner| {
            let (x, y) = corner.to_e7();
            Item {
                command: command::FENCE_POLYGON_EXCLUSION,
                auto_continue: true,
                params: [hole.len() as f32, 0.0, 0.0, 0.0],
                x,
                y,
                ..Item::default()
            }
        })
    });
    corners.collect()
}

fn corners(area: &FenceArea<LatLon>) -> Vec<LatLon> {
    match &area.shape {
        AreaShape::Polygon(corners) => corners.clone(),
        AreaShape::Circle { centre, radius_m } => {
            let (centre, radius_m) = (*centre, *radius_m);
            Outline::Circle { centre, radius_m }.corners()
        }
    }
}

/// The places of a document's plan, in order.
pub fn line(document: &Document) -> Vec<LatLon> {
    let items = document.plan.iter();
    items
        .filter(|item| !item.is_takeoff() && item.command != command::LAND)
        .filter(|item| item.is_waypoint())
        .map(crate::Item::point)
        .collect()
}

/// The single places of a document: its rally points.
pub fn places(document: &Document) -> Vec<LatLon> {
    document.rally.iter().map(crate::Item::point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, read};

    fn document(text: &str) -> Document {
        let loaded = read(text.as_bytes(), &ReadOptions::default());
        loaded.expect("a good file").document
    }

    #[test]
    fn polygons_with_holes_lines_and_points_are_found() {
        let found = document(
            r#"{"type": "GeometryCollection", "geometries": [
                {"type": "Polygon", "coordinates": [[[30, 50], [30.1, 50], [30.1, 50.1], [30, 50]],
                                                    [[30.06, 50.02], [30.07, 50.02], [30.07, 50.03], [30.06, 50.02]]]},
                {"type": "Polygon", "coordinates": [[[31, 50], [31.1, 50], [31.1, 50.1], [31, 50]]]},
                {"type": "LineString", "coordinates": [[30, 50], [30.2, 50]]},
                {"type": "Point", "coordinates": [30.5, 50.5]}]}"#,
        );
        let rings: Vec<usize> = areas(&found).iter().map(Vec::len).collect();
        assert_eq!(rings, [2, 1]);
        assert_eq!(line(&found).len(), 2);
        assert_eq!(places(&found).len(), 1);
    }

    #[test]
    fn a_plan_without_a_fence_is_an_outline() {
        let found = document(
            "QGC WPL 110\n\
             0\t1\t0\t16\t0\t0\t0\t0\t50\t30\t170\t1\n\
             1\t0\t3\t22\t0\t0\t0\t0\t50\t30\t20\t1\n\
             2\t0\t3\t16\t0\t0\t0\t0\t50.01\t30\t20\t1\n\
             3\t0\t3\t16\t0\t0\t0\t0\t50.01\t30.01\t20\t1\n\
             4\t0\t3\t16\t0\t0\t0\t0\t50.02\t30.01\t20\t1\n",
        );
        assert_eq!(areas(&found).len(), 1);
        assert_eq!(areas(&found)[0][0].len(), 3);
    }
}
