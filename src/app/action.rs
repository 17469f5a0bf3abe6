//! What the user wants, whichever key said it.

use strum::{EnumIter, IntoEnumIterator as _, IntoStaticStr};

use super::room_list::Room;

/// An intent. The keymap makes actions from keys. Its name in keymap files is that of the variant; the message
/// `action-NAME` says what it does.
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
    /// Select the vehicle under the cursor, or take it out of the selection.
    #[strum(serialize = "select")]
    Toggle,
    SelectAll,
    Invert,
    /// Take back the last character of the vehicle list.
    Erase,
    /// Take what was typed or is under the cursor.
    Submit,
    /// Take back: what was typed, the selection, the overlay.
    Escape,
    /// Fly the same mission again, as chance will have it this time.
    Again,
    /// Fly the same mission again, exactly as it was.
    AgainAlike,
    /// Fly the mission after this one.
    NextMission,
    /// Fly the short exercise for a mission.
    Drill,
    /// Fly a mission with the seed of the day.
    Daily,
    /// Fly a mission's exam.
    Exam,
    /// Fly a mission for practice, with a seed of one's own.
    Practise,
    /// Choose who trains here.
    Profiles,
    /// Have more or less advice come by itself.
    Aids,
    /// Let the mission stand still, or go on.
    PauseMission,
    /// End the mission now.
    Abandon,
    /// Show the truth on the map, or the text again.
    TruthMap,
    /// To the next section of a text.
    NextSection,
    /// To the section before.
    PreviousSection,
    /// Back to the home screen.
    Leave,
    /// Put the next completion into the command line.
    Complete,
    /// Put the previous completion into the command line.
    CompleteBack,
    /// An older line of the history.
    Older,
    /// A newer line of the history.
    Newer,
    /// Show only what contains some letters.
    Filter,
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
    /// The next vehicle by number.
    NextVehicle,
    PreviousVehicle,
    /// Show or hide where the vehicles have been.
    Trails,
    /// Show or hide what the signs mean.
    Legend,
    /// Show what the next sensor has found.
    NextSensor,
    /// Look further back in time.
    Window,
    /// Show what the screen has no room for at the same time.
    NextPage,
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
    /// Order by something else.
    Sort,
    /// Turn the order round.
    SortReverse,
    /// Take note of the alerts.
    Acknowledge,
    /// Show only what ended in the next way.
    NextOutcome,
    /// Show only what concerns the vehicle under the cursor, or the selected ones.
    OwnVehicles,
    /// Start the process under the cursor again.
    RestartProcess,
    /// End the process under the cursor.
    StopProcess,
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
    Quit,
}

impl Action {
    /// What moves a cursor or scrolls, in the order of hints.
    pub const UP_AND_DOWN: &[Self] = &[Self::Move(Step::Down), Self::Move(Step::Up)];

    /// Every action: the rooms, the steps of a cursor, and the others.
    pub fn all() -> impl Iterator<Item = Self> {
        let rooms = Room::ALL.into_iter().map(Self::Show);
        let steps = Step::iter().map(Self::Move);
        rooms.chain(steps).chain(Self::iter())
    }

    /// Its name in keymap files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Show(room) => room.name(),
            Self::Move(step) => step.into(),
            other => other.into(),
        }
    }

    /// The action of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|action| action.name() == name)
    }
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
        }
    }
}
