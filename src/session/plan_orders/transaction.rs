//! The transfer of one list, after which the vehicle holds either the new list or the old one.
//!
//! The vehicle's list is read and kept; the new one is written, read back and compared. If it differs, it is written
//! again; if that fails, the old list is restored. Answers to a write may be lost, so its result is always determined
//! by reading the list back. While the link is down, the transaction waits.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMissionResult;

use super::list::document_of;
use super::reading::{Read, Reading};
use super::sending::{Sending, Sent};
use super::{Desk, PlanShelf, compare, packed};
use crate::plan::{ContentHash, Document, Item, ListKind};
use crate::session::ftp::{FtpClient, FtpEvent, FtpFault, FtpTask, FtpTicket};
use crate::session::logs::hands_out_files;
use crate::text;
use crate::text::Text;
use crate::wire::Frame;

/// The maximum number of times that the new list, and then the old one, is written on a link that
/// is up.
const WRITES: u8 = 3;
const RESTORES: u8 = 5;

/// A transfer in progress.
#[derive(Debug, Clone)]
pub(super) struct Transaction {
    kind: ListKind,
    /// The list that the vehicle is to hold; `None` if it is only read.
    new: Option<Vec<Item>>,
    /// The list that the user knows to be on board; `None` if it has not been read yet.
    known: Option<Vec<Item>>,
    old: Vec<Item>,
    by_file: bool,
    restores: bool,
    is_stored: bool,
    /// The number of attempts to write the current list.
    writes: u8,
    /// Why the vehicle does not accept the new list.
    reason: Option<Text>,
    phase: Phase,
}

#[derive(Debug, Clone)]
enum Phase {
    /// The list on board is read and kept.
    Keeping(Reading),
    Writing(Writing),
    /// The list is read back.
    Checking(Reading),
}

#[derive(Debug, Clone)]
enum Writing {
    Items(Box<Sending>),
    File {
        ticket: FtpTicket,
        /// The number of bytes written, and the size of the file.
        written: u32,
        size: usize,
        ended: Option<Result<(), FtpFault>>,
    },
}

/// The result of a transfer, with the list that the vehicle holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    Read(Vec<Item>),
    Written(Vec<Item>),
    /// The vehicle already held the list.
    Same(Vec<Item>),
    /// The vehicle's list has changed since it was read; nothing was written.
    Changed(Vec<Item>),
    /// The vehicle carries a list that has not been read before; nothing was written.
    Unfamiliar(Vec<Item>),
    /// The vehicle refused the list and holds the old one.
    Kept(Vec<Item>, Text),
    /// The old list had to be restored.
    Restored(Vec<Item>, Text),
    /// The vehicle has no such list.
    Unsupported,
    /// The vehicle was silent; nothing was written.
    Unread,
    /// The vehicle holds neither the new list nor the old one.
    Neither(Vec<Item>),
    /// The vehicle was silent after something was written.
    Unknown,
}

impl Transaction {
    pub fn new(kind: ListKind, new: Option<Vec<Item>>, desk: &Desk<'_>) -> Self {
        let by_file = hands_out_files(desk.vehicle);
        Self {
            kind,
            new,
            known: desk.plans.acknowledged(kind).map(<[Item]>::to_vec),
            old: Vec::new(),
            by_file,
            restores: false,
            is_stored: false,
            writes: 0,
            reason: None,
            phase: Phase::Keeping(Reading::new(kind, by_file, desk.now)),
        }
    }

    /// Whether the old list is being restored.
    pub fn is_restoring(&self) -> bool {
        self.restores
    }

    /// Whether the old list was stored by this transfer, outside this program.
    pub fn is_stored(&self) -> bool {
        self.is_stored
    }

    /// Its progress in percent.
    pub fn percent(&self) -> u8 {
        let (from, weight, share) = match &self.phase {
            Phase::Keeping(reading) if self.new.is_none() => (0.0, 99.0, reading.share()),
            Phase::Keeping(reading) => (0.0, 15.0, reading.share()),
            Phase::Writing(Writing::Items(sending)) => (15.0, 55.0, sending.share()),
            Phase::Writing(Writing::File { written, size, .. }) => {
                (15.0, 55.0, *written as f32 / (*size).max(1) as f32)
            }
            Phase::Checking(reading) => (70.0, 29.0, reading.share()),
        };
        (from + weight * share) as u8
    }

    /// Reads the list on board again, because the link was down or the vehicle has rebooted.
    pub fn begin_anew(&mut self, ftp: &mut FtpClient, now: Duration) {
        match &mut self.phase {
            Phase::Keeping(reading) | Phase::Checking(reading) => reading.begin_anew(ftp, now),
            Phase::Writing(writing) => {
                if let Writing::File { ticket, .. } = writing {
                    ftp.cancel(*ticket);
                }
                // A write that was interrupted does not count.
                self.writes = self.writes.saturating_sub(1);
                self.phase = Phase::Checking(Reading::new(self.kind, self.by_file, now));
            }
        }
    }

    pub fn receive(&mut self, frame: &Frame, desk: &mut Desk<'_>) {
        match &mut self.phase {
            Phase::Keeping(reading) | Phase::Checking(reading) => {
                let mut messages = Vec::new();
                reading.receive(frame, desk.vehicle.station, desk.now, &mut messages);
                desk.output.send(messages);
            }
            Phase::Writing(Writing::Items(sending)) => {
                sending.receive(frame, desk.vehicle, desk.now, &mut desk.output.messages);
            }
            Phase::Writing(Writing::File { .. }) => {}
        }
    }

    pub fn hear_file(&mut self, heard: FtpTicket, event: &FtpEvent, now: Duration) {
        match &mut self.phase {
            Phase::Keeping(reading) | Phase::Checking(reading) => {
                reading.hear_file(heard, event, now);
            }
            Phase::Writing(Writing::File {
                ticket,
                written,
                ended,
                ..
            }) if *ticket == heard => match event {
                FtpEvent::Wrote(bytes) => *written = *bytes,
                FtpEvent::Written => *ended = Some(Ok(())),
                FtpEvent::Failed(fault) => *ended = Some(Err(*fault)),
                FtpEvent::Listed(_)
                | FtpEvent::Opened(_)
                | FtpEvent::Done
                | FtpEvent::Bytes(_)
                | FtpEvent::Complete(_)
                | FtpEvent::Checksum(_) => {}
            },
            Phase::Writing(_) => {}
        }
    }

    /// Takes the steps that are due; returns the result at the end.
    pub fn poll(&mut self, shelf: Option<&dyn PlanShelf>, desk: &mut Desk<'_>) -> Option<Outcome> {
        if desk.vehicle.link.lost {
            if let Phase::Keeping(reading) = &self.phase {
                reading.leave(desk.ftp);
                return Some(Outcome::Unread);
            }
            self.begin_anew(desk.ftp, desk.now);
            return None;
        }
        match &mut self.phase {
            Phase::Keeping(reading) => {
                let read = reading.poll(desk)?;
                self.kept(read, shelf, desk)
            }
            Phase::Writing(writing) => {
                let sent = writing.poll(desk)?;
                self.sent(sent, desk.now);
                None
            }
            Phase::Checking(reading) => {
                let read = reading.poll(desk)?;
                self.checked(read, desk)
            }
        }
    }

    fn kept(
        &mut self,
        read: Read,
        shelf: Option<&dyn PlanShelf>,
        desk: &mut Desk<'_>,
    ) -> Option<Outcome> {
        let items = match read {
            Read::Items(items) => items,
            Read::Unsupported | Read::Silent if self.by_file => {
                // The vehicle may still answer requests for items.
                self.by_file = false;
                self.phase = Phase::Keeping(Reading::new(self.kind, false, desk.now));
                return None;
            }
            Read::Unsupported => return Some(Outcome::Unsupported),
            Read::Silent => return Some(Outcome::Unread),
        };
        let Some(new) = &self.new else {
            return Some(Outcome::Read(items));
        };
        let known = self.known.as_deref();
        if known.is_some_and(|known| !compare::is_same(self.kind, known, &items)) {
            return Some(Outcome::Changed(items));
        }
        if compare::is_identical(self.kind, new, &items) {
            return Some(Outcome::Same(items));
        }
        let is_empty = compare::own(self.kind, &items).is_empty();
        if known.is_none() && !is_empty && !self.is_kept(&items, shelf, desk) {
            return Some(Outcome::Unfamiliar(items));
        }
        self.old = items;
        self.is_stored = shelf.is_some_and(|shelf| {
            let document = document_of(self.kind, &self.old);
            shelf.keep(desk.vehicle.id, self.kind, &document)
        });
        self.write(desk);
        None
    }

    /// Whether a list is the one that an earlier transfer has kept.
    fn is_kept(&self, items: &[Item], shelf: Option<&dyn PlanShelf>, desk: &Desk<'_>) -> bool {
        let Some(shelf) = shelf else {
            return false;
        };
        let mut kept = shelf.kept(desk.vehicle.id).into_iter();
        let file = kept.find(|(kind, _)| *kind == self.kind);
        let content = file.and_then(|(_, file)| shelf.read(&file).ok());
        let is_same = |kept: &Document| {
            let own = compare::own(self.kind, items);
            ContentHash::of(kept.list(self.kind)) == ContentHash::of(own)
        };
        content.is_some_and(|content| is_same(&content.document))
    }

    fn write(&mut self, desk: &mut Desk<'_>) {
        let new = self.new.as_deref().unwrap_or_default();
        let items = if self.restores { &self.old } else { new };
        self.writes += 1;
        // Not every vehicle accepts an empty file as a list.
        self.phase = Phase::Writing(if self.by_file && !items.is_empty() {
            let bytes = packed::pack(self.kind, items, desk.vehicle.address());
            let size = bytes.len();
            let path = packed::path(self.kind).to_owned();
            let ticket = desk.ftp.ask(FtpTask::Write { path, bytes });
            Writing::File {
                ticket,
                written: 0,
                size,
                ended: None,
            }
        } else {
            Writing::Items(Box::new(Sending::new(self.kind, items.to_vec())))
        });
    }

    /// Reads the list back after a write.
    fn sent(&mut self, sent: Sent, now: Duration) {
        if let (Sent::Refused(result, number), false) = (sent, self.restores) {
            self.reason = Some(self.refusal(result, number));
        }
        self.phase = Phase::Checking(Reading::new(self.kind, self.by_file, now));
    }

    fn refusal(&self, result: MavMissionResult, number: usize) -> Text {
        let new = self.new.as_deref().unwrap_or_default();
        match new.get(number) {
            Some(item) => {
                let reason = compare::explained(result, item);
                text!("refused-plan-item", item = number, reason = reason)
            }
            None => text!("plan-result-error"),
        }
    }

    fn checked(&mut self, read: Read, desk: &mut Desk<'_>) -> Option<Outcome> {
        let Read::Items(held) = read else {
            return Some(Outcome::Unknown);
        };
        let new = self.new.as_deref().unwrap_or_default();
        if !self.restores && compare::is_held(self.kind, new, &held) {
            return Some(Outcome::Written(held));
        }
        let is_old = compare::is_same(self.kind, &self.old, &held);
        if !self.restores {
            if self.reason.is_none() && self.writes < WRITES {
                // Refusals of items are explained; files are refused without a reason. The file that was just read
                // shows that no other one is open.
                self.by_file &= self.writes == 0;
                self.write(desk);
                return None;
            }
            let reason = self.reason.get_or_insert_with(|| text!("plan-differs"));
            if is_old {
                return Some(Outcome::Kept(held, reason.clone()));
            }
            self.restores = true;
            self.writes = 0;
            self.write(desk);
            return None;
        }
        if is_old {
            let reason = self.reason.take().unwrap_or_default();
            return Some(Outcome::Restored(held, reason));
        }
        if self.writes == RESTORES {
            return Some(Outcome::Neither(held));
        }
        self.write(desk);
        None
    }
}

impl Writing {
    fn poll(&mut self, desk: &mut Desk<'_>) -> Option<Sent> {
        match self {
            Self::Items(sending) => sending.poll(desk.vehicle, desk.now, &mut desk.output.messages),
            Self::File { ended, .. } => ended.map(|ended| match ended {
                Ok(()) => Sent::Accepted,
                Err(_) => Sent::Silent,
            }),
        }
    }
}
