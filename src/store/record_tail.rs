//! The files of a record that is being written, from any of their bytes on.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};

use super::RecordFiles;
use crate::class::RecordPart;

/// The parts that others may follow, in the order in which they are read: the heads of the lines come before frames.
const PARTS: [RecordPart; 3] = [RecordPart::Journal, RecordPart::Run, RecordPart::Frames];

/// Reads the files of a record while they grow.
#[derive(Debug)]
pub struct RecordTail {
    frames: PathBuf,
    parts: Vec<TailPart>,
}

#[derive(Debug)]
struct TailPart {
    part: RecordPart,
    /// `None` until the file is there.
    file: Option<File>,
    /// The number of bytes that have been read.
    read: u64,
}

impl RecordTail {
    /// The record with these frames; `has` says how much of its parts is known already.
    pub fn new(frames: &Path, has: &[(RecordPart, u64)]) -> Self {
        let known = |part| has.iter().find(|(it, _)| *it == part);
        let parts = PARTS.map(|part| TailPart {
            part,
            file: None,
            read: known(part).map_or(0, |(_, bytes)| *bytes),
        });
        Self {
            frames: frames.to_owned(),
            parts: parts.into(),
        }
    }

    /// The next bytes of a part, at most `most`; `None` if there are no more yet.
    pub fn next(&mut self, most: usize) -> Option<(RecordPart, Vec<u8>)> {
        let frames = &self.frames;
        self.parts.iter_mut().find_map(|part| {
            // A file that cannot be read now may be later.
            let bytes = part.next(frames, most).unwrap_or_default();
            (!bytes.is_empty()).then_some((part.part, bytes))
        })
    }
}

impl TailPart {
    fn next(&mut self, frames: &Path, most: usize) -> io::Result<Vec<u8>> {
        if self.file.is_none() {
            let files = RecordFiles::beside(frames);
            let path = match self.part {
                RecordPart::Journal => files.journal,
                RecordPart::Run => files.run,
                RecordPart::Frames | RecordPart::Inputs => files.frames,
            };
            let Some(path) = path else {
                return Ok(Vec::new());
            };
            let mut file = File::open(path)?;
            file.seek(SeekFrom::Start(self.read))?;
            self.file = Some(file);
        }
        let mut bytes = Vec::new();
        if let Some(file) = &mut self.file {
            file.take(most as u64).read_to_end(&mut bytes)?;
        }
        self.read += bytes.len() as u64;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_read_as_it_grows_and_from_any_byte_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |ending| folder.path().join(format!("a{ending}"));
        std::fs::write(path(".tlog"), "frames").expect("written");
        let mut tail = RecordTail::new(&path(".tlog"), &[(RecordPart::Frames, 4)]);
        assert_eq!(tail.next(9), Some((RecordPart::Frames, b"es".to_vec())));
        assert_eq!(tail.next(9), None);
        std::fs::write(path(".flight.jsonl"), "head\nline\n").expect("written");
        std::fs::write(path(".run.jsonl"), "run\n").expect("written");
        let mut read = Vec::new();
        while let Some((part, bytes)) = tail.next(5) {
            read.push((part, String::from_utf8(bytes).expect("text")));
        }
        let expected = [
            (RecordPart::Journal, "head\n".to_owned()),
            (RecordPart::Journal, "line\n".to_owned()),
            (RecordPart::Run, "run\n".to_owned()),
        ];
        assert_eq!(read, expected);
    }
}
