//! Errors in files and lines that people write: the fault, its exact place, and advice.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use strsim::osa_distance;

use crate::text;
use crate::text::{Locale, Text};

mod toml_words;

use toml_words::toml_words;
pub use toml_words::{serde_words, toml_value};

/// The longest line shown below a fault, in characters.
const LONGEST_EXCERPT: usize = 200;

/// One fault in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its place, in bytes of the text.
    pub span: Range<usize>,
    pub message: Text,
    /// Advice, unless the remedy is obvious.
    pub help: Option<Text>,
}

impl Diagnostic {
    /// A fault without advice.
    pub fn new(span: Range<usize>, message: impl Into<Text>) -> Self {
        Self {
            span,
            message: message.into(),
            help: None,
        }
    }

    /// The same fault, with advice on how to repair it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<Text>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds "did you mean" if one of `names` is close to the written word, or begins with it.
    #[must_use]
    pub fn with_nearest<'a>(self, written: &str, names: impl IntoIterator<Item = &'a str>) -> Self {
        let names: Vec<&str> = names.into_iter().collect();
        match nearest(written, names.iter().copied()).or_else(|| beginning(written, &names)) {
            Some(name) => self.with_help(text!("grammar-did-you-mean", name = name)),
            None => self,
        }
    }

    /// The same fault in a file that contains the line as a string: `quoted` is the place of the
    /// string with its quotes, `length` the length of the line in bytes.
    #[must_use]
    pub fn in_string(mut self, quoted: Range<usize>, length: usize) -> Self {
        // Escapes and triple quotes shift the text after them; in that case the fault covers the whole string.
        self.span = if quoted.len() == length + 2 {
            let start = quoted.start + 1;
            start + self.span.start..start + self.span.end
        } else {
            quoted
        };
        self
    }

    /// A fault reported by the TOML reader.
    pub fn from_toml(error: &toml::de::Error) -> Self {
        Self::new(error.span().unwrap_or(0..0), toml_words(error.message()))
    }

    /// Line and column in `source`, both counted from 1; columns are characters.
    pub fn line_column(&self, source: &str) -> (usize, usize) {
        let mut start = self.span.start.min(source.len());
        while !source.is_char_boundary(start) {
            start -= 1;
        }
        let before = &source[..start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        (
            before.matches('\n').count() + 1,
            before[line_start..].chars().count() + 1,
        )
    }

    /// `FILE:LINE:COLUMN: message`, for programs to read.
    pub fn one_line(&self, file: &str, source: &str) -> String {
        let (line, column) = self.line_column(source);
        let help = self
            .help
            .as_ref()
            .map_or(String::new(), |help| format!(" ({help})"));
        format!("{file}:{line}:{column}: {}{help}", self.message)
    }

    /// The line of [`Self::one_line`] as a text in the user's language.
    pub fn text(&self, file: &str, source: &str) -> Text {
        let (line, column) = self.line_column(source);
        let place = Text::verbatim(format!("{file}:{line}:{column}:"));
        let mut parts = vec![place, self.message.clone()];
        if let Some(help) = &self.help {
            let help = vec![Text::verbatim("("), help.clone(), Text::verbatim(")")];
            parts.push(Text::joined("", help));
        }
        Text::joined(" ", parts)
    }

    /// The line with the fault, and below it a mark at its place. Empty if the line is too long to be read.
    pub fn excerpt(&self, source: &str) -> String {
        let (number, column) = self.line_column(source);
        let written = source.lines().nth(number - 1).unwrap_or_default();
        let line = written.replace('\t', " ");
        if line.chars().count() > LONGEST_EXCERPT {
            return String::new();
        }
        let mark = " ".repeat(column - 1);
        format!("  {line}\n  {mark}^")
    }

    /// The fault with the surrounding lines, for people.
    pub fn render(&self, file: &str, source: &str, colour: bool, locale: &Locale) -> String {
        let start = self.span.start.min(source.len());
        let end = self.span.end.clamp(start, source.len());
        let error = Level::ERROR.with_name(locale.text(&text!("fault-error")));
        let title = error.primary_title(locale.text(&self.message)).element(
            Snippet::source(source)
                .path(file)
                .annotation(AnnotationKind::Primary.span(start..end)),
        );
        let mut report = vec![title];
        if let Some(help) = &self.help {
            report.push(Group::with_title(
                Level::HELP
                    .with_name(locale.text(&text!("fault-help")))
                    .secondary_title(locale.text(help)),
            ));
        }
        let renderer = if colour {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        renderer.render(&report)
    }
}

/// The maximum number of faults listed per file.
const MOST_SHOWN: usize = 50;

/// The first faults of a file, and a line with the number of those not shown.
pub fn first_shown(faults: &[Diagnostic]) -> (&[Diagnostic], Option<Text>) {
    let more = faults.len().saturating_sub(MOST_SHOWN);
    let rest = (more > 0).then(|| text!("file-more-faults", count = more));
    (&faults[..faults.len() - more], rest)
}

/// The name closest to the written word, if it is close enough to be a typing error.
pub fn nearest<'a>(written: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let nearest = typing_errors(written, names).into_iter().next();
    nearest.map(|(_, name)| name)
}

/// The maximum number of similar names to suggest for a word.
const MOST_NEAR: usize = 3;

/// The names that the written word may mean: those that it misspells, closest first, then those that contain it, then
/// one that it begins with.
pub fn near<'a>(written: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    const LETTERS: usize = 3;
    let names: Vec<&str> = names.into_iter().collect();
    let slips = typing_errors(written, names.iter().copied());
    let mut near: Vec<&str> = slips.into_iter().map(|(_, name)| name).collect();
    if written.chars().count() >= LETTERS {
        let lower = written.to_lowercase();
        let at = |name: &'a str| Some((name.to_lowercase().find(&lower)?, name));
        let mut containing: Vec<(usize, &str)> = names.iter().copied().filter_map(at).collect();
        containing.sort_by_key(|(at, _)| *at);
        near.extend(containing.into_iter().map(|(_, name)| name));
        near.extend(beginning(written, &names));
    }
    let mut seen = std::collections::BTreeSet::new();
    near.retain(|name| seen.insert(*name));
    near.truncate(MOST_NEAR);
    near
}

/// The names that the written word may misspell, closest first. The distance counts insertions,
/// deletions, substitutions and swaps of neighbours (optimal string alignment).
fn typing_errors<'a>(
    written: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Vec<(usize, &'a str)> {
    let written = written.to_lowercase();
    let length = written.chars().count();
    let distance = |name: &str| {
        let letters = name.chars().count();
        let most = (letters / 3).max(1);
        // The distance is at least the difference in length, so long lines need no comparison at
        // each key press.
        let is_near = length.abs_diff(letters) <= most;
        let distance = is_near.then(|| osa_distance(&written, &name.to_lowercase()));
        distance.filter(|&distance| distance <= most)
    };
    let near = names.into_iter();
    let mut near: Vec<_> = near
        .filter_map(|name| Some((distance(name)?, name)))
        .collect();
    near.sort_by_key(|&(distance, _)| distance);
    near
}

/// The longest name that the written word begins with, otherwise the only name that begins with the
/// word: `bat` for `battery`, `heading` for `head`. Words and names of fewer than three letters
/// would only give guesses.
fn beginning<'a>(written: &str, names: &[&'a str]) -> Option<&'a str> {
    const LETTERS: usize = 3;
    let written = written.to_lowercase();
    let long = |word: &str| word.chars().count() >= LETTERS;
    let begun = names
        .iter()
        .filter(|name| long(name) && written.starts_with(&name.to_lowercase()));
    let mut goes_on = names
        .iter()
        .filter(|name| long(&written) && name.to_lowercase().starts_with(&written));
    let only = goes_on.next().filter(|_| goes_on.next().is_none());
    begun.max_by_key(|name| name.len()).or(only).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;

    #[test]
    fn places_are_counted_in_characters_from_one() {
        let source = "a = 1\nназва = х\n";
        let at = source.find('х').expect("it is there");
        assert_eq!(
            Diagnostic::new(at..at + 2, "bad").line_column(source),
            (2, 9)
        );
    }

    #[test]
    fn slips_of_the_finger_find_their_name() {
        let verbs = ["takeoff", "land", "goto", "arm"];
        assert_eq!(nearest("takeof", verbs), Some("takeoff"));
        assert_eq!(nearest("GTOO", verbs), Some("goto"));
        assert_eq!(nearest("amr", verbs), Some("arm"));
        assert_eq!(nearest("survey", verbs), None);
    }

    #[test]
    fn a_word_that_begins_like_a_name_finds_it() {
        let help = |word: &str, names: [&str; 3]| {
            let fault = Diagnostic::new(0..0, "bad").with_nearest(word, names);
            fault.help.map(|help| help.to_string())
        };
        let meant = |name: &str| Some(format!("did you mean `{name}`?"));
        assert_eq!(help("battery", ["bat", "ba", "id"]), meant("bat"));
        assert_eq!(help("head", ["bat", "heading", "home"]), meant("heading"));
        assert_eq!(help("link", ["linked-up", "link-lost", "id"]), None);
        assert_eq!(help("identity", ["id", "bat", "home"]), None);
    }

    #[test]
    fn the_excerpt_marks_the_place() {
        let source = "a = 1\n\tназва = = 2\n";
        let at = source.rfind('=').expect("it is there");
        let excerpt = Diagnostic::new(at..at + 1, "bad").excerpt(source);
        assert_eq!(excerpt, "   назва = = 2\n           ^");
        let at_end = Diagnostic::new(source.len()..source.len(), "bad");
        assert_eq!(at_end.excerpt(source), "  \n  ^");
        let long = "x".repeat(1000);
        assert_eq!(Diagnostic::new(500..501, "bad").excerpt(&long), "");
    }

    #[test]
    fn the_rendering_points_at_the_word() {
        let source = "all takeof 20";
        let text = Diagnostic::new(4..10, "unknown verb `takeof`")
            .with_nearest("takeof", ["takeoff"])
            .render("x.pilot", source, false, &Locale::new(Language::English));
        assert!(text.starts_with("error: unknown verb"), "{text}");
        assert!(text.contains("x.pilot:1:5"), "{text}");
        assert!(text.contains("^^^^^^"), "{text}");
        assert!(text.contains("did you mean `takeoff`?"), "{text}");
    }

    #[test]
    fn the_rendering_is_in_the_language_of_the_user() {
        let source = "brief = = 1";
        let error = toml::from_str::<toml::Table>(source).expect_err("a fault");
        let fault =
            Diagnostic::from_toml(&error).with_help(text!("grammar-did-you-mean", name = "="));
        let text = fault.render("x.toml", source, false, &Locale::new(Language::Ukrainian));
        assert!(text.starts_with("помилка: зайвий знак `=`"), "{text}");
        assert!(text.contains("порада: може, `=`?"), "{text}");
    }
}
