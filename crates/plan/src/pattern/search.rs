//! Search paths around a datum (IAMSAR Manual, volume II, chapter 5).

use glam::DVec2;

use super::course;

/// The maximum number of legs; a larger number is probably a typing error.
const MOST_LEGS: usize = 400;

/// An expanding square from the datum, first to the north: two legs of the spacing, two of twice the spacing, and so
/// on, until the square reaches the radius.
pub fn square(spacing_m: f64, radius_m: f64) -> Vec<DVec2> {
    let mut points = vec![DVec2::ZERO];
    let mut at = DVec2::ZERO;
    for leg in 0..MOST_LEGS {
        let turn = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y][leg % 4];
        at += turn * (leg / 2 + 1) as f64 * spacing_m;
        points.push(at);
        // After four legs, each side lies half a spacing further out.
        if (leg + 1) as f64 / 4.0 * spacing_m >= radius_m {
            break;
        }
    }
    points
}

/// A sector search: nine legs in three triangles, each leg as long as the radius. All turns are by
/// 120 degrees to starboard, so every triangle begins and ends at the datum.
pub fn sector(radius_m: f64, first_course_deg: f64) -> Vec<DVec2> {
    let mut points = vec![DVec2::ZERO];
    let mut at = DVec2::ZERO;
    let mut heading_deg = first_course_deg;
    for leg in 0..9 {
        at += course(heading_deg) * radius_m;
        points.push(at);
        // At the datum the path continues straight ahead.
        if leg % 3 != 2 {
            heading_deg += 120.0;
        }
    }
    points
}

/// Divides a path into pieces of equal length.
pub fn pieces(points: &[DVec2], count: usize) -> Vec<Vec<DVec2>> {
    let total: f64 = points.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
    let piece_m = total / count as f64;
    let mut pieces = Vec::new();
    let mut piece: Vec<DVec2> = points.first().copied().into_iter().collect();
    let mut left_m = piece_m;
    for leg in points.windows(2) {
        let mut from = leg[0];
        while pieces.len() + 1 < count && from.distance(leg[1]) > left_m {
            from += (leg[1] - from).normalize_or_zero() * left_m;
            piece.push(from);
            pieces.push(std::mem::replace(&mut piece, vec![from]));
            left_m = piece_m;
        }
        left_m -= from.distance(leg[1]);
        piece.push(leg[1]);
    }
    pieces.push(piece);
    pieces
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_square_grows_by_its_spacing_every_second_leg() {
        let points = square(20.0, 40.0);
        let legs: Vec<f64> = points
            .windows(2)
            .map(|leg| leg[0].distance(leg[1]))
            .collect();
        assert_eq!(legs, [20.0, 20.0, 40.0, 40.0, 60.0, 60.0, 80.0, 80.0]);
        assert_eq!(points[4], DVec2::new(-20.0, -20.0));
    }

    #[test]
    fn a_sector_search_passes_the_datum_after_every_third_leg() {
        let points = sector(100.0, 0.0);
        assert_eq!(points.len(), 10);
        for at in [3, 6, 9] {
            assert!(points[at].length() < 1e-9, "{at}");
        }
        let corners = points.iter().filter(|point| point.length() > 1.0);
        for corner in corners {
            assert!((corner.length() - 100.0).abs() < 1e-9, "{corner}");
        }
        // The three triangles lie 120 degrees apart: no corner is visited twice on the way out.
        let out: Vec<DVec2> = [1, 4, 7].map(|at| points[at]).to_vec();
        assert!((out[0].distance(out[1]) - 173.205).abs() < 1e-2, "{out:?}");
    }

    proptest! {
        #[test]
        fn pieces_are_equal_and_make_up_the_whole(count in 1usize..9, spacing in 5.0..40.0f64,
                                                  turns in 1.0..6.0f64) {
            let points = square(spacing, spacing * turns);
            let pieces = pieces(&points, count);
            prop_assert_eq!(pieces.len(), count);
            let length = |points: &[DVec2]| -> f64 {
                points.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
            };
            for piece in &pieces {
                let share = length(&points) / count as f64;
                prop_assert!((length(piece) - share).abs() < 1e-6);
            }
            for pair in pieces.windows(2) {
                prop_assert_eq!(pair[0].last(), pair[1].first());
            }
        }

        #[test]
        fn a_square_leaves_no_gap_wider_than_its_spacing_but_for_its_corners(north in -60.0..60.0f64, east in -60.0..60.0f64) {
            let points = square(20.0, 80.0);
            let point = DVec2::new(north, east);
            let nearest = points
                .windows(2)
                .map(|leg| crate::pattern::distance_to_segment(point, leg[0], leg[1]))
                .fold(f64::INFINITY, f64::min);
            // Between two corners, the diagonal is the limit.
            let most = 10.0 * 2f64.sqrt();
            prop_assert!(nearest <= most + 1e-9, "{nearest}");
        }
    }
}
