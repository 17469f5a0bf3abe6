//! Reading a list for an order: as a file of the vehicle, or item by item.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::{Desk, packed};
use crate::plan::{Item, ListKind};
use crate::session::ftp::{FtpClient, FtpEvent, FtpFault, FtpTask, FtpTicket};
use crate::session::plans::download::{Download, Step};
use crate::session::plans::wire;
use crate::vehicle::Transfer;
use crate::wire::{Frame, SystemId};

/// The pause before a list is requested again: the vehicle may still be waiting for items of an upload.
const REST: Duration = Duration::from_secs(2);
/// The number of attempts on a link that is up.
const TRIES: u8 = 12;

/// A list that is being read from the vehicle.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    kind: ListKind,
    /// Whether it is read as a file. A file that was being written is closed before another one is
    /// opened; after an upload by file, only such a reading shows that no write is still to take
    /// effect.
    by_file: bool,
    way: Way,
    tries: u8,
}

#[derive(Debug, Clone)]
enum Way {
    /// Waits until this time, then begins.
    Resting(Duration),
    File(FtpTicket, Vec<u8>),
    Items(Box<Download>),
    Done(Vec<Item>),
    /// The vehicle has no such list, or does not offer it as a file.
    Unsupported,
}

/// The result of a reading.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Read {
    Items(Vec<Item>),
    Unsupported,
    Silent,
}

impl Reading {
    pub fn new(kind: ListKind, by_file: bool, now: Duration) -> Self {
        Self {
            kind,
            by_file,
            way: Way::Resting(now),
            tries: 0,
        }
    }

    /// Starts again after the link was lost.
    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        self.leave(ftp);
        *self = Self::new(self.kind, self.by_file, now);
    }

    pub fn leave(&self, ftp: &mut FtpClient) {
        if let Way::File(ticket, _) = &self.way {
            ftp.cancel(*ticket);
        }
    }

    /// How much has been read, from 0 to 1.
    pub fn share(&self) -> f32 {
        match &self.way {
            Way::Items(download) => match download.transfer() {
                Transfer::Coming {
                    received,
                    total: Some(total),
                } => f32::from(received) / f32::from(total.max(1)),
                Transfer::Coming { .. }
                | Transfer::Unasked
                | Transfer::Done
                | Transfer::Unsupported
                | Transfer::Failed => 0.0,
            },
            Way::Done(_) => 1.0,
            Way::Resting(_) | Way::File(..) | Way::Unsupported => 0.0,
        }
    }

    /// Takes the steps that are due; returns the result at the end.
    pub fn poll(&mut self, desk: &mut Desk<'_>) -> Option<Read> {
        let now = desk.now;
        if let Way::Resting(until) = self.way {
            if now < until {
                return None;
            }
            if self.tries == TRIES {
                return Some(Read::Silent);
            }
            self.tries += 1;
            self.way = self.begin(desk);
        }
        if let Way::Items(download) = &mut self.way {
            let round_trip = desk.vehicle.link.round_trip.unwrap_or_default();
            let mut messages = Vec::new();
            let step = download.poll(round_trip, now, &mut messages);
            desk.output.send(messages);
            self.stepped(step, now);
        }
        match &mut self.way {
            Way::Done(items) => Some(Read::Items(std::mem::take(items))),
            Way::Unsupported => Some(Read::Unsupported),
            Way::Resting(_) | Way::File(..) | Way::Items(_) => None,
        }
    }

    fn begin(&self, desk: &mut Desk<'_>) -> Way {
        if self.by_file {
            let path = packed::path(self.kind).to_owned();
            let ticket = desk.ftp.ask(FtpTask::Read { path, gaps: None });
            return Way::File(ticket, Vec::new());
        }
        Way::Items(Box::new(Download::new(
            self.kind,
            desk.vehicle.address(),
            Some(true),
        )))
    }

    fn stepped(&mut self, step: Step, now: Duration) {
        match step {
            Step::Going => {}
            Step::Done(items) => self.way = Way::Done(items),
            Step::Unsupported => self.way = Way::Unsupported,
            Step::Failed => self.way = Way::Resting(now + REST),
        }
    }

    /// Handles a message of the vehicle.
    pub fn receive(
        &mut self,
        frame: &Frame,
        station: SystemId,
        now: Duration,
        out: &mut Vec<MavMessage>,
    ) {
        if let (Way::Items(download), Some((kind, answer))) =
            (&mut self.way, wire::answer(frame, station))
            && kind == self.kind
        {
            let step = download.receive(answer, now, out);
            self.stepped(step, now);
        }
    }

    /// Handles an event of the file client.
    pub fn hear_file(&mut self, ticket: FtpTicket, event: &FtpEvent, now: Duration) {
        let Way::File(own, file) = &mut self.way else {
            return;
        };
        if *own != ticket {
            return;
        }
        match event {
            FtpEvent::Bytes(bytes) => {
                let range = bytes.range();
                let (start, end) = (range.start as usize, range.end as usize);
                if file.len() < end {
                    file.resize(end, 0);
                }
                file[start..end].copy_from_slice(&bytes.bytes);
            }
            FtpEvent::Complete(size) => {
                file.truncate(*size as usize);
                self.way = match packed::unpack(self.kind, file) {
                    Some(items) => Way::Done(items),
                    None => Way::Resting(now + REST),
                };
            }
            FtpEvent::Failed(FtpFault::Refused(nak)) if nak.is_of_missing_file() => {
                self.way = Way::Unsupported;
            }
            FtpEvent::Failed(_) => self.way = Way::Resting(now + REST),
            FtpEvent::Listed(_)
            | FtpEvent::Opened(_)
            | FtpEvent::Done
            | FtpEvent::Checksum(_)
            | FtpEvent::Wrote(_)
            | FtpEvent::Written => {}
        }
    }
}
