//! The keys of the inspector.

use crossterm::event::KeyCode;

use super::Messages;
use crate::app::State;
use crate::app::action::{Action, MessagesAction, Step, ViewAction};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest};
use crate::app::state::Purpose;
use crate::inspector::{Direction, name_of, target_of, written};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::wire::Anatomy;

const HINTS: &[KeyHint] = &[
    hint(&[Action::Help], "messages-key-help"),
    hint(&[Action::Submit], "messages-key-open"),
    hint(
        &[Action::Messages(MessagesAction::OtherSide)],
        "messages-key-fields",
    ),
    hint(
        &[Action::Messages(MessagesAction::Pin)],
        "messages-key-graph",
    ),
    hint(
        &[Action::Messages(MessagesAction::Hex)],
        "messages-key-bytes",
    ),
    hint(
        &[Action::Messages(MessagesAction::SendAgain)],
        "messages-key-send",
    ),
    hint(&[Action::View(ViewAction::Filter)], "messages-key-filter"),
    hint(&[Action::View(ViewAction::Sort)], "messages-key-sort"),
    hint(
        &[Action::Messages(MessagesAction::ResetStatistics)],
        "messages-key-reset",
    ),
    hint(
        &[Action::Messages(MessagesAction::Pause)],
        "messages-key-pause",
    ),
    hint(
        &[Action::Messages(MessagesAction::FoldAll)],
        "messages-key-fold",
    ),
];

impl RoomModel for Messages {
    const KEYS: &'static [KeyRow] = &[
        does(key('/'), Action::View(ViewAction::Filter)),
        does(ENTER, Action::Submit),
        does(
            Press::Plain(KeyCode::Right),
            Action::Messages(MessagesAction::Expand),
        ),
        does(
            Press::Plain(KeyCode::Left),
            Action::Messages(MessagesAction::Collapse),
        ),
        does(
            Press::Plain(KeyCode::Tab),
            Action::Messages(MessagesAction::OtherSide),
        ),
        does(key('z'), Action::Messages(MessagesAction::FoldAll)),
        does(key('p'), Action::Messages(MessagesAction::Pause)),
        does(key('g'), Action::Messages(MessagesAction::Pin)),
        does(key('x'), Action::Messages(MessagesAction::Hex)),
        does(key('e'), Action::Messages(MessagesAction::SendAgain)),
        does(key('r'), Action::Messages(MessagesAction::ResetStatistics)),
        does(key('s'), Action::View(ViewAction::Sort)),
        does(ESCAPE, Action::Escape),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        state.rooms.messages.go(step);
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        state.rooms.messages.submit();
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        let room = &mut state.rooms.messages;
        if room.field.take().is_none() {
            room.filter.clear();
            state.hush();
        }
        Some(Vec::new())
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        let room = &mut state.rooms.messages;
        match action {
            ViewAction::Filter => {
                let filter = room.filter.clone();
                state.prompt(Purpose::Filter(Room::Messages), filter);
            }
            ViewAction::Sort => room.sort = room.sort.next(),
            ViewAction::SortReverse
            | ViewAction::NextVehicle
            | ViewAction::PreviousVehicle
            | ViewAction::NextPage
            | ViewAction::Window => return None,
        }
        Some(Vec::new())
    }

    fn filter(state: &mut State, text: &str) {
        text.trim().clone_into(&mut state.rooms.messages.filter);
    }
}

pub(in crate::app::room) fn act(state: &mut State, action: MessagesAction) -> Vec<RoomRequest> {
    let choose = text!(
        "messages-choose-field",
        key = state.key(Action::Messages(MessagesAction::OtherSide))
    );
    let room = &mut state.rooms.messages;
    match action {
        MessagesAction::Expand => room.expand(),
        MessagesAction::Collapse => room.collapse(),
        MessagesAction::OtherSide if room.field.is_some() => room.field = None,
        MessagesAction::OtherSide => room.enter_fields(),
        MessagesAction::FoldAll => room.fold_all(),
        MessagesAction::Pause => room.paused = !room.paused,
        MessagesAction::Hex => room.hex = !room.hex,
        MessagesAction::ResetStatistics if room.paused => {
            state.say(Severity::Notice, text!("messages-reset-paused"));
        }
        MessagesAction::ResetStatistics => {
            state.session.connections.statistics_resets += 1;
            state.say(Severity::Info, text!("messages-reset"));
        }
        MessagesAction::SendAgain => match send_again(state) {
            Ok(line) => return vec![RoomRequest::Write(line)],
            Err(reason) => state.say(Severity::Notice, reason),
        },
        MessagesAction::Pin => {
            if let Err(reason) = room.pin(&choose) {
                state.say(Severity::Notice, reason);
            }
        }
    }
    Vec::new()
}

/// The line that sends the last frame of the message under the cursor again: to its receiver, or to the vehicle that
/// sent it.
fn send_again(state: &State) -> Result<String, Text> {
    let selected = state.rooms.messages.selected();
    let selected = selected.ok_or_else(|| text!("messages-choose-message"))?;
    let name = name_of(selected.key.message);
    let frame = Anatomy::of(&selected.tally.last);
    let fields = frame.as_ref().and_then(written);
    let fields = fields.ok_or_else(|| text!("messages-not-sendable", message = name))?;
    let system = match selected.key.source.direction {
        Direction::In => Some(selected.key.source.system),
        Direction::Out => frame.as_ref().and_then(target_of),
    };
    let vehicles = state.session.vehicles.values();
    let named = vehicles.filter(|vehicle| Some(vehicle.system) == system);
    let targets: Vec<String> = named
        .take(1)
        .map(|vehicle| format!("{} ", vehicle.id))
        .collect();
    Ok(format!("{}send {fields}", targets.concat()))
}
