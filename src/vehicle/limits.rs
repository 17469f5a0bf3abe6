//! Grades of readings, by the limits at which `ArduPilot` itself refuses, reacts or warns.

use super::{Ekf, EkfFlags, FixType, Gps, GpsAccuracy};

/// The grade of a reading, compared with its limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    /// Well within the limit.
    Good,
    /// Close to the limit.
    Poor,
    /// Beyond the limit, or not a number.
    Bad,
}

/// EKF test ratio of the failsafe: `FS_EKF_THRESH`, 0.8 by default; the arming checks use the same.
pub const EKF_BAD: f32 = 0.8;
/// A strict failsafe threshold: 0.6 in the documentation's list of values for `FS_EKF_THRESH`.
const EKF_POOR: f32 = 0.6;
/// `GPS_HDOP_GOOD`, 140 by default: above it arming is refused.
const HDOP_POOR: f32 = 1.4;
/// A limit of this program, at which the position may drift by metres.
const HDOP_BAD: f32 = 2.0;
/// The number of satellites that EKF3 requires for the GPS (`EK3_GPS_CHECK`, bit 0); fewer are bad.
const SATELLITES_BAD: u8 = 6;
/// Errors above which EKF3 does not begin to use the GPS (`EK3_GPS_CHECK`, bits 2 and 3), in metres.
const HORIZONTAL_BAD_M: f32 = 5.0;
const VERTICAL_BAD_M: f32 = 7.5;
/// Vibration: below 30 is normal, above 60 nearly always spoils the estimates (`ArduPilot`, "Measuring Vibration").
const VIBRATION_POOR_M_S2: f32 = 30.0;
pub const VIBRATION_BAD_M_S2: f32 = 60.0;
/// Battery charges in percent that this program grades as low and as nearly empty.
const BATTERY_POOR_PERCENT: u8 = 25;
const BATTERY_BAD_PERCENT: u8 = 10;
/// Clipping should be zero; more than 100 in a flight is severe (same page).
const CLIPPING_BAD: u32 = 100;

impl Grade {
    /// The grade of a value that is better the lower it is, down to zero. NaN and negative values are bad.
    fn rising(value: f32, poor: f32, bad: f32) -> Self {
        if (0.0..poor).contains(&value) {
            Self::Good
        } else if (poor..bad).contains(&value) {
            Self::Poor
        } else {
            Self::Bad
        }
    }

    /// The grade of an EKF test ratio.
    pub fn of_variance(ratio: f32) -> Self {
        Self::rising(ratio, EKF_POOR, EKF_BAD)
    }

    /// The grade of the filter: bad without a position on the earth, otherwise that of its worst
    /// test ratio. The vertical ratio is left out, as in the failsafe.
    pub fn of_ekf(ekf: &Ekf) -> Self {
        if !ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE) {
            return Self::Bad;
        }
        let ratios = [
            ekf.velocity_variance,
            ekf.position_horizontal_variance,
            ekf.compass_variance,
        ];
        let grades = ratios.map(Self::of_variance).into_iter();
        grades.max().unwrap_or(Self::Bad)
    }

    /// The grade of a kind of fix.
    pub fn of_fix(fix: FixType) -> Self {
        if fix >= FixType::Fix3d {
            Self::Good
        } else {
            Self::Bad
        }
    }

    /// The grade of a number of satellites.
    pub fn of_satellites(count: u8) -> Self {
        if count < SATELLITES_BAD {
            Self::Bad
        } else {
            Self::Good
        }
    }

    /// The grade of a horizontal dilution of precision.
    pub fn of_hdop(hdop: f32) -> Self {
        Self::rising(hdop, HDOP_POOR, HDOP_BAD)
    }

    /// The grade of the receiver's own error estimates.
    pub fn of_accuracy(accuracy: &GpsAccuracy) -> Self {
        let horizontal = Self::rising(accuracy.horizontal_m, HORIZONTAL_BAD_M, HORIZONTAL_BAD_M);
        let vertical = Self::rising(accuracy.vertical_m, VERTICAL_BAD_M, VERTICAL_BAD_M);
        horizontal.max(vertical)
    }

    /// The grade of the receiver as a whole.
    pub fn of_gps(gps: &Gps) -> Self {
        let satellites = gps.satellites.map_or(Self::Good, Self::of_satellites);
        let hdop = gps.hdop.map_or(Self::Good, Self::of_hdop);
        Self::of_fix(gps.fix).max(satellites).max(hdop)
    }

    /// The grade of the vibration along one axis.
    pub fn of_vibration(level_m_s2: f32) -> Self {
        Self::rising(level_m_s2, VIBRATION_POOR_M_S2, VIBRATION_BAD_M_S2)
    }

    /// The grade of a battery's charge.
    pub fn of_battery(left_percent: u8) -> Self {
        if left_percent <= BATTERY_BAD_PERCENT {
            Self::Bad
        } else if left_percent <= BATTERY_POOR_PERCENT {
            Self::Poor
        } else {
            Self::Good
        }
    }

    /// The grade of a count of clipped samples.
    pub fn of_clipping(count: u32) -> Self {
        match count {
            0 => Self::Good,
            1..CLIPPING_BAD => Self::Poor,
            _ => Self::Bad,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_belong_to_the_worse_side_and_no_number_is_bad() {
        for (grade, expected) in [
            (Grade::of_variance(0.59), Grade::Good),
            (Grade::of_variance(0.6), Grade::Poor),
            (Grade::of_variance(0.8), Grade::Bad),
            (Grade::of_variance(f32::NAN), Grade::Bad),
            (Grade::of_variance(-0.1), Grade::Bad),
            (Grade::of_variance(-0.0), Grade::Good),
            (Grade::of_hdop(1.39), Grade::Good),
            (Grade::of_hdop(1.4), Grade::Poor),
            (Grade::of_hdop(2.0), Grade::Bad),
            (Grade::of_satellites(5), Grade::Bad),
            (Grade::of_satellites(6), Grade::Good),
            (Grade::of_fix(FixType::Fix2d), Grade::Bad),
            (Grade::of_fix(FixType::Fix3d), Grade::Good),
            (Grade::of_vibration(30.0), Grade::Poor),
            (Grade::of_vibration(60.0), Grade::Bad),
            (Grade::of_battery(26), Grade::Good),
            (Grade::of_battery(25), Grade::Poor),
            (Grade::of_battery(10), Grade::Bad),
            (Grade::of_clipping(0), Grade::Good),
            (Grade::of_clipping(99), Grade::Poor),
            (Grade::of_clipping(100), Grade::Bad),
        ] {
            assert_eq!(grade, expected);
        }
    }
}
