//! Creating a file, writing it, and closing it.

use std::time::Duration;

use super::exchange::Exchange;
use super::packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence, MOST_DATA};
use super::{FtpFault, FtpNak, MOST_REFUSALS, PATIENCE, UNTIL_IDLE};

/// A file that is being written, one packet at a time. The server repeats an answer that was lost,
/// so packets are never written out of order.
#[derive(Debug, Clone)]
pub(super) struct FileWriting {
    path: String,
    session: u8,
    bytes: Vec<u8>,
    written: usize,
    refusals: u8,
    stage: WritingStage,
}

#[derive(Debug, Clone)]
enum WritingStage {
    Opening(Exchange),
    /// Waits until this time for another session to end.
    Resting(Duration),
    /// Writes a packet of this many bytes.
    Writing(Exchange, usize),
    Closing(Exchange),
}

/// The meaning of an answer for the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum WritingNews {
    Nothing,
    /// The number of bytes written so far.
    Wrote(u32),
    /// The file has been closed.
    Written,
    Fault(FtpFault),
}

impl FileWriting {
    pub fn new(path: String, session: u8, bytes: Vec<u8>, sequence: &mut FtpSequence) -> Self {
        Self {
            stage: opening(&path, session, sequence),
            path,
            session,
            bytes,
            written: 0,
            refusals: 0,
        }
    }

    /// The session that may be open on the server.
    pub fn session(&self) -> u8 {
        self.session
    }

    pub fn receive(
        &mut self,
        answer: &FtpAnswer,
        sequence: &mut FtpSequence,
        now: Duration,
    ) -> WritingNews {
        let (WritingStage::Opening(exchange)
        | WritingStage::Writing(exchange, _)
        | WritingStage::Closing(exchange)) = &self.stage
        else {
            return WritingNews::Nothing;
        };
        if !exchange.is_answered_by(answer) {
            return WritingNews::Nothing;
        }
        if let Err(nak) = answer.result {
            return self.refused(nak, now);
        }
        match &self.stage {
            // PX4 assigns the session number.
            WritingStage::Opening(_) => self.session = answer.session,
            WritingStage::Writing(_, size) => self.written += size,
            WritingStage::Closing(_) => return WritingNews::Written,
            WritingStage::Resting(_) => return WritingNews::Nothing,
        }
        self.stage = self.next(sequence);
        // A file is shorter than 4 GiB.
        WritingNews::Wrote(self.written as u32)
    }

    /// Writes the next packet, or closes the file after the last.
    fn next(&self, sequence: &mut FtpSequence) -> WritingStage {
        let rest = &self.bytes[self.written..];
        let data = rest[..rest.len().min(MOST_DATA)].to_vec();
        let size = data.len();
        let opcode = match size {
            0 => FtpOpcode::Terminate,
            _ => FtpOpcode::Write,
        };
        let request = FtpRequest {
            sequence: sequence.next(),
            session: self.session,
            opcode,
            offset: if size == 0 { 0 } else { self.written as u32 },
            size: size as u8,
            data,
        };
        let exchange = Exchange::new(request, PATIENCE);
        match size {
            0 => WritingStage::Closing(exchange),
            _ => WritingStage::Writing(exchange, size),
        }
    }

    fn refused(&mut self, nak: FtpNak, now: Duration) -> WritingNews {
        self.refusals += 1;
        let is_opening = matches!(self.stage, WritingStage::Opening(_));
        if !is_opening || !nak.is_of_busy_server() || self.refusals >= MOST_REFUSALS {
            return WritingNews::Fault(FtpFault::Refused(nak));
        }
        self.stage = WritingStage::Resting(now + UNTIL_IDLE);
        WritingNews::Nothing
    }

    /// The request that is due.
    ///
    /// # Errors
    /// [`FtpFault::Silent`] if nothing was received for a long time.
    pub fn poll(
        &mut self,
        sequence: &mut FtpSequence,
        round_trip: Duration,
        now: Duration,
    ) -> Result<Option<FtpRequest>, FtpFault> {
        if let WritingStage::Resting(until) = self.stage
            && now >= until
        {
            self.stage = opening(&self.path, self.session, sequence);
        }
        match &mut self.stage {
            WritingStage::Opening(exchange)
            | WritingStage::Writing(exchange, _)
            | WritingStage::Closing(exchange) => Ok(exchange.poll(round_trip, now)?.cloned()),
            WritingStage::Resting(_) => Ok(None),
        }
    }
}

fn opening(path: &str, session: u8, sequence: &mut FtpSequence) -> WritingStage {
    let request = FtpRequest::about(path, FtpOpcode::Create, session, sequence);
    WritingStage::Opening(Exchange::new(request, PATIENCE))
}
