//! Work for the shell, grouped by what it concerns.

use std::time::Duration;

use crate::campaign::{Aids, Stake};
use crate::commands::Order;
use crate::language::{GhostSource, ProcessDeed, SeekTarget};
use crate::ledger::EntryId;
use crate::moment::MomentKind;
use crate::review::Review;
use crate::text::{Language, Text};
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// How a mission is to be flown.
#[derive(Debug, Clone, PartialEq)]
pub struct Launch {
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

/// What a file that the user reads or writes holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Parameters of a vehicle.
    Parameters,
    /// A design of the workshop.
    Design,
    /// A review of a flight, as Markdown; it is only written.
    Review,
}

/// Work for the shell.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    Quit,
    /// Carry out an order whose entry in the ledger is open already.
    Order {
        /// Where the outcome belongs.
        entry: EntryId,
        order: Order,
    },
    /// Ask vehicles for all their parameters.
    FetchParameters(Vec<VehicleId>),
    /// Read or write a file of the user.
    File(FileEffect),
    /// Change the profile, or what belongs to it.
    Career(CareerEffect),
    /// Start, steer or end a session.
    Session(SessionEffect),
    /// Steer what is replayed.
    Replay(ReplayEffect),
    /// Change how the terminal shows the console, or call its user.
    Terminal(TerminalEffect),
}

/// What the shell has to do after an event, in this order.
#[derive(Debug, Default, Clone, PartialEq)]
#[must_use = "the shell has to carry the effects out"]
pub struct Effects(Vec<Effect>);

impl Effects {
    pub fn none() -> Self {
        Self::default()
    }

    pub fn into_vec(self) -> Vec<Effect> {
        self.0
    }
}

impl From<Effect> for Effects {
    fn from(effect: Effect) -> Self {
        Self(vec![effect])
    }
}

impl FromIterator<Effect> for Effects {
    fn from_iter<I: IntoIterator<Item = Effect>>(effects: I) -> Self {
        Self(effects.into_iter().collect())
    }
}

impl Extend<Effect> for Effects {
    fn extend<I: IntoIterator<Item = Effect>>(&mut self, effects: I) {
        self.0.extend(effects);
    }
}

impl IntoIterator for Effects {
    type Item = Effect;
    type IntoIter = std::vec::IntoIter<Effect>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

/// A file to read or to write. Paths are as the user wrote them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileEffect {
    Read {
        /// What it should hold.
        kind: FileKind,
        path: String,
    },
    Write {
        kind: FileKind,
        /// Where to write it.
        path: String,
        text: String,
        /// Whether an existing file may be replaced.
        replace: bool,
    },
}

/// A change of the profile in use, or of what is stored with it.
#[derive(Debug, Clone, PartialEq)]
pub enum CareerEffect {
    /// Switch to the profile of this name.
    Choose(String),
    /// Create a profile of this name and switch to it.
    Create(String),
    /// Continue without a profile: flights are not saved.
    Leave,
    /// Store how much advice the trainee wants.
    SetAids(Aids),
    /// Store the language of the screens.
    SetLanguage(Language),
    /// Buy the right to use a part, by id.
    BuyPart(String),
    /// Store a design; it replaces one of the same name.
    KeepDesign(Design),
    /// Store a design under another name.
    RenameDesign {
        /// The name that it had.
        from: String,
        /// The design with its new name.
        design: Design,
    },
    /// Delete the stored design of this name.
    DropDesign(String),
}

/// A change of what is flown.
#[derive(Debug, Clone, PartialEq)]
pub enum SessionEffect {
    StartMission(Launch),
    /// Start free flight with vehicles of the embedded simulator.
    StartFree,
    /// Start free flight with vehicles of ArduPilot's SITL.
    StartArduPilot,
    /// Connect to vehicles at these addresses.
    Connect(Vec<String>),
    /// Close what these vehicles are heard by; one that is heard again is new.
    Forget(Vec<VehicleId>),
    /// Replay a recorded flight.
    Replay {
        /// One of its files; `None` is the newest record.
        path: Option<String>,
        /// Whether to begin with its review.
        review: bool,
    },
    /// Restart or stop the process that simulates a vehicle.
    Process(ProcessDeed, VehicleId),
    /// Trigger an inject of the mission, by name.
    Inject(String),
    /// Set a bookmark with a text at this moment.
    Bookmark(String),
    /// Fetch another flight of the mission, to be shown beside this one.
    Ghost(GhostSource),
    /// Stop simulated time, and every deadline with it.
    Pause,
    /// Let simulated time go on.
    Continue,
    /// Another pace of simulated time from now on.
    Speedup(PaceChange),
    /// End the mission now; its report follows as an event.
    Abandon,
    /// Start the same mission again.
    Restart {
        /// Whether the seed stays the same.
        alike: bool,
    },
    /// Stop the session and close its links; the state has dropped it already.
    Leave,
}

/// What a replay is to do.
#[derive(Debug, Clone, PartialEq)]
pub enum ReplayEffect {
    /// Play, or stand still.
    Play(bool),
    /// Play from here back to the beginning.
    Rewind,
    /// Play so many times as fast as it was recorded.
    Rate(f64),
    Seek(SeekTarget),
    /// Show the next or the previous frame.
    Step {
        forward: bool,
    },
    /// Go to the next or the previous moment.
    Moment {
        forward: bool,
    },
    /// Show what happened at a time.
    Show(Duration),
    /// Play a stretch over and over, or no longer.
    Loop(Option<(Duration, Duration)>),
    /// Stop at moments of these kinds.
    StopAt(Vec<MomentKind>),
    /// Store what its user makes of it.
    Keep(Box<Review>),
}

/// Something about the terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TerminalEffect {
    /// Draw with this theme from now on.
    SetTheme(String),
    /// Draw at most this many frames per second from now on.
    SetFps(u8),
    Bell,
    /// Show a desktop notification.
    Notify(Text),
}

/// Another pace of simulated time.
#[derive(Debug, Clone, PartialEq)]
pub struct PaceChange {
    /// How many times as fast as the clock on the wall simulated time passes from now on.
    pub speedup: f64,
    /// What ended a faster pace; `None` where the trainee asked for the change.
    pub because: Option<Text>,
}

impl PaceChange {
    /// A pace that the trainee asks for.
    pub fn wanted(speedup: f64) -> Self {
        Self {
            speedup,
            because: None,
        }
    }
}
