//! Recording flights, and handing the logs out.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity::{MAV_SEVERITY_ERROR, MAV_SEVERITY_INFO};

use super::flash::{Groups, Log, Sample};
use super::tree::Entry;
use super::{Peer, Talk};
use crate::autopilot::Autopilot;
use crate::parameters::Parameters;
use crate::payload::{Payload, Writer};
use crate::telemetry::EPOCH_US;
use sortie_geo::wrap_360;

/// The folder in which ground stations find the logs by FTP.
pub(super) const FOLDER: &str = "logs";
const LAST_LOG: &str = "LASTLOG.TXT";
/// Steps from one sample to the next: two samples per second.
const SAMPLE_EVERY_STEPS: u64 = 50;
/// How much one log holds (20 minutes), and how many logs are kept.
const MOST_SAMPLES: usize = 2400;
const MOST_NOTES: usize = 200;
const MOST_LOGS: usize = 3;
/// Room for samples is made in such pieces.
const PIECE: usize = 120;
/// After disarming a log goes on for this long.
const PERSISTS_FOR: Duration = Duration::from_secs(15);
/// Message ids, and bytes of a log in one message.
const REQUEST_LIST: u32 = 117;
const ENTRY: u32 = 118;
const REQUEST_DATA: u32 = 119;
const DATA: u32 = 120;
const ERASE: u32 = 121;
const REQUEST_END: u32 = 122;
const DATA_BYTES: usize = 90;
/// Messages of a download in one step.
const SEND_PER_STEP: usize = 40;

/// What is recorded and when, read from the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Recorder {
    groups: Groups,
    enabled: bool,
    while_disarmed: bool,
}

impl Recorder {
    pub(crate) fn read(all: &Parameters) -> Self {
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
pub(super) struct Logs {
    kept: Vec<Log>,
    /// Whether the last one kept is being written, and when the vehicle was last armed.
    recording: bool,
    armed_at: Duration,
    /// How many logs there ever were.
    written: u16,
    sending: Option<Sending>,
    /// The file that was last asked for.
    open: Option<(u16, Vec<u8>)>,
    warned: bool,
}

#[derive(Debug, Clone)]
struct Sending {
    peer: Peer,
    begun_at: Duration,
    number: u16,
    offset: usize,
    left: usize,
}

impl Logs {
    /// Whether nothing is left to be sent.
    pub(super) fn is_idle(&self) -> bool {
        self.sending.is_none()
    }

    /// The logs after a reboot: those that there are stay, and the next flight begins another.
    pub(super) fn rebooted(self) -> Self {
        Self {
            kept: self.kept,
            written: self.written,
            ..Self::default()
        }
    }

    fn current(&mut self) -> Option<&mut Log> {
        self.kept.last_mut().filter(|_| self.recording)
    }

    fn numbered(&self, number: u16) -> Option<&Log> {
        self.kept.iter().find(|log| log.number == number)
    }
}

impl Autopilot {
    /// Records what is due after a step.
    pub(crate) fn record(&mut self, steps: u64) {
        if !steps.is_multiple_of(SAMPLE_EVERY_STEPS) {
            return;
        }
        let now = self.uptime();
        let recorder = self.tuning.recorder;
        if self.safety.armed {
            self.transfers.logs.armed_at = now;
            self.transfers.logs.open = None;
        }
        let logs = &mut self.transfers.logs;
        let persists = logs.recording && now.saturating_sub(logs.armed_at) < PERSISTS_FOR;
        if !recorder.enabled || !(self.safety.armed || recorder.while_disarmed || persists) {
            return;
        }
        if !logs.recording {
            self.begin_log();
        }
        let sample = self.sample();
        let mode = self.mode.number;
        let Some(log) = self.transfers.logs.current() else {
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

    /// Records a text that was said.
    pub(crate) fn record_text(&mut self, text: &str) {
        let now_ms = self.uptime().as_millis() as u32;
        if let Some(log) = self.transfers.logs.current()
            && log.texts.len() < MOST_NOTES
        {
            log.texts.push((now_ms, text.to_owned()));
        }
    }

    fn begin_log(&mut self) {
        let logs = &mut self.transfers.logs;
        logs.written = logs.written.wrapping_add(1).max(1);
        logs.recording = true;
        if logs.kept.len() == MOST_LOGS {
            logs.kept.remove(0);
        }
        logs.kept.push(Log {
            number: logs.written,
            groups: self.tuning.recorder.groups,
            boot_utc_ms: EPOCH_US / 1000,
            ..Log::default()
        });
        self.record_text("ArduCopter V4.6.0-dev (sortie)");
    }

    fn sample(&self) -> Sample {
        // A log tells what the autopilot believed.
        let body = self.believed();
        let here = self.here();
        let (lat_e7, lon_e7) = here.at.to_e7();
        let home_m = self
            .datum
            .home
            .map_or(here.altitude_amsl_m, |home| home.altitude_amsl_m);
        let (roll, pitch) = body.roll_pitch_rad();
        let velocity = body.velocity_m_s;
        let centi = |value: f64| value * 100.0;
        let degrees = |rad: f64| centi(rad.to_degrees());
        Sample {
            boot_ms: self.uptime().as_millis() as u32,
            lat_e7,
            lon_e7,
            altitude_amsl_cm: centi(here.altitude_amsl_m) as i32,
            above_home_cm: centi(here.altitude_amsl_m - home_m) as i32,
            above_origin_cm: centi(-body.position_m.z) as i32,
            speed_cm_s: centi(velocity.truncate().length()) as u16,
            course_cd: degrees(velocity.y.atan2(velocity.x)).rem_euclid(36_000.0) as u16,
            down_cm_s: centi(velocity.z) as i16,
            roll_cd: degrees(roll) as i16,
            pitch_cd: degrees(pitch) as i16,
            yaw_cd: centi(wrap_360(body.yaw_deg)) as u16,
            voltage_cv: centi(self.battery.voltage_v) as u16,
            current_ca: centi(self.battery.current_a) as u16,
            consumed_mah: self.battery.consumed_mah as u16,
            remaining_percent: self
                .battery
                .remaining_percent(self.tuning.battery_capacity_mah)
                as u8,
            satellites: self.tuning.faults.gps.satellites,
        }
    }
}

/// The log files, for a listing.
pub(super) fn entries(autopilot: &Autopilot) -> Vec<Entry> {
    let kept = &autopilot.transfers.logs.kept;
    let mut entries: Vec<_> = kept
        .iter()
        .map(|log| Entry::file(&log.file_name(), log.len(&autopilot.parameters)))
        .collect();
    entries.extend(file(autopilot, LAST_LOG).map(|text| Entry::file(LAST_LOG, text.len())));
    entries
}

/// A log file by its name.
pub(super) fn file(autopilot: &Autopilot, name: &str) -> Option<Vec<u8>> {
    let kept = &autopilot.transfers.logs.kept;
    if name == LAST_LOG {
        return kept
            .last()
            .map(|log| format!("{}\n", log.number).into_bytes());
    }
    let log = kept.iter().find(|log| log.file_name() == name)?;
    Some(log.file(&autopilot.parameters))
}

/// Answers a message of the protocol; `false` if it is none.
pub(super) fn handle(talk: &mut Talk<'_>, id: u32, payload: &Payload) -> bool {
    let to = match id {
        REQUEST_LIST => 4,
        REQUEST_DATA => 10,
        ERASE | REQUEST_END => 0,
        _ => return false,
    };
    if !talk.is_for_us(payload.byte(to)) {
        return true;
    }
    if talk.autopilot.safety.armed {
        if !std::mem::replace(&mut talk.logs().warned, true) {
            talk.text(MAV_SEVERITY_ERROR, "Disarm for log download");
        }
        return true;
    }
    talk.logs().warned = false;
    match id {
        REQUEST_LIST => talk.list_logs(payload.short(0), payload.short(2)),
        REQUEST_DATA => talk.send_log(
            payload.short(8),
            payload.word(0) as usize,
            payload.word(4) as usize,
        ),
        ERASE => {
            let written = talk.logs().written;
            *talk.logs() = Logs {
                written,
                ..Logs::default()
            };
        }
        _ => {
            talk.logs().sending = None;
            talk.logs().open = None;
        }
    }
    true
}

/// Sends the next messages of a download.
pub(super) fn step(talk: &mut Talk<'_>) {
    let now = talk.autopilot.uptime();
    let Some(sending) = &talk.autopilot.transfers.logs.sending else {
        return;
    };
    if sending.peer.link == talk.peer.link {
        if !talk.autopilot.safety.armed {
            talk.continue_sending();
        }
    } else if now.saturating_sub(sending.begun_at) > Duration::from_secs(60) {
        // Its link is gone.
        talk.logs().sending = None;
    }
}

impl Talk<'_> {
    fn logs(&mut self) -> &mut Logs {
        &mut self.autopilot.transfers.logs
    }

    fn list_logs(&mut self, start: u16, end: u16) {
        if self.logs().sending.is_some() {
            self.text(MAV_SEVERITY_INFO, "Log download in progress");
            return;
        }
        let logs = &self.autopilot.transfers.logs;
        let count = logs.kept.len() as u16;
        // Logs are numbered by their place here, as in the real vehicle's list.
        let (first, last) = if count == 0 {
            (0, 0)
        } else {
            (start.max(1), end.min(count))
        };
        let mut payloads = Vec::new();
        for place in first..=last.max(first) {
            let log = usize::from(place)
                .checked_sub(1)
                .and_then(|index| logs.kept.get(index));
            let time_utc = log.map_or(0, |log| log.boot_utc_ms + u64::from(log.begin_ms()));
            let time_utc = (time_utc / 1000) as u32;
            let size = log.map_or(0, |log| log.len(&self.autopilot.parameters)) as u32;
            let entry = Writer::default().word(time_utc).word(size).short(place);
            payloads.push(entry.short(count).short(last).done());
            if place >= last {
                break;
            }
        }
        for payload in payloads {
            self.raw(ENTRY, payload);
        }
    }

    fn send_log(&mut self, place: u16, offset: usize, count: usize) {
        let now = self.autopilot.uptime();
        if let Some(sending) = &self.autopilot.transfers.logs.sending {
            if sending.peer.link != self.peer.link {
                self.text(MAV_SEVERITY_INFO, "Log download in progress");
            }
            return;
        }
        let logs = &self.autopilot.transfers.logs;
        let log = usize::from(place)
            .checked_sub(1)
            .and_then(|index| logs.kept.get(index));
        let Some(number) = log.map(|log| log.number) else {
            return;
        };
        let logs = &mut self.autopilot.transfers.logs;
        if logs.open.as_ref().is_none_or(|(open, _)| *open != number) {
            let file = logs
                .numbered(number)
                .map(|log| log.file(&self.autopilot.parameters));
            self.logs().open = file.map(|file| (number, file));
        }
        let peer = self.peer;
        let logs = self.logs();
        let size = logs.open.as_ref().map_or(0, |(_, file)| file.len());
        logs.sending = Some(Sending {
            peer,
            begun_at: now,
            number: place,
            offset,
            left: size.saturating_sub(offset).min(count),
        });
        self.continue_sending();
    }

    fn continue_sending(&mut self) {
        for _ in 0..SEND_PER_STEP {
            let logs = self.logs();
            let (Some(sending), Some((_, file))) = (&mut logs.sending, &logs.open) else {
                logs.sending = None;
                return;
            };
            let bytes = file.get(sending.offset..).unwrap_or_default();
            let bytes = &bytes[..bytes.len().min(sending.left).min(DATA_BYTES)];
            let payload = Writer::default()
                .word(sending.offset as u32)
                .short(sending.number)
                .bytes(&[bytes.len() as u8])
                .bytes(bytes)
                .done();
            sending.offset += bytes.len();
            sending.left -= bytes.len();
            if bytes.len() < DATA_BYTES || sending.left == 0 {
                logs.sending = None;
            }
            self.raw(DATA, payload);
        }
    }
}
