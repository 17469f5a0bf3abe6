//! One order about a vehicle's files.

use super::words::{entries_text, got, put};
use super::{FileDesk, FilesScene};
use crate::commands::{Command, FileCommand, last_part};
use crate::ledger::RowState;
use crate::session::ftp::{FtpClient, FtpEntry, FtpEvent, FtpFault, FtpTask, FtpTicket};
use crate::session::gaps::FileBytes;
use crate::session::{ListedFolder, VehicleCommand};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::FtpChecksum;

/// The largest file that is copied, in bytes: it is kept in memory until it is complete.
const LARGEST: u32 = 64 * 1024 * 1024;
/// The assumed size of a file whose checksum is requested, in bytes: the server takes time to read it.
const CHECKED: u32 = 8 * 1024 * 1024;
/// Files below this are generated when they are read, so their checksum may differ each time.
const GENERATED: char = '@';

/// An order that is being carried out.
#[derive(Debug, Clone)]
pub(super) struct FileJob {
    order: VehicleCommand,
    command: FileCommand,
    ticket: FtpTicket,
    /// The bytes of the file that is copied, as far as they are known.
    bytes: Vec<u8>,
    /// The size of the file that is copied, once known; generated files have only an estimate.
    size: u32,
    /// Whether all bytes are copied, and the vehicle's checksum is awaited.
    is_copied: bool,
    /// The progress last reported, in percent.
    percent: Option<u8>,
}

/// The end of an order.
#[derive(Debug)]
pub(super) struct FileEnding {
    pub state: RowState,
    pub text: Text,
    /// The entries of the folder that was requested.
    pub listed: Option<ListedFolder>,
}

impl FileEnding {
    fn new(state: RowState, text: Text) -> Self {
        Self {
            state,
            text,
            listed: None,
        }
    }

    fn done(text: Text) -> Self {
        Self::new(RowState::Done, text)
    }

    fn failed(fault: FtpFault) -> Self {
        let state = match fault {
            FtpFault::Silent => RowState::TimedOut,
            FtpFault::Refused(_)
            | FtpFault::OtherSize(_)
            | FtpFault::Malformed
            | FtpFault::TooMany
            | FtpFault::BadPath => RowState::Refused,
        };
        Self::new(state, fault.into())
    }
}

impl FileJob {
    /// Begins an order.
    ///
    /// # Errors
    /// The file to send cannot be read.
    pub fn begin(
        order: &VehicleCommand,
        desk: Option<&dyn FileDesk>,
        ftp: &mut FtpClient,
    ) -> Result<Self, Text> {
        let Command::File(command) = &order.command else {
            return Err(text!("refused-files-here"));
        };
        let mut bytes = Vec::new();
        let task = match command {
            FileCommand::List { folder } => FtpTask::List {
                folder: folder.clone(),
            },
            FileCommand::Get { path, .. } => FtpTask::Read {
                path: path.clone(),
                gaps: None,
            },
            FileCommand::Put { file, path } => {
                let desk = desk.ok_or_else(|| text!("refused-files-nowhere"))?;
                bytes = desk.read(file)?;
                FtpTask::Write {
                    path: path.clone(),
                    bytes: bytes.clone(),
                }
            }
            FileCommand::Remove { path } => FtpTask::Remove { path: path.clone() },
            FileCommand::MakeFolder { path } => FtpTask::MakeFolder { path: path.clone() },
            FileCommand::Checksum { path } => FtpTask::Checksum {
                path: path.clone(),
                size: CHECKED,
            },
            FileCommand::Documentation | FileCommand::Stop => {
                return Err(text!("refused-files-here"));
            }
        };
        Ok(Self {
            order: order.clone(),
            command: command.clone(),
            ticket: ftp.ask(task),
            size: bytes.len() as u32,
            bytes,
            is_copied: false,
            percent: None,
        })
    }

    pub fn order(&self) -> &VehicleCommand {
        &self.order
    }

    pub fn ticket(&self) -> FtpTicket {
        self.ticket
    }

    /// Handles an event of the order's task; returns the progress in percent, if it is new. The end of the order is
    /// returned as an error.
    pub fn hear(
        &mut self,
        event: &FtpEvent,
        desk: Option<&dyn FileDesk>,
        scene: &mut FilesScene<'_>,
    ) -> Result<Option<u8>, FileEnding> {
        match event {
            FtpEvent::Listed(entries) => Err(self.listed(entries, scene.vehicle.id)),
            FtpEvent::Opened(size) => {
                self.size = *size;
                self.bytes.clear();
                Ok(None)
            }
            FtpEvent::Bytes(piece) => {
                self.take(piece)?;
                Ok(self.progress(self.bytes.len() as u32))
            }
            FtpEvent::Wrote(written) => Ok(self.progress(*written)),
            FtpEvent::Complete(size) => {
                self.bytes.truncate(*size as usize);
                self.copied(desk, scene)
            }
            FtpEvent::Written => self.copied(desk, scene),
            FtpEvent::Checksum(sum) => Err(self.checked(*sum, desk, scene)),
            FtpEvent::Done => Err(FileEnding::done(self.changed())),
            // The file is whole, even if the vehicle cannot say its checksum.
            FtpEvent::Failed(_) if self.is_copied => Err(self.finish(false, desk, scene)),
            FtpEvent::Failed(fault) => Err(FileEnding::failed(*fault)),
        }
    }

    fn listed(&self, entries: &[FtpEntry], vehicle: VehicleId) -> FileEnding {
        let FileCommand::List { folder } = &self.command else {
            return FileEnding::failed(FtpFault::Malformed);
        };
        let mut sorted = entries.to_vec();
        sorted.sort_by(|a, b| (a.size.is_some(), &a.name).cmp(&(b.size.is_some(), &b.name)));
        FileEnding {
            listed: Some(ListedFolder {
                vehicle,
                folder: folder.clone(),
                entries: sorted.clone(),
            }),
            ..FileEnding::done(entries_text(&sorted))
        }
    }

    /// Stores bytes at their place.
    fn take(&mut self, piece: &FileBytes) -> Result<(), FileEnding> {
        if piece.range().end > LARGEST {
            let text = text!("refused-file-large", most = LARGEST / 1024 / 1024);
            return Err(FileEnding::new(RowState::Refused, text));
        }
        piece.write_to(&mut self.bytes);
        Ok(())
    }

    fn progress(&mut self, done: u32) -> Option<u8> {
        let share = u64::from(done) * 100 / u64::from(self.size.max(1));
        let percent = share.min(100) as u8;
        let is_new = self.percent != Some(percent);
        self.percent = Some(percent);
        is_new.then_some(percent)
    }

    /// All bytes are copied: the vehicle's checksum is compared, unless the file is a generated one.
    fn copied(
        &mut self,
        desk: Option<&dyn FileDesk>,
        scene: &mut FilesScene<'_>,
    ) -> Result<Option<u8>, FileEnding> {
        let path = match &self.command {
            FileCommand::Get { path, .. } | FileCommand::Put { path, .. } => path,
            FileCommand::List { .. }
            | FileCommand::Remove { .. }
            | FileCommand::MakeFolder { .. }
            | FileCommand::Checksum { .. }
            | FileCommand::Documentation
            | FileCommand::Stop => return Err(FileEnding::failed(FtpFault::Malformed)),
        };
        self.is_copied = true;
        if path.trim_start_matches('/').starts_with(GENERATED) {
            return Err(self.finish(false, desk, scene));
        }
        self.ticket = scene.ftp.ask(FtpTask::Checksum {
            path: path.clone(),
            size: self.bytes.len() as u32,
        });
        Ok(None)
    }

    fn checked(&self, sum: u32, desk: Option<&dyn FileDesk>, scene: &FilesScene<'_>) -> FileEnding {
        if !self.is_copied {
            return FileEnding::done(text!("outcome-file-checksum", sum = format!("{sum:08x}")));
        }
        if sum == FtpChecksum::of(&self.bytes) {
            return self.finish(true, desk, scene);
        }
        FileEnding::new(RowState::Refused, text!("outcome-file-differs"))
    }

    /// Writes a file of the vehicle to this machine, or reports that a file has been sent.
    fn finish(
        &self,
        is_verified: bool,
        desk: Option<&dyn FileDesk>,
        scene: &FilesScene<'_>,
    ) -> FileEnding {
        let FileCommand::Get { path, to } = &self.command else {
            return FileEnding::done(put(self.bytes.len(), is_verified));
        };
        let given = to.clone();
        let name =
            given.unwrap_or_else(|| format!("vehicle-{}-{}", scene.vehicle.id, last_part(path)));
        let named = name.replace("{id}", &scene.vehicle.id.to_string());
        let written = match desk {
            Some(desk) => desk.write(&named, &self.bytes),
            None => Err(text!("refused-files-nowhere")),
        };
        match written {
            Ok(file) => FileEnding::done(got(&file, self.bytes.len(), is_verified)),
            Err(reason) => FileEnding::new(RowState::Refused, reason),
        }
    }

    /// The outcome of a change to files or folders.
    fn changed(&self) -> Text {
        match &self.command {
            FileCommand::MakeFolder { path } => text!("outcome-folder-made", path = path),
            FileCommand::Remove { path } => text!("outcome-file-removed", path = path),
            FileCommand::List { .. }
            | FileCommand::Get { .. }
            | FileCommand::Put { .. }
            | FileCommand::Checksum { .. }
            | FileCommand::Documentation
            | FileCommand::Stop => text!("outcome-files-stopped"),
        }
    }
}
