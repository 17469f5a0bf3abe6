//! Recorded runs, one file each, readable by anyone who can read their folder.
//!
//! A file's name contains the time and the mission, so the attempts at a mission are found without
//! opening the other files. Only complete lines are written, even when the disk is full; a crash
//! loses only the lines not yet written. Only files with such names are ever removed, and only in
//! the program's own folder.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, BufRead as _, BufReader, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use chrono::{DateTime, NaiveDateTime};
use sha2::{Digest as _, Sha256};

use super::append::{AppendFile, is_written};
use super::signature::signature_of;
use super::{StoreError, sharing};
use crate::campaign::is_practice;
use crate::class::{RecordHead, RecordName};
use crate::mission::Stake;
use crate::mission::record::{End, Head, is_recall};
use crate::scoring::TryReport;

/// The format of a date and time in UTC: `2026-11-20T14:03:22Z`.
const MOMENT: &str = "%Y-%m-%dT%H:%M:%SZ";
/// The suffix of a run's file.
pub(super) const ENDING: &str = ".run.jsonl";
/// The suffix of the inputs of a run's simulated vehicles.
pub(super) const INPUTS: &str = ".inputs.jsonl";
/// The pattern of the timestamp at the beginning of a run's file name, with any digits.
const STAMP: &str = "0000-00-00T00-00-00Z_";
/// The maximum number of runs; the oldest are removed first.
const RUNS_KEPT: usize = 300;
/// The maximum size of all runs, in bytes.
const BYTES_KEPT: u64 = 256 * 1024 * 1024;
const LARGEST_RUN: u64 = 64 * 1024 * 1024;
/// The maximum sizes of the head with the mission's text and of the end, in bytes.
const HEAD_LEN: u64 = 2 * 1024 * 1024;
const TAIL_LEN: u64 = 16 * 1024;

/// A folder of recorded runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Runs {
    folder: PathBuf,
    /// Whether old runs are removed to make room for new ones.
    is_bounded: bool,
}

/// A run that is being recorded.
#[derive(Debug)]
pub struct RunFile {
    file: AppendFile,
    /// The hash of all that was written.
    hash: Sha256,
}

impl Runs {
    /// The runs in the program's data folder: the newest 300, limited to 256 MiB in total.
    pub fn within(data: &Path) -> Self {
        Self {
            folder: data.join(super::RUNS),
            is_bounded: true,
        }
    }

    /// The runs in a folder that the user named, which need not exist; nothing in it is removed.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: folder.into(),
            is_bounded: false,
        }
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Creates the file of a run, after making room. `when` is the date and time in UTC, in the
    /// format of [`utc`].
    ///
    /// # Errors
    /// The file cannot be created.
    pub fn begin(&self, mission: &str, when: &str) -> Result<RunFile, StoreError> {
        let unwritable = |path: &Path, error| StoreError::Unwritable {
            path: path.to_owned(),
            error,
        };
        let made = match self.folder.parent() {
            Some(data) if self.is_bounded => sharing::folder_within(data, &self.folder),
            _ => sharing::private_folder(&self.folder),
        };
        made.map_err(|error| unwritable(&self.folder, error))?;
        if self.is_bounded {
            self.make_room();
        }
        let when = when.replace(':', "-");
        let process = std::process::id();
        // Two attempts in one second, or of two consoles, get different names.
        for number in 0..100 {
            let name = format!("{when}_{mission}_{process}-{number:02}{ENDING}");
            if let Some(file) = AppendFile::create(self.folder.join(name))? {
                return Ok(RunFile {
                    file,
                    hash: Sha256::new(),
                });
            }
        }
        Err(unwritable(
            &self.folder,
            io::ErrorKind::AlreadyExists.into(),
        ))
    }

    /// The comparable attempts of a profile, or of guests, at a revision of a mission, oldest first. Only the first
    /// and the last line of each file are read; unreadable ones are left out.
    pub fn tries_at(&self, whose: Option<&str>, mission: &str, revision: u32) -> Vec<TryReport> {
        let part = format!("_{mission}_");
        let of_it = |path: &Path| {
            let name = path.file_name().unwrap_or_default();
            name.to_string_lossy().contains(&part)
        };
        let mut tries = self.tries(whose, of_it).remove(mission).unwrap_or_default();
        tries.retain(|one| one.revision == revision);
        tries
    }

    /// The attempts at all missions, by the mission's id, oldest first; read as by [`tries_at`](Self::tries_at).
    pub fn all_tries(&self, whose: Option<&str>) -> BTreeMap<String, Vec<TryReport>> {
        self.tries(whose, |_| true)
    }

    fn tries(
        &self,
        whose: Option<&str>,
        wanted: impl Fn(&Path) -> bool,
    ) -> BTreeMap<String, Vec<TryReport>> {
        let mut tries: BTreeMap<String, Vec<TryReport>> = BTreeMap::new();
        let files = self.files().into_iter().filter(|path| wanted(path));
        // A flight under way is not an attempt yet.
        let outlines = files.filter_map(|path| {
            let (head, end) = outline(&path).ok()?;
            (end.is_some() || !is_written(&path)).then_some((head, end))
        });
        for (head, end) in outlines.filter(|(head, _)| head.profile.as_deref() == whose) {
            let one = as_try(&head, end.as_ref());
            tries.entry(head.mission).or_default().push(one);
        }
        tries
    }

    /// The run with the highest score at a revision of a mission, of one profile; `whose` is its name, or `None` for
    /// runs without a profile. Practice and the run called `except` are left out.
    pub fn best(
        &self,
        whose: Option<&str>,
        mission: &str,
        revision: u32,
        except: Option<&str>,
    ) -> Option<PathBuf> {
        let files = self.files().into_iter();
        let others = files.filter(|path| Some(run_id(path)) != except);
        let scored = others.filter_map(|path| {
            let (head, end) = outline(&path).ok()?;
            let is_meant = head.profile.as_deref() == whose
                && head.mission == mission
                && head.revision == revision;
            let one = as_try(&head, end.as_ref());
            let score = one.score.filter(|_| is_meant && !one.is_practice)?;
            Some((score, path))
        });
        scored.max_by_key(|(score, _)| *score).map(|(_, path)| path)
    }

    /// Whether a flight of this mission with this seed is under way: its world must stay hidden from everyone.
    pub fn is_flown_now(&self, mission: &str, seed: u64) -> bool {
        let mut written = self.files().into_iter().filter(|path| is_written(path));
        written.any(|path| {
            outline(&path).is_ok_and(|(head, end)| {
                end.is_none() && head.mission == mission && head.seed == seed
            })
        })
    }

    pub fn newest(&self) -> Option<PathBuf> {
        self.files().pop()
    }

    /// The files of runs whose ids are not among these, oldest first.
    pub(super) fn others(&self, known: &BTreeSet<String>) -> Vec<PathBuf> {
        let mut files = self.files();
        files.retain(|path| !known.contains(run_id(path)));
        files
    }

    /// The files, oldest first.
    fn files(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut files: Vec<PathBuf> = entries
            .map(|entry| entry.path())
            .filter(|path| is_run(path))
            .collect();
        files.sort();
        files
    }

    /// Removes the oldest runs above the limits; the newest stays whatever its size.
    fn make_room(&self) {
        let mut bytes = 0;
        for (newer, path) in self.files().into_iter().rev().enumerate() {
            let len = |path: &Path| fs::metadata(path).map_or(0, |file| file.len());
            bytes += len(&path) + len(&inputs_of(&path));
            let is_too_much = newer + 1 >= RUNS_KEPT || bytes > BYTES_KEPT;
            if newer > 0 && is_too_much {
                // A file that cannot be removed stays; the new run is more important.
                for path in [inputs_of(&path), path] {
                    drop(fs::remove_file(signature_of(&path)));
                    drop(fs::remove_file(path));
                }
            }
        }
    }
}

impl RunFile {
    /// Appends whole lines. On failure the earlier lines stay; an empty file is removed.
    ///
    /// # Errors
    /// The disk is full or unavailable.
    pub fn append(&mut self, lines: &str) -> Result<(), StoreError> {
        self.file.append(lines.as_bytes())?;
        self.hash.update(lines);
        Ok(())
    }

    pub fn path(&self) -> &Path {
        self.file.path()
    }

    /// How far the file has grown; `None` if its name is no name of a record.
    pub fn head(&self) -> Option<RecordHead> {
        Some(RecordHead {
            record: RecordName::try_from(self.id().to_owned()).ok()?,
            bytes: self.file.len(),
            sha256: <[u8; 32]>::from(self.hash.clone().finalize()).into(),
        })
    }

    /// Removes the file, and that of the inputs. If that fails, they stay as a flight without an
    /// end.
    pub fn discard(self) {
        drop(fs::remove_file(inputs_of(self.path())));
        drop(fs::remove_file(self.path()));
    }

    /// The run's unique id: the file's name without its suffix.
    pub fn id(&self) -> &str {
        run_id(self.file.path())
    }
}

fn inputs_of(run: &Path) -> PathBuf {
    run.with_file_name(format!("{}{INPUTS}", run_id(run)))
}

/// The id of a run, from its path.
pub(super) fn run_id(path: &Path) -> &str {
    let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
    name.strip_suffix(ENDING).unwrap_or(name)
}

/// Whether a file has the name of a run.
fn is_run(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut stamp = name.bytes().zip(STAMP.bytes());
    let fits = |(found, form): (u8, u8)| found == form || (form == b'0' && found.is_ascii_digit());
    name.len() > STAMP.len() && stamp.all(fits) && name.ends_with(ENDING)
}

/// Reads a run. Invalid UTF-8 counts as damage of the record.
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

/// A date and time in UTC: `2026-11-20T14:03:22Z`. Times before 1970 become the start of 1970.
pub fn utc(time: SystemTime) -> String {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
    let seconds = i64::try_from(since.as_secs()).ok();
    let moment = seconds.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
    moment.unwrap_or_default().format(MOMENT).to_string()
}

/// Whether a text is a date and time in the format of [`utc`].
pub(super) fn is_moment(text: &str) -> bool {
    moment(text).is_some()
}

/// Parses a date and time in the format of [`utc`]; `None` for anything else.
pub(super) fn moment(text: &str) -> Option<SystemTime> {
    let time = NaiveDateTime::parse_from_str(text, MOMENT).ok()?;
    let is_ours = time.format(MOMENT).to_string() == text;
    let seconds = u64::try_from(time.and_utc().timestamp()).ok()?;
    is_ours.then(|| UNIX_EPOCH + Duration::from_secs(seconds))
}

/// The first line of a run, and its last line if that ends the run.
pub(super) fn outline(path: &Path) -> io::Result<(Head, Option<End>)> {
    let file = File::open(path)?;
    let mut first = Vec::new();
    BufReader::new((&file).take(HEAD_LEN)).read_until(b'\n', &mut first)?;
    let mut head: Head = serde_json::from_slice(&first)?;
    let last = last_line_of(file)?;
    if is_recall(&last) {
        head.stake = Stake::Practice;
    }
    Ok((head, End::of_line(&last)))
}

/// The last line of a file, without its line end.
pub(super) fn last_line(path: &Path) -> io::Result<Vec<u8>> {
    last_line_of(File::open(path)?)
}

fn last_line_of(mut file: File) -> io::Result<Vec<u8>> {
    let len = file.metadata()?.len();
    file.seek(SeekFrom::Start(len.saturating_sub(TAIL_LEN)))?;
    let mut tail = Vec::new();
    file.take(TAIL_LEN).read_to_end(&mut tail)?;
    let last = tail.trim_ascii_end().rsplit(|byte| *byte == b'\n').next();
    Ok(last.unwrap_or_default().to_vec())
}

fn as_try(head: &Head, end: Option<&End>) -> TryReport {
    TryReport {
        attempt: head.attempt,
        when: head.when.clone(),
        score: end.map(|end| end.score),
        medal: end.and_then(|end| end.medal),
        passed: end.is_some_and(|end| end.passed),
        seed: head.seed,
        revision: head.revision,
        is_practice: is_practice(head.stake, head.flown_by),
    }
}

#[cfg(test)]
mod tests;
