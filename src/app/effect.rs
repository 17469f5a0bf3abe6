//! What the shell has to do.

use crate::campaign::{Aids, Stake};
use crate::commands::{Command, Deed, Manoeuvre};
use crate::language::Verb;
use crate::ledger::EntryId;
use crate::text::{Language, Text};
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// What can be done with the process of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HangarDeed {
    /// It is ended, if it runs, and started again.
    Restart,
    /// It is ended.
    Stop,
}

/// How a mission is to be flown.
#[derive(Debug, Clone, PartialEq)]
pub struct Launch {
    /// Its id.
    pub mission: String,
    /// How the flight counts for a career.
    pub stake: Stake,
    /// The seed, where it is the trainee's choice: for practice.
    pub seed: Option<u64>,
    /// The drones that were built for it, for all seats or one each; without any, the mission lends its own.
    pub fleet: Vec<Design>,
}

impl Launch {
    /// A mission for credits and medals, with its own drones.
    pub fn graded(mission: impl Into<String>) -> Self {
        Self {
            mission: mission.into(),
            stake: Stake::Graded,
            seed: None,
            fleet: Vec::new(),
        }
    }
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
    /// Start a mission.
    StartMission(Launch),
    /// Go on with this profile.
    ChooseProfile(String),
    /// Make a profile of this name, and go on with it.
    CreateProfile(String),
    /// Go on without a profile: nothing that is flown from now on is kept.
    LeaveProfile,
    /// Have so much advice come by itself from now on, and remember it for the trainee.
    SetAids(Aids),
    /// Remember the language of the screens for the trainee.
    SetLanguage(Language),
    /// Buy the right to use a part, by id.
    BuyPart(String),
    /// Keep a design among the trainee's own; it takes the place of one of the same name.
    KeepDesign(Design),
    /// Keep a design of the trainee's own under another name from now on.
    RenameDesign {
        /// The name that it had.
        from: String,
        /// The design with its new name.
        design: Design,
    },
    /// Remove the trainee's own design of this name.
    DropDesign(String),
    /// Read a design file.
    ReadDesign {
        /// Its path, as it was written.
        path: String,
    },
    /// Write a design file.
    WriteDesign {
        /// Its path, as it was written.
        path: String,
        /// What it shall say.
        text: String,
        /// Whether it may take the place of one that is there.
        replace: bool,
    },
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
