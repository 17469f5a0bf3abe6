//! How a desk takes in the records of its seats.

use std::collections::BTreeMap;

use super::protocol::DeskMessage;
use super::{
    ConnectionId, Piece, PieceRequest, RecordName, RecordPart, Submission, SubmissionEnd,
    SubmissionRefusal,
};

/// The maximum size of all records of one trainee at the desk, in bytes.
pub const TRAINEE_SHARE: u64 = 1024 * 1024 * 1024;

/// Where a desk keeps records, by trainee.
pub trait RecordShelf {
    /// The submission of a record that is complete.
    ///
    /// # Errors
    /// The records cannot be read.
    fn kept(&self, user: &str, record: &RecordName) -> Result<Option<Submission>, ShelfFault>;

    /// The size of all that is kept of a trainee, whether complete or not, in bytes.
    ///
    /// # Errors
    /// The records cannot be read.
    fn used(&self, user: &str) -> Result<u64, ShelfFault>;

    /// What there is of a file.
    ///
    /// # Errors
    /// The file cannot be read.
    fn held(&self, user: &str, record: &RecordName, part: RecordPart) -> Result<Held, ShelfFault>;

    /// Adds bytes to a file that is not whole.
    ///
    /// # Errors
    /// The disk is full or not available; what was there before stays.
    fn append(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        bytes: &[u8],
    ) -> Result<(), ShelfFault>;

    /// Compares the hash of a file that has all its bytes. With this one, the file is whole from now on; otherwise it
    /// is removed.
    ///
    /// # Errors
    /// The file cannot be read or renamed.
    fn check(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        sha256: &str,
    ) -> Result<bool, ShelfFault>;

    /// Marks a record as complete: all its files are whole.
    ///
    /// # Errors
    /// The mark cannot be written.
    fn complete(&mut self, user: &str, submission: &Submission) -> Result<(), ShelfFault>;
}

/// What a desk has of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// This many bytes from its beginning.
    Bytes(u64),
    /// All of it, with a hash that was compared when its last byte came.
    Whole,
}

/// Why records cannot be kept, in the words of the system.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShelfFault(pub String);

/// What follows from a line about a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Receipt {
    /// What to tell the seat.
    pub answer: DeskMessage,
    /// What happened, if the instructor has to know it.
    pub news: Option<ReceiptNews>,
}

/// What the instructor has to know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReceiptNews {
    /// A record is complete now.
    Kept(RecordName),
    /// A record was refused, with the words of the system, if there are some.
    Refused(RecordName, SubmissionRefusal, Option<String>),
}

/// The records that seats are handing in, one per connection.
#[derive(Debug)]
pub struct Reception<S> {
    shelf: S,
    open: BTreeMap<ConnectionId, Submission>,
}

impl<S: RecordShelf> Reception<S> {
    /// A desk that keeps records on this shelf.
    pub fn new(shelf: S) -> Self {
        Self {
            shelf,
            open: BTreeMap::new(),
        }
    }

    /// Where the records are.
    pub fn shelf(&self) -> &S {
        &self.shelf
    }

    /// A seat of this user hands in a record.
    pub fn begin(
        &mut self,
        connection: ConnectionId,
        user: &str,
        submission: &Submission,
    ) -> Receipt {
        match self.admit(user, submission) {
            Ok(true) => settled(&submission.record, SubmissionEnd::Kept),
            Ok(false) => {
                self.open.insert(connection, submission.clone());
                self.go_on(connection, user, submission)
            }
            Err(refusal) => refused(&submission.record, refusal),
        }
    }

    /// A piece has come. One that was not asked for, or came before, is ignored.
    pub fn take(&mut self, connection: ConnectionId, user: &str, piece: &Piece) -> Option<Receipt> {
        let submission = self.open.get(&connection)?.clone();
        let PieceRequest { record, part, from } = &piece.of;
        if *record != submission.record {
            return None;
        }
        let room = submission.part(*part)?.bytes.saturating_sub(*from);
        let bytes = &piece.data.0[..piece.data.0.len().min(room as usize)];
        let added = match self.shelf.held(user, record, *part) {
            Ok(Held::Bytes(held)) if held == *from => self.shelf.append(user, record, *part, bytes),
            Ok(_) => return None,
            Err(fault) => Err(fault),
        };
        Some(match added {
            Ok(()) => self.go_on(connection, user, &submission),
            Err(fault) => self.give_up(connection, record, fault.into()),
        })
    }

    /// A connection has ended. What has come stays.
    pub fn leave(&mut self, connection: ConnectionId) {
        self.open.remove(&connection);
    }

    /// Whether the record is complete already; otherwise what there is of it fits to the submission.
    fn admit(&mut self, user: &str, submission: &Submission) -> Result<bool, Unreceived> {
        if !submission.is_possible() {
            return Err(SubmissionRefusal::Impossible.into());
        }
        if let Some(kept) = self.shelf.kept(user, &submission.record)? {
            // The trainee may have flown on: what shows the score must be the same.
            let is_same = kept.part(RecordPart::Run) == submission.part(RecordPart::Run);
            return if is_same {
                Ok(true)
            } else {
                Err(SubmissionRefusal::Different.into())
            };
        }
        if self.shelf.used(user)?.saturating_add(submission.bytes()) > TRAINEE_SHARE {
            return Err(SubmissionRefusal::Share.into());
        }
        for part in &submission.parts {
            let record = &submission.record;
            if self.shelf.held(user, record, part.part)? == Held::Whole {
                self.shelf.check(user, record, part.part, &part.sha256)?;
            }
        }
        Ok(false)
    }

    /// Asks for the next piece, or completes the record.
    fn go_on(&mut self, connection: ConnectionId, user: &str, submission: &Submission) -> Receipt {
        let record = &submission.record;
        match self.next(user, submission) {
            Ok(Some(request)) => Receipt {
                answer: DeskMessage::Fetch(request),
                news: None,
            },
            Ok(None) => {
                self.open.remove(&connection);
                Receipt {
                    news: Some(ReceiptNews::Kept(record.clone())),
                    ..settled(record, SubmissionEnd::Kept)
                }
            }
            Err(unreceived) => self.give_up(connection, record, unreceived),
        }
    }

    fn next(
        &mut self,
        user: &str,
        submission: &Submission,
    ) -> Result<Option<PieceRequest>, Unreceived> {
        let record = &submission.record;
        for part in &submission.parts {
            let from = match self.shelf.held(user, record, part.part)? {
                Held::Whole => continue,
                Held::Bytes(from) => from,
            };
            if from < part.bytes {
                return Ok(Some(PieceRequest {
                    record: record.clone(),
                    part: part.part,
                    from,
                }));
            }
            if !self.shelf.check(user, record, part.part, &part.sha256)? {
                return Err(SubmissionRefusal::Damaged.into());
            }
        }
        self.shelf.complete(user, submission)?;
        Ok(None)
    }

    fn give_up(
        &mut self,
        connection: ConnectionId,
        record: &RecordName,
        unreceived: Unreceived,
    ) -> Receipt {
        self.open.remove(&connection);
        refused(record, unreceived)
    }
}

/// Why a record does not come in.
struct Unreceived {
    refusal: SubmissionRefusal,
    fault: Option<ShelfFault>,
}

impl From<SubmissionRefusal> for Unreceived {
    fn from(refusal: SubmissionRefusal) -> Self {
        Self {
            refusal,
            fault: None,
        }
    }
}

impl From<ShelfFault> for Unreceived {
    fn from(fault: ShelfFault) -> Self {
        Self {
            refusal: SubmissionRefusal::Unwritable,
            fault: Some(fault),
        }
    }
}

fn settled(record: &RecordName, end: SubmissionEnd) -> Receipt {
    Receipt {
        answer: DeskMessage::Settled {
            record: record.clone(),
            end,
        },
        news: None,
    }
}

fn refused(record: &RecordName, Unreceived { refusal, fault }: Unreceived) -> Receipt {
    let words = fault.map(|fault| fault.0);
    Receipt {
        news: Some(ReceiptNews::Refused(record.clone(), refusal, words)),
        ..settled(record, SubmissionEnd::Refused(refusal))
    }
}

#[cfg(test)]
pub(super) mod tests;
