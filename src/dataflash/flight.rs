//! The flight data read from a log: modes, errors, events, changed parameters, vibration, estimator, battery.

use std::collections::{BTreeMap, HashMap};
use std::mem::{self, Discriminant};

use serde::{Deserialize, Serialize};

use super::clock::MOST_ARMINGS;
use super::curves::{LogChannel, LogCurves};
use super::names;
use super::reader::{Record, Records};
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{Mode, VehicleClass, VehicleId};

/// Vibration from which on `ArduPilot`'s guide calls it too much, in m/s².
const SHAKEN_M_S2: f64 = 30.0;
/// The test ratio from which on the estimator rejects a measurement.
const REJECTED: f64 = 1.0;
/// A condition that lasts counts once, until it has been over for this long.
const OVER_US: u64 = 5_000_000;
/// Events that are kept of each kind.
const MOST: usize = 1000;
/// Records whose median time tells when the log was written.
const TIMED: usize = 999;
/// No log covers more time than this.
const LONGEST_US: u64 = 7 * 24 * 3600 * 1_000_000;
/// The types of records that are read.
const KNOWN: &[&str] = &[
    "PARM", "MODE", "ERR", "EV", "VIBE", "XKF4", "NKF4", "BAT", "GPS", "MSG",
];
/// Milliseconds of the Unix epoch at which GPS time began (1980-01-06), and the leap seconds since.
const GPS_EPOCH_MS: f64 = 315_964_800_000.0;
const LEAP_MS: f64 = 18_000.0;
const WEEK_MS: f64 = 7.0 * 24.0 * 3600.0 * 1000.0;
/// `EV.Id` of arming and disarming.
const ARMED: u8 = 10;

/// An event in a log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LoggedEvent {
    /// A mode was entered: its name, and the reason if known.
    Mode {
        name: String,
        reason: Option<String>,
    },
    /// Part of the autopilot reported an error, or its end.
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
    /// Vibration was too strong from this time on; with its maximum in m/s².
    Vibration {
        most_m_s2: f64,
    },
    /// Accelerometers reached their limit; with the total number of times.
    Clipping {
        count: u32,
    },
    /// The estimator rejected measurements from this time on; with the maximum test ratio.
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
    /// Microseconds since boot of the first and last record.
    pub span_us: Option<(u64, u64)>,
    /// When the autopilot booted, by GPS time: microseconds since 1970 (UTC).
    pub booted_unix_us: Option<u64>,
    /// When it was armed.
    pub armed_us: Vec<u64>,
    pub damage: LogDamage,
}

/// What is remembered while a log is read.
#[derive(Debug, Default)]
struct Reading {
    flight: LoggedFlight,
    /// A time within the log.
    reference_us: u64,
    counts: HashMap<Discriminant<LoggedEvent>, usize>,
    parameters: BTreeMap<String, f32>,
    class: Option<VehicleClass>,
    /// The events that go on, with when they were true last.
    shaken: Option<(usize, u64)>,
    rejecting: BTreeMap<Measured, (usize, u64)>,
    clips: BTreeMap<u8, u32>,
    clipping: Option<(usize, u64)>,
    lowest: BTreeMap<u8, LoggedMoment>,
}

impl LoggedFlight {
    /// Reads a log.
    ///
    /// # Errors
    /// It is none; in words.
    pub fn read(bytes: &[u8]) -> Result<Self, Text> {
        let mut records = Records::new(bytes);
        let mut reading = Reading {
            reference_us: reference_us(bytes),
            ..Reading::default()
        };
        for record in &mut records {
            reading.take_in(&record);
        }
        if records.described == 0 {
            return Err(text!("log-is-none"));
        }
        reading.flight.damage.skipped += records.skipped;
        reading.flight.damage.cut_off = records.cut_off;
        let mut flight = reading.flight;
        flight.moments.extend(reading.lowest.into_values());
        flight.moments.sort_by_key(|it| it.time_us);
        if flight.span_us.is_none() {
            return Err(text!("log-is-empty"));
        }
        Ok(flight)
    }
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

/// The median of the first times of a log: a damaged record may have any time.
fn reference_us(bytes: &[u8]) -> u64 {
    let records = Records::new(bytes).filter(|it| KNOWN.contains(&it.format.name.as_str()));
    let times = records.filter_map(|record| record.time_us());
    let mut times: Vec<u64> = times.take(TIMED).collect();
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

impl Reading {
    fn take_in(&mut self, record: &Record<'_>) {
        let Some(now) = record.time_us() else {
            return;
        };
        if !KNOWN.contains(&record.format.name.as_str()) {
            return;
        }
        // Bytes that only look like a record have any time.
        if now.abs_diff(self.reference_us) > LONGEST_US {
            self.flight.damage.skipped += record.len();
            return;
        }
        let (first, last) = self.flight.span_us.unwrap_or((now, now));
        self.flight.span_us = Some((first.min(now), last.max(now)));
        // A record that lacks a column says nothing.
        let _complete = match record.format.name.as_str() {
            "PARM" => self.parameter(record, now),
            "MODE" => self.mode(record, now),
            "ERR" => self.error(record, now),
            "EV" => self.event(record, now),
            "VIBE" => self.vibration(record, now),
            "XKF4" | "NKF4" => {
                self.estimator(record, now);
                Some(())
            }
            "BAT" => self.battery(record, now),
            "GPS" => self.gps(record, now),
            _ => self.message(record),
        };
    }

    /// Adds an event and returns its place; `None` if there are enough of its kind.
    fn add(&mut self, time_us: u64, event: LoggedEvent) -> Option<usize> {
        let count = self.counts.entry(mem::discriminant(&event)).or_default();
        *count += 1;
        if *count > MOST {
            self.flight.damage.left_out += 1;
            return None;
        }
        self.flight.moments.push(LoggedMoment { time_us, event });
        Some(self.flight.moments.len() - 1)
    }

    /// The event of a condition that lasts: that of `going`, or a new one if it has been over for a while.
    fn going_on(
        &mut self,
        going: Option<(usize, u64)>,
        now: u64,
        event: LoggedEvent,
    ) -> Option<(usize, &mut LoggedEvent)> {
        let place = match going.filter(|(_, until)| now < until.saturating_add(OVER_US)) {
            Some((place, _)) => place,
            None => self.add(now, event)?,
        };
        Some((place, &mut self.flight.moments[place].event))
    }

    fn parameter(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let name = record.text("Name")?;
        let value = Some(record.number("Value")? as f32).filter(|value| value.is_finite())?;
        if matches!(name.as_str(), "SYSID_THISMAV" | "MAV_SYSID") {
            self.flight.vehicle = Some(value as VehicleId).filter(|id| (1..=255).contains(id));
        }
        let before = self.parameters.insert(name.clone(), value);
        if let Some(before) = before.filter(|before| before.to_bits() != value.to_bits()) {
            let event = LoggedEvent::Parameter {
                name,
                value,
                before,
            };
            self.add(now, event);
        }
        Some(())
    }

    fn mode(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let number = u32::from(record.byte("ModeNum").or_else(|| record.byte("Mode"))?);
        let class = self.class.unwrap_or(VehicleClass::Copter);
        let name = Mode { class, number }.to_string();
        let reason = record.byte("Rsn").and_then(names::reason);
        let reason = reason.map(str::to_owned);
        self.add(now, LoggedEvent::Mode { name, reason });
        Some(())
    }

    fn error(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let (subsystem, code) = names::error(record.byte("Subsys")?, record.byte("ECode")?);
        self.add(now, LoggedEvent::Error { subsystem, code });
        Some(())
    }

    fn event(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let id = record.byte("Id")?;
        if id == ARMED && self.flight.armed_us.len() < MOST_ARMINGS {
            self.flight.armed_us.push(now);
        }
        let name = names::event(id);
        self.add(now, LoggedEvent::Event { name });
        Some(())
    }

    fn vibration(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let axes = ["VibeX", "VibeY", "VibeZ"].map(|axis| record.number(axis));
        let strongest = axes.into_iter().flatten().fold(0.0, f64::max);
        let curves = &mut self.flight.curves;
        curves.add(LogChannel::Vibration, now, strongest);
        if strongest >= SHAKEN_M_S2 {
            let begun = LoggedEvent::Vibration { most_m_s2: 0.0 };
            let going = self.going_on(self.shaken, now, begun);
            if let Some((place, LoggedEvent::Vibration { most_m_s2 })) = going {
                *most_m_s2 = most_m_s2.max(strongest);
                self.shaken = Some((place, now));
            }
        }
        let sensor = record.byte("IMU").unwrap_or(0);
        let clips = record.number("Clip")? as u32;
        let before = self.clips.insert(sensor, clips).unwrap_or(clips);
        if clips > before {
            let begun = LoggedEvent::Clipping { count: 0 };
            let going = self.going_on(self.clipping, now, begun);
            if let Some((place, LoggedEvent::Clipping { count })) = going {
                *count = count.saturating_add(clips - before);
                self.clipping = Some((place, now));
            }
        }
        Some(())
    }

    fn estimator(&mut self, record: &Record<'_>, now: u64) {
        let ratios = [
            ("SV", Measured::Velocity),
            ("SP", Measured::Position),
            ("SH", Measured::Height),
            ("SM", Measured::Compass),
        ];
        for (column, of) in ratios {
            let Some(ratio) = record.number(column) else {
                continue;
            };
            let curves = &mut self.flight.curves;
            curves.add(LogChannel::Estimator, now, ratio);
            if ratio < REJECTED {
                continue;
            }
            let begun = LoggedEvent::Estimator { of, most: 0.0 };
            let going = self.going_on(self.rejecting.get(&of).copied(), now, begun);
            if let Some((place, LoggedEvent::Estimator { most, .. })) = going {
                *most = most.max(ratio);
                self.rejecting.insert(of, (place, now));
            }
        }
    }

    fn battery(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let instance = record.byte("Inst").or_else(|| record.byte("Instance"));
        let instance = instance.unwrap_or(0);
        let volt = record.number("Volt").filter(|volt| *volt > 0.5)?;
        let ampere = record.number("Curr").unwrap_or(0.0);
        if instance == 0 {
            let curves = &mut self.flight.curves;
            curves.add(LogChannel::Voltage, now, volt);
            curves.add(LogChannel::Current, now, ampere);
        }
        let is_lower = self.lowest.get(&instance).is_none_or(|known| {
            matches!(&known.event, LoggedEvent::Battery { volt: lowest, .. } if volt < *lowest)
        });
        if is_lower {
            let event = LoggedEvent::Battery {
                instance,
                volt,
                ampere,
            };
            self.lowest.insert(
                instance,
                LoggedMoment {
                    time_us: now,
                    event,
                },
            );
        }
        Some(())
    }

    fn gps(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let has_fix = record.byte("Status")? >= 3;
        let (week, ms) = (record.number("GWk")?, record.number("GMS")?);
        if has_fix && week > 0.0 && self.flight.booted_unix_us.is_none() {
            let unix_ms = GPS_EPOCH_MS + week * WEEK_MS + ms - LEAP_MS;
            self.flight.booted_unix_us = ((unix_ms * 1000.0) as u64).checked_sub(now);
        }
        Some(())
    }

    fn message(&mut self, record: &Record<'_>) -> Option<()> {
        let text = record.text("Message")?;
        let classes = [
            ("ArduCopter", VehicleClass::Copter),
            ("ArduPlane", VehicleClass::Plane),
            ("ArduRover", VehicleClass::Rover),
            ("ArduSub", VehicleClass::Sub),
        ];
        let class = classes.iter().find(|(name, _)| text.starts_with(name));
        self.class = class.map(|(_, class)| *class).or(self.class);
        Some(())
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
