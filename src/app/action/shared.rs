//! Actions of several rooms and of overlays.

use strum::{EnumIter, IntoStaticStr};

/// List order, filter and vehicle, for the rooms that have them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ViewAction {
    /// Filter the list by a text.
    Filter,
    /// Sort by the next column.
    Sort,
    SortReverse,
    /// Go to the next vehicle by number.
    NextVehicle,
    PreviousVehicle,
    /// Show the next page, if the screen is too small for everything.
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

/// Actions that control the replay, in every room.
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
