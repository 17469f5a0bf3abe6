//! What the shell has to do.

use crate::commands::{Command, Deed, Manoeuvre};
use crate::language::Verb;
use crate::ledger::EntryId;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// What can be done with the process of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HangarDeed {
    /// It is ended, if it runs, and started again.
    Restart,
    /// It is ended.
    Stop,
}

/// Work for the run loop.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Leave the program.
    Quit,
    /// Give a command to vehicles; the ledger entry is open already.
    Command {
        /// Where the outcome belongs.
        entry: EntryId,
        /// The vehicles, sorted.
        targets: Vec<VehicleId>,
        /// Its row of the verb table: retries and deadline.
        verb: &'static Verb,
        /// What to do.
        command: Command,
    },
    /// Have the mission do something with vehicles; the ledger entry is open already.
    Deed {
        /// Where the outcome belongs.
        entry: EntryId,
        /// The vehicles, sorted.
        targets: Vec<VehicleId>,
        /// What to do.
        deed: Deed,
    },
    /// Have vehicles do something together; the ledger entry is open already.
    Manoeuvre {
        /// Where the outcome belongs.
        entry: EntryId,
        /// The vehicles, sorted.
        targets: Vec<VehicleId>,
        /// What to do.
        manoeuvre: Manoeuvre,
    },
    /// Ask vehicles for all their parameters.
    FetchParameters(Vec<VehicleId>),
    /// Read a parameter file.
    ReadParameters {
        /// Its path, as it was written.
        path: String,
    },
    /// Write a parameter file.
    SaveParameters {
        /// Its path, as it was written.
        path: String,
        /// What it shall say.
        text: String,
        /// Whether it may take the place of one that is there.
        replace: bool,
    },
    /// Start a mission, by id.
    StartMission(String),
    /// Start free flight with simulated vehicles.
    StartFree,
    /// Start free flight with vehicles that ArduPilot's SITL simulates.
    StartArduPilot,
    /// Have the process of a vehicle ended or started again.
    Hangar(HangarDeed, VehicleId),
    /// Connect to vehicles at these addresses.
    Connect(Vec<String>),
    /// End the mission now; its report follows as an event.
    AbandonMission,
    /// Start the same mission again.
    RestartMission {
        /// Whether chance plays the same again.
        alike: bool,
    },
    /// Have something happen in the mission, as its instructor may.
    Inject(String),
    /// Let everything that is simulated stand still, and every deadline with it.
    Pause,
    /// Let it go on.
    GoOn,
    /// Stop what runs and drop its links; the state has forgotten it already.
    LeaveSession,
    /// Draw with this theme from now on, and remember it.
    SetTheme(String),
    /// Draw at most so many frames a second from now on.
    SetFps(u8),
    /// Ring the terminal's bell.
    Bell,
    /// Ask the terminal for a note on the desktop.
    Notify(Text),
}
