//! The files of a vehicle, by `MAVLink` FTP: one client per vehicle, without input and output of its own.
//!
//! A user asks for an [`FtpTask`], keeps the [`FtpTicket`], and receives [`FtpEvent`]s with that ticket from
//! [`FtpClient::step`]. Tasks are carried out one after the other: `ArduPilot` has one session for all clients.
//!
//! Servers differ: `ArduPilot` takes the client's session number, PX4 assigns its own. A burst ends after 500 packets,
//! at the end of the file, or without notice. The client handles packets that are lost, duplicated or out of order.
//! Source: <https://mavlink.io/en/services/ftp.html> and `GCS_FTP.cpp` of `ArduPilot`.

use std::collections::VecDeque;
use std::time::Duration;

mod checksum;
mod exchange;
mod fault;
mod file;
mod flow;
mod listing;
mod packet;
#[cfg(test)]
pub(super) mod server;
#[cfg(test)]
mod tests;
mod writing;

pub use checksum::FtpChecksum;
pub use fault::{FtpFault, FtpNak};
pub use listing::FtpEntry;
pub use packet::FtpPayload;

use exchange::Exchange;
use file::{FileNews, FileReading};
use listing::{FolderListing, Listed};
use packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence, MOST_DATA};
use writing::{FileWriting, WritingNews};

use super::gaps::{FileBytes, GapMap};
use crate::hash::fnv1a;

/// How long a request may stay unanswered before it is abandoned.
const PATIENCE: Duration = Duration::from_secs(10);
/// How long to try to close a session; after that, it is left to the server's own time limit.
const CLOSING: Duration = Duration::from_secs(3);
/// The minimum speed at which a server reads its own file for the checksum, in bytes per second.
const SLOWEST_CHECKSUM: u32 = 200_000;
/// The maximum length of a path in bytes: `ArduPilot` needs the last byte of a packet for itself.
const LONGEST_PATH: usize = MOST_DATA - 1;
/// Sessions are numbered from 1 to this.
const MOST_SESSIONS: u64 = 250;

/// A request about a vehicle's files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FtpTask {
    /// The entries of a folder.
    List { folder: String },
    /// A file, or its missing parts. With gaps, it must have the size of the gap map; without, the vehicle determines
    /// its end.
    Read { path: String, gaps: Option<GapMap> },
    /// The checksum of a file of this size in bytes ([`FtpChecksum`]).
    Checksum { path: String, size: u32 },
    /// Replace a file. It takes effect when it is closed, after the last byte.
    Write { path: String, bytes: Vec<u8> },
}

/// The progress or the result of a task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FtpEvent {
    /// The folder: the task is done.
    Listed(Vec<FtpEntry>),
    /// Bytes of the file that were missing, in any order.
    Bytes(FileBytes),
    /// All bytes of a file of this size have come: the task is done.
    Complete(u32),
    /// The checksum: the task is done.
    Checksum(u32),
    /// So many bytes of the file have been written.
    Wrote(u32),
    /// The file has been closed: the task is done.
    Written,
    /// The task has failed.
    Failed(FtpFault),
}

/// Identifies the task that an event is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FtpTicket(u32);

/// The result of a step.
#[derive(Debug, Clone, Default)]
pub struct FtpStep {
    /// The requests to send, in order.
    pub requests: Vec<FtpPayload>,
    pub events: Vec<(FtpTicket, FtpEvent)>,
}

/// The client for the files of one vehicle.
#[derive(Debug, Clone, Default)]
pub struct FtpClient {
    waiting: VecDeque<(FtpTicket, FtpTask)>,
    job: Option<FtpJob>,
    tickets: u32,
    sequence: FtpSequence,
}

/// The task that is carried out.
#[derive(Debug, Clone)]
struct FtpJob {
    ticket: FtpTicket,
    work: FtpWork,
}

#[derive(Debug, Clone)]
enum FtpWork {
    Listing {
        folder: String,
        listing: FolderListing,
        exchange: Exchange,
    },
    Checking(Exchange),
    Reading(Box<FileReading>),
    Writing(Box<FileWriting>),
    /// The task is over; its session is closed.
    Closing(Exchange),
}

impl FtpClient {
    /// Queues a task; it begins with the next step, after all earlier tasks.
    pub fn ask(&mut self, task: FtpTask) -> FtpTicket {
        self.tickets = self.tickets.wrapping_add(1);
        let ticket = FtpTicket(self.tickets);
        self.waiting.push_back((ticket, task));
        ticket
    }

    /// Drops a task and closes a file that it has opened. The task gives no more events.
    pub fn cancel(&mut self, ticket: FtpTicket) {
        self.waiting.retain(|(waiting, _)| *waiting != ticket);
        if let Some(job) = self.job.take_if(|job| job.ticket == ticket) {
            self.close(job);
        }
    }

    /// Drops everything: the vehicle has rebooted, and its server has lost the session.
    pub fn forget(&mut self) {
        self.waiting.clear();
        self.job = None;
    }

    /// Whether a task is under way or waiting.
    pub fn is_busy(&self) -> bool {
        self.job.is_some() || !self.waiting.is_empty()
    }

    /// Handles what the vehicle's server has sent, if anything, and advances time. `round_trip` is the delay of the
    /// link there and back.
    pub fn step(
        &mut self,
        incoming: Option<&FtpPayload>,
        round_trip: Duration,
        now: Duration,
    ) -> FtpStep {
        let mut step = FtpStep::default();
        if let Some(answer) = incoming.and_then(FtpAnswer::read) {
            self.receive(&answer, now, &mut step);
        }
        // A task that ends makes room for the next one.
        while self.begin(now, &mut step) {
            if self.advance(round_trip, now, &mut step) {
                break;
            }
        }
        step
    }

    /// Begins the next task if none is under way; returns whether one is under way now.
    fn begin(&mut self, now: Duration, step: &mut FtpStep) -> bool {
        while self.job.is_none() {
            let Some((ticket, task)) = self.waiting.pop_front() else {
                return false;
            };
            let path = task.path();
            if path.is_empty() || path.len() > LONGEST_PATH || path.contains('\0') {
                let fault = FtpEvent::Failed(FtpFault::BadPath);
                step.events.push((ticket, fault));
                continue;
            }
            let work = self.work(task, session_at(now));
            self.job = Some(FtpJob { ticket, work });
        }
        true
    }

    fn work(&mut self, task: FtpTask, session: u8) -> FtpWork {
        let sequence = &mut self.sequence;
        match task {
            FtpTask::List { folder } => FtpWork::Listing {
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
                FtpWork::Checking(Exchange::new(request, PATIENCE + reading))
            }
            FtpTask::Read { path, gaps } => {
                let reading = FileReading::new(path, session, gaps, sequence);
                FtpWork::Reading(Box::new(reading))
            }
            FtpTask::Write { path, bytes } => {
                let writing = FileWriting::new(path, session, bytes, sequence);
                FtpWork::Writing(Box::new(writing))
            }
        }
    }

    fn receive(&mut self, answer: &FtpAnswer, now: Duration, step: &mut FtpStep) {
        let Some(job) = &mut self.job else {
            return;
        };
        let ticket = job.ticket;
        let ending = match &mut job.work {
            FtpWork::Listing {
                folder,
                listing,
                exchange,
            } if exchange.is_answered_by(answer) => match listing.receive(answer) {
                Listed::More(offset) => {
                    let session = exchange.request().session;
                    let request =
                        FtpRequest::about(folder, FtpOpcode::List, session, &mut self.sequence);
                    *exchange = Exchange::new(FtpRequest { offset, ..request }, PATIENCE);
                    None
                }
                Listed::All(entries) => Some(FtpEvent::Listed(entries)),
                Listed::Fault(fault) => Some(FtpEvent::Failed(fault)),
            },
            FtpWork::Checking(exchange) if exchange.is_answered_by(answer) => {
                Some(checksum_of(answer))
            }
            FtpWork::Reading(reading) => match reading.receive(answer, &mut self.sequence, now) {
                FileNews::Nothing => None,
                FileNews::Bytes(bytes) => {
                    step.events.push((ticket, FtpEvent::Bytes(bytes)));
                    None
                }
                FileNews::Fault(fault) => Some(FtpEvent::Failed(fault)),
            },
            FtpWork::Writing(writing) => match writing.receive(answer, &mut self.sequence, now) {
                WritingNews::Nothing => None,
                WritingNews::Wrote(bytes) => {
                    step.events.push((ticket, FtpEvent::Wrote(bytes)));
                    None
                }
                WritingNews::Written => {
                    step.events.push((ticket, FtpEvent::Written));
                    self.job = None;
                    return;
                }
                WritingNews::Fault(fault) => Some(FtpEvent::Failed(fault)),
            },
            FtpWork::Closing(exchange) if exchange.is_answered_by(answer) => {
                self.job = None;
                return;
            }
            FtpWork::Listing { .. } | FtpWork::Checking(_) | FtpWork::Closing(_) => None,
        };
        self.end_with(ending, step);
    }

    /// Sends the requests that are due; `false` if the task has ended.
    fn advance(&mut self, round_trip: Duration, now: Duration, step: &mut FtpStep) -> bool {
        let Some(job) = &mut self.job else {
            return false;
        };
        let due = match &mut job.work {
            FtpWork::Listing { exchange, .. } | FtpWork::Checking(exchange) => {
                let request = exchange.poll(round_trip, now);
                request.map(|it| it.cloned().into_iter().collect())
            }
            FtpWork::Closing(exchange) => {
                let Ok(request) = exchange.poll(round_trip, now) else {
                    self.job = None;
                    return false;
                };
                Ok(request.cloned().into_iter().collect())
            }
            FtpWork::Reading(reading) => {
                if let Some(size) = reading.complete() {
                    self.end_with(Some(FtpEvent::Complete(size)), step);
                    return false;
                }
                reading.poll(&mut self.sequence, round_trip, now)
            }
            FtpWork::Writing(writing) => {
                let request = writing.poll(&mut self.sequence, round_trip, now);
                request.map(|it| it.into_iter().collect())
            }
        };
        match due {
            Ok(requests) => {
                let requests: Vec<FtpRequest> = requests;
                step.requests
                    .extend(requests.iter().map(FtpRequest::payload));
                true
            }
            Err(fault) => {
                self.end_with(Some(FtpEvent::Failed(fault)), step);
                false
            }
        }
    }

    fn end_with(&mut self, ending: Option<FtpEvent>, step: &mut FtpStep) {
        if let Some(event) = ending
            && let Some(job) = self.job.take()
        {
            step.events.push((job.ticket, event));
            self.close(job);
        }
    }

    /// Closes the file of a task that is over, if it may have opened one.
    fn close(&mut self, job: FtpJob) {
        let session = match job.work {
            FtpWork::Listing { .. } | FtpWork::Checking(_) => return,
            FtpWork::Reading(reading) => reading.session(),
            FtpWork::Writing(writing) => writing.session(),
            FtpWork::Closing(exchange) => {
                self.job = Some(FtpJob {
                    work: FtpWork::Closing(exchange),
                    ..job
                });
                return;
            }
        };
        let request = FtpRequest {
            sequence: self.sequence.next(),
            session,
            opcode: FtpOpcode::Terminate,
            offset: 0,
            size: 0,
            data: Vec::new(),
        };
        self.job = Some(FtpJob {
            ticket: job.ticket,
            work: FtpWork::Closing(Exchange::new(request, CLOSING)),
        });
    }
}

impl FtpTask {
    fn path(&self) -> &str {
        match self {
            Self::List { folder } => folder,
            Self::Read { path, .. } | Self::Checksum { path, .. } | Self::Write { path, .. } => {
                path
            }
        }
    }
}

/// A session number that another console, or a file opened before, is unlikely to have.
fn session_at(now: Duration) -> u8 {
    let hash = fnv1a(&now.as_nanos().to_le_bytes());
    (hash % MOST_SESSIONS) as u8 + 1
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
