//! Parallel lines that cover an area.

use std::ops::Range;

use glam::DVec2;

use super::course;

/// The maximum number of lines; a larger number is probably a typing error.
const MOST_LANES: usize = 1000;
/// Areas narrower than this in every direction, in metres, cannot be covered.
const LEAST_EXTENT_M: f64 = 0.5;
/// The tolerance that keeps rounding from adding a line.
const SLACK: f64 = 1e-6;

/// One line over an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lane {
    /// Where the lane begins: north and east of the origin, in metres.
    pub from: DVec2,
    /// Where the lane ends: north and east of the origin, in metres.
    pub to: DVec2,
}

impl Lane {
    /// The length of the lane, in metres.
    pub fn length_m(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// The same line in the opposite direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self {
            from: self.to,
            to: self.from,
        }
    }
}

/// Why an area cannot be covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoLanes {
    /// The area has no extent.
    Empty,
    /// The area needs more lines than this maximum.
    TooMany(usize),
}

/// An area cut into strips of equal width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strips {
    along: DVec2,
    low: f64,
    step: f64,
    count: usize,
}

impl Strips {
    /// Strips at most `spacing_m` wide. Without a course they run along the edge for which the
    /// fewest are needed.
    ///
    /// # Errors
    /// The area has no extent, or needs too many strips.
    pub fn over(
        corners: &[DVec2],
        spacing_m: f64,
        course_deg: Option<f64>,
    ) -> Result<Self, NoLanes> {
        let along = match course_deg {
            Some(degrees) => course(degrees),
            None => narrowest(corners).ok_or(NoLanes::Empty)?,
        };
        let (low, high) = range(corners.iter().map(|corner| corner.dot(along.perp())));
        let width = high - low;
        let (start, end) = range(corners.iter().map(|corner| corner.dot(along)));
        if corners.len() < 3 || width.max(end - start) < LEAST_EXTENT_M {
            return Err(NoLanes::Empty);
        }
        let count = (width / spacing_m - SLACK).ceil().max(1.0);
        if count > MOST_LANES as f64 {
            return Err(NoLanes::TooMany(MOST_LANES));
        }
        Ok(Self {
            along,
            low,
            step: width / count,
            count: count as usize,
        })
    }

    /// The number of strips.
    pub const fn count(&self) -> usize {
        self.count
    }

    /// The direction of the strips.
    pub const fn along(&self) -> DVec2 {
        self.along
    }

    /// The direction from the first strip to the last.
    pub fn across(&self) -> DVec2 {
        self.along.perp()
    }

    fn strip(&self, index: usize) -> Range<f64> {
        let from = self.low + self.step * index as f64;
        from..from + self.step
    }

    /// The middle of a strip between two distances along it.
    fn lane(&self, index: usize, start: f64, end: f64) -> Lane {
        let strip = self.strip(index);
        let middle = self.across() * f64::midpoint(strip.start, strip.end);
        Lane {
            from: middle + self.along * start,
            to: middle + self.along * end,
        }
    }

    /// The lines of each strip, wherever any part of the strip is in an area with holes; gaps up to
    /// `shortest_gap_m` are flown over.
    pub fn lines(&self, rings: &[Vec<DVec2>], shortest_gap_m: f64) -> Vec<Vec<Lane>> {
        let of_strip = |index: usize| {
            let parts = parts(rings, self, index).into_iter();
            let mut lines: Vec<(f64, f64)> = Vec::new();
            for (start, end) in parts {
                match lines.last_mut() {
                    Some(last) if start - last.1 <= shortest_gap_m => last.1 = end,
                    Some(_) | None => lines.push((start, end)),
                }
            }
            let lane = |(start, end)| self.lane(index, start, end);
            lines.into_iter().map(lane).collect()
        };
        (0..self.count).map(of_strip).collect()
    }
}

/// The parts of a strip in which it touches an area, as distances along it.
fn parts(rings: &[Vec<DVec2>], strips: &Strips, index: usize) -> Vec<(f64, f64)> {
    let strip = strips.strip(index);
    let (along, across) = (strips.along, strips.across());
    let edges = rings
        .iter()
        .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let edges: Vec<(f64, f64)> = edges
        .filter_map(|(from, to)| {
            let ends = clipped([*from, *to], across, &strip)?;
            Some(range(ends.iter().map(|end| end.dot(along))))
        })
        .collect();
    let mut marks: Vec<f64> = edges.iter().flat_map(|edge| [edge.0, edge.1]).collect();
    marks.sort_by(f64::total_cmp);
    let middle = across * f64::midpoint(strip.start, strip.end);
    let between = marks.windows(2).filter_map(|pair| {
        let at = f64::midpoint(pair[0], pair[1]);
        // Between two marks there are edges everywhere or nowhere; without edges, the strip is all inside or all
        // outside.
        let on_edge = edges.iter().any(|edge| (edge.0..=edge.1).contains(&at));
        let inside = || is_in_rings(middle + along * at, rings);
        (pair[1] > pair[0] && (on_edge || inside())).then_some((pair[0], pair[1]))
    });
    between.collect()
}

/// Whether a point is inside an odd number of rings.
pub fn is_in_rings(point: DVec2, rings: &[Vec<DVec2>]) -> bool {
    let around = rings.iter().filter(|ring| crate::is_inside(point, ring));
    around.count() % 2 == 1
}

/// Parallel lines over an area: every point of it is within half the spacing of one of them.
///
/// The area is cut into strips of equal width, at most `spacing_m`. Each line runs along the middle
/// of its strip, wherever any part of the strip is in the area. Where a concave area has a gap in a
/// strip, the line continues over the gap. Without a course the lines run along the edge for which
/// the fewest are needed.
///
/// # Errors
/// See [`Strips::over`].
pub fn lanes(
    corners: &[DVec2],
    spacing_m: f64,
    course_deg: Option<f64>,
) -> Result<Vec<Lane>, NoLanes> {
    let strips = Strips::over(corners, spacing_m, course_deg)?;
    let lane = |index: usize| {
        let (start, end) = extent(corners, &strips, index);
        strips.lane(index, start, end)
    };
    Ok((0..strips.count).map(lane).collect())
}

/// The length of lanes outside the area, where they cross its gaps, in metres.
pub fn gaps_m(lanes: &[Lane], corners: &[DVec2]) -> f64 {
    lanes.iter().map(|lane| gap_m(lane, corners)).sum()
}

fn gap_m(lane: &Lane, corners: &[DVec2]) -> f64 {
    let Some(along) = (lane.to - lane.from).try_normalize() else {
        return 0.0;
    };
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossings = edges.filter_map(|(a, b)| {
        let (a, b) = (*a - lane.from, *b - lane.from);
        let (left, right) = (a.dot(along.perp()), b.dot(along.perp()));
        let crosses = (left > 0.0) != (right > 0.0);
        crosses.then(|| a.lerp(b, left / (left - right)).dot(along))
    });
    let mut crossings: Vec<f64> = crossings.collect();
    crossings.sort_by(f64::total_cmp);
    // The line alternately enters and leaves the area, so a gap lies behind every second crossing except the last.
    let gaps = crossings.get(1..).unwrap_or_default().chunks_exact(2);
    gaps.map(|gap| gap[1] - gap[0]).sum()
}

/// The direction of the edge across which the area is narrowest.
fn narrowest(corners: &[DVec2]) -> Option<DVec2> {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let directions = edges.filter_map(|(from, to)| (*to - *from).try_normalize());
    let width = |along: DVec2| {
        let (low, high) = range(corners.iter().map(|corner| corner.dot(along.perp())));
        high - low
    };
    directions
        .map(|along| (width(along), along))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, along)| along)
}

fn extent(corners: &[DVec2], strips: &Strips, index: usize) -> (f64, f64) {
    let strip = strips.strip(index);
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let ends = edges.filter_map(|(from, to)| clipped([*from, *to], strips.across(), &strip));
    range(ends.flatten().map(|end| end.dot(strips.along)))
}

/// The part of an edge inside a strip, as its two ends.
fn clipped([from, to]: [DVec2; 2], across: DVec2, strip: &Range<f64>) -> Option<[DVec2; 2]> {
    let (a, b) = (from.dot(across), to.dot(across));
    if (b - a).abs() < f64::EPSILON {
        let inside = (strip.start - SLACK..=strip.end + SLACK).contains(&a);
        return inside.then_some([from, to]);
    }
    let share = |at: f64| (at - a) / (b - a);
    let (one, other) = (share(strip.start), share(strip.end));
    let (first, last) = (one.min(other).max(0.0), one.max(other).min(1.0));
    (first <= last).then(|| [first, last].map(|share| from.lerp(to, share)))
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rectangle(north: f64, east: f64) -> Vec<DVec2> {
        vec![
            DVec2::ZERO,
            DVec2::new(north, 0.0),
            DVec2::new(north, east),
            DVec2::new(0.0, east),
        ]
    }

    /// 120 m by 60 m at 12 m: five lanes of 120 m, the first 6 m inside.
    #[test]
    fn a_rectangle_has_lanes_along_its_longer_side() {
        let lanes = lanes(&rectangle(120.0, 60.0), 12.0, None).expect("lanes");
        assert_eq!(lanes.len(), 5);
        for (index, lane) in lanes.iter().enumerate() {
            assert!((lane.length_m() - 120.0).abs() < 1e-9, "{lane:?}");
            let from_edge = lane.from.y.min(60.0 - lane.from.y);
            let expected = 6.0 + 12.0 * index.min(4 - index) as f64;
            assert!((from_edge - expected).abs() < 1e-9, "{lane:?}");
        }
    }

    #[test]
    fn a_course_turns_the_lanes() {
        let lanes = lanes(&rectangle(120.0, 60.0), 12.0, Some(90.0)).expect("lanes");
        assert_eq!(lanes.len(), 10);
        assert!(
            lanes
                .iter()
                .all(|lane| (lane.length_m() - 60.0).abs() < 1e-6)
        );
    }

    #[test]
    fn what_has_no_extent_or_too_much_is_refused() {
        assert_eq!(lanes(&[], 10.0, None), Err(NoLanes::Empty));
        assert_eq!(lanes(&[], 10.0, Some(0.0)), Err(NoLanes::Empty));
        assert_eq!(lanes(&[DVec2::ONE; 5], 10.0, None), Err(NoLanes::Empty));
        let huge = lanes(&rectangle(1e5, 1e5), 1.0, None);
        assert_eq!(huge, Err(NoLanes::TooMany(MOST_LANES)));
    }

    #[test]
    fn gaps_of_a_concave_area_are_measured_along_its_lanes() {
        // A horseshoe, 60 m wide and 40 m high, with a bay of 20 by 30 m.
        let horseshoe = [
            (0.0, 0.0),
            (60.0, 0.0),
            (60.0, 40.0),
            (40.0, 40.0),
            (40.0, 10.0),
            (20.0, 10.0),
            (20.0, 40.0),
            (0.0, 40.0),
        ];
        let horseshoe = horseshoe.map(|(north, east)| DVec2::new(north, east));
        let gaps = |course_deg| {
            let lanes = lanes(&horseshoe, 10.0, Some(course_deg)).expect("lanes");
            gaps_m(&lanes, &horseshoe)
        };
        // Four lines to the north, three of which cross the bay; six to the east, which all stay inside.
        assert!((gaps(0.0) - 3.0 * 20.0).abs() < 1e-6, "{}", gaps(0.0));
        assert!(gaps(90.0).abs() < 1e-6, "{}", gaps(90.0));
    }

    fn is_inside(point: DVec2, corners: &[DVec2]) -> bool {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let crossings = edges.filter(|(a, b)| {
            (a.y > point.y) != (b.y > point.y)
                && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
        });
        crossings.count() % 2 == 1
    }

    fn distance(point: DVec2, lane: &Lane) -> f64 {
        crate::pattern::distance_to_segment(point, lane.from, lane.to)
    }

    /// Stars of any depth: most of them are concave.
    fn polygon() -> impl Strategy<Value = Vec<DVec2>> {
        proptest::collection::vec(10.0..150.0f64, 3..12).prop_map(|radii| {
            let count = radii.len() as f64;
            let corner =
                |(index, radius): (usize, f64)| course(index as f64 / count * 360.0) * radius;
            radii.into_iter().enumerate().map(corner).collect()
        })
    }

    proptest! {
        #[test]
        fn every_point_of_an_area_is_within_half_the_spacing_of_a_lane(
            corners in polygon(),
            spacing in 3.0..40.0f64,
            course_deg in proptest::option::of(0.0..360.0f64),
            points in proptest::collection::vec((-150.0..150.0f64, -150.0..150.0f64), 60),
        ) {
            let lanes = lanes(&corners, spacing, course_deg).expect("lanes");
            for (north, east) in points {
                let point = DVec2::new(north, east);
                if is_inside(point, &corners) {
                    let nearest = lanes.iter().map(|lane| distance(point, lane));
                    let nearest = nearest.fold(f64::INFINITY, f64::min);
                    prop_assert!(nearest <= spacing / 2.0 + 1e-6, "{point} {nearest}");
                }
            }
            for pair in lanes.windows(2) {
                let apart = distance(pair[0].from, &pair[1]);
                prop_assert!(apart + 1e-6 >= spacing.min(apart.max(spacing / 2.0)));
            }
        }
    }
}
