//! Work for the shell, grouped by subject.

use std::time::Duration;

use crate::campaign::{Aids, Stake};
use crate::class::protocol::Denial;
use crate::class::{ConnectionId, DeskHeard, ExamNote, OrderId, RecordName};
use crate::commands::Order;
use crate::crew::CrewRecord;
use crate::crew::protocol::{CrewDenial, HeldRecord, HostMessage, MemberMessage};
use crate::diagnostic::Diagnostic;
use crate::draft::Trial;
use crate::forward::ForwardSpec;
use crate::geo::Square;
use crate::grading::{GradeSheet, GradedRequest};
use crate::language::{GhostSource, LoopTarget, ProcessDeed, SeekTarget};
use crate::ledger::EntryId;
use crate::moment::MomentKind;
use crate::record::DeskRecord;
use crate::review::Review;
use crate::text::{Language, Text};
use crate::vehicle::{HeldChannels, RadioTest, VehicleId};
use crate::workshop::Design;

/// How a mission is to be flown.
#[derive(Debug, Clone, PartialEq)]
pub struct Launch {
    pub mission: String,
    /// How the flight counts in a career.
    pub stake: Stake,
    /// The seed, if the trainee chose it for practice.
    pub seed: Option<u64>,
    /// The seed that the desk has drawn for a try of an exam.
    pub drawn: Option<u64>,
    /// The designs of the drones, one for all seats or one per seat; empty for the mission's own
    /// drones.
    pub fleet: Vec<Design>,
}

impl Launch {
    /// A graded flight with the mission's own drones.
    pub fn graded(mission: impl Into<String>) -> Self {
        Self {
            mission: mission.into(),
            stake: Stake::Graded,
            seed: None,
            drawn: None,
            fleet: Vec::new(),
        }
    }
}

/// The content of a file that the user reads or writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Parameters of a vehicle.
    Parameters,
    /// A design of the workshop.
    Design,
    /// A plan, a fence, rally points.
    Plan,
    /// A review of a flight, as Markdown; write-only.
    Review,
    /// Statistics of messages, as CSV or JSON; write-only.
    Statistics,
}

/// Work for the shell.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    Quit,
    /// Carry out an order that already has an entry in the ledger.
    Order {
        /// The ledger's entry for the outcome.
        entry: EntryId,
        order: Order,
    },
    /// Report to the program whether its line was carried out or refused.
    AnswerProgram(Result<ProgramAnswer, ProgramFault>),
    /// Download all parameters of vehicles.
    FetchParameters(Vec<VehicleId>),
    /// Read or write a file of the user.
    File(FileEffect),
    /// Fly drafts together in simulation.
    TryDrafts(Trial),
    /// Change the profile or its data.
    Career(CareerEffect),
    /// Do something for the class.
    Class(ClassEffect),
    /// Do something for the crew.
    Crew(CrewEffect),
    /// Start, change or end a session.
    Session(SessionEffect),
    Replay(ReplayEffect),
    /// Change the terminal's display, or notify the user.
    Terminal(TerminalEffect),
}

/// The answer to a program's line that was carried out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramAnswer {
    /// The line's entry in the ledger; `None` for a line to the console itself.
    pub entry: Option<EntryId>,
    /// The console's answer, if it has one.
    pub text: Option<Text>,
}

/// The reason why a program's line was not carried out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramFault {
    pub fault: Diagnostic,
    /// Whether the line would be carried out if the program confirmed it.
    pub asks: bool,
}

/// The shell's work after an event, in this order.
#[derive(Debug, Default, Clone, PartialEq)]
#[must_use = "the shell has to carry the effects out"]
pub struct Effects(Vec<Effect>);

impl Effects {
    pub fn none() -> Self {
        Self::default()
    }

    pub fn iter(&self) -> impl Iterator<Item = &Effect> {
        self.0.iter()
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

/// A file to read or write. Paths are as the user typed them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileEffect {
    /// List a folder, for the command line; an empty path is the working directory.
    List {
        folder: String,
    },
    /// Read the ground heights in these squares from the files of a folder.
    Ground {
        folder: String,
        squares: Vec<Square>,
    },
    Read {
        kind: FileKind,
        path: String,
    },
    Write {
        kind: FileKind,
        /// The path to write to.
        path: String,
        text: String,
        /// Whether an existing file may be replaced.
        replace: bool,
    },
    /// Write the unsaved drafts to their file in the data folder; `None` removes the file.
    KeepDrafts(Option<String>),
}

/// Work for a crew.
#[derive(Debug, Clone, PartialEq)]
pub enum CrewEffect {
    /// At the host: add a change to the journal.
    Note(CrewRecord),
    /// At the host: let a member in, with this first line, and send the record from where the member has got to.
    Admit {
        connection: ConnectionId,
        welcome: HostMessage,
        has: Option<HeldRecord>,
    },
    /// At the host: send the reason why a user cannot join, and end the connection.
    Deny {
        connection: ConnectionId,
        denial: CrewDenial,
    },
    /// At the host: end a connection.
    Drop(ConnectionId),
    /// At the host: tell a member something.
    Tell {
        connection: ConnectionId,
        message: HostMessage,
    },
    /// At the host: tell all members something.
    TellAll(HostMessage),
    /// At a member: tell the host something.
    Say(MemberMessage),
    /// At a member: end the program with this reason, because the crew cannot be joined.
    GiveUp(Text),
}

/// A change to the profile in use or to its data.
#[derive(Debug, Clone, PartialEq)]
pub enum CareerEffect {
    /// Switch to the profile with this name.
    Choose(String),
    /// Create a profile with this name and switch to it.
    Create(String),
    /// Continue without a profile: flights are not saved.
    Leave,
    /// Store the level of automatic advice.
    SetAids(Aids),
    /// Store the language of the screens.
    SetLanguage(Language),
    /// Buy the right to use a part, by id.
    BuyPart(String),
    /// Store a design; it replaces one of the same name.
    KeepDesign(Design),
    /// Store a design under another name.
    RenameDesign {
        from: String,
        /// The design with its new name.
        design: Design,
    },
    /// Delete the stored design of this name.
    DropDesign(String),
}

/// Work for the class.
#[derive(Debug, Clone, PartialEq)]
pub enum ClassEffect {
    /// At a seat: set a bookmark in the record, and report whether it is set.
    Mark { id: OrderId, text: String },
    /// At a seat: trigger an inject of the mission, or arm it with a condition, and report whether that is possible.
    Inject {
        id: OrderId,
        name: String,
        when: Option<String>,
    },
    /// At a seat: disarm the injects with this name, or all, and report it.
    Disarm { id: OrderId, name: Option<String> },
    /// At a seat: watch a condition in the flight, and report if that is not possible.
    Expect { id: OrderId, when: String },
    /// At a seat: note an order of the desk in the record.
    Note(DeskRecord),
    /// At a seat: hand in a record that is complete.
    HandIn(RecordName),
    /// At a seat: the desk has a record, or does not take it.
    Settle(RecordName),
    /// At the desk: list the lesson plans.
    ListLessons,
    /// At the desk: read a lesson plan, by its name or its path, and begin it with these seats; without any, go on with
    /// it at the seats that have it in their journals.
    ReadLesson { name: String, seats: Vec<usize> },
    /// At the desk: read a flight of a trainee, and the grades that it has.
    ReadGraded(GradedRequest),
    /// At the desk: find a flight of a trainee: the one with this record, otherwise the newest one; and the newest one of
    /// another trainee in the same mission.
    FindFlights {
        user: String,
        record: Option<String>,
        beside: Option<String>,
    },
    /// At the desk: keep the grades of a flight.
    KeepGrades {
        user: String,
        record: String,
        sheet: GradeSheet,
    },
    /// At the desk: read an exam, by its name or its path, and let these seats take part.
    ReadExam { name: String, seats: Vec<usize> },
    /// At the desk: keep notes of the exam that began at a time.
    KeepNotes { begun: u64, notes: Vec<ExamNote> },
    /// At the desk: take in a record, or a piece of one.
    Receive {
        connection: ConnectionId,
        /// The user at the other end.
        user: String,
        heard: DeskHeard,
    },
    /// At the desk: end a connection, with the reason.
    Deny {
        connection: ConnectionId,
        denial: Denial,
    },
}

/// A change to the session.
#[derive(Debug, Clone, PartialEq)]
pub enum SessionEffect {
    StartMission(Launch),
    /// Start free flight with vehicles of the embedded simulator.
    StartFree,
    /// Start free flight with vehicles of ArduPilot's SITL.
    StartArduPilot,
    /// Connect to vehicles at these addresses.
    Connect(Vec<String>),
    /// Open or close a forward to other ground stations.
    Forward(ForwardChange),
    /// Test the radio of these vehicles, or end the test.
    Radio {
        vehicles: Vec<VehicleId>,
        test: Option<RadioTest>,
    },
    /// Hold the sticks of a vehicle for a second, or release them.
    Sticks {
        vehicle: VehicleId,
        /// The positions; `None` to release them.
        held: Option<HeldChannels>,
    },
    /// Close the links to these vehicles; if heard again, they count as new.
    Forget(Vec<VehicleId>),
    /// Replay a recorded flight.
    Replay {
        /// A file of the record; `None` for the newest record.
        path: Option<String>,
        /// Whether to start with the review of the record.
        review: bool,
    },
    /// Restart or stop the process that simulates a vehicle.
    Process(ProcessDeed, VehicleId),
    /// Trigger an inject of the mission, by name.
    Inject(String),
    /// Set a bookmark with a text at the current time.
    Bookmark(String),
    /// Fetch another flight of the mission to show beside this one.
    Ghost(GhostSource),
    /// Stop simulated time, and every deadline with it.
    Pause,
    Continue,
    /// Change the speed-up of simulated time.
    Speedup(PaceChange),
    /// Give the mission up; its report follows as an event.
    Abandon,
    /// Keep a situation of the flight, or return to one.
    Situation(SituationEffect),
    /// End the mission for the instructor, as it stands; its report follows as an event.
    Stop,
    /// Start the same mission again.
    Restart {
        /// Whether to keep the seed.
        alike: bool,
    },
    /// Stop the session and close its links; the state has dropped it already.
    Leave,
}

/// What the desk wants to be done with a situation of the flight.
#[derive(Debug, Clone, PartialEq)]
pub enum SituationEffect {
    /// Keep the present one in this place, in which another one may be.
    Capture { id: OrderId, slot: usize },
    /// Return to the one in this place.
    Recall {
        id: OrderId,
        slot: usize,
        /// The last line of the record.
        line: DeskRecord,
    },
}

/// Opens or closes a forward to other ground stations.
#[derive(Debug, Clone, PartialEq)]
pub enum ForwardChange {
    Open(ForwardSpec),
    /// Close the forward at this address, as it was written.
    Close(String),
}

/// Control of a replay.
#[derive(Debug, Clone, PartialEq)]
pub enum ReplayEffect {
    Play(bool),
    Rewind,
    /// Play at this multiple of the recorded speed.
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
    /// Go to a time in the record.
    Show(Duration),
    /// Repeat a section of the record; `None` stops repeating.
    Loop(Option<LoopTarget>),
    /// Stop at moments of these kinds.
    StopAt(Vec<MomentKind>),
    /// Store the user's review.
    Keep(Box<Review>),
}

/// A change to the terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TerminalEffect {
    SetTheme(String),
    /// Limit the frames per second.
    SetFps(u8),
    Bell,
    /// Show a desktop notification.
    Notify(Text),
}

/// A change to the speed-up.
#[derive(Debug, Clone, PartialEq)]
pub struct PaceChange {
    /// The new speed-up of simulated time over the wall clock.
    pub speedup: f64,
    /// The reason for the end of a speed-up; `None` if the trainee asked for the change.
    pub because: Option<Text>,
}

impl PaceChange {
    /// A change to a speed-up that the trainee asks for.
    pub fn wanted(speedup: f64) -> Self {
        Self {
            speedup,
            because: None,
        }
    }
}
