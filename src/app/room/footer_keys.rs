//! The keys that several rooms show on the last line of the screen.

use super::State;
use crate::app::action::Action;
use crate::app::keymap::{KeyHint, hint, hint_words};

pub const COMMAND: KeyHint = hint(&[Action::CommandLine], "hint-command");
pub const HELP: KeyHint = hint(&[Action::Help], "hint-help");
pub const MOVE: KeyHint = hint(Action::UP_AND_DOWN, "hint-move");
pub const SCROLL: KeyHint = hint(Action::UP_AND_DOWN, "hint-scroll");
pub const BACK: KeyHint = hint(&[Action::Escape], "hint-back");
pub const PAUSE: KeyHint = hint(&[Action::PauseMission], "hint-pause");
pub const MISSION_HINT: KeyHint = hint_words("hint", "hint-hint");
pub const EXPORT: KeyHint = hint_words("review export", "hint-export");
pub const GHOST: KeyHint = hint_words("ghost", "hint-ghost");
pub const PREDICT: KeyHint = hint_words("predict ", "hint-predict");
pub const GOAL: KeyHint = hint_words("goal ", "hint-goal");

/// Whether a hint's keys are useful now, to this user: pause, if the mission allows it; a mission's hint, if one
/// is left; prediction and goal, before launch; export and ghost, during a replay.
pub fn is_of_use(state: &State, hint: KeyHint) -> bool {
    let mission = state.session.task.progress.as_ref();
    match hint {
        _ if !state.may_use(hint) => false,
        PAUSE => state.flown_mission().is_none_or(|it| it.pausable),
        MISSION_HINT => mission.is_some_and(|mission| mission.clues.next.is_some()),
        PREDICT | GOAL => state.can_pledge(),
        EXPORT | GHOST => state.replay.is_some(),
        _ => true,
    }
}
