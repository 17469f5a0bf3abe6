//! Listing and download of flight logs.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::MavSeverity::{MAV_SEVERITY_ERROR, MAV_SEVERITY_INFO};
use mavlink::dialects::ardupilotmega::{
    LOG_DATA_DATA, LOG_ENTRY_DATA, LOG_ERASE_DATA, LOG_REQUEST_DATA_DATA, LOG_REQUEST_END_DATA,
    LOG_REQUEST_LIST_DATA,
};

use super::tree::FolderEntry;
use super::{Peer, Talk};
use crate::flight_log::RecordedLog;
use crate::payload::{Payload, Writer};
use crate::vehicle::Vehicle;

/// The folder in which ground stations find the logs by FTP.
pub(super) const FOLDER: &str = "logs";
const LAST_LOG: &str = "LASTLOG.TXT";
/// Message ids, and bytes of a log in one message.
const REQUEST_LIST: u32 = LOG_REQUEST_LIST_DATA::ID;
const ENTRY: u32 = LOG_ENTRY_DATA::ID;
const REQUEST_DATA: u32 = LOG_REQUEST_DATA_DATA::ID;
const DATA: u32 = LOG_DATA_DATA::ID;
const ERASE: u32 = LOG_ERASE_DATA::ID;
const REQUEST_END: u32 = LOG_REQUEST_END_DATA::ID;
const DATA_BYTES: usize = 90;
/// Messages of a download in one step.
const SEND_PER_STEP: usize = 40;

/// The log that is being sent to a ground station, if any.
#[derive(Debug, Clone, Default)]
pub(super) struct LogDownload {
    sending: Option<Sending>,
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

impl LogDownload {
    /// Whether nothing is left to send.
    pub(super) fn is_idle(&self) -> bool {
        self.sending.is_none()
    }
}

/// The log files, for a listing.
pub(super) fn entries(vehicle: &Vehicle) -> Vec<FolderEntry> {
    let kept = vehicle.log.kept();
    let mut entries: Vec<_> = kept
        .iter()
        .map(|log| FolderEntry::file(&log.file_name(), log.len()))
        .collect();
    entries.extend(file(vehicle, LAST_LOG).map(|text| FolderEntry::file(LAST_LOG, text.len())));
    entries
}

/// A log file by its name, if it exists.
pub(super) fn file(vehicle: &Vehicle, name: &str) -> Option<Vec<u8>> {
    let kept = vehicle.log.kept();
    if name == LAST_LOG {
        return kept
            .last()
            .map(|log| format!("{}\n", log.number).into_bytes());
    }
    let log = kept.iter().find(|log| log.file_name() == name)?;
    Some(log.file())
}

/// Whether a message belongs to the protocol.
pub(super) fn is_part(id: u32) -> bool {
    matches!(id, REQUEST_LIST | REQUEST_DATA | ERASE | REQUEST_END)
}

/// Answers a message of the protocol; `false` if it is not one.
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
    if talk.autopilot.vehicle.safety.armed {
        if !std::mem::replace(&mut talk.download().warned, true) {
            talk.text(MAV_SEVERITY_ERROR, "Disarm for log download");
        }
        return true;
    }
    talk.download().warned = false;
    match id {
        REQUEST_LIST => talk.list_logs(payload.short(0), payload.short(2)),
        REQUEST_DATA => talk.send_log(
            payload.short(8),
            payload.word(0) as usize,
            payload.word(4) as usize,
        ),
        ERASE => {
            talk.autopilot.vehicle.log.erase();
            *talk.download() = LogDownload::default();
        }
        _ => {
            talk.autopilot.vehicle.log.close();
            talk.download().sending = None;
        }
    }
    true
}

/// Sends the next messages of a download.
pub(super) fn step(talk: &mut Talk<'_>) {
    let now = talk.autopilot.vehicle.uptime();
    let Some(sending) = &talk.transfers.download.sending else {
        return;
    };
    if sending.peer.link == talk.peer.link {
        if !talk.autopilot.vehicle.safety.armed {
            talk.continue_sending();
        }
    } else if now.saturating_sub(sending.begun_at) > Duration::from_secs(60) {
        // The link of the download is gone.
        talk.download().sending = None;
    }
}

impl Talk<'_> {
    fn download(&mut self) -> &mut LogDownload {
        &mut self.transfers.download
    }

    fn list_logs(&mut self, start: u16, end: u16) {
        if self.download().sending.is_some() {
            self.text(MAV_SEVERITY_INFO, "Log download in progress");
            return;
        }
        let vehicle = &self.autopilot.vehicle;
        let kept = vehicle.log.kept();
        let count = kept.len() as u16;
        // Logs are numbered by their index here, as in the real vehicle's list.
        let (first, last) = if count == 0 {
            (0, 0)
        } else {
            (start.max(1), end.min(count))
        };
        let mut payloads = Vec::new();
        for place in first..=last.max(first) {
            let log = usize::from(place)
                .checked_sub(1)
                .and_then(|index| kept.get(index));
            let time_utc_ms = log.map_or(0, |log| log.boot_utc_ms + u64::from(log.begin_ms()));
            let size = log.map_or(0, RecordedLog::len) as u32;
            let entry = Writer::default()
                .word((time_utc_ms / 1000) as u32)
                .word(size)
                .short(place);
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
        if let Some(sending) = &self.transfers.download.sending {
            if sending.peer.link != self.peer.link {
                self.text(MAV_SEVERITY_INFO, "Log download in progress");
            }
            return;
        }
        let vehicle = &mut self.autopilot.vehicle;
        let log = usize::from(place)
            .checked_sub(1)
            .and_then(|index| vehicle.log.kept().get(index));
        let Some(number) = log.map(|log| log.number) else {
            return;
        };
        let size = vehicle.log.open(number);
        self.transfers.download.sending = Some(Sending {
            peer: self.peer,
            begun_at: vehicle.uptime(),
            number: place,
            offset,
            left: size.saturating_sub(offset).min(count),
        });
        self.continue_sending();
    }

    fn continue_sending(&mut self) {
        for _ in 0..SEND_PER_STEP {
            let download = &mut self.transfers.download;
            let file = self.autopilot.vehicle.log.opened();
            let (Some(sending), Some(file)) = (&mut download.sending, file) else {
                download.sending = None;
                return;
            };
            let rest = file.get(sending.offset..).unwrap_or_default();
            let bytes = &rest[..rest.len().min(sending.left).min(DATA_BYTES)];
            let payload = Writer::default()
                .word(sending.offset as u32)
                .short(sending.number)
                .bytes(&[bytes.len() as u8])
                .bytes(bytes)
                .done();
            sending.offset += bytes.len();
            sending.left -= bytes.len();
            if bytes.len() < DATA_BYTES || sending.left == 0 {
                download.sending = None;
            }
            self.raw(DATA, payload);
        }
    }
}
