//! The user's intents, whichever key gave them.

use strum::{EnumIter, IntoEnumIterator as _, IntoStaticStr};

use super::room_list::Room;

/// An intent. The keymap makes actions from keys. Its name in keymap files is that of the innermost variant; the message
/// `action-NAME` says what it does. What only some rooms know is an enum of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Action {
    /// Go to a room; its name is that of the room.
    #[strum(disabled)]
    Show(Room),
    /// Move the cursor or scroll; its name is that of the step.
    #[strum(disabled)]
    Move(Step),
    /// Open the command line.
    CommandLine,
    /// Open or close the help.
    Help,
    /// Look back through the notices.
    #[strum(serialize = "look-back-notices")]
    Notices,
    /// Show the mission's brief again.
    Brief,
    /// Take what was typed or is under the cursor.
    Submit,
    /// Take back: what was typed, the selection, the overlay.
    Escape,
    /// Fly the same mission again, as chance will have it this time.
    Again,
    /// Fly the same mission again, exactly as it was.
    AgainAlike,
    /// Choose who trains here.
    Profiles,
    /// Have more or less advice come by itself.
    Aids,
    /// Let the mission stand still, or go on.
    PauseMission,
    /// Let simulated time pass faster.
    Faster,
    /// Let simulated time pass as usual.
    UsualPace,
    /// End the mission now.
    Abandon,
    /// Steer what is replayed.
    #[strum(disabled)]
    Replay(ReplayAction),
    /// Back to the home screen.
    Leave,
    /// Take note of the alerts.
    Acknowledge,
    /// How a room shows its lists, and of which vehicle. Several rooms know these.
    #[strum(disabled)]
    View(ViewAction),
    /// Which vehicles are selected; where parameters are compared, which are marked.
    #[strum(disabled)]
    Select(SelectAction),
    /// Completions and history of a line that is being written.
    #[strum(disabled)]
    Line(LineAction),
    /// Other ways to fly a mission that is listed.
    #[strum(disabled)]
    Start(StartAction),
    /// Actions of the Debrief room.
    #[strum(disabled)]
    Debrief(DebriefAction),
    /// Actions of the Map room.
    #[strum(disabled)]
    Map(MapAction),
    /// Actions of the Ledger room.
    #[strum(disabled)]
    Ledger(LedgerAction),
    /// Actions of the Parameters room.
    #[strum(disabled)]
    Parameters(ParametersAction),
    /// Actions of the Messages room.
    #[strum(disabled)]
    Messages(MessagesAction),
    /// Actions of the Hangar room.
    #[strum(disabled)]
    Hangar(HangarAction),
    /// Actions of the Workshop room.
    #[strum(disabled)]
    Workshop(WorkshopAction),
    Quit,
}

impl Action {
    /// What moves a cursor or scrolls, in the order of hints.
    pub const UP_AND_DOWN: &[Self] = &[Self::Move(Step::Down), Self::Move(Step::Up)];

    /// Every action: the rooms, the steps of a cursor, those that hold everywhere, and those of some rooms.
    pub fn all() -> impl Iterator<Item = Self> {
        let rooms = Room::ALL.into_iter().map(Self::Show);
        let steps = Step::iter().map(Self::Move);
        let shared = (ViewAction::iter().map(Self::View))
            .chain(SelectAction::iter().map(Self::Select))
            .chain(LineAction::iter().map(Self::Line))
            .chain(StartAction::iter().map(Self::Start))
            .chain(ReplayAction::iter().map(Self::Replay));
        let of_one_room = (DebriefAction::iter().map(Self::Debrief))
            .chain(MapAction::iter().map(Self::Map))
            .chain(LedgerAction::iter().map(Self::Ledger))
            .chain(ParametersAction::iter().map(Self::Parameters))
            .chain(MessagesAction::iter().map(Self::Messages))
            .chain(HangarAction::iter().map(Self::Hangar))
            .chain(WorkshopAction::iter().map(Self::Workshop));
        let everywhere = Self::iter();
        rooms
            .chain(steps)
            .chain(everywhere)
            .chain(shared)
            .chain(of_one_room)
    }

    /// Its name in keymap files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Show(room) => room.name(),
            Self::Move(step) => step.into(),
            Self::View(action) => action.into(),
            Self::Select(action) => action.into(),
            Self::Line(action) => action.into(),
            Self::Start(action) => action.into(),
            Self::Replay(action) => action.into(),
            Self::Debrief(action) => action.into(),
            Self::Map(action) => action.into(),
            Self::Ledger(action) => action.into(),
            Self::Parameters(action) => action.into(),
            Self::Messages(action) => action.into(),
            Self::Hangar(action) => action.into(),
            Self::Workshop(action) => action.into(),
            Self::CommandLine
            | Self::Help
            | Self::Notices
            | Self::Brief
            | Self::Submit
            | Self::Escape
            | Self::Again
            | Self::AgainAlike
            | Self::Profiles
            | Self::Aids
            | Self::PauseMission
            | Self::Faster
            | Self::UsualPace
            | Self::Abandon
            | Self::Leave
            | Self::Acknowledge
            | Self::Quit => self.into(),
        }
    }

    /// The action of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|action| action.name() == name)
    }
}

/// How a room shows its lists, and of which vehicle. Several rooms know these.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ViewAction {
    /// Show only what contains some letters.
    Filter,
    /// Order by something else.
    Sort,
    /// Turn the order round.
    SortReverse,
    /// The next vehicle by number.
    NextVehicle,
    PreviousVehicle,
    /// Show what the screen has no room for at the same time.
    NextPage,
    /// Look further back in time.
    Window,
}

/// Which vehicles are selected; where parameters are compared, which are marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum SelectAction {
    /// Select the vehicle under the cursor, or take it out of the selection.
    #[strum(serialize = "select")]
    Toggle,
    SelectAll,
    Invert,
    /// Take back the last character of the vehicle list.
    Erase,
}

/// Completions and history of a line that is being written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LineAction {
    /// Put the next completion into the command line.
    Complete,
    /// Put the previous completion into the command line.
    CompleteBack,
    /// An older line of the history.
    Older,
    /// A newer line of the history.
    Newer,
}

/// Other ways to fly a mission that is listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum StartAction {
    /// Fly the short exercise for a mission.
    Drill,
    /// Fly a mission with the seed of the day.
    Daily,
    /// Fly a mission's exam.
    Exam,
    /// Fly a mission for practice, with a seed of one's own.
    Practise,
}

/// Steers what is replayed, in every room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ReplayAction {
    /// Play, or stand still.
    PlayReplay,
    /// Play from here back to the beginning.
    Rewind,
    /// Go ten seconds back in the replay.
    ReplayBack,
    /// Go ten seconds on in the replay.
    ReplayForward,
    /// Show the frame before.
    FrameBack,
    /// Show the next frame.
    FrameForward,
    /// To the moment before.
    PreviousMoment,
    /// To the moment after.
    NextMoment,
    /// Show all moments, to go to one.
    ShowMoments,
    /// Replay the flight that was recorded last.
    ReplayNewest,
    /// Review the flight that was recorded last.
    ReviewNewest,
}

/// Actions of the Debrief room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum DebriefAction {
    /// Fly the mission after this one.
    NextMission,
    /// Show the truth on the map, or the text again.
    TruthMap,
    /// To the next section of a text.
    NextSection,
    /// To the section before.
    PreviousSection,
}

/// Actions of the Map room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum MapAction {
    /// Come closer to what is under the cursor.
    ZoomIn,
    /// Go away from it.
    ZoomOut,
    Fit,
    /// Let the view follow the vehicle under the cursor, or stop that.
    Follow,
    /// Put what is under the cursor into the middle.
    Centre,
    /// Measure from here, or stop measuring.
    Ruler,
    /// Write a command that sends vehicles to the place under the cursor.
    GotoHere,
    /// Show or hide where the vehicles have been.
    Trails,
    /// Show or hide what the signs mean.
    Legend,
    /// Show what the next sensor has found.
    NextSensor,
}

/// Actions of the Ledger room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LedgerAction {
    /// Show only what ended in the next way.
    NextOutcome,
    /// Show only what concerns the vehicle under the cursor, or the selected ones.
    OwnVehicles,
}

/// Actions of the Parameters room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ParametersAction {
    /// Show only the parameters that have changed, or all.
    ChangedParameters,
    /// Write a vehicle's parameters into a file.
    SaveParameters,
    /// Compare with a file, to set what differs.
    LoadParameters,
    /// Compare with a file or another vehicle.
    CompareParameters,
    /// Set the parameters that are marked.
    ApplyParameters,
    /// Ask the vehicle for all its parameters again.
    FetchParameters,
}

/// Actions of the Messages room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum MessagesAction {
    /// Open a branch, or go into what is under the cursor.
    Expand,
    /// Close a branch, or go back.
    Collapse,
    /// Close all branches, or open them.
    FoldAll,
    /// To the other half of the screen.
    OtherSide,
    /// Let the picture stand still, or go on.
    Pause,
    /// Draw what is under the cursor as a graph, or no longer.
    Pin,
    /// Show bytes, or what they mean.
    Hex,
}

/// Actions of the Hangar room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum HangarAction {
    /// Start the process under the cursor again.
    RestartProcess,
    /// End the process under the cursor.
    StopProcess,
}

/// Actions of the Workshop room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum WorkshopAction {
    /// To the other list.
    OtherPane,
    /// Take out the part, the design or the choice under the cursor.
    TakeOut,
    /// Buy the right to use the part under the cursor.
    BuyPart,
    /// Take back the last change.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Begin a new design.
    NewDesign,
    /// Keep the design under a name.
    SaveDesign,
    /// Show all designs, or the bench again.
    Designs,
    /// Compare the design on the bench with another one.
    CompareDesign,
    /// Keep a copy of the design.
    CopyDesign,
    /// Give the design another name.
    RenameDesign,
    /// Write the design to a file.
    ExportDesign,
    /// Read a design from a file.
    ImportDesign,
    /// Show something else beside the lists.
    NextView,
    /// Build for the mission before.
    MissionBefore,
    /// Build for the mission after.
    MissionAfter,
    /// Show the seats of the mission's fleet, or the bench again.
    Seats,
    /// Choose the design for all seats.
    AllSeats,
    /// Fly the mission with the drones that were chosen.
    FlyFleet,
}

/// How far a cursor moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Step {
    Up,
    Down,
    /// One column to the left.
    Left,
    /// One column to the right.
    Right,
    PageUp,
    PageDown,
    /// To the first line.
    First,
    /// To the last line.
    Last,
    /// To a line that was pointed at, counted from 0. No key means it.
    #[strum(disabled)]
    Row(usize),
}

impl Step {
    /// Where a cursor at `at` of `count` lines goes; stays within them.
    pub fn apply(self, at: usize, count: usize) -> usize {
        let last = count.saturating_sub(1);
        match self {
            Self::Up => at.saturating_sub(1),
            Self::Down => at.saturating_add(1).min(last),
            Self::Left | Self::Right => at.min(last),
            Self::PageUp => at.saturating_sub(10),
            Self::PageDown => at.saturating_add(10).min(last),
            Self::First => 0,
            Self::Last => last,
            Self::Row(row) => row.min(last),
        }
    }
}
