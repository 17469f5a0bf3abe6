//! What a member of a crew may do: the host decides what concerns the whole flight, and roles have their own verbs.
//!
//! Keys, lines and hints ask here, so that a member is offered what is open, and refused the rest with its reason.

use crate::app::State;
use crate::app::action::{Action, DebriefAction, ParametersAction, PlansAction};
use crate::app::keymap::{HintKeys, KeyHint};
use crate::language::{self, ConsoleLine, LineNeeds, Meaning, words};
use crate::text;
use crate::text::Text;

/// Whether an action concerns the whole flight, or the host's machine.
fn is_of_host(action: Action) -> bool {
    matches!(
        action,
        Action::PauseMission
            | Action::Faster
            | Action::UsualPace
            | Action::Again
            | Action::AgainAlike
            | Action::Abandon
            | Action::TakeSticks
            | Action::Start(_)
            | Action::Debrief(DebriefAction::NextMission)
            | Action::Hangar(_)
            | Action::Files(_)
            | Action::Plans(PlansAction::UploadDraft)
            | Action::Parameters(
                ParametersAction::LoadParameters
                    | ParametersAction::ApplyParameters
                    | ParametersAction::FetchParameters
            )
    )
}

/// Whether a line for the console concerns the whole flight, or a flight of this console's own.
fn is_line_of_host(line: &ConsoleLine) -> bool {
    let is_own_flight = matches!(
        line,
        ConsoleLine::Pause
            | ConsoleLine::Continue
            | ConsoleLine::Speedup(_)
            | ConsoleLine::Fly(_)
            | ConsoleLine::FlyFree
            | ConsoleLine::Connect(_)
            | ConsoleLine::Replay(_)
    );
    is_own_flight || line.needs() == LineNeeds::Flight
}

impl State {
    /// Why an action is not open to the user of this console; `None` if it is.
    pub fn action_refusal(&self, action: Action) -> Option<Text> {
        self.crew.member()?;
        match action {
            Action::Replay(_) if self.is_following() => Some(text!("crew-live")),
            _ => is_of_host(action).then(|| text!("crew-host-decides")),
        }
    }

    /// Why a line for the console is not open to its user; `None` if it is.
    pub fn line_refusal(&self, line: &ConsoleLine) -> Option<Text> {
        let is_refused = self.crew.member().is_some() && is_line_of_host(line);
        is_refused.then(|| text!("crew-host-decides"))
    }

    /// Whether a line that begins with these words may be offered to the user of this console.
    pub fn may_write(&self, line: &str) -> bool {
        let Some(place) = self.crew.member() else {
            return true;
        };
        let first = words(line).into_iter().next();
        let row = first.and_then(|first| language::row(first.text));
        if let Some(row) = row.filter(|row| row.scope.takes_targets()) {
            return place.role().may_say(&row.verb);
        }
        let read = self.with_context(|context| language::parse(line, context));
        match read.map(|statement| statement.meaning) {
            Ok(Meaning::Console(own)) => !is_line_of_host(&own),
            Ok(Meaning::Act(_) | Meaning::Wait(_)) | Err(_) => true,
        }
    }

    /// Whether the keys of a hint do something for the user of this console.
    pub fn may_use(&self, hint: KeyHint) -> bool {
        match hint.keys {
            HintKeys::Actions(actions) => {
                let mut actions = actions.iter();
                actions.any(|action| self.action_refusal(*action).is_none())
            }
            HintKeys::Words(line) => self.may_write(line),
            HintKeys::Lines(lines) => lines.iter().any(|line| self.may_write(line)),
            HintKeys::VehicleList => true,
        }
    }
}
