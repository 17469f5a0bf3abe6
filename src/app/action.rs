//! The user's intents, independent of their keys.

use strum::{EnumIter, IntoEnumIterator as _, IntoStaticStr};

use super::room_list::Room;

/// An intent, which the keymap makes from a key. Its name in keymap files is that of the innermost variant; the
/// message `action-NAME` says what it does. Actions of only some rooms have enums of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Action {
    /// Go to a room; the action has the room's name.
    #[strum(disabled)]
    Show(Room),
    /// Move the cursor or scroll; its name is that of the step.
    #[strum(disabled)]
    Move(Step),
    /// Open the command line.
    CommandLine,
    /// Open or close the help.
    Help,
    /// Show the past notices.
    #[strum(serialize = "look-back-notices")]
    Notices,
    /// Show the mission's brief again.
    Brief,
    /// Submit the typed text, or choose the item under the cursor.
    Submit,
    /// Cancel: the typed text, the selection, the overlay.
    Escape,
    /// Fly the same mission again with a new seed.
    Again,
    /// Fly the same mission again with the same seed.
    AgainAlike,
    Profiles,
    /// Change the level of automatic advice.
    Aids,
    /// Pause or resume the mission.
    PauseMission,
    /// Speed simulated time up.
    Faster,
    /// Return simulated time to real time.
    UsualPace,
    /// End the mission now.
    Abandon,
    #[strum(disabled)]
    Replay(ReplayAction),
    /// Return to the home screen.
    Leave,
    Acknowledge,
    /// List order, filter and vehicle, for the rooms that have them.
    #[strum(disabled)]
    View(ViewAction),
    /// Select vehicles, or mark parameters in a comparison.
    #[strum(disabled)]
    Select(SelectAction),
    /// Completions and history of the line being typed.
    #[strum(disabled)]
    Line(LineAction),
    /// Other ways to fly the listed mission.
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
    /// Actions of the Plans room about drafts, lists and the view.
    #[strum(disabled)]
    Plans(PlansAction),
    /// Changes of the draft in the Plans room.
    #[strum(disabled)]
    Draw(DrawAction),
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
    /// The cursor keys, in the order of hints.
    pub const UP_AND_DOWN: &[Self] = &[Self::Move(Step::Down), Self::Move(Step::Up)];

    /// Every action: the rooms, the cursor steps, the general ones, and those of single rooms.
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
            .chain(PlansAction::iter().map(Self::Plans))
            .chain(DrawAction::iter().map(Self::Draw))
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
            Self::Plans(action) => action.into(),
            Self::Draw(action) => action.into(),
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

    /// The action with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|action| action.name() == name)
    }
}

/// List order, filter and vehicle, for the rooms that have them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ViewAction {
    /// Filter the list by a text.
    Filter,
    /// Sort by the next column.
    Sort,
    SortReverse,
    /// The next vehicle by number.
    NextVehicle,
    PreviousVehicle,
    /// Show the next page where the screen is too small for all.
    NextPage,
    /// Show a longer time span.
    Window,
}

/// Select vehicles, or mark parameters in a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum SelectAction {
    /// Select the vehicle under the cursor, or deselect it.
    #[strum(serialize = "select")]
    Toggle,
    SelectAll,
    Invert,
    /// Delete the last character of the vehicle list.
    Erase,
}

/// Completions and history of the line being typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LineAction {
    /// Insert the next completion.
    Complete,
    /// Insert the previous completion.
    CompleteBack,
    /// Recall an older line of the history.
    Older,
    /// Recall a newer line of the history.
    Newer,
}

/// Other ways to fly the listed mission.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum StartAction {
    /// Fly the drill of a mission.
    Drill,
    /// Fly a mission with the seed of the day.
    Daily,
    /// Fly a mission's exam.
    Exam,
    /// Fly a mission for practice, with a chosen seed.
    Practise,
}

/// Controls the replay, in every room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ReplayAction {
    PlayReplay,
    Rewind,
    /// Jump ten seconds back.
    ReplayBack,
    /// Jump ten seconds forward.
    ReplayForward,
    /// Show the previous frame.
    FrameBack,
    /// Show the next frame.
    FrameForward,
    /// Go to the previous moment.
    PreviousMoment,
    /// Go to the next moment.
    NextMoment,
    /// List all moments to choose from.
    ShowMoments,
    /// Replay the newest record.
    ReplayNewest,
    /// Review the newest record.
    ReviewNewest,
}

/// Actions of the Debrief room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum DebriefAction {
    /// Fly the next mission.
    NextMission,
    /// Switch between the map of the truth and the text.
    TruthMap,
    /// Go to the next section.
    NextSection,
    /// Go to the previous section.
    PreviousSection,
}

/// Actions of the Map room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum MapAction {
    /// Zoom in on the cursor.
    ZoomIn,
    /// Zoom out from the cursor.
    ZoomOut,
    Fit,
    /// Follow the vehicle under the cursor, or stop following.
    Follow,
    /// Centre the view on the cursor.
    Centre,
    /// Start or end a measurement at the cursor.
    Ruler,
    /// Write a command that sends vehicles to the place under the cursor.
    GotoHere,
    /// Show or hide the trails.
    Trails,
    /// Show or hide the legend.
    Legend,
    /// Show the readings of the next sensor.
    NextSensor,
}

/// Actions of the Ledger room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LedgerAction {
    /// Filter by the next outcome.
    NextOutcome,
    /// Show only commands to the vehicle under the cursor, or the selected ones.
    OwnVehicles,
}

/// Actions of the Parameters room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ParametersAction {
    /// Show only the parameters that have changed, or all.
    ChangedParameters,
    /// Save a vehicle's parameters to a file.
    SaveParameters,
    /// Compare with a file and set the differences.
    LoadParameters,
    /// Compare with a file or another vehicle.
    CompareParameters,
    /// Set the marked parameters.
    ApplyParameters,
    /// Download all parameters of the vehicle again.
    FetchParameters,
}

/// Actions of the Plans room about drafts, lists and the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum PlansAction {
    /// Go to the next item of the list.
    NextItem,
    /// Go to the previous item of the list.
    PreviousItem,
    PlanList,
    FenceList,
    RallyList,
    NextDraft,
    PreviousDraft,
    /// Begin an empty draft.
    NewDraft,
    /// Write a line that opens a file.
    OpenDraft,
    /// Open what the vehicles have on board.
    TakePlan,
    /// Write a line that saves the draft.
    SaveDraft,
    /// Write a line that uploads the draft.
    UploadDraft,
    UndoEdit,
    RedoEdit,
    /// Write a line that changes heights.
    WriteHeight,
    /// Write a line that sets a parameter of an item.
    SetField,
    /// Write a line that changes an item's command.
    WriteCommand,
    /// Write a line that adds a jump.
    WriteJump,
    /// Zoom in on the map's cursor.
    CloserDraft,
    /// Zoom out from the map's cursor.
    WiderDraft,
    /// Fit the map to all drafts, vehicles, task areas and named places.
    FitDrafts,
    /// Centre the map on its cursor.
    CentreDraft,
}

/// Changes of the draft in the Plans room, in the list that is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum DrawAction {
    /// Add an item at the map's cursor.
    AddItem,
    /// The same before the item under the cursor.
    InsertItem,
    /// Move the marked items to the map's cursor.
    MoveItem,
    DeleteItem,
    /// Put a waypoint in the middle of the leg to the item.
    SplitLeg,
    /// Raise the marked items, or widen circles.
    Higher,
    /// Lower the marked items, or narrow circles.
    Lower,
    /// Measure heights from something else, or reverse an area of a fence.
    NextFrame,
    AddTakeoff,
    /// Add a landing at the map's cursor.
    AddLand,
    /// Add a return to the launch.
    AddReturn,
    /// Begin an area of the fence.
    BeginPolygon,
    /// Add a circle to the fence.
    AddCircle,
}

/// Actions of the Messages room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum MessagesAction {
    /// Open a branch, or enter the item under the cursor.
    Expand,
    /// Close a branch, or leave the item.
    Collapse,
    /// Close or open all branches.
    FoldAll,
    /// Go to the other half of the screen.
    OtherSide,
    /// Pause or resume the display.
    Pause,
    /// Draw or remove a graph of the field under the cursor.
    Pin,
    /// Switch between bytes and fields.
    Hex,
}

/// Actions of the Hangar room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum HangarAction {
    /// Restart the process under the cursor.
    RestartProcess,
    /// Stop the process under the cursor.
    StopProcess,
}

/// Actions of the Workshop room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum WorkshopAction {
    /// Go to the other list.
    OtherPane,
    /// Remove the part, the design or the choice under the cursor.
    TakeOut,
    /// Buy the part under the cursor.
    BuyPart,
    /// Undo the last change.
    Undo,
    /// Redo the last undone change.
    Redo,
    /// Start a new design.
    NewDesign,
    /// Save the design under a name.
    SaveDesign,
    /// Switch between the list of designs and the bench.
    Designs,
    /// Compare the design on the bench with another one.
    CompareDesign,
    /// Save a copy of the design.
    CopyDesign,
    RenameDesign,
    /// Write the design to a file.
    ExportDesign,
    /// Read a design from a file.
    ImportDesign,
    /// Show the next view beside the lists.
    NextView,
    /// Build for the previous mission.
    MissionBefore,
    /// Build for the next mission.
    MissionAfter,
    /// Switch between the seats of the mission's fleet and the bench.
    Seats,
    /// Use the design for all seats.
    AllSeats,
    /// Fly the mission with the chosen drones.
    FlyFleet,
}

/// A movement of the cursor.
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
    /// To a given line, counted from 0; sent by clicks, never by a key.
    #[strum(disabled)]
    Row(usize),
}

impl Step {
    /// The line after a step from `at` of `count` lines; never out of range.
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
