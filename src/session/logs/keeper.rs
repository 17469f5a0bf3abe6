//! The interface through which a session stores logs.

use std::fmt::Debug;

use crate::session::gaps::{FileBytes, GapMap};
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A log as a vehicle lists it (`LOG_ENTRY`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListedLog {
    pub number: u16,
    /// The size in bytes; a log that is still being written grows.
    pub size: u32,
    /// Seconds since 1970 (UTC); 0 if the vehicle has no time.
    pub time_utc_s: u32,
}

/// A log to download.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VehicleLog {
    pub vehicle: VehicleId,
    pub log: ListedLog,
    /// The folder to store it in, as the user wrote it; `None` for the default folder.
    pub folder: Option<String>,
}

/// The parts of a log from an earlier download.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeptLog {
    pub gaps: GapMap,
    /// Some of the stored bytes: if the vehicle's bytes differ, the file belongs to another log.
    pub samples: Vec<FileBytes>,
    /// The file, if it is complete.
    pub file: Option<String>,
}

/// Stores the logs of vehicles in files.
pub trait LogKeeper: Debug + Send + Sync {
    /// The parts of a log that are stored already.
    ///
    /// # Errors
    /// The log cannot be stored in its folder.
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text>;

    /// Stores bytes, and then the gaps that remain.
    ///
    /// # Errors
    /// The bytes or the gaps cannot be written.
    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text>;

    /// The checksum of a complete log ([`FtpChecksum`](crate::wire::FtpChecksum)).
    ///
    /// # Errors
    /// The stored bytes cannot be read.
    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text>;

    /// Checks the length of a complete log, and gives its file the final name, which is returned.
    ///
    /// # Errors
    /// The length is wrong, or the file cannot be renamed.
    fn finish(&self, log: &VehicleLog) -> Result<String, Text>;
}
