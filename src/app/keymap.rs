//! Which key means what, and where. The help is made from this table.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::{Action, Step};

/// Where a binding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// On every screen without an overlay.
    Anywhere,
    /// On the home screen.
    Home,
    /// On the flight screen.
    Fly,
    /// On the debrief.
    Debrief,
    /// On the command line and other prompts.
    Prompt,
    /// On overlays that are read.
    Reader,
}

impl Place {
    /// Its heading in the help.
    pub fn title(self) -> &'static str {
        match self {
            Self::Anywhere => "everywhere",
            Self::Home => "home screen",
            Self::Fly => "flight screen",
            Self::Debrief => "debrief",
            Self::Prompt => "command line",
            Self::Reader => "help and lists",
        }
    }
}

/// A key or a family of keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Press {
    /// A key alone; for characters, as they are written (`?`, `G`).
    Plain(KeyCode),
    /// A letter with Ctrl.
    Control(char),
    /// A character of a vehicle list: a digit, `-` or `,`.
    Number,
}

/// One row of the keymap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binding {
    /// The key.
    pub press: Press,
    /// Where it holds.
    pub place: Place,
    /// What it means.
    pub action: Action,
    /// The same in words, for the help.
    pub description: &'static str,
}

/// The table of keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keymap {
    bindings: Vec<Binding>,
}

impl Keymap {
    /// What a key means at a place; [`Place::Anywhere`] holds for the three screens too.
    pub fn resolve(&self, key: KeyEvent, place: Place) -> Option<Action> {
        let screen = !matches!(place, Place::Prompt | Place::Reader);
        let holds = |binding: &&Binding| {
            binding.place == place || (screen && binding.place == Place::Anywhere)
        };
        let mut found = self.bindings.iter().filter(holds);
        found.find_map(|binding| binding.matched(key))
    }

    /// The rows, in the order of the help.
    pub fn bindings(&self) -> &[Binding] {
        &self.bindings
    }
}

impl Binding {
    fn matched(&self, key: KeyEvent) -> Option<Action> {
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        let alt = key.modifiers.contains(KeyModifiers::ALT);
        match (self.press, key.code) {
            (Press::Plain(code), pressed) => {
                (code == pressed && !control && !alt).then_some(self.action)
            }
            (Press::Control(letter), KeyCode::Char(pressed)) => {
                (control && pressed.eq_ignore_ascii_case(&letter)).then_some(self.action)
            }
            (Press::Number, KeyCode::Char(pressed)) => {
                let fits = pressed.is_ascii_digit() || matches!(pressed, '-' | ',');
                (fits && !control && !alt).then_some(Action::Type(pressed))
            }
            _ => None,
        }
    }
}

impl Press {
    /// What is printed on the key.
    pub fn label(self) -> String {
        match self {
            Self::Control(letter) => format!("Ctrl-{}", letter.to_ascii_uppercase()),
            Self::Number => "3-9 1,4".to_owned(),
            Self::Plain(KeyCode::Char(' ')) => "Space".to_owned(),
            Self::Plain(KeyCode::Char(c)) => c.to_string(),
            Self::Plain(KeyCode::Up) => "Up".to_owned(),
            Self::Plain(KeyCode::Down) => "Down".to_owned(),
            Self::Plain(KeyCode::PageUp) => "PgUp".to_owned(),
            Self::Plain(KeyCode::PageDown) => "PgDn".to_owned(),
            Self::Plain(KeyCode::BackTab) => "Shift-Tab".to_owned(),
            Self::Plain(code) => code.to_string(),
        }
    }
}

impl Default for Keymap {
    fn default() -> Self {
        let (screens, readers) = (moves(Place::Anywhere), moves(Place::Reader));
        let rows = [GENERAL, &screens, &readers, FLIGHT, PROMPT].concat();
        let binding = |(press, place, action, description)| Binding {
            press,
            place,
            action,
            description,
        };
        Self {
            bindings: rows.into_iter().map(binding).collect(),
        }
    }
}

type Row = (Press, Place, Action, &'static str);

const fn key(c: char) -> Press {
    Press::Plain(KeyCode::Char(c))
}

const ENTER: Press = Press::Plain(KeyCode::Enter);
const ESCAPE: Press = Press::Plain(KeyCode::Esc);

const GENERAL: &[Row] = &[
    (
        key(':'),
        Place::Anywhere,
        Action::Palette(""),
        "command line",
    ),
    (
        Press::Control('p'),
        Place::Anywhere,
        Action::Palette(""),
        "command line",
    ),
    (key('?'), Place::Anywhere, Action::Help, "this help"),
    (
        key('c'),
        Place::Anywhere,
        Action::Ledger,
        "all commands: the ledger in full",
    ),
    (
        key('n'),
        Place::Anywhere,
        Action::Notices,
        "all notices in full",
    ),
    (
        Press::Plain(KeyCode::F(1)),
        Place::Anywhere,
        Action::Help,
        "this help",
    ),
    (
        Press::Control('c'),
        Place::Anywhere,
        Action::Quit,
        "leave the program",
    ),
    (
        ENTER,
        Place::Home,
        Action::Submit,
        "take what is under the cursor",
    ),
    (key('q'), Place::Home, Action::Quit, "leave the program"),
    (key('r'), Place::Debrief, Action::Again, "fly again"),
    (
        key('h'),
        Place::Debrief,
        Action::Leave,
        "back to the home screen",
    ),
    (
        ESCAPE,
        Place::Debrief,
        Action::Leave,
        "back to the home screen",
    ),
    (ESCAPE, Place::Reader, Action::Escape, "close"),
    (key('q'), Place::Reader, Action::Escape, "close"),
    (key('?'), Place::Reader, Action::Escape, "close"),
    (ENTER, Place::Reader, Action::Escape, "close"),
    (Press::Control('c'), Place::Reader, Action::Escape, "close"),
];

/// The keys that move a cursor or scroll.
fn moves(place: Place) -> [Row; 8] {
    let row = |press, step, description| (press, place, Action::Move(step), description);
    let plain = Press::Plain;
    [
        row(key('j'), Step::Down, "down"),
        row(plain(KeyCode::Down), Step::Down, "down"),
        row(key('k'), Step::Up, "up"),
        row(plain(KeyCode::Up), Step::Up, "up"),
        row(plain(KeyCode::PageDown), Step::PageDown, "ten down"),
        row(plain(KeyCode::PageUp), Step::PageUp, "ten up"),
        row(plain(KeyCode::Home), Step::First, "to the first"),
        row(plain(KeyCode::End), Step::Last, "to the last"),
    ]
}

const FLIGHT: &[Row] = &[
    (
        Press::Number,
        Place::Fly,
        Action::Type('0'),
        "list of vehicles, Enter selects them",
    ),
    (
        ENTER,
        Place::Fly,
        Action::Submit,
        "select the list that was typed",
    ),
    (
        Press::Plain(KeyCode::Backspace),
        Place::Fly,
        Action::Erase,
        "take back the last digit",
    ),
    (
        key(' '),
        Place::Fly,
        Action::Toggle,
        "select the one under the cursor",
    ),
    (key('*'), Place::Fly, Action::SelectAll, "select all"),
    (key('!'), Place::Fly, Action::Invert, "select the others"),
    (ESCAPE, Place::Fly, Action::Escape, "select none"),
    (
        key('a'),
        Place::Fly,
        Action::Palette("arm"),
        "write `arm`; Enter sends",
    ),
    (
        key('d'),
        Place::Fly,
        Action::Palette("disarm"),
        "write `disarm`",
    ),
    (
        key('t'),
        Place::Fly,
        Action::Palette("takeoff "),
        "write `takeoff`",
    ),
    (
        key('g'),
        Place::Fly,
        Action::Palette("goto "),
        "write `goto`",
    ),
    (
        key('m'),
        Place::Fly,
        Action::Palette("mode "),
        "write `mode`",
    ),
    (
        key('h'),
        Place::Fly,
        Action::Palette("hold"),
        "write `hold`",
    ),
    (
        key('l'),
        Place::Fly,
        Action::Palette("land"),
        "write `land`",
    ),
    (key('r'), Place::Fly, Action::Palette("rtl"), "write `rtl`"),
    (key('L'), Place::Fly, Action::Links, "what the links count"),
    (key('b'), Place::Fly, Action::Brief, "the mission's brief"),
    (
        key('q'),
        Place::Fly,
        Action::Palette("leave"),
        "write `leave`",
    ),
];

const PROMPT: &[Row] = &[
    (ENTER, Place::Prompt, Action::Submit, "give the command"),
    (ESCAPE, Place::Prompt, Action::Escape, "close"),
    (Press::Control('c'), Place::Prompt, Action::Escape, "close"),
    (
        Press::Plain(KeyCode::Tab),
        Place::Prompt,
        Action::Complete,
        "complete the word, then the next choice",
    ),
    (
        Press::Plain(KeyCode::BackTab),
        Place::Prompt,
        Action::CompleteBack,
        "the choice before",
    ),
    (
        Press::Plain(KeyCode::Up),
        Place::Prompt,
        Action::Older,
        "older line",
    ),
    (
        Press::Plain(KeyCode::Down),
        Place::Prompt,
        Action::Newer,
        "newer line",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers, place: Place) -> Option<Action> {
        Keymap::default().resolve(KeyEvent::new(code, modifiers), place)
    }

    #[test]
    fn a_key_means_what_the_place_says() {
        let plain = KeyModifiers::NONE;
        let r = KeyCode::Char('r');
        assert_eq!(press(r, plain, Place::Fly), Some(Action::Palette("rtl")));
        assert_eq!(press(r, plain, Place::Debrief), Some(Action::Again));
        assert_eq!(
            press(r, plain, Place::Prompt),
            None,
            "a prompt takes letters as text"
        );
        assert_eq!(press(r, KeyModifiers::CONTROL, Place::Fly), None);
        assert_eq!(
            press(KeyCode::Char('p'), KeyModifiers::CONTROL, Place::Home),
            Some(Action::Palette(""))
        );
        assert_eq!(
            press(KeyCode::Char('7'), plain, Place::Fly),
            Some(Action::Type('7'))
        );
    }

    #[test]
    fn no_key_has_two_meanings_at_one_place() {
        let keymap = Keymap::default();
        let clash = |a: &Binding, b: &Binding| {
            let screen = |place| !matches!(place, Place::Prompt | Place::Reader);
            let shared = a.place == b.place
                || (a.place == Place::Anywhere && screen(b.place))
                || (b.place == Place::Anywhere && screen(a.place));
            a.press == b.press && shared
        };
        for (at, a) in keymap.bindings().iter().enumerate() {
            for b in &keymap.bindings()[at + 1..] {
                assert!(!clash(a, b), "{a:?} and {b:?}");
            }
        }
    }
}
