//! Reading a folder, one packet of entries after the other.

use super::packet::FtpAnswer;
use super::{FtpFault, FtpNak};

const MOST_ENTRIES: u32 = 4096;

/// An entry of a vehicle's folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FtpEntry {
    /// A plain name, without path separators and control characters.
    pub name: String,
    /// The size of a file in bytes; `None` for a folder.
    pub size: Option<u32>,
}

/// The reading of a folder.
#[derive(Debug, Clone, Default)]
pub(super) struct FolderListing {
    entries: Vec<FtpEntry>,
    /// The number of entries that the server has listed, including skipped entries.
    counted: u32,
}

/// The meaning of an answer for a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Listed {
    /// More must be requested, starting with this entry.
    More(u32),
    All(Vec<FtpEntry>),
    Fault(FtpFault),
}

impl FolderListing {
    pub fn receive(&mut self, answer: &FtpAnswer) -> Listed {
        let data = match &answer.result {
            Ok(data) => data,
            Err(FtpNak::EndOfFile) => return Listed::All(std::mem::take(&mut self.entries)),
            Err(nak) => return Listed::Fault(FtpFault::Refused(*nak)),
        };
        let before = self.counted;
        // ArduPilot ends an entry with two zeros; the protocol defines one.
        for entry in data.split(|byte| *byte == 0).filter(|it| !it.is_empty()) {
            self.counted += 1;
            self.entries.extend(FtpEntry::read(entry));
        }
        if self.counted == before {
            return Listed::Fault(FtpFault::Malformed);
        }
        if self.counted > MOST_ENTRIES {
            return Listed::Fault(FtpFault::TooMany);
        }
        Listed::More(self.counted)
    }
}

impl FtpEntry {
    /// Reads `Fname<tab>size` or `Dname`; `None` for entries that are skipped, not understood, or could lead to another
    /// folder.
    fn read(entry: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(entry).ok()?;
        let (name, size) = if let Some(file) = text.strip_prefix('F') {
            let (name, size) = file.split_once('\t')?;
            (name, Some(size.parse().ok()?))
        } else {
            (text.strip_prefix('D')?, None)
        };
        let is_unsafe = |it: char| it == '/' || it == '\\' || it.is_control();
        let is_plain = !matches!(name, "" | "." | "..") && !name.contains(is_unsafe);
        let name = name.to_owned();
        is_plain.then_some(Self { name, size })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(data: &[u8]) -> FtpAnswer {
        FtpAnswer {
            sequence: 1,
            session: 1,
            asked: 3,
            is_burst_complete: false,
            offset: 0,
            result: Ok(data.to_vec()),
        }
    }

    #[test]
    fn names_that_lead_elsewhere_are_left_out_but_counted() {
        let mut listing = FolderListing::default();
        let data = b"D.\0\0Dlogs\0\0D..\0F../../etc/passwd\t5\0Fa\\b\t1\0S\0Fok.BIN\t70\0Fbad\t-1\0F\x1b[2J\t1\0F\xff\t1\0Fnosize\0";
        assert_eq!(listing.receive(&page(data)), Listed::More(11));
        let end = FtpAnswer {
            result: Err(FtpNak::EndOfFile),
            ..page(b"")
        };
        let entry = |name: &str, size| FtpEntry {
            name: name.to_owned(),
            size,
        };
        let known = vec![entry("logs", None), entry("ok.BIN", Some(70))];
        assert_eq!(listing.receive(&end), Listed::All(known));
    }

    #[test]
    fn a_list_without_end_or_without_entries_is_given_up() {
        let mut listing = FolderListing::default();
        let malformed = Listed::Fault(FtpFault::Malformed);
        assert_eq!(listing.receive(&page(b"")), malformed);
        assert_eq!(listing.receive(&page(b"\0\0")), malformed);
        let data = b"Fx\t1\0".repeat(40);
        let mut pages = 0;
        while let Listed::More(_) = listing.receive(&page(&data)) {
            pages += 1;
        }
        assert_eq!(pages, 4096 / 40);
    }
}
