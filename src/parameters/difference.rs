//! The differences between two lists of parameters.

use std::collections::BTreeMap;

/// How a parameter of one list differs from another list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParameterFinding {
    /// Both lists have the parameter, with different values: this list's and the other's.
    Changed(f64, f64),
    /// Only the other list has the parameter, with this value.
    Missing(f64),
    /// Only this list has the parameter, with this value.
    Extra(f64),
}

/// One parameter that differs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterDifference<'a> {
    pub name: &'a str,
    pub finding: ParameterFinding,
}

/// The rounding of a number written with about seven digits.
const ROUNDING: f64 = 1e-6;

/// Whether two values are equal. Whole numbers must match exactly, since they may be bit masks;
/// other numbers may have been rounded in a file.
#[expect(
    clippy::float_cmp,
    reason = "whole numbers are compared, and equal is meant"
)]
pub fn is_same(one: f64, other: f64) -> bool {
    if one == other || (one.is_nan() && other.is_nan()) {
        return true;
    }
    let is_rounded = one.fract() != 0.0 || other.fract() != 0.0;
    is_rounded && (one - other).abs() <= ROUNDING * one.abs().max(other.abs())
}

/// The differences between this list and another, in order of the names.
pub fn differences<'a>(
    this: impl Iterator<Item = (&'a str, f64)>,
    other: impl Iterator<Item = (&'a str, f64)>,
) -> Vec<ParameterDifference<'a>> {
    let mut sides: BTreeMap<&str, (Option<f64>, Option<f64>)> = BTreeMap::new();
    for (name, value) in this {
        sides.entry(name).or_default().0 = Some(value);
    }
    for (name, value) in other {
        sides.entry(name).or_default().1 = Some(value);
    }
    let found = sides.into_iter().filter_map(|(name, sides)| {
        let finding = match sides {
            (Some(this), Some(other)) if is_same(this, other) => return None,
            (Some(this), Some(other)) => ParameterFinding::Changed(this, other),
            (Some(this), None) => ParameterFinding::Extra(this),
            (None, Some(other)) => ParameterFinding::Missing(other),
            (None, None) => return None,
        };
        Some(ParameterDifference { name, finding })
    });
    found.collect()
}

/// Whether a parameter identifies one vehicle, counts its use or its lists, or holds what it has
/// measured by itself: its system id, the ids of its sensors, its hours, the number of its plan's
/// items, the offsets of its gyroscopes. It must not be copied: two vehicles with the same system id receive each
/// other's commands.
pub fn is_the_vehicles_own(name: &str) -> bool {
    let is_one_of_its_ids = matches!(name, "SYSID_THISMAV" | "MAV_SYSID" | "FORMAT_VERSION")
        || name.contains("DEVID")
        || name.contains("DEV_ID");
    let is_counted = name.starts_with("STAT_")
        || name.ends_with("_TOTAL")
        || matches!(name, "SYS_NUM_RESETS" | "SYS_NUMRESETS");
    let is_measured = name.ends_with("_GND_PRESS")
        || name.ends_with("_CALTEMP")
        || name == "COMPASS_DEC"
        || (name.starts_with("INS_GYR") && name.contains("OFFS"));
    is_one_of_its_ids || is_counted || is_measured
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_and_each_way_to_differ_is_found_in_order() {
        let this = [("C", 1.0), ("A", 1.0), ("B", 2.0), ("D", 0.1)];
        let other = [("A", 1.0), ("B", 3.0), ("E", 5.0), ("D", 0.100_000_01)];
        let found = differences(this.into_iter(), other.into_iter());
        let expected = [
            ("B", ParameterFinding::Changed(2.0, 3.0)),
            ("C", ParameterFinding::Extra(1.0)),
            ("E", ParameterFinding::Missing(5.0)),
        ];
        let expected = expected.map(|(name, finding)| ParameterDifference { name, finding });
        assert_eq!(found, expected);
    }

    #[test]
    fn a_bit_more_in_a_mask_is_a_difference_and_rounding_is_none() {
        assert!(!is_same(16_777_214.0, 16_777_215.0));
        assert!(is_same(0.135, 0.135_000_02));
        assert!(!is_same(0.135, 0.1351));
        assert!(!is_same(0.0, 1e-9));
        assert!(is_same(f64::NAN, f64::NAN));
        assert!(!is_same(f64::NAN, 0.0));
        assert!(is_same(-0.0, 0.0));
    }

    #[test]
    fn what_makes_a_vehicle_itself_is_known() {
        for own in [
            "SYSID_THISMAV",
            "STAT_RUNTIME",
            "COMPASS_DEV_ID2",
            "BARO1_DEVID",
            "MIS_TOTAL",
            "RALLY_TOTAL",
            "FENCE_TOTAL",
            "INS_GYROFFS_X",
            "INS_GYR2OFFS_Z",
            "INS_GYR1_CALTEMP",
            "COMPASS_DEC",
            "SYS_NUM_RESETS",
        ] {
            assert!(is_the_vehicles_own(own), "{own}");
        }
        for common in ["WPNAV_SPEED", "INS_GYRO_FILTER", "FENCE_RADIUS"] {
            assert!(!is_the_vehicles_own(common), "{common}");
        }
    }
}
