//! Which key means what, and where. The help is made from this table.

use std::borrow::Cow;

use crossterm::event::{KeyCode, KeyEvent};

use super::action::{Action, Step};
use super::room::{self, Room};
use crate::text;
use crate::text::Text;

mod file;
mod press;
mod show;

pub use press::Press;

/// Where a binding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In every room without an overlay.
    Anywhere,
    /// In one room.
    In(Room),
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
        std::iter::once(Self::Anywhere)
            .chain(rooms)
            .chain([Self::Prompt, Self::Reader, Self::List])
    }

    /// Its name in keymap files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Anywhere => "anywhere",
            Self::In(room) => room.name(),
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

impl Meaning {
    /// The same in words, for the help.
    pub fn description(&self) -> Text {
        match self {
            Self::Do(action) => Text::new(format!("action-{}", action.name()), Vec::new()),
            Self::Write(line) => text!("keys-writes", line = line.trim_end()),
            Self::Give(line) => text!("keys-gives", line = line.as_ref()),
            Self::Type => text!("keys-types"),
        }
    }
}

/// A key with its meaning; where it holds is known from where it stands.
pub type Row = (Press, Meaning);

/// One row of the keymap.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Binding {
    /// The key.
    pub press: Press,
    /// Where it holds.
    pub place: Place,
    /// What it means.
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
    /// What a key means at a place. What a room says of a key comes before what holds anywhere.
    pub fn resolve(&self, key: KeyEvent, place: Place) -> Option<&Meaning> {
        let at = |place: Place| {
            let mut found = self.bindings.iter().filter(move |it| it.place == place);
            found
                .find(|binding| binding.press.is(key))
                .map(|binding| &binding.meaning)
        };
        at(place).or_else(|| match place {
            Place::In(_) if !self.is_silent(key, place) => at(Place::Anywhere),
            _ => None,
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

impl Default for Keymap {
    fn default() -> Self {
        let mut bindings = Vec::new();
        let mut add = |place: Place, rows: &[Row]| {
            bindings.extend(rows.iter().map(|(press, meaning)| Binding {
                press: *press,
                place,
                meaning: meaning.clone(),
            }));
        };
        add(Place::Anywhere, GENERAL);
        add(Place::Anywhere, MOVES);
        for room in Room::ALL {
            let show = (key(room.key()), Meaning::Do(Action::Show(room)));
            add(Place::Anywhere, &[show]);
            let own = room::keys(room);
            add(Place::In(room), own);
            if room.shows_vehicles() {
                let free = |row: &&Row| own.iter().all(|(press, _)| *press != row.0);
                let rows: Vec<Row> = VEHICLES.iter().filter(free).cloned().collect();
                add(Place::In(room), &rows);
            }
        }
        add(Place::Prompt, PROMPT);
        add(Place::Reader, READER);
        add(Place::Reader, MOVES);
        add(Place::List, LIST);
        add(Place::List, MOVES);
        Self {
            bindings,
            silent: Vec::new(),
        }
    }
}

/// A character's key.
pub const fn key(c: char) -> Press {
    Press::Plain(KeyCode::Char(c))
}

/// A row that leads to an action.
pub const fn does(press: Press, action: Action) -> Row {
    (press, Meaning::Do(action))
}

/// A row that opens the command line with a text.
pub const fn writes(c: char, line: &'static str) -> Row {
    (key(c), Meaning::Write(Cow::Borrowed(line)))
}

/// The key Enter.
pub const ENTER: Press = Press::Plain(KeyCode::Enter);
/// The key Esc.
pub const ESCAPE: Press = Press::Plain(KeyCode::Esc);

const GENERAL: &[Row] = &[
    does(key(':'), Action::CommandLine),
    does(Press::Control('p'), Action::CommandLine),
    does(key('?'), Action::Help),
    does(Press::Plain(KeyCode::F(1)), Action::Help),
    does(key('n'), Action::Notices),
    does(key('c'), Action::Show(Room::Ledger)),
    does(key('b'), Action::Brief),
    does(key('p'), Action::PauseMission),
    does(Press::Control('c'), Action::Quit),
];

/// The keys that move a cursor or scroll.
const MOVES: &[Row] = &[
    does(key('j'), Action::Move(Step::Down)),
    does(Press::Plain(KeyCode::Down), Action::Move(Step::Down)),
    does(key('k'), Action::Move(Step::Up)),
    does(Press::Plain(KeyCode::Up), Action::Move(Step::Up)),
    does(
        Press::Plain(KeyCode::PageDown),
        Action::Move(Step::PageDown),
    ),
    does(Press::Plain(KeyCode::PageUp), Action::Move(Step::PageUp)),
    does(Press::Plain(KeyCode::Home), Action::Move(Step::First)),
    does(Press::Plain(KeyCode::End), Action::Move(Step::Last)),
];

const READER: &[Row] = &[
    does(ESCAPE, Action::Escape),
    does(key('q'), Action::Escape),
    does(key('?'), Action::Escape),
    does(ENTER, Action::Escape),
    does(Press::Control('c'), Action::Escape),
];

const LIST: &[Row] = &[
    does(ENTER, Action::Submit),
    does(ESCAPE, Action::Escape),
    does(key('q'), Action::Escape),
    does(Press::Control('c'), Action::Escape),
];

const PROMPT: &[Row] = &[
    does(ENTER, Action::Submit),
    does(ESCAPE, Action::Escape),
    does(Press::Control('c'), Action::Escape),
    does(Press::Plain(KeyCode::Tab), Action::Complete),
    does(Press::Plain(KeyCode::BackTab), Action::CompleteBack),
    does(Press::Plain(KeyCode::Up), Action::Older),
    does(Press::Plain(KeyCode::Down), Action::Newer),
];

/// The keys that select vehicles and command them, in the rooms that show vehicles; a room's own keys go before.
const VEHICLES: &[Row] = &[
    (Press::Number, Meaning::Type),
    does(ENTER, Action::Submit),
    does(Press::Plain(KeyCode::Backspace), Action::Erase),
    does(key(' '), Action::Toggle),
    does(key('*'), Action::SelectAll),
    does(key('!'), Action::Invert),
    does(ESCAPE, Action::Escape),
    writes('a', "arm"),
    writes('d', "disarm"),
    writes('t', "takeoff "),
    writes('g', "goto "),
    writes('m', "mode "),
    writes('l', "land"),
    writes('r', "rtl"),
    writes('q', "leave"),
];

#[cfg(test)]
mod tests {
    use crossterm::event::KeyModifiers;

    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers, place: Place) -> Option<Meaning> {
        Keymap::default()
            .resolve(KeyEvent::new(code, modifiers), place)
            .cloned()
    }

    #[test]
    fn a_key_means_what_the_place_says() {
        let plain = KeyModifiers::NONE;
        let r = KeyCode::Char('r');
        assert_eq!(
            press(r, plain, Place::In(Room::Fly)),
            Some(Meaning::Write("rtl".into()))
        );
        assert_eq!(
            press(r, plain, Place::In(Room::Debrief)),
            Some(Meaning::Do(Action::Again))
        );
        assert_eq!(
            press(r, plain, Place::Prompt),
            None,
            "a prompt takes letters as text"
        );
        assert_eq!(press(r, KeyModifiers::CONTROL, Place::In(Room::Fly)), None);
        assert_eq!(
            press(
                KeyCode::Char('p'),
                KeyModifiers::CONTROL,
                Place::In(Room::Home)
            ),
            Some(Meaning::Do(Action::CommandLine))
        );
        assert_eq!(
            press(KeyCode::Char('7'), plain, Place::In(Room::Fly)),
            Some(Meaning::Type)
        );
    }

    #[test]
    fn no_key_has_two_meanings_at_one_place() {
        let keymap = Keymap::default();
        for (at, a) in keymap.bindings().iter().enumerate() {
            for b in &keymap.bindings()[at + 1..] {
                assert!(a.press != b.press || a.place != b.place, "{a:?} and {b:?}");
            }
        }
    }

    #[test]
    fn every_action_of_the_table_has_a_name() {
        for binding in Keymap::default().bindings() {
            if let Meaning::Do(action) = binding.meaning {
                assert_eq!(Action::named(action.name()), Some(action), "{binding:?}");
            }
        }
    }
}
