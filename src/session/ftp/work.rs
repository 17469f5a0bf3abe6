//! The work of a task: handling its answers, and sending the requests that are due.

use std::time::Duration;

use super::exchange::Exchange;
use super::file::{FileNews, FileReading};
use super::listing::{FolderListing, Listed};
use super::packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence};
use super::writing::{FileWriting, WritingNews};
use super::{FtpEvent, FtpFault, FtpTask, PATIENCE};

/// The minimum speed at which a server reads its own file for the checksum, in bytes per second.
const SLOWEST_CHECKSUM: u32 = 200_000;

/// The stage of a task.
#[derive(Debug, Clone)]
pub(super) enum FtpWork {
    Listing {
        folder: String,
        listing: FolderListing,
        exchange: Exchange,
    },
    Checking(Exchange),
    /// Removing a file or folder, or making a folder.
    Changing(Exchange),
    Reading(Box<FileReading>),
    Writing(Box<FileWriting>),
    /// The task is over; its session is closed.
    Closing(Exchange),
}

/// The effect of an answer on the task.
pub(super) enum FtpNews {
    Nothing,
    /// The task continues; the event reports its progress.
    Progress(FtpEvent),
    /// The task is done or has failed; a session that it may have opened still has to be closed.
    End(FtpEvent),
    /// The task is over, and no session is left to close.
    Closed(Option<FtpEvent>),
}

/// The work that is due: requests to send, or the end of the task.
pub(super) enum FtpDue {
    Requests(Vec<FtpRequest>),
    /// The task is done or has failed.
    End(FtpEvent),
    /// The session could not be closed.
    GivenUp,
}

impl FtpWork {
    pub fn new(task: FtpTask, session: u8, sequence: &mut FtpSequence) -> Self {
        match task {
            FtpTask::List { folder } => Self::Listing {
                exchange: Exchange::new(
                    FtpRequest::about(&folder, FtpOpcode::List, session, sequence),
                    PATIENCE,
                ),
                folder,
                listing: FolderListing::default(),
            },
            FtpTask::Checksum { path, size } => {
                let request = FtpRequest::about(&path, FtpOpcode::Checksum, session, sequence);
                let reading = Duration::from_secs(u64::from(size / SLOWEST_CHECKSUM));
                Self::Checking(Exchange::new(request, PATIENCE + reading))
            }
            FtpTask::Remove { path } => {
                let opcode = if path.ends_with('/') {
                    FtpOpcode::RemoveFolder
                } else {
                    FtpOpcode::RemoveFile
                };
                let path = path.trim_end_matches('/');
                let request = FtpRequest::about(path, opcode, session, sequence);
                Self::Changing(Exchange::new(request, PATIENCE))
            }
            FtpTask::MakeFolder { path } => {
                let path = path.trim_end_matches('/');
                let request = FtpRequest::about(path, FtpOpcode::MakeFolder, session, sequence);
                Self::Changing(Exchange::new(request, PATIENCE))
            }
            FtpTask::Read { path, gaps } => {
                let reading = FileReading::new(path, session, gaps, sequence);
                Self::Reading(Box::new(reading))
            }
            FtpTask::Write { path, bytes } => {
                let writing = FileWriting::new(path, session, bytes, sequence);
                Self::Writing(Box::new(writing))
            }
        }
    }

    pub fn receive(
        &mut self,
        answer: &FtpAnswer,
        sequence: &mut FtpSequence,
        now: Duration,
    ) -> FtpNews {
        match self {
            Self::Listing {
                folder,
                listing,
                exchange,
            } if exchange.is_answered_by(answer) => match listing.receive(answer) {
                Listed::More(offset) => {
                    let session = exchange.request().session;
                    let request = FtpRequest::about(folder, FtpOpcode::List, session, sequence);
                    *exchange = Exchange::new(FtpRequest { offset, ..request }, PATIENCE);
                    FtpNews::Nothing
                }
                Listed::All(entries) => FtpNews::End(FtpEvent::Listed(entries)),
                Listed::Fault(fault) => FtpNews::End(FtpEvent::Failed(fault)),
            },
            Self::Checking(exchange) if exchange.is_answered_by(answer) => {
                FtpNews::End(checksum_of(answer))
            }
            Self::Changing(exchange) if exchange.is_answered_by(answer) => {
                FtpNews::End(match &answer.result {
                    Ok(_) => FtpEvent::Done,
                    Err(nak) => FtpEvent::Failed(FtpFault::Refused(*nak)),
                })
            }
            Self::Reading(reading) => match reading.receive(answer, sequence, now) {
                FileNews::Opened(size) => FtpNews::Progress(FtpEvent::Opened(size)),
                FileNews::Nothing => FtpNews::Nothing,
                FileNews::Bytes(bytes) => FtpNews::Progress(FtpEvent::Bytes(bytes)),
                FileNews::Fault(fault) => FtpNews::End(FtpEvent::Failed(fault)),
            },
            Self::Writing(writing) => match writing.receive(answer, sequence, now) {
                WritingNews::Nothing => FtpNews::Nothing,
                WritingNews::Wrote(bytes) => FtpNews::Progress(FtpEvent::Wrote(bytes)),
                WritingNews::Written => FtpNews::Closed(Some(FtpEvent::Written)),
                WritingNews::Fault(fault) => FtpNews::End(FtpEvent::Failed(fault)),
            },
            Self::Closing(exchange) if exchange.is_answered_by(answer) => FtpNews::Closed(None),
            Self::Listing { .. } | Self::Checking(_) | Self::Changing(_) | Self::Closing(_) => {
                FtpNews::Nothing
            }
        }
    }

    pub fn poll(
        &mut self,
        sequence: &mut FtpSequence,
        round_trip: Duration,
        now: Duration,
    ) -> FtpDue {
        let due = match self {
            Self::Listing { exchange, .. }
            | Self::Checking(exchange)
            | Self::Changing(exchange) => {
                let request = exchange.poll(round_trip, now);
                request.map(|it| it.cloned().into_iter().collect())
            }
            Self::Closing(exchange) => match exchange.poll(round_trip, now) {
                Ok(request) => Ok(request.cloned().into_iter().collect()),
                Err(_) => return FtpDue::GivenUp,
            },
            Self::Reading(reading) => match reading.complete() {
                Some(size) => return FtpDue::End(FtpEvent::Complete(size)),
                None => reading.poll(sequence, round_trip, now),
            },
            Self::Writing(writing) => {
                let request = writing.poll(sequence, round_trip, now);
                request.map(|it| it.into_iter().collect())
            }
        };
        match due {
            Ok(requests) => FtpDue::Requests(requests),
            Err(fault) => FtpDue::End(FtpEvent::Failed(fault)),
        }
    }
}

fn checksum_of(answer: &FtpAnswer) -> FtpEvent {
    match &answer.result {
        Ok(data) => match data.first_chunk().copied() {
            Some(sum) => FtpEvent::Checksum(u32::from_le_bytes(sum)),
            None => FtpEvent::Failed(FtpFault::Malformed),
        },
        Err(nak) => FtpEvent::Failed(FtpFault::Refused(*nak)),
    }
}
