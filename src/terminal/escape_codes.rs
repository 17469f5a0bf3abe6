//! Writes the sixteen basic colours of a frame in the escape codes that every terminal supports.
//! The colours of a frame are chosen earlier, in `ui::theme`.
//!
//! The terminal library writes basic colours as colours of the 256-colour palette (`38;5;1`), which
//! terminals with sixteen colours misread, and ends every frame with several resets, the last of
//! which includes the others.

/// The library's code at the end of a frame, and its basic equivalent.
const RESETS: (&[u8], &[u8]) = (b"\x1b[39m\x1b[49m\x1b[59m\x1b[0m", b"\x1b[0m");

/// The same frame with its basic colours in the short codes, such as `31` and `101`.
pub fn with_basic_colours(frame: &[u8]) -> Vec<u8> {
    let mut written = Vec::with_capacity(frame.len());
    let mut rest = frame;
    while let Some(at) = rest.iter().position(|&byte| byte == 0x1b) {
        written.extend_from_slice(&rest[..at]);
        rest = &rest[at..];
        if let Some(after) = rest.strip_prefix(RESETS.0) {
            written.extend_from_slice(RESETS.1);
            rest = after;
            continue;
        }
        let length = style_length(rest);
        match rest.get(2..length.saturating_sub(1)) {
            Some(parameters) if length > 3 => restyle(parameters, &mut written),
            _ => written.extend_from_slice(&rest[..length.max(1)]),
        }
        rest = &rest[length.max(1)..];
    }
    written.extend_from_slice(rest);
    written
}

/// The length of the style sequence (`ESC [ parameters m`) at the beginning of `bytes`; 0 if they begin with none.
fn style_length(bytes: &[u8]) -> usize {
    if !bytes.starts_with(b"\x1b[") {
        return 0;
    }
    let parameters = bytes[2..]
        .iter()
        .take_while(|byte| byte.is_ascii_digit() || **byte == b';')
        .count();
    if bytes.get(2 + parameters) == Some(&b'm') {
        parameters + 3
    } else {
        0
    }
}

fn restyle(parameters: &[u8], written: &mut Vec<u8>) {
    let text = String::from_utf8_lossy(parameters);
    let parts: Vec<&str> = text.split(';').collect();
    let mut said: Vec<String> = Vec::with_capacity(parts.len());
    let mut rest = parts.as_slice();
    while let Some((first, others)) = rest.split_first() {
        let length = match (*first, others) {
            ("38" | "48" | "58", ["5", ..]) => 3,
            ("38" | "48" | "58", ["2", ..]) => 5,
            _ => 1,
        };
        let (colour, after) = rest.split_at(length.min(rest.len()));
        said.push(basic_colour(colour).unwrap_or_else(|| colour.join(";")));
        rest = after;
    }
    written.extend_from_slice(b"\x1b[");
    written.extend_from_slice(said.join(";").as_bytes());
    written.push(b'm');
}

fn basic_colour(parts: &[&str]) -> Option<String> {
    let &[ground, "5", number] = parts else {
        return None;
    };
    let number: u16 = number.parse().ok()?;
    let base = match (ground, number) {
        ("38", 0..=7) => 30,
        ("48", 0..=7) => 40,
        ("38", 8..=15) => 90 - 8,
        ("48", 8..=15) => 100 - 8,
        _ => return None,
    };
    Some((base + number).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_basic_colours_are_said_otherwise() {
        let cases = [
            ("a\u{1b}[38;5;1mb", "a\u{1b}[31mb"),
            ("\u{1b}[38;5;9;48;5;15m", "\u{1b}[91;107m"),
            ("\u{1b}[38;5;102;48;5;7mx", "\u{1b}[38;5;102;47mx"),
            ("\u{1b}[38;2;5;5;1;48;5;0m", "\u{1b}[38;2;5;5;1;40m"),
            (
                "\u{1b}[1m\u{1b}[4;5H\u{1b}[?2026l",
                "\u{1b}[1m\u{1b}[4;5H\u{1b}[?2026l",
            ),
            ("\u{1b}[39m\u{1b}[49m\u{1b}[59m\u{1b}[0m.", "\u{1b}[0m."),
            ("висота\u{1b}", "висота\u{1b}"),
        ];
        for (library, terminal) in cases {
            let written = with_basic_colours(library.as_bytes());
            assert_eq!(String::from_utf8_lossy(&written), terminal);
        }
    }
}
