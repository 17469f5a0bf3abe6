//! Readings of a log as curves: one value per second, the worst of that second.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Readings of at least this size, in any unit, are ignored.
const MOST: f64 = 1e6;

/// A reading of a log that is shown as a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LogChannel {
    /// The strongest axis of `VIBE`, in m/s².
    Vibration,
    /// The greatest test ratio of `XKF4`: at 1 or more, the estimator rejects the measurement.
    Estimator,
    /// The voltage of the first battery (`BAT`), in volts.
    Voltage,
    /// The current of the first battery (`BAT`), in amperes.
    Current,
}

impl LogChannel {
    /// All channels, in display order.
    pub const ALL: [Self; 4] = [
        Self::Vibration,
        Self::Estimator,
        Self::Voltage,
        Self::Current,
    ];

    /// Whether low readings are worse than high ones.
    pub fn is_low_worse(self) -> bool {
        match self {
            Self::Voltage => true,
            Self::Vibration | Self::Estimator | Self::Current => false,
        }
    }

    fn worse(self, one: f32, other: f32) -> f32 {
        if self.is_low_worse() {
            one.min(other)
        } else {
            one.max(other)
        }
    }
}

/// The curves of a log. Their seconds count from the boot of the autopilot, or, in a joined log, from the start of the
/// record.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LogCurves {
    by_channel: BTreeMap<LogChannel, BTreeMap<u64, f32>>,
}

impl LogCurves {
    /// Adds a reading to its second; if there are several, the worst is kept.
    pub(super) fn add(&mut self, channel: LogChannel, time_us: u64, value: f64) {
        // A larger value is not a real reading.
        if value.abs() < MOST {
            let value = (value * 100.0).round() / 100.0;
            self.add_to_second(channel, time_us / 1_000_000, value as f32);
        }
    }

    fn add_to_second(&mut self, channel: LogChannel, second: u64, value: f32) {
        let seconds = self.by_channel.entry(channel).or_default();
        let kept = seconds.entry(second).or_insert(value);
        *kept = channel.worse(*kept, value);
    }

    /// The same curves on another clock. `place` maps microseconds to that clock; seconds without a place are dropped.
    pub(super) fn placed(&self, place: impl Fn(u64) -> Option<Duration>) -> Self {
        let mut placed = Self::default();
        for (&channel, seconds) in &self.by_channel {
            for (&second, &value) in seconds {
                if let Some(at) = place(second.saturating_mul(1_000_000)) {
                    placed.add_to_second(channel, at.as_secs(), value);
                }
            }
        }
        placed
    }

    /// The channels with readings, in display order.
    pub fn channels(&self) -> impl Iterator<Item = LogChannel> + '_ {
        self.by_channel.keys().copied()
    }

    /// The readings of a channel in the span that ends with the second of `until`, oldest first, one per second; `None`
    /// for a second without a reading.
    pub fn readings(&self, channel: LogChannel, until: Duration, seconds: u16) -> Vec<Option<f32>> {
        let known = self.by_channel.get(&channel);
        let last = until.as_secs();
        let first = (last + 1).saturating_sub(u64::from(seconds));
        (first..=last)
            .map(|second| known?.get(&second).copied())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_keeps_its_worst_reading() {
        let mut curves = LogCurves::default();
        for (ms, shake, volt) in [(1000, 3.0, 12.4), (1500, 40.126, 11.2), (1900, 5.0, 12.0)] {
            curves.add(LogChannel::Vibration, ms * 1000, shake);
            curves.add(LogChannel::Voltage, ms * 1000, volt);
        }
        let until = Duration::from_millis(2500);
        let of = |channel| curves.readings(channel, until, 2);
        assert_eq!(of(LogChannel::Vibration), [Some(40.13), None]);
        assert_eq!(of(LogChannel::Voltage), [Some(11.2), None]);
        assert_eq!(of(LogChannel::Current), [None, None]);
        assert_eq!(curves.readings(LogChannel::Vibration, until, 30).len(), 3);
    }

    #[test]
    fn on_a_faster_clock_seconds_fall_together() {
        let mut curves = LogCurves::default();
        for (second, value) in [(9, 1.0), (10, 2.0), (11, 7.0), (12, 3.0)] {
            curves.add(LogChannel::Vibration, second * 1_000_000, value);
        }
        let placed = curves.placed(|us| {
            us.checked_sub(10_000_000)
                .map(|us| Duration::from_micros(us / 2))
        });
        let until = Duration::from_secs(1);
        let readings = placed.readings(LogChannel::Vibration, until, 5);
        assert_eq!(readings, [Some(7.0), Some(3.0)]);
    }
}
