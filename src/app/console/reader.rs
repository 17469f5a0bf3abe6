//! The words of a console line, read by the row of its verb.

use std::ops::Range;

use super::offer::Names;
use super::table::ConsoleVerb;
use crate::diagnostic::Diagnostic;
use crate::language::Word;
use crate::text;
use crate::text::Text;

/// A line that begins with a verb of the console.
pub(super) struct LineReader<'a> {
    pub names: &'a Names<'a>,
    pub verb_span: Range<usize>,
    verb: &'static ConsoleVerb,
    line: &'a str,
    words: &'a [Word<'a>],
}

impl<'a> LineReader<'a> {
    /// # Errors
    /// More words than the verb takes.
    pub fn new(
        verb: &'static ConsoleVerb,
        line: &'a str,
        words: &'a [Word<'a>],
        names: &'a Names<'a>,
    ) -> Result<Self, Diagnostic> {
        let (first, arguments) = words
            .split_first()
            .map_or((0..0, words), |(first, rest)| (first.span.clone(), rest));
        let reader = Self {
            names,
            verb_span: first,
            verb,
            line,
            words: arguments,
        };
        match arguments.get(verb.most_words) {
            Some(extra) => Err(
                Diagnostic::new(extra.span.clone(), text!("console-too-much"))
                    .with_help(reader.usage()),
            ),
            None => Ok(reader),
        }
    }

    /// The words after the verb.
    pub fn words(&self) -> &'a [Word<'a>] {
        self.words
    }

    pub fn first(&self) -> Option<&'a Word<'a>> {
        self.words.first()
    }

    pub fn word(&self, at: usize) -> Option<&'a str> {
        self.words.get(at).map(|word| word.text)
    }

    /// From a word on as it was written, with its blanks.
    pub fn rest(&self, from: usize) -> Option<&'a str> {
        let (first, last) = (self.words.get(from)?, self.words.last()?);
        self.line.get(first.span.start..last.span.end)
    }

    /// # Errors
    /// The word is missing.
    pub fn required(&self, at: usize) -> Result<&'a str, Diagnostic> {
        let missing = || self.missing(text!("console-missing"));
        self.word(at).ok_or_else(missing)
    }

    /// A word that has to be one of those that could follow.
    ///
    /// # Errors
    /// It is missing or another one.
    pub fn known(&self, at: usize) -> Result<&'a str, Diagnostic> {
        let written = self.required(at)?;
        let before: Vec<&str> = self.words[..at].iter().map(|word| word.text).collect();
        let could = (self.verb.following)(self.names, &before).into_iter();
        let could: Vec<&str> = could.map(|(name, _)| name).collect();
        if could.contains(&written) {
            return Ok(written);
        }
        let span = self.words[at].span.clone();
        let fault = Diagnostic::new(span, text!("console-unknown", word = written));
        let help = if could.is_empty() {
            text!("console-none")
        } else {
            text!("console-known", names = could.join(", "))
        };
        Err(fault.with_help(help).with_nearest(written, could))
    }

    /// That something is missing at the end of the line.
    pub fn missing(&self, what: Text) -> Diagnostic {
        let end = self.line.trim_end().len();
        Diagnostic::new(end..end, what).with_help(self.usage())
    }

    /// That a word is wrong.
    pub fn wrong(&self, at: usize, why: Text) -> Diagnostic {
        let span = self.words.get(at).map(|word| word.span.clone());
        Diagnostic::new(span.unwrap_or_default(), why).with_help(self.usage())
    }

    fn usage(&self) -> Text {
        text!("console-usage", usage = self.verb.usage)
    }
}
