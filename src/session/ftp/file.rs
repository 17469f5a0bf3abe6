//! Opening a file and reading it.

use std::time::Duration;

use super::exchange::Exchange;
use super::flow::{FileFlow, Heard};
use super::packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence};
use super::{FtpFault, FtpNak, MOST_REFUSALS, PATIENCE, UNTIL_IDLE};
use crate::session::gaps::{FileBytes, GapMap};

/// After this many losses of the session in a row, further attempts are pointless.
const MOST_LOSSES: u8 = 3;

/// The opening and reading of a file.
#[derive(Debug, Clone)]
pub(super) struct FileReading {
    path: String,
    session: u8,
    /// The missing parts of a file of known size; `None` until a file of unknown size is opened.
    known: Option<GapMap>,
    stage: FileStage,
    refusals: u8,
    losses: u8,
    is_estimate: bool,
}

#[derive(Debug, Clone)]
enum FileStage {
    Opening(Exchange),
    /// Ends sessions that were left open.
    Resetting(Exchange),
    /// Waits until this time for another session to end.
    Resting(Duration),
    Flowing(FileFlow),
}

/// The meaning of an answer for a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FileNews {
    Nothing,
    /// The file has been opened and has this size in bytes.
    Opened(u32),
    Bytes(FileBytes),
    Fault(FtpFault),
}

impl FileReading {
    pub fn new(
        path: String,
        session: u8,
        known: Option<GapMap>,
        sequence: &mut FtpSequence,
    ) -> Self {
        Self {
            stage: opening(&path, session, sequence),
            is_estimate: known.is_none(),
            path,
            session,
            known,
            refusals: 0,
            losses: 0,
        }
    }

    /// The session that may be open on the server.
    pub fn session(&self) -> u8 {
        self.session
    }

    /// The size of the file in bytes, once all of it has been received.
    pub fn complete(&self) -> Option<u32> {
        match &self.stage {
            FileStage::Flowing(flow) => flow.gaps().is_complete().then(|| flow.gaps().size()),
            FileStage::Opening(_) | FileStage::Resetting(_) | FileStage::Resting(_) => None,
        }
    }

    pub fn receive(
        &mut self,
        answer: &FtpAnswer,
        sequence: &mut FtpSequence,
        now: Duration,
    ) -> FileNews {
        match &mut self.stage {
            FileStage::Opening(exchange) if exchange.is_answered_by(answer) => {
                let request = exchange.request().clone();
                self.opened(&request, answer, sequence, now)
            }
            FileStage::Resetting(exchange) if exchange.is_answered_by(answer) => {
                self.stage = opening(&self.path, self.session, sequence);
                FileNews::Nothing
            }
            FileStage::Flowing(flow) => match flow.receive(answer, sequence, now) {
                Heard::Nothing => FileNews::Nothing,
                Heard::Bytes(bytes) => {
                    self.losses = 0;
                    FileNews::Bytes(bytes)
                }
                Heard::Lost(nak) => self.lost(nak, sequence),
                Heard::Fault(fault) => FileNews::Fault(fault),
            },
            FileStage::Opening(_) | FileStage::Resetting(_) | FileStage::Resting(_) => {
                FileNews::Nothing
            }
        }
    }

    fn opened(
        &mut self,
        request: &FtpRequest,
        answer: &FtpAnswer,
        sequence: &mut FtpSequence,
        now: Duration,
    ) -> FileNews {
        let data = match &answer.result {
            Ok(data) => data,
            Err(nak) => return self.refused(*nak, sequence, now),
        };
        let Some(size) = data.first_chunk().copied().map(u32::from_le_bytes) else {
            return FileNews::Fault(FtpFault::Malformed);
        };
        // PX4 assigns the session number.
        self.session = answer.session;
        let gaps = self.known.take().unwrap_or_else(|| GapMap::new(size));
        if gaps.size() != size {
            return FileNews::Fault(FtpFault::OtherSize(size));
        }
        let flow = FileFlow::new(request, self.session, gaps, now);
        self.stage = FileStage::Flowing(if self.is_estimate {
            flow.estimated()
        } else {
            flow
        });
        FileNews::Opened(size)
    }

    /// Handles a refusal to open the file: the server may be busy with another session, or with one that was never
    /// closed.
    fn refused(&mut self, nak: FtpNak, sequence: &mut FtpSequence, now: Duration) -> FileNews {
        self.refusals += 1;
        if !nak.is_of_busy_server() || self.refusals >= MOST_REFUSALS {
            return FileNews::Fault(FtpFault::Refused(nak));
        }
        self.stage = if self.refusals == 1 {
            let request = FtpRequest {
                sequence: sequence.next(),
                session: self.session,
                opcode: FtpOpcode::Reset,
                offset: 0,
                size: 0,
                data: Vec::new(),
            };
            FileStage::Resetting(Exchange::new(request, PATIENCE))
        } else {
            FileStage::Resting(now + UNTIL_IDLE)
        };
        FileNews::Nothing
    }

    /// Opens the file again to read the missing parts.
    fn lost(&mut self, nak: FtpNak, sequence: &mut FtpSequence) -> FileNews {
        self.losses += 1;
        if self.losses > MOST_LOSSES {
            return FileNews::Fault(FtpFault::Refused(nak));
        }
        if let FileStage::Flowing(flow) = &self.stage {
            // An estimated size may have shrunk in the meantime; then the whole file is read again.
            self.known = (!self.is_estimate).then(|| flow.gaps().clone());
        }
        self.stage = opening(&self.path, self.session, sequence);
        FileNews::Nothing
    }

    /// The requests that are due.
    ///
    /// # Errors
    /// [`FtpFault::Silent`] if nothing useful was received for a long time.
    pub fn poll(
        &mut self,
        sequence: &mut FtpSequence,
        round_trip: Duration,
        now: Duration,
    ) -> Result<Vec<FtpRequest>, FtpFault> {
        if let FileStage::Resting(until) = self.stage
            && now >= until
        {
            self.stage = opening(&self.path, self.session, sequence);
        }
        match &mut self.stage {
            FileStage::Opening(exchange) | FileStage::Resetting(exchange) => {
                let request = exchange.poll(round_trip, now)?;
                Ok(request.cloned().into_iter().collect())
            }
            FileStage::Resting(_) => Ok(Vec::new()),
            FileStage::Flowing(flow) => flow.poll(sequence, round_trip, now),
        }
    }
}

fn opening(path: &str, session: u8, sequence: &mut FtpSequence) -> FileStage {
    let request = FtpRequest::about(path, FtpOpcode::OpenToRead, session, sequence);
    FileStage::Opening(Exchange::new(request, PATIENCE))
}
