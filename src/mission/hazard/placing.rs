//! Random placement of objects, and their display in the debrief.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::{Object, TruthPiece, TruthShape};
use crate::mission::Point;
use crate::mission::report::distance_m;
use crate::mission::zone::Shape;

/// Positions tried for one object before the best one is taken.
const TRIES: usize = 400;

/// `count` points in a shape, at least `gap_m` from one another and from the points in `taken`. If
/// there is no room, the candidate with the largest gap is used.
pub(super) fn spread(
    shape: &Shape,
    count: usize,
    gap_m: f64,
    mut taken: Vec<Point>,
    random: &mut ChaCha8Rng,
) -> Vec<Point> {
    let before = taken.len();
    for _ in 0..count {
        let mut best: Option<(f64, Point)> = None;
        for _ in 0..TRIES {
            let at = within(shape, random);
            let nearest = taken.iter().map(|&other| distance_m(at, other));
            let gap = nearest.fold(f64::INFINITY, f64::min);
            if best.is_none_or(|(most, _)| gap > most) {
                best = Some((gap, at));
            }
            if gap >= gap_m {
                break;
            }
        }
        taken.extend(best.map(|(_, at)| at));
    }
    taken.split_off(before)
}

/// A random point of a shape; its centre if the shape has almost no area.
fn within(shape: &Shape, random: &mut ChaCha8Rng) -> Point {
    let (low, high) = shape.bounds();
    for _ in 0..TRIES {
        let at = [0, 1].map(|axis| low[axis] + (high[axis] - low[axis]) * random.random::<f64>());
        if shape.contains(at) {
            return at;
        }
    }
    [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]))
}

/// The objects as the debrief shows them.
pub(super) fn revealed(objects: &[Object]) -> Vec<TruthPiece> {
    let truth = |object: &Object| TruthPiece {
        at: object.at,
        shape: TruthShape::Object(object.class, object.present),
    };
    objects.iter().map(truth).collect()
}
