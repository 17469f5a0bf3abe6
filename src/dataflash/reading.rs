//! Reads the flight data from a log, record by record.

use std::collections::{BTreeMap, HashMap};
use std::mem::{self, Discriminant};

use super::clock::MOST_ARMINGS;
use super::curves::LogChannel;
use super::flight::{LoggedEvent, LoggedFlight, LoggedMoment, MOST, Measured};
use super::names;
use super::reader::{Record, Records};
use crate::geo::LatLon;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, VehicleClass, VehicleId};

/// The vibration that `ArduPilot`'s guide calls too strong, in m/s².
const SHAKEN_M_S2: f64 = 30.0;
const REJECTED: f64 = 1.0;
/// A lasting condition counts as one event until it has been over for this long.
const OVER_US: u64 = 5_000_000;
/// The number of records at the start of a log whose median time is taken as a time within the log.
const TIMED: usize = 999;
/// The maximum time that a log covers.
const LONGEST_US: u64 = 7 * 24 * 3600 * 1_000_000;
/// The types of records that are read.
const KNOWN: &[&str] = &[
    "PARM", "MODE", "ERR", "EV", "VIBE", "XKF4", "NKF4", "BAT", "GPS", "POS", "MSG",
];
/// The Unix time at which GPS time began (1980-01-06), in milliseconds.
const GPS_EPOCH_MS: f64 = 315_964_800_000.0;
const LEAP_MS: f64 = 18_000.0;
const WEEK_MS: f64 = 7.0 * 24.0 * 3600.0 * 1000.0;
/// The `Id` of an `EV` record that says that the vehicle was armed.
const ARMED: u8 = 10;

#[derive(Debug, Default)]
struct LogReading {
    flight: LoggedFlight,
    /// A time that is certain to be within the log.
    reference_us: u64,
    counts: HashMap<Discriminant<LoggedEvent>, usize>,
    parameters: BTreeMap<String, f32>,
    class: Option<VehicleClass>,
    /// The events of lasting conditions: the index of each, and the time when its condition was
    /// last true.
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
    /// A text if it is not a log.
    pub fn read(bytes: &[u8]) -> Result<Self, Text> {
        let mut records = Records::new(bytes);
        let mut reading = LogReading {
            reference_us: reference_us(bytes),
            ..LogReading::default()
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

/// The median time of the first records of a log: a damaged record may have any time.
fn reference_us(bytes: &[u8]) -> u64 {
    let records = Records::new(bytes).filter(|it| KNOWN.contains(&it.format.name.as_str()));
    let mut times: Vec<u64> = records
        .filter_map(|record| record.time_us())
        .take(TIMED)
        .collect();
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

impl LogReading {
    fn take_in(&mut self, record: &Record<'_>) {
        let Some(now) = record.time_us() else {
            return;
        };
        if !KNOWN.contains(&record.format.name.as_str()) {
            return;
        }
        // Bytes that only look like a record may contain any time.
        if now.abs_diff(self.reference_us) > LONGEST_US {
            self.flight.damage.skipped += record.len();
            return;
        }
        let (first, last) = self.flight.span_us.unwrap_or((now, now));
        self.flight.span_us = Some((first.min(now), last.max(now)));
        // A record that lacks a column is ignored.
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
            "POS" => self.position(record, now),
            _ => self.message(record),
        };
    }

    /// Adds an event and returns its index; `None` if the maximum for its kind has been reached.
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

    /// The event of a lasting condition and its index: the event of `going`, or a new one if the
    /// condition has been over for a while. `None` if no new event can be added.
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
        self.flight.course.add_mode(now, number);
        let class = self.class.unwrap_or(VehicleClass::Copter);
        let name = Mode { class, number }.to_string();
        let reason = record.byte("Rsn").and_then(names::reason);
        self.add(
            now,
            LoggedEvent::Mode {
                name,
                reason: reason.map(str::to_owned),
            },
        );
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
        let named = record.byte("Inst").or_else(|| record.byte("Instance"));
        let instance = named.unwrap_or(0);
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

    fn position(&mut self, record: &Record<'_>, now: u64) -> Option<()> {
        let place = LatLon::new(record.number("Lat")?, record.number("Lng")?);
        self.flight.course.add_place(now, place);
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
