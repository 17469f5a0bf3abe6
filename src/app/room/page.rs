//! Pages of text, line by line, each line with its meaning.

use unicode_width::UnicodeWidthStr as _;

use crate::text::{Locale, Text, wrap};

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// A heading with a rule.
    Title,
    Plain,
    Muted,
    /// An objective that is met.
    Met,
    /// An objective that was not met.
    Missed,
    /// A condition that blocks or restricts the mission.
    Warning,
    /// Advice on the next step.
    Hint,
    /// The hint that was requested last.
    AskedHint,
}

/// One line of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageLine {
    pub tone: Tone,
    pub text: String,
}

/// A page of text while it is written.
#[derive(Debug)]
pub struct TextPage<'a> {
    pub locale: &'a Locale,
    /// The maximum number of columns of a line.
    pub width: usize,
    lines: Vec<PageLine>,
}

impl<'a> TextPage<'a> {
    pub fn new(locale: &'a Locale, width: usize) -> Self {
        Self {
            locale,
            width,
            lines: Vec::new(),
        }
    }

    /// The lines that were written.
    pub fn finish(self) -> Vec<PageLine> {
        self.lines
    }
}

impl TextPage<'_> {
    /// Adds a line as it is, without wrapping.
    pub fn add(&mut self, tone: Tone, text: impl Into<String>) {
        let text = text.into();
        self.lines.push(PageLine { tone, text });
    }

    /// Adds a heading, with a blank line above it.
    pub fn title(&mut self, text: &Text) {
        if !self.lines.is_empty() {
            self.add(Tone::Plain, "");
        }
        self.add(Tone::Title, self.locale.text(text));
    }

    pub fn paragraph(&mut self, tone: Tone, text: &str) {
        for line in wrap(text, self.width) {
            self.add(tone, line);
        }
    }

    pub fn say(&mut self, tone: Tone, text: &Text) {
        let words = self.locale.text(text);
        self.paragraph(tone, &words);
    }

    /// Adds an item of a list; its second and later lines are indented.
    pub fn item(&mut self, tone: Tone, lead: &str, text: &str) {
        let indent = " ".repeat(lead.len());
        let lines = wrap(text, self.width.saturating_sub(lead.len()));
        for (at, line) in lines.iter().enumerate() {
            let lead = if at == 0 { lead } else { &indent };
            self.add(tone, format!("{lead}{line}"));
        }
    }

    /// Adds names, each with its explanation beside it.
    pub fn rows(&mut self, rows: &[(Text, Text)]) {
        let plain = rows
            .iter()
            .map(|(name, what)| (name.clone(), what.clone(), Tone::Plain));
        self.toned_rows(&plain.collect::<Vec<_>>());
    }

    /// Adds names and explanations, each pair in its own tone.
    pub fn toned_rows(&mut self, rows: &[(Text, Text, Tone)]) {
        let names: Vec<String> = rows
            .iter()
            .map(|(name, ..)| self.locale.text(name))
            .collect();
        let indent = names.iter().map(|name| name.width()).max().unwrap_or(0) + 2;
        for (name, (_, what, tone)) in names.iter().zip(rows) {
            let what = self.locale.text(what);
            let mut lead = padded(name, indent);
            for line in wrap(&what, self.width.saturating_sub(indent)) {
                self.add(*tone, lead + &line);
                lead = " ".repeat(indent);
            }
        }
    }
}

/// A text padded with spaces to at least `width` columns.
pub fn padded(text: &str, width: usize) -> String {
    let gap = width.saturating_sub(text.width());
    format!("{text}{}", " ".repeat(gap))
}
