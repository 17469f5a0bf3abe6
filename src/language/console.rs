//! Lines that the console carries out itself.

use std::time::Duration;

use super::VehicleChoice;
use super::targets::Targets;
use crate::alert::AlertKind;
use crate::commands::Pattern;
use crate::config::{Column, LiveSetting, TableSort};
use crate::draft::Edit;
use crate::geo::{LatLon, Outline};
use crate::moment::{Alignment, MomentKind};
use crate::plan::ListKind;
use crate::plan::generate::Course;
use crate::vehicle::{RadioTest, VehicleId};

mod class;
mod crew;
mod grading;

pub use class::{ClassLine, ReplayedTrainees, SeatChoice};
pub use crew::{CrewLine, ProposalLine};
pub use grading::{GradingLine, Rating};

/// A line that the console carries out itself, without any vehicle.
#[derive(Debug, Clone, PartialEq)]
pub enum ConsoleLine {
    /// Show a report: in its room, or as text without a screen.
    Report(Report),
    Select(VehicleChoice),
    /// Show which of the targets carry the same list.
    Carried {
        kind: ListKind,
        targets: Targets,
    },
    Group {
        /// The name, without `@`.
        name: String,
        /// The vehicles of the group; `None` for the selection.
        vehicles: Option<VehicleChoice>,
    },
    /// Delete the group with this name, given without `@`.
    Ungroup(String),
    /// Forget vehicles whose link is lost: these, or all.
    Forget(Option<VehicleChoice>),
    /// Share the links with other ground stations, or stop sharing them.
    Forward(ForwardLine),
    /// Go to the room with this name.
    Show(String),
    /// Start the mission with this id.
    Fly(String),
    /// Fly simulated vehicles without a mission.
    FlyFree,
    /// Connect to these addresses.
    Connect(Vec<String>),
    /// Trigger an inject of the mission.
    Inject(String),
    Macro(String),
    /// Change a setting for this session.
    Set(LiveSetting),
    /// A command about the parameters of the vehicle under the cursor.
    Parameters(ParametersLine),
    /// A command about the messages on the links.
    Messages(MessagesLine),
    /// Test the radio of vehicles, or end the test.
    Radio {
        choice: RadioChoice,
        test: Option<RadioTest>,
    },
    /// A command about the process of a vehicle.
    Process {
        /// The action on the process.
        deed: ProcessDeed,
        /// The vehicle that the process simulates.
        vehicle: VehicleId,
    },
    /// A command about the table of vehicles.
    Table(TableLine),
    /// Acknowledge, mute or list alerts.
    Alerts(AlertLine),
    Pause,
    Continue,
    Speedup(f64),
    /// A command about the replay.
    Replay(ReplayLine),
    /// Set a bookmark at this moment, with a text.
    Bookmark(String),
    /// Remove the bookmark at this moment of a replay.
    Unbookmark,
    /// A command about the review.
    Review(ReviewLine),
    /// A command about the drafts of plans.
    Draft(DraftLine),
    /// A command about another flight, shown beside this one.
    Ghost(GhostLine),
    /// A command about the class.
    Class(ClassLine),
    /// A command about the crew.
    Crew(CrewLine),
    /// Abandon the mission and show its debrief.
    Abandon,
    /// Restart the same mission.
    Restart,
    /// Return to the home screen.
    Leave,
    Quit,
}

/// The condition for a line to have an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineNeeds {
    Nothing,
    /// A flight under way: the line has no effect on a recorded one.
    Flight,
    /// A replay, which the line controls.
    Replay,
}

impl ConsoleLine {
    /// The condition for the line to have an effect.
    pub fn needs(&self) -> LineNeeds {
        match self {
            Self::Forget(_)
            | Self::Forward(_)
            | Self::Inject(_)
            | Self::Radio { .. }
            | Self::Process { .. }
            | Self::Abandon
            | Self::Restart => LineNeeds::Flight,
            Self::Unbookmark
            | Self::Replay(
                ReplayLine::Seek(_)
                | ReplayLine::Loop(_)
                | ReplayLine::StopAt(_)
                | ReplayLine::Rewind,
            ) => LineNeeds::Replay,
            Self::Review(line) if *line != ReviewLine::Open => LineNeeds::Replay,
            Self::Review(_)
            | Self::Replay(ReplayLine::Open(_))
            | Self::Report(_)
            | Self::Select(_)
            | Self::Carried { .. }
            | Self::Group { .. }
            | Self::Ungroup(_)
            | Self::Show(_)
            | Self::Fly(_)
            | Self::FlyFree
            | Self::Connect(_)
            | Self::Macro(_)
            | Self::Set(_)
            | Self::Parameters(_)
            | Self::Messages(_)
            | Self::Table(_)
            | Self::Alerts(_)
            | Self::Pause
            | Self::Continue
            | Self::Speedup(_)
            | Self::Bookmark(_)
            | Self::Draft(_)
            | Self::Ghost(_)
            | Self::Class(_)
            | Self::Crew(_)
            | Self::Leave
            | Self::Quit => LineNeeds::Nothing,
        }
    }
}

/// A command about forwards.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ForwardLine {
    /// Open a forward, given by its address and its filters.
    Add(String),
    /// Close the forward at this address.
    Remove(String),
}

/// The vehicles whose radio is meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RadioChoice {
    /// The selected vehicles; with none selected, the one under the cursor.
    Addressed,
    Vehicles(VehicleChoice),
    /// The vehicles heard on the link with this number, from 1.
    Link(usize),
}

/// A command about the messages on the links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MessagesLine {
    /// Forget the messages counted so far, and begin new statistics.
    Reset,
    /// Write the statistics to a file.
    Export(String),
}

/// A report to show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Report {
    /// The commands and keys.
    Help,
    /// Each link with its traffic and findings.
    Links,
    /// The commands so far with their outcome.
    Ledger,
    /// The notices so far.
    Notices,
    /// Other aircraft, and how close they come.
    Traffic,
    /// The processes of simulated vehicles.
    Hangar,
    /// The seats of the class.
    Class,
    /// The brief: the mission's objectives, its rules and its scoring.
    Brief,
    /// The state of vehicles: these, otherwise the selected ones, otherwise all.
    Status(Option<VehicleChoice>),
    /// The state of the mission.
    Objectives,
    Contacts,
}

/// A command about parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParametersLine {
    /// Opens the room of parameters.
    Show,
    /// Downloads all parameters again.
    Fetch,
    /// Saves the parameters to a file.
    Save(String),
    /// Compares the parameters with those of a file or of another vehicle, so that differences can
    /// be set.
    Compare(String),
}

/// An action on the process of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProcessDeed {
    Restart,
    /// Stop a process until it is restarted by hand.
    Stop,
}

/// A command about the table of vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TableLine {
    /// Order by a column.
    Sort(TableSort),
    /// Show only matching vehicles; all if empty.
    Filter(String),
    /// Show these columns; as many as fit if empty.
    Columns(Vec<Column>),
}

/// A command about the replay.
#[derive(Debug, Clone, PartialEq)]
pub enum ReplayLine {
    /// Replay this file, or the newest record.
    Open(Option<String>),
    /// Go to a moment.
    Seek(SeekTarget),
    /// Repeat a stretch; `None` ends the repetition.
    Loop(Option<LoopTarget>),
    /// Stop at moments of these kinds; empty for none.
    StopAt(Vec<MomentKind>),
    Rewind,
}

/// The stretch of a recording to repeat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoopTarget {
    /// Between two times of the recording.
    Times { from: Duration, to: Duration },
    /// From the last moment of this kind to the next one.
    Moments(MomentKind),
}

/// A command about the review of a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReviewLine {
    /// Review the replay, or the last flight.
    Open,
    /// The reasons for the result.
    Why(String),
    /// The plan for next time.
    Next(String),
    /// Something that went well, at the moment shown.
    Sustain(String),
    /// Something to improve, at the moment shown.
    Improve(String),
    /// Remove the point with this number, from 1.
    Remove(usize),
    /// Write the review as Markdown into this file.
    Export(String),
}

/// A command about another flight, shown beside this one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GhostLine {
    Show(GhostSource),
    /// Align the other flight with this one at an event of both flights.
    AlignedBy(Alignment),
    Off,
}

/// Another flight of the same mission.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GhostSource {
    /// The trainee's best flight.
    Best,
    /// The reference pilot's flight, flown now.
    Reference,
    /// A recorded flight, given by one of the files of its record.
    File(String),
}

/// A target in a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeekTarget {
    /// A time from the beginning.
    At(Duration),
    /// A time of the mission's clock.
    Mission(Duration),
    /// Later than now by this much.
    Later(Duration),
    /// Earlier than now by this much.
    Earlier(Duration),
    /// The next moment of a kind.
    Next(MomentKind),
    /// The previous moment of a kind.
    Previous(MomentKind),
    End,
}

/// A command about the drafts of plans.
#[derive(Debug, Clone, PartialEq)]
pub enum DraftLine {
    /// Show the room of plans; without a screen, the items of the current draft.
    Show,
    /// Begin an empty draft.
    New(Option<String>),
    /// Open the plan in a file of any known format.
    Open(String),
    /// Write the current draft to a file; `None` for the file that it comes from.
    Save(Option<String>),
    /// Open the lists that these vehicles carry, in a draft for each.
    Take(Option<VehicleChoice>),
    /// Make the draft with this name the current one.
    Use(String),
    Close,
    /// Make a plan for each of these vehicles, otherwise for each of the addressed ones, as drafts.
    Divide {
        work: DraftWork,
        vehicles: Option<VehicleChoice>,
    },
    /// Upload the current draft to these vehicles, otherwise to the selected ones.
    Upload(Option<VehicleChoice>),
    /// Upload each draft that is meant for a vehicle to that vehicle.
    UploadEach,
    Undo,
    Redo,
    /// Calculate times with this speed in m/s; `None` for the speed of the vehicle.
    Speed(Option<f64>),
    /// Fly the drafts together in simulation.
    Try {
        /// Whether to change the drafts that come too close to each other.
        is_apart: bool,
        /// The vehicles that would fly the drafts; `None` for the drafts' own vehicles, otherwise
        /// the selected ones.
        vehicles: Option<VehicleChoice>,
    },
    /// Take the height of the ground from files in this folder; `None` counts it as level.
    Ground(Option<String>),
    Edit(Edit),
}

/// Work that is divided among several vehicles.
#[derive(Debug, Clone, PartialEq)]
pub enum DraftWork {
    /// Parallel lines over an area.
    Sweep {
        /// The area to cover; `None` for the area of the current draft.
        area: Option<Outline>,
        /// The line spacing in metres; `None` for the default.
        spacing_m: Option<f64>,
        /// Height above home in metres; `None` for the default.
        up_m: Option<f64>,
        course: Course,
    },
    /// A search around a place.
    Search {
        pattern: Pattern,
        /// The most likely position of the object; `None` for the cursor of the map.
        datum: Option<LatLon>,
        radius_m: Option<f64>,
        spacing_m: Option<f64>,
        up_m: Option<f64>,
    },
    /// Lanes side by side along a line.
    Line {
        /// Its places; empty for the places of the current draft's plan.
        points: Vec<LatLon>,
        spacing_m: Option<f64>,
        up_m: Option<f64>,
    },
    /// Circles around a place.
    Orbit {
        /// The centre; `None` for the cursor of the map.
        centre: Option<LatLon>,
        radius_m: f64,
        turns: Option<u8>,
        up_m: Option<f64>,
    },
}

/// A command about alerts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AlertLine {
    /// Mute a kind of alert; `None` lists the muted ones.
    Mute(Option<AlertKind>),
    /// Unmute a kind; `None` for all.
    Unmute(Option<AlertKind>),
    /// Acknowledge the worst alerts.
    AcknowledgeWorst,
    /// Acknowledge all alerts of a kind.
    AcknowledgeKind(AlertKind),
    /// Acknowledge all alerts of these vehicles.
    AcknowledgeOf(VehicleChoice),
}
