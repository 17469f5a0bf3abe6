//! Numbers and times as text.

use crate::geo::maths;
use std::time::Duration;

use chrono::DateTime;

const LONGEST_IN_SECONDS: u64 = 120;
/// Numbers of at least this size are written with an exponent: the limits for numbers with
/// decimals, and for whole numbers.
const LONG_DECIMAL: f64 = 1e5;
const LONG_WHOLE: f64 = 1e7;

/// A number with this many decimals, never more than a few digits long: `1e38` for values far
/// beyond any measurement, a dash for values that are not numbers. Zero is written without a sign,
/// because a changing sign would flicker.
pub fn figure(value: impl Into<f64>, decimals: usize) -> String {
    let value = value.into();
    let long = if decimals == 0 {
        LONG_WHOLE
    } else {
        LONG_DECIMAL
    };
    if !value.is_finite() {
        return "-".to_owned();
    }
    if value.abs() >= long {
        return format!("{value:.0e}");
    }
    let text = format!("{value:.decimals$}");
    let digits = text.trim_start_matches('-');
    if digits.chars().all(|c| matches!(c, '0' | '.')) {
        digits.to_owned()
    } else {
        text
    }
}

/// A number rounded to this many decimals, for documents; 0 if it is not finite.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = maths::powi(10f64, decimals);
    let rounded = (value * scale).round() / scale;
    // Adding zero turns -0.0, which would print its sign, into 0.0.
    if rounded.is_finite() {
        rounded + 0.0
    } else {
        0.0
    }
}

/// A date and time, given in microseconds since 1970 (UTC): `2026-11-20 14:03:22`.
pub fn utc_of(unix_us: u64) -> String {
    utc_in(unix_us, "%Y-%m-%d %H:%M:%S")
}

/// A date and time to the minute, given in microseconds since 1970 (UTC): `2026-11-20 14:03`.
pub fn utc_minute_of(unix_us: u64) -> String {
    utc_in(unix_us, "%Y-%m-%d %H:%M")
}

fn utc_in(unix_us: u64, form: &str) -> String {
    let signed_us = i64::try_from(unix_us).ok();
    let time = signed_us.and_then(DateTime::from_timestamp_micros);
    time.unwrap_or_default().format(form).to_string()
}

/// A time as minutes and seconds, with hours where there are any.
pub fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 {
        format!("{hours}:{minutes:02}:{seconds:02}")
    } else {
        format!("{minutes:02}:{seconds:02}")
    }
}

/// A time in seconds, in the format of [`clock`]; a negative one becomes 0.
pub fn clock_s(seconds: f64) -> String {
    clock(Duration::try_from_secs_f64(seconds.max(0.0)).unwrap_or(Duration::MAX))
}

/// A duration as text: `90 s` up to 120 s, beyond that `2:05`.
pub fn lasting(time: Duration) -> String {
    let seconds = time.as_secs();
    if seconds <= LONGEST_IN_SECONDS {
        format!("{seconds} s")
    } else {
        format!("{}:{:02}", seconds / 60, seconds % 60)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_in_seconds_up_to_two_minutes() {
        let known = [(5, "5 s"), (120, "120 s"), (121, "2:01"), (3725, "62:05")];
        for (seconds, words) in known {
            assert_eq!(lasting(Duration::from_secs(seconds)), words);
        }
    }

    #[test]
    fn clocks_grow_hours_when_needed() {
        assert_eq!(clock(Duration::from_secs(62)), "01:02");
        assert_eq!(clock(Duration::from_secs(3723)), "1:02:03");
    }

    #[test]
    fn numbers_are_short_whatever_they_are() {
        for (value, decimals, expected) in [
            (1.26, 1, "1.3"),
            (-0.01, 1, "0.0"),
            (-10.0, 1, "-10.0"),
            (1_234_567.0, 0, "1234567"),
            (f64::from(f32::MAX), 1, "3e38"),
            (-1e38, 0, "-1e38"),
            (f64::NAN, 1, "-"),
            (f64::INFINITY, 1, "-"),
        ] {
            assert_eq!(figure(value, decimals), expected);
        }
    }
}
