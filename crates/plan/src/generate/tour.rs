//! The order in which lines are flown.

use glam::DVec2;

use super::field::Field;
use crate::pattern::Lane;

/// A cut closer than this to the end of a stroke is moved to that end, in metres.
const SNAP_M: f64 = 2.0;

/// Strokes in the order in which they are flown; each is a line along which a vehicle works.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way {
    strokes: Vec<Vec<DVec2>>,
    /// The bends between each stroke and the next.
    links: Vec<Vec<DVec2>>,
    /// For each stroke, the length of all strokes up to its end, in metres.
    ends: Vec<f64>,
}

impl Way {
    /// The way along strokes; `None` if the fence separates two of them.
    pub(super) fn new(strokes: Vec<Vec<DVec2>>, field: &Field) -> Option<Self> {
        let link = |pair: &[Vec<DVec2>]| field.way(*pair[0].last()?, *pair[1].first()?);
        let links: Option<Vec<_>> = strokes.windows(2).map(link).collect();
        let ends = strokes.iter().scan(0.0, |sum, stroke| {
            *sum += length_m(stroke);
            Some(*sum)
        });
        Some(Self {
            links: links?,
            ends: ends.collect(),
            strokes,
        })
    }

    /// The length of all strokes, in metres.
    pub(super) fn length_m(&self) -> f64 {
        self.ends.last().copied().unwrap_or_default()
    }

    /// The points between two places, each given as the length of the strokes up to it, in metres.
    pub(super) fn part(&self, from_m: f64, to_m: f64) -> Vec<DVec2> {
        let mut points = Vec::new();
        let first = self.ends.partition_point(|end| *end <= from_m + 1e-6);
        for (index, stroke) in self.strokes.iter().enumerate().skip(first) {
            let start_m = index.checked_sub(1).map_or(0.0, |before| self.ends[before]);
            if start_m >= to_m - 1e-6 {
                break;
            }
            if !points.is_empty() {
                points.extend_from_slice(&self.links[index - 1]);
            }
            cut(stroke, from_m - start_m, to_m - start_m, &mut points);
        }
        points
    }

    /// A place for a cut: the end of a stroke, if one is near.
    pub(super) fn snapped(&self, at_m: f64) -> f64 {
        let next = self.ends.partition_point(|end| *end < at_m);
        let around = [next.checked_sub(1), Some(next)];
        let ends = around.into_iter().flatten();
        let near = ends
            .filter_map(|index| self.ends.get(index))
            .find(|end| (*end - at_m).abs() <= SNAP_M);
        near.copied().unwrap_or(at_m)
    }

    /// The vector from the middle of its first half to the middle of its second half.
    pub(super) fn direction(&self) -> DVec2 {
        let mean = |points: &[DVec2]| points.iter().sum::<DVec2>() / points.len().max(1) as f64;
        let half = self.length_m() / 2.0;
        mean(&self.part(half, self.length_m())) - mean(&self.part(0.0, half))
    }
}

/// Appends the part of a stroke between two distances along it, in metres.
fn cut(stroke: &[DVec2], from_m: f64, to_m: f64, points: &mut Vec<DVec2>) {
    let mut start_m = 0.0;
    for leg in stroke.windows(2) {
        let length = leg[0].distance(leg[1]);
        let end_m = start_m + length;
        if end_m > from_m && start_m < to_m && length > 0.0 {
            let share =
                |at_m: f64| leg[0].lerp(leg[1], ((at_m - start_m) / length).clamp(0.0, 1.0));
            let ends = [share(from_m), share(to_m)];
            let is_new = |end: &DVec2| points.last().is_none_or(|last| last.distance(*end) > 1e-6);
            if is_new(&ends[0]) {
                points.push(ends[0]);
            }
            points.push(ends[1]);
        }
        start_m = end_m;
    }
}

/// The length of a path, in metres.
pub(super) fn length_m(points: &[DVec2]) -> f64 {
    points.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
}

/// Where a tour begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Begin {
    pub(super) last_row: bool,
    pub(super) far_end: bool,
}

impl Begin {
    pub(super) const ALL: [Self; 4] = [
        Self::new(false, false),
        Self::new(false, true),
        Self::new(true, false),
        Self::new(true, true),
    ];

    const fn new(last_row: bool, far_end: bool) -> Self {
        Self { last_row, far_end }
    }

    /// The lines of a cell, flown back and forth.
    fn order(self, cell: &[Lane]) -> Vec<Vec<DVec2>> {
        let mut lanes = cell.to_vec();
        if self.last_row {
            lanes.reverse();
        }
        let turned = lanes.into_iter().enumerate().map(|(index, lane)| {
            let back = self.far_end != (index % 2 == 1);
            if back {
                vec![lane.to, lane.from]
            } else {
                vec![lane.from, lane.to]
            }
        });
        turned.collect()
    }
}

/// Rows of lines as cells: in each, every line lies beside one line of the row before (boustrophedon decomposition).
pub(super) fn cells(rows: &[Vec<Lane>], along: DVec2) -> Vec<Vec<Lane>> {
    let mut cells: Vec<Vec<Lane>> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for row in rows {
        let beside = |cell: &usize, lane: &Lane| {
            let last = cells[*cell].last();
            last.is_some_and(|last| overlap(last, lane, along))
        };
        let neighbours = |lane: &Lane| -> Vec<usize> {
            let near = open.iter().filter(|cell| beside(cell, lane));
            near.copied().collect()
        };
        let goes_on = |lane: &Lane| match neighbours(lane).as_slice() {
            [cell] => {
                let rivals = row.iter().filter(|other| beside(cell, other)).count();
                (rivals == 1).then_some(*cell)
            }
            _ => None,
        };
        let targets: Vec<Option<usize>> = row.iter().map(goes_on).collect();
        open = Vec::new();
        for (lane, target) in row.iter().zip(targets) {
            let cell = target.unwrap_or(cells.len());
            if target.is_none() {
                cells.push(Vec::new());
            }
            cells[cell].push(*lane);
            open.push(cell);
        }
    }
    cells
}

fn overlap(a: &Lane, b: &Lane, along: DVec2) -> bool {
    let ends = |lane: &Lane| {
        let (from, to) = (lane.from.dot(along), lane.to.dot(along));
        (from.min(to), from.max(to))
    };
    let ((a_start, a_end), (b_start, b_end)) = (ends(a), ends(b));
    a_start < b_end && b_start < a_end
}

/// The strokes of all cells: first the first cell as `begin` specifies, then repeatedly the
/// remaining cell with the nearest corner.
pub(super) fn tour(cells: &[Vec<Lane>], begin: Begin) -> Vec<Vec<DVec2>> {
    let mut left: Vec<&Vec<Lane>> = cells.iter().collect();
    if left.is_empty() {
        return Vec::new();
    }
    let first = if begin.last_row { left.len() - 1 } else { 0 };
    let mut strokes = begin.order(left.remove(first));
    while !left.is_empty() {
        let Some(here) = strokes.last().and_then(|stroke| stroke.last()).copied() else {
            break;
        };
        let starts = left.iter().enumerate().flat_map(|(cell, lanes)| {
            Begin::ALL.map(|begin| {
                let edge = if begin.last_row {
                    lanes.last()
                } else {
                    lanes.first()
                };
                let corner =
                    edge.map_or(here, |lane| if begin.far_end { lane.to } else { lane.from });
                (cell, begin, here.distance(corner))
            })
        });
        let nearest = starts.min_by(|a, b| a.2.total_cmp(&b.2));
        let Some((cell, begin, _)) = nearest else {
            break;
        };
        strokes.extend(begin.order(left.remove(cell)));
    }
    strokes
}
