//! Actions of single rooms.

use strum::{EnumIter, IntoStaticStr};

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
    /// Read what the vehicle documents about its parameters.
    ReadDocuments,
}

/// Actions of the Files room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum FilesAction {
    /// Show the folder that contains the shown one.
    ParentFolder,
    /// Write a line that copies the file to this machine.
    GetFile,
    /// Copy a file of this machine into the folder.
    PutFile,
    RemoveFile,
    /// Write a line that makes a folder.
    MakeFolder,
    /// Request the checksum of the file.
    CheckFile,
    /// List the folder again.
    ListAgain,
}

/// Actions of the Plans room about drafts, lists and the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum PlansAction {
    /// Go to the next item of the list.
    NextItem,
    /// Go to the previous item of the list.
    PreviousItem,
    /// Begin to mark items at the item under the cursor, or stop marking.
    MarkItems,
    PlanList,
    FenceList,
    RallyList,
    NextDraft,
    PreviousDraft,
    /// Begin an empty draft.
    NewDraft,
    /// Write a line that opens a file.
    OpenDraft,
    /// Open the lists that the vehicles have on board.
    TakePlan,
    /// Write a line that saves the draft.
    SaveDraft,
    /// Write a line that uploads the draft.
    UploadDraft,
    /// Write a line that divides the drawn area among vehicles.
    SurveyDraft,
    /// Write a line that flies the drafts in simulation.
    TryDrafts,
    /// Show the figures of the last rehearsal, or the items again.
    ShowFigures,
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

/// Changes to the draft in the Plans room, in the list that is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum DrawAction {
    /// Add an item at the map's cursor.
    AddItem,
    /// Insert an item at the map's cursor, before the item under the cursor.
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
    /// Measure heights from the next reference, or switch an area of a fence between inclusion and
    /// exclusion.
    NextFrame,
    AddTakeoff,
    /// Add a landing at the map's cursor.
    AddLand,
    /// Add a return to launch.
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
    /// Put the last frame on the command line, to be edited and sent.
    SendAgain,
    /// Forget the messages counted so far, and begin new statistics.
    ResetStatistics,
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

/// Actions of the Class room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ClassAction {
    /// Mark the seat under the cursor, or remove its mark.
    MarkSeat,
    MarkAllSeats,
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
