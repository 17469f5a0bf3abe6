//! The files of a vehicle, by `MAVLink` FTP: one client per vehicle, without input and output of
//! its own.
//!
//! The caller queues an [`FtpTask`], keeps the [`FtpTicket`], and receives [`FtpEvent`]s with that
//! ticket from [`FtpClient::step`]. Tasks are carried out one after the other: `ArduPilot` has one
//! session for all clients.
//!
//! Servers differ: `ArduPilot` takes the client's session number, PX4 assigns its own. A burst ends
//! after 500 packets, at the end of the file, or without notice. The client handles packets that
//! are lost, duplicated or out of order. Source: <https://mavlink.io/en/services/ftp.html> and
//! `GCS_FTP.cpp` of `ArduPilot`.
//!
//! # How the parts fit
//! - The client: `work` handles the answers of a task and sends what is due; `exchange` is one
//!   request and its answer; `flow` reads a file, in bursts or piece by piece; `file`, `listing`
//!   and `writing` open, list and write; `fault` says what went wrong. `packet` is the payload.
//! - For tests: `server`.

use std::collections::VecDeque;
use std::time::Duration;

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
mod work;
mod writing;

pub use fault::{FtpFault, FtpNak};
pub use listing::FtpEntry;
pub use packet::FtpPayload;

use exchange::Exchange;
use packet::{FtpAnswer, FtpOpcode, FtpRequest, FtpSequence, MOST_DATA};
use work::{FtpDue, FtpNews, FtpWork};

use super::gaps::{FileBytes, GapMap};
use crate::hash::fnv1a;

/// How long a request may stay unanswered, or a file bring nothing new, before it is abandoned.
const PATIENCE: Duration = Duration::from_secs(10);
/// The wait before another attempt on a busy server: `ArduPilot` ends a session that was idle for 3
/// s if another client needs one; each refusal counts as activity.
const UNTIL_IDLE: Duration = Duration::from_millis(3500);
/// After this many refusals, the server counts as busy for a long time.
const MOST_REFUSALS: u8 = 4;
/// How long to try to close a session; after that, it is left to the server's own time limit.
const CLOSING: Duration = Duration::from_secs(3);
/// The maximum length of a path in bytes: `ArduPilot` needs the last byte of a packet for itself.
const LONGEST_PATH: usize = MOST_DATA - 1;
/// Sessions are numbered from 1 to this.
const MOST_SESSIONS: u64 = 250;

/// A request about a vehicle's files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FtpTask {
    /// The entries of a folder.
    List {
        folder: String,
    },
    /// A file, or its missing parts. With gaps, it must have the size of the gap map; without, the vehicle determines
    /// its end.
    Read {
        path: String,
        gaps: Option<GapMap>,
    },
    /// The checksum of a file of this size in bytes ([`FtpChecksum`](crate::wire::FtpChecksum)).
    Checksum {
        path: String,
        size: u32,
    },
    /// Removes a file, or an empty folder if the path ends with `/`.
    Remove {
        path: String,
    },
    MakeFolder {
        path: String,
    },
    /// A file to replace. The new content takes effect when the file is closed, after the last
    /// byte.
    Write {
        path: String,
        bytes: Vec<u8>,
    },
}

/// The progress or the result of a task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FtpEvent {
    /// The entries of the folder; the task is done.
    Listed(Vec<FtpEntry>),
    /// A file to read has been opened; its size in bytes as the vehicle reports it.
    Opened(u32),
    /// Bytes of the file that were missing, in any order.
    Bytes(FileBytes),
    /// All bytes of a file of this size have arrived: the task is done.
    Complete(u32),
    /// The checksum: the task is done.
    Checksum(u32),
    /// The number of bytes of the file that have been written.
    Wrote(u32),
    /// The file has been closed: the task is done.
    Written,
    /// A file or folder has been removed, or a folder made: the task is done.
    Done,
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

#[derive(Debug, Clone)]
struct FtpJob {
    ticket: FtpTicket,
    work: FtpWork,
}

impl FtpClient {
    /// Queues a task; it begins with the next step, after all earlier tasks.
    pub fn ask(&mut self, task: FtpTask) -> FtpTicket {
        self.tickets = self.tickets.wrapping_add(1);
        let ticket = FtpTicket(self.tickets);
        self.waiting.push_back((ticket, task));
        ticket
    }

    /// Drops a task and closes a file that it has opened. The task causes no further events.
    pub fn cancel(&mut self, ticket: FtpTicket) {
        self.waiting.retain(|(waiting, _)| *waiting != ticket);
        if let Some(job) = self.job.take_if(|job| job.ticket == ticket) {
            self.close(job);
        }
    }

    /// Drops all tasks: the vehicle has rebooted, and its server has lost the session.
    pub fn forget(&mut self) {
        self.waiting.clear();
        self.job = None;
    }

    /// Whether a task is under way or waiting.
    pub fn is_busy(&self) -> bool {
        self.job.is_some() || !self.waiting.is_empty()
    }

    /// Handles the answer of the vehicle's server, if there is one, and advances time. `round_trip`
    /// is the round-trip time of the link.
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
            let work = FtpWork::new(task, session_at(now), &mut self.sequence);
            self.job = Some(FtpJob { ticket, work });
        }
        true
    }

    fn receive(&mut self, answer: &FtpAnswer, now: Duration, step: &mut FtpStep) {
        let Some(job) = &mut self.job else {
            return;
        };
        match job.work.receive(answer, &mut self.sequence, now) {
            FtpNews::Nothing => {}
            FtpNews::Progress(event) => step.events.push((job.ticket, event)),
            FtpNews::End(event) => self.end_with(event, step),
            FtpNews::Closed(event) => {
                step.events.extend(event.map(|event| (job.ticket, event)));
                self.job = None;
            }
        }
    }

    /// Sends the requests that are due; `false` if the task has ended.
    fn advance(&mut self, round_trip: Duration, now: Duration, step: &mut FtpStep) -> bool {
        let Some(job) = &mut self.job else {
            return false;
        };
        match job.work.poll(&mut self.sequence, round_trip, now) {
            FtpDue::Requests(requests) => {
                step.requests
                    .extend(requests.iter().map(FtpRequest::payload));
                return true;
            }
            FtpDue::End(event) => self.end_with(event, step),
            FtpDue::GivenUp => self.job = None,
        }
        false
    }

    fn end_with(&mut self, event: FtpEvent, step: &mut FtpStep) {
        if let Some(job) = self.job.take() {
            step.events.push((job.ticket, event));
            self.close(job);
        }
    }

    /// Closes the file of a task that is over, if it may have opened one.
    fn close(&mut self, job: FtpJob) {
        let session = match job.work {
            FtpWork::Listing { .. } | FtpWork::Checking(_) | FtpWork::Changing(_) => return,
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
            Self::Read { path, .. }
            | Self::Checksum { path, .. }
            | Self::Remove { path }
            | Self::MakeFolder { path }
            | Self::Write { path, .. } => path,
        }
    }
}

/// A session number that another console, or a file opened before, is unlikely to have.
fn session_at(now: Duration) -> u8 {
    let hash = fnv1a(&now.as_nanos().to_le_bytes());
    (hash % MOST_SESSIONS) as u8 + 1
}
