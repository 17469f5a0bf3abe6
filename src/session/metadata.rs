//! Reads what a vehicle documents about its parameters and events (`param docs`): its general file, then the files that
//! this one names. Files are kept by their checksum, so that vehicles with the same firmware are asked once.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMPONENT_METADATA_DATA, MavCmd, MavMessage};

use super::files::{FileDesk, FilesScene};
use super::ftp::{FtpEvent, FtpTask, FtpTicket};
use super::{VehicleCommand, logs};
use crate::commands::{Command, QueryCommand};
use crate::ledger::{RowState, RowUpdate};
use crate::metadata::{
    EventDocuments, LARGEST_PACKED, MetadataFile, MetadataKind, MetadataPlace, general, unpacked,
};
use crate::parameters::ParameterDocuments;
use crate::text;
use crate::text::Text;

/// The time between requests for the message that names the general file.
const ASK_EVERY: Duration = Duration::from_secs(1);
const TRIES: u8 = 3;
/// The command with which the message is requested.
const REQUEST: u16 = MavCmd::MAV_CMD_REQUEST_MESSAGE as u16;

/// The documentation that a vehicle has, as far as it has been read.
#[derive(Debug, Clone, Default)]
pub(super) struct MetadataReader {
    desk: Option<Arc<dyn FileDesk>>,
    job: Option<MetadataJob>,
    parameters: Arc<ParameterDocuments>,
    /// The texts of events that have not been taken.
    events: Option<Arc<EventDocuments>>,
}

/// The order under way.
#[derive(Debug, Clone)]
struct MetadataJob {
    order: VehicleCommand,
    stage: Stage,
    /// The files that are still to be read.
    files: VecDeque<MetadataFile>,
    /// What was read, in words.
    read: Vec<Text>,
    /// What could not be read.
    faults: Vec<Text>,
    percent: Option<u8>,
}

#[derive(Debug, Clone)]
enum Stage {
    /// The message that names the general file is requested.
    Asking { tries: u8, due: Duration },
    Reading {
        part: Part,
        checksum: Option<u32>,
        ticket: FtpTicket,
        bytes: Vec<u8>,
        size: u32,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    General,
    Documents(MetadataKind),
}

/// The end of the reading of a file.
enum Heard {
    Whole(WholeFile),
    Fault(Part, Text),
}

/// A file as the vehicle has it.
struct WholeFile {
    part: Part,
    checksum: Option<u32>,
    bytes: Vec<u8>,
}

impl MetadataReader {
    /// Keeps files through `desk`.
    pub fn use_desk(&mut self, desk: Arc<dyn FileDesk>) {
        self.desk = Some(desk);
    }

    /// Whether an order is under way.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// The documentation of the vehicle's parameters; empty until it has been read.
    pub fn parameters(&self) -> &Arc<ParameterDocuments> {
        &self.parameters
    }

    /// The texts of events that were read since the last call.
    pub fn take_events(&mut self) -> Option<Arc<EventDocuments>> {
        self.events.take()
    }

    /// Begins to read for an order.
    pub fn order(&mut self, order: VehicleCommand, scene: &mut FilesScene<'_>) {
        // Before the vehicle has told its capabilities, it is simply asked.
        let is_without = scene.vehicle.version.is_some() && !logs::hands_out_files(scene.vehicle);
        if is_without {
            return scene.unsent(&order, RowState::Refused, text!("refused-files-none"));
        }
        if self.job.is_some() {
            return scene.unsent(&order, RowState::Refused, text!("refused-metadata-busy"));
        }
        self.job = Some(MetadataJob {
            order,
            stage: Stage::Asking {
                tries: 0,
                due: scene.now,
            },
            files: VecDeque::new(),
            read: Vec::new(),
            faults: Vec::new(),
            percent: None,
        });
    }

    /// Ends the order: the vehicle has rebooted.
    pub fn clear(&mut self, newer: &Text, scene: &mut FilesScene<'_>) {
        if let Some(job) = self.job.take() {
            if let Stage::Reading { ticket, .. } = job.stage {
                scene.ftp.cancel(ticket);
            }
            let reason = text!("outcome-superseded", by = newer);
            job.row(RowState::Superseded, Some(reason), scene);
        }
    }

    /// Requests the message that names the general file.
    pub fn poll(&mut self, scene: &mut FilesScene<'_>) {
        let Some(MetadataJob {
            stage: Stage::Asking { tries, due },
            ..
        }) = &mut self.job
        else {
            return;
        };
        if scene.now < *due {
            return;
        }
        if *tries >= TRIES {
            return self.end(RowState::TimedOut, text!("outcome-metadata-none"), scene);
        }
        *tries += 1;
        *due = scene.now + ASK_EVERY;
        let is_first = *tries == 1;
        let query = Command::Query(QueryCommand::Request {
            message: COMPONENT_METADATA_DATA::ID,
        });
        if let Ok(request) = query.request(scene.vehicle, 0) {
            scene.output.messages.extend(request.messages);
            scene.output.unawaited.push(REQUEST);
        }
        if let Some(job) = self.job.as_ref().filter(|_| is_first) {
            job.row(RowState::Sent, None, scene);
        }
    }

    /// Handles a message of the autopilot.
    pub fn receive(&mut self, message: &MavMessage, scene: &mut FilesScene<'_>) {
        let MavMessage::COMPONENT_METADATA(data) = message else {
            return;
        };
        let is_awaited = matches!(
            self.job,
            Some(MetadataJob {
                stage: Stage::Asking { .. },
                ..
            })
        );
        if !is_awaited {
            return;
        }
        let address = data.uri.to_str().unwrap_or_default();
        match MetadataPlace::of(address) {
            Some(MetadataPlace::OnBoard(path)) => {
                self.fetch(Part::General, path, Some(data.file_crc), scene);
            }
            Some(MetadataPlace::Elsewhere(address)) => {
                let text = text!("metadata-elsewhere", address = address);
                self.end(RowState::Refused, text, scene);
            }
            None => self.end(RowState::Refused, text!("outcome-metadata-none"), scene),
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, scene: &mut FilesScene<'_>) {
        let Some(job) = &mut self.job else {
            return;
        };
        match job.hear(ticket, event, scene) {
            None => {}
            Some(Heard::Whole(whole)) => self.take(whole, scene),
            Some(Heard::Fault(part, fault)) => self.leave_out(part, fault, scene),
        }
    }

    /// Reads a file: the one that was kept under its checksum, or else the vehicle's.
    fn fetch(
        &mut self,
        part: Part,
        path: String,
        checksum: Option<u32>,
        scene: &mut FilesScene<'_>,
    ) {
        let kept = checksum.and_then(|checksum| self.desk.as_ref()?.kept(checksum));
        if let Some(kept) = kept
            && let Ok(text) = unpacked(kept)
            && self.understand(part, &text).is_ok()
        {
            return self.go_on(scene);
        }
        let ticket = scene.ftp.ask(FtpTask::Read { path, gaps: None });
        if let Some(job) = &mut self.job {
            job.stage = Stage::Reading {
                part,
                checksum,
                ticket,
                bytes: Vec::new(),
                size: 0,
            };
        }
    }

    /// Takes in a whole file, and keeps it if it can be used.
    fn take(&mut self, whole: WholeFile, scene: &mut FilesScene<'_>) {
        let WholeFile {
            part,
            checksum,
            bytes,
        } = whole;
        let text = unpacked(bytes.clone());
        match text.and_then(|text| self.understand(part, &text)) {
            Ok(()) => {
                if let (Some(desk), Some(checksum)) = (&self.desk, checksum) {
                    desk.keep(checksum, &bytes);
                }
                self.go_on(scene);
            }
            Err(fault) => self.leave_out(part, fault, scene),
        }
    }

    /// Takes in the content of a file.
    fn understand(&mut self, part: Part, source: &str) -> Result<(), Text> {
        let Some(job) = &mut self.job else {
            return Ok(());
        };
        match part {
            Part::General => {
                let files = general(source)?;
                if files.is_empty() {
                    return Err(text!("metadata-nothing"));
                }
                job.files = files.into();
            }
            Part::Documents(MetadataKind::Parameters) => {
                let found = ParameterDocuments::read(source);
                if found.documents.is_empty() {
                    let fault = found.faults.into_iter().next();
                    return Err(fault.map_or_else(Text::default, |fault| fault.message));
                }
                job.read
                    .push(text!("metadata-parameters", count = found.documents.len()));
                self.parameters = Arc::new(found.documents);
            }
            Part::Documents(MetadataKind::Events) => {
                let found = EventDocuments::read(source)?;
                job.read
                    .push(text!("metadata-events", count = found.documents.len()));
                self.events = Some(Arc::new(found.documents));
            }
        }
        Ok(())
    }

    /// Goes on without a file; without the general one, the order ends.
    fn leave_out(&mut self, part: Part, fault: Text, scene: &mut FilesScene<'_>) {
        let Part::Documents(kind) = part else {
            return self.end(RowState::Refused, fault, scene);
        };
        if let Some(job) = &mut self.job {
            job.faults.push(left_out(kind, &fault));
        }
        self.go_on(scene);
    }

    /// Reads the next file, or ends the order.
    fn go_on(&mut self, scene: &mut FilesScene<'_>) {
        let Some(job) = &mut self.job else {
            return;
        };
        while let Some(MetadataFile {
            kind,
            place,
            checksum,
        }) = job.files.pop_front()
        {
            match place {
                MetadataPlace::OnBoard(path) => {
                    return self.fetch(Part::Documents(kind), path, checksum, scene);
                }
                MetadataPlace::Elsewhere(address) => {
                    let fault = text!("metadata-elsewhere", address = address);
                    job.faults.push(left_out(kind, &fault));
                }
            }
        }
        let state = if job.read.is_empty() {
            RowState::Refused
        } else {
            RowState::Done
        };
        let said = job.read.iter().chain(&job.faults).cloned().collect();
        self.end(state, Text::joined("; ", said), scene);
    }

    fn end(&mut self, state: RowState, text: Text, scene: &mut FilesScene<'_>) {
        if let Some(job) = self.job.take() {
            job.row(state, Some(text), scene);
        }
    }
}

impl MetadataJob {
    fn row(&self, state: RowState, explanation: Option<Text>, scene: &mut FilesScene<'_>) {
        scene.output.row(RowUpdate {
            entry: self.order.entry,
            vehicle: scene.vehicle.id,
            state,
            tries: 1,
            at: scene.now,
            explanation,
        });
    }

    /// Handles an event of the file client; returns the end of the file that is being read.
    fn hear(
        &mut self,
        ticket: FtpTicket,
        event: &FtpEvent,
        scene: &mut FilesScene<'_>,
    ) -> Option<Heard> {
        let Stage::Reading {
            part,
            checksum,
            ticket: own,
            bytes,
            size,
        } = &mut self.stage
        else {
            return None;
        };
        if *own != ticket {
            return None;
        }
        if needs(event) > LARGEST_PACKED {
            scene.ftp.cancel(ticket);
            let most = LARGEST_PACKED / 1024 / 1024;
            return Some(Heard::Fault(
                *part,
                text!("metadata-too-large", most = most),
            ));
        }
        match event {
            FtpEvent::Opened(opened) => {
                *size = *opened;
                bytes.clear();
            }
            FtpEvent::Bytes(piece) => {
                piece.write_to(bytes);
                let share = bytes.len() as u64 * 100 / u64::from((*size).max(1));
                self.progress(share.min(100) as u8, scene);
            }
            FtpEvent::Complete(length) => {
                bytes.truncate(*length as usize);
                return Some(Heard::Whole(WholeFile {
                    part: *part,
                    checksum: *checksum,
                    bytes: std::mem::take(bytes),
                }));
            }
            FtpEvent::Failed(fault) => return Some(Heard::Fault(*part, Text::from(*fault))),
            FtpEvent::Listed(_)
            | FtpEvent::Checksum(_)
            | FtpEvent::Wrote(_)
            | FtpEvent::Written
            | FtpEvent::Done => {}
        }
        None
    }

    fn progress(&mut self, percent: u8, scene: &mut FilesScene<'_>) {
        if self.percent != Some(percent) {
            self.percent = Some(percent);
            self.row(RowState::InProgress(percent), None, scene);
        }
    }
}

/// The size that a file has at least, according to an event.
fn needs(event: &FtpEvent) -> u32 {
    match event {
        FtpEvent::Opened(size) => *size,
        FtpEvent::Bytes(piece) => piece.range().end,
        FtpEvent::Complete(_)
        | FtpEvent::Failed(_)
        | FtpEvent::Listed(_)
        | FtpEvent::Checksum(_)
        | FtpEvent::Wrote(_)
        | FtpEvent::Written
        | FtpEvent::Done => 0,
    }
}

fn left_out(kind: MetadataKind, fault: &Text) -> Text {
    match kind {
        MetadataKind::Parameters => text!("metadata-no-parameters", fault = fault),
        MetadataKind::Events => text!("metadata-no-events", fault = fault),
    }
}
