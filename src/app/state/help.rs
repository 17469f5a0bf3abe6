//! The help, made from the keymap, the console's own verbs and the verb table.

use crate::app::console::CONSOLE_VERBS;
use crate::app::keymap::{Binding, Keymap, Place};
use crate::language::verbs;

/// Columns of a usage that leaves room for an explanation beside it.
pub const SHORT_USAGE: usize = 28;

/// One line of the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HelpLine {
    /// A heading.
    Title(&'static str),
    /// Something to press or write, and what it does.
    Entry(String, String),
    /// Space between.
    Blank,
}

/// The whole help.
pub fn help_lines(keymap: &Keymap) -> Vec<HelpLine> {
    let mut lines = Vec::new();
    for place in [
        Place::Fly,
        Place::Anywhere,
        Place::Prompt,
        Place::Home,
        Place::Debrief,
    ] {
        lines.push(HelpLine::Title(place.title()));
        lines.extend(keys(keymap, place));
        lines.push(HelpLine::Blank);
    }
    lines.push(HelpLine::Title("commands: [targets] verb [arguments]"));
    let targets = "targets: 3  1-4,7  @group  all; none means the selection";
    lines.push(HelpLine::Entry("1-4,7 arm".to_owned(), targets.to_owned()));
    for verb in verbs() {
        // The summary stands beside the last usage, or below it where that is long.
        let mut usages = verb.usage();
        let last = usages.pop().unwrap_or_default();
        lines.extend(usages.iter().map(|usage| entry(usage, "")));
        if last.chars().count() <= SHORT_USAGE {
            lines.push(entry(&last, verb.summary));
        } else {
            lines.push(entry(&last, ""));
            lines.push(entry("", verb.summary));
        }
    }
    lines.push(HelpLine::Blank);
    lines.push(HelpLine::Title("the console itself"));
    lines.extend(
        CONSOLE_VERBS
            .iter()
            .map(|verb| entry(verb.usage, verb.summary)),
    );
    lines
}

/// The keys of a place; keys with one meaning share a line.
fn keys(keymap: &Keymap, place: Place) -> Vec<HelpLine> {
    let mut rows: Vec<(String, &Binding)> = Vec::new();
    let here = keymap
        .bindings()
        .iter()
        .filter(|binding| binding.place == place);
    for binding in here {
        let same = |(_, known): &&mut (String, &Binding)| known.description == binding.description;
        match rows.iter_mut().find(same) {
            Some((labels, _)) => {
                labels.push(' ');
                labels.push_str(&binding.press.label());
            }
            None => rows.push((binding.press.label(), binding)),
        }
    }
    let lines = rows.into_iter();
    lines
        .map(|(labels, binding)| entry(&labels, binding.description))
        .collect()
}

fn entry(what: &str, meaning: &str) -> HelpLine {
    HelpLine::Entry(what.to_owned(), meaning.to_owned())
}
