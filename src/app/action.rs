//! What the user wants, whichever key said it.

/// An intent. The keymap makes actions from keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Open the command line with these words in it.
    Palette(&'static str),
    /// Open or close the help.
    Help,
    /// Show what the links count.
    Links,
    /// Look back through the commands.
    Ledger,
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
    /// A character of a vehicle list such as `3-9`.
    Type(char),
    /// Take back the last character of the vehicle list.
    Erase,
    /// Take what was typed or is under the cursor.
    Submit,
    /// Take back: what was typed, the selection, the overlay.
    Escape,
    /// Fly the same mission again.
    Again,
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
    /// Ten lines up.
    PageUp,
    /// Ten lines down.
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
            Self::PageUp => at.saturating_sub(10),
            Self::PageDown => at.saturating_add(10).min(last),
            Self::First => 0,
            Self::Last => last,
        }
    }
}
