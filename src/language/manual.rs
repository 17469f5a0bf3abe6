//! The verb table as text.

use std::fmt::Write as _;

use super::{Scope, VerbRow, rows};
use crate::verb::{Danger, UnsuitedKind};

/// The manual of the language: the structure of a line, then every verb with its forms, arguments and examples.
pub fn manual() -> String {
    let mut text = INTRODUCTION.to_owned();
    for row in rows() {
        text.push('\n');
        for usage in row.usage() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{usage}");
        }
        let _ = writeln!(text, "    {}", row.summary());
        for remark in remarks(row) {
            let _ = writeln!(text, "    {remark}");
        }
        let mut seen: Vec<String> = Vec::new();
        for argument in row.forms.iter().flat_map(|form| form.arguments) {
            let line = format!("    {:<16} {}", argument.usage(), argument.explained());
            if !argument.explained().is_empty() && !seen.contains(&line) {
                let _ = writeln!(text, "{line}");
                seen.push(line);
            }
        }
        for example in row.examples {
            let _ = writeln!(text, "    e.g. {example}");
        }
    }
    text
}

/// Where a verb is allowed, what it asks, and which vehicles it does not suit.
fn remarks(row: &VerbRow) -> Vec<String> {
    let mut lines = Vec::new();
    if !row.aliases.is_empty() {
        lines.push(format!("also: {}", row.aliases.join(", ")));
    }
    let only = match row.scope {
        Scope::Everywhere => "",
        Scope::Scripts => "only in scripts and through a pipe",
        Scope::Console => "only in the console",
        Scope::Screen => "only in the console with a screen",
        Scope::Plain => "only in the console without a screen",
    };
    if !only.is_empty() {
        lines.push(only.to_owned());
    }
    if row.verb.danger == Danger::Confirm {
        lines.push("asks for confirmation".to_owned());
    }
    let kinds = row
        .verb
        .unsuited
        .iter()
        .map(|unsuited| match unsuited.kind {
            UnsuitedKind::Surface => "rovers and boats",
            UnsuitedKind::Plane => "planes",
            UnsuitedKind::FixedWing => "planes that do not hover",
        });
    let kinds: Vec<&str> = kinds.collect();
    if !kinds.is_empty() {
        lines.push(format!("not for {}", kinds.join(", ")));
    }
    lines
}

const INTRODUCTION: &str = "\
A line is [TARGETS] VERB [ARGUMENTS].
TARGETS are 3, 1-4,7, @GROUP, all, or none for the selection; after `wait` they follow the verb.
Words in capitals are values, words in [] may be left out, | separates choices. A number may carry its
unit: 20m, 5m/s, 30s, 3min, 90deg. A mode's name alone changes to it. # begins a comment.
";
