//! The messages of `MAVLink` FTP.

use crate::payload::{Payload, Writer};
use crate::transfer::Peer;
use crate::transfer::tree::{self, FolderEntry, NO_SUCH_FILE};

/// The offset of the protocol's own header in `FILE_TRANSFER_PROTOCOL`.
const BEGIN: usize = 3;
/// Bytes of data in one message.
pub(super) const DATA: usize = 239;

pub(super) const TERMINATE: u8 = 1;
pub(super) const RESET: u8 = 2;
pub(super) const LIST: u8 = 3;
pub(super) const OPEN_RO: u8 = 4;
pub(super) const READ: u8 = 5;
pub(super) const CREATE: u8 = 6;
pub(super) const WRITE: u8 = 7;
pub(super) const REMOVE_FILE: u8 = 8;
pub(super) const MAKE_FOLDER: u8 = 9;
pub(super) const REMOVE_FOLDER: u8 = 10;
pub(super) const OPEN_WO: u8 = 11;
pub(super) const RENAME: u8 = 13;
pub(super) const CRC32: u8 = 14;
pub(super) const BURST_READ: u8 = 15;
pub(super) const ACCEPTED: u8 = 128;
pub(super) const REFUSED: u8 = 129;

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    Fail,
    InvalidSize,
    InvalidSession,
    EndOfFile,
    NothingOpen,
    /// An error number of the operating system.
    System(u8),
}

impl From<u8> for Refusal {
    fn from(number: u8) -> Self {
        Self::System(number)
    }
}

impl Refusal {
    pub(super) fn data(self) -> Vec<u8> {
        match self {
            Self::Fail => vec![1],
            Self::InvalidSize => vec![3],
            Self::InvalidSession => vec![4],
            Self::EndOfFile => vec![6],
            Self::System(tree::EXISTS) => vec![8],
            Self::NothingOpen | Self::System(NO_SUCH_FILE) => vec![10],
            Self::System(number) => vec![2, number],
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct FtpRequest {
    pub(super) from: Peer,
    pub(super) seq: u16,
    pub(super) session: u8,
    pub(super) opcode: u8,
    pub(super) size: u8,
    pub(super) offset: u32,
    pub(super) data: Vec<u8>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Reply {
    pub(super) to: Peer,
    pub(super) seq: u16,
    pub(super) session: u8,
    pub(super) opcode: u8,
    pub(super) asked: u8,
    pub(super) burst_complete: bool,
    pub(super) offset: u32,
    pub(super) data: Vec<u8>,
}

impl FtpRequest {
    pub(super) fn read(payload: &Payload, from: Peer) -> Self {
        let data = payload.from(BEGIN + 12);
        Self {
            from,
            seq: payload.short(BEGIN),
            session: payload.byte(BEGIN + 2),
            opcode: payload.byte(BEGIN + 3),
            size: payload.byte(BEGIN + 4),
            offset: payload.word(BEGIN + 8),
            data: data[..data.len().min(DATA)].to_vec(),
        }
    }

    /// The path in the data; its length must equal the request's size.
    pub(super) fn path(&self) -> Result<String, Refusal> {
        let end = self.data.iter().position(|byte| *byte == 0);
        let len = end.unwrap_or(self.data.len());
        if self.size == 0 || usize::from(self.size) != len {
            return Err(Refusal::InvalidSize);
        }
        // A name is one byte shorter than its field.
        let name = &self.data[..len.min(DATA - 1)];
        Ok(String::from_utf8_lossy(name).into_owned())
    }

    /// Two paths in the data.
    pub(super) fn paths(&self) -> Result<(String, String), Refusal> {
        let mut names = self.data.split(|byte| *byte == 0);
        let (from, to) = (names.next(), names.next());
        let (from, to) = (from.unwrap_or_default(), to.unwrap_or_default());
        if self.size == 0 || from.len() + to.len() + 1 != usize::from(self.size) {
            return Err(Refusal::InvalidSize);
        }
        let text = |name: &[u8]| String::from_utf8_lossy(name).into_owned();
        Ok((text(from), text(to)))
    }

    pub(super) fn reply(&self) -> Reply {
        Reply {
            to: self.from,
            seq: self.seq.wrapping_add(1),
            session: self.session,
            opcode: ACCEPTED,
            asked: self.opcode,
            ..Reply::default()
        }
    }
}

impl Reply {
    pub(super) fn refuse(&mut self, reason: Refusal) {
        self.opcode = REFUSED;
        self.data = reason.data();
    }

    pub(super) fn payload(&self) -> Vec<u8> {
        let complete = u8::from(self.burst_complete);
        Writer::default()
            .bytes(&[0, self.to.system, self.to.component])
            .short(self.seq)
            .bytes(&[self.session, self.opcode, self.data.len() as u8])
            .bytes(&[self.asked, complete, 0])
            .word(self.offset)
            .bytes(&self.data)
            .done()
    }
}

/// As many entries of a folder as fit into one message, beginning with the entry `first`.
pub(super) fn listing(entries: &[FolderEntry], first: u32) -> Result<Vec<u8>, Refusal> {
    let mut data = Vec::new();
    for entry in entries.iter().skip(first as usize) {
        let line = match entry.len {
            Some(len) => format!("F{}\t{len}\0\0", entry.name),
            None => format!("D{}\0\0", entry.name),
        };
        if data.len() + line.len() > DATA {
            break;
        }
        data.extend_from_slice(line.as_bytes());
    }
    if data.is_empty() {
        return Err(Refusal::EndOfFile);
    }
    Ok(data)
}
