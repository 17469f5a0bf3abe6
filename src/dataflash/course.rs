//! The modes and positions of a vehicle over time, according to a log or to telemetry. They
//! distinguish two flights in which the vehicle was armed at the same time since boot.

use crate::geo::LatLon;

/// How long a mode of the log counts before and after its time, since telemetry repeats the mode only every second and
/// may lag.
const LAG_US: u64 = 3_000_000;
/// The minimum time between the positions that are kept.
const EVERY_US: u64 = 1_000_000;
/// The maximum distance between the positions of one flight at the same time.
const SAME_PLACE_M: f64 = 50.0;
/// The number of consecutive disagreements that rules out a coincidence.
const CERTAIN: usize = 4;

/// The course of a flight. Times are microseconds since the autopilot booted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Course {
    modes: Vec<TimedMode>,
    places: Vec<TimedPlace>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct TimedMode {
    boot_us: u64,
    /// `ArduPilot`'s number of the mode.
    mode: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct TimedPlace {
    boot_us: u64,
    place: LatLon,
}

/// A disagreement between the courses of a log and of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Disagreement {
    Mode,
    Position,
}

impl Course {
    /// Adds a mode; one that is earlier than the last is left out.
    pub fn add_mode(&mut self, boot_us: u64, mode: u32) {
        if self.modes.last().is_none_or(|it| it.boot_us <= boot_us) {
            self.modes.push(TimedMode { boot_us, mode });
        }
    }

    /// Adds a position, at most one a second.
    pub fn add_place(&mut self, boot_us: u64, place: LatLon) {
        let last = self.places.last();
        if last.is_none_or(|it| it.boot_us.saturating_add(EVERY_US) <= boot_us) {
            self.places.push(TimedPlace { boot_us, place });
        }
    }

    /// The disagreement between telemetry and this course of a log; `None` if both may belong to
    /// one flight.
    pub fn disagreement(&self, telemetry: &Self) -> Option<Disagreement> {
        let other_mode = |it: &TimedMode| {
            self.modes_around(it.boot_us)
                .map(|mut all| !all.any(|mode| mode == it.mode))
        };
        if is_certain(telemetry.modes.iter().filter_map(other_mode)) {
            return Some(Disagreement::Mode);
        }
        let elsewhere = |it: &TimedPlace| {
            let logged = self.place_at(it.boot_us)?;
            Some(logged.distance_m(it.place) > SAME_PLACE_M)
        };
        is_certain(telemetry.places.iter().filter_map(elsewhere)).then_some(Disagreement::Position)
    }

    /// The modes of a log around a time; `None` earlier than [`LAG_US`] after its first mode, or
    /// later than both its last mode and its last position. A log without positions covers only the
    /// time until its last change of mode.
    fn modes_around(&self, boot_us: u64) -> Option<impl Iterator<Item = u32>> {
        let last_place_us = self.places.last().map(|it| it.boot_us);
        let last_us = last_place_us.max(self.modes.last().map(|it| it.boot_us));
        if last_us.is_none_or(|last_us| last_us < boot_us) {
            return None;
        }
        let (from, to) = (boot_us.checked_sub(LAG_US)?, boot_us + LAG_US);
        let begun = self.modes.partition_point(|it| it.boot_us <= from);
        let ended = self.modes.partition_point(|it| it.boot_us <= to);
        let around = &self.modes[begun.checked_sub(1)?..ended];
        Some(around.iter().map(|it| it.mode))
    }

    /// The position closest to a time; `None` if it is more than a second away.
    fn place_at(&self, boot_us: u64) -> Option<LatLon> {
        let next = self.places.partition_point(|it| it.boot_us < boot_us);
        let around = &self.places[next.saturating_sub(1)..];
        let apart = |it: &&TimedPlace| it.boot_us.abs_diff(boot_us);
        let near = around.iter().take(2).min_by_key(apart)?;
        (apart(&near) <= EVERY_US).then_some(near.place)
    }
}

fn is_certain(disagreements: impl Iterator<Item = bool>) -> bool {
    let mut in_a_row = 0;
    for disagrees in disagreements {
        in_a_row = if disagrees { in_a_row + 1 } else { 0 };
        if in_a_row == CERTAIN {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUIDED: u32 = 4;
    const RTL: u32 = 6;

    fn s(seconds: u64) -> u64 {
        seconds * 1_000_000
    }

    /// A one-minute flight north at 10 m/s, switched to RTL after `rtl_s` seconds.
    fn flown(rtl_s: u64, from_east_m: f64) -> Course {
        let start = LatLon::new(50.0, 30.0).moved(0.0, from_east_m);
        let mut course = Course::default();
        for at_s in 0..60 {
            let mode = if at_s < rtl_s { GUIDED } else { RTL };
            course.add_mode(s(at_s), mode);
            course.add_place(s(at_s), start.moved(at_s as f64 * 10.0, 0.0));
        }
        course
    }

    /// The same flight as recorded in a log, which contains only changes of the mode.
    fn logged(rtl_s: u64) -> Course {
        let mut course = Course {
            places: flown(rtl_s, 0.0).places,
            ..Course::default()
        };
        course.add_mode(0, GUIDED);
        course.add_mode(s(rtl_s), RTL);
        course
    }

    #[test]
    fn flights_differ_in_their_modes_or_their_positions() {
        let log = logged(40);
        assert_eq!(log.disagreement(&flown(40, 0.0)), None);
        assert_eq!(log.disagreement(&flown(42, 30.0)), None, "telemetry lags");
        let other = log.disagreement(&flown(50, 0.0));
        assert_eq!(other, Some(Disagreement::Mode));
        let other = log.disagreement(&flown(40, 60.0));
        assert_eq!(other, Some(Disagreement::Position));
    }

    #[test]
    fn flights_differ_in_their_modes_even_if_the_log_has_no_positions() {
        let without_places = |rtl_s: u64| Course {
            places: Vec::new(),
            ..logged(rtl_s)
        };
        let other = without_places(40).disagreement(&flown(20, 0.0));
        assert_eq!(other, Some(Disagreement::Mode));
        assert_eq!(without_places(40).disagreement(&flown(40, 0.0)), None);
        let later = without_places(40).disagreement(&flown(50, 0.0));
        assert_eq!(later, None, "the log may have ended with its last change");
    }

    #[test]
    fn what_one_of_them_does_not_cover_is_no_disagreement() {
        let mut late = Course::default();
        late.add_mode(s(90), RTL);
        late.add_place(s(90), LatLon::new(10.0, 10.0));
        assert_eq!(logged(40).disagreement(&late), None);
        assert_eq!(Course::default().disagreement(&flown(40, 0.0)), None);
        assert_eq!(logged(40).disagreement(&Course::default()), None);
    }
}
