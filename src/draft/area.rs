//! The areas that are drawn in a document, as outlines for surveys and searches.

use crate::geo::{LatLon, Outline};
use crate::plan::Document;
use crate::plan::generate::source;

/// The areas drawn in a document: the inclusion areas of its fence, otherwise the area that the places of its plan
/// enclose. An outline is one line, so a hole is joined to its area by a line that leads there and back.
pub fn drawn_areas(document: &Document) -> Vec<Outline> {
    let areas = source::areas(document).into_iter();
    areas
        .filter_map(|rings| {
            let mut rings = rings.into_iter();
            let outline = rings.next()?;
            Some(Outline::Polygon(
                rings.fold(outline, |line, hole| joined(line, &hole)),
            ))
        })
        .collect()
}

/// An outline with a hole, joined at the two corners that are closest to each other.
fn joined(outline: Vec<LatLon>, hole: &[LatLon]) -> Vec<LatLon> {
    let pairs = (0..outline.len()).flat_map(|at| (0..hole.len()).map(move |to| (at, to)));
    let way_m = |&(at, to): &(usize, usize)| outline[at].distance_m(hole[to]);
    let Some((at, to)) = pairs.min_by(|a, b| way_m(a).total_cmp(&way_m(b))) else {
        return outline;
    };
    let around = hole.iter().cycle().skip(to).take(hole.len() + 1);
    let mut line: Vec<LatLon> = outline[..=at].to_vec();
    line.extend(around);
    line.extend(&outline[at..]);
    line
}

/// The rings of an outline: the outline itself, and the holes that [`drawn_areas`] has joined to it.
pub fn rings(outline: &Outline) -> Vec<Vec<LatLon>> {
    let mut line = outline.corners();
    let mut holes = Vec::new();
    // A hole may have holes of its own, which lie within its stretch of the line, so the shortest
    // stretch comes first.
    while let Some((at, end)) = seam(&line) {
        holes.push(line[at + 1..end - 1].to_vec());
        line.drain(at + 1..=end);
    }
    std::iter::once(line).chain(holes).collect()
}

/// The shortest stretch of a line that leaves a place, goes around a hole and comes back the same
/// way: the indices of the places before and after it. `None` if there is no such stretch.
fn seam(line: &[LatLon]) -> Option<(usize, usize)> {
    /// The number of places in the smallest hole with its two seams.
    const LEAST: usize = 5;
    let is_seam =
        |(at, end): &(usize, usize)| line[*at] == line[*end] && line[at + 1] == line[end - 1];
    let ends = (LEAST..line.len())
        .flat_map(|length| (0..line.len() - length).map(move |at| (at, at + length)));
    ends.into_iter().find(is_seam)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::generate::{Course, Manner, Task, generate};
    use crate::plan::{Home, Item, command};

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    fn corners(command: u16, places: &[(f64, f64)]) -> Vec<Item> {
        let count = places.len() as f32;
        let item = |&(north_m, east_m): &(f64, f64)| {
            let (x, y) = HOME.moved(north_m, east_m).to_e7();
            Item {
                command,
                params: [count, 0.0, 0.0, 0.0],
                x,
                y,
                ..Item::default()
            }
        };
        places.iter().map(item).collect()
    }

    fn square(from_m: f64, to_m: f64) -> [(f64, f64); 4] {
        [
            (from_m, from_m),
            (from_m, to_m),
            (to_m, to_m),
            (to_m, from_m),
        ]
    }

    #[test]
    fn a_survey_of_an_area_with_a_hole_leaves_the_hole_out() {
        let mut document = Document {
            fence: corners(command::FENCE_POLYGON_INCLUSION, &square(0.0, 200.0)),
            ..Document::default()
        };
        document.fence.extend(corners(
            command::FENCE_POLYGON_EXCLUSION,
            &square(80.0, 120.0),
        ));
        let areas = drawn_areas(&document);
        let [Outline::Polygon(outline)] = &areas[..] else {
            panic!("one area: {areas:?}");
        };
        assert_eq!(outline.len(), 10);
        let found = rings(&areas[0]);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
        let (x, y) = HOME.to_e7();
        let task = Task::Survey {
            rings: found,
            spacing_m: 20.0,
            course: Course::Degrees(0.0),
        };
        let manner = Manner {
            height_m: 30.0,
            layer_m: 6.0,
            speed_m_s: None,
            fence: Vec::new(),
        };
        let plans = generate(&task, &[Home { x, y, z: 170.0 }], &manner).expect("a survey");
        let inside = |item: &&Item| {
            let (north_m, east_m) = HOME.offset_to(item.point());
            item.is_waypoint() && [north_m, east_m].iter().all(|m| (85.0..115.0).contains(m))
        };
        let plan = &plans.parts[0].document.plan;
        assert!(plan.len() > 20, "{} items", plan.len());
        assert_eq!(plan.iter().filter(inside).count(), 0);
    }

    #[test]
    fn the_holes_of_an_outline_are_found_again() {
        let mut document = Document {
            fence: corners(command::FENCE_POLYGON_INCLUSION, &square(0.0, 200.0)),
            ..Document::default()
        };
        for (from_m, to_m) in [(20.0, 40.0), (50.0, 70.0), (150.0, 180.0)] {
            let hole = corners(command::FENCE_POLYGON_EXCLUSION, &square(from_m, to_m));
            document.fence.extend(hole);
        }
        let expected = source::areas(&document).swap_remove(0);
        let found = rings(&drawn_areas(&document)[0]);
        assert_eq!(found.len(), 4);
        assert_eq!(found[0], expected[0]);
        for hole in &expected[1..] {
            let is_same = |ring: &Vec<LatLon>| {
                ring.len() == hole.len() && hole.iter().all(|it| ring.contains(it))
            };
            assert!(found[1..].iter().any(is_same), "{found:?}");
        }
    }

    #[test]
    fn the_places_of_a_plan_are_an_area_without_a_fence() {
        let document = Document {
            plan: corners(command::WAYPOINT, &square(0.0, 100.0)),
            ..Document::default()
        };
        assert_eq!(drawn_areas(&document).len(), 1);
        assert!(drawn_areas(&Document::default()).is_empty());
    }
}
