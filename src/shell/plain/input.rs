//! The lines of standard input.

use std::io::{BufRead, ErrorKind};

use tokio::sync::mpsc;

/// The maximum number of lines read ahead.
const LINES_AHEAD: usize = 16;

/// A line as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PlainLine {
    /// A line of text.
    Read(String),
    /// A line that is not valid UTF-8, with replacement characters for the invalid bytes.
    Garbled(String),
}

/// Whether a line is neither empty nor a comment.
pub(super) fn is_said(line: &str) -> bool {
    !line.is_empty() && !line.starts_with('#')
}

/// Starts to read standard input.
pub(super) fn read() -> mpsc::Receiver<PlainLine> {
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
fn lines_of(mut input: impl BufRead) -> impl Iterator<Item = PlainLine> {
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

fn line(bytes: Vec<u8>) -> PlainLine {
    match String::from_utf8(bytes) {
        Ok(text) => PlainLine::Read(text),
        Err(error) => PlainLine::Garbled(String::from_utf8_lossy(error.as_bytes()).into_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_is_not_utf_8_does_not_hide_those_after_it() {
        let input: &[u8] = b"status\n1 l\xffand\n\nall land";
        let lines: Vec<PlainLine> = lines_of(input).collect();
        let expected = [
            PlainLine::Read("status\n".to_owned()),
            PlainLine::Garbled("1 l\u{fffd}and\n".to_owned()),
            PlainLine::Read("\n".to_owned()),
            PlainLine::Read("all land".to_owned()),
        ];
        assert_eq!(lines, expected);
    }
}
