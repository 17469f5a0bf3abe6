//! The reported length of a fence. [`Fence::check`](crate::fence::Fence::check) checks whether the
//! fence is valid.

use crate::plan::Item;

/// The value of `FENCE_TOTAL`: the number of corners and circles, and two more that the old fence protocol counts; 0
/// for fewer than three.
pub(super) fn total(items: &[Item]) -> f32 {
    let counted = items
        .iter()
        .filter(|item| item.command != sortie_plan::command::FENCE_RETURN_POINT)
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
            command: sortie_plan::command::FENCE_POLYGON_INCLUSION,
            params: [f32::from(corners), 0.0, 0.0, 0.0],
            ..Item::default()
        }
    }

    #[test]
    fn the_old_protocol_counts_two_points_more_and_no_return_point() {
        let returning = Item {
            command: sortie_plan::command::FENCE_RETURN_POINT,
            ..Item::default()
        };
        for (corners, expected) in [(2, 0.0), (3, 5.0), (4, 6.0)] {
            let mut items = vec![corner(corners); usize::from(corners)];
            items.push(returning);
            assert!((total(&items) - expected).abs() < f32::EPSILON, "{corners}");
        }
    }
}
