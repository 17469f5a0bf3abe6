//! Events, grouped by origin.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyEvent;

use super::action::Action;
use super::effect::{FileKind, PaceChange};
use super::room::messages::LinkTraffic;
use super::snapshot::FlightSnapshot;
use super::state::{
    Activity, Career, ForwardSummary, Ghost, Instance, LinkSummary, ReplayPosition, ReplayView,
};
use crate::campaign::Reward;
use crate::class::protocol::{DeskMessage, SeatMessage};
use crate::class::{
    ConnectionId, Exam, OrderId, RecordName, Refusal, Submission, SubmissionRefusal,
};
use crate::class_results::{ClassResults, FoundFlights};
use crate::crew::protocol::{HostMessage, MemberMessage};
use crate::doctor::LinkFinding;
use crate::draft::Tried;
use crate::geo::{LatLon, Terrain};
use crate::grading::{GradedFlight, GradedRequest};
use crate::language::Named;
use crate::ledger::{ForeignCommand, Risk, RowUpdate};
use crate::lesson_plan::{Lesson, LessonList};
use crate::mission::{Area, Listing, Progress};
use crate::moment::Moment;
use crate::notice::Notice;
use crate::operator::RehearsalFindings;
use crate::parameters::ParameterSnapshot;
use crate::pilot_in_command::{Person, PilotsInCommand};
use crate::record::DeskRecord;
use crate::review::Review;
use crate::scoring::{Report, TryReport};
use crate::session::ListedFolder;
use crate::swarm::Path;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::verb::Verb;

/// An event that the console handles.
#[derive(Debug, Clone)]
pub enum Event {
    /// Input from the user or the terminal.
    Terminal(TerminalEvent),
    /// A line from a program that controls the console.
    Program(ProgramLine),
    /// Time has passed; no other event moves the console's clock.
    Tick {
        /// Time since the start of the program, excluding pauses of the session.
        now: Duration,
        /// Time since the start of the program, including pauses of the session.
        wall: Duration,
    },
    /// A change in a vehicle or its commands.
    Vehicle(VehicleEvent),
    /// A change in the links or their traffic.
    Link(LinkEvent),
    /// A change in the processes that simulate vehicles.
    Process(ProcessEvent),
    /// A change in the session.
    Session(SessionEvent),
    /// A change in a replay.
    Replay(ReplayEvent),
    /// A change to the profile in use or to its data.
    Career(CareerEvent),
    /// Something happened between a seat and the desk of its class.
    Class(ClassEvent),
    /// Something happened between the host and the members of a crew.
    Crew(CrewEvent),
    /// A file was read or written by the shell.
    File(FileEvent),
    /// Drafts were flown together in simulation.
    Tried(Tried),
    /// A notice for the list of notices.
    Notice(Notice),
    /// The number of notices dropped so far because the console was busy.
    NoticesDropped(u64),
    /// The shell's short answer, for the last line of the screen.
    Answer(Text),
    /// A failure of the shell; the text states what failed, where, and what to do.
    Failed(Text),
}

/// Input from the user or the terminal.
#[derive(Debug, Clone)]
pub enum TerminalEvent {
    /// A key was pressed (releases and repeats of modifiers are ignored).
    Key(KeyEvent),
    Paste(String),
    /// A cell was clicked; its position is counted from the upper left corner.
    Click {
        column: u16,
        row: u16,
    },
    /// An element drawn for an action was clicked.
    Choose(Action),
    /// The terminal has been resized.
    Resize {
        columns: u16,
        rows: u16,
    },
    /// A line was entered at the prompt of the plain console.
    Line(String),
    /// The plain console has printed the contents of the screen: messages and overlays close, but a
    /// question stays open.
    Told,
    /// The throughput of the terminal's connection in bytes per second while it is too slow for the
    /// screen; otherwise `None`.
    SlowLine(Option<u32>),
}

/// A line given by a program. The answer is an error or the line's ledger entry
/// ([`Effect::AnswerProgram`]).
///
/// [`Effect::AnswerProgram`]: super::effect::Effect::AnswerProgram
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramLine {
    pub line: String,
    /// Whether the program has confirmed the line in advance, so the console does not ask.
    pub confirmed: bool,
}

#[derive(Debug, Clone)]
pub enum VehicleEvent {
    /// A vehicle's telemetry changed.
    Telemetry(Arc<Vehicle>),
    /// A vehicle's parameters, or the progress of their download, changed.
    Parameters {
        vehicle: VehicleId,
        snapshot: ParameterSnapshot,
    },
    /// A command was given in a replay.
    Given {
        /// The time at which the command was given.
        at: Duration,
        /// The whole command in the console's grammar.
        line: String,
        verb: &'static Verb,
        /// The risk of the command.
        risk: Risk,
        /// Who gave the command; `None` for the user of the console.
        by: Option<Person>,
        /// The vehicles that the command addresses.
        vehicles: Vec<VehicleId>,
    },
    /// A command made progress with one vehicle.
    Row(RowUpdate),
    /// A folder of a vehicle has been listed.
    Folder(ListedFolder),
    /// Another ground station has commanded a vehicle, or its command has a new state.
    Foreign(ForeignCommand),
    /// The paths that vehicles of a manoeuvre will fly.
    Paths(Vec<Path>),
    /// In a replay: vehicles have other pilots.
    Pilots(PilotsInCommand),
    /// A rehearsal is over.
    Rehearsed(RehearsalFindings),
}

#[derive(Debug, Clone)]
pub enum LinkEvent {
    /// The state of each link.
    Summaries(Vec<LinkSummary>),
    /// The state of each forward.
    Forwards(Vec<ForwardSummary>),
    /// The findings of the link doctor, once a second.
    Findings(Vec<LinkFinding>),
    /// The message counts of the links.
    Traffic(Vec<LinkTraffic>),
}

/// A change in the processes that simulate vehicles.
#[derive(Debug, Clone)]
pub enum ProcessEvent {
    /// The state of each process.
    Instances(Vec<Instance>),
    /// The processes could not be started.
    NotLaunched(Text),
    /// A process has printed output.
    Printed {
        vehicle: VehicleId,
        /// Whether to drop the lines shown so far.
        anew: bool,
        /// The new lines of the process's output, oldest first.
        lines: Vec<String>,
    },
}

/// A change in the course of a session.
#[derive(Debug, Clone)]
pub enum SessionEvent {
    /// A session has begun; it replaces the previous session or replay.
    Started(Box<Started>),
    /// The previous session or replay has ended, and the next one could not be started.
    Ended,
    /// Simulated time stopped or resumed.
    Paused(bool),
    /// The speed-up has changed.
    Speedup(PaceChange),
    /// The progress of the mission.
    Mission(Box<Progress>),
    /// The mission is over.
    MissionEnded(Box<Report>),
    /// In a replay: an order of an instructor's desk ended.
    Instructed(Box<DeskRecord>),
    /// The flight continues, frozen, from this earlier state.
    Recalled(Box<FlightSnapshot>),
    /// Another flight of the mission is ready to show beside this one.
    Ghost(Box<Ghost>),
}

/// A change in the course of a replay. Recorded telemetry and occurrences arrive as their original
/// events.
#[derive(Debug, Clone)]
pub enum ReplayEvent {
    /// A recording was opened; its session replaces the previous one.
    Opened {
        view: Box<ReplayView>,
        started: Box<Started>,
    },
    /// More of the recording is known: its length, its moments or its report. The length is an
    /// estimate until the whole recording has been indexed.
    Known {
        length: Duration,
        /// The moments found so far, earliest first.
        moments: Arc<Vec<Moment>>,
        /// The mission's report, once it is known.
        report: Option<Arc<Report>>,
    },
    /// The gaps of the recording found so far, earliest first.
    Gaps(Arc<Vec<Range<Duration>>>),
    /// The console must restore an earlier or later state of the flight.
    Restored(Box<FlightSnapshot>),
    At(ReplayPosition),
}

/// A change in profiles and careers.
#[derive(Debug, Clone)]
pub enum CareerEvent {
    /// The names of all profiles.
    Profiles(Vec<String>),
    /// The profile in use with its trainee's career; `None` without a profile.
    Career(Option<Box<Career>>),
    /// The trainee's attempts at the current revisions of missions, by mission id, oldest first.
    Tries(BTreeMap<String, Vec<TryReport>>),
    /// The trainee's newest review of each mission, by mission id.
    Reviews(BTreeMap<String, Review>),
    /// The rewards of the flight that has just ended.
    Rewarded(Box<Reward>),
    /// The number of flights that could not be stored yet, and are lost if the program ends.
    AtRisk(usize),
}

/// What happens between a seat and the desk of its class.
#[derive(Debug, Clone)]
pub enum ClassEvent {
    /// At a seat: a desk was found, which belongs to this user.
    Found { instructor: String },
    /// At a seat: the desk has said something.
    Said(DeskMessage),
    /// At a seat: the connection to the desk has ended.
    Lost,
    /// At a seat: there is a desk to which it must not connect; the text states why.
    Refused(Text),
    /// At a seat: the shell has begun what the desk has ordered, or cannot do it.
    Begun {
        id: OrderId,
        refusal: Option<Refusal>,
    },
    /// At a seat: the flight of a try would be practice, so it was not begun.
    TryRefused(Refusal),
    /// At the desk: a seat has said something.
    Heard {
        connection: ConnectionId,
        /// The user at the other end.
        user: String,
        message: SeatMessage,
    },
    /// At the desk: a connection has ended.
    Left(ConnectionId),
    /// At a seat: the record of a mission is complete.
    Recorded(RecordName),
    /// At a seat: a record can be handed in.
    Offered(Submission),
    /// At a seat: a record cannot be read.
    Unreadable { record: RecordName, error: String },
    /// At the desk: a record of this user is complete, and was scored.
    Kept {
        user: String,
        /// The id of the mission.
        mission: String,
        score: u16,
    },
    /// At the desk: a record of this user was refused.
    NotKept {
        user: String,
        record: RecordName,
        refusal: SubmissionRefusal,
        /// The words of the system, if it was at fault.
        words: Option<String>,
    },
    /// At the desk: a record is complete, but cannot be scored.
    Unscored(Text),
    /// At the desk: the lesson plans.
    Lessons(LessonList),
    /// At the desk: a lesson plan was read, or why not, for these seats.
    LessonRead {
        name: String,
        lesson: Result<Arc<Lesson>, Text>,
        seats: Vec<usize>,
    },
    /// At the desk: the flight that was asked for, or why it cannot be graded.
    Graded {
        asked: GradedRequest,
        flight: Result<Box<GradedFlight>, Text>,
    },
    /// At the desk: the flights that are to be replayed, or why there are none.
    FlightsFound(Result<FoundFlights, Text>),
    /// At the desk: the grades of so many flights are not written yet. They are kept in memory, and written later.
    GradesWait {
        count: usize,
        /// Why the last ones could not be written; `None` if all have been written now.
        fault: Option<Text>,
    },
    /// At the desk: what happened to its exam.
    Exam(ExamEvent),
    /// At the desk: the results of the class have changed.
    Results(Arc<ClassResults>),
}

/// What happens to the exam of a desk.
#[derive(Debug, Clone)]
pub enum ExamEvent {
    /// An exam was read and can begin, or why not, for these seats.
    Read {
        name: String,
        exam: Result<Box<Exam>, Text>,
        seats: Vec<usize>,
    },
    /// The exams that can be held, with their titles.
    Listed(Vec<Named>),
    /// An exam had not ended when the last desk did.
    Found(Box<Exam>),
    /// This many more notes of the exam that began at a time are on disk.
    NotesKept {
        /// When the exam began, in seconds since 1970.
        begun: u64,
        count: usize,
    },
    /// The notes of an exam are damaged, so it is not continued.
    Damaged(Text),
    /// Notes of the exam could not be kept, or a record not be sealed.
    Failed(Text),
}

/// What happens between the host of a crew and its members.
#[derive(Debug, Clone)]
pub enum CrewEvent {
    /// At the host: a line of a member, or of a user who asks to join.
    Heard {
        connection: ConnectionId,
        /// The user at the other end, from the system.
        user: String,
        message: MemberMessage,
    },
    /// At the host: a connection has ended.
    Left(ConnectionId),
    /// At a member: the host has said something.
    Said(HostMessage),
    /// At a member: the connection to the host has ended.
    Lost,
    /// At a member: the crew cannot be joined, for this reason.
    Refused(Text),
}

/// The result of a file operation. Paths are as the user typed them.
#[derive(Debug, Clone)]
pub enum FileEvent {
    /// A file was read.
    Read {
        kind: FileKind,
        path: String,
        text: String,
    },
    /// A folder was listed. Names of subfolders end with `/`; `names` is empty if the folder cannot
    /// be read.
    Listed { folder: String, names: Vec<String> },
    /// The height of the ground in the squares for which the folder has files.
    Ground { folder: String, terrain: Terrain },
    /// The drafts that an earlier console left unsaved.
    Kept { text: String },
    /// A file was written.
    Written { path: String },
    /// A file was not written because it exists already.
    Exists {
        kind: FileKind,
        path: String,
        /// The text to write.
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
    ClassEvent => Class,
    CrewEvent => Crew,
    FileEvent => File,
    Notice => Notice,
}

/// A session that has just begun.
#[derive(Debug, Clone, PartialEq)]
pub struct Started {
    /// The kind of session.
    pub activity: Activity,
    /// The mission, if there is one.
    pub mission: Option<Box<Listing>>,
    /// The places that commands may name.
    pub places: BTreeMap<String, LatLon>,
    /// The areas of the mission that are known from the start.
    pub areas: Vec<Area>,
    /// The number of processes started for the session; `None` without any.
    pub processes: Option<usize>,
    /// The speed-up of simulated time over the wall clock.
    pub speedup: f64,
    /// Whether the user restarted the previous session; if so, a mission begins without its brief, except from the
    /// debrief.
    pub is_again: bool,
}
