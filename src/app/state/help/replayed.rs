//! The effect that keys have while a recorded flight is shown.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::app::action::{Action, MapAction, ParametersAction, PlansAction};
use crate::app::keymap::Meaning;
use crate::language::{self, Channel, Context, LineNeeds, VerbRow, rows, words};

/// The effect of a key in a replay.
pub(super) enum ReplayUse {
    Same,
    /// A key that controls the replay, with the id of its description.
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
                Some(row) if !is_carried_out(row) => ReplayUse::None,
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
        | Action::TakeSticks
        | Action::Map(MapAction::GotoHere)
        | Action::Parameters(
            ParametersAction::LoadParameters
            | ParametersAction::ApplyParameters
            | ParametersAction::FetchParameters
            | ParametersAction::ReadDocuments,
        )
        | Action::Files(_)
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
        | Action::Class(_)
        | Action::Workshop(_)
        | Action::Quit => ReplayUse::Same,
    }
}

/// Whether a replay carries out lines of a verb. Verbs of vehicles are refused, and others have no effect if each of
/// their lines needs a flight under way.
pub(super) fn is_carried_out(row: &VerbRow) -> bool {
    CARRIED_OUT.contains(row.name())
}

/// The verbs that a replay carries out. They follow from the table alone, and the help, which is drawn anew with every
/// frame, needs them for each of its keys.
static CARRIED_OUT: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    rows()
        .filter(|row| has_use(row))
        .map(VerbRow::name)
        .collect()
});

fn has_use(row: &VerbRow) -> bool {
    if row.scope.takes_targets() {
        return false;
    }
    // Lines that lack an argument, or name something of this session, do not parse here and are
    // left out.
    let lines = std::iter::once(row.name()).chain(row.examples.iter().copied());
    let context = Context {
        channel: Channel::Screen,
        ..Context::default()
    };
    let read = lines.filter_map(|line| language::parse(line, &context).ok());
    let needs: Vec<bool> = read
        .map(|statement| match statement.meaning {
            language::Meaning::Console(own) => own.needs() == LineNeeds::Flight,
            language::Meaning::Act(_) | language::Meaning::Wait(_) => true,
        })
        .collect();
    needs.is_empty() || needs.contains(&false)
}
