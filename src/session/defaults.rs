//! The defaults of a vehicle's parameters: read once as a file, after its list is complete, from an ArduPilot that offers
//! files. Without them, nothing is missing but a remark, so a failure is not repeated before the next reboot.

use std::collections::BTreeMap;

use super::ftp::{FtpClient, FtpEvent, FtpTask, FtpTicket};
use crate::parameters::{DEFAULTS_FILE, Fetching, read_defaults};

/// The largest file that is read, in bytes: ten times that of a vehicle with all parameters.
const LARGEST: u32 = 512 * 1024;

/// The reading of the defaults.
#[derive(Debug, Clone, Default)]
pub(super) struct DefaultsReader {
    stage: DefaultsStage,
}

#[derive(Debug, Clone, Default)]
enum DefaultsStage {
    #[default]
    Waiting,
    Reading {
        ticket: FtpTicket,
        bytes: Vec<u8>,
    },
    /// The file was read, or cannot be.
    Over,
}

impl DefaultsReader {
    /// Begins again: the vehicle has rebooted.
    pub fn begin_anew(&mut self) {
        self.stage = DefaultsStage::Waiting;
    }

    /// Requests the file once the list is complete.
    pub fn poll(&mut self, fetching: Fetching, offers_file: bool, ftp: &mut FtpClient) {
        let is_due = matches!(self.stage, DefaultsStage::Waiting);
        if is_due && offers_file && fetching == Fetching::Complete && !ftp.is_busy() {
            let ticket = ftp.ask(FtpTask::Read {
                path: DEFAULTS_FILE.to_owned(),
                gaps: None,
            });
            let bytes = Vec::new();
            self.stage = DefaultsStage::Reading { ticket, bytes };
        }
    }

    /// Handles an event of the file client; returns the defaults once the file is whole.
    pub fn hear_file(
        &mut self,
        ticket: FtpTicket,
        event: &FtpEvent,
        ftp: &mut FtpClient,
    ) -> Option<BTreeMap<String, f64>> {
        let DefaultsStage::Reading { ticket: own, bytes } = &mut self.stage else {
            return None;
        };
        if *own != ticket {
            return None;
        }
        match event {
            FtpEvent::Opened(_) => bytes.clear(),
            FtpEvent::Bytes(piece) if piece.range().end <= LARGEST => piece.write_to(bytes),
            FtpEvent::Bytes(_) => {
                ftp.cancel(ticket);
                self.stage = DefaultsStage::Over;
            }
            FtpEvent::Complete(size) => {
                bytes.truncate(*size as usize);
                let defaults = read_defaults(bytes);
                self.stage = DefaultsStage::Over;
                return defaults;
            }
            FtpEvent::Failed(_) => self.stage = DefaultsStage::Over,
            FtpEvent::Listed(_)
            | FtpEvent::Checksum(_)
            | FtpEvent::Wrote(_)
            | FtpEvent::Written
            | FtpEvent::Done => {}
        }
        None
    }
}
