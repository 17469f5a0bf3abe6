//! The leg of a plan as text.

use super::map::length;
use super::short_clock;
use crate::vehicle::PlanLeg;

/// The distance and the time to the next place: `140 m 0:14`; `None` if both are unknown.
pub fn way(leg: &PlanLeg) -> Option<String> {
    let way = leg.left_m.map(length);
    let time = leg.next.map(short_clock);
    let parts: Vec<String> = way.into_iter().chain(time).collect();
    (!parts.is_empty()).then(|| parts.join(" "))
}

/// The time to the end of the plan, if known.
pub fn end(leg: &PlanLeg) -> Option<String> {
    leg.end.map(short_clock)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn what_is_not_known_is_left_out() {
        let mut leg = PlanLeg {
            item: 3,
            last: 12,
            to: None,
            left_m: Some(1240.0),
            next: Some(Duration::from_secs(94)),
            end: None,
        };
        assert_eq!(way(&leg).as_deref(), Some("1.2 km 1:34"));
        assert_eq!(end(&leg), None);
        leg.next = None;
        assert_eq!(way(&leg).as_deref(), Some("1.2 km"));
        leg.left_m = None;
        assert_eq!(way(&leg), None);
    }
}
