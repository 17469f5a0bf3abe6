//! Lanes along a line.

use glam::DVec2;

use super::layers::{ASIDE_M, set};
use super::{GenerateError, Manner, Scene, Work};

/// The farthest that a lane goes beyond a sharp corner, as a multiple of its distance from the line.
const LONGEST_MITRE: f64 = 2.0;

/// One lane for each vehicle, from the end that is closer to the vehicles.
///
/// # Errors
/// The line has no length, or the lanes are so close that vehicles descending to their own lanes
/// would come too close to each other.
pub(super) fn lanes(
    scene: &Scene,
    manner: &Manner,
    points: &[DVec2],
    spacing_m: f64,
) -> Result<Vec<Work>, GenerateError> {
    let mut line: Vec<DVec2> = Vec::new();
    for point in points {
        if line.last().is_none_or(|last| last.distance(*point) > 0.1) {
            line.push(*point);
        }
    }
    let [first, .., last] = line.as_slice() else {
        return Err(GenerateError::Empty);
    };
    let count = scene.homes.len();
    if count > 1 && spacing_m < ASIDE_M {
        return Err(GenerateError::TooNarrow(ASIDE_M as u32));
    }
    let middle = scene.homes.iter().sum::<DVec2>() / count as f64;
    if middle.distance(*last) < middle.distance(*first) {
        line.reverse();
    }
    // The lanes are taken in the order in which the vehicles stand, so that they need not cross.
    let side = (line[1] - line[0]).perp();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| {
        scene.homes[*a]
            .dot(side)
            .total_cmp(&scene.homes[*b].dot(side))
    });
    let works = order.into_iter().enumerate().map(|(lane, vehicle)| {
        let off_m = (lane as f64 - (count - 1) as f64 / 2.0) * spacing_m;
        Work {
            vehicle,
            points: beside(&line, off_m),
            height_m: manner.height_m,
            layer_m: manner.height_m,
            circle: None,
        }
    });
    let mut works: Vec<Work> = works.collect();
    set(scene, &mut works, manner.layer_m);
    Ok(works)
}

/// A line parallel to another at a distance: to its right if the distance is positive.
fn beside(line: &[DVec2], off_m: f64) -> Vec<DVec2> {
    let normal = |index: usize| {
        let pair = line.get(index..index + 2)?;
        Some((pair[1] - pair[0]).normalize().perp())
    };
    let corner = |index: usize| {
        let before = index.checked_sub(1).and_then(normal);
        let after = normal(index);
        let (Some(before), Some(after)) = (before, after) else {
            let only = before.or(after).unwrap_or(DVec2::Y);
            return vec![line[index] + only * off_m];
        };
        let middle = (before + after).try_normalize();
        let reach = middle.map(|middle| (middle, 1.0 / middle.dot(before).max(1e-6)));
        match reach {
            Some((middle, reach)) if reach <= LONGEST_MITRE => {
                vec![line[index] + middle * reach * off_m]
            }
            Some(_) | None => [before, after]
                .map(|side| line[index] + side * off_m)
                .to_vec(),
        }
    };
    (0..line.len()).flat_map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_stays_at_its_distance_around_a_corner() {
        let line = [
            DVec2::ZERO,
            DVec2::new(100.0, 0.0),
            DVec2::new(100.0, 100.0),
        ];
        let right = beside(&line, 10.0);
        assert_eq!(right.len(), 3);
        assert!((right[0] - DVec2::new(0.0, 10.0)).length() < 1e-9);
        assert!(
            (right[1] - DVec2::new(90.0, 10.0)).length() < 1e-9,
            "{right:?}"
        );
        assert!((right[2] - DVec2::new(90.0, 100.0)).length() < 1e-9);
        let back = [DVec2::ZERO, DVec2::X * 50.0, DVec2::ZERO];
        assert_eq!(beside(&back, 5.0).len(), 4);
    }
}
