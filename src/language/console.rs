//! Lines that the console carries out itself.

use std::time::Duration;

use super::VehicleChoice;
use crate::alert::AlertKind;
use crate::config::{Column, LiveSetting, TableSort};
use crate::moment::{Alignment, MomentKind};
use crate::vehicle::VehicleId;

/// A line that the console carries out itself: no vehicle hears of it.
#[derive(Debug, Clone, PartialEq)]
pub enum ConsoleLine {
    /// Show something: on a screen its room, without one as text.
    Report(Report),
    Select(VehicleChoice),
    /// Give vehicles a group's name.
    Group {
        /// The name, without `@`.
        name: String,
        /// `None` means the selection.
        vehicles: Option<VehicleChoice>,
    },
    /// Forget the name of a group, given without `@`.
    Ungroup(String),
    /// Forget vehicles whose link is lost: these, or all of them.
    Forget(Option<VehicleChoice>),
    /// Go to the room of this name.
    Show(String),
    /// Start the mission of this id.
    Fly(String),
    /// Fly simulated vehicles without a mission.
    FlyFree,
    /// Connect to these addresses.
    Connect(Vec<String>),
    /// Have something happen in the mission.
    Inject(String),
    /// Give the lines of a macro.
    Macro(String),
    /// Change a setting for this session.
    Set(LiveSetting),
    /// Something about the parameters of the vehicle under the cursor.
    Parameters(ParametersLine),
    /// Something about the process of a vehicle.
    Process {
        /// What to do with it.
        deed: ProcessDeed,
        /// The vehicle whose process it is.
        vehicle: VehicleId,
    },
    /// Something about the table of vehicles.
    Table(TableLine),
    /// Acknowledge, mute or list alerts.
    Alerts(AlertLine),
    /// Let the session stand still.
    Pause,
    /// Let it go on.
    Continue,
    /// Have so many seconds pass in one.
    Speedup(f64),
    /// Something about what is replayed.
    Replay(ReplayLine),
    /// Set a bookmark at this moment, with a text.
    Bookmark(String),
    /// Remove the bookmark of this moment, in a replay.
    Unbookmark,
    /// Something about the review of what is replayed.
    Review(ReviewLine),
    /// Something about another flight beside this one.
    Ghost(GhostLine),
    /// Give the mission up and show its debrief.
    Abandon,
    /// The same mission again.
    Restart,
    /// Back to the home screen.
    Leave,
    Quit,
}

/// What can be shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Report {
    /// What can be said and pressed.
    Help,
    /// Each link with its traffic and findings.
    Links,
    /// The commands given so far and what became of them.
    Ledger,
    /// What vehicles and console have said so far.
    Notices,
    /// The processes of simulated vehicles.
    Hangar,
    /// The task, its rules and how it is scored.
    Brief,
    /// How vehicles are: these, else the selected ones, else all.
    Status(Option<VehicleChoice>),
    /// How the mission stands.
    Objectives,
    /// What detectors have found.
    Contacts,
}

/// What the console does with parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParametersLine {
    /// Opens the room of parameters.
    Show,
    /// Asks the vehicle for all of them again.
    Fetch,
    /// Saves them to a file.
    Save(String),
    /// Loads a file, or compares with one or with another vehicle: first the differences show.
    Compare(String),
}

/// What can be done with the process of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProcessDeed {
    /// It is ended, if it runs, and started again.
    Restart,
    /// Ends it for good.
    Stop,
}

/// A line about the table of vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TableLine {
    /// Order by a column.
    Sort(TableSort),
    /// Show only what fits; everything if empty.
    Filter(String),
    /// Show these columns; as many as fit if empty.
    Columns(Vec<Column>),
}

/// A line about what is replayed.
#[derive(Debug, Clone, PartialEq)]
pub enum ReplayLine {
    /// Replay this file, or the newest record.
    Open(Option<String>),
    /// Go to a moment.
    Seek(SeekTarget),
    /// Play from one time to another over and over; `None` ends that.
    Loop(Option<(Duration, Duration)>),
    /// Stop at moments of these kinds; none plays through.
    StopAt(Vec<MomentKind>),
    /// Play from here back to the beginning.
    Rewind,
}

/// What a line says about the review of a recorded flight.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReviewLine {
    /// Review what is replayed, or what was flown last.
    Open,
    /// Why it went as it did.
    Why(String),
    /// What is to be done next time.
    Next(String),
    /// Something that went well, at the moment shown.
    Sustain(String),
    /// Something to do otherwise, at the moment shown.
    Improve(String),
    /// Remove the point of this number, from 1.
    Remove(usize),
    /// Write the review as Markdown into this file.
    Export(String),
}

/// What a line says about another flight that is shown beside this one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GhostLine {
    /// Show this flight.
    Show(GhostSource),
    /// Lay its times upon this one's by something that happened in both.
    AlignedBy(Alignment),
    /// Show it no longer.
    Off,
}

/// Another flight of the same mission.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GhostSource {
    /// The best one of the trainee's own.
    Best,
    /// That of the reference pilot, flown now.
    Reference,
    /// That of a record, by one of its files.
    File(String),
}

/// Where in a recording to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeekTarget {
    /// A time from the beginning.
    At(Duration),
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

/// A line about alerts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AlertLine {
    /// Keep a kind of alert silent; none asks which are.
    Mute(Option<AlertKind>),
    /// Let a kind ring again; none means all.
    Unmute(Option<AlertKind>),
    /// Acknowledge the worst alerts.
    AcknowledgeWorst,
    /// Acknowledge all alerts of a kind.
    AcknowledgeKind(AlertKind),
    /// Acknowledge all alerts of these vehicles.
    AcknowledgeOf(VehicleChoice),
}
