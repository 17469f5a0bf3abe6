//! The folder of logs, which were copied from vehicles.
//!
//! An incomplete log is stored as `NAME.bin.part`, with its missing parts in `NAME.bin.gaps`: the size, and a line for
//! each gap. The gaps are written after the bytes. A program that was killed therefore requests a little again that it
//! has, but never counts missing bytes as read. A part is found by vehicle and number; some of it is read again to
//! check that it belongs to the same log.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::iter;
use std::path::{Path, PathBuf};

use super::regular::read_regular_text;
use super::{StoreError, give_new_name, sharing, user_path};
use crate::session::{FileBytes, FtpChecksum, GapMap, KeptLog, LogKeeper, VehicleLog};
use crate::text;
use crate::text::{Text, utc_of};

/// The number of bytes that are read again to check that a file belongs to the same log.
const SAMPLE: u32 = 720;
/// The number of bytes that are read at a time for a checksum.
const BLOCK: usize = 64 * 1024;
/// The maximum number of ranges of a file that are compared.
const MOST_SAMPLES: usize = 16;
/// The maximum number of logs with the same name.
const MOST_ALIKE: usize = 100;
/// The maximum size of a list of gaps, in bytes.
const LONGEST_GAPS: u64 = 16 * 1024 * 1024;

/// A folder into which logs of vehicles are downloaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogFolder {
    folder: PathBuf,
}

impl LogFolder {
    /// The logs in the program's folder for data.
    pub fn within(data: &Path) -> Self {
        Self {
            folder: data.join("logs"),
        }
    }

    /// The path of the folder in which a log is stored.
    fn folder_of(&self, log: &VehicleLog) -> PathBuf {
        match &log.folder {
            Some(folder) => user_path(folder),
            None => self.folder.clone(),
        }
    }

    /// Creates the folder of a log. If the user has named the folder, its mode is the user's choice.
    fn make_folder(&self, log: &VehicleLog) -> Result<(), StoreError> {
        let folder = self.folder_of(log);
        let made = if log.folder.is_some() {
            fs::create_dir_all(&folder)
        } else {
            let above = self.folder.parent().unwrap_or(&self.folder);
            sharing::folder_within(above, &folder)
        };
        made.map_err(|error| unwritable(&folder, error))
    }

    /// The files of a log.
    fn paths(&self, log: &VehicleLog) -> LogPaths {
        let folder = self.folder_of(log);
        let part = format!("v{}-log{}.bin", log.vehicle, log.log.number);
        let time = u64::from(log.log.time_utc_s);
        let name = match time {
            0 => format!("v{}-log{}", log.vehicle, log.log.number),
            time => {
                let time = utc_of(time * 1_000_000).replace(' ', "T").replace(':', "-");
                format!("v{}-log{}-{time}Z", log.vehicle, log.log.number)
            }
        };
        LogPaths {
            part: folder.join(format!("{part}.part")),
            gaps: folder.join(format!("{part}.gaps")),
            name: folder.join(name),
        }
    }
}

/// The files of one log.
struct LogPaths {
    part: PathBuf,
    gaps: PathBuf,
    /// The path of the complete file, without its ending.
    name: PathBuf,
}

impl LogPaths {
    /// The possible names of the complete file, the best first.
    fn names(&self) -> impl Iterator<Item = PathBuf> + '_ {
        (1..=MOST_ALIKE).map(|number| {
            let mut name = self.name.clone().into_os_string();
            if number > 1 {
                name.push(format!("-{number}"));
            }
            name.push(".bin");
            PathBuf::from(name)
        })
    }

    /// Refuses links, FIFOs and the like, which others may have created.
    fn check(&self) -> Result<(), StoreError> {
        for path in [&self.part, &self.gaps] {
            if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
                let error = io::Error::other("it is not a regular file");
                return Err(unwritable(path, error));
            }
        }
        Ok(())
    }

    /// The missing ranges of the part, if there is a part that can be continued.
    fn missing(&self, size: u32) -> Option<GapMap> {
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
        let length = fs::metadata(&self.part).ok()?.len();
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
}

impl LogKeeper for LogFolder {
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text> {
        let paths = self.paths(log);
        let ready = self.make_folder(log).and_then(|()| paths.check());
        ready.map_err(|error| Text::from(&error))?;
        let size = log.log.size;
        let is_whole = |path: &PathBuf| {
            fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() == u64::from(size))
        };
        let whole = paths.names().take_while(|it| it.exists()).find(is_whole);
        if let Some(path) = whole.filter(|_| size > 0) {
            let mut gaps = GapMap::new(size);
            gaps.fill(0..size);
            return Ok(KeptLog {
                samples: samples(&path, &gaps),
                gaps,
                file: Some(path.display().to_string()),
            });
        }
        let gaps = paths.missing(size).unwrap_or_else(|| GapMap::new(size));
        Ok(KeptLog {
            samples: samples(&paths.part, &gaps),
            gaps,
            file: None,
        })
    }

    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text> {
        let write = || {
            let paths = self.paths(log);
            let mut options = OpenOptions::new();
            let options = options.create(true).truncate(false).write(true);
            let written = sharing::open(options, &paths.part).and_then(|mut file| {
                for stretch in bytes {
                    file.seek(SeekFrom::Start(u64::from(stretch.at)))?;
                    file.write_all(&stretch.bytes)?;
                }
                // The list of gaps must not be ahead of the bytes, even if the power fails.
                file.sync_data()
            });
            written.map_err(|error| unwritable(&paths.part, error))?;
            write_gaps(&paths.gaps, gaps).map_err(|error| unwritable(&paths.gaps, error))
        };
        write().map_err(|error: StoreError| Text::from(&error))
    }

    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text> {
        let paths = self.paths(log);
        let mut sum = FtpChecksum::default();
        let summed = File::open(&paths.part).and_then(|file| {
            let mut file = file.take(u64::from(log.log.size));
            let mut block = vec![0; BLOCK];
            loop {
                match file.read(&mut block)? {
                    0 => return Ok(()),
                    len => sum.add(&block[..len]),
                }
            }
        });
        summed.map_err(|error| Text::from(&unreadable(&paths.part, error)))?;
        Ok(sum.value())
    }

    fn finish(&self, log: &VehicleLog) -> Result<String, Text> {
        let paths = self.paths(log);
        let unwritable = |path: &Path, error| Text::from(&unwritable(path, error));
        let mut options = OpenOptions::new();
        let options = options.create(true).truncate(false).write(true);
        let sized = sharing::open(options, &paths.part).and_then(|file| {
            // Removes bytes beyond the end, which a longer log with that number has left.
            if file.metadata()?.len() > u64::from(log.log.size) {
                file.set_len(u64::from(log.log.size))?;
            }
            file.sync_all()?;
            Ok(file.metadata()?.len())
        });
        let bytes = sized.map_err(|error| unwritable(&paths.part, error))?;
        if bytes != u64::from(log.log.size) {
            drop(fs::remove_file(&paths.gaps));
            return Err(text!(
                "outcome-log-length",
                file = paths.part.display().to_string(),
                bytes = bytes,
                expected = log.log.size
            ));
        }
        for path in paths.names() {
            match give_new_name(&paths.part, &path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                named => named.map_err(|error| unwritable(&path, error))?,
            }
            drop(fs::remove_file(&paths.part));
            drop(fs::remove_file(&paths.gaps));
            return Ok(path.display().to_string());
        }
        let error = io::ErrorKind::AlreadyExists.into();
        Err(unwritable(&paths.name, error))
    }
}

/// Some of the stored bytes: the last ones before each gap and before the end, where logs of one vehicle differ. If
/// there are many gaps, only some are used.
fn samples(path: &Path, gaps: &GapMap) -> Vec<FileBytes> {
    let ends = gaps.missing().iter().map(|gap| gap.start);
    let starts = iter::once(0).chain(gaps.missing().iter().map(|gap| gap.end));
    let kept = starts.zip(ends.chain([gaps.size()]));
    let kept: Vec<_> = kept.filter(|(start, end)| start < end).collect();
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

fn write_gaps(path: &Path, gaps: &GapMap) -> io::Result<()> {
    let lines = gaps.missing().iter();
    let lines: Vec<String> = lines
        .map(|gap| format!("{}-{}\n", gap.start, gap.end))
        .collect();
    let text = format!("bytes {}\n{}", gaps.size(), lines.concat());
    let part = path.with_extension("gaps.new");
    let mut options = OpenOptions::new();
    let options = options.create(true).truncate(true).write(true);
    sharing::open(options, &part)?.write_all(text.as_bytes())?;
    fs::rename(&part, path)
}

fn unreadable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unreadable { path, error }
}

fn unwritable(path: &Path, error: io::Error) -> StoreError {
    let path = path.to_owned();
    StoreError::Unwritable { path, error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::ListedLog;

    fn log(size: u32) -> VehicleLog {
        let log = ListedLog {
            number: 2,
            size,
            time_utc_s: 1_767_225_645,
        };
        VehicleLog {
            vehicle: 3,
            log,
            folder: None,
        }
    }

    fn bytes(at: u32, len: usize) -> FileBytes {
        let bytes = (0..len).map(|it| (it + at as usize) as u8).collect();
        FileBytes { at, bytes }
    }

    #[test]
    fn a_part_is_gone_on_with_and_becomes_the_file() {
        let data = tempfile::tempdir().expect("a folder");
        let folder = LogFolder::within(data.path());
        let log = log(2000);
        let kept = folder.find(&log).expect("it can be kept");
        assert_eq!(
            (kept.gaps.missing_bytes(), kept.samples, kept.file),
            (2000, Vec::new(), None)
        );
        let mut gaps = kept.gaps;
        for stretch in [bytes(0, 900), bytes(1000, 500)] {
            gaps.fill(stretch.range());
            folder.keep(&log, &[stretch], &gaps).expect("written");
        }
        let again = folder.find(&log).expect("it can be kept");
        assert_eq!(again.gaps.missing(), [900..1000, 1500..2000]);
        // The end of each stored range, the last one first.
        assert_eq!(again.samples, [bytes(1000, 500), bytes(180, 720)]);
        let rest = [bytes(900, 100), bytes(1500, 500)];
        for stretch in &rest {
            gaps.fill(stretch.range());
        }
        folder.keep(&log, &rest, &gaps).expect("written");
        let mut sum = FtpChecksum::default();
        sum.add(&bytes(0, 2000).bytes);
        assert_eq!(folder.checksum(&log), Ok(sum.value()));
        let path = folder.finish(&log).expect("it is whole");
        assert!(
            path.ends_with("logs/v3-log2-2026-01-01T00-00-45Z.bin"),
            "{path}"
        );
        assert_eq!(fs::read(&path).expect("there"), bytes(0, 2000).bytes);
        let known = folder.find(&log).expect("it can be kept");
        assert!(known.gaps.is_complete());
        assert_eq!(
            (known.file, known.samples),
            (Some(path), vec![bytes(1280, 720)])
        );
        assert_eq!(
            fs::read_dir(data.path().join("logs"))
                .expect("there")
                .count(),
            1
        );
    }

    #[test]
    fn a_file_that_is_too_short_gets_no_name_and_another_log_no_ones_place() {
        let data = tempfile::tempdir().expect("a folder");
        let folder = LogFolder::within(data.path());
        let log = log(100);
        folder.find(&log).expect("it can be kept");
        let mut gaps = GapMap::new(100);
        gaps.fill(0..50);
        folder.keep(&log, &[bytes(0, 50)], &gaps).expect("written");
        folder.finish(&log).expect_err("half is missing");
        for expected in ["45Z.bin", "45Z-2.bin"] {
            gaps.fill(0..100);
            folder.keep(&log, &[bytes(0, 100)], &gaps).expect("written");
            let path = folder.finish(&log).expect("it is whole");
            assert!(path.ends_with(expected), "{path}");
        }
    }

    #[test]
    fn a_part_with_a_gap_in_the_common_header_is_compared_behind_it() {
        let data = tempfile::tempdir().expect("a folder");
        let folder = LogFolder::within(data.path());
        let log = log(50_000);
        folder.find(&log).expect("it can be kept");
        let mut gaps = GapMap::new(50_000);
        for stretch in [bytes(0, 90), bytes(180, 39_820)] {
            gaps.fill(stretch.range());
            folder.keep(&log, &[stretch], &gaps).expect("written");
        }
        let known = folder.find(&log).expect("it can be kept");
        assert_eq!(known.gaps.missing(), [90..180, 40_000..50_000]);
        assert_eq!(known.samples, [bytes(39_280, 720), bytes(0, 90)]);
    }

    #[test]
    fn links_and_fifos_in_place_of_a_part_are_refused() {
        let data = tempfile::tempdir().expect("a folder");
        let folder = LogFolder::within(data.path());
        let logs = data.path().join("logs");
        fs::create_dir(&logs).expect("made");
        for name in ["v3-log2.bin.part", "v3-log2.bin.gaps"] {
            let path = logs.join(name);
            nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).expect("made");
            let fault = folder.find(&log(100)).expect_err("a FIFO");
            assert!(fault.to_string().contains("regular file"), "{fault}");
            fs::remove_file(&path).expect("removed");
            std::os::unix::fs::symlink("elsewhere", &path).expect("made");
            folder.find(&log(100)).expect_err("a link");
            fs::remove_file(&path).expect("removed");
        }
        folder.find(&log(100)).expect("it can be kept");
    }

    #[test]
    fn a_folder_that_the_user_names_keeps_its_mode() {
        use std::os::unix::fs::PermissionsExt as _;

        let data = tempfile::tempdir().expect("a folder");
        let shared = fs::Permissions::from_mode(0o2750);
        fs::set_permissions(data.path(), shared).expect("ours");
        let named = data.path().join("named");
        fs::create_dir(&named).expect("made");
        fs::set_permissions(&named, fs::Permissions::from_mode(0o700)).expect("ours");
        let folder = LogFolder::within(data.path());
        let log = VehicleLog {
            folder: Some(named.display().to_string()),
            ..log(100)
        };
        folder.find(&log).expect("it can be kept");
        let mode = fs::metadata(&named).expect("there").permissions().mode();
        assert_eq!(mode & 0o7777, 0o700);
    }

    #[test]
    fn gaps_that_make_no_sense_are_left_alone() {
        let data = tempfile::tempdir().expect("a folder");
        let folder = LogFolder::within(data.path());
        let log = log(100);
        folder.find(&log).expect("it can be kept");
        let mut gaps = GapMap::new(100);
        gaps.fill(0..50);
        folder.keep(&log, &[bytes(0, 50)], &gaps).expect("written");
        let path = data.path().join("logs/v3-log2.bin.gaps");
        for text in [
            "",
            "bytes 100\n50",
            "bytes 100\n70-60\n",
            "bytes 200\n50-200\n",
            "\u{fffd}",
        ] {
            fs::write(&path, text).expect("written");
            let kept = folder.find(&log).expect("it can be kept");
            assert_eq!(kept.gaps, GapMap::new(100), "{text:?}");
        }
    }
}
