//! The room that a fence takes in the vehicle's storage, and its reported length.
//! [`Fence::check`](crate::fence::Fence::check) checks whether it is valid.

use crate::cmd;
use crate::plan::Item;

/// Bytes of storage for fences.
const STORAGE: usize = 560;

/// Whether a fence fits into the storage.
pub(super) fn fits(items: &[Item]) -> bool {
    let mut needed = 4;
    let mut rest = items;
    while let Some(item) = rest.first() {
        let (bytes, length) = match item.command {
            cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION | cmd::NAV_FENCE_POLYGON_VERTEX_EXCLUSION => {
                let corners = usize::from(item.p[0] as u8);
                (2 + 8 * corners, corners.max(1))
            }
            cmd::NAV_FENCE_CIRCLE_INCLUSION | cmd::NAV_FENCE_CIRCLE_EXCLUSION => (13, 1),
            _ => (9, 1),
        };
        needed += bytes;
        rest = rest.get(length..).unwrap_or_default();
    }
    needed <= STORAGE
}

/// The value of `FENCE_TOTAL`: corners and circles, and two more that the old fence protocol counts.
pub(super) fn total(items: &[Item]) -> f32 {
    let counted = items
        .iter()
        .filter(|item| item.command != cmd::NAV_FENCE_RETURN_POINT)
        .count();
    if counted < 3 {
        0.0
    } else {
        (counted + 2) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(corners: u8) -> Item {
        Item {
            command: cmd::NAV_FENCE_POLYGON_VERTEX_INCLUSION,
            p: [f32::from(corners), 0.0, 0.0, 0.0],
            ..Item::default()
        }
    }

    #[test]
    fn the_old_protocol_counts_two_points_more_and_no_return_point() {
        let returning = Item {
            command: cmd::NAV_FENCE_RETURN_POINT,
            ..Item::default()
        };
        for (corners, expected) in [(2, 0.0), (3, 5.0), (4, 6.0)] {
            let mut items = vec![corner(corners); usize::from(corners)];
            items.push(returning);
            assert!((total(&items) - expected).abs() < f32::EPSILON, "{corners}");
        }
    }

    #[test]
    fn a_large_fence_does_not_fit() {
        assert!(fits(&vec![corner(60); 60]));
        assert!(!fits(&vec![corner(70); 70]));
    }
}
