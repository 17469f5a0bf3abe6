//! What is added to the journal and to the run of a recording that is still being made.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use crate::record::Journal;
use crate::store::RecordFiles;
use crate::text;
use crate::text::Text;

/// The maximum number of bytes that are read of a file at once, so that a long recording does not hold the console.
const READ_AT_ONCE: u64 = 4 * 1024 * 1024;
/// The maximum length of a line, in bytes. A longer one is damage, and nothing after it is read: it comes from another
/// console.
const LONGEST_LINE: usize = 8 * 1024 * 1024;

/// The journal and the run of a recording that grows.
#[derive(Debug)]
pub(super) struct Growth {
    journal_lines: GrowingLines,
    pub journal: Journal,
    run_lines: Option<GrowingLines>,
}

impl Growth {
    /// Begins at the first line of each file.
    ///
    /// # Errors
    /// A file cannot be read, or the journal does not begin with its head.
    pub fn begin(files: &RecordFiles) -> Result<Self, Text> {
        let path = files
            .journal
            .as_deref()
            .ok_or_else(|| text!("journal-none"))?;
        let mut journal_lines = GrowingLines::open(path)?;
        let lines = journal_lines.take();
        let head = lines.split_inclusive('\n').next().unwrap_or_default();
        let mut journal = Journal::read(head)?;
        journal.grow(&lines[head.len()..]);
        let run_lines = files.run.as_deref().map(GrowingLines::open).transpose()?;
        Ok(Self {
            journal_lines,
            journal,
            run_lines,
        })
    }

    /// Reads what has been added to the journal.
    pub fn grow_journal(&mut self) {
        let lines = self.journal_lines.take();
        self.journal.grow(&lines);
    }

    /// The lines that have been added to the run; at first all of them, with the head.
    pub fn run(&mut self) -> String {
        let lines = self.run_lines.as_mut();
        lines.map_or_else(String::new, GrowingLines::take)
    }
}

/// A file of lines that grows.
#[derive(Debug)]
struct GrowingLines {
    file: File,
    /// The bytes after the last line end.
    rest: Vec<u8>,
    /// Whether a line was too long.
    is_cut: bool,
}

impl GrowingLines {
    fn open(path: &Path) -> Result<Self, Text> {
        let file = File::open(path).map_err(|error| crate::store::unread(path, &error))?;
        Ok(Self {
            file,
            rest: Vec::new(),
            is_cut: false,
        })
    }

    /// The whole lines since the last call.
    fn take(&mut self) -> String {
        if self.is_cut {
            return String::new();
        }
        let mut part = self.file.by_ref().take(READ_AT_ONCE);
        // What cannot be read now may be later.
        drop(part.read_to_end(&mut self.rest));
        let end = self.rest.iter().rposition(|byte| *byte == b'\n');
        let whole: Vec<u8> = self.rest.drain(..end.map_or(0, |at| at + 1)).collect();
        if self.rest.len() > LONGEST_LINE {
            (self.rest, self.is_cut) = (Vec::new(), true);
        }
        String::from_utf8_lossy(&whole).into_owned()
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Seek as _, SeekFrom, Write as _};

    use super::*;

    #[test]
    fn only_whole_lines_are_taken_and_each_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("lines");
        let mut file = File::create(&path).expect("created");
        let mut lines = GrowingLines::open(&path).expect("it is there");
        let mut taken = Vec::new();
        for part in ["a\nb", "", "c\nd\n", "e"] {
            file.write_all(part.as_bytes()).expect("written");
            taken.push(lines.take());
        }
        assert_eq!(taken, ["a\n", "", "bc\nd\n", ""]);
    }

    #[test]
    fn a_line_without_end_is_given_up() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("lines");
        let mut file = File::create(&path).expect("created");
        let mut lines = GrowingLines::open(&path).expect("it is there");
        file.set_len(3 * READ_AT_ONCE).expect("it grows");
        for _ in 0..3 {
            assert_eq!(lines.take(), "");
            assert!(lines.rest.len() <= LONGEST_LINE);
        }
        file.seek(SeekFrom::End(0)).expect("its end");
        file.write_all(b"\nb\n").expect("written");
        assert_eq!(lines.take(), "");
    }
}
