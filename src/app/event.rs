//! Events, grouped by where they come from.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyEvent;

use super::action::Action;
use super::effect::{FileKind, PaceChange};
use super::room::messages::LinkTraffic;
use super::snapshot::FlightSnapshot;
use super::state::{Activity, Career, Ghost, Instance, LinkSummary, ReplayPosition, ReplayView};
use crate::campaign::Reward;
use crate::doctor::LinkFinding;
use crate::geo::LatLon;
use crate::ledger::{Risk, RowUpdate};
use crate::mission::{Area, Listing, Progress};
use crate::moment::Moment;
use crate::notice::Notice;
use crate::parameters::ParameterSnapshot;
use crate::review::Review;
use crate::scoring::{Report, TryReport};
use crate::swarm::Path;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::verb::Verb;

/// Something that the console reacts to.
#[derive(Debug, Clone)]
pub enum Event {
    /// The user or the terminal did something.
    Terminal(TerminalEvent),
    /// Time passed; nothing else moves the console's clock.
    Tick {
        /// Since the start of the program, without the time for which the session stood still.
        now: Duration,
        /// The same with it.
        wall: Duration,
    },
    /// A vehicle reported something.
    Vehicle(VehicleEvent),
    /// The links, or what the messages on them show, changed.
    Link(LinkEvent),
    /// The processes that simulate vehicles changed.
    Process(ProcessEvent),
    /// A session began, ended or went on.
    Session(SessionEvent),
    /// A recording is replayed.
    Replay(ReplayEvent),
    /// The profile in use, or what belongs to it, changed.
    Career(CareerEvent),
    /// A file was read or written by the shell.
    File(FileEvent),
    /// Something to tell, for the log of notices.
    Notice(Notice),
    /// So many notices were dropped so far because the console was busy.
    NoticesDropped(u64),
    /// The shell's short answer to its user, for the last line of the screen.
    Answer(Text),
    /// The shell could not do something; the text says what, where, and what to do.
    Failed(Text),
}

/// What the user and the terminal do.
#[derive(Debug, Clone)]
pub enum TerminalEvent {
    /// A key was pressed (releases and repeats of modifiers are ignored).
    Key(KeyEvent),
    Paste(String),
    /// A cell was clicked, counted from the upper left corner.
    Click {
        column: u16,
        row: u16,
    },
    /// Something was clicked on that was drawn for an action.
    Choose(Action),
    /// The terminal has this size now.
    Resize {
        columns: u16,
        rows: u16,
    },
    /// A whole line was entered at the prompt of the plain console.
    Line(String),
    /// The plain console has told what a screen would show: message and overlays close, except a question.
    Told,
    /// What the line to the terminal carries in bytes per second, while it cannot keep up.
    SlowLine(Option<u32>),
}

/// What is heard of vehicles.
#[derive(Debug, Clone)]
pub enum VehicleEvent {
    /// A vehicle's telemetry changed.
    Telemetry(Arc<Vehicle>),
    /// A vehicle's parameters, or the progress of their download, changed.
    Parameters {
        vehicle: VehicleId,
        /// What is known of them now.
        snapshot: ParameterSnapshot,
    },
    /// A command was given in what is replayed.
    Given {
        /// When it was given.
        at: Duration,
        /// The whole line in the console's grammar.
        line: String,
        verb: &'static Verb,
        /// What it sets at risk.
        risk: Risk,
        /// The vehicles that it goes to.
        vehicles: Vec<VehicleId>,
    },
    /// An order advanced with one vehicle.
    Row(RowUpdate),
    /// The paths that vehicles of a manoeuvre are going to fly.
    Paths(Vec<Path>),
}

/// What is heard of links.
#[derive(Debug, Clone)]
pub enum LinkEvent {
    /// How the links are doing.
    Summaries(Vec<LinkSummary>),
    /// What the link doctor has found, once a second.
    Findings(Vec<LinkFinding>),
    /// The messages on the links, counted.
    Traffic(Vec<LinkTraffic>),
}

/// What is heard of the processes that simulate vehicles.
#[derive(Debug, Clone)]
pub enum ProcessEvent {
    /// How they are doing.
    Instances(Vec<Instance>),
    /// They could not be started at all.
    NotLaunched(Text),
    /// What the process of a vehicle has printed.
    Printed {
        vehicle: VehicleId,
        /// Whether the lines that are known already are to be dropped.
        anew: bool,
        /// The new lines of its output, oldest first.
        lines: Vec<String>,
    },
}

/// The course of a session.
#[derive(Debug, Clone)]
pub enum SessionEvent {
    /// A session has begun; it replaces the one before.
    Started(Box<Started>),
    /// Simulated time stopped, or goes on.
    Paused(bool),
    /// Simulated time passes at another pace.
    Speedup(PaceChange),
    /// How the mission is going.
    Mission(Box<Progress>),
    /// The mission is over.
    MissionEnded(Box<Report>),
    /// Another flight of the mission is there, to be shown beside this one.
    Ghost(Box<Ghost>),
}

/// The course of a replay. What was heard and happened comes as the events of then.
#[derive(Debug, Clone)]
pub enum ReplayEvent {
    /// A recording was opened; what it was about follows as a session that has started.
    Opened(Box<ReplayView>),
    /// It has been read to its end: how long it is, and what is in it.
    Known {
        length: Duration,
        /// The moments found so far, earliest first.
        moments: Arc<Vec<Moment>>,
        /// What the mission was scored, once that is known.
        report: Option<Arc<Report>>,
    },
    /// The console is to show what it knew at another time.
    Restored(Box<FlightSnapshot>),
    /// It stands there now.
    At(ReplayPosition),
}

/// The state of profiles and careers.
#[derive(Debug, Clone)]
pub enum CareerEvent {
    /// The names of all profiles.
    Profiles(Vec<String>),
    /// The profile in use and how far its trainee has come; `None` without a profile.
    Career(Option<Box<Career>>),
    /// The trainee's tries at the current revisions of missions, by mission id, oldest first.
    Tries(BTreeMap<String, Vec<TryReport>>),
    /// The trainee's newest review of each mission, by mission id.
    Reviews(BTreeMap<String, Review>),
    /// What the flight that has just ended brought to the career.
    Rewarded(Box<Reward>),
}

/// What became of a file. Paths are as the user wrote them.
#[derive(Debug, Clone)]
pub enum FileEvent {
    /// A file was read.
    Read {
        /// What it should hold.
        kind: FileKind,
        path: String,
        text: String,
    },
    /// A file was written.
    Written { path: String },
    /// A file was not written because it exists already.
    Exists {
        /// What it would hold.
        kind: FileKind,
        path: String,
        /// What would be written.
        text: String,
    },
}

macro_rules! part_of_event {
    ($($part:ident => $variant:ident),* $(,)?) => {$(
        impl From<$part> for Event {
            fn from(part: $part) -> Self {
                Self::$variant(part)
            }
        }
    )*};
}

part_of_event! {
    TerminalEvent => Terminal,
    VehicleEvent => Vehicle,
    LinkEvent => Link,
    ProcessEvent => Process,
    SessionEvent => Session,
    ReplayEvent => Replay,
    CareerEvent => Career,
    FileEvent => File,
    Notice => Notice,
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
    /// How many times as fast as the clock on the wall simulated time passes.
    pub speedup: f64,
}
