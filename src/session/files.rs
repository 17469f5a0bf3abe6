//! Carries out commands about a vehicle's files: list, copy, remove, checksum.
//!
//! These orders are separate from the line of commands, one at a time: a file takes minutes over a radio, and must not
//! hold up a command.

use std::collections::VecDeque;
use std::fmt::Debug;
use std::sync::Arc;
use std::time::Duration;

use self::job::{FileEnding, FileJob};
use super::ftp::{FtpClient, FtpEvent, FtpTicket};
use super::logs::hands_out_files;
use super::{Output, Report, VehicleCommand};
use crate::commands::{Command, FileCommand};
use crate::ledger::{RowState, RowUpdate};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

mod job;
mod words;

const MOST_WAITING: usize = 8;

/// Reads and writes files of this machine for a session.
pub trait FileDesk: Debug + Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// The file cannot be read, or is too large to be sent.
    fn read(&self, file: &str) -> Result<Vec<u8>, Text>;

    /// Writes a new file, and returns its path.
    ///
    /// # Errors
    /// A file of this name exists, or the file cannot be written.
    fn write(&self, file: &str, bytes: &[u8]) -> Result<String, Text>;

    /// The file of a vehicle's documentation that was kept under a checksum; `None` if there is none.
    fn kept(&self, checksum: u32) -> Option<Vec<u8>>;

    /// Keeps a file of a vehicle's documentation under its checksum. If that fails, it is read from the vehicle again.
    fn keep(&self, checksum: u32, bytes: &[u8]);
}

/// The orders about the files of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct FileOrders {
    desk: Option<Arc<dyn FileDesk>>,
    waiting: VecDeque<VehicleCommand>,
    job: Option<FileJob>,
    /// The order that ends all other orders.
    stop: Option<VehicleCommand>,
}

/// The surroundings of the orders at one moment.
pub(super) struct FilesScene<'a> {
    pub vehicle: &'a Vehicle,
    pub ftp: &'a mut FtpClient,
    pub now: Duration,
    pub output: &'a mut Output,
}

impl FilesScene<'_> {
    fn row(&mut self, order: &VehicleCommand, state: RowState, explanation: Option<Text>) {
        self.output.row(RowUpdate {
            entry: order.entry,
            vehicle: self.vehicle.id,
            state,
            tries: 1,
            at: self.now,
            explanation,
        });
    }

    pub fn unsent(&mut self, order: &VehicleCommand, state: RowState, reason: Text) {
        let row = order.unsent(self.vehicle.id, state, reason, self.now);
        self.output.row(row);
    }
}

impl FileOrders {
    /// Reads and writes files of this machine through `desk`.
    pub fn use_desk(&mut self, desk: Arc<dyn FileDesk>) {
        self.desk = Some(desk);
    }

    /// Whether an answer is awaited.
    pub fn is_busy(&self) -> bool {
        self.job.is_some() || !self.waiting.is_empty()
    }

    pub fn order(&mut self, order: VehicleCommand, scene: &mut FilesScene<'_>) {
        if order.command == Command::File(FileCommand::Stop) {
            self.stop = Some(order);
            return;
        }
        // Before the vehicle has told its capabilities, it is simply asked.
        let is_without = scene.vehicle.version.is_some() && !hands_out_files(scene.vehicle);
        let needs_desk = matches!(
            order.command,
            Command::File(FileCommand::Get { .. } | FileCommand::Put { .. })
        );
        let refusal = if is_without {
            Some(text!("refused-files-none"))
        } else if needs_desk && self.desk.is_none() {
            Some(text!("refused-files-nowhere"))
        } else if self.waiting.len() >= MOST_WAITING {
            Some(text!("outcome-queue-full", count = MOST_WAITING))
        } else {
            None
        };
        match refusal {
            Some(reason) => scene.unsent(&order, RowState::Refused, reason),
            None => self.waiting.push_back(order),
        }
    }

    /// Ends all orders: the vehicle has rebooted, or the user stops them.
    pub fn clear(&mut self, newer: &Text, scene: &mut FilesScene<'_>) {
        let reason = text!("outcome-superseded", by = newer);
        for order in std::mem::take(&mut self.waiting) {
            scene.unsent(&order, RowState::Superseded, reason.clone());
        }
        if let Some(job) = self.job.take() {
            scene.ftp.cancel(job.ticket());
            scene.row(job.order(), RowState::Superseded, Some(reason));
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, scene: &mut FilesScene<'_>) {
        let Some(mut job) = self.job.take_if(|job| job.ticket() == ticket) else {
            return;
        };
        match job.hear(event, self.desk.as_deref(), scene) {
            Ok(None) => self.job = Some(job),
            Ok(Some(percent)) => {
                scene.row(job.order(), RowState::InProgress(percent), None);
                self.job = Some(job);
            }
            Err(FileEnding {
                state,
                text,
                listed,
            }) => {
                scene.row(job.order(), state, Some(text));
                scene.output.reports.extend(listed.map(Report::Folder));
            }
        }
    }

    /// Advances time: begins and ends orders.
    pub fn poll(&mut self, scene: &mut FilesScene<'_>) {
        if let Some(stop) = self.stop.take() {
            if self.is_busy() {
                self.clear(&Text::verbatim("ftp stop"), scene);
                scene.unsent(&stop, RowState::Done, text!("outcome-files-stopped"));
            } else {
                scene.unsent(&stop, RowState::Refused, text!("refused-files-idle"));
            }
        }
        while self.job.is_none()
            && let Some(order) = self.waiting.pop_front()
        {
            match FileJob::begin(&order, self.desk.as_deref(), scene.ftp) {
                Ok(job) => {
                    scene.row(&order, RowState::Sent, None);
                    self.job = Some(job);
                }
                Err(reason) => scene.unsent(&order, RowState::Refused, reason),
            }
        }
    }
}
