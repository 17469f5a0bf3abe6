//! ZIGZAG: two stored points, and the lines through them, perpendicular to the line from one to the other.

use glam::DVec2;

/// A point of ZIGZAG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineEnd {
    A,
    B,
}

impl LineEnd {
    /// The point's name in texts.
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

    /// The point nearest to a place on the line through `end`; `None` without both points.
    pub(crate) fn across(&self, end: LineEnd, here_m: DVec2) -> Option<DVec2> {
        let (a_m, b_m) = self.line()?;
        let along = (b_m - a_m).normalize();
        let from_m = match end {
            LineEnd::A => a_m,
            LineEnd::B => b_m,
        };
        Some(here_m - along * (here_m - from_m).dot(along))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_leads_straight_to_the_line_through_the_point() {
        let mut zigzag = ZigZag::default();
        let here_m = DVec2::new(31.0, 20.0);
        assert_eq!(zigzag.across(LineEnd::A, here_m), None);
        assert!(zigzag.store(LineEnd::A, DVec2::new(1.0, 0.0)));
        assert!(zigzag.store(LineEnd::B, DVec2::new(1.0, 20.0)));
        assert!(!zigzag.store(LineEnd::B, DVec2::ZERO));
        let goal_m = zigzag.across(LineEnd::A, here_m).expect("both points");
        assert!((goal_m - DVec2::new(31.0, 0.0)).length() < 1e-9);
    }
}
