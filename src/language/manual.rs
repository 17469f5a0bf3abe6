//! The verb table as text.

use std::fmt::Write as _;

use super::verb::Danger;
use super::verbs;

/// The manual of the language: how a line is built, then every verb with its forms, arguments and examples.
pub fn manual() -> String {
    let mut text = INTRODUCTION.to_owned();
    for verb in verbs() {
        text.push('\n');
        for usage in verb.usage() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{usage}");
        }
        let _ = writeln!(text, "    {}", verb.summary());
        if !verb.aliases.is_empty() {
            let _ = writeln!(text, "    also: {}", verb.aliases.join(", "));
        }
        if verb.danger == Danger::Confirm {
            let _ = writeln!(text, "    asks for a second key");
        }
        let mut seen: Vec<String> = Vec::new();
        for argument in verb.forms.iter().flat_map(|form| form.arguments) {
            let line = format!("    {:<16} {}", argument.usage(), argument.explained());
            if !argument.explained().is_empty() && !seen.contains(&line) {
                let _ = writeln!(text, "{line}");
                seen.push(line);
            }
        }
        for example in verb.examples {
            let _ = writeln!(text, "    e.g. {example}");
        }
    }
    text
}

const INTRODUCTION: &str = "\
A line is [TARGETS] VERB [ARGUMENTS].
TARGETS are 3, 1-4,7, @GROUP, all, or none for the selection; after `wait` they follow the verb.
Words in capitals are values, words in [] may be left out, | separates choices. A number may carry its
unit: 20m, 5m/s, 30s, 3min, 90deg. A mode's name alone changes to it. # begins a comment.
";
