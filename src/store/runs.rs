//! Recorded runs: a file each, for their trainee's eyes only.
//!
//! A file is called after the time and the mission, so that the tries at a mission are found without opening the
//! others. What is written comes in whole lines; a crash loses what was not yet written and nothing else.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead as _, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::mission::record::{End, Head};
use crate::scoring::TryReport;

/// How a run's file ends.
const ENDING: &str = ".run.jsonl";
/// Runs that are kept; the oldest go first.
const RUNS_KEPT: usize = 300;
/// Bytes that they may take together.
const BYTES_KEPT: u64 = 256 * 1024 * 1024;
/// A run longer than this is none of ours.
const LARGEST_RUN: u64 = 64 * 1024 * 1024;
/// The head with the mission's text is no longer than this, and the end no longer than that.
const HEAD_LEN: u64 = 2 * 1024 * 1024;
const TAIL_LEN: u64 = 16 * 1024;

/// A folder of recorded runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Runs {
    folder: PathBuf,
}

/// A run that is being recorded.
#[derive(Debug)]
pub struct RunFile {
    file: File,
    path: PathBuf,
}

impl Runs {
    /// The runs in the program's folder for data.
    pub fn within(data: &Path) -> Self {
        Self::at(data.join("runs"))
    }

    /// The runs in a folder, which need not exist.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: folder.into(),
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Begins the file of a run; makes room for it. `when` is the time of day in UTC, as [`utc`] writes it.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn begin(&self, mission: &str, when: &str) -> io::Result<RunFile> {
        fs::DirBuilder::new()
            .recursive(true)
            .mode(0o700)
            .create(&self.folder)?;
        self.make_room();
        let when = when.replace(':', "-");
        let process = std::process::id();
        // Two tries in one second, or of two consoles, get names of their own.
        for number in 0..100 {
            let name = format!("{when}_{mission}_{process}-{number:02}{ENDING}");
            let path = self.folder.join(name);
            let mut private = OpenOptions::new();
            private.create_new(true).append(true).mode(0o600);
            match private.open(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                opened => return opened.map(|file| RunFile { file, path }),
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    /// The tries at a mission, oldest first. Only the first and the last line of each file are read; one that cannot
    /// be read is left out.
    pub fn tries(&self, mission: &str) -> Vec<TryReport> {
        let part = format!("_{mission}_");
        let files = self.files();
        let of_it = files.iter().filter(|path| {
            let name = path.file_name().unwrap_or_default();
            name.to_string_lossy().contains(&part)
        });
        let tries = of_it.filter_map(|path| outline(path).ok());
        let tries = tries.filter(|(head, _)| head.mission == mission);
        tries.map(|(head, end)| as_try(&head, end)).collect()
    }

    /// The tries at all missions, by the mission's id, oldest first; as [`tries`](Self::tries) reads them.
    pub fn all_tries(&self) -> BTreeMap<String, Vec<TryReport>> {
        let mut tries: BTreeMap<String, Vec<TryReport>> = BTreeMap::new();
        for (head, end) in self.files().iter().filter_map(|path| outline(path).ok()) {
            let one = as_try(&head, end);
            tries.entry(head.mission).or_default().push(one);
        }
        tries
    }

    /// The run that began last.
    pub fn newest(&self) -> Option<PathBuf> {
        self.files().pop()
    }

    /// The files, oldest first.
    fn files(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut files: Vec<PathBuf> = entries
            .map(|entry| entry.path())
            .filter(|path| path.to_string_lossy().ends_with(ENDING))
            .collect();
        files.sort();
        files
    }

    /// Removes the oldest runs, as far as there are too many.
    fn make_room(&self) {
        let mut kept = (0, 0);
        for path in self.files().into_iter().rev() {
            let len = fs::metadata(&path).map_or(0, |file| file.len());
            kept = (kept.0 + 1, kept.1 + len);
            if kept.0 >= RUNS_KEPT || kept.1 > BYTES_KEPT {
                // What cannot be removed stays; the new run is worth more than the order.
                drop(fs::remove_file(path));
            }
        }
    }
}

impl RunFile {
    /// Adds whole lines.
    ///
    /// # Errors
    /// The disk is full or gone.
    pub fn append(&mut self, lines: &str) -> io::Result<()> {
        self.file.write_all(lines.as_bytes())
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Reads a run. What is not UTF-8 in it is damage that the record finds.
///
/// # Errors
/// It cannot be read, or is too long to be a run.
pub fn read_run(path: &Path) -> io::Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(LARGEST_RUN + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST_RUN {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "it is too long to be a recorded run",
        ));
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A time of day in UTC: `2026-11-20T14:03:22Z`. Times before 1970 become its first second.
pub fn utc(time: SystemTime) -> String {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    let (days, seconds) = (since.as_secs() / 86_400, since.as_secs() % 86_400);
    let (year, month, day) = date(days);
    let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// The date of a day since 1970 in the Gregorian calendar, counted in years that begin in March, so that the leap
/// day is the last one (Hinnant's `civil_from_days`).
fn date(days: u64) -> (u64, u64, u64) {
    let day = days + 719_468;
    let (era, of_era) = (day / 146_097, day % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    (year + era * 400 + u64::from(month <= 2), month, day)
}

/// The first line of a run, and the last one if it is its end.
fn outline(path: &Path) -> io::Result<(Head, Option<End>)> {
    let mut file = File::open(path)?;
    let mut first = Vec::new();
    BufReader::new((&file).take(HEAD_LEN)).read_until(b'\n', &mut first)?;
    let head = serde_json::from_slice(&first)?;
    let len = file.metadata()?.len();
    file.seek(SeekFrom::Start(len.saturating_sub(TAIL_LEN)))?;
    let mut tail = Vec::new();
    file.take(TAIL_LEN).read_to_end(&mut tail)?;
    let last = tail.trim_ascii_end().rsplit(|byte| *byte == b'\n').next();
    Ok((head, End::of_line(last.unwrap_or_default())))
}

fn as_try(head: &Head, end: Option<End>) -> TryReport {
    TryReport {
        attempt: head.attempt,
        when: head.when.clone(),
        score: end.as_ref().map(|end| end.score),
        medal: end.as_ref().and_then(|end| end.medal),
        passed: end.as_ref().is_some_and(|end| end.passed),
        seed: head.seed,
        revision: head.revision,
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    const HEAD: &str = "{\"sortie_run\":1,\"mission\":\"01-a\",\"revision\":2,\"seed\":5,\"attempt\":1,\
        \"backend\":\"embedded\",\"when\":\"2026-11-20T14:03:22Z\",\"program\":\"0\",\"source\":\"\"}\n";
    const END: &str = "{\"end\":{\"t\":100,\"end\":{\"score\":812,\"medal\":\"silver\",\"passed\":true,\
        \"sim_time_s\":0.1}}}\n";

    #[test]
    fn the_tries_at_a_mission_are_told_by_first_and_last_lines() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let runs = Runs::within(&folder.path().join("data"));
        assert!(runs.tries("01-a").is_empty() && runs.newest().is_none());
        for end in [END, "{\"tick\":{\"t\":"] {
            let mut run = runs.begin("01-a", "2026-11-20T14:03:22Z").expect("created");
            run.append(HEAD).expect("written");
            run.append(end).expect("written");
        }
        let all = runs.all_tries();
        assert_eq!(all.keys().collect::<Vec<_>>(), ["01-a"]);
        assert_eq!(all["01-a"], runs.tries("01-a"));
        let run = runs.begin("01-b", "2026-11-20T14:03:23Z").expect("created");
        let mode = fs::metadata(run.path())
            .expect("there")
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o600);
        assert_eq!(runs.newest().as_deref(), Some(run.path()));
        let tries = runs.tries("01-a");
        let scores: Vec<Option<u16>> = tries.iter().map(|one| one.score).collect();
        assert_eq!(scores, [Some(812), None]);
        assert_eq!(
            (tries[0].seed, tries[0].revision, tries[0].passed),
            (5, 2, true)
        );
    }

    #[test]
    fn the_oldest_runs_make_room() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let runs = Runs::at(folder.path());
        for number in 0..RUNS_KEPT + 5 {
            let when = format!("2026-11-20T14:{:02}:{:02}Z", number / 60, number % 60);
            drop(runs.begin("01-a", &when).expect("created"));
        }
        assert_eq!(runs.files().len(), RUNS_KEPT);
        assert!(runs.files()[0].to_string_lossy().contains("14-00-05Z"));
    }

    #[test]
    fn a_time_of_day_is_written_in_utc() {
        for (seconds, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_795_183_402, "2026-11-20T14:03:22Z"),
            (4_107_542_399, "2100-02-28T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            let time = UNIX_EPOCH + Duration::from_secs(seconds);
            assert_eq!(utc(time), expected);
        }
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_an_error_and_nothing_worse() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        fs::write(&file, "x").expect("written");
        assert!(Runs::at(file.join("runs")).begin("01-a", "x").is_err());
        assert!(Runs::at(&file).tries("01-a").is_empty());
    }
}
