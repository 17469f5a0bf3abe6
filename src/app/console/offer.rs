//! What the console's own lines could be: the names that may stand in them, completions, and whole lines.

use std::collections::BTreeMap;

use super::table::{CONSOLE_VERBS, ConsoleVerb, Offered, find};
use crate::language::{Completion, Groups, Word, words};
use crate::mission::{Inject, Listing};
use crate::text::Text;

/// The names that words of a console line may be, besides vehicles.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a> {
    pub themes: &'a [String],
    /// The missions: id and title.
    pub missions: &'a [Listing],
    /// What an instructor may have happen in the mission; `None` without one under way.
    pub injects: Option<&'a [Inject]>,
    pub macros: &'a BTreeMap<String, Vec<String>>,
    pub groups: &'a Groups,
}

/// What could stand at the end of the line, if the console itself has something to offer.
pub fn complete(line: &str, cursor: usize, names: &Names<'_>) -> Vec<Completion> {
    let until_cursor = line.get(..cursor).unwrap_or(line);
    let mut before = words(until_cursor);
    let partial = before.pop_if(|word| word.span.end == until_cursor.len());
    let (written, start) = partial.map_or(("", until_cursor.len()), |word: Word<'_>| {
        (word.text, word.span.start)
    });
    let candidates = match before.split_first() {
        None => CONSOLE_VERBS
            .iter()
            .map(|verb| (verb.name, verb.summary()))
            .collect(),
        Some((verb, arguments)) => {
            let arguments: Vec<&str> = arguments.iter().map(|word| word.text).collect();
            find(verb.text).map_or_else(Vec::new, |verb| (verb.following)(names, &arguments))
        }
    };
    let fitting = candidates.into_iter();
    fitting
        .filter(|(name, _)| name.starts_with(written))
        .map(|(name, hint)| Completion {
            text: name.to_owned(),
            hint,
            replaces: start..until_cursor.len(),
        })
        .collect()
}

/// Every line that the console could carry out as it stands, with what it means: rooms, missions, macros, settings.
pub fn lines(names: &Names<'_>) -> Vec<(String, Text)> {
    CONSOLE_VERBS
        .iter()
        .flat_map(|verb| verb.lines(names))
        .collect()
}

impl ConsoleVerb {
    fn lines(&self, names: &Names<'_>) -> Vec<(String, Text)> {
        let with = |before: &[&str]| {
            let following = (self.following)(names, before).into_iter();
            let start = std::iter::once(self.name).chain(before.iter().copied());
            let start: Vec<&str> = start.collect();
            let start = start.join(" ");
            following
                .map(|(word, hint)| (format!("{start} {word}"), hint))
                .collect::<Vec<_>>()
        };
        match self.offered {
            Offered::None => Vec::new(),
            Offered::Alone => vec![(self.name.to_owned(), self.summary())],
            Offered::Words => with(&[]),
            Offered::Pairs => {
                let first = (self.following)(names, &[]).into_iter();
                first.flat_map(|(word, _)| with(&[word])).collect()
            }
        }
    }
}
