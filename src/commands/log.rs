//! Commands about the `DataFlash` logs that a vehicle keeps of its flights.

use strum::{EnumString, VariantNames};

/// A command about a vehicle's logs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LogCommand {
    List,
    /// Cancel all log commands; the parts of a log that were read are kept.
    Stop,
    /// Copy logs from the vehicle into files.
    Download {
        which: LogChoice,
        /// The folder for the files, as the user wrote it; `None` for the default folder.
        folder: Option<String>,
    },
}

/// A choice among a vehicle's logs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogChoice {
    Group(LogGroup),
    /// The log with this number in the vehicle's list.
    Number(u16),
}

/// Logs that are chosen without their number. The names are those of the command line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "snake_case")]
pub enum LogGroup {
    /// The log of the last flight.
    #[default]
    Last,
    All,
}
