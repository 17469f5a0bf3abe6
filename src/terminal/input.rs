//! Parses the bytes of a terminal into keys, pastes and answers.
//!
//! The terminal library does not pass answers on, but they show the speed of the line (see `pace`).
//! Only sequences that real terminals send are recognised; all others are skipped and never taken
//! for keys.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// Input from the terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key was pressed.
    Key(KeyEvent),
    Paste(String),
    /// The left button of the mouse was pressed on a cell, counted from 0.
    Click {
        column: u16,
        row: u16,
    },
    /// The terminal has read everything up to the query.
    Answer,
}

/// The longest control sequence that is accepted, in bytes.
const LONGEST_SEQUENCE: usize = 64;
/// The longest paste that is kept, in bytes; a line is far shorter.
const LONGEST_PASTE: usize = 64 * 1024;
const PASTE_END: &[u8] = b"\x1b[201~";

/// A parser from bytes to inputs.
#[derive(Debug, Default)]
pub struct Parser {
    bytes: Vec<u8>,
    paste: Option<Vec<u8>>,
}

enum ParsedInput {
    /// An input, or bytes to ignore, with their length.
    Whole(Option<Input>, usize),
    /// The start of a paste, with its length.
    Paste(usize),
    Partial,
}

impl Parser {
    /// Adds bytes that the terminal has sent.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// The next input, if one is complete.
    pub fn next_input(&mut self) -> Option<Input> {
        loop {
            if self.paste.is_some() {
                return self.pasted();
            }
            match find(&self.bytes) {
                ParsedInput::Partial => return None,
                ParsedInput::Paste(length) => {
                    self.bytes.drain(..length);
                    self.paste = Some(Vec::new());
                }
                ParsedInput::Whole(input, length) => {
                    self.bytes.drain(..length);
                    if input.is_some() {
                        return input;
                    }
                }
            }
        }
    }

    /// Whether an incomplete input is waiting for its end.
    pub fn is_waiting(&self) -> bool {
        !self.bytes.is_empty() && self.paste.is_none()
    }

    /// Handles a time-out: returns the Esc key if a lone Esc character is waiting; a longer
    /// incomplete sequence is dropped.
    pub fn give_up(&mut self) -> Option<Input> {
        let is_escape = self.bytes.first() == Some(&0x1b);
        let alone = self.bytes.len() == 1;
        self.bytes.clear();
        (is_escape && alone).then(|| key(KeyCode::Esc, KeyModifiers::NONE))
    }

    fn pasted(&mut self) -> Option<Input> {
        let paste = self.paste.as_mut()?;
        let end = self
            .bytes
            .windows(PASTE_END.len())
            .position(|window| window == PASTE_END);
        // The end marker may be split between two reads.
        let taken = end.unwrap_or(self.bytes.len().saturating_sub(PASTE_END.len() - 1));
        let room = LONGEST_PASTE.saturating_sub(paste.len());
        paste.extend(self.bytes.drain(..taken).take(room));
        end?;
        self.bytes.drain(..PASTE_END.len());
        let paste = self.paste.take()?;
        Some(Input::Paste(String::from_utf8_lossy(&paste).into_owned()))
    }
}

fn key(code: KeyCode, modifiers: KeyModifiers) -> Input {
    Input::Key(KeyEvent::new(code, modifiers))
}

fn find(bytes: &[u8]) -> ParsedInput {
    match bytes {
        [] | [0x1b] | [0x1b, b'O'] => ParsedInput::Partial,
        [0x1b, 0x1b, ..] => ParsedInput::Whole(Some(key(KeyCode::Esc, KeyModifiers::NONE)), 1),
        [0x1b, b'[', ..] => sequence(bytes),
        [0x1b, b'O', letter, ..] => {
            let found = letter_key(*letter).map(|code| key(code, KeyModifiers::NONE));
            ParsedInput::Whole(found, 3)
        }
        [0x1b, rest @ ..] => match character(rest) {
            ParsedInput::Whole(Some(Input::Key(pressed)), length) => {
                let modifiers = pressed.modifiers | KeyModifiers::ALT;
                ParsedInput::Whole(Some(key(pressed.code, modifiers)), length + 1)
            }
            ParsedInput::Whole(other, length) => ParsedInput::Whole(other, length + 1),
            other @ (ParsedInput::Paste(_) | ParsedInput::Partial) => other,
        },
        _ => character(bytes),
    }
}

/// A control character, or a character in UTF-8.
fn character(bytes: &[u8]) -> ParsedInput {
    let none = KeyModifiers::NONE;
    let control = |c: u8| key(KeyCode::Char(c.into()), KeyModifiers::CONTROL);
    let found = match bytes[0] {
        b'\r' => key(KeyCode::Enter, none),
        b'\t' => key(KeyCode::Tab, none),
        0x7f => key(KeyCode::Backspace, none),
        0 => control(b' '),
        c @ 0x01..=0x1a => control(c - 1 + b'a'),
        c @ 0x1c..=0x1f => control(c - 0x1c + b'4'),
        first => return utf8(bytes, first),
    };
    ParsedInput::Whole(Some(found), 1)
}

fn utf8(bytes: &[u8], first: u8) -> ParsedInput {
    let length = match first {
        0..=0x7f => 1,
        0xc0..=0xdf => 2,
        0xe0..=0xef => 3,
        0xf0..=0xf7 => 4,
        _ => return ParsedInput::Whole(None, 1),
    };
    let whole = bytes.get(..length);
    let known = whole.unwrap_or(bytes);
    match std::str::from_utf8(known).map(|text| text.chars().next()) {
        Ok(Some(c)) => {
            let modifiers = if c.is_uppercase() {
                KeyModifiers::SHIFT
            } else {
                KeyModifiers::NONE
            };
            ParsedInput::Whole(Some(key(KeyCode::Char(c), modifiers)), length)
        }
        Err(error) if whole.is_none() && error.error_len().is_none() => ParsedInput::Partial,
        _ => ParsedInput::Whole(None, 1),
    }
}

/// A control sequence: `ESC [`, parameters, a letter.
fn sequence(bytes: &[u8]) -> ParsedInput {
    // The Linux console's first function keys: `ESC [ [ A`.
    if bytes.get(2) == Some(&b'[') {
        return match bytes.get(3) {
            None => ParsedInput::Partial,
            Some(letter @ b'A'..=b'E') => {
                let number = letter - b'A' + 1;
                ParsedInput::Whole(Some(key(KeyCode::F(number), KeyModifiers::NONE)), 4)
            }
            Some(_) => ParsedInput::Whole(None, 3),
        };
    }
    let inner = &bytes[2..];
    let Some(end) = inner.iter().position(|byte| !matches!(byte, 0x20..=0x3f)) else {
        let length = bytes.len();
        return if length > LONGEST_SEQUENCE {
            ParsedInput::Whole(None, length)
        } else {
            ParsedInput::Partial
        };
    };
    let last = inner[end];
    if !matches!(last, 0x40..=0x7e) {
        // An interrupted sequence: the character that interrupts it is read separately.
        return ParsedInput::Whole(None, 2 + end);
    }
    let parameters = std::str::from_utf8(&inner[..end]).unwrap_or_default();
    if (parameters, last) == ("200", b'~') {
        return ParsedInput::Paste(2 + end + 1);
    }
    ParsedInput::Whole(meaning(parameters, last), 2 + end + 1)
}

fn meaning(parameters: &str, last: u8) -> Option<Input> {
    if let Some(mouse) = parameters.strip_prefix('<') {
        return (last == b'M').then(|| mouse_input(mouse)).flatten();
    }
    let mut numbers = parameters
        .split(';')
        // Kitty appends details after colons.
        .map(|part| {
            part.split(':')
                .next()
                .unwrap_or_default()
                .parse::<u32>()
                .ok()
        });
    let first = numbers.next().flatten();
    let modifiers = modifiers(numbers.next().flatten());
    match (last, first) {
        (b'n', Some(0 | 3)) => Some(Input::Answer),
        (b'Z', _) => Some(key(KeyCode::BackTab, KeyModifiers::SHIFT)),
        (b'~', Some(number)) => numbered_key(number).map(|code| key(code, modifiers)),
        (b'u', Some(number)) => {
            let code = match number {
                13 => KeyCode::Enter,
                9 => KeyCode::Tab,
                27 => KeyCode::Esc,
                127 => KeyCode::Backspace,
                other => KeyCode::Char(char::from_u32(other).filter(|c| !c.is_control())?),
            };
            Some(key(code, modifiers))
        }
        (letter, _) => letter_key(letter).map(|code| key(code, modifiers)),
    }
}

fn modifiers(parameter: Option<u32>) -> KeyModifiers {
    let bits = parameter.unwrap_or(1).saturating_sub(1);
    let named = [
        (1, KeyModifiers::SHIFT),
        (2, KeyModifiers::ALT),
        (4, KeyModifiers::CONTROL),
    ];
    let held = named.into_iter().filter(|(bit, _)| bits & bit != 0);
    held.fold(KeyModifiers::NONE, |all, (_, one)| all | one)
}

fn letter_key(letter: u8) -> Option<KeyCode> {
    Some(match letter {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        b'H' => KeyCode::Home,
        b'F' => KeyCode::End,
        b'M' => KeyCode::Enter,
        b'P'..=b'S' => KeyCode::F(letter - b'P' + 1),
        _ => return None,
    })
}

fn numbered_key(number: u32) -> Option<KeyCode> {
    let function = |first: u32, key: u32| KeyCode::F((number - first + key) as u8);
    Some(match number {
        1 | 7 => KeyCode::Home,
        2 => KeyCode::Insert,
        3 => KeyCode::Delete,
        4 | 8 => KeyCode::End,
        5 => KeyCode::PageUp,
        6 => KeyCode::PageDown,
        11..=15 => function(11, 1),
        17..=21 => function(17, 6),
        23..=24 => function(23, 11),
        _ => return None,
    })
}

/// The wheel acts as the arrow keys, the left button as a click; other buttons are ignored. Parameters are
/// `button;column;row`, counted from 1.
fn mouse_input(parameters: &str) -> Option<Input> {
    let mut parts = parameters.split(';');
    let button = parts.next()?;
    let mut place = parts.map(|part| part.parse::<u16>().ok()?.checked_sub(1));
    match button {
        "0" => Some(Input::Click {
            column: place.next()??,
            row: place.next()??,
        }),
        "64" => Some(key(KeyCode::Up, KeyModifiers::NONE)),
        "65" => Some(key(KeyCode::Down, KeyModifiers::NONE)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
