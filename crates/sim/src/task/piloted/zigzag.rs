//! ZIGZAG: two stored points, and the lines through them at a right angle to the way from one to the other.

use glam::{DVec2, DVec3};

/// The vehicle is at its destination within this distance at most, once its path has ended there.
const ARRIVED_MAX_M: f64 = 3.0;
const PATH_ENDS_M: f64 = 0.05;

/// A point of ZIGZAG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineEnd {
    A,
    B,
}

impl LineEnd {
    /// Its name in texts.
    pub(crate) fn name(self) -> char {
        match self {
            Self::A => 'A',
            Self::B => 'B',
        }
    }
}

/// The points stored since the mode was entered, north and east of the start.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ZigZag {
    a_m: Option<DVec2>,
    b_m: Option<DVec2>,
    /// The destination, until the pilot has control again.
    goal_m: Option<DVec3>,
}

impl ZigZag {
    /// Stores the place as a point, as long as a point is missing; `false` otherwise.
    pub(crate) fn store(&mut self, end: LineEnd, here_m: DVec2) -> bool {
        if self.line().is_some() {
            return false;
        }
        match end {
            LineEnd::A => self.a_m = Some(here_m),
            LineEnd::B => self.b_m = Some(here_m),
        }
        true
    }

    /// Both points, if they differ.
    fn line(&self) -> Option<(DVec2, DVec2)> {
        let (a_m, b_m) = (self.a_m?, self.b_m?);
        (a_m != b_m).then_some((a_m, b_m))
    }

    /// Begins the flight from a place, at the height of the path, to the nearest point of the line through `end`; `None`
    /// without both points. A flight that is under way keeps its height.
    pub(crate) fn cross(&mut self, end: LineEnd, here_m: DVec3) -> Option<DVec3> {
        let (a_m, b_m) = self.line()?;
        let along = (b_m - a_m).normalize();
        let from_m = match end {
            LineEnd::A => a_m,
            LineEnd::B => b_m,
        };
        let flat_m = here_m.truncate();
        let down_m = self.goal_m.map_or(here_m.z, |goal_m| goal_m.z);
        let goal_m = (flat_m - along * (flat_m - from_m).dot(along)).extend(down_m);
        self.goal_m = Some(goal_m);
        self.goal_m
    }

    /// Whether the path has ended at the destination, and the vehicle is within a radius of it.
    pub(crate) fn has_arrived(&self, path_m: DVec3, here_m: DVec3, radius_m: f64) -> bool {
        self.goal_m.is_some_and(|goal_m| {
            let within = radius_m.min(ARRIVED_MAX_M);
            goal_m.distance(path_m) <= PATH_ENDS_M && goal_m.distance(here_m) <= within
        })
    }

    /// Ends a flight; `false` if there was none.
    pub(crate) fn end(&mut self) -> bool {
        self.goal_m.take().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crossing_leads_straight_to_the_line_through_the_point() {
        let mut zigzag = ZigZag::default();
        assert_eq!(zigzag.cross(LineEnd::A, DVec3::ZERO), None);
        assert!(zigzag.store(LineEnd::A, DVec2::new(1.0, 0.0)));
        assert!(zigzag.store(LineEnd::B, DVec2::new(1.0, 20.0)));
        assert!(!zigzag.store(LineEnd::B, DVec2::ZERO));
        let here_m = DVec3::new(31.0, 20.0, -10.0);
        let goal_m = zigzag.cross(LineEnd::A, here_m).expect("both points");
        assert!((goal_m - DVec3::new(31.0, 0.0, -10.0)).length() < 1e-9);
        let near_m = goal_m + DVec3::Y * 1.9;
        assert!(!zigzag.has_arrived(goal_m, here_m, 5.0));
        assert!(!zigzag.has_arrived(goal_m, goal_m + DVec3::Y * 3.5, 5.0));
        assert!(!zigzag.has_arrived(near_m, near_m, 2.0));
        assert!(zigzag.has_arrived(goal_m, near_m, 2.0));
        assert!(zigzag.end() && !zigzag.end());
    }
}
