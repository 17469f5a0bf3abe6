//! What a member of a crew may do: the host decides what concerns the whole flight, and roles have their own verbs.
//!
//! Keys, lines and hints ask here, so that a member is offered what is open, and refused the rest with its reason.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::app::State;
use crate::app::action::{Action, DebriefAction, ParametersAction, PlansAction};
use crate::app::keymap::{self, HintKeys, KeyHint, Place};
use crate::app::room_list::Room;
use crate::crew::Role;
use crate::language::{self, Channel, ConsoleLine, Context, LineNeeds, Meaning, VerbRow, words};
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

/// Whether a member has a place of keys: a crew shows no flight of the past, and has the rooms of the flight alone.
fn is_place_of_member(place: Place) -> bool {
    !matches!(
        place,
        Place::Replay | Place::In(Room::Home | Room::Class | Room::Hangar | Room::Files)
    )
}

/// Whether a key does something for members with a role.
pub(super) fn is_meant_for_member(place: Place, meaning: &keymap::Meaning, role: Role) -> bool {
    is_place_of_member(place)
        && match meaning {
            keymap::Meaning::Do(Action::Replay(_) | Action::Class(_)) => false,
            keymap::Meaning::Do(Action::Show(room)) => is_place_of_member(Place::In(*room)),
            keymap::Meaning::Do(action) => !is_of_host(*action),
            keymap::Meaning::Write(line) | keymap::Meaning::Give(line) => {
                let first = words(line).into_iter().next();
                let row = first.and_then(|first| language::row(first.text));
                row.is_none_or(|row| is_row_of_member(row, role))
            }
            keymap::Meaning::Type => true,
        }
}

/// Whether members with a role can give lines of a verb.
pub(super) fn is_row_of_member(row: &VerbRow, role: Role) -> bool {
    if row.scope.takes_targets() {
        return role.may_say(&row.verb);
    }
    let is_of_pilots = ROWS_OF_PILOTS.contains(row.name());
    !ROWS_OF_HOST.contains(row.name()) && (role == Role::Pilot || !is_of_pilots)
}

/// The verbs for the console whose lines are all the host's. They follow from the table alone, and the help, which is
/// drawn anew with every frame, needs them for each of its keys.
static ROWS_OF_HOST: LazyLock<BTreeSet<&str>> = LazyLock::new(|| rows_of(is_line_of_host));

/// The verbs for the console of which only who flies vehicles can make use.
static ROWS_OF_PILOTS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| rows_of(is_line_of_pilots));

/// The verbs for the console whose lines are all like this.
fn rows_of(is_so: fn(&ConsoleLine) -> bool) -> BTreeSet<&'static str> {
    let own = language::rows().filter(|row| !row.scope.takes_targets());
    let found = own.filter(|row| {
        let mut lines = read_lines(row).peekable();
        lines.peek().is_some() && lines.all(|line| is_so(&line))
    });
    found.map(VerbRow::name).collect()
}

/// Whether a line is of use only to who flies vehicles: drafts are plans for them.
fn is_line_of_pilots(line: &ConsoleLine) -> bool {
    matches!(line, ConsoleLine::Draft(_))
}

/// The lines of a verb for the console, as far as its examples can be read anywhere.
fn read_lines(row: &VerbRow) -> impl Iterator<Item = ConsoleLine> {
    let context = Context {
        channel: Channel::Screen,
        ..Context::default()
    };
    let lines = std::iter::once(row.name()).chain(row.examples.iter().copied());
    lines.filter_map(
        move |line| match language::parse(line, &context).ok()?.meaning {
            Meaning::Console(own) => Some(own),
            Meaning::Act(_) | Meaning::Wait(_) => None,
        },
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
            Ok(Meaning::Console(own)) => {
                !is_line_of_host(&own) && (place.role() == Role::Pilot || !is_line_of_pilots(&own))
            }
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
