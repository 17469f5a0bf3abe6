//! What happened.

use std::collections::BTreeMap;
use std::time::Duration;

use crossterm::event::KeyEvent;

use super::room::messages::LinkTraffic;
use super::state::{Activity, Career, Instance, LinkSummary};
use crate::campaign::Reward;
use crate::doctor::Finding;
use crate::geo::LatLon;
use crate::ledger::RowUpdate;
use crate::mission::{Area, Listing, Progress};
use crate::notice::Notice;
use crate::parameters::Snapshot;
use crate::scoring::{Report, TryReport};
use crate::swarm::Path;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};

/// Something that the console reacts to.
#[derive(Debug, Clone)]
pub enum Event {
    /// A key was pressed (releases and repeats of modifiers are ignored).
    Key(KeyEvent),
    /// Text was pasted.
    Paste(String),
    /// The terminal has this size now.
    Resize {
        /// Its width.
        columns: u16,
        /// Its height.
        rows: u16,
    },
    /// A whole line was given at the prompt of the plain console.
    Line(String),
    /// What the line to the terminal carries in bytes per second, while it cannot keep up.
    SlowLine(Option<u32>),
    /// Time passed; nothing else moves the console's clock.
    Tick {
        /// Since the start of the program.
        now: Duration,
    },
    /// What was asked for runs: forget the session before it and show the new one.
    Started(Box<Started>),
    /// A vehicle's telemetry changed.
    Vehicle(Box<Vehicle>),
    /// A vehicle's parameters, or how far their download is, changed.
    Parameters {
        /// The vehicle.
        vehicle: VehicleId,
        /// What is known of them now.
        snapshot: Snapshot,
    },
    /// A parameter file was read.
    ParametersRead {
        /// Its path, as it was written.
        path: String,
        /// What it says.
        text: String,
    },
    /// A parameter file was written.
    ParametersSaved {
        /// Its path, as it was written.
        path: String,
    },
    /// A parameter file was not written because there is one already.
    ParametersExist {
        /// Its path, as it was written.
        path: String,
        /// What would be written.
        text: String,
    },
    /// A design file was read.
    DesignRead {
        /// Its path, as it was written.
        path: String,
        /// What it says.
        text: String,
    },
    /// A design file was written.
    DesignWritten {
        /// Its path, as it was written.
        path: String,
    },
    /// A design file was not written because there is one already.
    DesignExists {
        /// Its path, as it was written.
        path: String,
        /// What would be written.
        text: String,
    },
    /// Something to tell.
    Notice(Notice),
    /// So many notices were dropped so far because the console was busy.
    NoticesDropped(u64),
    /// A command came one step further with one vehicle.
    Row(RowUpdate),
    /// How the links are doing.
    Links(Vec<LinkSummary>),
    /// How the processes of the vehicles are doing.
    Hangar(Vec<Instance>),
    /// The processes of the vehicles could not be started at all.
    NotLaunched(Text),
    /// What the process of a vehicle has printed.
    Printed {
        /// The vehicle.
        vehicle: VehicleId,
        /// Whether what was known of it before is to be forgotten.
        anew: bool,
        /// Lines, oldest first.
        lines: Vec<String>,
    },
    /// What the link doctor has found, once a second.
    Findings(Vec<Finding>),
    /// A look at the messages on the links.
    Traffic(Vec<LinkTraffic>),
    /// What is simulated stands still from now on, or goes on.
    Paused(bool),
    /// What vehicles that do something together are going to fly.
    Paths(Vec<Path>),
    /// How the mission is going.
    Mission(Box<Progress>),
    /// The mission is over.
    MissionEnded(Box<Report>),
    /// Who has a profile here.
    Profiles(Vec<String>),
    /// Who trains here, and how far they have come; nobody whose flights are kept.
    Career(Option<Box<Career>>),
    /// The trainee's tries at missions as they are now, by the mission's id, oldest first.
    Tries(BTreeMap<String, Vec<TryReport>>),
    /// What the flight that has just ended brought to the career.
    Rewarded(Box<Reward>),
    /// The shell could not do something; the text says what, where, and what to do.
    Failed(Text),
}

/// A session that has just begun.
#[derive(Debug, Clone, PartialEq)]
pub struct Started {
    /// What is being done.
    pub activity: Activity,
    /// The mission, if it is one.
    pub mission: Option<Box<Listing>>,
    /// The places that commands may name.
    pub places: BTreeMap<String, LatLon>,
    /// The areas of the mission that are known from the start.
    pub areas: Vec<Area>,
    /// How many processes are started for it; `None` where none is.
    pub processes: Option<usize>,
}
