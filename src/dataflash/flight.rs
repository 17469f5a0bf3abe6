//! The flight data read from a log: modes, errors, events, changed parameters, vibration, estimator, battery.

use serde::{Deserialize, Serialize};

use super::course::Course;
use super::curves::LogCurves;
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::VehicleId;

/// The maximum number of events kept of each kind.
pub(super) const MOST: usize = 1000;

/// An event in a log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LoggedEvent {
    /// A mode was entered: its name, and the reason if known.
    Mode {
        name: String,
        reason: Option<String>,
    },
    /// A subsystem of the autopilot reported an error, or that an error has ended.
    Error {
        subsystem: String,
        code: String,
    },
    Event {
        name: String,
    },
    /// A parameter was changed in flight.
    Parameter {
        name: String,
        value: f32,
        before: f32,
    },
    /// Vibration became too strong; with its maximum in m/s².
    Vibration {
        most_m_s2: f64,
    },
    /// Accelerometers reached their limit; with the total number of times.
    Clipping {
        count: u32,
    },
    /// The estimator began to reject measurements; with the maximum test ratio.
    Estimator {
        of: Measured,
        most: f64,
    },
    /// The lowest voltage of a battery.
    Battery {
        instance: u8,
        volt: f64,
        ampere: f64,
    },
}

/// A measurement that an estimator checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    Velocity,
    Position,
    Height,
    Compass,
}

impl Measured {
    fn text(self) -> Text {
        match self {
            Self::Velocity => text!("log-of-velocity"),
            Self::Position => text!("log-of-position"),
            Self::Height => text!("log-of-height"),
            Self::Compass => text!("log-of-compass"),
        }
    }
}

/// An event with its time.
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedMoment {
    /// Microseconds since the autopilot booted.
    pub time_us: u64,
    pub event: LoggedEvent,
}

/// The faults of a log, and the parts that were left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct LogDamage {
    /// The number of bytes that do not belong to any record.
    pub skipped: usize,
    /// The number of bytes of an incomplete last record.
    pub cut_off: usize,
    /// The number of events beyond the maximum for their kind.
    #[serde(default)]
    pub left_out: usize,
}

/// The flight data read from a log.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoggedFlight {
    /// The vehicle, according to the system id in the parameters.
    pub vehicle: Option<VehicleId>,
    pub moments: Vec<LoggedMoment>,
    pub curves: LogCurves,
    pub course: Course,
    /// The times of the first and last record, in microseconds since boot.
    pub span_us: Option<(u64, u64)>,
    /// When the autopilot booted, by GPS time: microseconds since 1970 (UTC).
    pub booted_unix_us: Option<u64>,
    /// When the vehicle was armed, in microseconds since boot.
    pub armed_us: Vec<u64>,
    pub damage: LogDamage,
}

impl LogDamage {
    /// The damage as text, if there is any.
    pub fn text(self) -> Option<Text> {
        let bytes = match (self.skipped, self.cut_off) {
            (0, 0) => None,
            (0, cut_off) => Some(text!("log-cut-off", bytes = cut_off)),
            (skipped, cut_off) => Some(text!("log-damaged", bytes = skipped + cut_off)),
        };
        let left_out =
            (self.left_out > 0).then(|| text!("log-left-out", count = self.left_out, most = MOST));
        let texts: Vec<Text> = bytes.into_iter().chain(left_out).collect();
        (!texts.is_empty()).then(|| Text::joined("\n", texts))
    }
}

impl LoggedEvent {
    /// The event in a few words.
    pub fn text(&self) -> Text {
        match self {
            Self::Mode { name, reason } => match reason {
                Some(reason) => {
                    text!(
                        "log-mode-why",
                        mode = name.as_str(),
                        reason = reason.as_str()
                    )
                }
                None => text!("moment-mode", mode = name.as_str()),
            },
            Self::Error { subsystem, code } => {
                text!("log-error", part = subsystem.as_str(), code = code.as_str())
            }
            Self::Event { name } => text!("log-event", name = name.as_str()),
            Self::Parameter {
                name,
                value,
                before,
            } => text!(
                "log-parameter",
                name = name.as_str(),
                value = value.to_string(),
                before = before.to_string()
            ),
            Self::Vibration { most_m_s2 } => {
                text!("log-vibration", most = figure(*most_m_s2, 0))
            }
            Self::Clipping { count } => text!("log-clipping", count = *count),
            Self::Estimator { of, most } => {
                text!("log-estimator", of = of.text(), most = figure(*most, 2))
            }
            Self::Battery {
                instance,
                volt,
                ampere,
            } => text!(
                "log-battery",
                number = u16::from(*instance) + 1,
                volt = figure(*volt, 2),
                ampere = figure(*ampere, 1)
            ),
        }
    }
}
