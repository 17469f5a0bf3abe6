//! Patterns around a place.

use glam::DVec2;

use super::field::Field;
use super::layers::stack;
use super::sweep::Lines;
use super::tour::{Way, length_m};
use super::{Circle, GenerateError, Manner, Scene, Work};
use crate::pattern::{Lane, course, sector, square as expanding_square};

/// The expanding square: one stroke, or the parts of its legs inside the fence, with paths around
/// the areas between them.
pub(super) fn square(
    field: &Field,
    datum: DVec2,
    spacing_m: f64,
    radius_m: f64,
) -> Result<Lines, GenerateError> {
    let points = expanding_square(spacing_m, radius_m).into_iter();
    let points: Vec<DVec2> = points.map(|point| datum + point).collect();
    let whole_m = length_m(&points);
    let strokes = if field.holds(&points) {
        vec![points]
    } else {
        let legs = points.windows(2).map(|leg| Lane {
            from: leg[0],
            to: leg[1],
        });
        let kept = legs.flat_map(|leg| field.inside(leg));
        kept.map(|lane| vec![lane.from, lane.to]).collect()
    };
    let kept_m: f64 = strokes.iter().map(|stroke| length_m(stroke)).sum();
    let way = Way::new(strokes, field).filter(|way| way.length_m() > 0.0);
    Ok(Lines {
        ways: vec![way.ok_or(GenerateError::OutsideFence)?],
        uncovered: (1.0 - kept_m / whole_m.max(f64::EPSILON)).max(0.0),
    })
}

/// A sector search for each vehicle: rotated relative to the others, and at a height of its own, as all cross the
/// datum.
pub(super) fn sectors(scene: &Scene, manner: &Manner, datum: DVec2, radius_m: f64) -> Vec<Work> {
    let count = scene.homes.len();
    let work = |vehicle: usize| {
        let points = sector(radius_m, 60.0 * vehicle as f64 / count as f64);
        Work {
            vehicle,
            points: points.into_iter().map(|point| datum + point).collect(),
            height_m: manner.height_m,
            layer_m: manner.height_m,
            circle: None,
        }
    };
    let mut works: Vec<Work> = (0..count).map(work).collect();
    stack(scene, &mut works, manner.layer_m);
    works
}

/// Circles with evenly spaced starting points, each at a height of its own.
pub(super) fn orbits(scene: &Scene, manner: &Manner, circle: Circle) -> Vec<Work> {
    let count = scene.homes.len();
    let towards = scene
        .homes
        .first()
        .map_or(DVec2::X, |home| *home - circle.centre);
    let first_deg = towards.to_angle().to_degrees();
    let work = |vehicle: usize| {
        let angle = first_deg + 360.0 * vehicle as f64 / count as f64;
        Work {
            vehicle,
            points: vec![circle.centre + course(angle) * circle.radius_m],
            height_m: manner.height_m,
            layer_m: manner.height_m,
            circle: Some(circle),
        }
    };
    let mut works: Vec<Work> = (0..count).map(work).collect();
    stack(scene, &mut works, manner.layer_m);
    works
}
