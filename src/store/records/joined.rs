//! The logs that were joined to records: a small file for each vehicle, next to the record.

use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::{REVIEW, RecordFiles, StoreError, sharing, unwritable};
use crate::dataflash::JoinedLog;
use crate::store::regular::{read_regular, read_regular_text};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The text between the name of a record and the number of a vehicle.
const MARK: &str = ".log-";
const JSON: &str = ".json";
/// The maximum size of a joined log, in bytes.
const LONGEST: u64 = 64 * 1024 * 1024;
/// The maximum size of a log, in bytes.
const LARGEST_LOG: u64 = 2 * 1024 * 1024 * 1024;

impl RecordFiles {
    /// The common beginning of the names of the record's files.
    fn common_name(&self) -> Option<String> {
        let name = self.review.file_name()?.to_str()?;
        name.strip_suffix(REVIEW).map(str::to_owned)
    }

    /// The files of the logs that were joined to the record, by vehicle.
    pub fn joined_paths(&self) -> Vec<PathBuf> {
        let Some(name) = self.common_name() else {
            return Vec::new();
        };
        let folder = self.review.parent().filter(|it| !it.as_os_str().is_empty());
        let entries = fs::read_dir(folder.unwrap_or(Path::new(".")));
        let is_ours = |path: &PathBuf| {
            let file = path.file_name().and_then(|it| it.to_str());
            let rest = file.and_then(|it| it.strip_prefix(&name)?.strip_prefix(MARK));
            rest.and_then(vehicle_of).is_some()
        };
        let entries = entries.into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|it| it.path()).filter(is_ours).collect();
        paths.sort();
        paths
    }

    /// The logs that were joined to the record, and the faults of those that cannot be read.
    pub fn read_joined(&self) -> (Vec<JoinedLog>, Vec<Text>) {
        let (mut logs, mut faults) = (Vec::new(), Vec::new());
        for path in self.joined_paths() {
            let file = path.file_name().and_then(|it| it.to_str());
            let named = file.and_then(|it| vehicle_of(it.rsplit_once(MARK)?.1));
            let read = read_regular_text(&path, LONGEST)
                .map_err(|error| text!("log-join-unreadable", error = error.to_string()))
                .and_then(|text| JoinedLog::read(&text));
            match read {
                Ok(log) if Some(log.vehicle) == named => logs.push(log),
                Ok(log) => faults.push(text!(
                    "log-join-other",
                    file = file.unwrap_or_default(),
                    vehicle = log.vehicle
                )),
                Err(fault) => faults.push(fault),
            }
        }
        (logs, faults)
    }

    /// Stores a log next to the record; the record itself is not changed. An earlier log of the
    /// same vehicle is replaced. Returns the path.
    ///
    /// # Errors
    /// The log cannot be written.
    pub fn write_joined(&self, log: &JoinedLog) -> Result<PathBuf, StoreError> {
        let name = self.common_name().unwrap_or_else(|| self.stem.clone());
        let name = format!("{name}{MARK}{}{JSON}", log.vehicle);
        let path = self.review.with_file_name(name);
        let part = path.with_extension("json.part");
        let write = || {
            let mut options = OpenOptions::new();
            let mut file = sharing::open(options.create(true).truncate(true).write(true), &part)?;
            file.write_all(log.to_json().as_bytes())?;
            file.sync_all()?;
            fs::rename(&part, &path)
        };
        write().map_err(|error| unwritable(&path, error))?;
        Ok(path)
    }

    /// Removes the logs that were joined to the record.
    ///
    /// # Errors
    /// One of the logs cannot be removed.
    pub fn delete_joined(&self) -> Result<(), StoreError> {
        for path in self.joined_paths() {
            fs::remove_file(&path).map_err(|error| unwritable(&path, error))?;
        }
        Ok(())
    }
}

/// The bytes of a log.
///
/// # Errors
/// A text if it cannot be read.
pub fn read_log(path: &Path) -> Result<Vec<u8>, Text> {
    read_regular(path, LARGEST_LOG).map_err(|error| {
        let (file, error) = (path.display().to_string(), Text::from(&error));
        text!("log-unreadable", file = file, error = error)
    })
}

/// The vehicle in the last part of a joined log's name, `3.json`.
fn vehicle_of(rest: &str) -> Option<VehicleId> {
    let number = rest.strip_suffix(JSON)?;
    let vehicle: VehicleId = number.parse().ok()?;
    (vehicle.to_string() == number).then_some(vehicle)
}
