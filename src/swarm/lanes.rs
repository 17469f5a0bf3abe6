//! Parallel lines that cover an area, and their shares.

use std::ops::Range;

use glam::DVec2;

use super::site::course;

/// More lines than this are a typing error.
const MOST_LANES: usize = 1000;
/// Areas narrower than this in every direction cannot be covered.
const LEAST_EXTENT_M: f64 = 0.5;
/// Rounding must not add a line.
const SLACK: f64 = 1e-6;

/// One line over an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lane {
    pub from: DVec2,
    pub to: DVec2,
}

impl Lane {
    pub fn length_m(&self) -> f64 {
        self.from.distance(self.to)
    }

    fn reversed(self) -> Self {
        Self {
            from: self.to,
            to: self.from,
        }
    }
}

/// Why an area cannot be covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoLanes {
    /// The area has no extent.
    Empty,
    /// The area needs this many lines, which are too many.
    TooMany(usize),
}

/// Parallel lines over an area: every point of it is within half the spacing of one of them.
///
/// The area is cut into strips of equal width, at most `spacing_m`, and each line runs along the middle of its strip
/// for as long as any part of the strip is in the area. Where a concave area has a gap in a strip, the line goes on
/// over the gap. Without a course the lines run along the edge that needs the fewest of them.
pub(super) fn lanes(
    corners: &[DVec2],
    spacing_m: f64,
    course_deg: Option<f64>,
) -> Result<Vec<Lane>, NoLanes> {
    let along = match course_deg {
        Some(degrees) => course(degrees),
        None => narrowest(corners).ok_or(NoLanes::Empty)?,
    };
    let across = along.perp();
    let (low, high) = range(corners.iter().map(|corner| corner.dot(across)));
    let width = high - low;
    let (start, end) = range(corners.iter().map(|corner| corner.dot(along)));
    if corners.len() < 3 || width.max(end - start) < LEAST_EXTENT_M {
        return Err(NoLanes::Empty);
    }
    let count = (width / spacing_m - SLACK).ceil().max(1.0);
    if count > MOST_LANES as f64 {
        return Err(NoLanes::TooMany(MOST_LANES));
    }
    let step = width / count;
    let lane = |index: usize| {
        let from = low + step * index as f64;
        let (start, end) = extent(corners, along, across, &(from..from + step));
        let middle = across * (from + step / 2.0);
        Lane {
            from: middle + along * start,
            to: middle + along * end,
        }
    };
    Ok((0..count as usize).map(lane).collect())
}

/// The length of lanes outside the area, where they cross its gaps, in metres.
pub(super) fn gaps_m(lanes: &[Lane], corners: &[DVec2]) -> f64 {
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
    // The line enters and leaves the area in turns, so a gap lies behind every second crossing except the last.
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

/// The extent of the area along a strip.
fn extent(corners: &[DVec2], along: DVec2, across: DVec2, strip: &Range<f64>) -> (f64, f64) {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    range(edges.flat_map(|(from, to)| {
        let (a, b) = (from.dot(across), to.dot(across));
        // The part of the edge inside the strip, as shares of the way.
        let is_along = (b - a).abs() < f64::EPSILON;
        let share = |at: f64| if is_along { 0.0 } else { (at - a) / (b - a) };
        let (one, other) = (share(strip.start), share(strip.end));
        let (first, last) = if is_along {
            (0.0, 1.0)
        } else {
            (one.min(other).max(0.0), one.max(other).min(1.0))
        };
        let outside =
            first > last || is_along && !(strip.start - SLACK..=strip.end + SLACK).contains(&a);
        let ends = [first, last].map(|share| from.lerp(*to, share).dot(along));
        ends.into_iter().filter(move |_| !outside)
    }))
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// Divides a row of lanes into `count` adjacent shares, none empty, as equal in length as whole lanes allow. There
/// must be at least as many lanes.
pub(super) fn shares(lanes: &[Lane], count: usize) -> Vec<Vec<Lane>> {
    let total: f64 = lanes.iter().map(Lane::length_m).sum();
    let mut cuts = vec![0];
    let (mut at, mut flown) = (0, 0.0);
    for share in 1..count {
        let goal = total * share as f64 / count as f64;
        let last = lanes.len() - (count - share);
        // A lane belongs to the share in which its middle lies.
        while at < last && (at <= cuts[share - 1] || flown + lanes[at].length_m() / 2.0 <= goal) {
            flown += lanes[at].length_m();
            at += 1;
        }
        cuts.push(at);
    }
    cuts.push(lanes.len());
    cuts.windows(2)
        .map(|cut| lanes[cut[0]..cut[1]].to_vec())
        .collect()
}

/// The side and the end at which the shares begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Start {
    pub last_lane: bool,
    pub far_end: bool,
}

impl Start {
    pub const ALL: [Self; 4] = [
        Self::new(false, false),
        Self::new(false, true),
        Self::new(true, false),
        Self::new(true, true),
    ];

    const fn new(last_lane: bool, far_end: bool) -> Self {
        Self { last_lane, far_end }
    }

    /// A share in the order and the directions in which it is flown: to and fro.
    pub fn order(self, share: &[Lane]) -> Vec<Lane> {
        let mut lanes = share.to_vec();
        if self.last_lane {
            lanes.reverse();
        }
        for (index, lane) in lanes.iter_mut().enumerate() {
            if self.far_end != (index % 2 == 1) {
                *lane = lane.reversed();
            }
        }
        lanes
    }
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
        super::super::geometry::distance_to_segment(point, lane.from, lane.to)
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

        #[test]
        fn shares_are_whole_and_differ_from_the_mean_by_a_lane_at_most(
            corners in polygon(),
            spacing in 3.0..15.0f64,
            count in 1usize..9,
        ) {
            let lanes = lanes(&corners, spacing, None).expect("lanes");
            prop_assume!(lanes.len() >= count);
            let shares = shares(&lanes, count);
            prop_assert_eq!(shares.len(), count);
            prop_assert_eq!(shares.concat(), lanes.clone());
            let length = |lanes: &[Lane]| lanes.iter().map(Lane::length_m).sum::<f64>();
            let longest = lanes.iter().map(Lane::length_m).fold(0.0, f64::max);
            let mean = length(&lanes) / count as f64;
            for share in &shares {
                prop_assert!(!share.is_empty());
                prop_assert!(length(share) <= mean + longest + 1e-6);
            }
        }
    }
}
