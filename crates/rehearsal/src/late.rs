//! Whether vehicles still keep away from each other if one of them is late.

use crate::approach::{Approach, TOO_NEAR_VERTICALLY_M, nearness};
use crate::place::{TRACK_EVERY, Track, sample_s};

/// The margin in time, in seconds: vehicles should stay apart even if one of them is this late.
pub const LATE_S: u32 = 3;

/// The shortest delay of one of two vehicles that brings them into conflict, in seconds; see [`Approach::late_s`].
pub(crate) fn late_s(approach: &Approach, tracks: &[Track]) -> Option<u32> {
    if approach.is_conflict() {
        return Some(0);
    }
    let (a, b) = (tracks.get(approach.a)?, tracks.get(approach.b)?);
    let limit_m = approach.limit_m;
    if are_far(a, b, limit_m) {
        return None;
    }
    (1..=LATE_S).find(|late_s| {
        let late = points_in(*late_s);
        let apart = |a_by, b_by| {
            let (a, b) = (Shifted::new(a, a_by), Shifted::new(b, b_by));
            are_apart(a, b, limit_m, 1.0)
        };
        !apart(late, 0) || !apart(0, late)
    })
}

/// A vehicle that starts late, by a number of points of its track.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shifted<'a> {
    track: &'a Track,
    by: usize,
}

impl<'a> Shifted<'a> {
    pub(crate) fn new(track: &'a Track, by: usize) -> Self {
        Self { track, by }
    }

    fn end(self) -> usize {
        self.track.points.len() + self.by
    }

    /// The position at a time, in points; a vehicle that ends in the air stays there.
    fn at(self, time: usize) -> Option<[f64; 3]> {
        let last = self.track.points.len().checked_sub(1)?;
        self.track.points[time.checked_sub(self.by)?.min(last)]
    }
}

/// The number of a track's points in a number of seconds.
pub(crate) fn points_in(seconds: u32) -> usize {
    let per_second = (1.0 / (sample_s() * f64::from(TRACK_EVERY))).round() as usize;
    seconds as usize * per_second
}

/// Whether the boxes around two tracks are apart, so that no lateness brings the vehicles together.
fn are_far(a: &Track, b: &Track, limit_m: f64) -> bool {
    let (Some(a), Some(b)) = (bounds(a), bounds(b)) else {
        return true;
    };
    let limits_m = [limit_m, limit_m, TOO_NEAR_VERTICALLY_M];
    (0..3).any(|axis| {
        let gap_m = (b[axis].0 - a[axis].1).max(a[axis].0 - b[axis].1);
        gap_m > limits_m[axis]
    })
}

/// The minimum and the maximum of each axis.
fn bounds(track: &Track) -> Option<[(f64, f64); 3]> {
    let mut points = track.points.iter().flatten();
    let first = points.next()?;
    Some(
        points.fold(first.map(|value| (value, value)), |bounds, point| {
            std::array::from_fn(|axis| {
                let (least, most) = bounds[axis];
                (least.min(point[axis]), most.max(point[axis]))
            })
        }),
    )
}

/// Whether two vehicles stay apart by a horizontal limit in metres and the vertical one; `factor` multiplies the
/// squares of both.
pub(crate) fn are_apart(a: Shifted<'_>, b: Shifted<'_>, limit_m: f64, factor: f64) -> bool {
    let times = a.by.max(b.by)..a.end().max(b.end());
    times
        .into_iter()
        .all(|time| match (a.at(time), b.at(time)) {
            (Some(a), Some(b)) => nearness(a, b, limit_m) >= factor,
            (None, _) | (_, None) => true,
        })
}
