//! Keyboard layouts: the Latin key at the place of each Ukrainian letter or sign.

use crossterm::event::{KeyCode, KeyEvent};

/// The rows of a Ukrainian keyboard (JCUKEN), each followed by the same keys on an English one.
const ROWS: [[&str; 2]; 6] = [
    ["йцукенгшщзхї", "qwertyuiop[]"],
    ["фівапролджє", "asdfghjkl;'"],
    ["ячсмитьбю", "zxcvbnm,."],
    ["ЙЦУКЕНГШЩЗХЇ", "QWERTYUIOP{}"],
    ["ФІВАПРОЛДЖЄ", "ASDFGHJKL:\""],
    ["ЯЧСМИТЬБЮ", "ZXCVBNM<>"],
];

/// Signs that lie on other keys of a Ukrainian keyboard, each followed by the sign of the same key on an English one.
const SIGNS: [[char; 2]; 3] = [['"', '@'], ['.', '/'], [',', '?']];

/// The Latin character on the key of a Ukrainian letter; `None` for all other characters.
fn latin(letter: char) -> Option<char> {
    ROWS.iter().find_map(|[ukrainian, english]| {
        let at = ukrainian.chars().position(|known| known == letter)?;
        english.chars().nth(at)
    })
}

/// The same key on an English keyboard, if a Ukrainian one has another character on it.
pub(super) fn by_position(key: KeyEvent) -> Option<KeyEvent> {
    let KeyCode::Char(typed) = key.code else {
        return None;
    };
    let code = KeyCode::Char(latin_key(typed)?);
    Some(KeyEvent { code, ..key })
}

/// The character of the same key on an English keyboard; `None` if both keyboards have the same one.
pub fn latin_key(typed: char) -> Option<char> {
    latin(typed).or_else(|| {
        let mut signs = SIGNS.iter();
        signs.find_map(|[ukrainian, english]| (*ukrainian == typed).then_some(*english))
    })
}

/// A line in the Ukrainian keyboard layout as the Latin letters on its keys, character for character; `None` if no
/// character changes. A `"` at the beginning of a word is `@`, unless it ends the text of a field (`text="a "`). Other
/// signs stay: numbers and names contain them.
pub fn latin_line(line: &str) -> Option<String> {
    let has_latin = line.contains(|c: char| c.is_ascii_alphabetic());
    if has_latin && !line.chars().any(|letter| latin(letter).is_some()) {
        return None;
    }
    let (mut before, mut is_text) = (' ', false);
    let read = |typed: char| {
        let is_quote = typed == '"';
        let begins_word = before.is_whitespace() && !is_text;
        let begins_text = before == '=' && !is_text;
        before = typed;
        if is_quote {
            is_text = begins_text;
        }
        if is_quote && begins_word {
            '@'
        } else {
            latin(typed).unwrap_or(typed)
        }
    };
    let read: String = line.chars().map(read).collect();
    (read != line).then_some(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_lie_where_the_keys_are() {
        for (letter, key) in [('ц', 'w'), ('о', 'j'), ('Ж', ':'), ('М', 'V'), ('ю', '.')] {
            assert_eq!(latin(letter), Some(key), "{letter}");
        }
        assert_eq!(latin('w'), None);
        assert_eq!(latin_key('"'), Some('@'));
        for [ukrainian, english] in ROWS {
            assert_eq!(ukrainian.chars().count(), english.chars().count());
        }
    }

    #[test]
    fn a_line_is_read_by_its_keys() {
        for (line, read) in [
            ("ефлущаа 20", Some("takeoff 20")),
            ("\"кув фкь", Some("@red arm")),
            ("\"", Some("@")),
            ("ифеБ30", Some("bat<30")),
            ("іутв ф=\"a \" \"и", Some("send a=\"a \" @b")),
            ("\"red arm", None),
            ("1-4", None),
        ] {
            assert_eq!(latin_line(line).as_deref(), read, "{line}");
        }
    }
}
