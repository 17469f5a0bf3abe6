//! The fence around the vehicles, and paths inside it.

use glam::DVec2;
use sortie_geo::LatLon;

use super::{GenerateError, Work};
use crate::Item;
use crate::areas::{AreaShape, Fence, FenceArea};
use crate::check::is_crossed;
use crate::pattern::{Lane, course};

/// The distance from the fence at which paths bend around it and lines end, in metres.
const MARGIN_M: f64 = 2.0;
/// Pieces of lines shorter than this, in metres, are left out.
const SHORTEST_M: f64 = 1.0;
/// The distance kept from an exclusion area, in metres: a vehicle does not follow a line exactly.
const ASIDE_M: f64 = 1.0;
/// The farthest that a corner of an exclusion area is moved to keep this distance, in metres.
const FARTHEST_M: f64 = 3.0;
/// The number of corners of a path around a circle.
const CIRCLE_CORNERS: u32 = 12;

/// A fence in the plane.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Field {
    areas: Vec<FenceArea<[f64; 2]>>,
    bends: Vec<DVec2>,
}

impl Field {
    pub(super) fn new(fence: &[Item], origin: LatLon) -> Result<Self, GenerateError> {
        let fence = Fence::check(fence).map_err(|_| GenerateError::Fence)?;
        let metres = |point: &LatLon| <[f64; 2]>::from(origin.offset_to(*point));
        let areas = fence.areas.iter().map(|area| area.map(metres));
        let areas: Vec<_> = areas.map(widened).collect();
        let mut field = Self {
            areas,
            bends: Vec::new(),
        };
        let bends = field.areas.iter().flat_map(bends_of);
        field.bends = bends.filter(|bend| field.allows(*bend)).collect();
        Ok(field)
    }

    pub(super) fn is_open(&self) -> bool {
        self.areas.is_empty()
    }

    pub(super) fn allows(&self, point: DVec2) -> bool {
        let mut areas = self.areas.iter();
        areas.all(|area| !area.is_broken_at(point.into()))
    }

    fn is_clear(&self, from: DVec2, to: DVec2) -> bool {
        let mut areas = self.areas.iter();
        areas.all(|area| !is_crossed(area, from.into(), to.into()))
    }

    /// Whether all points and legs stay inside.
    pub(super) fn holds(&self, points: &[DVec2]) -> bool {
        let mut legs = points.windows(2);
        points.iter().all(|point| self.allows(*point))
            && legs.all(|leg| self.is_clear(leg[0], leg[1]))
    }

    /// Whether all points and legs of the work, and the circle around its last point, stay inside.
    pub(super) fn holds_work(&self, work: &Work) -> bool {
        let mut rim = work.circle.iter().flat_map(|circle| {
            let at = move |corner: u32| {
                let turn = course(f64::from(corner) * 360.0 / 36.0);
                circle.centre + turn * circle.radius_m
            };
            (0..36).map(at)
        });
        self.holds(&work.points) && rim.all(|point| self.allows(point))
    }

    /// The parts of a line that lie inside and keep `MARGIN_M` from the fence.
    pub(super) fn inside(&self, lane: Lane) -> Vec<Lane> {
        let Some(along) = (lane.to - lane.from).try_normalize() else {
            return Vec::new();
        };
        if self.is_open() {
            return vec![lane];
        }
        // The longer line loses the margin at each end, whether the fence cuts it there or the line
        // itself ends.
        let longer = Lane {
            from: lane.from - along * MARGIN_M,
            to: lane.to + along * MARGIN_M,
        };
        let kept = self.allowed(longer, along).into_iter();
        let kept = kept.map(|(start, end)| (start + MARGIN_M, end - MARGIN_M));
        let at = |distance_m: f64| longer.from + along * distance_m;
        kept.filter(|(start, end)| end - start >= SHORTEST_M)
            .map(|(start, end)| Lane {
                from: at(start),
                to: at(end),
            })
            .collect()
    }

    /// The parts of a line inside the fence, as distances along it.
    fn allowed(&self, lane: Lane, along: DVec2) -> Vec<(f64, f64)> {
        let mut marks = vec![0.0, lane.length_m()];
        for area in &self.areas {
            marks.extend(crossings(area, lane, along));
        }
        marks.sort_by(f64::total_cmp);
        let mut parts: Vec<(f64, f64)> = Vec::new();
        for pair in marks.windows(2).filter(|pair| pair[1] - pair[0] > 1e-6) {
            let middle = f64::midpoint(pair[0], pair[1]);
            if !self.allows(lane.from + along * middle) {
                continue;
            }
            match parts.last_mut() {
                Some(last) if pair[0] - last.1 < 1e-5 => last.1 = pair[1],
                Some(_) | None => parts.push((pair[0], pair[1])),
            }
        }
        parts
    }

    /// The places at which the shortest path inside the fence bends; `None` if there is no path.
    pub(super) fn way(&self, from: DVec2, to: DVec2) -> Option<Vec<DVec2>> {
        if self.is_clear(from, to) {
            return Some(Vec::new());
        }
        // Dijkstra's algorithm over the bends; the last place is the goal.
        let places: Vec<DVec2> = self.bends.iter().copied().chain([to]).collect();
        let mut best: Vec<(f64, Option<usize>)> = places
            .iter()
            .map(|place| {
                if self.is_clear(from, *place) {
                    (from.distance(*place), None)
                } else {
                    (f64::INFINITY, None)
                }
            })
            .collect();
        let mut open: Vec<usize> = (0..places.len()).collect();
        while let Some(nearest) =
            (0..open.len()).min_by(|a, b| best[open[*a]].0.total_cmp(&best[open[*b]].0))
        {
            let here = open.swap_remove(nearest);
            if !best[here].0.is_finite() {
                return None;
            }
            if here + 1 == places.len() {
                break;
            }
            for &other in &open {
                let length = best[here].0 + places[here].distance(places[other]);
                if length < best[other].0 && self.is_clear(places[here], places[other]) {
                    best[other] = (length, Some(here));
                }
            }
        }
        let mut bends = Vec::new();
        let mut before = best.last()?.1;
        while let Some(place) = before {
            bends.push(places[place]);
            before = best[place].1;
        }
        bends.reverse();
        Some(bends)
    }
}

/// An exclusion area, widened by the distance kept from it; other areas are unchanged.
fn widened(area: FenceArea<[f64; 2]>) -> FenceArea<[f64; 2]> {
    if area.keeps_in {
        return area;
    }
    let shape = match area.shape {
        AreaShape::Circle { centre, radius_m } => AreaShape::Circle {
            centre,
            radius_m: radius_m + ASIDE_M,
        },
        AreaShape::Polygon(corners) => AreaShape::Polygon(spread(&corners)),
    };
    FenceArea { shape, ..area }
}

/// A polygon whose edges are moved outwards.
fn spread(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let corners: Vec<DVec2> = corners.iter().map(|it| DVec2::from(*it)).collect();
    let count = corners.len();
    let next = |index: usize| corners[(index + 1) % count];
    let doubled: f64 = (0..count).map(|at| corners[at].perp_dot(next(at))).sum();
    let outwards = |edge: DVec2| -edge.normalize_or_zero().perp() * doubled.signum();
    let moved = |index: usize| {
        let here = corners[index];
        let before = outwards(here - corners[(index + count - 1) % count]);
        let after = outwards(next(index) - here);
        let middle = (before + after).normalize_or(before);
        let away_m = (ASIDE_M / middle.dot(before).max(1e-6)).min(FARTHEST_M);
        <[f64; 2]>::from(here + middle * away_m)
    };
    (0..count).map(moved).collect()
}

/// Places beside the corners of an area, on both sides of its edge.
fn bends_of(area: &FenceArea<[f64; 2]>) -> Vec<DVec2> {
    match &area.shape {
        AreaShape::Polygon(corners) => {
            let corners: Vec<DVec2> = corners.iter().map(|it| DVec2::from(*it)).collect();
            let count = corners.len();
            let beside = |index: usize| {
                let here = corners[index];
                let before = (corners[(index + count - 1) % count] - here).normalize_or_zero();
                let after = (corners[(index + 1) % count] - here).normalize_or_zero();
                let inwards = (before + after).try_normalize();
                let inwards = inwards.unwrap_or(before.perp());
                [inwards, -inwards].map(|side| here + side * MARGIN_M * 1.5)
            };
            (0..count).flat_map(beside).collect()
        }
        AreaShape::Circle { .. } if area.keeps_in => Vec::new(),
        AreaShape::Circle { centre, radius_m } => {
            // The sides of the way around must not cut the circle.
            let half = std::f64::consts::PI / f64::from(CIRCLE_CORNERS);
            let away_m = (radius_m + MARGIN_M) / sortie_geo::maths::cos(half);
            let step = 360.0 / f64::from(CIRCLE_CORNERS);
            let corner = |index| DVec2::from(*centre) + course(f64::from(index) * step) * away_m;
            (0..CIRCLE_CORNERS).map(corner).collect()
        }
    }
}

/// Where a line crosses the edge of an area, as distances along it.
fn crossings(area: &FenceArea<[f64; 2]>, lane: Lane, along: DVec2) -> Vec<f64> {
    let found: Vec<f64> = match &area.shape {
        AreaShape::Polygon(corners) => {
            let edges = corners.iter().zip(corners.iter().cycle().skip(1));
            let crossing = edges.filter_map(|(a, b)| {
                let [a, b] = [*a, *b].map(|corner| DVec2::from(corner) - lane.from);
                let (left, right) = (a.dot(along.perp()), b.dot(along.perp()));
                let crosses = (left > 0.0) != (right > 0.0);
                crosses.then(|| a.lerp(b, left / (left - right)).dot(along))
            });
            crossing.collect()
        }
        AreaShape::Circle { centre, radius_m } => {
            let to = DVec2::from(*centre) - lane.from;
            let (middle, off) = (to.dot(along), to.dot(along.perp()));
            let half = (radius_m * radius_m - off * off).max(0.0).sqrt();
            vec![middle - half, middle + half]
        }
    };
    let on_line = found.into_iter();
    on_line
        .filter(|at| (0.0..=lane.length_m()).contains(at))
        .collect()
}
