//! The lines of the page, with the tone of each.

use super::{DebriefPage, TimelineMark};

/// The meaning of a line, for screens that can show it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DebriefTone {
    /// The result: mission, score and medal.
    Head,
    /// The name of a section.
    Heading,
    #[default]
    Plain,
    /// A result that earned its points.
    Good,
    /// A result that cost points, or a failure.
    Bad,
    /// An improvement that may bring points.
    Gain,
    /// An event of the flight, by its kind.
    Event(TimelineMark),
}

/// A line of the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DebriefLine {
    pub text: String,
    pub tone: DebriefTone,
}

impl DebriefPage<'_> {
    pub(super) fn heading(&mut self, id: &str) {
        let heading = format!(" {}", self.locale.say(id));
        self.line_of(&heading, DebriefTone::Heading);
    }

    /// Writes a line with its own tone.
    pub(super) fn line_of(&mut self, line: &str, tone: DebriefTone) {
        self.toned(DebriefTone::Plain);
        self.line(line);
        self.toned(tone);
    }

    /// Sets the tone of the lines written since the last call.
    pub(super) fn toned(&mut self, tone: DebriefTone) {
        let written = self.words.matches('\n').count();
        self.tones.resize(written, tone);
    }
}
