//! What the user wants, whichever key said it.

use super::room::Room;

/// An intent. The keymap makes actions from keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Go to a room.
    Show(Room),
    /// Open the command line.
    CommandLine,
    /// Open or close the help.
    Help,
    /// Look back through the notices.
    Notices,
    /// Show the mission's brief again.
    Brief,
    /// Move the cursor or scroll.
    Move(Step),
    /// Select the vehicle under the cursor, or take it out of the selection.
    Toggle,
    /// Select all vehicles.
    SelectAll,
    /// Select the others.
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
    /// Show everything.
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
    /// The vehicle before.
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
    /// Leave the program.
    Quit,
}

/// How far a cursor moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// One line up.
    Up,
    /// One line down.
    Down,
    /// One column to the left.
    Left,
    /// One column to the right.
    Right,
    /// Ten lines up.
    PageUp,
    /// Ten lines down.
    PageDown,
    /// To the first line.
    First,
    /// To the last line.
    Last,
}

impl Action {
    /// Every action with its name in keymap files. The message `action-NAME` says what it does.
    pub const ALL: &[(&'static str, Self)] = &[
        ("home", Self::Show(Room::Home)),
        ("fly", Self::Show(Room::Fly)),
        ("vehicle", Self::Show(Room::Vehicle)),
        ("map", Self::Show(Room::Map)),
        ("commands", Self::Show(Room::Ledger)),
        ("messages", Self::Show(Room::Messages)),
        ("links", Self::Show(Room::Links)),
        ("hangar", Self::Show(Room::Hangar)),
        ("parameters", Self::Show(Room::Parameters)),
        ("mission", Self::Show(Room::Mission)),
        ("debrief", Self::Show(Room::Debrief)),
        ("standing", Self::Show(Room::Standing)),
        ("workshop", Self::Show(Room::Workshop)),
        ("command-line", Self::CommandLine),
        ("help", Self::Help),
        ("look-back-notices", Self::Notices),
        ("brief", Self::Brief),
        ("up", Self::Move(Step::Up)),
        ("down", Self::Move(Step::Down)),
        ("left", Self::Move(Step::Left)),
        ("right", Self::Move(Step::Right)),
        ("page-up", Self::Move(Step::PageUp)),
        ("page-down", Self::Move(Step::PageDown)),
        ("first", Self::Move(Step::First)),
        ("last", Self::Move(Step::Last)),
        ("select", Self::Toggle),
        ("select-all", Self::SelectAll),
        ("invert", Self::Invert),
        ("erase", Self::Erase),
        ("submit", Self::Submit),
        ("escape", Self::Escape),
        ("again", Self::Again),
        ("again-alike", Self::AgainAlike),
        ("next-mission", Self::NextMission),
        ("drill", Self::Drill),
        ("daily", Self::Daily),
        ("exam", Self::Exam),
        ("practise", Self::Practise),
        ("profiles", Self::Profiles),
        ("aids", Self::Aids),
        ("pause-mission", Self::PauseMission),
        ("abandon", Self::Abandon),
        ("truth-map", Self::TruthMap),
        ("next-section", Self::NextSection),
        ("previous-section", Self::PreviousSection),
        ("leave", Self::Leave),
        ("complete", Self::Complete),
        ("complete-back", Self::CompleteBack),
        ("older", Self::Older),
        ("newer", Self::Newer),
        ("filter", Self::Filter),
        ("zoom-in", Self::ZoomIn),
        ("zoom-out", Self::ZoomOut),
        ("fit", Self::Fit),
        ("follow", Self::Follow),
        ("centre", Self::Centre),
        ("ruler", Self::Ruler),
        ("goto-here", Self::GotoHere),
        ("next-vehicle", Self::NextVehicle),
        ("previous-vehicle", Self::PreviousVehicle),
        ("trails", Self::Trails),
        ("legend", Self::Legend),
        ("next-sensor", Self::NextSensor),
        ("window", Self::Window),
        ("next-page", Self::NextPage),
        ("changed-parameters", Self::ChangedParameters),
        ("save-parameters", Self::SaveParameters),
        ("load-parameters", Self::LoadParameters),
        ("compare-parameters", Self::CompareParameters),
        ("apply-parameters", Self::ApplyParameters),
        ("fetch-parameters", Self::FetchParameters),
        ("expand", Self::Expand),
        ("collapse", Self::Collapse),
        ("fold-all", Self::FoldAll),
        ("other-side", Self::OtherSide),
        ("pause", Self::Pause),
        ("pin", Self::Pin),
        ("hex", Self::Hex),
        ("sort", Self::Sort),
        ("sort-reverse", Self::SortReverse),
        ("acknowledge", Self::Acknowledge),
        ("next-outcome", Self::NextOutcome),
        ("own-vehicles", Self::OwnVehicles),
        ("restart-process", Self::RestartProcess),
        ("stop-process", Self::StopProcess),
        ("other-pane", Self::OtherPane),
        ("take-out", Self::TakeOut),
        ("buy-part", Self::BuyPart),
        ("undo", Self::Undo),
        ("redo", Self::Redo),
        ("new-design", Self::NewDesign),
        ("save-design", Self::SaveDesign),
        ("designs", Self::Designs),
        ("compare-design", Self::CompareDesign),
        ("copy-design", Self::CopyDesign),
        ("rename-design", Self::RenameDesign),
        ("export-design", Self::ExportDesign),
        ("import-design", Self::ImportDesign),
        ("next-view", Self::NextView),
        ("mission-before", Self::MissionBefore),
        ("mission-after", Self::MissionAfter),
        ("seats", Self::Seats),
        ("all-seats", Self::AllSeats),
        ("fly-fleet", Self::FlyFleet),
        ("quit", Self::Quit),
    ];

    /// Its name in keymap files.
    pub fn name(self) -> &'static str {
        let mut all = Self::ALL.iter();
        all.find(|(_, action)| *action == self)
            .map_or("", |(name, _)| name)
    }

    /// The action of a name.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter();
        all.find(|(known, _)| *known == name)
            .map(|(_, action)| *action)
    }
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
