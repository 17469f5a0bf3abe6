//! The trail of a vehicle.

use crate::geo::LatLon;

const MOST_POINTS: usize = 256;
/// The initial distance between two points, in metres.
const SPACING_M: f64 = 1.0;
/// A step longer than this, in metres, and than four times the spacing means that the position was
/// reset: the trail starts again.
const JUMP_M: f64 = 500.0;

/// The path of one vehicle. A trail keeps its start: when it is full, every second point is dropped and the spacing
/// doubles.
#[derive(Debug, Clone)]
pub struct Trail {
    points: Vec<LatLon>,
    spacing_m: f64,
}

impl Default for Trail {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            spacing_m: SPACING_M,
        }
    }
}

impl Trail {
    /// Adds the vehicle's position; returns false if it is too close to the last point.
    pub fn add(&mut self, place: LatLon) -> bool {
        if let Some(last) = self.points.last() {
            let way_m = last.distance_m(place);
            if way_m < self.spacing_m {
                return false;
            }
            if way_m > JUMP_M.max(self.spacing_m * 4.0) {
                *self = Self::default();
            }
        }
        if self.points.len() == MOST_POINTS {
            let mut at = 0;
            self.points.retain(|_| {
                at += 1;
                at % 2 == 1
            });
            self.spacing_m *= 2.0;
        }
        self.points.push(place);
        true
    }

    /// The points, oldest first.
    pub fn points(&self) -> &[LatLon] {
        &self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    #[test]
    fn a_long_flight_is_kept_as_a_whole_in_bounded_room() {
        let mut trail = Trail::default();
        for metre in 0..20_000 {
            trail.add(HOME.moved(f64::from(metre), 0.0));
        }
        let points = trail.points();
        assert!((MOST_POINTS / 2..=MOST_POINTS).contains(&points.len()));
        assert!(points[0].distance_m(HOME) < 0.01);
        let way_m = |pair: &[LatLon]| pair[0].distance_m(pair[1]);
        let longest = points.windows(2).map(way_m).fold(0.0, f64::max);
        assert!(longest < 20_000.0 / 64.0, "a gap of {longest} m");
        let last = points.last().expect("a point").distance_m(HOME);
        assert!(last > 19_700.0, "the newest part is there: {last}");
    }

    #[test]
    fn hovering_adds_nothing_and_a_reset_position_begins_anew() {
        let mut trail = Trail::default();
        assert!(trail.add(HOME));
        for step in 0..100 {
            assert!(!trail.add(HOME.moved(0.009 * f64::from(step), 0.0)));
        }
        assert!(trail.add(HOME.moved(5.0, 0.0)));
        assert!(trail.add(HOME.moved(9_000.0, 0.0)));
        assert_eq!(trail.points().len(), 1);
    }
}
