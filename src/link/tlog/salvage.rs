//! Reading past damage: the valid records of a tlog, and the damaged stretches between them.

use std::io::{self, Read};

use super::{LONGEST_FRAME, STAMP_LEN, TlogError, TlogRecord};
use crate::wire::{Decoder, Frame, frame_len, is_frame_start};

const LONGEST_RECORD: usize = STAMP_LEN + LONGEST_FRAME;
const READ_LEN: usize = 64 * 1024;
const DAY_US: u64 = 24 * 3600 * 1_000_000;
/// The plausible times after damage without an earlier record: 2000-01-01 to 2100-01-01.
const PLAUSIBLE_US: std::ops::Range<u64> = 946_684_800_000_000..4_102_444_800_000_000;

/// The next piece of a recording.
#[derive(Debug, PartialEq, Eq)]
pub enum TlogPiece {
    Record(TlogRecord),
    /// Bytes that belong to no record.
    Damage {
        /// Where the bytes start, in bytes from the start of the file.
        offset: u64,
        len: u64,
    },
}

/// Reads all valid records of a tlog; the strict reader is [`super::TlogReader`]. After an error it yields nothing
/// more.
#[derive(Debug)]
pub struct TlogSalvage<R> {
    input: R,
    window: Vec<u8>,
    /// Where the next record starts in the window, and in the file.
    start: usize,
    offset: u64,
    at_end: bool,
    /// Whether the file is still being written, so that more may follow its last byte.
    grows: bool,
    last_us: Option<u64>,
}

impl<R: Read> TlogSalvage<R> {
    /// Reads from the start of a recording; the reader need not be buffered.
    pub fn new(input: R) -> Self {
        Self {
            input,
            window: Vec::new(),
            start: 0,
            offset: 0,
            at_end: false,
            grows: false,
            last_us: None,
        }
    }

    /// The same for a file that is still being written: at its end, a record that is not whole yet is no damage, and after
    /// `None` there may be more.
    #[must_use]
    pub fn growing(self) -> Self {
        Self {
            grows: true,
            ..self
        }
    }

    /// Continues at the start of a record, `offset` bytes from the start of the file; `last_us` is the time of the
    /// record before it.
    pub fn at(input: R, offset: u64, last_us: Option<u64>) -> Self {
        Self {
            offset,
            last_us,
            ..Self::new(input)
        }
    }

    /// Where the next piece starts, in bytes from the start of the file.
    pub fn offset(&self) -> u64 {
        self.offset
    }

    /// The time of the last record, in microseconds since 1970 (UTC); `None` before the first.
    pub fn last_us(&self) -> Option<u64> {
        self.last_us
    }

    fn piece(&mut self) -> Result<Option<TlogPiece>, TlogError> {
        self.fill()?;
        if self.rest().is_empty() || self.awaits_more() {
            return Ok(None);
        }
        if self.is_record() {
            return Ok(self.take_record().map(TlogPiece::Record));
        }
        let offset = self.offset;
        let is_cut = is_cut(self.rest());
        while !self.rest().is_empty() && !self.awaits_more() && !self.is_resumption() {
            self.advance(1);
            self.fill()?;
        }
        if is_cut && self.rest().is_empty() {
            return Err(TlogError::Truncated { offset });
        }
        let len = self.offset - offset;
        Ok(Some(TlogPiece::Damage { offset, len }))
    }

    /// Whether the file is still being written and ends within the next record.
    fn awaits_more(&self) -> bool {
        self.grows && is_cut(self.rest())
    }

    fn take_record(&mut self) -> Option<TlogRecord> {
        let (unix_us, frame) = head(self.rest())?;
        let bytes = frame.to_vec();
        self.last_us = Some(unix_us);
        self.advance(STAMP_LEN + bytes.len());
        Some(TlogRecord { unix_us, bytes })
    }

    /// Whether the next record is at the expected position. A frame may be damaged if the next record follows it; the
    /// decoder handles that.
    fn is_record(&self) -> bool {
        let Some((unix_us, frame)) = head(self.rest()) else {
            return false;
        };
        let follows = &self.rest()[STAMP_LEN + frame.len()..];
        let is_followed = match head(follows) {
            Some((next_us, _)) => next_us.abs_diff(unix_us) < DAY_US,
            None => follows.is_empty() || is_cut(follows),
        };
        (is_followed && self.is_plausible(unix_us)) || is_intact(frame)
    }

    /// Whether a trustworthy record starts here, after damage.
    fn is_resumption(&self) -> bool {
        head(self.rest())
            .is_some_and(|(unix_us, frame)| self.is_plausible(unix_us) && is_intact(frame))
    }

    fn is_plausible(&self, unix_us: u64) -> bool {
        match self.last_us {
            Some(last_us) => unix_us.abs_diff(last_us) < DAY_US,
            None => PLAUSIBLE_US.contains(&unix_us),
        }
    }

    fn rest(&self) -> &[u8] {
        &self.window[self.start..]
    }

    fn advance(&mut self, count: usize) {
        self.start += count;
        self.offset += count as u64;
    }

    /// Reads until a record and the next one are in the window, or the file ends.
    fn fill(&mut self) -> Result<(), TlogError> {
        if self.at_end || self.rest().len() >= 2 * LONGEST_RECORD {
            return Ok(());
        }
        self.window.drain(..self.start);
        self.start = 0;
        let wanted = READ_LEN - self.window.len();
        let got = self
            .input
            .by_ref()
            .take(wanted as u64)
            .read_to_end(&mut self.window)
            .map_err(|source: io::Error| TlogError::Read {
                offset: self.offset,
                source,
            })?;
        self.at_end = got < wanted && !self.grows;
        Ok(())
    }
}

impl<R: Read> Iterator for TlogSalvage<R> {
    type Item = Result<TlogPiece, TlogError>;

    fn next(&mut self) -> Option<Self::Item> {
        let piece = self.piece();
        if piece.is_err() {
            self.advance(self.rest().len());
            self.at_end = true;
        }
        piece.transpose()
    }
}

/// The time and the frame of a whole record, according to its header.
fn head(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (stamp, frame) = bytes.split_first_chunk::<STAMP_LEN>()?;
    let frame = frame.get(..frame_len(*frame.first_chunk()?)?)?;
    Some((u64::from_be_bytes(*stamp), frame))
}

/// Whether the bytes are the start of an incomplete record.
fn is_cut(bytes: &[u8]) -> bool {
    match bytes.get(STAMP_LEN..) {
        None | Some([]) => true,
        Some([start, ..]) => is_frame_start(*start) && head(bytes).is_none(),
    }
}

fn is_intact(frame: &[u8]) -> bool {
    let mut decoder = Decoder::new();
    decoder.push(frame);
    let intact = |found: Frame| found.is_verified() && usize::from(found.wire_len) == frame.len();
    decoder.next_frame().is_some_and(intact)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::TlogWriter;
    use crate::link::tests::heartbeat;
    use crate::link::tlog::LONGEST_FRAME;
    use proptest::prelude::*;

    const START_US: u64 = 1_700_000_000_000_000;

    fn records(count: u64) -> Vec<TlogRecord> {
        (0..count)
            .map(|number| TlogRecord {
                unix_us: START_US + number,
                bytes: heartbeat(number as u8),
            })
            .collect()
    }

    fn written(records: &[TlogRecord]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut writer = TlogWriter::new(&mut bytes);
        for record in records {
            writer
                .write(record.unix_us, &record.bytes)
                .expect("memory is writable");
        }
        bytes
    }

    #[test]
    fn damage_longer_than_what_is_read_at_once_is_passed_over() {
        let records = records(2);
        let noise = vec![0; 3 * READ_LEN];
        let bytes = [written(&records[..1]), noise, written(&records[1..])].concat();
        let pieces: Result<Vec<_>, _> = TlogSalvage::new(&bytes[..]).collect();
        let damage = TlogPiece::Damage {
            offset: written(&records[..1]).len() as u64,
            len: 3 * READ_LEN as u64,
        };
        let [first, second] = [0, 1].map(|number| TlogPiece::Record(records[number].clone()));
        assert_eq!(pieces.expect("readable"), [first, damage, second]);
    }

    #[test]
    fn logs_joined_after_months_are_no_damage() {
        let mut records = records(6);
        for record in &mut records[3..] {
            record.unix_us += 100 * DAY_US;
        }
        let bytes = written(&records);
        let pieces: Result<Vec<_>, _> = TlogSalvage::new(&bytes[..]).collect();
        let expected: Vec<_> = records.into_iter().map(TlogPiece::Record).collect();
        assert_eq!(pieces.expect("sound"), expected);
    }

    #[test]
    fn a_file_that_grows_byte_by_byte_has_all_its_records_and_no_damage() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.tlog");
        let records = records(3);
        let mut file = std::fs::File::create(&path).expect("created");
        let read = std::fs::File::open(&path).expect("it is there");
        let mut salvage = TlogSalvage::new(read).growing();
        let mut found = Vec::new();
        for byte in written(&records) {
            std::io::Write::write_all(&mut file, &[byte]).expect("written");
            for piece in salvage.by_ref() {
                found.push(piece.expect("readable"));
            }
        }
        let expected: Vec<_> = records.into_iter().map(TlogPiece::Record).collect();
        assert_eq!(found, expected);
    }

    proptest! {
        #[test]
        fn every_byte_is_in_a_record_or_passed_over_and_little_is_lost(
            noise in prop::collection::vec(any::<u8>(), 0..400),
            at in 60usize..500,
        ) {
            let records = records(40);
            let mut bytes = written(&records);
            bytes[at..at + noise.len()].copy_from_slice(&noise);
            let (mut len, mut found) = (0, 0);
            for piece in TlogSalvage::new(&bytes[..]) {
                match piece.expect("readable") {
                    TlogPiece::Record(record) => {
                        len += (STAMP_LEN + record.bytes.len()) as u64;
                        found += usize::from(records.contains(&record));
                    }
                    TlogPiece::Damage { offset, len: passed_over } => {
                        prop_assert_eq!(offset, len);
                        len += passed_over;
                    }
                }
            }
            prop_assert_eq!(len, bytes.len() as u64);
            // The end of the noise may look like the start of a frame of an unknown message. Such a
            // frame cannot be checked, and would swallow the bytes that follow.
            let reach = noise.len() + LONGEST_FRAME;
            let touched = reach / records[0].bytes.len() + 2;
            prop_assert!(found >= 40 - touched, "{} of 40", found);
        }
    }
}
