//! What a session needs of the files that logs are kept in.

use std::fmt::Debug;

use crate::session::gaps::{FileBytes, GapMap};
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A log as a vehicle lists it (`LOG_ENTRY`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListedLog {
    pub number: u16,
    /// Bytes; a log that is still written grows.
    pub size: u32,
    /// Seconds since 1970 (UTC); 0 where the vehicle does not know.
    pub time_utc_s: u32,
}

/// A log that is downloaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VehicleLog {
    pub vehicle: VehicleId,
    pub log: ListedLog,
    /// Where it is to be kept, as the user wrote it; by default the folder for logs.
    pub folder: Option<String>,
}

/// What is there of a log from an earlier download.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeptLog {
    pub gaps: GapMap,
    /// Some of what is there: the vehicle's bytes must be the same, else the file is of another log.
    pub samples: Vec<FileBytes>,
    /// The file, if it is whole.
    pub file: Option<String>,
}

/// Keeps the logs of vehicles in files.
pub trait LogKeeper: Debug + Send + Sync {
    /// What is there of a log.
    ///
    /// # Errors
    /// In plain words when nothing can be kept there.
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text>;

    /// Keeps bytes, and then what is still missing.
    ///
    /// # Errors
    /// In plain words when they cannot be written.
    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text>;

    /// The check sum of a log that has come whole ([`FtpChecksum`](crate::session::FtpChecksum)).
    ///
    /// # Errors
    /// In plain words when what was kept cannot be read.
    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text>;

    /// Checks the length of a log that has come whole, and gives its file the final name, which is returned.
    ///
    /// # Errors
    /// In plain words when the length is another one, or it cannot be renamed.
    fn finish(&self, log: &VehicleLog) -> Result<String, Text>;
}
