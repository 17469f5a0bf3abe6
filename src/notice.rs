//! Notices to the operator: events, each reported in one line.

use std::time::Duration;

use crate::alert::AlertKind;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::vehicle::VehicleId;

/// One line for the notice list, the log and the debrief's timeline.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Notice {
    /// When the event happened, on the program's clock.
    pub at: Duration,
    /// The vehicle concerned, if any.
    pub vehicle: Option<VehicleId>,
    /// How serious the notice is.
    pub severity: Severity,
    /// The kind of alert that it reports, if known.
    pub kind: Option<AlertKind>,
    pub source: NoticeSource,
    /// The message; foreign text in it is free of control characters.
    pub text: Text,
}

/// Where a notice's text comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoticeSource {
    /// The notice comes from this program.
    Program,
    /// The notice repeats a vehicle's STATUSTEXT.
    Vehicle,
    /// The notice is about the class or from its desk: a person may wait for the answer.
    Class,
}

impl Notice {
    /// A notice that concerns a vehicle and no alert.
    pub fn about(vehicle: VehicleId, at: Duration, severity: Severity, text: Text) -> Self {
        Self {
            vehicle: Some(vehicle),
            ..Self::general(at, severity, text)
        }
    }

    /// A notice that concerns no vehicle and no alert.
    pub fn general(at: Duration, severity: Severity, text: Text) -> Self {
        Self {
            at,
            vehicle: None,
            severity,
            kind: None,
            source: NoticeSource::Program,
            text,
        }
    }
}

/// Makes foreign text safe to show in a line: control characters (escape sequences begin with one) and bidirectional
/// overrides become `?`, and trailing blanks are removed.
pub fn sanitised(text: &str) -> String {
    let cleaned: String = text.chars().map(harmless).collect();
    cleaned.trim_end().to_owned()
}

/// Makes a whole output safe to print, as [`sanitised`] does, but keeps lines, tabs and blanks.
pub fn sanitised_lines(text: &str) -> String {
    let mut letters = text.chars().peekable();
    let mut cleaned = String::with_capacity(text.len());
    while let Some(letter) = letters.next() {
        let ends_line = letter == '\n' || (letter == '\r' && letters.peek() == Some(&'\n'));
        let stays = ends_line || letter == '\t';
        cleaned.push(if stays { letter } else { harmless(letter) });
    }
    cleaned
}

fn harmless(letter: char) -> char {
    let reorders = matches!(letter, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' | '\u{200E}' | '\u{200F}');
    if letter.is_control() || reorders {
        '?'
    } else {
        letter
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stay_lines_without_escape_sequences() {
        let text = "a\tb \r\n\u{1b}[31mc\rd\n";
        assert_eq!(sanitised_lines(text), "a\tb \r\n?[31mc?d\n");
    }

    #[test]
    fn escape_sequences_do_not_survive() {
        assert_eq!(sanitised("hi\u{1b}[2J\u{9b}31m\r\n"), "hi?[2J?31m??");
        assert_eq!(sanitised("Батарея ok  "), "Батарея ok");
    }
}
