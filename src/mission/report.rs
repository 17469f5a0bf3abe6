//! The trainee's reports of contacts.

use std::time::Duration;

use super::Point;
use crate::commands::FindKind;
use crate::geo::maths;
use crate::vehicle::VehicleId;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mark {
    pub at: Point,
    /// Its kind; `None` if the trainee gave none.
    pub kind: Option<FindKind>,
    pub by: VehicleId,
    pub when: Duration,
}

/// Reports closer together than this count as the same.
pub(crate) const SAME_WITHIN_M: f64 = 0.5;
const UNMARK_WITHIN_M: f64 = 15.0;

/// All reports of a flight that were not withdrawn, in order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Marks(Vec<Mark>);

impl Marks {
    pub fn all(&self) -> &[Mark] {
        &self.0
    }

    /// Adds a report; false if it repeats an earlier one.
    pub fn add(&mut self, mark: Mark) -> bool {
        let same =
            |known: &Mark| known.kind == mark.kind && distance_m(known.at, mark.at) < SAME_WITHIN_M;
        let new = !self.0.iter().any(same);
        if new {
            self.0.push(mark);
        }
        new
    }

    /// Withdraws the nearest report within reach; `None` if there is none.
    pub fn remove(&mut self, at: Point) -> Option<Mark> {
        let distances = self.0.iter().map(|mark| distance_m(mark.at, at));
        let (index, distance) = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        (distance <= UNMARK_WITHIN_M).then(|| self.0.remove(index))
    }
}

/// The distance between two points on the ground, in metres.
pub(crate) fn distance_m(a: Point, b: Point) -> f64 {
    maths::hypot(a[0] - b[0], a[1] - b[1])
}
