//! Telemetry logs in the format of `MAVProxy`, Mission Planner and `QGroundControl`: before each frame, eight bytes
//! of big-endian Unix time in microseconds.

use std::io::{self, Read, Write};

use crate::text;
use crate::text::Text;
use crate::wire::frame_len;

mod damage;
mod salvage;

pub use damage::TlogDamage;
pub use salvage::{TlogPiece, TlogSalvage};

const STAMP_LEN: usize = 8;
/// The longest frame: MAVLink 2 with a full payload and a signature.
const LONGEST_FRAME: usize = 280;

/// One entry of a tlog.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TlogRecord {
    /// When the frame was received or sent, in microseconds since 1970 (UTC).
    pub unix_us: u64,
    /// The frame as it was on the wire, from its start byte to its checksum or signature.
    pub bytes: Vec<u8>,
}

/// A fault in a tlog, with its position.
#[derive(Debug, thiserror::Error)]
#[error("{}", Text::from(self))]
pub enum TlogError {
    /// The file ends inside a record: the recorder was killed, or the copy is incomplete.
    Truncated {
        /// Where the incomplete record starts, in bytes from the start of the file.
        offset: u64,
    },
    /// No frame follows a timestamp.
    Damaged {
        /// Where the bad record starts, in bytes from the start of the file.
        offset: u64,
        /// The byte in place of the start byte.
        found: u8,
    },
    /// Reading the file failed.
    Read {
        /// Where the unreadable record starts, in bytes from the start of the file.
        offset: u64,
        source: io::Error,
    },
}

impl From<&TlogError> for Text {
    fn from(error: &TlogError) -> Self {
        match error {
            TlogError::Truncated { offset } => text!("transport-tlog-cut-off", byte = *offset),
            TlogError::Damaged { offset, found } => text!(
                "transport-tlog-damaged",
                byte = *offset,
                found = format!("0x{found:02X}")
            ),
            TlogError::Read { offset, source } => text!(
                "transport-tlog-unreadable",
                byte = *offset,
                error = source.to_string()
            ),
        }
    }
}

/// Reads a tlog record by record; `input` should be buffered. After an error it yields nothing more, since the start of
/// the next record is unknown.
#[derive(Debug)]
pub struct TlogReader<R> {
    input: R,
    offset: u64,
    ended: bool,
}

impl<R: Read> TlogReader<R> {
    /// Reads from the start of a recording.
    pub fn new(input: R) -> Self {
        Self {
            input,
            offset: 0,
            ended: false,
        }
    }

    /// Where the next record starts, in bytes from the start of the file.
    pub fn offset(&self) -> u64 {
        self.offset
    }

    fn record(&mut self) -> Result<Option<TlogRecord>, TlogError> {
        // The start byte and the two after it determine the frame's length.
        let mut head = [0; STAMP_LEN + 3];
        let got = self.fill(&mut head)?;
        if got == 0 {
            return Ok(None);
        }
        let truncated = TlogError::Truncated {
            offset: self.offset,
        };
        let [stamp @ .., start, payload_len, flags] = head;
        if got <= STAMP_LEN {
            return Err(truncated);
        }
        let len = frame_len([start, payload_len, flags]).ok_or(TlogError::Damaged {
            offset: self.offset,
            found: start,
        })?;
        if got < head.len() {
            return Err(truncated);
        }
        let mut bytes = [0; LONGEST_FRAME];
        bytes[..3].copy_from_slice(&head[STAMP_LEN..]);
        if self.fill(&mut bytes[3..len])? < len - 3 {
            return Err(truncated);
        }
        self.offset += (STAMP_LEN + len) as u64;
        Ok(Some(TlogRecord {
            unix_us: u64::from_be_bytes(stamp),
            bytes: bytes[..len].to_vec(),
        }))
    }

    /// Reads until the buffer is full or the file ends; returns the length read.
    fn fill(&mut self, buffer: &mut [u8]) -> Result<usize, TlogError> {
        let mut got = 0;
        while got < buffer.len() {
            match self.input.read(&mut buffer[got..]) {
                Ok(0) => break,
                Ok(count) => got += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(source) => {
                    return Err(TlogError::Read {
                        offset: self.offset,
                        source,
                    });
                }
            }
        }
        Ok(got)
    }
}

impl<R: Read> Iterator for TlogReader<R> {
    type Item = Result<TlogRecord, TlogError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let record = self.record().transpose();
        self.ended = !matches!(record, Some(Ok(_)));
        record
    }
}

/// Writes a tlog; `output` should be buffered.
#[derive(Debug)]
pub struct TlogWriter<W> {
    output: W,
}

impl<W: Write> TlogWriter<W> {
    /// Writes to this output.
    pub fn new(output: W) -> Self {
        Self { output }
    }

    /// Appends one frame, whole and as it is on the wire, with its time in microseconds since 1970
    /// (UTC).
    ///
    /// # Errors
    /// The output cannot be written.
    pub fn write(&mut self, unix_us: u64, frame: &[u8]) -> io::Result<()> {
        self.output.write_all(&unix_us.to_be_bytes())?;
        self.output.write_all(frame)
    }

    pub fn into_inner(self) -> W {
        self.output
    }

    /// Flushes the output.
    ///
    /// # Errors
    /// The output cannot be flushed.
    pub fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::Encoder;
    use mavlink::MavlinkVersion;
    use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, STATUSTEXT_DATA};

    fn records() -> Vec<TlogRecord> {
        let mut encoder = Encoder::new(1, 1);
        [MavlinkVersion::V2, MavlinkVersion::V1, MavlinkVersion::V2]
            .into_iter()
            .zip(1_000_000..)
            .map(|(version, unix_us)| {
                encoder.set_version(version);
                let message = if unix_us % 2 == 0 {
                    MavMessage::HEARTBEAT(HEARTBEAT_DATA::default())
                } else {
                    MavMessage::STATUSTEXT(STATUSTEXT_DATA::default())
                };
                let mut bytes = Vec::new();
                encoder.encode(&message.into(), &mut bytes);
                TlogRecord { unix_us, bytes }
            })
            .collect()
    }

    fn written(records: &[TlogRecord]) -> Vec<u8> {
        let mut writer = TlogWriter::new(Vec::new());
        for record in records {
            writer
                .write(record.unix_us, &record.bytes)
                .expect("memory is writable");
        }
        writer.output
    }

    #[test]
    fn what_was_written_is_read_back() {
        let bytes = written(&records());
        let mut reader = TlogReader::new(&bytes[..]);
        let read: Vec<_> = reader.by_ref().map(|r| r.expect("sound")).collect();
        assert_eq!(read, records());
        assert_eq!(reader.offset(), bytes.len() as u64);
    }

    #[test]
    fn a_signed_frame_is_read_with_its_signature() {
        let mut frame = vec![0xFD, 1, 1];
        frame.resize(10 + 1 + 2 + 13, 0x55);
        let record = TlogRecord {
            unix_us: 7,
            bytes: frame,
        };
        let bytes = written(std::slice::from_ref(&record));
        let read: Result<Vec<_>, _> = TlogReader::new(&bytes[..]).collect();
        assert_eq!(read.expect("sound"), [record]);
    }

    #[test]
    fn a_cut_anywhere_inside_a_record_is_reported_at_its_start() {
        let records = records();
        let bytes = written(&records);
        let last = bytes.len() - STAMP_LEN - records[2].bytes.len();
        for end in last + 1..bytes.len() {
            let mut reader = TlogReader::new(&bytes[..end]);
            assert_eq!(reader.by_ref().take(2).flatten().count(), 2);
            let error = reader.next().expect("an error").expect_err("cut");
            assert!(
                matches!(error, TlogError::Truncated { offset } if offset == last as u64),
                "{error}"
            );
            assert!(reader.next().is_none(), "nothing follows an error");
        }
    }

    #[test]
    fn a_record_without_a_frame_is_reported_at_its_offset() {
        let records = records();
        let mut bytes = written(&records);
        let second = STAMP_LEN + records[0].bytes.len();
        bytes[second + STAMP_LEN] = b'#';
        let error = TlogReader::new(&bytes[..])
            .find_map(Result::err)
            .expect("an error")
            .to_string();
        assert!(
            error.contains(&format!("at byte {second} (found 0x23")),
            "{error}"
        );
    }
}
