//! KMZ: the first `.kml` file of a zip archive (APPNOTE.TXT 6.3: stored and deflated files).

use miniz_oxide::inflate::decompress_to_vec_with_limit;

use crate::fault::{ArchiveFault, Fault, FaultKind};

/// The maximum size of unpacked data: far more than any plan needs, yet little memory.
const LARGEST: usize = 16 * 1024 * 1024;
const END: [u8; 4] = *b"PK\x05\x06";
const ENTRY: [u8; 4] = *b"PK\x01\x02";
const FILE: [u8; 4] = *b"PK\x03\x04";
/// The length of the end record without its comment, and that of the longest comment, in bytes.
const END_LENGTH: usize = 22;
const LONGEST_COMMENT: usize = 65_535;

/// The text of the archive's KML document.
pub(super) fn kml_of(bytes: &[u8]) -> Result<String, Fault> {
    let fault = |kind| Fault::new(0..0, FaultKind::Archive(kind));
    let content = content(bytes).map_err(fault)?;
    String::from_utf8(content).map_err(|_| fault(ArchiveFault::Damaged))
}

fn content(bytes: &[u8]) -> Result<Vec<u8>, ArchiveFault> {
    let last = bytes.len().saturating_sub(END_LENGTH);
    let first = last.saturating_sub(LONGEST_COMMENT);
    let end = (first..=last)
        .rev()
        .find(|at| bytes[*at..].starts_with(&END));
    let end = end.ok_or(ArchiveFault::Damaged)?;
    let mut at = long(bytes, end + 16)?;
    for _ in 0..short(bytes, end + 10)? {
        if !bytes.get(at..).is_some_and(|rest| rest.starts_with(&ENTRY)) {
            return Err(ArchiveFault::Damaged);
        }
        let name_length = short(bytes, at + 28)?;
        let name = bytes
            .get(at + 46..at + 46 + name_length)
            .ok_or(ArchiveFault::Damaged)?;
        if name.to_ascii_lowercase().ends_with(b".kml") {
            return unpacked(bytes, at);
        }
        at += 46 + name_length + short(bytes, at + 30)? + short(bytes, at + 32)?;
    }
    Err(ArchiveFault::NoKml)
}

fn unpacked(bytes: &[u8], entry: usize) -> Result<Vec<u8>, ArchiveFault> {
    let (method, packed) = (short(bytes, entry + 10)?, long(bytes, entry + 20)?);
    let size = long(bytes, entry + 24)?;
    if size > LARGEST {
        return Err(ArchiveFault::TooLarge);
    }
    let at = long(bytes, entry + 42)?;
    if !bytes.get(at..).is_some_and(|rest| rest.starts_with(&FILE)) {
        return Err(ArchiveFault::Damaged);
    }
    let start = at + 30 + short(bytes, at + 26)? + short(bytes, at + 28)?;
    let content = bytes
        .get(start..start + packed)
        .ok_or(ArchiveFault::Damaged)?;
    let content = match method {
        0 => content.to_vec(),
        8 => decompress_to_vec_with_limit(content, LARGEST).map_err(|_| ArchiveFault::Damaged)?,
        _ => return Err(ArchiveFault::Method),
    };
    if content.len() == size {
        Ok(content)
    } else {
        Err(ArchiveFault::Damaged)
    }
}

fn short(bytes: &[u8], at: usize) -> Result<usize, ArchiveFault> {
    let two = bytes.get(at..at + 2).and_then(|two| two.try_into().ok());
    two.map(|two| usize::from(u16::from_le_bytes(two)))
        .ok_or(ArchiveFault::Damaged)
}

fn long(bytes: &[u8], at: usize) -> Result<usize, ArchiveFault> {
    let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
    four.map(|four| u32::from_le_bytes(four) as usize)
        .ok_or(ArchiveFault::Damaged)
}
