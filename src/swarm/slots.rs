//! The places of a formation.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::DVec2;

use crate::commands::Shape;
use crate::geo::maths;

/// The places of `count` vehicles: x metres ahead of the first, y to its right. The first is at the origin; neighbours
/// are `spacing_m` apart, and no two are closer.
pub(super) fn slots(shape: Shape, count: usize, spacing_m: f64) -> Vec<DVec2> {
    let unit = |index: usize| match shape {
        Shape::Line => DVec2::new(0.0, in_turn(index)),
        Shape::Column => DVec2::new(-(index as f64), 0.0),
        Shape::Wedge => {
            let arm = in_turn(index) * FRAC_1_SQRT_2;
            DVec2::new(-arm.abs(), arm)
        }
        Shape::Grid => {
            let across = (1..=count).find(|side| side * side >= count).unwrap_or(1);
            // Each row is filled from the middle outwards, so that its first vehicle has neighbours on both sides.
            DVec2::new(-((index / across) as f64), in_turn(index % across))
        }
        Shape::Circle => {
            let radius = if count > 1 {
                0.5 / maths::sin(PI / count as f64)
            } else {
                0.0
            };
            let turn = DVec2::from_angle(TAU * index as f64 / count as f64);
            (turn - DVec2::X) * radius
        }
    };
    (0..count).map(|index| unit(index) * spacing_m).collect()
}

/// The sequence 0, 1, -1, 2, -2 and so on.
fn in_turn(index: usize) -> f64 {
    let steps = index.div_ceil(2) as f64;
    if index % 2 == 1 { steps } else { -steps }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use strum::VariantNames as _;

    use super::*;

    #[test]
    fn shapes_are_what_they_are_called() {
        let at = |shape, index: usize| slots(shape, 5, 10.0)[index];
        assert_eq!(at(Shape::Line, 2), DVec2::new(0.0, -10.0));
        assert_eq!(at(Shape::Column, 4), DVec2::new(-40.0, 0.0));
        let arm = at(Shape::Wedge, 3);
        assert!(
            (arm - DVec2::new(-14.142_136, 14.142_136)).length() < 1e-5,
            "{arm}"
        );
        assert_eq!(at(Shape::Grid, 3), DVec2::new(-10.0, 0.0));
    }

    proptest! {
        #[test]
        fn neighbours_are_as_far_apart_as_was_asked_and_nobody_is_nearer(
            count in 1usize..30, spacing in 5.0..50.0f64, shape in 0usize..5,
        ) {
            let shape = Shape::VARIANTS[shape].parse::<Shape>().expect("a shape");
            let slots = slots(shape, count, spacing);
            prop_assert_eq!(slots[0], DVec2::ZERO);
            for (index, slot) in slots.iter().enumerate() {
                let others = slots.iter().enumerate().filter(|(other, _)| *other != index);
                let nearest = others.map(|(_, other)| slot.distance(*other));
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                prop_assert!(count == 1 || (nearest - spacing).abs() < 1e-6, "{shape:?} {nearest}");
            }
        }
    }
}
