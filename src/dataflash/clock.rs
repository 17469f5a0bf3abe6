//! Aligns the clock of an autopilot with that of a record.
//!
//! Logs count microseconds since the autopilot booted. Telemetry counts from the same time, but in
//! milliseconds (`SYSTEM_TIME`, `ATTITUDE`, `GLOBAL_POSITION_INT`), and a record contains the time
//! at which each message arrived. These times connect the two clocks, even if time passed faster in
//! a simulator. GPS time, which is in both log and telemetry, shows whether they belong to the same
//! boot. A record without boot times is aligned by the times at which the vehicle was armed.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavModeFlag};
use serde::{Deserialize, Serialize};

use super::{Course, Disagreement, LoggedFlight};
use crate::geo::LatLon;
use crate::text;
use crate::text::Text;
use crate::wire::{Content, Frame};

/// If the boot time goes back by more than this, the autopilot has rebooted.
const REBOOT_US: u64 = 2_000_000;
/// Boots count as the same if their GPS times differ by less than this, since telemetry arrives late.
const SAME_BOOT_US: u64 = 5_000_000;
/// The time within which telemetry shows that the vehicle was armed.
const ARMING_US: u64 = 3_000_000;
/// The maximum number of armings that are compared, both of a log and of a record: any pair of them
/// may match.
pub(super) const MOST_ARMINGS: usize = 100;
/// The minimum time between two clock readings that are kept.
const EVERY_US: u64 = 200_000;

/// One boot of an autopilot, according to telemetry.
#[derive(Debug, Clone, Default)]
struct AutopilotStart {
    /// Pairs of microseconds since boot and microseconds from the beginning of the record.
    places: Vec<(u64, u64)>,
    /// When the autopilot booted, by its clock: microseconds since 1970 (UTC).
    booted_unix_us: Option<u64>,
    course: Course,
}

/// The data of a record about a vehicle's clock.
#[derive(Debug, Clone, Default)]
pub struct VehicleClock {
    boots: Vec<AutopilotStart>,
    /// When the vehicle was armed, in microseconds from the beginning of the record.
    armed_us: Vec<u64>,
    is_armed: Option<bool>,
}

/// The data by which a log was aligned with a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AlignedBy {
    /// The time since boot in telemetry; GPS time shows that it is the same boot.
    GpsTime,
    /// The time since boot in telemetry; log and record agree on when the vehicle was armed.
    BootTime,
    /// The time since boot in telemetry alone: nothing shows that it is the same flight.
    BootTimeOnly,
    /// The time at which the vehicle was armed.
    Arming,
}

/// The conversion from the clock of a log to that of a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alignment {
    pub by: AlignedBy,
    /// Pairs of microseconds since boot and from the beginning of the record; earliest first, at least one.
    places: Vec<(u64, u64)>,
}

/// Why a log does not belong to a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misfit {
    /// Log and record share no boot of the autopilot, or cover different parts of it.
    NoCommonTime,
    /// In the time that both cover, the vehicle is armed in only one of them.
    OtherArming,
    /// In the time that both cover, the vehicle's modes or positions differ.
    OtherCourse(Disagreement),
}

struct BootFit {
    alignment: Alignment,
    /// The number of armings that the log and the record share.
    armed: usize,
    common_us: u64,
}

impl BootFit {
    /// More shared armings and a longer common time fit better.
    fn rank(&self) -> impl Ord + use<> {
        (self.armed, self.common_us)
    }
}

impl Misfit {
    /// The reason as text.
    pub fn text(self) -> Text {
        match self {
            Self::NoCommonTime => text!("log-no-common-time"),
            Self::OtherArming => text!("log-other-arming"),
            Self::OtherCourse(Disagreement::Mode) => text!("log-other-mode"),
            Self::OtherCourse(Disagreement::Position) => text!("log-other-position"),
        }
    }
}

impl VehicleClock {
    /// Adds a frame of the vehicle's autopilot, received at a time of the record.
    pub fn hear(&mut self, frame: &Frame, at: Duration) {
        let at_us = u64::try_from(at.as_micros()).unwrap_or(u64::MAX);
        let Content::Message(message) = &frame.content else {
            return;
        };
        match message {
            MavMessage::HEARTBEAT(data) => {
                let armed = data
                    .base_mode
                    .contains(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED);
                let is_new = armed && self.is_armed == Some(false);
                if is_new && self.armed_us.len() < MOST_ARMINGS {
                    self.armed_us.push(at_us);
                }
                self.is_armed = Some(armed);
                if let Some(boot) = self.boots.last_mut()
                    && let Some((boot_us, _)) = boot.places.last()
                {
                    boot.course.add_mode(*boot_us, data.custom_mode);
                }
            }
            MavMessage::SYSTEM_TIME(data) => {
                self.pass(data.time_boot_ms, at_us);
                let boot_us = u64::from(data.time_boot_ms) * 1000;
                let booted = data.time_unix_usec.checked_sub(boot_us);
                if let Some(boot) = self.boots.last_mut() {
                    boot.booted_unix_us = booted.filter(|us| *us > 0).or(boot.booted_unix_us);
                }
            }
            MavMessage::ATTITUDE(data) => self.pass(data.time_boot_ms, at_us),
            MavMessage::GLOBAL_POSITION_INT(data) => {
                self.pass(data.time_boot_ms, at_us);
                if let Some(boot) = self.boots.last_mut() {
                    let place = LatLon::from_e7(data.lat, data.lon);
                    boot.course
                        .add_place(u64::from(data.time_boot_ms) * 1000, place);
                }
            }
            _ => {}
        }
    }

    fn pass(&mut self, boot_ms: u32, at_us: u64) {
        let boot_us = u64::from(boot_ms) * 1000;
        let last = self.boots.last().and_then(|it| it.places.last()).copied();
        match (self.boots.last_mut(), last) {
            (Some(boot), Some((before, _))) if boot_us + REBOOT_US >= before => {
                if boot_us >= before + EVERY_US {
                    boot.places.push((boot_us, at_us));
                }
            }
            _ => self.boots.push(AutopilotStart {
                places: vec![(boot_us, at_us)],
                ..AutopilotStart::default()
            }),
        }
    }

    /// Aligns the log of a flight with the record.
    ///
    /// # Errors
    /// The log is from another time or another flight.
    pub fn align(&self, flight: &LoggedFlight) -> Result<Alignment, Misfit> {
        let mut misfit = Misfit::NoCommonTime;
        let mut best: Option<BootFit> = None;
        for boot in &self.boots {
            match self.fit(boot, flight) {
                Ok(fit) if best.as_ref().is_none_or(|best| best.rank() <= fit.rank()) => {
                    best = Some(fit);
                }
                Ok(_) | Err(Misfit::NoCommonTime) => {}
                Err(other) => misfit = other,
            }
        }
        if let Some(fit) = best {
            return Ok(fit.alignment);
        }
        self.align_by_arming(flight).ok_or(misfit)
    }

    fn fit(&self, boot: &AutopilotStart, flight: &LoggedFlight) -> Result<BootFit, Misfit> {
        let mut alignment = boot.align(flight).ok_or(Misfit::NoCommonTime)?;
        let common_us = alignment.common_us(flight).ok_or(Misfit::NoCommonTime)?;
        let armed = self
            .armed_together(&alignment, flight)
            .ok_or(Misfit::OtherArming)?;
        if alignment.by == AlignedBy::BootTime {
            if let Some(disagreement) = flight.course.disagreement(&boot.course) {
                return Err(Misfit::OtherCourse(disagreement));
            }
            if armed == 0 {
                alignment.by = AlignedBy::BootTimeOnly;
            }
        }
        Ok(BootFit {
            alignment,
            armed,
            common_us,
        })
    }

    /// The number of armings on which log and record agree; `None` if log and record contradict
    /// each other.
    fn armed_together(&self, alignment: &Alignment, flight: &LoggedFlight) -> Option<usize> {
        let (from, to) = flight.span_us?;
        let (first, last) = (alignment.places.first()?.1, alignment.places.last()?.1);
        let from = alignment.place_us(from).map_or(first, |at| at.max(first));
        let to = alignment.place_us(to).unwrap_or(last).min(last);
        // Near the ends of the common time, one of them may have missed the arming.
        let common = from + ARMING_US..to;
        let logged: Vec<u64> = flight
            .armed_us
            .iter()
            .filter_map(|us| alignment.place_us(*us))
            .collect();
        let within = |times: &[u64]| times.iter().any(|at| common.contains(at));
        let same = logged.iter().filter(|at| self.has_armed_at(**at)).count();
        let is_quiet = !within(&logged) && !within(&self.armed_us);
        // Some logs and recordings never contain armings.
        let is_unsaid = logged.is_empty() || self.armed_us.is_empty();
        let is_sure = alignment.by == AlignedBy::GpsTime;
        (same > 0 || is_quiet || (is_sure && is_unsaid)).then_some(same)
    }

    fn has_armed_at(&self, at_us: u64) -> bool {
        let mut armed = self.armed_us.iter();
        armed.any(|it| it.abs_diff(at_us) < ARMING_US)
    }

    fn align_by_arming(&self, flight: &LoggedFlight) -> Option<Alignment> {
        if !self.boots.is_empty() {
            return None;
        }
        let pairs = self.armed_us.iter().flat_map(|at| {
            let logged = flight.armed_us.iter();
            logged.map(move |log| Alignment {
                by: AlignedBy::Arming,
                places: vec![(*log, *at)],
            })
        });
        let same = |alignment: &Alignment| {
            let logged = flight.armed_us.iter();
            let at = logged.filter_map(|us| alignment.place_us(*us));
            at.filter(|at| self.has_armed_at(*at)).count()
        };
        // Of equally good alignments the first one counts; `max_by_key` finds it because the order is reversed.
        let pairs: Vec<Alignment> = pairs.collect();
        pairs.into_iter().rev().max_by_key(same)
    }
}

impl AutopilotStart {
    fn align(&self, flight: &LoggedFlight) -> Option<Alignment> {
        let by = match (self.booted_unix_us, flight.booted_unix_us) {
            (Some(ours), Some(theirs)) if ours.abs_diff(theirs) > SAME_BOOT_US => return None,
            (Some(_), Some(_)) => AlignedBy::GpsTime,
            (Some(_) | None, None) | (None, Some(_)) => AlignedBy::BootTime,
        };
        Some(Alignment {
            by,
            places: self.places.clone(),
        })
    }
}

impl Alignment {
    /// The alignment of a log whose clock is that of the record.
    #[cfg(test)]
    pub(super) fn identity() -> Self {
        Self {
            by: AlignedBy::BootTime,
            places: vec![(0, 0)],
        }
    }

    /// How long log and record overlap, in microseconds; `None` if they do not.
    fn common_us(&self, flight: &LoggedFlight) -> Option<u64> {
        let (from, to) = flight.span_us?;
        let (first, last) = (self.places.first()?.0, self.places.last()?.0);
        let (from, to) = (from.max(first), to.min(last));
        to.checked_sub(from).filter(|common| *common > 0)
    }

    /// Converts a time of the log to a time from the beginning of the record; `None` if it is
    /// before that beginning.
    pub fn place(&self, boot_us: u64) -> Option<Duration> {
        self.place_us(boot_us).map(Duration::from_micros)
    }

    fn place_us(&self, boot_us: u64) -> Option<u64> {
        let behind = self.places.partition_point(|(boot, _)| *boot <= boot_us);
        let (before, after) = match behind {
            0 => {
                let (boot, at) = *self.places.first()?;
                return at.checked_sub(boot - boot_us);
            }
            behind => (self.places[behind - 1], self.places.get(behind)),
        };
        let since = boot_us - before.0;
        let Some((boot, at)) = after else {
            return Some(before.1 + since);
        };
        // Between two messages, time is assumed to pass evenly.
        let share = since as f64 / (boot - before.0) as f64;
        let passed = at.saturating_sub(before.1) as f64 * share;
        Some(before.1 + passed as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(places: &[(u64, u64)], booted: Option<u64>, armed: &[u64]) -> VehicleClock {
        let seconds = |s: u64| s * 1_000_000;
        VehicleClock {
            boots: vec![AutopilotStart {
                places: places
                    .iter()
                    .map(|(boot, at)| (seconds(*boot), seconds(*at)))
                    .collect(),
                booted_unix_us: booted.map(seconds),
                course: Course::default(),
            }],
            armed_us: armed.iter().map(|it| seconds(*it)).collect(),
            is_armed: None,
        }
    }

    fn flight(from: u64, to: u64, booted: Option<u64>, armed: &[u64]) -> LoggedFlight {
        LoggedFlight {
            span_us: Some((from * 1_000_000, to * 1_000_000)),
            booted_unix_us: booted.map(|it| it * 1_000_000),
            armed_us: armed.iter().map(|it| it * 1_000_000).collect(),
            ..LoggedFlight::default()
        }
    }

    #[test]
    fn time_that_passed_faster_is_followed() {
        let clock = clock(&[(10, 0), (50, 5), (90, 45)], None, &[2]);
        let found = clock.align(&flight(12, 80, None, &[26]));
        let found = found.expect("they have time in common");
        assert_eq!(found.by, AlignedBy::BootTime);
        for (boot, at_ms) in [(10, 0), (26, 2000), (50, 5000), (60, 15_000), (100, 55_000)] {
            let at = found.place(boot * 1_000_000);
            assert_eq!(at, Some(Duration::from_millis(at_ms)), "{boot}");
        }
        assert_eq!(found.place(5_000_000), None);
    }

    #[test]
    fn another_boot_has_no_time_in_common() {
        let places = [(10, 0), (100, 90)];
        let with_gps = clock(&places, Some(1000), &[30]);
        let same = flight(40, 80, Some(1001), &[40]);
        let found = with_gps.align(&same).expect("it is the same boot");
        assert_eq!(found.by, AlignedBy::GpsTime);
        for other in [
            flight(40, 80, Some(2000), &[40]),
            flight(200, 300, Some(1000), &[]),
            flight(40, 80, Some(1000), &[70]),
            flight(40, 80, None, &[60]),
        ] {
            assert!(with_gps.align(&other).is_err(), "{other:?}");
        }
    }

    #[test]
    fn what_only_one_of_them_says_of_arming_contradicts() {
        let places = [(10, 0), (100, 90)];
        // The record has an arming at 31 s since boot; the log covers that time, but does not contain it.
        let armed = clock(&places, None, &[21]);
        let refused = Err(Misfit::OtherArming);
        assert_eq!(armed.align(&flight(12, 90, None, &[])), refused);
        assert_eq!(armed.align(&flight(12, 90, None, &[60])), refused);
        let found = armed.align(&flight(12, 90, None, &[31]));
        assert_eq!(found.map(|it| it.by), Ok(AlignedBy::BootTime));
        // GPS time shows that it is the same boot, and not every log contains its armings.
        let sure = clock(&places, Some(1000), &[21]);
        let found = sure.align(&flight(12, 90, Some(1000), &[]));
        assert_eq!(found.map(|it| it.by), Ok(AlignedBy::GpsTime));
        // In this stretch the vehicle was not armed, so nothing shows that it is the same flight.
        let found = armed.align(&flight(50, 90, None, &[]));
        assert_eq!(found.map(|it| it.by), Ok(AlignedBy::BootTimeOnly));
    }

    #[test]
    fn without_boot_times_arming_decides() {
        let clock = VehicleClock {
            armed_us: vec![5_000_000, 65_000_000],
            ..VehicleClock::default()
        };
        let found = clock.align(&flight(20, 200, None, &[25, 85]));
        let found = found.expect("both were armed twice");
        assert_eq!(found.by, AlignedBy::Arming);
        assert_eq!(found.place(85_000_000), Some(Duration::from_secs(65)));
        let none = clock.align(&flight(20, 200, None, &[]));
        assert_eq!(none, Err(Misfit::NoCommonTime));
    }
}
