//! The key bindings by room. The help is generated from this table.

use std::borrow::Cow;

use crossterm::event::{KeyCode, KeyEvent};

use super::action::Action;
use super::room_list::Room;
use crate::text;
use crate::text::Text;

mod file;
mod hint;
mod layout;
mod press;
mod show;

pub use hint::{HintKeys, KeyHint, hint, hint_words};
pub use layout::{latin_key, latin_line};
pub use press::Press;

/// Where a binding applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In every room without an overlay.
    Anywhere,
    In(Room),
    /// In every room during a replay, before the room's own keys.
    Replay,
    /// On the command line and other prompts.
    Prompt,
    /// On overlays with text.
    Reader,
    /// On lists to choose from.
    List,
}

impl Place {
    /// Every place, in the order of the help.
    pub fn all() -> impl Iterator<Item = Self> {
        let rooms = Room::ALL.into_iter().map(Self::In);
        std::iter::once(Self::Anywhere).chain(rooms).chain([
            Self::Replay,
            Self::Prompt,
            Self::Reader,
            Self::List,
        ])
    }

    /// The place's name in keymap files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Anywhere => "anywhere",
            Self::In(room) => room.name(),
            Self::Replay => "replay",
            Self::Prompt => "prompt",
            Self::Reader => "reader",
            Self::List => "list",
        }
    }

    /// The place's heading in the help.
    pub fn title(self) -> Text {
        match self {
            Self::Anywhere => text!("keys-anywhere"),
            Self::In(room) => text!("keys-room", room = room.title()),
            Self::Replay => text!("keys-replay"),
            Self::Prompt => text!("keys-prompt"),
            Self::Reader => text!("keys-reader"),
            Self::List => text!("keys-list"),
        }
    }
}

/// The effect of a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Meaning {
    Do(Action),
    /// Opens the command line with this text.
    Write(Cow<'static, str>),
    /// Runs this line as if typed and followed by Enter.
    Give(Cow<'static, str>),
    /// Adds the character to the vehicle list being typed.
    Type,
}

/// A key with its meaning; the table that contains it determines where it applies.
pub type KeyRow = (Press, Meaning);

/// One row of the keymap.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Binding {
    pub press: Press,
    pub place: Place,
    pub meaning: Meaning,
}

/// The table of keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keymap {
    bindings: Vec<Binding>,
    /// Keys disabled in a place; in a room, this also disables their general meaning.
    silent: Vec<(Press, Place)>,
}

impl Keymap {
    /// A keymap with these rows, in the order of the help.
    pub fn new(bindings: Vec<Binding>) -> Self {
        Self {
            bindings,
            silent: Vec::new(),
        }
    }

    /// The meaning of a key at a place. A room's own keys come before the general ones. Where no line is edited, a
    /// Ukrainian letter or sign without a meaning of its own counts as the Latin key in its position.
    pub fn resolve(&self, key: KeyEvent, place: Place) -> Option<&Meaning> {
        let is_edited = place == Place::Prompt;
        self.written(key, place)
            .or_else(|| self.by_position(key, place).filter(|_| !is_edited))
    }

    /// The meaning of the Latin key in the position of a Ukrainian letter or sign.
    pub fn by_position(&self, key: KeyEvent, place: Place) -> Option<&Meaning> {
        self.written(layout::by_position(key)?, place)
    }

    /// The meaning of a key, without converting it from another keyboard layout.
    fn written(&self, key: KeyEvent, place: Place) -> Option<&Meaning> {
        let at = |place: Place| {
            let mut found = self.bindings.iter().filter(move |it| it.place == place);
            found
                .find(|binding| binding.press.is(key))
                .map(|binding| &binding.meaning)
        };
        at(place).or_else(|| match place {
            Place::In(_) if !self.is_silent(key, place) => at(Place::Anywhere),
            Place::Anywhere
            | Place::In(_)
            | Place::Replay
            | Place::Prompt
            | Place::Reader
            | Place::List => None,
        })
    }

    /// The action of a key at a place, if its meaning is one.
    pub fn action(&self, key: KeyEvent, place: Place) -> Option<Action> {
        match self.resolve(key, place) {
            Some(Meaning::Do(action)) => Some(*action),
            _ => None,
        }
    }

    /// The rows, in the order of the help.
    pub fn bindings(&self) -> &[Binding] {
        &self.bindings
    }

    fn is_silent(&self, key: KeyEvent, place: Place) -> bool {
        let mut silent = self.silent.iter();
        silent.any(|(press, silent_in)| *silent_in == place && press.is(key))
    }
}

pub const fn key(c: char) -> Press {
    Press::Plain(KeyCode::Char(c))
}

/// A row that performs an action.
pub const fn does(press: Press, action: Action) -> KeyRow {
    (press, Meaning::Do(action))
}

/// A row that opens the command line with a text.
pub const fn writes(c: char, line: &'static str) -> KeyRow {
    (key(c), Meaning::Write(Cow::Borrowed(line)))
}

pub const ENTER: Press = Press::Plain(KeyCode::Enter);
pub const ESCAPE: Press = Press::Plain(KeyCode::Esc);
