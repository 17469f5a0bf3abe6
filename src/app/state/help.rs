//! The help, made from the keymap, the console's own verbs and the verb table.

use crate::app::console::CONSOLE_VERBS;
use crate::app::keymap::{Keymap, Meaning, Place};
use crate::language::{Verb, verbs};
use crate::text;
use crate::text::Text;

/// Columns of a usage that leaves room for an explanation beside it.
pub const SHORT_USAGE: usize = 22;

/// Columns of a summary that fits beside it.
const SHORT_SUMMARY: usize = 49;
/// Columns of a note.
const NOTE_WIDTH: usize = 66;
/// Verbs that only pilot scripts can say.
pub const SCRIPT_VERBS: &[&str] = &["wait"];

/// One line of the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HelpLine {
    /// A heading.
    Title(Text),
    /// Something to press or write, and what it does.
    Entry(String, Text),
    /// An explanation below an entry.
    Note(String),
    /// Space between.
    Blank,
}

/// The whole help.
pub fn help_lines(keymap: &Keymap) -> Vec<HelpLine> {
    let mut lines = Vec::new();
    for place in Place::all() {
        let keys = keys(keymap, place);
        if keys.is_empty() {
            continue;
        }
        lines.push(HelpLine::Title(place.title()));
        lines.extend(keys);
        lines.push(HelpLine::Blank);
    }
    lines.push(HelpLine::Title(text!("help-commands")));
    lines.extend(notes(
        "targets: 3  1-4,7  @group  all; none means the selection",
    ));
    for verb in verbs()
        .iter()
        .filter(|verb| !SCRIPT_VERBS.contains(&verb.name))
    {
        lines.extend(explained(verb));
    }
    lines.push(HelpLine::Blank);
    lines.push(HelpLine::Title(text!("help-console")));
    lines.extend(
        CONSOLE_VERBS
            .iter()
            .map(|verb| entry(verb.usage, verb.summary)),
    );
    lines
}

/// A verb: its summary beside its usage, or below where one of them is long.
fn explained(verb: &Verb) -> Vec<HelpLine> {
    let usages = verb.usage();
    let summary = verb.summary();
    let words = summary.to_string();
    if let [usage] = usages.as_slice()
        && usage.chars().count() <= SHORT_USAGE
        && words.chars().count() <= SHORT_SUMMARY
    {
        return vec![entry(usage, summary)];
    }
    let mut lines: Vec<HelpLine> = usages.iter().map(|usage| entry(usage, "")).collect();
    lines.extend(notes(&words));
    lines
}

/// A text in lines of the width of notes.
fn notes(text: &str) -> Vec<HelpLine> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < NOTE_WIDTH => {
                if !line.is_empty() {
                    line.push(' ');
                }
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.into_iter().map(HelpLine::Note).collect()
}

/// The keys of a place; keys with one meaning share a line.
fn keys(keymap: &Keymap, place: Place) -> Vec<HelpLine> {
    let mut rows: Vec<(String, &Meaning)> = Vec::new();
    let here = keymap
        .bindings()
        .iter()
        .filter(|binding| binding.place == place);
    for binding in here {
        let same = |(_, known): &&mut (String, &Meaning)| **known == binding.meaning;
        match rows.iter_mut().find(same) {
            Some((labels, _)) => {
                labels.push(' ');
                labels.push_str(&binding.press.label());
            }
            None => rows.push((binding.press.label(), &binding.meaning)),
        }
    }
    let lines = rows.into_iter();
    lines
        .map(|(labels, meaning)| entry(&labels, meaning.description()))
        .collect()
}

fn entry(what: &str, meaning: impl Into<Text>) -> HelpLine {
    HelpLine::Entry(what.to_owned(), meaning.into())
}
