//! The flight logs that the vehicle stores.

mod flash;
mod sample;

use std::time::Duration;

use super::parameters::Parameters;
use flash::Groups;
pub(super) use flash::RecordedLog;
pub(super) use sample::{LogInputs, LogSample};

/// The start of the world's clock: 2026-01-01, in microseconds of the Unix epoch.
pub(super) const EPOCH_US: u64 = 1_767_225_600_000_000;
/// Steps from one sample to the next: two samples per second.
pub(super) const EVERY_STEPS: u64 = 50;
/// The maximum number of samples in a log (20 minutes); of modes, events and texts in a log, each;
/// and of logs.
const MOST_SAMPLES: usize = 2400;
const MOST_NOTES: usize = 200;
const MOST_LOGS: usize = 3;
/// The number of samples for which memory is allocated at a time.
const PIECE: usize = 120;
/// How long a log continues after disarming.
const PERSISTS_FOR: Duration = Duration::from_secs(15);

/// The rules of logging, from the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LogRules {
    groups: Groups,
    enabled: bool,
    while_disarmed: bool,
}

impl LogRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let mask = all.value("LOG_BITMASK") as i64;
        Self {
            groups: Groups {
                attitude: mask & 0x3 != 0,
                gps: mask & 0x4 != 0,
                battery: mask & 0x200 != 0,
            },
            enabled: all.value("LOG_BACKEND_TYPE") as i64 & 1 == 1,
            while_disarmed: all.value("LOG_DISARMED") > 0.0,
        }
    }
}

/// The logs of a vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct FlightLog {
    kept: Vec<RecordedLog>,
    /// Whether a log has been begun since boot.
    recording: bool,
    /// Whether samples are written now; after a flight the log pauses until the next one.
    is_writing: bool,
    is_armed: bool,
    /// When the vehicle was last armed, if it was since boot.
    armed_at: Option<Duration>,
    /// The number of logs so far.
    written: u16,
    /// The last requested file.
    open: Option<(u16, Vec<u8>)>,
}

impl FlightLog {
    /// The logs after a reboot: existing ones stay, and the next flight begins a new one.
    pub(super) fn rebooted(self) -> Self {
        Self {
            kept: self.kept,
            written: self.written,
            ..Self::default()
        }
    }

    /// Deletes all logs; the numbers begin again, with a new log if one is being written.
    pub(super) fn erase(&mut self) {
        *self = Self {
            is_armed: self.is_armed,
            armed_at: self.armed_at,
            ..Self::default()
        };
    }

    /// The logs that are kept, oldest first.
    pub(super) fn kept(&self) -> &[RecordedLog] {
        &self.kept
    }

    /// Whether a sample is due; the first one begins a log. To be called every [`EVERY_STEPS`].
    pub(super) fn wants_sample(
        &mut self,
        rules: LogRules,
        parameters: &Parameters,
        armed: bool,
        now: Duration,
    ) -> bool {
        if armed {
            self.armed_at = Some(now);
            self.open = None;
        }
        let since_flight = self.armed_at.map(|at| now.saturating_sub(at));
        let persists = since_flight.is_some_and(|since| since < PERSISTS_FOR);
        let wants = rules.enabled && (armed || rules.while_disarmed || persists);
        self.is_writing = wants;
        if wants && !self.recording {
            self.begin(rules, parameters, now);
        }
        self.note_arming(armed, now);
        wants
    }

    fn note_arming(&mut self, armed: bool, now: Duration) {
        if std::mem::replace(&mut self.is_armed, armed) != armed
            && let Some(log) = self.current()
            && log.events.len() < MOST_NOTES
        {
            let event = if armed { flash::ARMED } else { flash::DISARMED };
            log.events.push((now.as_millis() as u32, event));
        }
    }

    /// Adds a sample, taken in a mode.
    pub(super) fn add(&mut self, sample: LogSample, mode: u8) {
        let Some(log) = self.current() else {
            return;
        };
        if log.modes.last().is_none_or(|(_, last)| *last != mode) && log.modes.len() < MOST_NOTES {
            log.modes.push((sample.boot_ms, mode));
        }
        if log.samples.len() < MOST_SAMPLES {
            if log.samples.len() == log.samples.capacity() {
                log.samples.reserve_exact(PIECE);
            }
            log.samples.push(sample);
        }
    }

    pub(super) fn note(&mut self, text: &str, now: Duration) {
        if let Some(log) = self.current()
            && log.texts.len() < MOST_NOTES
        {
            log.texts.push((now.as_millis() as u32, text.to_owned()));
        }
    }

    /// Opens the file of a log by its number; returns its length in bytes.
    pub(super) fn open(&mut self, number: u16) -> usize {
        let log = self.kept.iter().find(|log| log.number == number);
        // A log continues for a while after disarming.
        let len = log.map_or(0, RecordedLog::len);
        let is_open = |(open, file): &(u16, Vec<u8>)| *open == number && file.len() == len;
        if !self.open.as_ref().is_some_and(is_open) {
            self.open = log.map(|log| (number, log.file()));
        }
        self.opened().map_or(0, <[u8]>::len)
    }

    /// The file that was last opened, until it is closed.
    pub(super) fn opened(&self) -> Option<&[u8]> {
        self.open.as_ref().map(|(_, file)| file.as_slice())
    }

    /// Closes the file that was last opened.
    pub(super) fn close(&mut self) {
        self.open = None;
    }

    fn begin(&mut self, rules: LogRules, parameters: &Parameters, now: Duration) {
        self.written = self.written.wrapping_add(1).max(1);
        self.recording = true;
        if self.kept.len() == MOST_LOGS {
            self.kept.remove(0);
        }
        self.kept.push(RecordedLog {
            number: self.written,
            groups: rules.groups,
            parameters: parameters.clone(),
            boot_utc_ms: EPOCH_US / 1000,
            samples: Vec::new(),
            modes: Vec::new(),
            events: Vec::new(),
            texts: Vec::new(),
        });
        self.note("ArduCopter V4.6.0-dev (sortie)", now);
    }

    fn current(&mut self) -> Option<&mut RecordedLog> {
        let is_writing = self.recording && self.is_writing;
        self.kept.last_mut().filter(|_| is_writing)
    }
}
