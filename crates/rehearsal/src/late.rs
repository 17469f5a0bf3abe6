//! Whether vehicles still keep away from each other if one of them is late.

use crate::approach::{Approach, Separation, TOO_NEAR_M, TOO_NEAR_VERTICALLY_M, between};
use crate::place::{TRACK_EVERY, Track, sample_s};

/// The margin in time, in seconds: vehicles should stay apart even if one of them is this late.
pub const LATE_S: u32 = 3;

/// The shortest delay of one of two vehicles that brings them into conflict, in seconds; see [`Approach::late_s`].
/// `starts_m` are the starts of all vehicles.
pub(crate) fn late_s(approach: &Approach, tracks: &[Track], starts_m: &[[f64; 2]]) -> Option<u32> {
    if approach.is_conflict() {
        return Some(0);
    }
    let (a, b) = (tracks.get(approach.a)?, tracks.get(approach.b)?);
    let rule = between([*starts_m.get(approach.a)?, *starts_m.get(approach.b)?]);
    if are_far(a, b) {
        return None;
    }
    (1..=LATE_S).find(|late_s| {
        let late = points_in(*late_s);
        let apart = |a_by, b_by| {
            let (a, b) = (Shifted::new(a, a_by), Shifted::new(b, b_by));
            are_apart(a, b, &rule, 1.0)
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

    /// The position at a time, counted in points of the track; a vehicle whose track ends in the
    /// air stays there.
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

/// Whether the boxes around two tracks are apart, so no delay brings the vehicles together.
fn are_far(a: &Track, b: &Track) -> bool {
    let (Some(a), Some(b)) = (bounds(a), bounds(b)) else {
        return true;
    };
    let limits_m = [TOO_NEAR_M, TOO_NEAR_M, TOO_NEAR_VERTICALLY_M];
    (0..3).any(|axis| {
        let gap_m = (b[axis].0 - a[axis].1).max(a[axis].0 - b[axis].1);
        gap_m > limits_m[axis]
    })
}

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

/// Whether two vehicles stay apart by their rule; `factor` multiplies the squares of its limits.
pub(crate) fn are_apart(a: Shifted<'_>, b: Shifted<'_>, rule: &Separation, factor: f64) -> bool {
    let times = a.by.max(b.by)..a.end().max(b.end());
    times
        .into_iter()
        .all(|time| match (a.at(time), b.at(time)) {
            (Some(a), Some(b)) => rule.nearness([a, b]) >= factor,
            (None, _) | (_, None) => true,
        })
}
