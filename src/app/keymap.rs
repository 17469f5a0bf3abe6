//! The key bindings by room. The help is made from this table.

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
pub use layout::latin;
pub use press::Press;

/// Where a binding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In every room without an overlay.
    Anywhere,
    In(Room),
    /// In every room while a recording is replayed, before what the room says.
    Replay,
    /// On the command line and other prompts.
    Prompt,
    /// On overlays that are read.
    Reader,
    /// On lists that something is chosen from.
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

    /// Its name in keymap files.
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

    /// Its heading in the help.
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

/// What a key leads to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Meaning {
    /// The console does something.
    Do(Action),
    /// The command line opens with these words in it.
    Write(Cow<'static, str>),
    /// A line is given as if it had been written and Enter pressed.
    Give(Cow<'static, str>),
    /// The character joins the vehicle list that is being typed.
    Type,
}

/// A key with its meaning; where it holds is known from where it stands.
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
    /// Keys that mean nothing in a place, whatever they mean anywhere.
    silent: Vec<(Press, Place)>,
}

impl Keymap {
    /// A keymap of these rows, in the order of the help.
    pub fn new(bindings: Vec<Binding>) -> Self {
        Self {
            bindings,
            silent: Vec::new(),
        }
    }

    /// What a key means at a place. What a room says of a key comes before what holds anywhere. Where no line is edited,
    /// a Ukrainian letter without a meaning of its own is the Latin key in its position.
    pub fn resolve(&self, key: KeyEvent, place: Place) -> Option<&Meaning> {
        self.written(key, place).or_else(|| {
            let by_position = layout::by_position(key).filter(|_| place != Place::Prompt)?;
            self.written(by_position, place)
        })
    }

    /// What a key means as it is written.
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

    /// What the console does for a key at a place, if it leads to an action.
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

/// A row that leads to an action.
pub const fn does(press: Press, action: Action) -> KeyRow {
    (press, Meaning::Do(action))
}

/// A row that opens the command line with a text.
pub const fn writes(c: char, line: &'static str) -> KeyRow {
    (key(c), Meaning::Write(Cow::Borrowed(line)))
}

pub const ENTER: Press = Press::Plain(KeyCode::Enter);
pub const ESCAPE: Press = Press::Plain(KeyCode::Esc);
