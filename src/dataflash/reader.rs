//! The records of a log: `A3 95`, a type, and columns that are defined by a format record in the log.

use std::sync::Arc;

/// Every record begins with these bytes.
const HEAD: [u8; 2] = [0xA3, 0x95];
const HEAD_LEN: usize = 3;
/// The type of format records (`FMT`), which define the other records, and their length.
const FORMAT: u8 = 0x80;
const FORMAT_LEN: usize = 89;

/// The format of one type of record.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Format {
    pub name: String,
    /// The size of a record in bytes, including its header.
    length: usize,
    /// The columns: name, letter of its type, position in the record.
    columns: Vec<(String, u8, usize)>,
}

/// A record of a log.
#[derive(Debug, Clone)]
pub(super) struct Record<'a> {
    pub format: Arc<Format>,
    bytes: &'a [u8],
}

/// Iterates over the records of a log. Invalid bytes are skipped and counted.
#[derive(Debug)]
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    at: usize,
    formats: Vec<Option<Arc<Format>>>,
    /// The number of bytes that do not belong to any record.
    pub skipped: usize,
    /// The number of bytes of an incomplete last record.
    pub cut_off: usize,
    /// The number of format records so far.
    pub described: usize,
}

impl Format {
    /// Reads a format record; `None` if it is not valid.
    fn read(record: &[u8]) -> Option<(u8, Self)> {
        let (kind, length) = (*record.get(HEAD_LEN)?, usize::from(*record.get(4)?));
        let name = text(record.get(5..9)?);
        let letters = record.get(9..25)?;
        let labels = text(record.get(25..FORMAT_LEN)?);
        let (mut columns, mut at, mut labels) = (Vec::new(), HEAD_LEN, labels.split(','));
        for &letter in letters.iter().take_while(|letter| **letter != 0) {
            let label = labels.next().unwrap_or_default();
            columns.push((label.to_owned(), letter, at));
            at += size(letter)?;
        }
        let format = Self {
            name,
            length,
            columns,
        };
        (at == length && length > HEAD_LEN).then_some((kind, format))
    }
}

impl Record<'_> {
    fn column(&self, label: &str) -> Option<(u8, &[u8])> {
        let mut columns = self.format.columns.iter();
        let (_, letter, at) = columns.find(|(known, ..)| known == label)?;
        let bytes = self.bytes.get(*at..*at + size(*letter)?)?;
        Some((*letter, bytes))
    }

    /// The number in a column, scaled; `None` if there is no such column or it is not a number.
    pub fn number(&self, label: &str) -> Option<f64> {
        let (letter, bytes) = self.column(label)?;
        let value = match letter {
            b'b' => f64::from(bytes[0] as i8),
            b'B' | b'M' => f64::from(bytes[0]),
            b'h' => f64::from(i16::from_le_bytes(bytes.try_into().ok()?)),
            b'c' => f64::from(i16::from_le_bytes(bytes.try_into().ok()?)) * 0.01,
            b'H' => f64::from(u16::from_le_bytes(bytes.try_into().ok()?)),
            b'C' => f64::from(u16::from_le_bytes(bytes.try_into().ok()?)) * 0.01,
            b'i' => f64::from(i32::from_le_bytes(bytes.try_into().ok()?)),
            b'e' => f64::from(i32::from_le_bytes(bytes.try_into().ok()?)) * 0.01,
            b'L' => f64::from(i32::from_le_bytes(bytes.try_into().ok()?)) * 1e-7,
            b'I' => f64::from(u32::from_le_bytes(bytes.try_into().ok()?)),
            b'E' => f64::from(u32::from_le_bytes(bytes.try_into().ok()?)) * 0.01,
            b'f' => f64::from(f32::from_le_bytes(bytes.try_into().ok()?)),
            b'd' => f64::from_le_bytes(bytes.try_into().ok()?),
            b'q' => i64::from_le_bytes(bytes.try_into().ok()?) as f64,
            b'Q' => u64::from_le_bytes(bytes.try_into().ok()?) as f64,
            _ => return None,
        };
        value.is_finite().then_some(value)
    }

    /// The size of the record in bytes, including its header.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// The number in a column as a byte; `None` if it does not fit or is missing.
    pub fn byte(&self, label: &str) -> Option<u8> {
        let value = self.number(label)?;
        (0.0..=255.0).contains(&value).then_some(value as u8)
    }

    pub fn text(&self, label: &str) -> Option<String> {
        let (letter, bytes) = self.column(label)?;
        matches!(letter, b'n' | b'N' | b'Z').then(|| text(bytes))
    }

    /// The time at which the record was written, in microseconds since the autopilot booted.
    pub fn time_us(&self) -> Option<u64> {
        match self.column("TimeUS")? {
            (b'Q', bytes) => Some(u64::from_le_bytes(bytes.try_into().ok()?)),
            _ => None,
        }
    }
}

impl<'a> Records<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            formats: vec![None; 256],
            skipped: 0,
            cut_off: 0,
            described: 0,
        }
    }

    /// The size of a record of this type in bytes, if known.
    fn length(&self, kind: u8) -> Option<usize> {
        match kind {
            FORMAT => Some(FORMAT_LEN),
            kind => self.formats[usize::from(kind)].as_ref().map(|it| it.length),
        }
    }
}

impl<'a> Iterator for Records<'a> {
    type Item = Record<'a>;

    fn next(&mut self) -> Option<Record<'a>> {
        loop {
            let rest = &self.bytes[self.at..];
            if rest.is_empty() {
                return None;
            }
            let length = match rest {
                [0xA3, 0x95, kind, ..] => self.length(*kind),
                _ if HEAD.starts_with(rest) || rest == HEAD => Some(HEAD_LEN),
                _ => None,
            };
            let Some(length) = length else {
                self.skipped += 1;
                self.at += 1;
                continue;
            };
            let Some(bytes) = rest.get(..length) else {
                self.cut_off = rest.len();
                self.at = self.bytes.len();
                return None;
            };
            if bytes[2] == FORMAT {
                let Some((kind, format)) = Format::read(bytes) else {
                    self.skipped += 1;
                    self.at += 1;
                    continue;
                };
                self.formats[usize::from(kind)] = Some(Arc::new(format));
                self.described += 1;
                self.at += length;
                continue;
            }
            let format = self.formats[usize::from(bytes[2])].clone()?;
            self.at += length;
            return Some(Record { format, bytes });
        }
    }
}

/// The size of a column in bytes, by the letter of its type.
fn size(letter: u8) -> Option<usize> {
    Some(match letter {
        b'b' | b'B' | b'M' => 1,
        b'h' | b'H' | b'c' | b'C' | b'g' => 2,
        b'i' | b'I' | b'f' | b'n' | b'e' | b'E' | b'L' => 4,
        b'd' | b'q' | b'Q' => 8,
        b'N' => 16,
        b'a' | b'Z' => 64,
        _ => return None,
    })
}

/// A text up to its first zero byte; bytes that are not text become `?`.
fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|byte| *byte == 0);
    let bytes = &bytes[..end.unwrap_or(bytes.len())];
    crate::notice::sanitised(&String::from_utf8_lossy(bytes))
}
