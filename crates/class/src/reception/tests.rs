//! A shelf in memory, and what happens when it is full.

use super::*;
use crate::{PIECE, PieceBytes, SubmittedPart};

/// A desk's records in memory, on a disk that may be small.
#[derive(Debug, Default)]
pub(crate) struct MemoryShelf {
    pub files: BTreeMap<(String, RecordName, RecordPart), (Vec<u8>, bool)>,
    pub complete: BTreeMap<(String, RecordName), Submission>,
    /// The number of bytes after which the disk is full.
    pub room: Option<usize>,
}

/// Stands for a hash.
pub(crate) fn sum(bytes: &[u8]) -> String {
    let sum = bytes.iter().fold(7u64, |sum, byte| {
        sum.wrapping_mul(31).wrapping_add(u64::from(*byte))
    });
    format!("{sum:x}")
}

impl RecordShelf for MemoryShelf {
    fn kept(&self, user: &str, record: &RecordName) -> Result<Option<Submission>, ShelfFault> {
        let key = (user.to_owned(), record.clone());
        Ok(self.complete.get(&key).cloned())
    }

    fn used(&self, user: &str) -> Result<u64, ShelfFault> {
        let own = self.files.iter().filter(|((of, _, _), _)| of == user);
        Ok(own.map(|(_, (bytes, _))| bytes.len() as u64).sum())
    }

    fn held(&self, user: &str, record: &RecordName, part: RecordPart) -> Result<Held, ShelfFault> {
        Ok(
            match self.files.get(&(user.to_owned(), record.clone(), part)) {
                Some((_, true)) => Held::Whole,
                Some((bytes, false)) => Held::Bytes(bytes.len() as u64),
                None => Held::Bytes(0),
            },
        )
    }

    fn append(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        bytes: &[u8],
    ) -> Result<(), ShelfFault> {
        let used: usize = self.files.values().map(|(bytes, _)| bytes.len()).sum();
        if self.room.is_some_and(|room| used + bytes.len() > room) {
            return Err(ShelfFault("no space left".to_owned()));
        }
        let key = (user.to_owned(), record.clone(), part);
        self.files.entry(key).or_default().0.extend(bytes);
        Ok(())
    }

    fn check(
        &mut self,
        user: &str,
        record: &RecordName,
        part: RecordPart,
        sha256: &str,
    ) -> Result<bool, ShelfFault> {
        let key = (user.to_owned(), record.clone(), part);
        let (bytes, is_whole) = self.files.entry(key.clone()).or_default();
        *is_whole = sum(bytes) == sha256;
        let is_whole = *is_whole;
        if !is_whole {
            self.files.remove(&key);
        }
        Ok(is_whole)
    }

    fn complete(&mut self, user: &str, submission: &Submission) -> Result<(), ShelfFault> {
        let key = (user.to_owned(), submission.record.clone());
        self.complete.insert(key, submission.clone());
        Ok(())
    }
}

pub(crate) fn name(name: &str) -> RecordName {
    RecordName::try_from(name.to_owned()).expect("a name")
}

/// A record with one file.
pub(crate) fn submission(content: &[u8]) -> Submission {
    Submission {
        record: name("2026-11-20_00-first-flight"),
        parts: vec![SubmittedPart {
            part: RecordPart::Run,
            bytes: content.len() as u64,
            sha256: sum(content),
        }],
    }
}

/// The piece of a content that was asked for.
pub(crate) fn piece(content: &[u8], request: &PieceRequest) -> Piece {
    let from = request.from as usize;
    let until = (from + PIECE).min(content.len());
    Piece {
        of: request.clone(),
        data: PieceBytes(content[from..until].to_vec()),
    }
}

const AT: ConnectionId = ConnectionId(1);

fn hand_in(desk: &mut Reception<MemoryShelf>, content: &[u8]) -> Receipt {
    let mut receipt = desk.begin(AT, "anna", &submission(content));
    while let DeskMessage::Fetch(request) = &receipt.answer {
        let piece = piece(content, request);
        receipt = desk.take(AT, "anna", &piece).expect("an answer");
    }
    receipt
}

#[test]
fn a_full_disk_is_said_and_the_record_goes_on_when_there_is_room() {
    let content = vec![5; 3 * PIECE];
    let mut desk = Reception::new(MemoryShelf {
        room: Some(2 * PIECE),
        ..MemoryShelf::default()
    });
    let receipt = hand_in(&mut desk, &content);
    let refusal = SubmissionRefusal::Unwritable;
    let end = SubmissionEnd::Refused(refusal);
    let record = submission(&content).record;
    assert_eq!(
        receipt.answer,
        DeskMessage::Settled {
            record: record.clone(),
            end
        }
    );
    let words = Some("no space left".to_owned());
    let news = ReceiptNews::Refused(record.clone(), refusal, words);
    assert_eq!(receipt.news, Some(news));
    desk.shelf.room = None;
    let receipt = desk.begin(AT, "anna", &submission(&content));
    let from = 2 * PIECE as u64;
    assert!(matches!(receipt.answer, DeskMessage::Fetch(it) if it.from == from));
    assert_eq!(
        hand_in(&mut desk, &content).news,
        Some(ReceiptNews::Kept(record))
    );
}

#[test]
fn a_trainee_has_a_share_of_the_disk_and_no_more() {
    let mut desk = Reception::new(MemoryShelf::default());
    let mut large = submission(b"x");
    for part in [RecordPart::Inputs, RecordPart::Journal, RecordPart::Frames] {
        large.parts.push(SubmittedPart {
            part,
            bytes: crate::LARGEST_PART,
            sha256: String::new(),
        });
    }
    assert!(matches!(
        desk.begin(AT, "anna", &large).answer,
        DeskMessage::Fetch(_)
    ));
    let mut full = Reception::new(SharedShelf(TRAINEE_SHARE - 2 * crate::LARGEST_PART));
    let receipt = full.begin(AT, "anna", &large);
    let refused = ReceiptNews::Refused(large.record.clone(), SubmissionRefusal::Share, None);
    assert_eq!(receipt.news, Some(refused));
}

/// A shelf of a trainee who uses this many bytes.
struct SharedShelf(u64);

impl RecordShelf for SharedShelf {
    fn kept(&self, _: &str, _: &RecordName) -> Result<Option<Submission>, ShelfFault> {
        Ok(None)
    }
    fn used(&self, _: &str) -> Result<u64, ShelfFault> {
        Ok(self.0)
    }
    fn held(&self, _: &str, _: &RecordName, _: RecordPart) -> Result<Held, ShelfFault> {
        Ok(Held::Bytes(0))
    }
    fn append(
        &mut self,
        _: &str,
        _: &RecordName,
        _: RecordPart,
        _: &[u8],
    ) -> Result<(), ShelfFault> {
        Ok(())
    }
    fn check(
        &mut self,
        _: &str,
        _: &RecordName,
        _: RecordPart,
        _: &str,
    ) -> Result<bool, ShelfFault> {
        Ok(true)
    }
    fn complete(&mut self, _: &str, _: &Submission) -> Result<(), ShelfFault> {
        Ok(())
    }
}
