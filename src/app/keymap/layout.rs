//! Keyboard layouts: the Latin key at the place of each Ukrainian letter.

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

/// The Latin character on the key of a Ukrainian letter; `None` for all other characters.
pub fn latin(letter: char) -> Option<char> {
    ROWS.iter().find_map(|[ukrainian, english]| {
        let at = ukrainian.chars().position(|known| known == letter)?;
        english.chars().nth(at)
    })
}

/// The same key on an English keyboard, if the key has a Ukrainian letter.
pub(super) fn by_position(key: KeyEvent) -> Option<KeyEvent> {
    let KeyCode::Char(letter) = key.code else {
        return None;
    };
    let code = KeyCode::Char(latin(letter)?);
    Some(KeyEvent { code, ..key })
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
        for [ukrainian, english] in ROWS {
            assert_eq!(ukrainian.chars().count(), english.chars().count());
        }
    }
}
