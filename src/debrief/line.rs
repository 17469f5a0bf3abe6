//! The lines of the page, with what each tells.

use super::{DebriefPage, TimelineMark};

/// What a line tells, for screens that can show it.
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
    /// What may bring points.
    Gain,
    /// What happened, by its kind.
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

    /// A line that tells something of its own.
    pub(super) fn line_of(&mut self, line: &str, tone: DebriefTone) {
        self.toned(DebriefTone::Plain);
        self.line(line);
        self.toned(tone);
    }

    /// Says what the lines tell that were written since it was said last.
    pub(super) fn toned(&mut self, tone: DebriefTone) {
        let written = self.words.matches('\n').count();
        self.tones.resize(written, tone);
    }
}
