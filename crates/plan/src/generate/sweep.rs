//! Lines over an area.

use glam::DVec2;

use super::field::Field;
use super::tour::{Begin, Way, cells, tour};
use super::{Course, GenerateError, Scene};
use crate::pattern::{Lane, Strips, distance_to_segment, is_in_rings};

const MOST_COURSES: usize = 24;
/// The number of points across an area at which its coverage is tested.
const SAMPLES: f64 = 100.0;

/// The lines over an area, in each order in which they may be flown; one order is chosen later.
pub(super) struct Lines {
    pub(super) ways: Vec<Way>,
    /// The share of the area that is not covered.
    pub(super) uncovered: f64,
}

pub(super) fn lines(
    scene: &Scene,
    rings: &[Vec<DVec2>],
    spacing_m: f64,
    course: Course,
) -> Result<Lines, GenerateError> {
    let outline = rings.first().ok_or(GenerateError::Empty)?;
    let mut best: Option<(f64, Vec<Vec<Lane>>)> = None;
    for course_deg in courses(outline, spacing_m, course)? {
        let strips = Strips::over(outline, spacing_m, course_deg)?;
        let found = found_cells(&strips, rings, spacing_m, &scene.field);
        let strokes = tour(&found, Begin::ALL[0]);
        let cost = scene.pace.path(&strokes.concat()).hover_s;
        if best.as_ref().is_none_or(|(least, _)| cost < *least) && !found.is_empty() {
            best = Some((cost, found));
        }
    }
    let (_, found) = best.ok_or(GenerateError::OutsideFence)?;
    let ways = Begin::ALL
        .into_iter()
        .filter_map(|begin| Way::new(tour(&found, begin), &scene.field));
    let ways: Vec<Way> = ways.collect();
    if ways.is_empty() {
        return Err(GenerateError::OutsideFence);
    }
    let uncovered = if scene.field.is_open() {
        0.0
    } else {
        uncovered(rings, &found.concat(), spacing_m)
    };
    Ok(Lines { ways, uncovered })
}

fn found_cells(
    strips: &Strips,
    rings: &[Vec<DVec2>],
    spacing_m: f64,
    field: &Field,
) -> Vec<Vec<Lane>> {
    let rows = strips.lines(rings, spacing_m).into_iter();
    let rows: Vec<Vec<Lane>> = rows
        .map(|row| {
            row.into_iter()
                .flat_map(|lane| field.inside(lane))
                .collect()
        })
        .collect();
    cells(&rows, strips.along())
}

fn courses(
    outline: &[DVec2],
    spacing_m: f64,
    course: Course,
) -> Result<Vec<Option<f64>>, GenerateError> {
    Ok(match course {
        Course::Degrees(degrees) => vec![Some(degrees)],
        Course::Long => vec![None],
        Course::Short => {
            let across = Strips::over(outline, spacing_m, None)?.across();
            vec![Some(across.to_angle().to_degrees())]
        }
        Course::Best => {
            let edges = outline.iter().zip(outline.iter().cycle().skip(1));
            let mut edges: Vec<DVec2> = edges.map(|(from, to)| *to - *from).collect();
            edges.sort_by(|a, b| b.length().total_cmp(&a.length()));
            let mut degrees: Vec<f64> = Vec::new();
            for edge in edges.into_iter().filter(|edge| edge.length() > 0.0) {
                let course = edge.to_angle().to_degrees().rem_euclid(180.0);
                let is_known = degrees.iter().any(|known| (known - course).abs() < 1.0);
                if !is_known && degrees.len() < MOST_COURSES {
                    degrees.push(course);
                }
            }
            let edges = degrees.into_iter().map(Some);
            std::iter::once(None).chain(edges).collect()
        }
    })
}

/// The share of an area that is farther than half the spacing from all lines.
fn uncovered(rings: &[Vec<DVec2>], lanes: &[Lane], spacing_m: f64) -> f64 {
    let corners = || rings.iter().flatten().copied();
    let low = corners().fold(DVec2::INFINITY, DVec2::min);
    let high = corners().fold(DVec2::NEG_INFINITY, DVec2::max);
    let step = (high - low) / SAMPLES;
    let (mut inside, mut bare) = (0u32, 0u32);
    for north in 0..SAMPLES as u32 {
        for east in 0..SAMPLES as u32 {
            let cell = DVec2::new(f64::from(north) + 0.5, f64::from(east) + 0.5);
            let point = low + step * cell;
            if !is_in_rings(point, rings) {
                continue;
            }
            inside += 1;
            let near = |lane: &Lane| distance_to_segment(point, lane.from, lane.to);
            let limit = spacing_m / 2.0 + 1e-6;
            bare += u32::from(!lanes.iter().any(|lane| near(lane) <= limit));
        }
    }
    f64::from(bare) / f64::from(inside.max(1))
}
