//! Whether the items of a fence make a fence.

use mavlink::dialects::ardupilotmega::MavSeverity::{
    self, MAV_SEVERITY_INFO, MAV_SEVERITY_WARNING,
};

use super::items::{
    CIRCLE_EXCLUSION, CIRCLE_INCLUSION, FENCE_RETURN_POINT, POLYGON_EXCLUSION, POLYGON_INCLUSION,
    is_on_earth,
};
use crate::sim::plan::Item;

/// Bytes of storage for fences.
const STORAGE: usize = 560;

/// What the vehicle says of a fence it does not take.
pub(super) type Complaint = (MavSeverity, String);

/// Looks a complete fence over.
pub(super) fn check(items: &[Item]) -> Result<(), Complaint> {
    let mut polygon = Polygon::default();
    let mut return_points = 0;
    for item in items {
        match item.command {
            POLYGON_INCLUSION | POLYGON_EXCLUSION => polygon.corner(item)?,
            _ => polygon.other(item)?,
        }
        let circle = matches!(item.command, CIRCLE_INCLUSION | CIRCLE_EXCLUSION);
        if circle && !(item.p[0].is_finite() && item.p[0] > 0.0) {
            return warn("Non-positive circle radius");
        }
        return_points += usize::from(item.command == FENCE_RETURN_POINT);
        if return_points > 1 {
            return warn("Multiple return points");
        }
        if !is_on_earth(item.x, item.y) {
            return warn("Bad lat or lon");
        }
    }
    if polygon.missing > 0 {
        return Err((MAV_SEVERITY_INFO, "Incorrect item count".into()));
    }
    Ok(())
}

/// Whether there is room to keep it.
pub(super) fn fits(items: &[Item]) -> bool {
    let mut needed = 4;
    let mut rest = items;
    while let Some(item) = rest.first() {
        let (bytes, length) = match item.command {
            POLYGON_INCLUSION | POLYGON_EXCLUSION => {
                let corners = usize::from(item.p[0] as u8);
                (2 + 8 * corners, corners.max(1))
            }
            CIRCLE_INCLUSION | CIRCLE_EXCLUSION => (13, 1),
            _ => (9, 1),
        };
        needed += bytes;
        rest = rest.get(length..).unwrap_or_default();
    }
    needed <= STORAGE
}

/// The value of `FENCE_TOTAL`: corners and circles, and two more that the old fence protocol counts.
pub(super) fn total(items: &[Item]) -> f32 {
    let counted = items
        .iter()
        .filter(|item| item.command != FENCE_RETURN_POINT)
        .count();
    if counted < 3 {
        0.0
    } else {
        (counted + 2) as f32
    }
}

/// The polygon that is being read.
#[derive(Default)]
struct Polygon {
    command: u16,
    corners: u8,
    missing: u8,
}

impl Polygon {
    fn corner(&mut self, item: &Item) -> Result<(), Complaint> {
        let corners = item.p[0] as u8;
        if corners < 3 {
            return warn(&format!("Invalid vertex count ({corners})"));
        }
        if self.missing == 0 {
            self.command = item.command;
            self.corners = corners;
            self.missing = corners;
        } else if item.command != self.command {
            let (want, got) = (storage_type(self.command), storage_type(item.command));
            return warn(&format!(
                "Received incorrect vertex type (want={want} got={got})"
            ));
        } else if corners != self.corners {
            let want = self.corners;
            return warn(&format!(
                "Unexpected vertex count want={want} got={corners}\n"
            ));
        }
        self.missing -= 1;
        Ok(())
    }

    fn other(&self, item: &Item) -> Result<(), Complaint> {
        if self.missing == 0 {
            return Ok(());
        }
        let (want, got) = (storage_type(self.command), storage_type(item.command));
        warn(&format!("Received incorrect type (want={want} got={got})"))
    }
}

/// The number under which the vehicle stores each kind; its texts name it.
fn storage_type(command: u16) -> u8 {
    match command {
        POLYGON_INCLUSION => 98,
        POLYGON_EXCLUSION => 97,
        FENCE_RETURN_POINT => 95,
        CIRCLE_EXCLUSION => 93,
        _ => 92,
    }
}

fn warn(text: &str) -> Result<(), Complaint> {
    Err((MAV_SEVERITY_WARNING, text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(corners: u8) -> Item {
        Item {
            command: POLYGON_INCLUSION,
            p: [f32::from(corners), 0.0, 0.0, 0.0],
            ..Item::default()
        }
    }

    fn circle(radius_m: f32) -> Item {
        Item {
            command: CIRCLE_EXCLUSION,
            p: [radius_m, 0.0, 0.0, 0.0],
            ..Item::default()
        }
    }

    #[test]
    fn a_fence_is_complete_or_refused_in_the_vehicles_words() {
        let good = [corner(3), corner(3), corner(3), circle(8.0)];
        assert_eq!(check(&good), Ok(()));
        assert!((total(&good) - 6.0).abs() < f32::EPSILON);
        for (bad, text) in [
            (vec![corner(2), corner(2)], "Invalid vertex count (2)"),
            (vec![corner(3), corner(3)], "Incorrect item count"),
            (vec![circle(0.0)], "Non-positive circle radius"),
            (vec![circle(f32::NAN)], "Non-positive circle radius"),
            (
                vec![corner(3), circle(5.0)],
                "Received incorrect type (want=98 got=93)",
            ),
        ] {
            assert_eq!(check(&bad).expect_err("bad").1, text);
        }
    }

    #[test]
    fn a_large_fence_does_not_fit() {
        assert!(fits(&vec![corner(60); 60]));
        assert!(!fits(&vec![corner(70); 70]));
    }
}
