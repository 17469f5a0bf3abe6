//! A log that is not complete yet: its bytes so far, and the list of its missing ranges.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::iter;
use std::path::{Path, PathBuf};

use super::{unreadable, unwritable};
use crate::session::{FileBytes, GapMap};
use crate::store::regular::read_regular_text;
use crate::store::{StoreError, sharing};
use crate::text;
use crate::text::OwnFault;
use crate::wire::FtpChecksum;

/// The number of bytes that are read again to check that a file belongs to the same log.
const SAMPLE: u32 = 720;
/// The number of bytes that are read at a time for a checksum.
const BLOCK: usize = 64 * 1024;
/// The maximum number of ranges of a file that are compared.
const MOST_SAMPLES: usize = 16;
/// The maximum size of a list of gaps, in bytes.
const LONGEST_GAPS: u64 = 16 * 1024 * 1024;

/// The two files of an incomplete log.
pub(super) struct LogPart {
    bytes: PathBuf,
    gaps: PathBuf,
}

impl LogPart {
    /// The part of a log with this name in a folder.
    pub fn new(folder: &Path, name: &str) -> Self {
        Self {
            bytes: folder.join(format!("{name}.part")),
            gaps: folder.join(format!("{name}.gaps")),
        }
    }

    /// The file with the bytes.
    pub fn path(&self) -> &Path {
        &self.bytes
    }

    /// Refuses links, FIFOs and the like, which others may have created.
    pub fn check(&self) -> Result<(), StoreError> {
        for path in [&self.bytes, &self.gaps] {
            if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
                let error = OwnFault::error(io::ErrorKind::Other, text!("file-not-regular"));
                return Err(unwritable(path, error));
            }
        }
        Ok(())
    }

    /// The missing ranges, if there is a part that can be continued to this size.
    pub fn missing(&self, size: u32) -> Option<GapMap> {
        let text = read_regular_text(&self.gaps, LONGEST_GAPS).ok()?;
        let mut lines = text.lines();
        let before: u32 = lines.next()?.strip_prefix("bytes ")?.parse().ok()?;
        let gaps: Option<Vec<_>> = lines
            .map(|line| {
                let (start, end) = line.split_once('-')?;
                Some(start.parse().ok()?..end.parse().ok()?)
            })
            .collect();
        let known = GapMap::of_gaps(before, gaps?)?;
        let length = fs::metadata(&self.bytes).ok()?.len();
        let reach = known.missing().last().map_or(0, |gap| gap.end);
        // The log may have grown since; a shorter one is a different log.
        let is_sound = before <= size && (length >= u64::from(before) || reach == before);
        if !is_sound {
            return None;
        }
        let mut grown = GapMap::new(size);
        let mut at = 0;
        for gap in known.missing() {
            grown.fill(at..gap.start);
            at = gap.end;
        }
        grown.fill(at..before);
        Some(grown)
    }

    /// Writes bytes, and then the list of those still missing.
    pub fn write(&self, stretches: &[FileBytes], gaps: &GapMap) -> Result<(), StoreError> {
        let written = self.open().and_then(|mut file| {
            for stretch in stretches {
                file.seek(SeekFrom::Start(u64::from(stretch.at)))?;
                file.write_all(&stretch.bytes)?;
            }
            // The list of gaps must not be ahead of the bytes, even if the power fails.
            file.sync_data()
        });
        written.map_err(|error| unwritable(&self.bytes, error))?;
        self.write_gaps(gaps)
            .map_err(|error| unwritable(&self.gaps, error))
    }

    fn write_gaps(&self, gaps: &GapMap) -> io::Result<()> {
        let missing = gaps.missing().iter();
        let lines: Vec<String> = missing
            .map(|gap| format!("{}-{}\n", gap.start, gap.end))
            .collect();
        let text = format!("bytes {}\n{}", gaps.size(), lines.concat());
        let part = self.gaps.with_extension("gaps.new");
        let mut options = OpenOptions::new();
        options.create(true).truncate(true).write(true);
        sharing::open(&mut options, &part)?.write_all(text.as_bytes())?;
        fs::rename(&part, &self.gaps)
    }

    /// The checksum of the first `size` bytes.
    pub fn checksum(&self, size: u32) -> Result<u32, StoreError> {
        let mut sum = FtpChecksum::default();
        let summed = File::open(&self.bytes).and_then(|file| {
            let mut file = file.take(u64::from(size));
            let mut block = vec![0; BLOCK];
            loop {
                match file.read(&mut block)? {
                    0 => return Ok(()),
                    len => sum.add(&block[..len]),
                }
            }
        });
        summed.map_err(|error| unreadable(&self.bytes, error))?;
        Ok(sum.value())
    }

    /// Removes bytes beyond the end, left over from a longer log with the same number; returns the
    /// length of the file.
    pub fn trim(&self, size: u32) -> Result<u64, StoreError> {
        let trimmed = self.open().and_then(|file| {
            if file.metadata()?.len() > u64::from(size) {
                file.set_len(u64::from(size))?;
            }
            file.sync_all()?;
            Ok(file.metadata()?.len())
        });
        trimmed.map_err(|error| unwritable(&self.bytes, error))
    }

    /// Deletes the list of gaps: the next download starts over.
    pub fn forget_gaps(&self) {
        drop(fs::remove_file(&self.gaps));
    }

    /// Removes both files once the complete log has its final name.
    pub fn remove(&self) {
        drop(fs::remove_file(&self.bytes));
        self.forget_gaps();
    }

    fn open(&self) -> io::Result<File> {
        let mut options = OpenOptions::new();
        options.create(true).truncate(false).write(true);
        sharing::open(&mut options, &self.bytes)
    }
}

/// Some of the stored bytes of a file: the last ones before each gap and before the end, where logs of one vehicle
/// differ. If there are many gaps, only some are used.
pub(super) fn samples(path: &Path, gaps: &GapMap) -> Vec<FileBytes> {
    let ends = gaps.missing().iter().map(|gap| gap.start);
    let starts = iter::once(0).chain(gaps.missing().iter().map(|gap| gap.end));
    let between = starts.zip(ends.chain([gaps.size()]));
    let kept: Vec<_> = between.filter(|(start, end)| start < end).collect();
    let Ok(mut file) = File::open(path) else {
        return Vec::new();
    };
    // The last one matters most: after the first difference, logs usually differ to the end.
    let every = kept.len().div_ceil(MOST_SAMPLES).max(1);
    let chosen = kept.iter().rev().step_by(every);
    let read = chosen.filter_map(|&(start, end)| {
        let at = end.saturating_sub(SAMPLE).max(start);
        let mut bytes = vec![0; (end - at) as usize];
        file.seek(SeekFrom::Start(u64::from(at))).ok()?;
        file.read_exact(&mut bytes).ok()?;
        Some(FileBytes { at, bytes })
    });
    read.collect()
}
