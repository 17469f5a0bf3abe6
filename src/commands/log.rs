//! Commands about the `DataFlash` logs that a vehicle keeps of its flights.

/// What is to be done with a vehicle's logs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LogCommand {
    List,
    /// End the orders about logs; what was read of a log stays.
    Stop,
    /// Copy logs from the vehicle into files.
    Download {
        which: LogChoice,
        /// Where the files go, as the user wrote it; by default the folder for logs.
        folder: Option<String>,
    },
}

/// Which logs of a vehicle are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogChoice {
    /// That of the last flight.
    Last,
    All,
    /// The log of this number in the vehicle's list.
    Number(u16),
}
