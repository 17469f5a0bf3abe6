//! The class: at the desk, a row per seat, in the order in which they need help.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::app::State;
use crate::app::action::{Action, ClassAction, Step};
use crate::app::keymap::{ESCAPE, KeyHint, KeyRow, Meaning, does, hint, hint_words, key, writes};
use crate::app::room::{Answer, RoomModel, RoomRequest, footer_keys};
use crate::class::Desk;

/// The state of the room. Seats are meant by their index at the desk, which does not change when rows move.
#[derive(Debug, Clone, Default)]
pub struct ClassRoom {
    /// The seat under the cursor.
    pub(in crate::app) cursor: Option<usize>,
    /// The seats that orders to marked ones go to.
    pub(in crate::app) marked: BTreeSet<usize>,
    /// Whether the injects of the seat under the cursor are shown, instead of what happened there.
    pub(in crate::app) shows_injects: bool,
}

impl ClassRoom {
    /// The seat under the cursor.
    pub fn cursor(&self) -> Option<usize> {
        self.cursor
    }

    /// Whether a seat is marked.
    pub fn is_marked(&self, seat: usize) -> bool {
        self.marked.contains(&seat)
    }

    /// Whether the injects of the seat under the cursor are shown, instead of what happened there.
    pub fn shows_injects(&self) -> bool {
        self.shows_injects
    }

    /// The number of marked seats.
    pub fn marked(&self) -> usize {
        self.marked.len()
    }
}

/// The seats to which an order without seats goes: the marked ones, otherwise the one under the cursor.
pub fn addressed(state: &State) -> Vec<usize> {
    let room = &state.rooms.class;
    if room.marked.is_empty() {
        room.cursor.into_iter().collect()
    } else {
        room.marked.iter().copied().collect()
    }
}

/// Puts the cursor on the first row if it is on none.
pub fn keep_cursor(state: &mut State) {
    let first = state
        .class
        .desk()
        .and_then(|desk| desk.board().first().copied());
    let cursor = &mut state.rooms.class.cursor;
    *cursor = cursor.or(first);
}

const DESK_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint_words("class message ", "class-key-message"),
    hint_words("class hint", "class-key-hint"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class mark ", "class-key-bookmark"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class end", "class-key-end"),
    hint(&[Action::Quit], "hint-quit"),
];

const SEAT_HINTS: &[KeyHint] = &[footer_keys::COMMAND, footer_keys::HELP, footer_keys::BACK];

const fn gives(c: char, line: &'static str) -> KeyRow {
    (key(c), Meaning::Give(Cow::Borrowed(line)))
}

/// Marks seats, or removes their marks.
pub(super) fn act(state: &mut State, action: ClassAction) -> Vec<RoomRequest> {
    let count = state.class.desk().map_or(0, |desk| desk.seats().len());
    let room = &mut state.rooms.class;
    match action {
        ClassAction::MarkSeat => {
            if let Some(seat) = room.cursor
                && !room.marked.remove(&seat)
            {
                room.marked.insert(seat);
            }
        }
        ClassAction::MarkAllSeats => room.marked = (0..count).collect(),
    }
    Vec::new()
}

impl RoomModel for ClassRoom {
    const KEYS: &'static [KeyRow] = &[
        does(key(' '), Action::Class(ClassAction::MarkSeat)),
        does(key('*'), Action::Class(ClassAction::MarkAllSeats)),
        writes('m', "class message "),
        gives('h', "class hint"),
        gives('f', "class freeze"),
        gives('r', "class resume"),
        writes('\'', "class mark "),
        writes('e', "class inject "),
        gives('i', "class injects"),
        gives('x', "class end"),
        does(ESCAPE, Action::Escape),
        does(key('q'), Action::Quit),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        if state.class.desk().is_some() {
            DESK_HINTS
        } else {
            SEAT_HINTS
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let board = state.class.desk().map(Desk::board).unwrap_or_default();
        let room = &mut state.rooms.class;
        let row = board.iter().position(|&seat| Some(seat) == room.cursor);
        let row = step.apply(row.unwrap_or_default(), board.len());
        room.cursor = board.get(row).copied();
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        state.hush();
        state.class.desk()?;
        let room = &mut state.rooms.class;
        if !std::mem::take(&mut room.shows_injects) {
            room.marked.clear();
        }
        Some(Vec::new())
    }

    fn entered(state: &mut State) {
        keep_cursor(state);
    }

    /// Marks belong to the class, not to a session.
    fn forget_session(&mut self) {}
}
