//! The effect that keys have while a recorded flight is shown.

use crate::app::action::{Action, MapAction, ParametersAction, PlansAction};
use crate::app::keymap::Meaning;
use crate::language::{rows, words};

/// The effect of a key in a replay.
pub(super) enum ReplayUse {
    Same,
    /// It controls the replay: the id of its description.
    Control(&'static str),
    None,
}

/// The effect of a meaning in a replay.
pub(super) fn replayed(meaning: &Meaning) -> ReplayUse {
    match meaning {
        Meaning::Do(action) => action_replayed(*action),
        Meaning::Write(line) | Meaning::Give(line) => {
            let row = words(line)
                .first()
                .and_then(|verb| rows().find(|row| row.is_called(verb.text)));
            match row {
                Some(row) if row.scope.takes_targets() => ReplayUse::None,
                Some(_) | None => ReplayUse::Same,
            }
        }
        Meaning::Type => ReplayUse::Same,
    }
}

fn action_replayed(action: Action) -> ReplayUse {
    match action {
        Action::PauseMission => ReplayUse::Control("action-play-replay"),
        Action::Faster => ReplayUse::Control("action-replay-faster"),
        Action::UsualPace => ReplayUse::Control("action-replay-slower"),
        Action::Again
        | Action::AgainAlike
        | Action::Abandon
        | Action::Acknowledge
        | Action::Map(MapAction::GotoHere)
        | Action::Parameters(
            ParametersAction::LoadParameters
            | ParametersAction::ApplyParameters
            | ParametersAction::FetchParameters,
        )
        | Action::Plans(PlansAction::UploadDraft)
        | Action::Hangar(_) => ReplayUse::None,
        Action::Show(_)
        | Action::Move(_)
        | Action::CommandLine
        | Action::Help
        | Action::Notices
        | Action::Brief
        | Action::Submit
        | Action::Escape
        | Action::Profiles
        | Action::Aids
        | Action::Replay(_)
        | Action::Leave
        | Action::View(_)
        | Action::Select(_)
        | Action::Line(_)
        | Action::Start(_)
        | Action::Debrief(_)
        | Action::Map(_)
        | Action::Ledger(_)
        | Action::Parameters(_)
        | Action::Plans(_)
        | Action::Draw(_)
        | Action::Messages(_)
        | Action::Workshop(_)
        | Action::Quit => ReplayUse::Same,
    }
}
