//! The files in which a vehicle stores its logs, for vehicles that offer files (MAVFTP).

use std::collections::BTreeMap;

use super::ListedLog;
use crate::session::ftp::{FtpClient, FtpEntry, FtpEvent, FtpFault, FtpTask, FtpTicket};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// The folders where `ArduPilot` stores logs: in SITL, and on boards.
const FOLDERS: [&str; 2] = ["logs", "/APM/LOGS"];
/// The bit `MAV_PROTOCOL_CAPABILITY_FTP`: the vehicle offers files.
const CAPABILITY: u64 = 32;

/// Whether a vehicle announces that it offers files.
pub(in crate::session) fn hands_out_files(vehicle: &Vehicle) -> bool {
    let version = vehicle.version.as_ref();
    version.is_some_and(|version| version.capabilities & CAPABILITY != 0)
}

/// The search for the files of listed logs.
#[derive(Debug, Clone)]
pub(super) struct FileSearch {
    logs: Vec<ListedLog>,
    folder: usize,
    ticket: FtpTicket,
    /// Whether a folder was listed that does not contain these logs.
    is_other: bool,
    /// The files found, or why there are none.
    found: Option<LogFiles>,
}

/// The paths of a vehicle's log files, for MAVFTP.
#[derive(Debug, Clone, Default)]
pub(super) struct LogFiles {
    /// Paths by the number of the log in the vehicle's list.
    paths: BTreeMap<u16, String>,
    /// Why a log has no file; `None` if the vehicle offers no files.
    reason: Option<Text>,
}

impl LogFiles {
    /// The result that no log has a file.
    pub fn none(reason: Text) -> Self {
        Self {
            paths: BTreeMap::new(),
            reason: Some(reason),
        }
    }

    /// The path of a log's file.
    ///
    /// # Errors
    /// Why it has no file; `None` if the vehicle offers no files.
    pub fn path(&self, log: u16) -> Result<&str, Option<Text>> {
        let path = self.paths.get(&log);
        path.map(String::as_str).ok_or_else(|| self.reason.clone())
    }
}

impl FileSearch {
    pub fn new(logs: Vec<ListedLog>, ftp: &mut FtpClient) -> Self {
        Self {
            ticket: ask(FOLDERS[0], ftp),
            logs,
            folder: 0,
            is_other: false,
            found: None,
        }
    }

    pub fn ticket(&self) -> FtpTicket {
        self.ticket
    }

    /// Handles the answer for the requested folder, and requests the next one.
    pub fn receive(&mut self, event: FtpEvent, ftp: &mut FtpClient) {
        let folder = FOLDERS[self.folder];
        let fault = match event {
            FtpEvent::Listed(entries) => {
                if let Some(paths) = files_of(&self.logs, folder, &entries) {
                    let reason = Some(text!("outcome-log-no-file"));
                    self.found = Some(LogFiles { paths, reason });
                    return;
                }
                self.is_other = true;
                None
            }
            FtpEvent::Failed(fault) => Some(fault),
            FtpEvent::Opened(_)
            | FtpEvent::Done
            | FtpEvent::Bytes(_)
            | FtpEvent::Complete(_)
            | FtpEvent::Checksum(_)
            | FtpEvent::Wrote(_)
            | FtpEvent::Written => return,
        };
        if self.folder + 1 < FOLDERS.len() && fault != Some(FtpFault::Silent) {
            self.folder += 1;
            self.ticket = ask(FOLDERS[self.folder], ftp);
            return;
        }
        let reason = match fault {
            Some(fault) if !self.is_other => fault.into(),
            Some(_) | None => text!("outcome-log-no-file"),
        };
        self.found = Some(LogFiles::none(reason));
    }

    /// The logs and their files, once all folders have been requested.
    pub fn finished(&mut self) -> Option<(Vec<ListedLog>, LogFiles)> {
        let files = self.found.take()?;
        Some((std::mem::take(&mut self.logs), files))
    }
}

fn ask(folder: &str, ftp: &mut FtpClient) -> FtpTicket {
    let folder = folder.to_owned();
    ftp.ask(FtpTask::List { folder })
}

/// The paths of the logs whose files have the listed size; `None` if the folder does not contain
/// these logs.
///
/// A vehicle lists its logs from 1, the oldest first, but their files keep their numbers. File
/// numbers wrap around at some point, so the oldest file is not always the one with the lowest
/// number. The newest file may have grown since.
fn files_of(
    logs: &[ListedLog],
    folder: &str,
    entries: &[FtpEntry],
) -> Option<BTreeMap<u16, String>> {
    let mut files: Vec<(u32, &FtpEntry, u32)> = entries
        .iter()
        .filter_map(|entry| {
            let (number, ending) = entry.name.split_once('.')?;
            let is_log = ending.eq_ignore_ascii_case("bin");
            Some((number.parse().ok().filter(|_| is_log)?, entry, entry.size?))
        })
        .collect();
    files.sort_unstable_by_key(|(number, ..)| *number);
    let (newest, older) = logs.split_last()?;
    if files.len() != logs.len() {
        return None;
    }
    let fits = |files: &[(u32, &FtpEntry, u32)]| {
        let same = older
            .iter()
            .zip(files)
            .all(|(log, file)| log.size == file.2);
        same && files.last().is_some_and(|file| file.2 >= newest.size)
    };
    let is_found = (0..files.len()).any(|_| {
        let fits = fits(&files);
        if !fits {
            files.rotate_left(1);
        }
        fits
    });
    let pairs = logs.iter().zip(&files);
    let paths = pairs
        .filter(|(log, file)| log.size == file.2)
        .map(|(log, file)| (log.number, format!("{folder}/{}", file.1.name)));
    is_found.then(|| paths.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logs(sizes: &[u32]) -> Vec<ListedLog> {
        let numbered = (1..).zip(sizes);
        let log = |(number, size): (u16, &u32)| ListedLog {
            number,
            size: *size,
            time_utc_s: 0,
        };
        numbered.map(log).collect()
    }

    fn folder(files: &[(&str, u32)]) -> Vec<FtpEntry> {
        let entry = |(name, size): &(&str, u32)| FtpEntry {
            name: (*name).to_owned(),
            size: Some(*size),
        };
        files.iter().map(entry).collect()
    }

    fn paths(sizes: &[u32], files: &[(&str, u32)]) -> Option<Vec<(u16, String)>> {
        let found = files_of(&logs(sizes), "logs", &folder(files))?;
        Some(found.into_iter().collect())
    }

    #[test]
    fn files_belong_to_logs_by_age_and_size() {
        let log = |number, name: &str| (number, format!("logs/{name}"));
        let files = [
            ("LASTLOG.TXT", 3),
            ("00000008.BIN", 700),
            ("00000007.bin", 500),
            ("notes.BIN", 9),
        ];
        let both = vec![log(1, "00000007.bin"), log(2, "00000008.BIN")];
        assert_eq!(paths(&[500, 700], &files), Some(both));
        // The newest file has grown, so it differs from the listed log.
        let first = vec![log(1, "00000007.bin")];
        assert_eq!(paths(&[500, 600], &files), Some(first));
        // The numbers have wrapped around: the lowest is the newest.
        let files = [
            ("00000001.BIN", 30),
            ("00000499.BIN", 10),
            ("00000500.BIN", 20),
        ];
        let all = vec![
            log(1, "00000499.BIN"),
            log(2, "00000500.BIN"),
            log(3, "00000001.BIN"),
        ];
        assert_eq!(paths(&[10, 20, 30], &files), Some(all));
    }

    #[test]
    fn a_folder_with_other_files_is_not_that_of_the_logs() {
        let files = [("00000001.BIN", 10), ("00000002.BIN", 20)];
        assert_eq!(paths(&[10], &files), None);
        assert_eq!(paths(&[11, 20], &files), None);
        assert_eq!(paths(&[10, 21], &files), None);
        assert_eq!(paths(&[], &[]), None);
    }
}
