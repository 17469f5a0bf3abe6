//! The lines of standard input.

use std::io::{BufRead, ErrorKind};

use tokio::sync::mpsc;

/// Lines that may be given ahead.
const LINES_AHEAD: usize = 16;

/// A line as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Line {
    /// A line of text.
    Read(String),
    /// A line that is not UTF-8, with marks where it is not: nobody knows what was meant.
    Garbled(String),
}

/// Begins to read standard input.
pub(super) fn read() -> mpsc::Receiver<Line> {
    let (sender, lines) = mpsc::channel(LINES_AHEAD);
    std::thread::spawn(move || {
        for line in lines_of(std::io::stdin().lock()) {
            if sender.blocking_send(line).is_err() {
                break;
            }
        }
    });
    lines
}

/// The lines of an input until it ends or fails.
fn lines_of(mut input: impl BufRead) -> impl Iterator<Item = Line> {
    std::iter::from_fn(move || {
        let mut bytes = Vec::new();
        loop {
            return match input.read_until(b'\n', &mut bytes) {
                Ok(0) if bytes.is_empty() => None,
                Ok(_) => Some(line(bytes)),
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(_) => None,
            };
        }
    })
}

fn line(bytes: Vec<u8>) -> Line {
    match String::from_utf8(bytes) {
        Ok(text) => Line::Read(text),
        Err(error) => Line::Garbled(String::from_utf8_lossy(error.as_bytes()).into_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_is_not_utf_8_does_not_hide_those_after_it() {
        let input: &[u8] = b"status\n1 l\xffand\n\nall land";
        let lines: Vec<Line> = lines_of(input).collect();
        let expected = [
            Line::Read("status\n".to_owned()),
            Line::Garbled("1 l\u{fffd}and\n".to_owned()),
            Line::Read("\n".to_owned()),
            Line::Read("all land".to_owned()),
        ];
        assert_eq!(lines, expected);
    }
}
