//! Keys: their spelling, and the key presses that they match.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::text;
use crate::text::Text;

/// A key or a family of keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Press {
    /// A single key; for characters, the character itself (`?`, `G`).
    Plain(KeyCode),
    /// A letter with Ctrl.
    Control(char),
    /// Any other key combined with Ctrl, Alt or Shift.
    With(KeyModifiers, KeyCode),
    /// A character of a vehicle list: a digit, `-` or `,`.
    Number,
}

/// The named keys: their spellings, and their labels.
const NAMED: &[(&[&str], &str, KeyCode)] = &[
    (&["space"], "Space", KeyCode::Char(' ')),
    (&["enter", "return"], "Enter", KeyCode::Enter),
    (&["esc", "escape"], "Esc", KeyCode::Esc),
    (&["tab"], "Tab", KeyCode::Tab),
    (&["backspace"], "Backspace", KeyCode::Backspace),
    (&["delete", "del"], "Del", KeyCode::Delete),
    (&["insert", "ins"], "Ins", KeyCode::Insert),
    (&["home"], "Home", KeyCode::Home),
    (&["end"], "End", KeyCode::End),
    (&["pgup", "pageup"], "PgUp", KeyCode::PageUp),
    (&["pgdn", "pgdown", "pagedown"], "PgDn", KeyCode::PageDown),
    (&["up"], "Up", KeyCode::Up),
    (&["down"], "Down", KeyCode::Down),
    (&["left"], "Left", KeyCode::Left),
    (&["right"], "Right", KeyCode::Right),
];

const MODIFIERS: &[(&str, &str, KeyModifiers)] = &[
    ("ctrl-", "Ctrl-", KeyModifiers::CONTROL),
    ("alt-", "Alt-", KeyModifiers::ALT),
    ("shift-", "Shift-", KeyModifiers::SHIFT),
];

/// Letters with Ctrl that terminals send as other keys.
const SAME: &[(char, &str)] = &[('i', "tab"), ('m', "enter"), ('[', "esc")];

impl Press {
    /// Reads a key as keymap files spell it: `a`, `A`, `ctrl-a`, `alt-x`, `f5`, `space`, `shift-tab`. Names and
    /// modifiers may be in capitals.
    ///
    /// # Errors
    /// The reason why the key does not exist.
    pub fn read(written: &str) -> Result<Self, Text> {
        let mut rest = written;
        let mut modifiers = KeyModifiers::NONE;
        while let Some((length, modifier)) = modifier(rest) {
            rest = &rest[length..];
            modifiers |= modifier;
        }
        let code = code(rest).ok_or_else(|| text!("keymap-no-key", key = written))?;
        combined(modifiers, code)
            .map_err(|same| text!("keymap-same-key", key = written, other = same))
    }

    /// Whether a key press matches.
    pub fn is(self, key: KeyEvent) -> bool {
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        let alt = key.modifiers.contains(KeyModifiers::ALT);
        match (self, key.code) {
            (Self::Plain(code), pressed) => code == pressed && !control && !alt,
            (Self::Control(letter), KeyCode::Char(pressed)) => {
                control && !alt && pressed.eq_ignore_ascii_case(&letter)
            }
            (Self::With(modifiers, KeyCode::Char(c)), KeyCode::Char(pressed)) => {
                let same = c == pressed || (control && c.eq_ignore_ascii_case(&pressed));
                // The character already includes Shift.
                same && key.modifiers - KeyModifiers::SHIFT == modifiers
            }
            (Self::With(modifiers, code), pressed) => code == pressed && key.modifiers == modifiers,
            (Self::Number, KeyCode::Char(pressed)) => {
                (pressed.is_ascii_digit() || matches!(pressed, '-' | ',')) && !control && !alt
            }
            _ => false,
        }
    }

    /// Whether this key matches every press that another one matches.
    pub fn covers(self, other: Self) -> bool {
        match (self, other) {
            (Self::Number, Self::Plain(code)) => self.is(KeyEvent::from(code)),
            _ => self == other,
        }
    }

    /// The label of the key, as short as possible for hints.
    pub fn symbol(self) -> String {
        let arrow = match self {
            Self::Plain(KeyCode::Left) => "←",
            Self::Plain(KeyCode::Right) => "→",
            Self::Plain(KeyCode::Up) => "↑",
            Self::Plain(KeyCode::Down) => "↓",
            Self::Number => "0-9",
            Self::Plain(_) | Self::Control(_) | Self::With(..) => return self.label(),
        };
        arrow.to_owned()
    }

    /// The label of the key.
    pub fn label(self) -> String {
        match self {
            Self::Control(letter) => format!("Ctrl-{}", letter.to_ascii_uppercase()),
            Self::Number => "0-9 , -".to_owned(),
            Self::Plain(KeyCode::BackTab) => "Shift-Tab".to_owned(),
            Self::Plain(code) => printed(code),
            Self::With(modifiers, code) => {
                let all = MODIFIERS.iter();
                let held = all.filter(|(_, _, modifier)| modifiers.contains(*modifier));
                let names: String = held.map(|(_, label, _)| *label).collect();
                names + &printed(code)
            }
        }
    }
}

/// The modifier at the beginning of a key, and its length.
fn modifier(written: &str) -> Option<(usize, KeyModifiers)> {
    MODIFIERS.iter().find_map(|(prefix, _, modifier)| {
        let head = written.get(..prefix.len())?;
        let goes_on = written.len() > prefix.len();
        (goes_on && head.eq_ignore_ascii_case(prefix)).then_some((prefix.len(), *modifier))
    })
}

fn code(written: &str) -> Option<KeyCode> {
    let mut characters = written.chars();
    if let (Some(c), None) = (characters.next(), characters.next()) {
        return (!c.is_control() && !c.is_whitespace()).then_some(KeyCode::Char(c));
    }
    let name = written.to_ascii_lowercase();
    let number = name.strip_prefix('f').and_then(|rest| rest.parse().ok());
    if let Some(number @ 1..=12) = number {
        return Some(KeyCode::F(number));
    }
    let mut named = NAMED.iter();
    named
        .find(|(names, ..)| names.contains(&name.as_str()))
        .map(|(_, _, code)| *code)
}

/// The canonical form of equivalent spellings; the error is the key that terminals send instead.
fn combined(modifiers: KeyModifiers, code: KeyCode) -> Result<Press, &'static str> {
    let others = modifiers - KeyModifiers::SHIFT;
    let is_shift_alone = modifiers == KeyModifiers::SHIFT;
    Ok(match code {
        KeyCode::Char(c) if others == KeyModifiers::CONTROL && c != ' ' => {
            let c = c.to_ascii_lowercase();
            match SAME.iter().find(|(letter, _)| *letter == c) {
                Some((_, same)) => return Err(same),
                None => Press::Control(c),
            }
        }
        KeyCode::Char(c) if is_shift_alone => {
            Press::Plain(KeyCode::Char(c.to_uppercase().next().unwrap_or(c)))
        }
        KeyCode::Char(_) if others.is_empty() => Press::Plain(code),
        KeyCode::Char(c) if others.contains(KeyModifiers::CONTROL) => {
            Press::With(others, KeyCode::Char(c.to_ascii_lowercase()))
        }
        KeyCode::Char(_) => Press::With(others, code),
        KeyCode::Tab if is_shift_alone => Press::Plain(KeyCode::BackTab),
        _ if modifiers.is_empty() => Press::Plain(code),
        _ => Press::With(modifiers, code),
    })
}

fn printed(code: KeyCode) -> String {
    let named = NAMED.iter().find(|(_, _, known)| *known == code);
    match (named, code) {
        (Some((_, label, _)), _) => (*label).to_owned(),
        (None, KeyCode::Char(c)) => c.to_string(),
        (None, code) => code.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: KeyModifiers = KeyModifiers::NONE;
    const CONTROL: KeyModifiers = KeyModifiers::CONTROL;
    const ALT: KeyModifiers = KeyModifiers::ALT;
    const SHIFT: KeyModifiers = KeyModifiers::SHIFT;

    #[test]
    fn keys_are_read_as_they_are_spelled() {
        let plain = |c| Press::Plain(KeyCode::Char(c));
        let with = Press::With;
        let cases = [
            ("a", plain('a'), "a"),
            ("A", plain('A'), "A"),
            ("shift-a", plain('A'), "A"),
            ("-", plain('-'), "-"),
            ("ї", plain('ї'), "ї"),
            ("space", plain(' '), "Space"),
            ("F5", Press::Plain(KeyCode::F(5)), "F5"),
            ("PgUp", Press::Plain(KeyCode::PageUp), "PgUp"),
            ("shift-tab", Press::Plain(KeyCode::BackTab), "Shift-Tab"),
            ("Ctrl-A", Press::Control('a'), "Ctrl-A"),
            ("ctrl--", Press::Control('-'), "Ctrl--"),
            ("alt-X", with(ALT, KeyCode::Char('X')), "Alt-X"),
            (
                "ctrl-alt-x",
                with(CONTROL | ALT, KeyCode::Char('x')),
                "Ctrl-Alt-x",
            ),
            ("ctrl-left", with(CONTROL, KeyCode::Left), "Ctrl-Left"),
            ("shift-f5", with(SHIFT, KeyCode::F(5)), "Shift-F5"),
            (
                "ctrl-space",
                with(CONTROL, KeyCode::Char(' ')),
                "Ctrl-Space",
            ),
        ];
        for (written, press, label) in cases {
            assert_eq!(Press::read(written), Ok(press), "{written}");
            assert_eq!(press.label(), label);
            assert_eq!(Press::read(label), Ok(press), "{label}");
        }
        for written in ["", " ", "ctrl-", "f13", "f0", "hyper-x", "aa", "\u{1b}"] {
            assert!(Press::read(written).is_err(), "{written:?}");
        }
        let same = Press::read("Ctrl-I").expect_err("it is Tab").to_string();
        assert!(same.contains("tab"), "{same}");
    }

    #[test]
    fn a_press_is_the_key_with_exactly_its_modifiers() {
        let cases = [
            ("x", KeyCode::Char('x'), NONE, true),
            ("x", KeyCode::Char('x'), ALT, false),
            ("X", KeyCode::Char('X'), SHIFT, true),
            ("alt-x", KeyCode::Char('x'), ALT, true),
            ("alt-x", KeyCode::Char('x'), NONE, false),
            ("alt-x", KeyCode::Char('x'), ALT | CONTROL, false),
            ("alt-X", KeyCode::Char('X'), ALT | SHIFT, true),
            ("ctrl-a", KeyCode::Char('a'), CONTROL, true),
            ("ctrl-a", KeyCode::Char('a'), CONTROL | ALT, false),
            ("shift-up", KeyCode::Up, SHIFT, true),
            ("shift-up", KeyCode::Up, NONE, false),
        ];
        for (written, code, modifiers, expected) in cases {
            let press = Press::read(written).expect("a key");
            let key = KeyEvent::new(code, modifiers);
            assert_eq!(press.is(key), expected, "{written}");
        }
    }
}
